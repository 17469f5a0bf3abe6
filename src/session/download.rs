//! The download of a vehicle's parameters: the list is asked for once, and what did not come is asked for by its
//! place, a few at a time, until all is there.

use std::collections::BTreeMap;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::{
    MavMessage, PARAM_REQUEST_LIST_DATA, PARAM_REQUEST_READ_DATA,
};

use crate::messages::Inbox;
use crate::parameters::{Fetching, ParameterList};
use crate::vehicle::Vehicle;
use crate::wire::Outgoing;

/// Places that are asked for at one time. `ArduPilot` keeps 20 such requests and answers some every 100 ms; a slow
/// radio must not be filled with our questions.
const AT_ONCE: usize = 10;
/// The list has ended if nothing new has come for this long.
const LIST_SILENCE: Duration = Duration::from_secs(1);
/// A question for one place was lost if it is not answered for this long; `ArduPilot` takes up to 104 ms.
const PLACE_SILENCE: Duration = Duration::from_millis(400);
/// Fruitless requests make the next one wait twice as long, but not longer than this many times.
const LONGEST_WAIT: u32 = 8;
/// So many requests without any news mean that nothing more will come.
const FRUITLESS: u16 = 24;
/// What one missing place costs, with ten asked for at a time and some of the questions lost. Where the list as a
/// whole would come sooner, it is asked for again.
const PLACE_COST: Duration = Duration::from_millis(30);
/// After so many lists of which much was lost, places are asked for.
const LISTS: u8 = 4;
/// A vehicle whose number of parameters changes is read anew, but not for ever.
const RESTARTS: u8 = 3;

/// What a download is waiting for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Phase {
    Idle,
    /// The first list has to be requested yet.
    Asking,
    Listing,
    Filling,
    Complete,
    Stalled,
}

/// The download of one vehicle's list.
#[derive(Debug, Clone)]
pub(super) struct Download {
    phase: Phase,
    /// Since when nothing new has come, or since when that was found out last.
    quiet_since: Duration,
    /// How many places had come when we looked last.
    received: u16,
    /// How many values of the list had passed by then, those that were known included.
    passed: u64,
    /// The numbering of the list that is being filled.
    count: Option<u16>,
    /// The places that are asked for, and when.
    asked: BTreeMap<u16, Duration>,
    /// Where to look for the next missing place: one that is never answered must not hold up the others.
    next: u16,
    fruitless: u16,
    /// How many lists have brought anything.
    lists: u8,
    /// When the list was asked for last, and how long it went on coming then.
    listed_at: Duration,
    list_took: Duration,
    restarts: u8,
}

impl Download {
    /// One that was not requested yet.
    pub fn new() -> Self {
        Self {
            phase: Phase::Idle,
            quiet_since: Duration::ZERO,
            received: 0,
            passed: 0,
            count: None,
            asked: BTreeMap::new(),
            next: 0,
            fruitless: 0,
            lists: 0,
            listed_at: Duration::ZERO,
            list_took: Duration::ZERO,
            restarts: 0,
        }
    }

    /// Asks for all parameters, also for those that have come before; one that is under way goes on as it is.
    pub fn begin(&mut self, inbox: &mut Inbox) {
        if !self.fetching().is_under_way() {
            *self = Self {
                phase: Phase::Asking,
                restarts: self.restarts,
                ..Self::new()
            };
            inbox.expect_parameters_again();
        }
    }

    /// The vehicle has booted and may have other values than before, or other parameters: what was known of them says
    /// nothing any more. If they had been asked for, they are again.
    pub fn begin_anew(&mut self, inbox: &mut Inbox) {
        inbox.forget_parameters();
        if self.phase != Phase::Idle {
            *self = Self {
                phase: Phase::Asking,
                ..Self::new()
            };
        }
    }

    /// How far it is.
    pub fn fetching(&self) -> Fetching {
        match self.phase {
            Phase::Idle => Fetching::NotAsked,
            Phase::Asking | Phase::Listing | Phase::Filling => Fetching::UnderWay {
                fruitless: self.fruitless,
            },
            Phase::Complete => Fetching::Complete,
            Phase::Stalled => Fetching::Stalled,
        }
    }

    /// The link or the vehicle has come back: what was asked before will not be answered, and patience begins anew.
    pub fn resume(&mut self, now: Duration) {
        self.asked.clear();
        self.fruitless = 0;
        self.quiet_since = now;
        if self.phase == Phase::Stalled {
            self.phase = Phase::Filling;
        }
    }

    /// The requests that are due.
    pub fn poll(&mut self, inbox: &mut Inbox, vehicle: &Vehicle, now: Duration) -> Vec<Outgoing> {
        if self.is_to_restart(inbox.parameters()) {
            self.restarts += 1;
            self.begin(inbox);
        }
        let parameters = inbox.parameters();
        if !self.fetching().is_under_way() {
            return Vec::new();
        }
        if self.phase == Phase::Asking {
            self.quiet_since = now;
            return self.list(vehicle, now);
        }
        self.take_note(parameters, now);
        if parameters.is_complete() {
            self.phase = Phase::Complete;
            return Vec::new();
        }
        let is_quiet = now >= self.quiet_since + self.wait(vehicle);
        if is_quiet {
            self.note_silence(now);
        }
        if self.fruitless > FRUITLESS {
            self.phase = Phase::Stalled;
            Vec::new()
        } else if self.phase == Phase::Listing && !is_quiet {
            Vec::new()
        } else if self.asked.is_empty() && self.is_better_listed(parameters) {
            self.list(vehicle, now)
        } else {
            self.phase = Phase::Filling;
            self.fill(parameters, vehicle, now)
        }
    }

    /// Whether the list has to be read anew because the vehicle has another number of parameters by now.
    fn is_to_restart(&self, parameters: &ParameterList) -> bool {
        let is_stale = parameters.is_outdated() || !parameters.is_complete();
        self.phase == Phase::Complete && is_stale && self.restarts < RESTARTS
    }

    fn take_note(&mut self, parameters: &ParameterList, now: Duration) {
        if self.count != parameters.count() {
            self.asked.clear();
            self.count = parameters.count();
            self.received = 0;
        }
        let is_news = parameters.received() > self.received;
        // A list that comes again brings known places first: it must not be cut off for that.
        let is_coming = self.phase == Phase::Listing && parameters.passed() != self.passed;
        if is_news || is_coming {
            self.quiet_since = now;
        }
        if is_news {
            self.fruitless = 0;
        }
        self.received = parameters.received();
        self.passed = parameters.passed();
    }

    fn note_silence(&mut self, now: Duration) {
        if self.phase == Phase::Listing {
            self.list_took = self.quiet_since.saturating_sub(self.listed_at);
            // A request for the list that was lost does not count.
            self.lists += u8::from(self.quiet_since > self.listed_at);
        }
        self.fruitless += 1;
        self.quiet_since = now;
        self.asked.clear();
    }

    fn is_better_listed(&self, parameters: &ParameterList) -> bool {
        let Some(count) = parameters.count() else {
            return true;
        };
        let missing = u32::from(count - parameters.received());
        let again = self.list_took + LIST_SILENCE;
        // A list that has not begun is asked for as long as there is patience.
        parameters.received() == 0 || (self.lists < LISTS && PLACE_COST * missing > again)
    }

    /// How long to wait for anything new; longer the longer there was none, and where the way is long.
    fn wait(&self, vehicle: &Vehicle) -> Duration {
        let silence = match self.phase {
            Phase::Filling => PLACE_SILENCE,
            Phase::Idle | Phase::Asking | Phase::Listing | Phase::Complete | Phase::Stalled => {
                LIST_SILENCE
            }
        };
        silence.max(round_trip(vehicle) * 3 / 2) * self.patience()
    }

    /// When a place is asked for again. On a long way that is before the answer can have come: a second question costs
    /// less than the wait for one that was lost.
    fn asked_again_after(&self, vehicle: &Vehicle) -> Duration {
        PLACE_SILENCE.max(round_trip(vehicle) / 2) * self.patience()
    }

    fn patience(&self) -> u32 {
        (1 << (self.fruitless / 2).min(8)).min(LONGEST_WAIT)
    }

    fn list(&mut self, vehicle: &Vehicle, now: Duration) -> Vec<Outgoing> {
        self.phase = Phase::Listing;
        self.listed_at = now;
        let request = MavMessage::PARAM_REQUEST_LIST(PARAM_REQUEST_LIST_DATA {
            target_system: vehicle.system,
            target_component: vehicle.component,
        });
        vec![request.into()]
    }

    fn fill(
        &mut self,
        parameters: &ParameterList,
        vehicle: &Vehicle,
        now: Duration,
    ) -> Vec<Outgoing> {
        let wait = self.asked_again_after(vehicle);
        let missing: Vec<u16> = parameters.missing().collect();
        // What was answered is not missing any more; what was lost is asked for again.
        self.asked
            .retain(|index, at| missing.binary_search(index).is_ok() && now < *at + wait);
        let from = missing.partition_point(|&index| index < self.next);
        let round = missing[from..].iter().chain(&missing[..from]).copied();
        let free = AT_ONCE - self.asked.len();
        let due: Vec<u16> = round
            .filter(|index| !self.asked.contains_key(index))
            .take(free)
            .collect();
        for &index in &due {
            self.asked.insert(index, now);
            self.next = index.saturating_add(1);
        }
        due.into_iter().map(|index| read(vehicle, index)).collect()
    }
}

fn round_trip(vehicle: &Vehicle) -> Duration {
    vehicle.link.round_trip.unwrap_or_default()
}

/// Asks for a parameter by its place in the list.
fn read(vehicle: &Vehicle, index: u16) -> Outgoing {
    MavMessage::PARAM_REQUEST_READ(PARAM_REQUEST_READ_DATA {
        param_index: index as i16,
        target_system: vehicle.system,
        target_component: vehicle.component,
        param_id: [0; 16].into(),
    })
    .into()
}
