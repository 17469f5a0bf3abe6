//! The links: their counters, their history, and their faults.

use std::collections::VecDeque;

use crate::app::State;
use crate::app::action::{Action, Step};
use crate::app::keymap::{KeyHint, KeyRow, does, hint, key};
use crate::app::room::{Answer, Room, RoomModel};
use crate::app::state::LinkSummary;

/// The length of the history in seconds.
pub const HISTORY_S: usize = 60;

/// The state of the room.
#[derive(Debug, Clone, Default)]
pub struct Links {
    /// The link under the cursor.
    pub(in crate::app) cursor: usize,
    /// The traffic of every link, one value per second.
    pub(in crate::app) history: Vec<History>,
}

/// The recent traffic of a link, newest last.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct History {
    /// Bytes per second received.
    pub(in crate::app) bytes_in: VecDeque<f64>,
    /// Bytes per second sent.
    pub(in crate::app) bytes_out: VecDeque<f64>,
}

impl History {
    /// Bytes per second received.
    pub fn bytes_in(&self) -> &VecDeque<f64> {
        &self.bytes_in
    }

    /// Bytes per second sent.
    pub fn bytes_out(&self) -> &VecDeque<f64> {
        &self.bytes_out
    }
}

const HINTS: &[KeyHint] = &[
    hint(&[Action::CommandLine], "links-key-command"),
    hint(&[Action::Help], "links-key-help"),
    hint(Action::UP_AND_DOWN, "links-key-choose"),
    hint(&[Action::Show(Room::Messages)], "links-key-messages"),
    hint(&[Action::Show(Room::Fly)], "links-key-fly"),
];

impl RoomModel for Links {
    const KEYS: &'static [KeyRow] = &[does(key('J'), Action::TakeSticks)];

    fn hints(_state: &State) -> &'static [KeyHint] {
        HINTS
    }

    fn step(state: &mut State, step: Step) -> Answer {
        let cursor = &mut state.rooms.links.cursor;
        *cursor = step.apply(*cursor, state.session.connections.links.len());
        Some(Vec::new())
    }
}

impl Links {
    /// The link under the cursor.
    pub fn cursor(&self) -> usize {
        self.cursor
    }

    /// The traffic of every link, one value per second.
    pub fn histories(&self) -> &[History] {
        &self.history
    }

    /// Adds the current traffic of the links; called once a second.
    pub fn note(&mut self, links: &[LinkSummary]) {
        self.history.resize(links.len(), History::default());
        for (history, link) in self.history.iter_mut().zip(links) {
            let (bytes_in, bytes_out) = if link.up {
                (link.bytes_in_per_s, link.bytes_out_per_s)
            } else {
                (0.0, 0.0)
            };
            push(&mut history.bytes_in, bytes_in);
            push(&mut history.bytes_out, bytes_out);
        }
    }
}

fn push(history: &mut VecDeque<f64>, value: f64) {
    history.push_back(value);
    if history.len() > HISTORY_S {
        history.pop_front();
    }
}
