//! Examines the links: for the doctor once a second, and for the messages room up to four times a second.

use std::collections::BTreeSet;
use std::time::Duration;

use tokio::sync::watch;

use crate::app::event::{Event, LinkEvent};
use crate::app::room::messages::{LinkTraffic, TrafficRequest};
use crate::doctor::{Chart, Way, diagnose};
use crate::inspector::TallyKey;
use crate::link::{LinkStatus, Tap};
use crate::vehicle_id::VehicleId;

const EXAMINE_EVERY: Duration = Duration::from_secs(1);
/// The time between counts of the messages.
const LOOK_EVERY: Duration = Duration::from_millis(250);
/// The time between counts if there are more than [`MANY`] kinds of messages.
const LOOK_AT_MANY_EVERY: Duration = Duration::from_secs(1);
const MANY: usize = 4000;

/// Examines the links of a session, through a tap on each.
#[derive(Default)]
pub(super) struct Inspection {
    taps: Vec<Tap>,
    charts: Vec<Chart>,
    next_exam: Duration,
    next_look: Duration,
    watched: BTreeSet<(usize, TallyKey)>,
}

impl Inspection {
    /// Adds a link that was opened.
    pub fn add(&mut self, status: &watch::Receiver<LinkStatus>, tap: Tap) {
        self.charts
            .push(Chart::new(Way::of(&status.borrow().name.to_string())));
        self.taps.push(tap);
    }

    /// Notes a pause, during which no message could arrive; the doctor then waits until messages
    /// can arrive again.
    pub fn rest(&mut self, now: Duration) {
        self.next_exam = now + EXAMINE_EVERY;
    }

    /// The doctor's findings, if due. `expected` are the vehicles of the swarm; empty if any vehicle is.
    pub fn examine(
        &mut self,
        links: &[watch::Receiver<LinkStatus>],
        expected: &BTreeSet<VehicleId>,
        now: Duration,
    ) -> Option<Event> {
        if now < self.next_exam {
            return None;
        }
        self.next_exam = now + EXAMINE_EVERY;
        for ((tap, link), chart) in self.taps.iter().zip(links).zip(&mut self.charts) {
            let status = link.borrow().clone();
            chart.note(tap.observe(&status), now);
        }
        Some(LinkEvent::Findings(diagnose(&self.charts, expected)).into())
    }

    /// A count of the messages, if due.
    pub fn look(
        &mut self,
        links: &[watch::Receiver<LinkStatus>],
        request: &TrafficRequest,
        now: Duration,
    ) -> Option<Event> {
        if now < self.next_look {
            return None;
        }
        self.watch(&request.watched);
        let looks = self.taps.iter().zip(links).map(|(tap, link)| {
            let name = link.borrow().name.clone();
            tap.look(|census, now| {
                census.reset_statistics(request.resets, now);
                LinkTraffic {
                    name,
                    now,
                    census: request.census.then(|| census.snapshot()),
                    watched: census.take_watched(),
                }
            })
        });
        let traffic: Vec<LinkTraffic> = looks.collect();
        let censuses = traffic.iter().filter_map(|link| link.census.as_ref());
        let kinds: usize = censuses.map(|census| census.tallies().count()).sum();
        self.next_look = now
            + if kinds > MANY {
                LOOK_AT_MANY_EVERY
            } else {
                LOOK_EVERY
            };
        Some(LinkEvent::Traffic(traffic).into())
    }

    /// Keeps every frame of these kinds, and of no others.
    fn watch(&mut self, watched: &BTreeSet<(usize, TallyKey)>) {
        if self.watched == *watched {
            return;
        }
        for (link, tap) in self.taps.iter().enumerate() {
            let mine = watched.iter().filter(|(of, _)| *of == link);
            let keys = mine.map(|(_, key)| *key).collect();
            tap.look(|census, _| census.watch(&keys));
        }
        self.watched.clone_from(watched);
    }
}
