//! The hangar: a line per process, and the fault and the output of the process under the cursor.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::action::{Action, HangarAction};
use crate::app::room::hangar::under_cursor;
use crate::app::state::{Hangar, Instance, SitlStage};
use crate::text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, below, clip, put, row_of, wrap};

/// The widths of the bar, of the bar beside a host name, and of the state, in columns.
const BAR: usize = 12;
const SHORT_BAR: usize = 5;
const WORDS: usize = 22;
/// The width of all figures after the state, in columns.
const FIGURES: usize = 32;
/// The maximum width of a host name, in columns.
const HOST: usize = 24;

pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let Some(hangar) = state.session().hangar() else {
        return empty(panel, buffer);
    };
    if state.rooms().hangar().is_opened()
        && let Some(instance) = under_cursor(state)
    {
        let output = hangar.output(instance);
        return draw_output(
            instance,
            output,
            state.rooms().hangar().back(),
            panel,
            buffer,
        );
    }
    let list = draw_list(state, hangar, panel, buffer);
    if let Some(instance) = under_cursor(state) {
        draw_detail(state, instance, panel.at(list), buffer);
    }
}

fn empty(panel: Panel<'_>, buffer: &mut Buffer) {
    let inner = panel.titled(&panel.say("room-hangar"), buffer);
    let lines = wrap(&panel.say("hangar-none"), usize::from(inner.width));
    for (row, line) in lines.into_iter().enumerate() {
        put(
            buffer,
            inner,
            row as u16,
            &Line::styled(line, panel.style(Role::Muted)),
        );
    }
}

/// Draws the processes and returns the area below them.
fn draw_list(state: &State, hangar: &Hangar, panel: Panel<'_>, buffer: &mut Buffer) -> Rect {
    let ready = text!(
        "hangar-ready",
        ready = hangar.ready(),
        count = hangar.expected()
    );
    let title = format!("{}: {}", panel.say("room-hangar"), panel.text(&ready));
    let most = panel.area.height.saturating_sub(8).max(4);
    let rows = (hangar.instances().len().max(1) as u16 + 3).min(most);
    let inner = panel.upper(rows).focused(&title, true, buffer);
    let columns = Columns::new(hangar, inner.width);
    put(
        buffer,
        inner,
        0,
        &Line::styled(heading(columns, panel.look), panel.style(Role::Muted)),
    );
    let inner = below(inner, 1);
    if hangar.instances().is_empty() {
        // The message may use the whole room.
        draw_nothing(hangar, panel.at(below(panel.area, 2)), buffer);
    }
    draw_instances(
        hangar,
        state.rooms().hangar().cursor(),
        columns,
        panel.at(inner),
        buffer,
    );
    below(panel.area, rows)
}

/// Draws the reason why there is no process.
fn draw_nothing(hangar: &Hangar, panel: Panel<'_>, buffer: &mut Buffer) {
    let (text, role) = match hangar.fault() {
        Some(fault) => (panel.text(fault), Role::Danger),
        None => (panel.say("hangar-opening"), Role::Muted),
    };
    let lines = wrap(&text, usize::from(panel.area.width));
    for (row, line) in lines.into_iter().enumerate() {
        let line = Line::styled(line, panel.style(role));
        put(buffer, panel.area, row as u16, &line);
    }
}

fn draw_instances(
    hangar: &Hangar,
    cursor: usize,
    columns: Columns,
    panel: Panel<'_>,
    buffer: &mut Buffer,
) {
    let count = hangar.instances().len();
    let room = usize::from(panel.area.height);
    let first = cursor
        .saturating_sub(room / 2)
        .min(count.saturating_sub(room));
    let shown = hangar.instances().iter().enumerate().skip(first).take(room);
    for (row, (at, instance)) in shown.enumerate() {
        let text = line(instance, columns, panel.look);
        put(buffer, panel.area, row as u16, &text);
        if at == cursor {
            panel.at(row_of(panel.area, row as u16)).mark_cursor(buffer);
        }
    }
    panel.mark_list(first, count, true, buffer);
}

/// The widths of the host and of the bar, in columns.
#[derive(Debug, Clone, Copy)]
struct Columns {
    host: usize,
    bar: usize,
}

impl Columns {
    /// Divides the remaining columns: the bar is shortened to keep host names whole.
    fn new(hangar: &Hangar, width: u16) -> Self {
        let left = |bar| usize::from(width).saturating_sub(4 + bar + 1 + WORDS + 1 + FIGURES + 1);
        let names = hangar.instances().iter().filter_map(host_name);
        let bar = match names.map(|name| name.chars().count()).max() {
            Some(longest) if longest > left(BAR) => SHORT_BAR,
            _ => BAR,
        };
        let host = left(bar).min(HOST);
        Self { host, bar }
    }
}

/// The host of the service that runs a process, if there is one.
fn host_name(instance: &Instance) -> Option<&str> {
    let url = instance.host.as_deref()?;
    Some(url.trim_start_matches("http://"))
}

fn heading(columns: Columns, look: &Look) -> String {
    let figures = [
        aligned(&look.say("hangar-pid"), 8, true),
        aligned(&look.say("hangar-restarts"), 7, true),
        aligned(&look.say("hangar-memory"), 9, true),
        aligned(&look.say("hangar-processor"), 8, true),
    ];
    let stage = aligned(&look.say("hangar-stage"), columns.bar + 1 + WORDS, false);
    let host = columns.host;
    let host_title = aligned(&clip(&look.say("hangar-host-title"), host), host, false);
    format!("{:>3} {host_title} {stage} {}", "#", figures.concat())
}

fn line(instance: &Instance, Columns { host, bar }: Columns, look: &Look) -> Line<'static> {
    let role = role(instance.stage, instance.has_crashed());
    let filled = (instance.progress() * bar as f32).round() as usize;
    let drawn = format!(
        "{}{}",
        "█".repeat(filled),
        "░".repeat(bar.saturating_sub(filled))
    );
    let words = clip(&look.text(&instance.says()), WORDS);
    let unknown = || "-".to_owned();
    let pid = instance.pid.map_or_else(unknown, |pid| pid.to_string());
    // A process that has not been measured yet has no figures.
    let measured = instance.pid.filter(|_| instance.memory_bytes > 0);
    let memory = measured.map_or_else(unknown, |_| megabytes(instance.memory_bytes));
    let load = instance.processor_percent.filter(|_| measured.is_some());
    let processor = load.map_or_else(unknown, |percent| format!("{percent:.1} %"));
    let place = host_name(instance).map_or_else(|| look.say("hangar-here"), str::to_owned);
    let name = aligned(&place, host, false);
    Line::from(vec![
        Span::raw(format!("{:>3} {name} ", instance.vehicle)),
        Span::styled(drawn, look.style(role)),
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

fn role(stage: SitlStage, has_crashed: bool) -> Role {
    match stage {
        _ if has_crashed => Role::Danger,
        SitlStage::Ready => Role::Ok,
        SitlStage::Queued | SitlStage::Stopping | SitlStage::Ended => Role::Muted,
        SitlStage::Process | SitlStage::Heartbeat | SitlStage::Parameters | SitlStage::Position => {
            Role::Accent
        }
    }
}

/// Draws the fault of a process, and the end of its output.
fn draw_detail(state: &State, instance: &Instance, panel: Panel<'_>, buffer: &mut Buffer) {
    let hangar = state.session().hangar();
    let output = hangar.map_or(&[][..], |hangar| hangar.output(instance));
    let title = panel.text(&text!("hangar-vehicle", vehicle = instance.vehicle));
    let inner = panel.titled(&title, buffer);
    let width = usize::from(inner.width);
    let mut lines: Vec<(String, Style)> = Vec::new();
    let wrapped = |text: &str, role| {
        let style = panel.style(role);
        wrap(text, width).into_iter().map(move |line| (line, style))
    };
    if let Some(fault) = &instance.fault {
        let fault = panel.text(&text!("hangar-fault", reason = fault.as_str()));
        lines.extend(wrapped(&fault, Role::Danger));
    }
    if let Some(hint) = &instance.hint {
        lines.extend(wrapped(hint, Role::Warning));
    }
    if instance.has_crashed() {
        let what = text!(
            "hangar-fault-what",
            restart = state.key(Action::Hangar(HangarAction::RestartProcess)),
            stop = state.key(Action::Hangar(HangarAction::StopProcess))
        );
        lines.extend(wrapped(&panel.text(&what), Role::Text));
    }
    let place = panel.text(&where_kept(instance, output));
    lines.extend(wrapped(&place, Role::Muted));
    let room = usize::from(inner.height).saturating_sub(lines.len());
    let skipped = output.len().saturating_sub(room);
    let output = output.iter().skip(skipped);
    lines.extend(output.map(|line| (line.clone(), panel.style(Role::Text))));
    for (row, (line, style)) in lines.into_iter().enumerate() {
        put(
            buffer,
            inner,
            row as u16,
            &Line::styled(clip(&line, width), style),
        );
    }
}

fn where_kept(instance: &Instance, output: &[String]) -> text::Text {
    let folder = instance.folder.as_str();
    if output.is_empty() {
        text!("hangar-no-output", folder = folder)
    } else {
        text!("hangar-output", folder = folder)
    }
}

/// Draws the output on the whole screen, `back` lines before the newest.
fn draw_output(
    instance: &Instance,
    output: &[String],
    back: usize,
    panel: Panel<'_>,
    buffer: &mut Buffer,
) {
    let title = panel.text(&text!("hangar-output-of", vehicle = instance.vehicle));
    let inner = panel.titled(&title, buffer);
    let width = usize::from(inner.width);
    let place = wrap(&panel.text(&where_kept(instance, output)), width);
    let above = place.len() as u16;
    for (row, line) in place.into_iter().enumerate() {
        let line = Line::styled(line, panel.style(Role::Muted));
        put(buffer, inner, row as u16, &line);
    }
    let inner = below(inner, above);
    let end = output.len().saturating_sub(back);
    let lines: Vec<String> = output[..end]
        .iter()
        .flat_map(|line| wrap(line, width))
        .collect();
    let skipped = lines.len().saturating_sub(usize::from(inner.height));
    for (row, line) in lines.into_iter().skip(skipped).enumerate() {
        put(buffer, inner, row as u16, &Line::raw(line));
    }
}
