//! Transfers to and from the vehicle: lists of items, files and flight logs.
//!
//! As on the real vehicle, at most one upload per list, one open file and one log download are
//! under way at a time, over all links together.

mod content;
mod fence;
mod files;
mod items;
mod lists;
mod logs;
mod packed;
mod plan_file;
mod tree;

use mavlink::dialects::ardupilotmega::{MavMessage, MavSeverity};

use self::files::Files;
use self::lists::Lists;
use self::logs::LogDownload;
use super::autopilot::Autopilot;
use super::link::{Link, LinkNumber};
use super::payload::Payload;
use super::plan::{Item, ListKind};
use super::texts;
use sortie_wire::{Frame, Outgoing};

/// Every transfer of a vehicle.
#[derive(Debug, Clone, Default)]
pub(super) struct Transfers {
    lists: Lists,
    files: Files,
    download: LogDownload,
    /// The number of links that have sent a request.
    links: u32,
}

/// Stores a whole list as an upload would; a plan begins with home. `false` if the vehicle refuses
/// it.
pub(super) fn load(autopilot: &mut Autopilot, kind: ListKind, items: &[Item]) -> bool {
    plan_file::take_list(autopilot, kind, items)
}

impl Transfers {
    /// Whether no transfer is under way.
    pub(super) fn is_idle(&self) -> bool {
        self.lists.is_idle() && self.files.is_idle() && self.download.is_idle()
    }

    /// The state after a reboot: files stay.
    pub(super) fn rebooted(self) -> Self {
        Self {
            files: self.files.rebooted(),
            ..Self::default()
        }
    }
}

/// A ground station on a link.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct Peer {
    link: u32,
    system: u8,
    component: u8,
}

impl Peer {
    fn is_same_sender(self, other: Self) -> bool {
        (self.system, self.component) == (other.system, other.component)
    }
}

/// A conversation with a ground station.
struct Talk<'a> {
    autopilot: &'a mut Autopilot,
    transfers: &'a mut Transfers,
    link: &'a mut Link,
    peer: Peer,
}

impl Talk<'_> {
    fn is_for_us(&self, to: u8) -> bool {
        to == 0 || to == self.autopilot.vehicle.system
    }

    /// Version, board and frame, for this link.
    fn banner(&mut self) -> Vec<MavMessage> {
        let vehicle = &mut self.autopilot.vehicle;
        let before = vehicle.outbox.len();
        vehicle.say_banner();
        vehicle.outbox.split_off(before)
    }

    fn raw(&mut self, id: u32, payload: Vec<u8>) {
        self.link.replies.push(Outgoing::Raw { id, payload });
    }

    /// Sends a text on this link alone.
    fn text(&mut self, severity: MavSeverity, text: &str) {
        let mut said = Vec::new();
        texts::say(&mut said, severity, text);
        self.link.replies.extend(said.into_iter().map(Into::into));
    }
}

/// Answers a message that belongs to a transfer; `false` if it does not belong to one.
pub(super) fn handle(
    transfers: &mut Transfers,
    autopilot: &mut Autopilot,
    link: &mut Link,
    frame: &Frame,
) -> bool {
    let id = frame.content.id();
    if !(lists::is_part(id) || files::is_part(id) || logs::is_part(id)) {
        return false;
    }
    let Some(payload) = Payload::of(&frame.content) else {
        return false;
    };
    if link.transfer.0 == 0 {
        transfers.links += 1;
        link.transfer = LinkNumber(transfers.links);
    }
    let peer = Peer {
        link: link.transfer.0,
        system: frame.system,
        component: frame.component,
    };
    let mut talk = Talk {
        autopilot,
        transfers,
        link,
        peer,
    };
    lists::handle(&mut talk, id, &payload)
        || files::handle(&mut talk, id, &payload)
        || logs::handle(&mut talk, id, &payload)
}

/// Continues the transfers of a link.
pub(super) fn step(transfers: &mut Transfers, autopilot: &mut Autopilot, link: &mut Link) {
    let peer = Peer {
        link: link.transfer.0,
        ..Peer::default()
    };
    let mut talk = Talk {
        autopilot,
        transfers,
        link,
        peer,
    };
    lists::step(&mut talk);
    files::step(&mut talk);
    logs::step(&mut talk);
}
