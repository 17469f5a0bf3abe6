//! The download of a vehicle's parameters: the list is requested once, and missing values are
//! requested by index, a few at a time, until all have arrived.

use std::collections::BTreeMap;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::{
    MavMessage, PARAM_REQUEST_LIST_DATA, PARAM_REQUEST_READ_DATA,
};

use crate::messages::Inbox;
use crate::parameters::{Fetching, ParameterList};
use crate::vehicle::Vehicle;
use crate::wire::Outgoing;

/// Values requested at a time. `ArduPilot` queues 20 such requests and answers some every 100 ms; a slow radio must
/// not be filled with requests.
const AT_ONCE: usize = 10;
/// The list counts as ended after this long without a new value.
const LIST_SILENCE: Duration = Duration::from_secs(1);
/// A request for one value counts as lost after this long; `ArduPilot` takes up to 104 ms.
const PLACE_SILENCE: Duration = Duration::from_millis(400);
/// Each fruitless request doubles the next wait, up to this factor.
const LONGEST_WAIT: u32 = 8;
/// After this many fruitless requests, the download is abandoned.
const FRUITLESS: u16 = 24;
/// The cost of one missing value, with ten requested at a time and some requests lost. If the whole list is faster, it
/// is requested again.
const PLACE_COST: Duration = Duration::from_millis(30);
/// After this many lists with many losses, only single values are requested.
const LISTS: u8 = 4;
/// The maximum number of times that a list is read again because the number of parameters has
/// changed.
const RESTARTS: u8 = 3;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum DownloadPhase {
    Idle,
    /// The first list is not requested yet.
    Asking,
    Listing,
    Filling,
    Complete,
    Stalled,
}

/// The download of one vehicle's list.
#[derive(Debug, Clone)]
pub(super) struct Download {
    phase: DownloadPhase,
    /// The time of the last new value, or of the last fruitless request.
    quiet_since: Duration,
    /// The number of values received at the last check.
    received: u16,
    /// The number of list values seen by that check, including known ones.
    passed: u64,
    count: Option<u16>,
    /// The requested indices, with their time.
    asked: BTreeMap<u16, Duration>,
    /// Where to search for the next missing index, so that an index without an answer does not
    /// block the others.
    next: u16,
    fruitless: u16,
    /// The number of lists that brought new values.
    lists: u8,
    /// When the list was last requested, and how long it took.
    listed_at: Duration,
    list_took: Duration,
    restarts: u8,
}

impl Download {
    /// A download that has not started.
    pub fn new() -> Self {
        Self {
            phase: DownloadPhase::Idle,
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

    /// Downloads all parameters, even known ones; a download under way continues.
    pub fn begin(&mut self, inbox: &mut Inbox) {
        if !self.fetching().is_under_way() {
            *self = Self {
                phase: DownloadPhase::Asking,
                restarts: self.restarts,
                ..Self::new()
            };
            inbox.expect_parameters_again();
        }
    }

    /// Handles a reboot: the vehicle may have other values or other parameters. An earlier request is repeated.
    pub fn begin_anew(&mut self, inbox: &mut Inbox) {
        inbox.forget_parameters();
        if self.phase != DownloadPhase::Idle {
            *self = Self {
                phase: DownloadPhase::Asking,
                ..Self::new()
            };
        }
    }

    pub fn fetching(&self) -> Fetching {
        match self.phase {
            DownloadPhase::Idle => Fetching::NotAsked,
            DownloadPhase::Asking | DownloadPhase::Listing | DownloadPhase::Filling => {
                Fetching::UnderWay {
                    fruitless: self.fruitless,
                }
            }
            DownloadPhase::Complete => Fetching::Complete,
            DownloadPhase::Stalled => Fetching::Stalled,
        }
    }

    /// Handles the return of the link or the vehicle: earlier requests will not be answered, and time-outs start
    /// again.
    pub fn resume(&mut self, now: Duration) {
        self.asked.clear();
        self.fruitless = 0;
        self.quiet_since = now;
        if self.phase == DownloadPhase::Stalled {
            self.phase = DownloadPhase::Filling;
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
        if self.phase == DownloadPhase::Asking {
            self.quiet_since = now;
            return self.list(vehicle, now);
        }
        self.take_note(parameters, now);
        if parameters.is_complete() {
            self.phase = DownloadPhase::Complete;
            return Vec::new();
        }
        let is_quiet = now >= self.quiet_since + self.wait(vehicle);
        if is_quiet {
            self.note_silence(now);
        }
        if self.fruitless > FRUITLESS {
            self.phase = DownloadPhase::Stalled;
            Vec::new()
        } else if self.phase == DownloadPhase::Listing && !is_quiet {
            Vec::new()
        } else if self.asked.is_empty() && self.is_better_listed(parameters) {
            self.list(vehicle, now)
        } else {
            self.phase = DownloadPhase::Filling;
            self.fill(parameters, vehicle, now)
        }
    }

    /// Whether the list must be read again because the number of parameters has changed.
    fn is_to_restart(&self, parameters: &ParameterList) -> bool {
        let is_stale = parameters.is_outdated() || !parameters.is_complete();
        self.phase == DownloadPhase::Complete && is_stale && self.restarts < RESTARTS
    }

    fn take_note(&mut self, parameters: &ParameterList, now: Duration) {
        if self.count != parameters.count() {
            self.asked.clear();
            self.count = parameters.count();
            self.received = 0;
        }
        let is_news = parameters.received() > self.received;
        // A repeated list starts with known values, which must not count as silence.
        let is_coming = self.phase == DownloadPhase::Listing && parameters.passed() != self.passed;
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
        if self.phase == DownloadPhase::Listing {
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
        // A list that has not begun is requested again as long as the limits allow.
        parameters.received() == 0 || (self.lists < LISTS && PLACE_COST * missing > again)
    }

    /// How long to wait for a new value; longer after fruitless requests and on slow links.
    fn wait(&self, vehicle: &Vehicle) -> Duration {
        let silence = match self.phase {
            DownloadPhase::Filling => PLACE_SILENCE,
            DownloadPhase::Idle
            | DownloadPhase::Asking
            | DownloadPhase::Listing
            | DownloadPhase::Complete
            | DownloadPhase::Stalled => LIST_SILENCE,
        };
        silence.max(round_trip(vehicle) * 3 / 2) * self.patience()
    }

    /// When to repeat a request for a value. On a slow link, this is before the answer can arrive: a second request
    /// costs less than waiting for a lost one.
    fn asked_again_after(&self, vehicle: &Vehicle) -> Duration {
        PLACE_SILENCE.max(round_trip(vehicle) / 2) * self.patience()
    }

    fn patience(&self) -> u32 {
        (1 << (self.fruitless / 2).min(8)).min(LONGEST_WAIT)
    }

    fn list(&mut self, vehicle: &Vehicle, now: Duration) -> Vec<Outgoing> {
        self.phase = DownloadPhase::Listing;
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
        // Answered indices are no longer missing; lost ones are requested again.
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

fn read(vehicle: &Vehicle, index: u16) -> Outgoing {
    MavMessage::PARAM_REQUEST_READ(PARAM_REQUEST_READ_DATA {
        param_index: index as i16,
        target_system: vehicle.system,
        target_component: vehicle.component,
        param_id: [0; 16].into(),
    })
    .into()
}
