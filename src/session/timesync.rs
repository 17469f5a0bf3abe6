//! Round-trip time by TIMESYNC, and answers to the vehicle's own requests.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{MavMessage, TIMESYNC_DATA};

use crate::wire::{MavAddress, Outgoing, SystemId};

/// The time between measurements.
const EVERY: Duration = Duration::from_secs(5);

/// Measures the round trip to a vehicle.
#[derive(Debug, Clone, Default)]
pub(super) struct Timesync {
    asked_at: Option<Duration>,
}

impl Timesync {
    /// A request, if due.
    pub fn poll(&mut self, vehicle: MavAddress, now: Duration) -> Option<Outgoing> {
        if self.asked_at.is_some_and(|asked| now < asked + EVERY) {
            return None;
        }
        self.asked_at = Some(now);
        Some(message(0, nanoseconds(now), vehicle))
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
        let ours = self
            .asked_at
            .filter(|&asked| nanoseconds(asked) == sync.ts1);
        (None, ours.map(|asked| now.saturating_sub(asked)))
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
