//! The inspector: every message on the links, by link, system, component and message type.

use std::collections::BTreeSet;
use std::time::Duration;

use crate::app::State;
use crate::app::action::Step;
use crate::app::room::Room;
use crate::inspector::{
    Census, Direction, MessageReading, MessageTally, TallyKey, WatchedMessage, name_of, read,
};
use crate::text;
use crate::text::Text;
use crate::wire::{Anatomy, SenderLoss};

pub(super) mod act;
mod pin;
mod tree;

pub use pin::{GRAPH_SPAN, Pin, PinExtent};
pub use tree::{Branch, Node};

/// The maximum number of graphs below the fields.
const MOST_PINS: usize = 4;

/// The state of the room.
#[derive(Debug, Clone, Default)]
pub struct Messages {
    /// The traffic as last received.
    pub(in crate::app) traffic: Vec<LinkTraffic>,
    /// Whether the display is paused.
    pub(in crate::app) paused: bool,
    /// The filter: only messages whose name contains it, or whose number equals it, are shown.
    pub(in crate::app) filter: String,
    /// The order of a component's messages.
    pub(in crate::app) sort: Sort,
    /// The line under the cursor; `None` for the first.
    pub(in crate::app) cursor: Option<Node>,
    /// The field under the cursor, while the fields have the focus.
    pub(in crate::app) field: Option<usize>,
    /// Whether the last frame is shown byte by byte.
    pub(in crate::app) hex: bool,
    /// The fields that are drawn as graphs.
    pub(in crate::app) pins: Vec<Pin>,
    /// Branches toggled from their default state.
    turned: BTreeSet<Node>,
}

/// The messages of one link: their counts, and the frames of the fields drawn as graphs.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkTraffic {
    pub name: Text,
    /// The time of the count, on the clock of the link's census.
    pub now: Duration,
    /// The counts; `None` if only graphs needed data.
    pub census: Option<Census>,
    /// The frames of the fields with a graph.
    pub watched: Vec<WatchedMessage>,
}

/// The data that the room needs from the links.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TrafficRequest {
    /// Whether the counts of all messages are needed.
    pub census: bool,
    /// The number of times that a reset of the statistics was requested in this session.
    pub resets: u32,
    /// The messages of which every frame is needed, each with the number of its link.
    pub watched: BTreeSet<(usize, TallyKey)>,
}

/// The message under the cursor.
#[derive(Debug, Clone, Copy)]
pub struct Selected<'a> {
    /// The number of the message's link.
    pub link: usize,
    /// The message and its sender.
    pub key: TallyKey,
    pub tally: &'a MessageTally,
    /// The losses of the message's sender; `None` for the console's own messages and for unknown
    /// senders.
    pub loss: Option<&'a SenderLoss>,
    /// The time of the count, on the link's clock.
    pub now: Duration,
}

/// The order of the messages.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Sort {
    /// The lowest MAVLink id first.
    #[default]
    Number,
    /// The names of the messages, in alphabetical order.
    Name,
    /// The most frequent first, by messages per second.
    Rate,
    /// The most recent first.
    Age,
}

/// The data that the room needs now; `None` if it needs no data.
pub fn traffic_request(state: &State) -> Option<TrafficRequest> {
    let room = &state.rooms.messages;
    let connections = &state.session.connections;
    let resets = connections.statistics_resets;
    let counted = |link: &LinkTraffic| link.census.as_ref().map(Census::resets);
    let is_reset = room.traffic.first().and_then(counted) == Some(resets) || resets == 0;
    let census = state.room == Room::Messages || connections.export_to.is_some() || !is_reset;
    if room.paused || !census && room.pins.is_empty() {
        return None;
    }
    let watched = room.pins.iter().map(|pin| (pin.link, pin.key)).collect();
    Some(TrafficRequest {
        census,
        resets,
        watched,
    })
}

impl Sort {
    fn next(self) -> Self {
        match self {
            Self::Number => Self::Name,
            Self::Name => Self::Rate,
            Self::Rate => Self::Age,
            Self::Age => Self::Number,
        }
    }

    /// The order's name on the screen.
    pub fn title(self) -> Text {
        match self {
            Self::Number => text!("messages-by-number"),
            Self::Name => text!("messages-by-name"),
            Self::Rate => text!("messages-by-rate"),
            Self::Age => text!("messages-by-age"),
        }
    }
}

impl Messages {
    /// The traffic as last received.
    pub fn traffic(&self) -> &[LinkTraffic] {
        &self.traffic
    }

    /// Whether the display is paused.
    pub fn is_paused(&self) -> bool {
        self.paused
    }

    /// The filter: only messages whose name contains it, or whose number equals it, are shown.
    pub fn filter_text(&self) -> &str {
        &self.filter
    }

    /// The order of a component's messages.
    pub fn sort(&self) -> Sort {
        self.sort
    }

    /// The line under the cursor; `None` for the first.
    pub fn cursor(&self) -> Option<Node> {
        self.cursor
    }

    /// The field under the cursor, while the fields have the focus.
    pub fn field(&self) -> Option<usize> {
        self.field
    }

    /// Whether the last frame is shown byte by byte.
    pub fn shows_hex(&self) -> bool {
        self.hex
    }

    /// The fields that are drawn as graphs.
    pub fn pins(&self) -> &[Pin] {
        &self.pins
    }

    pub fn take(&mut self, traffic: Vec<LinkTraffic>) {
        for (link, seen) in traffic.iter().enumerate() {
            for pin in self.pins.iter_mut().filter(|pin| pin.link == link) {
                pin.take(seen);
            }
        }
        if traffic.iter().any(|link| link.census.is_some()) {
            self.traffic = traffic;
        }
    }

    /// The message under the cursor; `None` on any other line.
    pub fn selected(&self) -> Option<Selected<'_>> {
        self.selected_in(&self.branches())
    }

    /// The message under the cursor, from lines already computed.
    pub fn selected_in(&self, branches: &[Branch]) -> Option<Selected<'_>> {
        let Node::Message(link, key) = branches.get(self.cursor_row(branches))?.node else {
            return None;
        };
        let traffic = self.traffic.get(link)?;
        let census = traffic.census.as_ref()?;
        let is_received = key.source.direction == Direction::In;
        Some(Selected {
            link,
            key,
            tally: census.tally(key)?,
            loss: census.loss_of(key.source).filter(|_| is_received),
            now: traffic.now,
        })
    }

    /// The fields of the last frame of the message under the cursor; `None` on any other line.
    pub fn reading(&self) -> Option<MessageReading> {
        let last = &self.selected()?.tally.last;
        Anatomy::of(last).map(|frame| read(&frame))
    }

    /// The line under the cursor; if it is hidden, the line that replaces it.
    pub fn cursor_branch(&self) -> Option<Branch> {
        let branches = self.branches();
        let at = self.cursor_row(&branches);
        branches.into_iter().nth(at)
    }

    /// The number of the line under the cursor.
    pub fn cursor_row(&self, branches: &[Branch]) -> usize {
        let Some(cursor) = self.cursor else {
            return 0;
        };
        let exact = branches.iter().position(|branch| branch.node == cursor);
        // It is folded or filtered out: use the branch that hides it, if any.
        exact.unwrap_or_else(|| {
            let hides = |branch: &Branch| cursor.is_below(branch.node);
            branches.iter().rposition(hides).unwrap_or(0)
        })
    }

    fn submit(&mut self) {
        match self.cursor_branch() {
            Some(branch) if branch.is_open.is_some() => self.turn(branch.node),
            Some(_) => self.enter_fields(),
            None => {}
        }
    }

    fn go(&mut self, step: Step) {
        if let Some(field) = self.field {
            let count = self.reading().map_or(0, |reading| reading.values.len());
            self.field = Some(step.apply(field, count));
            return;
        }
        let branches = self.branches();
        let at = step.apply(self.cursor_row(&branches), branches.len());
        self.cursor = branches.get(at).map(|branch| branch.node);
    }

    fn enter_fields(&mut self) {
        let has_fields = self.reading().is_some_and(|it| !it.values.is_empty());
        self.field = has_fields.then_some(0);
        if has_fields {
            self.hex = false;
        }
    }

    fn expand(&mut self) {
        match self.cursor_branch() {
            Some(branch) if branch.is_open == Some(false) => self.turn(branch.node),
            Some(branch) if branch.is_open == Some(true) => self.go(Step::Down),
            Some(_) => self.enter_fields(),
            None => {}
        }
    }

    fn collapse(&mut self) {
        if self.field.take().is_some() {
            return;
        }
        match self.cursor_branch() {
            Some(branch) if branch.is_open == Some(true) => self.turn(branch.node),
            Some(branch) => self.cursor = branch.node.parent().or(self.cursor),
            None => {}
        }
    }

    fn turn(&mut self, node: Node) {
        if !self.turned.remove(&node) {
            self.turned.insert(node);
        }
        self.cursor = Some(node);
    }

    /// Closes all systems, or opens them if all are closed.
    fn fold_all(&mut self) {
        let branches = self.branches();
        let systems = branches
            .iter()
            .filter(|branch| matches!(branch.node, Node::System(..)));
        let is_any_open = systems.clone().any(|branch| branch.is_open == Some(true));
        let to_turn: Vec<Node> = systems
            .filter(|branch| branch.is_open == Some(is_any_open))
            .map(|branch| branch.node)
            .collect();
        let cursor = self.cursor;
        for node in to_turn {
            self.turn(node);
        }
        self.cursor = cursor;
    }

    /// Draws a graph of the field under the cursor, or removes it.
    fn pin(&mut self, choose: &Text) -> Result<(), Text> {
        let (Some(field), Some(selected)) = (self.field, self.selected()) else {
            return Err(choose.clone());
        };
        let Selected { link, key, now, .. } = selected;
        let is_it = |pin: &Pin| (pin.link, pin.key, pin.field) == (link, key, field);
        if self.pins.iter().any(is_it) {
            self.pins.retain(|pin| !is_it(pin));
            return Ok(());
        }
        let reading = self.reading();
        let read = reading
            .as_ref()
            .and_then(|reading| reading.values.get(field));
        let value = read.ok_or_else(|| choose.clone())?;
        if value.text.is_some() {
            return Err(text!("messages-no-number", field = value.name));
        }
        let pin = Pin {
            link,
            key,
            field,
            title: format!("{}.{}", name_of(key.message), value.name),
            unit: value.unit,
            points: value
                .number()
                .map(|number| (now, number))
                .into_iter()
                .collect(),
            now,
            dropped: 0,
        };
        if self.pins.len() == MOST_PINS {
            self.pins.remove(0);
        }
        self.pins.push(pin);
        Ok(())
    }
}
