//! The inspector: the tree of all messages on the left, the message under the cursor on the right.

use std::time::Duration;

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::HEARTBEAT_DATA;
use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::room::messages::{Branch, Messages, Node};
use crate::inspector::{Direction, FrameSource, MessageTally, Rate, name_of, read};
use crate::text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{below, clip, columns, put, row_of, upper};
use crate::wire::Anatomy;

mod fields;
mod graph;

/// The width of the tree with rate and age, and of the wide one with bytes and count as well, in
/// columns.
const NARROW_TREE: u16 = 43;
const WIDE_TREE: u16 = 62;
/// The width of the tree with jitter and silence as well, in columns.
const WIDEST_TREE: u16 = 80;
/// The minimum width of the screen for the wide tree, in columns.
const WIDE: u16 = 112;
/// The minimum width of the screen for the widest tree, in columns.
const WIDEST: u16 = 150;

pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let room = state.rooms().messages();
    let tree_width = match panel.area.width {
        WIDEST.. => WIDEST_TREE,
        WIDE.. => WIDE_TREE,
        _ => NARROW_TREE,
    };
    let branches = room.branches();
    draw_tree(room, &branches, panel.columns(0, tree_width), buffer);
    let right = columns(panel.area, tree_width + 2, panel.area.width);
    let graphs = graph::height(room, right.height);
    let top = upper(right, right.height - graphs);
    fields::draw(state, room.selected_in(&branches), panel.at(top), buffer);
    graph::draw(room, panel.at(below(right, top.height)), buffer);
}

fn draw_tree(room: &Messages, branches: &[Branch], panel: Panel<'_>, buffer: &mut Buffer) {
    let has_keys = room.field().is_none();
    let inner = panel.focused(&tree_title(room, panel.look), has_keys, buffer);
    let tree_width = panel.area.width;
    let head = heading(tree_width, inner.width, panel.look);
    put(
        buffer,
        inner,
        0,
        &Line::styled(head, panel.style(Role::Muted)),
    );
    let inner = below(inner, 1);
    if branches.is_empty() {
        let text = if room.filter_text().is_empty() {
            panel.say("messages-none")
        } else {
            panel.say("messages-none-found")
        };
        put(
            buffer,
            inner,
            0,
            &Line::styled(text, panel.style(Role::Muted)),
        );
        return;
    }
    let rows = usize::from(inner.height);
    let cursor = room.cursor_row(branches);
    let middle = cursor.saturating_sub(rows / 2);
    let first = middle.min(branches.len().saturating_sub(rows));
    for (row, branch) in branches.iter().skip(first).take(rows).enumerate() {
        let line = tree_line(room, branch, tree_width, inner.width, panel.look);
        put(buffer, inner, row as u16, &line);
        if first + row == cursor {
            let role = if has_keys {
                Role::Cursor
            } else {
                Role::Selected
            };
            buffer.set_style(row_of(inner, row as u16), panel.style(role));
            if let Some(cell) = buffer.cell_mut((inner.x, inner.y + row as u16)) {
                cell.set_char('>');
            }
        }
    }
    panel
        .at(inner)
        .mark_list(first, branches.len(), has_keys, buffer);
}

fn tree_title(room: &Messages, look: &Look) -> String {
    let mut title = look.text(&room.sort().title());
    if !room.filter_text().is_empty() {
        title = format!("/{}  {title}", room.filter_text());
    }
    if room.is_paused() {
        title = format!("{}  {title}", look.say("messages-paused"));
    }
    title
}

fn heading(tree_width: u16, width: u16, look: &Look) -> String {
    let count = look.say("messages-count");
    let jitter = look.say("messages-jitter-column");
    let silence = look.say("messages-silence-column");
    let words = [
        "Hz",
        "B/s",
        &count,
        &look.say("messages-age"),
        &jitter,
        &silence,
    ];
    let figures = columns_of(tree_width, words);
    format!("{figures:>width$}", width = usize::from(width))
}

/// Figures in the columns of a tree: rate, bytes, count, age, jitter, silence. Narrow trees have fewer.
fn columns_of(tree_width: u16, [hz, bytes, count, age, jitter, silence]: [&str; 6]) -> String {
    match tree_width {
        WIDEST_TREE.. => format!("{hz:>7}{bytes:>8}{count:>9}{age:>8}{jitter:>9}{silence:>8}"),
        WIDE_TREE.. => format!("{hz:>7}{bytes:>8}{count:>9}{age:>8}"),
        _ => format!("{hz:>7}{age:>8}"),
    }
}

fn tree_line(
    room: &Messages,
    branch: &Branch,
    tree_width: u16,
    width: u16,
    look: &Look,
) -> Line<'static> {
    let figures = figures(branch, tree_width);
    let marker = match branch.is_open {
        Some(true) => "- ",
        Some(false) => "+ ",
        None => "",
    };
    let room_left = usize::from(width).saturating_sub(figures.len() + 1);
    // A column before the tree for the cursor.
    let indent = " ".repeat(branch.node.depth() + 1);
    let whole = format!("{indent}{marker}{}", label(room, branch.node, look));
    let label = clip(&whole, room_left);
    let padding = room_left.saturating_sub(Span::raw(label.as_str()).width()) + 1;
    let is_stale = branch.age.is_none_or(|age| age > Duration::from_secs(5));
    let role = match branch.node {
        Node::Link(_) => Role::Title,
        Node::System(..) | Node::Component(..) => Role::Accent,
        Node::Message(..) if is_stale => Role::Muted,
        Node::Message(..) => Role::Text,
    };
    Line::from(vec![
        Span::styled(label, look.style(role)),
        Span::raw(" ".repeat(padding)),
        Span::styled(
            figures,
            look.style(if is_stale { Role::Muted } else { Role::Text }),
        ),
    ])
}

fn figures(branch: &Branch, tree_width: u16) -> String {
    let Rate { hz, bytes_s } = branch.rate;
    let words = [
        hertz(hz),
        format!("{bytes_s:.0}"),
        branch.count.to_string(),
        branch.age.map_or_else(|| "-".to_owned(), age),
        branch.jitter.map(interval).unwrap_or_default(),
        branch.silence.map(age).unwrap_or_default(),
    ];
    columns_of(tree_width, words.each_ref().map(String::as_str))
}

/// An interval in milliseconds or seconds, in at most eight columns.
fn interval(interval: Duration) -> String {
    let seconds = interval.as_secs_f64();
    match seconds {
        ..0.01 => format!("{:.2} ms", seconds * 1e3),
        ..1.0 => format!("{:.0} ms", seconds * 1e3),
        _ => format!("{seconds:.1} s"),
    }
}

fn label(room: &Messages, node: Node, look: &Look) -> String {
    let traffic = room.traffic().get(node.link());
    match node {
        Node::Link(link) => {
            let name = traffic.map_or_else(String::new, |traffic| look.text(&traffic.name));
            format!("{} {name}", link + 1)
        }
        Node::System(_, direction, peer, system) => {
            let census = traffic.and_then(|traffic| traffic.census.as_ref());
            let peer = census.and_then(|census| census.peer_name(peer));
            let name = look.text(&text!("messages-system", system = system));
            let way = match (direction, peer) {
                (Direction::In, Some(peer)) => peer.to_owned(),
                (Direction::In, None) => look.say("messages-received"),
                (Direction::Out, Some(peer)) => {
                    return look.text(&text!("messages-to", system = system, peer = peer));
                }
                (Direction::Out, None) => look.say("messages-sent"),
            };
            format!("{name} {way}")
        }
        Node::Component(_, source) => {
            let component = source.component;
            let name = look.text(&text!("messages-component", component = component));
            format!("{name} {}", kind(room, node.link(), source))
        }
        Node::Message(_, key) => name_of(key.message),
    }
}

/// The type of a component, by its last heartbeat.
fn kind(room: &Messages, link: usize, source: FrameSource) -> String {
    let census = room.traffic().get(link).and_then(|it| it.census.as_ref());
    let heartbeat =
        census.and_then(|census| census.of(source).find(|(id, _)| *id == HEARTBEAT_DATA::ID));
    let kind = |tally: &MessageTally| {
        let reading = read(&Anatomy::of(&tally.last)?);
        let kind = reading.values.iter().find(|value| value.name == "type")?;
        kind.names.first().cloned()
    };
    heartbeat
        .and_then(|(_, tally)| kind(tally))
        .unwrap_or_default()
}

/// A rate with a suitable number of digits.
fn hertz(hz: f64) -> String {
    if hz >= 99.95 {
        format!("{hz:.0}")
    } else {
        format!("{hz:.1}")
    }
}

/// An age in at most six columns.
fn age(age: Duration) -> String {
    match age.as_secs() {
        0..=9 => format!("{:.1} s", age.as_secs_f64()),
        seconds @ 10..=99 => format!("{seconds} s"),
        seconds @ 100..=5999 => format!("{} min", seconds / 60),
        seconds => format!("{} h", seconds / 3600),
    }
}
