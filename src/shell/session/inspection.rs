//! Examines the links: for the doctor once a second, and for the messages room up to four times a second.

use std::collections::BTreeSet;
use std::time::Duration;

use tokio::sync::watch;

use crate::app::event::{Event, LinkEvent};
use crate::app::room::messages::{LinkTraffic, TrafficRequest};
use crate::doctor::{Chart, Way, diagnose};
use crate::inspector::TallyKey;
use crate::link::{LinkState, LinkStatus, Tap};
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

    /// The doctor's findings, if due: once a second, and when a link opens or closes. `links` is the status that is
    /// shown beside them, so that both agree on which links are open. `expected` are the vehicles of the swarm; empty if
    /// any vehicle is.
    pub fn examine(
        &mut self,
        links: &[LinkStatus],
        expected: &BTreeSet<VehicleId>,
        now: Duration,
    ) -> Option<Event> {
        let is_due = now >= self.next_exam;
        if is_due {
            self.next_exam = now + EXAMINE_EVERY;
        }
        let mut is_news = is_due;
        for ((tap, status), chart) in self.taps.iter().zip(links).zip(&mut self.charts) {
            // The other links wait: after a pause, their silence means nothing.
            let has_turned = chart.is_up() != Some(status.state == LinkState::Up);
            if is_due || has_turned {
                chart.note(tap.observe(status), now);
            }
            is_news |= has_turned;
        }
        is_news.then(|| LinkEvent::Findings(diagnose(&self.charts, expected)).into())
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

#[cfg(test)]
mod tests {
    use tokio::net::TcpListener;
    use tokio::sync::mpsc;
    use tokio_util::sync::CancellationToken;

    use super::*;
    use crate::doctor::Cause;
    use crate::link::{self, LinkHandle, LinkId, Transport};
    use crate::shell::session::links::SessionLinks;

    /// The links of a session, and what of the first one is on the screen: whether it is up, and whether the doctor says
    /// that it is not open.
    #[derive(Default)]
    struct Shown {
        links: SessionLinks,
        inspection: Inspection,
        is_up: bool,
        is_not_open: bool,
    }

    impl Shown {
        fn add(&mut self, link: &LinkHandle) {
            self.inspection.add(&link.status(), link.tap());
            self.links.add(link.status());
        }

        /// Shows what is new, as a tick of the session does.
        fn tick(&mut self, ms: u64) {
            let summaries = self.links.changed(&[]);
            if let Some(Event::Link(LinkEvent::Summaries(links))) = summaries {
                self.is_up = links[0].up;
            }
            self.examine(ms);
        }

        fn examine(&mut self, ms: u64) {
            let (shown, now) = (self.links.shown(), Duration::from_millis(ms));
            let news = self.inspection.examine(shown, &BTreeSet::new(), now);
            if let Some(Event::Link(LinkEvent::Findings(findings))) = news {
                let mut causes = findings.iter().map(|finding| &finding.cause);
                self.is_not_open = causes.any(|cause| *cause == Cause::NotOpen);
            }
        }
    }

    #[tokio::test]
    async fn a_link_that_is_shown_as_up_is_never_said_to_be_not_open() {
        let listener = TcpListener::bind("127.0.0.1:0").await.expect("a port");
        let port = listener.local_addr().expect("it is bound").port();
        let address = format!("tcp:127.0.0.1:{port}").parse().expect("it is one");
        let (inbound, _frames) = mpsc::channel(8);
        let cancel = CancellationToken::new();
        let link = link::open(
            LinkId(0),
            Transport::Address(address),
            inbound,
            cancel.clone(),
        );
        let mut shown = Shown::default();
        shown.add(&link);
        // The link's task has not run yet.
        shown.tick(0);
        assert_eq!((shown.is_up, shown.is_not_open), (false, true));
        let mut status = link.status();
        let is_up = |status: &LinkStatus| status.state == LinkState::Up;
        status.wait_for(is_up).await.expect("it runs");
        shown.tick(33);
        assert_eq!((shown.is_up, shown.is_not_open), (true, false));
        // It closes between the two parts of a tick.
        drop((listener.accept().await.expect("it connects"), listener));
        let is_down = |status: &LinkStatus| !is_up(status);
        status.wait_for(is_down).await.expect("it runs");
        shown.examine(2000);
        assert_eq!((shown.is_up, shown.is_not_open), (true, false));
        shown.tick(2033);
        assert_eq!((shown.is_up, shown.is_not_open), (false, true));
        cancel.cancel();
    }
}
