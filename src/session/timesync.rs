//! Round-trip time by TIMESYNC, and answers to the vehicle's own requests.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{MavMessage, TIMESYNC_DATA};

use crate::wire::{MavAddress, Outgoing, SystemId};

/// The time between measurements.
const EVERY: Duration = Duration::from_secs(5);
/// A vehicle answers every request on its link, whichever vehicle it is for, so that one request serves all vehicles of
/// a link. The system ids decide which session asks: the others are due later, by this for each id.
const APART: Duration = Duration::from_millis(20);

/// Measures the round trip to a vehicle.
#[derive(Debug, Clone, Default)]
pub(super) struct Timesync {
    /// When the latest request was sent that the vehicle is known to answer, by this session or by another one.
    asked_at: Option<Duration>,
    /// When the next request is due.
    due: Option<Duration>,
}

impl Timesync {
    /// A request, if due.
    pub fn poll(&mut self, vehicle: MavAddress, now: Duration) -> Option<Outgoing> {
        let apart = APART * u32::from(vehicle.system);
        if now < *self.due.get_or_insert(now + apart) {
            return None;
        }
        self.ask_after(now, vehicle.system);
        Some(message(0, nanoseconds(now), vehicle))
    }

    fn ask_after(&mut self, asked_at: Duration, system: SystemId) {
        self.asked_at = Some(asked_at);
        self.due = Some(asked_at + EVERY + APART * u32::from(system));
    }

    /// Handles a message: returns a reply to the vehicle's request, or the round trip from its answer.
    pub fn receive(
        &mut self,
        message_in: &MavMessage,
        system: SystemId,
        now: Duration,
    ) -> (Option<Outgoing>, Option<Duration>) {
        let MavMessage::TIMESYNC(sync) = message_in else {
            return (None, None);
        };
        if sync.tc1 == 0 {
            // Zero would be another request, so the clock's first nanosecond is left out.
            let reply = message(
                nanoseconds(now).max(1),
                sync.ts1,
                MavAddress {
                    system,
                    component: 0,
                },
            );
            return (Some(reply), None);
        }
        let round_trip = self.round_trip(sync.ts1, now);
        if let Some(round_trip) = round_trip {
            self.ask_after(now.saturating_sub(round_trip), system);
        }
        (None, round_trip)
    }

    /// The time since a request, which may be that of another session; `None` if a newer one was sent, or if the
    /// request is of another clock.
    fn round_trip(&self, asked_ns: i64, now: Duration) -> Option<Duration> {
        let asked_at = Duration::from_nanos(u64::try_from(asked_ns).ok()?);
        let is_latest = self.asked_at <= Some(asked_at);
        now.checked_sub(asked_at)
            .filter(|age| is_latest && *age < EVERY)
    }
}

fn message(tc1: i64, ts1: i64, to: MavAddress) -> Outgoing {
    MavMessage::TIMESYNC(TIMESYNC_DATA {
        tc1,
        ts1,
        target_system: to.system,
        target_component: to.component,
    })
    .into()
}

fn nanoseconds(time: Duration) -> i64 {
    i64::try_from(time.as_nanos()).unwrap_or(i64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sessions whose vehicles share a link with a round trip of `delay`, and the requests sent in
    /// a minute. Every vehicle answers every request.
    fn requests_in_a_minute(vehicles: u8, delay: Duration) -> usize {
        let mut sessions: Vec<Timesync> = vec![Timesync::default(); usize::from(vehicles)];
        let mut answers: Vec<(Duration, MavMessage)> = Vec::new();
        let mut requests = 0;
        for now in (0..60_000).step_by(10).map(Duration::from_millis) {
            answers.retain(|(due, answer)| {
                if *due > now {
                    return true;
                }
                for (session, system) in sessions.iter_mut().zip(1..) {
                    let (_, round_trip) = session.receive(answer, system, now);
                    assert!(round_trip.is_none_or(|it| it >= delay));
                }
                false
            });
            for (session, system) in sessions.iter_mut().zip(1..) {
                let vehicle = MavAddress {
                    system,
                    component: 1,
                };
                if session.poll(vehicle, now).is_some() {
                    requests += 1;
                    let Outgoing::Message(answer) = message(7, nanoseconds(now), vehicle) else {
                        panic!("a message");
                    };
                    answers.push((now + delay, answer));
                }
            }
        }
        requests
    }

    #[test]
    fn one_request_serves_all_vehicles_of_a_link() {
        for (vehicles, delay_ms, most) in [(1, 10, 12), (200, 10, 14), (200, 400, 260)] {
            let requests = requests_in_a_minute(vehicles, Duration::from_millis(delay_ms));
            assert!(requests <= most, "{vehicles} {delay_ms}: {requests}");
            assert!(requests >= 10);
        }
    }

    #[test]
    fn an_answer_to_an_older_request_or_to_another_clock_measures_nothing() {
        let mut session = Timesync::default();
        let vehicle = MavAddress {
            system: 1,
            component: 1,
        };
        let at = Duration::from_secs;
        assert!(session.poll(vehicle, at(100)).is_none());
        assert!(session.poll(vehicle, at(101)).is_some());
        let answer = |asked: Duration| {
            let Outgoing::Message(answer) = message(7, nanoseconds(asked), vehicle) else {
                panic!("a message");
            };
            answer
        };
        for wrong in [at(100), at(102), at(96), Duration::MAX] {
            assert_eq!(session.receive(&answer(wrong), 1, at(101)).1, None);
        }
        let own = session.receive(&answer(at(101)), 1, Duration::from_millis(101_030));
        assert_eq!(own.1, Some(Duration::from_millis(30)));
    }
}
