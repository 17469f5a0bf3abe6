//! The mission protocol: missions, fences and rally points, item by item.

#![expect(deprecated, reason = "the real vehicle still speaks these messages")]

mod guided;
mod kept;
mod layout;
mod upload;

use std::ops::RangeInclusive;

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::MavMissionResult::{
    self, MAV_MISSION_ACCEPTED, MAV_MISSION_DENIED, MAV_MISSION_ERROR,
    MAV_MISSION_INVALID_SEQUENCE, MAV_MISSION_NO_SPACE, MAV_MISSION_OPERATION_CANCELLED,
    MAV_MISSION_UNSUPPORTED,
};
use mavlink::dialects::ardupilotmega::MavSeverity::{MAV_SEVERITY_INFO, MAV_SEVERITY_WARNING};
use mavlink::dialects::ardupilotmega::{
    MISSION_ACK_DATA, MISSION_CLEAR_ALL_DATA, MISSION_COUNT_DATA, MISSION_ITEM_DATA,
    MISSION_ITEM_INT_DATA, MISSION_REQUEST_DATA, MISSION_REQUEST_INT_DATA,
    MISSION_REQUEST_LIST_DATA, MISSION_WRITE_PARTIAL_LIST_DATA,
};

use self::kept::announce;
pub(super) use self::kept::{as_sent, leads_somewhere, replace, take_fence};
use self::layout::{Travelling, float_place, read_floats};
pub(super) use self::layout::{item_at, laid_out, whole_place};
use self::upload::{Upload, UploadDue};
use super::{Peer, Talk, items};
use crate::mode::ModeId;
use crate::payload::{Payload, Writer};
use crate::plan::{Item, ListKind};
use sortie_plan::board;

/// Message ids of the mission protocol.
const PARTIAL: u32 = MISSION_WRITE_PARTIAL_LIST_DATA::ID;
const ITEM: u32 = MISSION_ITEM_DATA::ID;
const REQUEST: u32 = MISSION_REQUEST_DATA::ID;
const REQUEST_LIST: u32 = MISSION_REQUEST_LIST_DATA::ID;
const COUNT: u32 = MISSION_COUNT_DATA::ID;
const CLEAR_ALL: u32 = MISSION_CLEAR_ALL_DATA::ID;
const ACK: u32 = MISSION_ACK_DATA::ID;
const REQUEST_INT: u32 = MISSION_REQUEST_INT_DATA::ID;
const ITEM_INT: u32 = MISSION_ITEM_INT_DATA::ID;
/// The transfers of the three lists.
#[derive(Debug, Clone, Default)]
pub(super) struct Lists([ListState; 3]);

#[derive(Debug, Clone, Default)]
struct ListState {
    upload: Option<Upload>,
    /// Whether the sender was warned about its old dialect.
    warned_item: bool,
    warned_request: bool,
}

impl Lists {
    /// Whether nothing is being uploaded.
    pub(super) fn is_idle(&self) -> bool {
        self.0.iter().all(|state| state.upload.is_none())
    }

    fn of(&mut self, kind: ListKind) -> &mut ListState {
        &mut self.0[usize::from(kind.number())]
    }
}

/// Whether a message belongs to the protocol.
pub(super) fn is_part(id: u32) -> bool {
    let requests = matches!(id, REQUEST | REQUEST_INT | REQUEST_LIST | CLEAR_ALL);
    requests || matches!(id, PARTIAL | ITEM | ITEM_INT | COUNT | ACK)
}

/// Answers a message of the protocol; `false` if it is not one.
pub(super) fn handle(talk: &mut Talk<'_>, id: u32, payload: &Payload) -> bool {
    // The offsets of the receiver's system id and of the list's number.
    let (to, list) = match id {
        PARTIAL => (4, 6),
        ITEM | ITEM_INT => (32, 37),
        REQUEST | REQUEST_INT | COUNT => (2, 4),
        REQUEST_LIST | CLEAR_ALL => (0, 2),
        // The vehicle ignores a ground station's acknowledgement, even a cancellation.
        ACK => return true,
        _ => return false,
    };
    if !talk.is_for_us(payload.byte(to)) {
        return true;
    }
    let number = payload.byte(list);
    if matches!(id, ITEM | ITEM_INT) {
        talk.item(&Travelling::read(payload), id == ITEM);
        return true;
    }
    let Some(kind) = ListKind::numbered(number) else {
        if !matches!(id, REQUEST | REQUEST_INT) {
            talk.ack(number, MAV_MISSION_UNSUPPORTED);
        }
        return true;
    };
    match id {
        PARTIAL => talk.partial(kind, payload.short(0) as i16, payload.short(2) as i16),
        REQUEST | REQUEST_INT => talk.request(kind, payload.short(0), id == REQUEST),
        REQUEST_LIST => talk.request_list(kind),
        COUNT => talk.count(kind, payload.short(0)),
        _ => talk.clear(kind),
    }
    true
}

/// Requests a missing item again, and eventually gives up.
pub(super) fn step(talk: &mut Talk<'_>) {
    let now = talk.autopilot.vehicle.uptime();
    for kind in ListKind::ALL {
        let link = talk.peer.link;
        let Some(upload) = &talk.state(kind).upload else {
            continue;
        };
        let peer = upload.peer;
        match upload.due(now, peer.link == link) {
            UploadDue::Nothing => {}
            UploadDue::AskAgain => talk.ask(kind),
            UploadDue::Forget => talk.state(kind).upload = None,
            UploadDue::GiveUp => {
                talk.peer = peer;
                talk.state(kind).upload = None;
                talk.ack(kind.number(), MAV_MISSION_OPERATION_CANCELLED);
                let name = match kind {
                    ListKind::Plan => "Mission",
                    ListKind::Fence => "Fence",
                    ListKind::Rally => "Rally",
                };
                talk.text(MAV_SEVERITY_WARNING, &format!("{name} upload timeout"));
            }
        }
    }
}

impl Talk<'_> {
    fn state(&mut self, kind: ListKind) -> &mut ListState {
        self.transfers.lists.of(kind)
    }

    fn ack(&mut self, list: u8, result: MavMissionResult) {
        let payload = vec![self.peer.system, self.peer.component, result as u8, list];
        self.raw(ACK, payload);
    }

    fn say_count(&mut self, kind: ListKind) {
        let count = self.autopilot.vehicle.plans.list(kind).len() as u16;
        let to = [self.peer.system, self.peer.component, kind.number()];
        self.raw(COUNT, Writer::default().short(count).bytes(&to).done());
    }

    fn ask(&mut self, kind: ListKind) {
        let now = self.autopilot.vehicle.uptime();
        let Some(upload) = &mut self.state(kind).upload else {
            return;
        };
        let (next, to) = (upload.ask(now), upload.peer);
        let to = [to.system, to.component, kind.number()];
        self.raw(REQUEST, Writer::default().short(next).bytes(&to).done());
    }

    fn begin(&mut self, kind: ListKind, items: RangeInclusive<u16>, staged: Vec<Item>) {
        let now = self.autopilot.vehicle.uptime();
        *self.state(kind) = ListState {
            upload: Some(Upload::new(self.peer, &items, now, staged)),
            ..ListState::default()
        };
        self.ask(kind);
    }

    fn count(&mut self, kind: ListKind, count: u16) {
        let peer = self.peer;
        if let Some(upload) = &self.state(kind).upload
            && !upload.peer.is_same_sender(peer)
        {
            self.ack(kind.number(), MAV_MISSION_DENIED);
            return;
        }
        if usize::from(count) > board::most_items(kind) {
            self.ack(kind.number(), MAV_MISSION_NO_SPACE);
            let text = format!("Only {} items are supported", board::most_items(kind));
            self.autopilot.vehicle.say(MAV_SEVERITY_WARNING, &text);
            return;
        }
        if kind != ListKind::Fence {
            self.truncate(kind, usize::from(count));
        }
        if count == 0 {
            self.state(kind).upload = None;
            self.complete(kind, Vec::new());
            return;
        }
        let staged = match kind {
            ListKind::Fence => vec![Item::default(); usize::from(count)],
            ListKind::Plan | ListKind::Rally => Vec::new(),
        };
        self.begin(kind, 0..=count - 1, staged);
    }

    fn partial(&mut self, kind: ListKind, first: i16, last: i16) {
        let length = self.autopilot.vehicle.plans.list(kind).len();
        let range = (u16::try_from(first), u16::try_from(last));
        let (Ok(first), Ok(last)) = range else {
            return self.refuse_partial(kind);
        };
        if usize::from(first) > length || usize::from(last) > length || last < first {
            return self.refuse_partial(kind);
        }
        let staged = match kind {
            ListKind::Fence => self.autopilot.vehicle.plans.fence.clone(),
            ListKind::Plan | ListKind::Rally => Vec::new(),
        };
        self.begin(kind, first..=last, staged);
    }

    fn refuse_partial(&mut self, kind: ListKind) {
        self.ack(kind.number(), MAV_MISSION_ERROR);
        self.autopilot
            .vehicle
            .say(MAV_SEVERITY_WARNING, "Flight plan update rejected");
    }

    fn clear(&mut self, kind: ListKind) {
        let autopilot = &*self.autopilot;
        // A mission that is being flown cannot be cleared.
        let flown = kind == ListKind::Plan
            && autopilot.vehicle.safety.armed
            && autopilot.vehicle.flight.mode.id == ModeId::Auto;
        let cleared = self.state(kind).upload.is_none() && !flown;
        if !cleared {
            self.ack(kind.number(), MAV_MISSION_ERROR);
            return;
        }
        if kind == ListKind::Fence {
            take_fence(self.autopilot, Vec::new());
        } else {
            self.truncate(kind, 0);
        }
        self.ack(kind.number(), MAV_MISSION_ACCEPTED);
    }

    fn truncate(&mut self, kind: ListKind, length: usize) {
        let items = self.autopilot.vehicle.plans.list_mut(kind);
        if items.len() > length {
            items.truncate(length);
            announce(self.autopilot, kind);
            self.autopilot.plans_changed(kind);
        }
    }

    fn request_list(&mut self, kind: ListKind) {
        if self.state(kind).upload.is_some() {
            self.ack(kind.number(), MAV_MISSION_DENIED);
        } else {
            self.say_count(kind);
        }
    }

    fn request(&mut self, kind: ListKind, seq: u16, with_floats: bool) {
        if self.state(kind).upload.is_some() {
            self.ack(kind.number(), MAV_MISSION_DENIED);
            return;
        }
        let Some(item) = as_sent(&self.autopilot.vehicle, kind, usize::from(seq)) else {
            let result = match kind {
                ListKind::Plan => {
                    self.say_count(kind);
                    MAV_MISSION_ERROR
                }
                ListKind::Fence if usize::from(seq) == self.autopilot.vehicle.plans.fence.len() => {
                    MAV_MISSION_ERROR
                }
                ListKind::Fence | ListKind::Rally => MAV_MISSION_INVALID_SEQUENCE,
            };
            self.ack(kind.number(), result);
            return;
        };
        let to = [self.peer.system, self.peer.component];
        if !with_floats {
            self.raw(ITEM_INT, laid_out(&item, seq, to, kind, whole_place(&item)));
            return;
        }
        self.raw(ITEM, laid_out(&item, seq, to, kind, float_place(&item)));
        if !std::mem::replace(&mut self.state(kind).warned_request, true) {
            let text = "got MISSION_REQUEST; use MISSION_REQUEST_INT!";
            self.autopilot.vehicle.say(MAV_SEVERITY_WARNING, text);
        }
    }

    fn item(&mut self, travelling: &Travelling, with_floats: bool) {
        let mut item = travelling.item;
        if with_floats && let Err(reason) = read_floats(&mut item) {
            self.ack(travelling.number, reason);
            return;
        }
        let Some(kind) = ListKind::numbered(travelling.number) else {
            self.ack(travelling.number, MAV_MISSION_UNSUPPORTED);
            return;
        };
        if kind == ListKind::Plan && guided::is_meant(travelling.current) {
            let result = guided::go(self.autopilot, &item, travelling.current);
            self.ack(travelling.number, result);
            return;
        }
        if with_floats && !std::mem::replace(&mut self.state(kind).warned_item, true) {
            let text = "got MISSION_ITEM; GCS should send MISSION_ITEM_INT";
            self.autopilot.vehicle.say(MAV_SEVERITY_WARNING, text);
        }
        let peer = self.peer;
        let refusal = match &self.state(kind).upload {
            None => Some(MAV_MISSION_ERROR),
            Some(upload) => upload.refusal(travelling.seq, peer),
        };
        if let Some(reason) = refusal {
            self.ack(travelling.number, reason);
            return;
        }
        if let Err(reason) = self.store(kind, travelling.seq, &item) {
            self.state(kind).upload = None;
            self.ack(travelling.number, reason);
            return;
        }
        self.proceed(kind);
    }

    /// Requests the next item, or ends the upload.
    fn proceed(&mut self, kind: ListKind) {
        let now = self.autopilot.vehicle.uptime();
        let Some(upload) = &mut self.state(kind).upload else {
            return;
        };
        if upload.advance(now) {
            self.ask(kind);
            return;
        }
        let staged = std::mem::take(&mut upload.staged);
        self.state(kind).upload = None;
        self.complete(kind, staged);
    }

    fn complete(&mut self, kind: ListKind, staged: Vec<Item>) {
        let mut result = MAV_MISSION_ACCEPTED;
        if kind == ListKind::Fence && !take_fence(self.autopilot, staged) {
            result = MAV_MISSION_ERROR;
        }
        self.ack(kind.number(), result);
        if kind == ListKind::Plan {
            self.text(MAV_SEVERITY_INFO, "Flight plan received");
        }
    }

    fn store(&mut self, kind: ListKind, seq: u16, item: &Item) -> Result<(), MavMissionResult> {
        let place = usize::from(seq);
        let item = items::kept(kind, item)?;
        if kind == ListKind::Fence {
            let upload = self.state(kind).upload.as_mut();
            let slot = upload.and_then(|upload| upload.staged.get_mut(place));
            *slot.ok_or(MAV_MISSION_INVALID_SEQUENCE)? = item;
            return Ok(());
        }
        let upload = self.state(kind).upload.as_ref();
        let announced = upload.map_or(1, Upload::length);
        let length = self.autopilot.vehicle.plans.list(kind).len();
        let in_sight = length.max(announced);
        if kind == ListKind::Plan && !leads_somewhere(&item, in_sight) {
            return Err(MAV_MISSION_ERROR);
        }
        let items = self.autopilot.vehicle.plans.list_mut(kind);
        if let Some(slot) = items.get_mut(place) {
            *slot = item;
        } else if place == length && length < board::most_items(kind) {
            items.push(item);
            announce(self.autopilot, kind);
        } else {
            return Err(MAV_MISSION_ERROR);
        }
        self.autopilot.plans_changed(kind);
        Ok(())
    }
}
