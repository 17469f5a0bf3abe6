//! The links: a line for each, and the doctor's findings and all counters of the link under the
//! cursor.

use std::collections::{BTreeMap, VecDeque};

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::room::links::{HISTORY_S, History};
use crate::app::state::{LinkCounters, LinkSummary};
use crate::doctor::{Cause, LinkFinding, Weight};
use crate::text;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::curve::{self, Curve};
use crate::ui::widget::{below, clip, columns, put, row_of, upper, wrap};
use crate::vehicle::VehicleId;
use crate::vehicle_id::ranges;
use crate::wire::SystemId;

mod forwards;

/// The width of a label, in columns.
const LABEL: usize = 16;
/// The maximum number of senders whose losses are listed.
const LOSSES_SHOWN: usize = 5;
/// The maximum number of radios under test that are listed.
const RADIOS_SHOWN: usize = 8;
const CURVE_ROWS: u16 = 2;

pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let links = state.session().links();
    if links.is_empty() {
        let inner = panel.titled(&panel.say("room-links"), buffer);
        let line = Line::styled(panel.say("links-none"), panel.style(Role::Muted));
        put(buffer, inner, 0, &line);
        return;
    }
    let cursor = state.rooms().links().cursor().min(links.len() - 1);
    let wanted = links.len() as u16 + 2;
    let rows = wanted.min((panel.area.height / 3).max(4));
    draw_list(state, cursor, panel.upper(rows), buffer);
    let mut below_list = panel.below(rows);
    if !state.session().forwards().is_empty() {
        let rest = forwards::draw(state, below_list, buffer);
        below_list = panel.at(rest);
    }
    let rest = draw_doctor(state, cursor, below_list, buffer);
    draw_link(state, cursor, panel.at(rest), buffer);
}

fn draw_list(state: &State, cursor: usize, panel: Panel<'_>, buffer: &mut Buffer) {
    let links = state.session().links();
    let room = usize::from(panel.area.height.saturating_sub(2));
    let first = cursor
        .saturating_sub(room / 2)
        .min(links.len().saturating_sub(room));
    let mut title = panel.say("room-links");
    if links.len() > room {
        let last = first + room;
        let part = text!(
            "fly-rows",
            first = first + 1,
            last = last,
            count = links.len()
        );
        title = format!("{title} {}", panel.text(&part));
    }
    let inner = panel.focused(&title, true, buffer);
    let name_width = usize::from(inner.width).saturating_sub(53);
    let head = format!(
        "{:>3} {:name_width$} {:>10} {:>10} {:>6}  {:9} {}",
        "#",
        panel.say("links-address"),
        panel.say("links-in"),
        panel.say("links-out"),
        panel.say("links-lost"),
        panel.say("links-state"),
        panel.say("links-check")
    );
    put(
        buffer,
        inner,
        0,
        &Line::styled(head, panel.style(Role::Muted)),
    );
    let inner = below(inner, 1);
    let rows = usize::from(inner.height);
    for (row, (at, link)) in links.iter().enumerate().skip(first).take(rows).enumerate() {
        let worst = state.session().findings().iter().find(|it| it.link == at);
        let line = list_line(at, link, worst, name_width, panel.look);
        put(buffer, inner, row as u16, &line);
        if at == cursor {
            put(buffer, row_of(inner, row as u16), 0, &Line::raw(">"));
            panel.at(row_of(inner, row as u16)).mark_cursor(buffer);
        }
    }
    panel.at(inner).mark_list(first, links.len(), true, buffer);
}

fn list_line(
    at: usize,
    link: &LinkSummary,
    worst: Option<&LinkFinding>,
    name_width: usize,
    look: &Look,
) -> Line<'static> {
    let counters = link.counters.as_ref();
    let lost = counters.map_or_else(unknown, |it| it.all_lost().to_string());
    let (sign, role) = worst.map_or((String::new(), Role::Text), |finding| {
        let (sign, role) = signed(finding.cause.weight());
        (look.say(sign), role)
    });
    let hears_nothing = worst.is_some_and(|it| it.cause == Cause::Nothing);
    let (state, state_role) = match (link.up, hears_nothing) {
        (true, true) => ("links-silent", Role::Warning),
        (true, false) => ("links-up", Role::Ok),
        (false, _) => ("links-down", Role::Danger),
    };
    let state = look.say(state);
    let figures = format!(
        "{:>3} {:name_width$} {:>10.0} {:>10.0} {lost:>6}  ",
        at + 1,
        clip(&look.text(&link.name), name_width),
        link.bytes_in_per_s,
        link.bytes_out_per_s
    );
    Line::from(vec![
        Span::raw(figures),
        Span::styled(format!("{state:9} "), look.style(state_role)),
        Span::styled(sign, look.style(role)),
    ])
}

/// A dash for an unknown value.
fn unknown() -> String {
    "-".to_owned()
}

/// The word and the role of a finding's severity.
fn signed(weight: Weight) -> (&'static str, Role) {
    match weight {
        Weight::Fatal => ("links-fatal", Role::Danger),
        Weight::Fault => ("links-fault", Role::Warning),
        Weight::Remark => ("links-remark", Role::Accent),
        Weight::Fine => ("links-fine", Role::Ok),
    }
}

/// Draws the doctor's findings for a link; returns the area below them.
fn draw_doctor(state: &State, link: usize, panel: Panel<'_>, buffer: &mut Buffer) -> Rect {
    let title = match state.session().links().len() {
        0 | 1 => panel.say("links-doctor"),
        _ => panel.text(&text!("links-doctor-of", link = link + 1)),
    };
    let inner = panel.titled(&title, buffer);
    let width = usize::from(inner.width).saturating_sub(2);
    let mine = state
        .session()
        .findings()
        .iter()
        .filter(|it| it.link == link);
    let mut row = 0;
    for finding in mine {
        let (sign, role) = signed(finding.cause.weight());
        let says = format!("{}: {}", panel.say(sign), panel.text(&finding.says()));
        let lines = wrap(&says, width).into_iter().map(|line| (line, role));
        let advice = wrap(&panel.text(&finding.advice()), width)
            .into_iter()
            .filter(|line| !line.is_empty())
            .map(|line| (format!("  {line}"), Role::Text));
        for (line, role) in lines.chain(advice) {
            put(buffer, inner, row, &Line::styled(line, panel.style(role)));
            row += 1;
        }
    }
    if row == 0 {
        let line = Line::styled(panel.say("doctor-listening"), panel.style(Role::Muted));
        put(buffer, inner, 0, &line);
    }
    below(inner, row.max(1))
}

/// Draws all counters of a link and its recent traffic.
fn draw_link(state: &State, at: usize, panel: Panel<'_>, buffer: &mut Buffer) {
    let link = &state.session().links()[at];
    let inner = panel.titled(&format!("{} {}", at + 1, panel.text(&link.name)), buffer);
    let mut lines = vec![(
        text!("links-state"),
        panel.text(&state.session().link_state(at)),
    )];
    lines.extend(counters(link, panel.look));
    lines.extend(autopilots(state, at));
    lines.extend(controls(state, at, panel.look));
    lines.extend(radios(state, at, panel.look));
    let mut row = 0;
    for (label, words) in lines {
        let label = panel.text(&label);
        let wrapped = wrap(&words, usize::from(inner.width).saturating_sub(LABEL + 1));
        for (count, line) in wrapped.into_iter().enumerate() {
            let label = if count == 0 { label.as_str() } else { "" };
            let line = Line::from(vec![
                Span::styled(format!("{label:LABEL$} "), panel.style(Role::Muted)),
                Span::raw(line),
            ]);
            put(buffer, inner, row, &line);
            row += 1;
        }
    }
    if let Some(history) = state.rooms().links().histories().get(at) {
        draw_history(history, panel.at(below(inner, row)), buffer);
    }
}

fn counters(link: &LinkSummary, look: &Look) -> Vec<(Text, String)> {
    let error = link.error.iter();
    let mut lines: Vec<(Text, String)> = error
        .map(|it| (text!("links-error"), look.text(it)))
        .collect();
    let traffic = |bytes: f64, messages: f64| {
        let (bytes, messages) = (format!("{bytes:.0}"), format!("{messages:.0}"));
        text!("links-rates", bytes = bytes, messages = messages)
    };
    let trip = link.round_trip;
    let round_trip = trip.map_or_else(unknown, |trip| format!("{} ms", trip.as_millis()));
    let received = traffic(link.bytes_in_per_s, link.messages_in_per_s);
    let sent = traffic(link.bytes_out_per_s, link.messages_out_per_s);
    let counted = |figures: fn(&LinkCounters) -> Text| {
        let counters = link.counters.as_ref();
        counters.map_or_else(unknown, |it| look.text(&figures(it)))
    };
    lines.extend([
        (text!("links-received"), look.text(&received)),
        (text!("links-sent"), look.text(&sent)),
    ]);
    if let Some(seals) = link.counters.as_ref().and_then(|it| it.seals) {
        lines.push((text!("links-signing"), look.text(&seals.text())));
    }
    lines.extend([
        (text!("links-round-trip"), round_trip),
        (text!("links-dropped"), counted(passed_over)),
        (text!("links-missing"), counted(losses)),
        (text!("links-others"), counted(others)),
    ]);
    lines
}

/// The autopilots of the vehicles on a link, by name, with the number of vehicles; `None` if no name is known.
fn autopilots(state: &State, at: usize) -> Option<(Text, String)> {
    let vehicles = state.session().vehicles().values();
    let mine = vehicles.filter(|vehicle| vehicle.link.via.map(usize::from) == Some(at));
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for name in mine.filter_map(|vehicle| vehicle.heartbeat?.autopilot_name()) {
        *counts.entry(name).or_default() += 1;
    }
    let named = counts.iter().map(|(name, count)| format!("{name} {count}"));
    let words = named.collect::<Vec<_>>().join(", ");
    (!words.is_empty()).then(|| (text!("links-autopilots"), words))
}

/// The ground stations in control of the vehicles on a link, if any vehicle announces its own: `255: 1-3; free: 4`.
fn controls(state: &State, at: usize, look: &Look) -> Option<(Text, String)> {
    let vehicles = state.session().vehicles().values();
    let mine = vehicles.filter(|vehicle| vehicle.link.via.map(usize::from) == Some(at));
    let mut owners: BTreeMap<Option<SystemId>, Vec<VehicleId>> = BTreeMap::new();
    for vehicle in mine {
        if let Some(control) = vehicle.control {
            owners.entry(control.owner).or_default().push(vehicle.id);
        }
    }
    let parts = owners.into_iter().map(|(owner, vehicles)| {
        let owner = owner.map_or_else(|| look.say("links-control-free"), |id| id.to_string());
        format!("{owner}: {}", ranges(vehicles))
    });
    let parts: Vec<String> = parts.collect();
    (!parts.is_empty()).then(|| (text!("links-control"), parts.join("; ")))
}

/// The radio tests of the vehicles on a link: what was requested, and what was measured.
fn radios(state: &State, at: usize, look: &Look) -> Vec<(Text, String)> {
    let vehicles = state.session().vehicles().values();
    let mine = vehicles.filter(|vehicle| vehicle.link.via.map(usize::from) == Some(at));
    let tested = mine.filter_map(|vehicle| {
        let radio = vehicle.link.radio?;
        let figures = radio.text(vehicle.link.round_trip);
        let label = text!("links-radio", vehicle = vehicle.id);
        Some((label, look.text(&figures)))
    });
    tested.take(RADIOS_SHOWN).collect()
}

/// Counters of bytes and messages that arrived and were not used.
fn passed_over(counters: &LinkCounters) -> Text {
    text!(
        "links-dropped-figures",
        crc = counters.bad_crc,
        skipped = counters.skipped_bytes,
        unknown = counters.unknown,
        undecoded = counters.undecoded
    )
}

fn others(counters: &LinkCounters) -> Text {
    text!(
        "links-other-figures",
        peers = counters.peers,
        reconnects = counters.reconnects,
        unsent = counters.unsent
    )
}

/// Losses per sender, as `3/1: 12`, the worst first, and the number of others.
fn losses(counters: &LinkCounters) -> Text {
    let mut lossy: Vec<_> = counters
        .lost
        .iter()
        .filter(|(_, count)| *count > 0)
        .collect();
    lossy.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    let mut parts: Vec<String> = lossy
        .iter()
        .take(LOSSES_SHOWN)
        .map(|((system, component), count)| format!("{system}/{component}: {count}"))
        .collect();
    if lossy.len() > LOSSES_SHOWN {
        parts.push(format!("+{}", lossy.len() - LOSSES_SHOWN));
    }
    if parts.is_empty() {
        "0".into()
    } else {
        parts.join(", ").into()
    }
}

fn draw_history(history: &History, panel: Panel<'_>, buffer: &mut Buffer) {
    let half = panel.area.width / 2;
    let sides = [
        (text!("links-in"), history.bytes_in(), 0),
        (text!("links-out"), history.bytes_out(), half),
    ];
    for (label, values, from) in sides {
        let most = values.iter().copied().fold(0.0, f64::max);
        let title = panel.text(&text!(
            "links-history",
            way = label,
            most = format!("{most:.0}"),
            seconds = HISTORY_S
        ));
        let side = columns(panel.area, from, half.saturating_sub(1));
        let title = clip(&title, side.width.into());
        put(
            buffer,
            side,
            0,
            &Line::styled(title, panel.style(Role::Muted)),
        );
        let plot = upper(below(side, 1), CURVE_ROWS.max(side.height.min(8) / 2));
        let values = spread(values, curve::steps(plot.width, panel.look.symbols));
        let style = panel.style(Role::Accent);
        let curve = Curve {
            values: &values,
            low: 0.0,
            high: most.max(1.0),
            style,
        };
        curve::draw(&curve, panel.look.symbols, plot, buffer);
    }
}

/// The history spread over a number of columns, the newest value at the right edge.
fn spread(history: &VecDeque<f64>, count: usize) -> Vec<Option<f64>> {
    let value = |column: usize| {
        let ago = (count - 1 - column) * HISTORY_S / count.max(1);
        let at = history.len().checked_sub(ago + 1)?;
        history.get(at).copied()
    };
    (0..count).map(value).collect()
}
