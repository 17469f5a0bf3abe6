//! Reads the list of a vehicle's logs.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::{LOG_ENTRY_DATA, LOG_REQUEST_LIST_DATA, MavMessage};

use super::ListedLog;
use crate::wire::{MavAddress, Outgoing};

/// If nothing new arrives for this long, the list or its missing part is requested again.
const SILENCE: Duration = Duration::from_secs(1);
/// After this many requests that bring nothing new, the vehicle counts as having stopped sending.
const FRUITLESS: u8 = 20;

/// The reading of a list.
#[derive(Debug, Clone)]
pub(super) struct Listing {
    entries: BTreeMap<u16, ListedLog>,
    /// The number of logs and the highest log number, once the vehicle has announced them.
    announced: Option<(u16, u16)>,
    /// The time of the last request or of the last new entry; `None` before the first request.
    heard_at: Option<Duration>,
    fruitless: u8,
}

impl Listing {
    pub fn new() -> Self {
        Self {
            entries: BTreeMap::new(),
            announced: None,
            heard_at: None,
            fruitless: 0,
        }
    }

    /// Adds an entry of the list that the vehicle sends.
    pub fn receive(&mut self, entry: &LOG_ENTRY_DATA, now: Duration) {
        let highest = self.announced.map_or(0, |(_, highest)| highest);
        // An answer to a repeated request has a smaller last number.
        self.announced = Some((entry.num_logs, entry.last_log_num.max(highest)));
        let log = ListedLog {
            number: entry.id,
            size: entry.size,
            time_utc_s: entry.time_utc,
        };
        if entry.num_logs > 0 && self.entries.insert(entry.id, log).is_none() {
            self.heard_at = Some(now);
            self.fruitless = 0;
        }
    }

    /// All logs, if all are known.
    pub fn complete(&self) -> Option<Vec<ListedLog>> {
        let numbers = self.numbers()?;
        let missing = numbers.clone().find(|it| !self.entries.contains_key(it));
        let logs = || numbers.filter_map(|it| self.entries.get(&it).copied());
        missing.is_none().then(|| logs().collect())
    }

    /// Whether the vehicle has stopped sending new entries.
    pub fn is_stalled(&self) -> bool {
        self.fruitless > FRUITLESS
    }

    /// The request that is due.
    pub fn poll(&mut self, vehicle: MavAddress, now: Duration) -> Option<Outgoing> {
        let is_due = self.heard_at.is_none_or(|heard| now >= heard + SILENCE);
        if !is_due {
            return None;
        }
        self.heard_at = Some(now);
        self.fruitless += 1;
        let (start, end) = match self.numbers() {
            Some(numbers) => {
                let lacks = |it: &u16| !self.entries.contains_key(it);
                let mut missing = numbers.clone().skip_while(|it| !lacks(it));
                let start = missing.next().unwrap_or(0);
                let end = missing.take_while(lacks).last();
                (start, end.unwrap_or(start))
            }
            None => (0, u16::MAX),
        };
        let request = MavMessage::LOG_REQUEST_LIST(LOG_REQUEST_LIST_DATA {
            start,
            end,
            target_system: vehicle.system,
            target_component: vehicle.component,
        });
        Some(request.into())
    }

    /// The numbers of all logs, once announced: `ArduPilot` counts from 1, PX4 from 0.
    fn numbers(&self) -> Option<RangeInclusive<u16>> {
        let (count, highest) = self.announced?;
        if count == 0 {
            #[expect(clippy::reversed_empty_ranges, reason = "there are none")]
            return Some(1..=0);
        }
        Some(highest.saturating_sub(count - 1)..=highest)
    }
}
