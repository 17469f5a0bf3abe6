//! Reads the plan, the fence and the rally points of a vehicle in the background: once it is ready,
//! and again after changes. An operator's orders about them are in
//! [`plan_orders`](super::plan_orders).
//!
//! Only one list is read at a time, and only one request is outstanding. A list has changed when
//! `MISSION_CURRENT` contains another count or id, or when the vehicle has accepted another
//! program's upload. `ArduPilot` gives no ids, but reports changes in texts and by its parameters
//! `FENCE_TOTAL` and `RALLY_TOTAL`. None of these shows an upload of the same length over another
//! link, so a list without an id is read again periodically. A list that the vehicle does not offer
//! is not requested; a failed one is requested again at growing intervals, and then abandoned.

use std::sync::Arc;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::{MISSION_CURRENT_DATA, MavMessage, MavProtocolCapability};

use crate::plan::{Item, ListKind};
use crate::vehicle::{FencePlan, Plan, RallyPlan, Transfer, Vehicle};
use crate::wire::{Content, Frame};

pub(super) mod download;
#[cfg(test)]
mod tests;
pub(super) mod wire;

use download::{Download, Step};
use wire::Answer;

/// How long to wait before the first query to a new vehicle: `ArduPilot` stalls while it boots.
const AFTER_FIRST_HEARD: Duration = Duration::from_secs(3);
/// The delay between groups of a swarm's vehicles, by system id, and the number of groups.
const STAGGER: Duration = Duration::from_millis(100);
const STAGGER_GROUPS: u32 = 16;
/// A vehicle that has not reported its capabilities within this time is asked for its plan anyway,
/// since every vehicle has one.
const CAPABILITIES_WITHIN: Duration = Duration::from_secs(10);
/// How long an upload counts as under way after its last sign.
const SETTLED_AFTER: Duration = Duration::from_millis(1500);
/// The minimum time between two readings of the same list.
const NOT_AGAIN_WITHIN: Duration = Duration::from_secs(3);
/// The time after which a list without an id is read again, and the extra time per item: on average
/// less than one small message a second.
const AGAIN_AFTER: Duration = Duration::from_secs(120);
const AGAIN_PER_ITEM: Duration = Duration::from_secs(1);
/// As [`AGAIN_AFTER`], while another ground station is heard, which may upload a list unseen.
const AGAIN_BESIDE_STATION: Duration = Duration::from_secs(20);
/// How long a ground station counts as present after its last heartbeat.
const STATION_STAYS: Duration = Duration::from_secs(10);
/// The waits after the first, second and third failures; after a fourth, nothing more is requested.
const AFTER_FAILURE: [Duration; 3] = [
    Duration::from_secs(20),
    Duration::from_secs(60),
    Duration::from_secs(300),
];

const MISSION_FLOAT: u64 = MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_MISSION_FLOAT.bits();
const MISSION_INT: u64 = MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_MISSION_INT.bits();
const MISSION_FENCE: u64 = MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_MISSION_FENCE.bits();
const MISSION_RALLY: u64 = MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_MISSION_RALLY.bits();

/// The texts that `ArduPilot` sends after an upload (`GCS_MAVLINK::handle_mission_item`, `AC_PolyFence_loader`).
const UPLOAD_TEXTS: [(&[u8], ListKind); 2] = [
    (b"Flight plan received", ListKind::Plan),
    (b"Fence Indexed OK", ListKind::Fence),
];
/// The parameters with `ArduPilot`'s counts of uploaded items, which it sends on its own when they change.
const UPLOAD_PARAMETERS: [(&[u8], ListKind); 2] = [
    (b"FENCE_TOTAL", ListKind::Fence),
    (b"RALLY_TOTAL", ListKind::Rally),
];
/// `PARAM_VALUE.param_index` of a value that is not part of the list of all parameters.
const NO_INDEX: u16 = u16::MAX;

/// Reads the lists of one vehicle.
#[derive(Debug, Clone, Default)]
pub(super) struct PlanReader {
    /// Whether it requests nothing and only reads the answers to other stations, as in a recording.
    only_follows: bool,
    /// When the vehicle was first heard.
    heard_at: Option<Duration>,
    /// Whether the vehicle's capabilities have been evaluated.
    knows_capabilities: bool,
    /// When each list is due to be read; `None` if it is not due.
    due: [Option<Duration>; 3],
    /// When each list was last read, and its number of failures since.
    read_at: [Option<Duration>; 3],
    failures: [usize; 3],
    /// Lists that the vehicle has refused: they are not requested again.
    refused: [bool; 3],
    download: Option<Download>,
    /// The lists that the user knows to be on board: as first read, or as last read or written by
    /// an order. A list of another program that is read in the background is not one of them.
    acknowledged: [Option<Vec<Item>>; 3],
    /// When another ground station was last heard.
    station_at: Option<Duration>,
    /// The count and the ids in `MISSION_CURRENT`.
    announced: Option<[u32; 4]>,
}

impl PlanReader {
    /// Starts again after a reboot, or with another link.
    pub fn forget(&mut self) {
        *self = Self {
            only_follows: self.only_follows,
            acknowledged: std::mem::take(&mut self.acknowledged),
            ..Self::default()
        };
    }

    /// Requests nothing from now on, but still reads the answers to other stations.
    pub fn only_follow(&mut self) {
        self.only_follows = true;
    }

    /// Whether an answer is awaited.
    pub fn is_busy(&self) -> bool {
        self.download.is_some()
    }

    /// Makes way for an order about the lists: a download under way is repeated later.
    pub fn make_way(&mut self, now: Duration, out: &mut Vec<MavMessage>) {
        if let Some(download) = self.download.take() {
            self.due[download.kind as usize] = Some(now);
            download.cancel(out);
        }
    }

    /// Notes a list that an order has read.
    pub fn learn(
        &mut self,
        vehicle: &mut Vehicle,
        kind: ListKind,
        items: Vec<Item>,
        now: Duration,
    ) {
        self.refused[kind as usize] = false;
        self.is_read(kind, items.len(), now);
        self.acknowledged[kind as usize] = Some(items.clone());
        store(vehicle, kind, items);
        *transfer(vehicle, kind) = Transfer::Done;
    }

    /// The list that the user knows to be on board, if one has been read.
    pub fn acknowledged(&self, kind: ListKind) -> Option<&[Item]> {
        self.acknowledged[kind as usize].as_deref()
    }

    /// Accepts the next list read as the one known to the user: after a transfer with an unknown
    /// outcome, it does not count as changed by another program.
    pub fn forget_acknowledged(&mut self, kind: ListKind) {
        self.acknowledged[kind as usize] = None;
    }

    /// Requests a list again, as soon as possible.
    pub fn read_again(&mut self, kind: ListKind, now: Duration) {
        self.due[kind as usize] = Some(now);
    }

    /// Notes that another ground station is heard. Lists that are to be read again much later are read soon.
    pub fn station_heard(&mut self, now: Duration) {
        let before = self.station_at.replace(now);
        let is_new = before.is_none_or(|at| now.saturating_sub(at) >= STATION_STAYS);
        let soon = now + AGAIN_BESIDE_STATION;
        for due in self.due.iter_mut().flatten().filter(|_| is_new) {
            *due = soon.min(*due);
        }
    }

    fn is_read(&mut self, kind: ListKind, length: usize, now: Duration) {
        let list = kind as usize;
        self.read_at[list] = Some(now);
        self.failures[list] = 0;
        let has_company = |at| now.saturating_sub(at) < STATION_STAYS;
        let after = match self.station_at.filter(|at| has_company(*at)) {
            Some(_) => AGAIN_BESIDE_STATION,
            None => AGAIN_AFTER,
        };
        // The length fits: no list has more than some thousand items.
        let again = now + after + AGAIN_PER_ITEM * length as u32;
        self.due[list] = (!self.has_id(kind)).then_some(again);
    }

    /// Handles a frame of the autopilot while an order about the lists is carried out: answers belong to the order.
    pub fn watch(&mut self, frame: &Frame, now: Duration, out: &mut Vec<MavMessage>) {
        if let Content::Message(message) = &frame.content {
            self.look_for_changes(message, now, out);
        }
    }

    /// Handles a frame of the autopilot.
    pub fn receive(
        &mut self,
        vehicle: &mut Vehicle,
        frame: &Frame,
        now: Duration,
        out: &mut Vec<MavMessage>,
    ) {
        if let Some((kind, answer)) = wire::answer(frame, vehicle.station) {
            self.answered(vehicle, kind, answer, now, out);
        } else if let Some(kind) = wire::others_upload(frame) {
            self.changed(kind, now, out);
        } else if let Content::Message(message) = &frame.content {
            self.look_for_changes(message, now, out);
        }
    }

    /// Starts downloads that are due, and repeats requests.
    pub fn poll(&mut self, vehicle: &mut Vehicle, now: Duration, out: &mut Vec<MavMessage>) {
        if self.only_follows {
            return;
        }
        let heard_at = *self.heard_at.get_or_insert(now);
        let lead = STAGGER * (u32::from(vehicle.system) % STAGGER_GROUPS);
        if now < heard_at + AFTER_FIRST_HEARD + lead {
            return;
        }
        self.look_at_capabilities(vehicle, now.saturating_sub(heard_at), now);
        if self.download.is_none() {
            self.begin_what_is_due(vehicle, now);
        }
        if let Some(download) = &mut self.download {
            let round_trip = vehicle.link.round_trip.unwrap_or_default();
            let step = download.poll(round_trip, now, out);
            self.note(vehicle, step, now);
        }
    }

    fn look_at_capabilities(&mut self, vehicle: &mut Vehicle, known_for: Duration, now: Duration) {
        if self.knows_capabilities {
            return;
        }
        let Some(version) = vehicle.version else {
            let plan = ListKind::Plan as usize;
            if known_for >= CAPABILITIES_WITHIN && self.is_fresh(plan) {
                self.due[plan] = Some(now);
            }
            return;
        };
        self.knows_capabilities = true;
        for kind in ListKind::ALL {
            let wanted = match kind {
                ListKind::Plan => MISSION_FLOAT | MISSION_INT,
                ListKind::Fence => MISSION_FENCE,
                ListKind::Rally => MISSION_RALLY,
            };
            if !self.is_fresh(kind as usize) {
                continue;
            }
            if version.capabilities & wanted == 0 {
                self.refused[kind as usize] = true;
                *transfer(vehicle, kind) = Transfer::Unsupported;
            } else {
                self.due[kind as usize] = Some(now);
            }
        }
    }

    /// Whether a list has never been requested, and is neither due nor being read.
    fn is_fresh(&self, list: usize) -> bool {
        let is_coming = |download: &Download| download.kind as usize == list;
        self.due[list].is_none()
            && !self.refused[list]
            && self.read_at[list].is_none()
            && self.failures[list] == 0
            && !self.download.as_ref().is_some_and(is_coming)
    }

    fn begin_what_is_due(&mut self, vehicle: &Vehicle, now: Duration) {
        let is_due = |kind: &ListKind| self.due[*kind as usize].is_some_and(|due| now >= due);
        let Some(kind) = ListKind::ALL.into_iter().find(is_due) else {
            return;
        };
        self.due[kind as usize] = None;
        let knows_int = vehicle
            .version
            .map(|version| version.capabilities & MISSION_INT != 0);
        self.download = Some(Download::new(kind, vehicle.address(), knows_int));
    }

    fn answered(
        &mut self,
        vehicle: &mut Vehicle,
        kind: ListKind,
        answer: Answer,
        now: Duration,
        out: &mut Vec<MavMessage>,
    ) {
        let is_other = |it: &Download| it.kind != kind;
        if self.only_follows
            && matches!(answer, Answer::Count(_))
            && self.download.as_ref().is_none_or(is_other)
        {
            self.download = Some(Download::new(kind, vehicle.address(), Some(true)));
        }
        if let Some(download) = &mut self.download
            && download.kind == kind
        {
            let step = download.receive(answer, now, out);
            self.note(vehicle, step, now);
        }
    }

    /// Notes the state of the download, and ends it if it is over.
    fn note(&mut self, vehicle: &mut Vehicle, step: Step, now: Duration) {
        let Some(download) = self.download.take() else {
            return;
        };
        let kind = download.kind;
        let list = kind as usize;
        let result = match step {
            Step::Going => {
                let coming = download.transfer();
                self.download = Some(download);
                coming
            }
            Step::Done(items) => {
                self.is_read(kind, items.len(), now);
                self.acknowledged[list].get_or_insert_with(|| items.clone());
                store(vehicle, kind, items);
                Transfer::Done
            }
            Step::Unsupported => {
                self.refused[list] = true;
                self.due[list] = None;
                Transfer::Unsupported
            }
            Step::Failed => {
                let wait = AFTER_FAILURE.get(self.failures[list]);
                self.failures[list] += 1;
                // A sign of a change may have arrived in the meantime, and takes precedence.
                self.due[list] = self.due[list].or(wait.map(|wait| now + *wait));
                Transfer::Failed
            }
        };
        *transfer(vehicle, kind) = result;
    }

    fn look_for_changes(&mut self, message: &MavMessage, now: Duration, out: &mut Vec<MavMessage>) {
        match message {
            MavMessage::MISSION_CURRENT(data) => self.compare(data, now, out),
            MavMessage::STATUSTEXT(data) => {
                let said = |(text, _): &&(&[u8], ListKind)| data.text.starts_with(text);
                if let Some(&(_, kind)) = UPLOAD_TEXTS.iter().find(said) {
                    self.changed(kind, now, out);
                }
            }
            MavMessage::PARAM_VALUE(data) if data.param_index == NO_INDEX => {
                let name = data.param_id.split(|&byte| byte == 0).next();
                let named = |(known, _): &&(&[u8], ListKind)| name == Some(*known);
                if let Some(&(_, kind)) = UPLOAD_PARAMETERS.iter().find(named) {
                    self.changed(kind, now, out);
                }
            }
            _ => {}
        }
    }

    /// Whether `MISSION_CURRENT` has an id of the list, which reveals every change.
    fn has_id(&self, kind: ListKind) -> bool {
        let id = self.announced.map(|announced| announced[1 + kind as usize]);
        id.is_some_and(|id| id != 0)
    }

    /// Compares the counts and ids of the lists with the last ones announced. The first
    /// announcement changes nothing, since the lists are read anyway.
    fn compare(&mut self, data: &MISSION_CURRENT_DATA, now: Duration, out: &mut Vec<MavMessage>) {
        let [total, plan, fence, rally] = [
            u32::from(data.total),
            data.mission_id,
            data.fence_id,
            data.rally_points_id,
        ];
        let Some(before) = self.announced.replace([total, plan, fence, rally]) else {
            return;
        };
        for (kind, differs) in [
            (ListKind::Plan, [total, plan] != before[..2]),
            (ListKind::Fence, fence != before[2]),
            (ListKind::Rally, rally != before[3]),
        ] {
            if differs {
                self.changed(kind, now, out);
            }
        }
    }

    /// Handles a changed list. It is read again once the upload has settled, if it was requested at all; a download
    /// under way belongs to the old list.
    fn changed(&mut self, kind: ListKind, now: Duration, out: &mut Vec<MavMessage>) {
        let list = kind as usize;
        if self.refused[list] || self.is_fresh(list) {
            return;
        }
        let settled = now + SETTLED_AFTER;
        let earliest = self.read_at[list].map_or(settled, |read| read + NOT_AGAIN_WITHIN);
        self.due[list] = Some(settled.max(earliest));
        self.failures[list] = 0;
        if let Some(download) = self.download.take_if(|download| download.kind == kind) {
            download.cancel(out);
        }
    }
}

fn transfer(vehicle: &mut Vehicle, kind: ListKind) -> &mut Transfer {
    match kind {
        ListKind::Plan => &mut vehicle.plans.plan.transfer,
        ListKind::Fence => &mut vehicle.plans.fence.transfer,
        ListKind::Rally => &mut vehicle.plans.rally.transfer,
    }
}

fn store(vehicle: &mut Vehicle, kind: ListKind, items: Vec<Item>) {
    // Item 0 of `ArduPilot` is home.
    let home_first = vehicle
        .heartbeat
        .is_some_and(|heartbeat| heartbeat.is_ardupilot());
    let plans = &mut vehicle.plans;
    match kind {
        ListKind::Plan => {
            // The number that the vehicle has reported is older than the list.
            let last = u16::try_from(items.len().saturating_sub(1)).ok();
            vehicle.plan.total = vehicle.plan.total.and(last);
            plans.plan.content = Some(Arc::new(Plan { items, home_first }));
        }
        ListKind::Fence => plans.fence.content = Some(Arc::new(FencePlan::from_items(items))),
        ListKind::Rally => plans.rally.content = Some(Arc::new(RallyPlan::from_items(items))),
    }
}
