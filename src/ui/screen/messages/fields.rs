//! The message under the cursor, field by field or byte by byte.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use super::{age, hertz, interval};
use crate::app::State;
use crate::app::action::{Action, MessagesAction, ViewAction};
use crate::app::room::messages::{Messages, Selected};
use crate::inspector::{
    Census, Direction, FieldReading, MessageReading, MessageTally, TallyKey, name_of, read,
};
use crate::text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{below, clip, put, row_of, wrap};
use crate::wire::Anatomy;
use mavlink::MavlinkVersion;

const DIGITS: &[u8; 16] = b"0123456789abcdef";
/// The indent of a value below its name.
const INDENT: usize = 4;

/// A line of the pane, and the field that it belongs to.
type Row = (Option<usize>, Line<'static>);

pub(super) fn draw(
    state: &State,
    selected: Option<Selected<'_>>,
    panel: Panel<'_>,
    buffer: &mut Buffer,
) {
    let room = state.rooms().messages();
    let Some(selected) = selected else {
        draw_hint(state, panel, buffer);
        return;
    };
    let Selected {
        key, tally, now, ..
    } = selected;
    let title = format!("{} ({})", name_of(key.message), key.message);
    let inner = panel.focused(&title, room.field().is_some(), buffer);
    let Some(frame) = Anatomy::of(&tally.last) else {
        return;
    };
    let rate = tally.rate(now);
    let figures = text!(
        "messages-figures",
        hz = hertz(rate.hz),
        bytes = format!("{:.0}", rate.bytes_s),
        count = tally.count,
        age = age(now.saturating_sub(tally.last_at))
    );
    let width = usize::from(inner.width);
    put(
        buffer,
        inner,
        0,
        &Line::raw(clip(&panel.text(&figures), width)),
    );
    let dress = Line::styled(
        clip(&dress(key, &frame, tally, panel.look), width),
        panel.style(Role::Muted),
    );
    put(buffer, inner, 1, &dress);
    let statistics = statistics(selected, panel.look);
    for (row, line) in (2..).zip(&statistics) {
        put(buffer, inner, row, &Line::raw(clip(line, width)));
    }
    let inner = below(inner, 2 + statistics.len() as u16);
    if room.shows_hex() {
        draw_bytes(tally, panel.at(inner), buffer);
        return;
    }
    let reading = read(&frame);
    if reading.values.is_empty() {
        draw_undecoded(&reading, tally, panel.at(inner), buffer);
        return;
    }
    let rows = rows(room, selected, &reading, panel.look, inner.width.into());
    draw_rows(&rows, room.field(), panel.at(inner), buffer);
}

/// The statistics since the last reset as lines.
fn statistics(selected: Selected<'_>, look: &Look) -> [String; 3] {
    let Selected {
        tally, now, loss, ..
    } = selected;
    let statistics = &tally.statistics;
    let rate = statistics.rate(now);
    let known = |time: Option<Duration>| time.map_or_else(|| "-".to_owned(), interval);
    let silence = age(statistics.longest_silence(now));
    let gaps = match loss {
        Some(loss) => text!(
            "messages-gaps",
            silence = silence,
            lost = loss.lost(),
            percent = format!("{:.1}", 100.0 * loss.share())
        ),
        None => text!("messages-no-losses", silence = silence),
    };
    let window = text!(
        "messages-window",
        time = age(statistics.window(now)),
        hz = hertz(rate.hz),
        bytes = format!("{:.0}", rate.bytes_s)
    );
    let jitter = text!(
        "messages-jitter",
        jitter = known(statistics.jitter()),
        longest = known(statistics.longest_interval())
    );
    [window, jitter, gaps].map(|line| look.text(&line))
}

/// Draws a hint while no message is under the cursor.
fn draw_hint(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let inner = panel.titled(&panel.say("messages-fields"), buffer);
    let hint = text!(
        "messages-hint",
        open = state.key(Action::Submit),
        fields = state.key(Action::Messages(MessagesAction::OtherSide)),
        graph = state.key(Action::Messages(MessagesAction::Pin)),
        bytes = state.key(Action::Messages(MessagesAction::Hex)),
        send = state.key(Action::Messages(MessagesAction::SendAgain)),
        filter = state.key(Action::View(ViewAction::Filter)),
        sort = state.key(Action::View(ViewAction::Sort)),
        reset = state.key(Action::Messages(MessagesAction::ResetStatistics)),
        pause = state.key(Action::Messages(MessagesAction::Pause)),
        fold = state.key(Action::Messages(MessagesAction::FoldAll))
    );
    let mut lines = wrap(&panel.text(&hint), usize::from(inner.width));
    let traffic = state.rooms().messages().traffic().iter();
    let censuses = traffic.filter_map(|link| link.census.as_ref());
    let uncounted: u64 = censuses.map(Census::uncounted).sum();
    if uncounted > 0 {
        let text = text!("messages-uncounted", count = uncounted);
        lines.extend(wrap(&panel.text(&text), usize::from(inner.width)));
    }
    for (row, line) in lines.into_iter().enumerate() {
        let line = Line::styled(line, panel.style(Role::Muted));
        put(buffer, inner, row as u16, &line);
    }
}

/// The last frame's properties: version, direction, signature, length, sequence number.
fn dress(key: TallyKey, frame: &Anatomy<'_>, tally: &MessageTally, look: &Look) -> String {
    let version = match frame.version {
        MavlinkVersion::V1 => 1,
        MavlinkVersion::V2 => 2,
    };
    let way = match key.source.direction {
        Direction::In => look.say("messages-received"),
        Direction::Out => look.say("messages-sent"),
    };
    let signed = if frame.signed {
        look.say("messages-signed")
    } else {
        look.say("messages-unsigned")
    };
    look.text(&text!(
        "messages-dress",
        way = way,
        version = version,
        signed = signed,
        length = tally.last.len(),
        sequence = frame.sequence
    ))
}

fn draw_rows(rows: &[Row], field: Option<usize>, panel: Panel<'_>, buffer: &mut Buffer) {
    let is_cursor = |row: &Row| row.0.is_some() && row.0 == field;
    let cursor = rows.iter().position(is_cursor).unwrap_or(0);
    let height = usize::from(panel.area.height);
    let middle = cursor.saturating_sub(height / 2);
    let first = middle.min(rows.len().saturating_sub(height));
    panel.mark_scroll(first, rows.len(), buffer);
    for (at, row) in rows.iter().skip(first).take(height).enumerate() {
        put(buffer, panel.area, at as u16, &row.1);
        if is_cursor(row) {
            panel.at(row_of(panel.area, at as u16)).mark_cursor(buffer);
        }
    }
    let hidden = rows.len().saturating_sub(first + height);
    if hidden > 0 && height > 0 {
        let more = panel.text(&text!("messages-more", count = hidden));
        let place = row_of(panel.area, panel.area.height - 1);
        let x = place.right().saturating_sub(more.chars().count() as u16);
        buffer.set_string(x, place.y, more, panel.style(Role::Muted));
    }
}

fn rows(
    room: &Messages,
    selected: Selected<'_>,
    reading: &MessageReading,
    look: &Look,
    width: usize,
) -> Vec<Row> {
    let lengths = reading.values.iter().map(|value| value.name.len() + 1);
    let name_width = lengths.filter(|len| *len <= width / 2).max().unwrap_or(0);
    let mine = |field: usize| (selected.link, selected.key, field);
    let pins = room.pins().iter().map(|pin| (pin.link, pin.key, pin.field));
    let is_pinned = |field: usize| pins.clone().any(|pin| pin == mine(field));
    let mut rows = Vec::new();
    for (field, value) in reading.values.iter().enumerate() {
        let (words, role) = words(value, look);
        let mark = if is_pinned(field) { "~" } else { " " };
        let name = format!("{mark}{}", value.name);
        let name_role = if value.is_extension {
            Role::Muted
        } else {
            Role::Text
        };
        let left = width.saturating_sub(name_width + 1);
        let fits = name.len() <= name_width && Span::raw(words.as_str()).width() <= left;
        let mut line = vec![Span::styled(
            format!("{name:name_width$} "),
            look.style(name_role),
        )];
        if fits {
            line.push(Span::styled(words, look.style(role)));
            rows.push((Some(field), Line::from(line)));
            continue;
        }
        // A value too long for its column is placed below its name.
        rows.push((Some(field), Line::from(line)));
        for part in wrap(&words, width.saturating_sub(INDENT).max(8)) {
            let text = format!("{:INDENT$}{part}", "");
            rows.push((None, Line::styled(text, look.style(role))));
        }
    }
    rows
}

/// A value with its unit and its enum names.
fn words(value: &FieldReading, look: &Look) -> (String, Role) {
    if value.is_unknown {
        let text = text!("messages-unknown", value = value.figures());
        return (look.text(&text), Role::Muted);
    }
    let names = value.names.join(" ");
    let mut parts = vec![value.figures(), value.unit.to_owned(), names];
    parts.retain(|part| !part.is_empty());
    (parts.join(" "), Role::Text)
}

/// Draws a message that cannot be decoded: the reason, and its bytes.
fn draw_undecoded(
    reading: &MessageReading,
    tally: &MessageTally,
    panel: Panel<'_>,
    buffer: &mut Buffer,
) {
    let reason = if reading.name.is_some() {
        panel.say("messages-other-layout")
    } else {
        panel.say("messages-unknown-id")
    };
    let mut row = 0;
    for line in wrap(&reason, usize::from(panel.area.width)) {
        put(
            buffer,
            panel.area,
            row,
            &Line::styled(line, panel.style(Role::Warning)),
        );
        row += 1;
    }
    draw_bytes(tally, panel.below(row), buffer);
}

/// Draws the last frame byte by byte.
fn draw_bytes(tally: &MessageTally, panel: Panel<'_>, buffer: &mut Buffer) {
    let per_line = if panel.area.width >= 72 { 16 } else { 8 };
    for (row, bytes) in tally.last.chunks(per_line).enumerate() {
        let mut hex = String::new();
        for byte in bytes {
            hex.push(' ');
            hex.extend([byte >> 4, byte & 0xF].map(|digit| char::from(DIGITS[usize::from(digit)])));
        }
        let text: String = bytes
            .iter()
            .map(|&byte| {
                if byte.is_ascii_graphic() {
                    char::from(byte)
                } else {
                    '.'
                }
            })
            .collect();
        let offset = format!("{:03x}", row * per_line);
        let line = Line::from(vec![
            Span::styled(offset, panel.style(Role::Muted)),
            Span::raw(format!("{hex:width$} ", width = per_line * 3)),
            Span::styled(text, panel.style(Role::Muted)),
        ]);
        put(buffer, panel.area, row as u16, &line);
    }
}
