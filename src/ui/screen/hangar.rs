//! The hangar: a line for the process of each vehicle, and of the one under the cursor what ails it and what it says.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::{Line, Span};

use crate::app::room::hangar::under_cursor;
use crate::app::state::{Hangar, Instance, Stage, State};
use crate::text;
use crate::ui::look::Look;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, below, clip, put, row_of, titled, upper, wrap};

/// Keys that the last line of the screen names.
pub const HINTS: &[(&str, &str)] = &[
    (":", "hint-command"),
    ("?", "hint-help"),
    ("j k", "hint-move"),
    ("Enter", "hangar-key-output"),
    ("r", "hangar-key-restart"),
    ("x", "hangar-key-stop"),
    ("F", "links-key-fly"),
    ("q", "hangar-key-leave"),
];
/// Columns of the bar, and of the words beside it.
const BAR: usize = 12;
const WORDS: usize = 22;
/// Columns of all figures behind them.
const FIGURES: usize = 32;
/// Columns of a host at most.
const HOST: usize = 24;

/// Draws it.
pub fn draw(state: &State, look: &Look, area: Rect, buffer: &mut Buffer) {
    let Some(hangar) = &state.session.hangar else {
        return empty(look, area, buffer);
    };
    if state.rooms.hangar.opened
        && let Some(instance) = under_cursor(state)
    {
        return draw_output(instance, state.rooms.hangar.back, look, area, buffer);
    }
    let list = draw_list(state, hangar, look, area, buffer);
    if let Some(instance) = under_cursor(state) {
        draw_detail(instance, look, list, buffer);
    }
}

fn empty(look: &Look, area: Rect, buffer: &mut Buffer) {
    let inner = titled(&look.say("room-hangar"), look, area, buffer);
    let lines = wrap(&look.say("hangar-none"), usize::from(inner.width));
    for (row, line) in lines.into_iter().enumerate() {
        put(
            buffer,
            inner,
            row as u16,
            &Line::styled(line, look.style(Role::Muted)),
        );
    }
}

/// Draws the processes and returns what is left below.
fn draw_list(state: &State, hangar: &Hangar, look: &Look, area: Rect, buffer: &mut Buffer) -> Rect {
    let ready = text!(
        "hangar-ready",
        ready = hangar.ready(),
        count = hangar.expected
    );
    let title = format!("{}: {}", look.say("room-hangar"), look.text(&ready));
    let most = area.height.saturating_sub(8).max(4);
    let rows = (hangar.instances.len().max(1) as u16 + 3).min(most);
    let inner = titled(&title, look, upper(area, rows), buffer);
    let host = host_width(inner.width);
    put(
        buffer,
        inner,
        0,
        &Line::styled(heading(host, look), look.style(Role::Muted)),
    );
    let inner = below(inner, 1);
    if hangar.instances.is_empty() {
        let line = Line::styled(look.say("hangar-opening"), look.style(Role::Muted));
        put(buffer, inner, 0, &line);
    }
    let cursor = state.rooms.hangar.cursor;
    let room = usize::from(inner.height);
    let first = cursor.saturating_sub(room / 2);
    let first = first.min(hangar.instances.len().saturating_sub(room));
    let shown = hangar.instances.iter().enumerate().skip(first).take(room);
    for (row, (at, instance)) in shown.enumerate() {
        put(buffer, inner, row as u16, &line(instance, host, look));
        if at == cursor {
            buffer.set_style(row_of(inner, row as u16), look.style(Role::Cursor));
        }
    }
    below(area, rows)
}

/// Columns that are left for the host.
fn host_width(width: u16) -> usize {
    let others = 4 + BAR + 1 + WORDS + 1 + FIGURES + 1;
    usize::from(width).saturating_sub(others).min(HOST)
}

fn heading(host: usize, look: &Look) -> String {
    let figures = [
        aligned(&look.say("hangar-pid"), 8, true),
        aligned(&look.say("hangar-restarts"), 7, true),
        aligned(&look.say("hangar-memory"), 9, true),
        aligned(&look.say("hangar-processor"), 8, true),
    ];
    let stage = aligned(&look.say("hangar-stage"), BAR + 1 + WORDS, false);
    let host_title = aligned(&clip(&look.say("hangar-host-title"), host), host, false);
    format!("{:>3} {host_title} {stage} {}", "#", figures.concat())
}

fn line(instance: &Instance, host: usize, look: &Look) -> Line<'static> {
    let role = role(instance.stage, instance.has_crashed());
    let filled = (instance.progress() * BAR as f32).round() as usize;
    let bar = format!(
        "{}{}",
        "█".repeat(filled),
        "░".repeat(BAR.saturating_sub(filled))
    );
    let words = clip(&look.text(&instance.says()), WORDS);
    let unknown = || "-".to_owned();
    let pid = instance.pid.map_or_else(unknown, |pid| pid.to_string());
    // One that has not been measured yet has no figures.
    let measured = instance.pid.filter(|_| instance.memory_bytes > 0);
    let memory = measured.map_or_else(unknown, |_| megabytes(instance.memory_bytes));
    let processor = instance.processor_percent.filter(|_| measured.is_some());
    let processor = processor.map_or_else(unknown, |percent| format!("{percent:.1} %"));
    let name = match &instance.host {
        Some(url) => url.trim_start_matches("http://").to_owned(),
        None => look.say("hangar-here"),
    };
    let name = aligned(&clip(&name, host), host, false);
    Line::from(vec![
        Span::raw(format!("{:>3} {name} ", instance.vehicle)),
        Span::styled(bar, look.style(role)),
        Span::styled(
            format!(" {} ", aligned(&words, WORDS, false)),
            look.style(role),
        ),
        Span::raw(format!(
            "{pid:>8}{:>7}{memory:>9}{processor:>8}",
            instance.restarts
        )),
    ])
}

fn megabytes(bytes: u64) -> String {
    format!("{:.1} MB", bytes as f64 / 1e6)
}

fn role(stage: Stage, has_crashed: bool) -> Role {
    match stage {
        _ if has_crashed => Role::Danger,
        Stage::Ready => Role::Ok,
        Stage::Queued | Stage::Stopping | Stage::Ended => Role::Muted,
        _ => Role::Accent,
    }
}

/// What ails a process, and the end of what it has printed.
fn draw_detail(instance: &Instance, look: &Look, area: Rect, buffer: &mut Buffer) {
    let title = look.text(&text!("hangar-vehicle", vehicle = instance.vehicle));
    let inner = titled(&title, look, area, buffer);
    let width = usize::from(inner.width);
    let mut lines: Vec<(String, Style)> = Vec::new();
    if let Some(fault) = &instance.fault {
        let fault = look.text(&text!("hangar-fault", reason = fault.as_str()));
        let what_to_do = look.say("hangar-fault-what");
        let wrapped = |text: &str, role| {
            let style = look.style(role);
            wrap(text, width).into_iter().map(move |line| (line, style))
        };
        lines.extend(wrapped(&fault, Role::Danger));
        lines.extend(wrapped(&what_to_do, Role::Text));
    }
    let room = usize::from(inner.height).saturating_sub(lines.len() + 1);
    lines.push((look.text(&where_kept(instance)), look.style(Role::Muted)));
    let skipped = instance.output.len().saturating_sub(room);
    let output = instance.output.iter().skip(skipped);
    lines.extend(output.map(|line| (line.clone(), look.style(Role::Text))));
    for (row, (line, style)) in lines.into_iter().enumerate() {
        put(
            buffer,
            inner,
            row as u16,
            &Line::styled(clip(&line, width), style),
        );
    }
}

fn where_kept(instance: &Instance) -> text::Text {
    let folder = instance.folder.as_str();
    if instance.output.is_empty() {
        text!("hangar-no-output", folder = folder)
    } else {
        text!("hangar-output", folder = folder)
    }
}

/// The output on the whole screen, ending so many lines before its end.
fn draw_output(instance: &Instance, back: usize, look: &Look, area: Rect, buffer: &mut Buffer) {
    let title = look.text(&text!("hangar-output-of", vehicle = instance.vehicle));
    let inner = titled(&title, look, area, buffer);
    let where_kept = look.text(&where_kept(instance));
    put(
        buffer,
        inner,
        0,
        &Line::styled(where_kept, look.style(Role::Muted)),
    );
    let inner = below(inner, 1);
    let width = usize::from(inner.width);
    let end = instance.output.len().saturating_sub(back);
    let lines: Vec<String> = instance.output[..end]
        .iter()
        .flat_map(|line| wrap(line, width))
        .collect();
    let skipped = lines.len().saturating_sub(usize::from(inner.height));
    for (row, line) in lines.into_iter().skip(skipped).enumerate() {
        put(buffer, inner, row as u16, &Line::raw(line));
    }
}
