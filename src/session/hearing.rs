//! The reception of a vehicle: the share of its messages that arrive, and its silence.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{MavAutopilot, MavMessage, MavType};

use crate::alert::AlertKind;
use crate::notice::Notice;
use crate::text;
use crate::vehicle::{Severity, Vehicle};
use crate::wire::{ComponentId, Content, Frame, LossMeter};

/// A vehicle counts as lost this long after the last verified frame of its autopilot, of any kind. The screen must
/// show it within 3 s.
pub const LOST_AFTER: Duration = Duration::from_millis(2500);

const TYPE_GROUND_STATION: u8 = MavType::MAV_TYPE_GCS as u8;
/// The autopilot type of a component without an autopilot.
const AUTOPILOT_NONE: u8 = MavAutopilot::MAV_AUTOPILOT_INVALID as u8;

/// The autopilot's component id, if the frame is a heartbeat of a vehicle.
pub fn autopilot_of(frame: &Frame) -> Option<ComponentId> {
    let (mav_type, autopilot) = match &frame.content {
        Content::Message(MavMessage::HEARTBEAT(beat)) => (beat.mavtype as u8, beat.autopilot as u8),
        // Unknown types and autopilots are still at their fixed positions.
        Content::Undecoded { id: 0, payload } => (payload[4], payload[5]),
        Content::Message(_) | Content::Undecoded { .. } | Content::Unknown { .. } => return None,
    };
    (mav_type != TYPE_GROUND_STATION && autopilot != AUTOPILOT_NONE && frame.system != 0)
        .then_some(frame.component)
}

/// Monitors the messages of one vehicle.
#[derive(Debug, Clone, Default)]
pub(super) struct Hearing {
    loss: LossMeter,
}

impl Hearing {
    /// Counts a frame of the vehicle's autopilot; returns a notice if the vehicle was lost before.
    pub fn hear(&mut self, frame: &Frame, vehicle: &mut Vehicle, now: Duration) -> Option<Notice> {
        self.loss.note(frame);
        if !frame.is_verified() {
            return None;
        }
        let link = &mut vehicle.link;
        link.received += 1;
        link.missing = self.loss.lost();
        let silent_since = link.last_heard.replace(now);
        if !std::mem::take(&mut link.lost) {
            return None;
        }
        let gap = now.saturating_sub(silent_since.unwrap_or(now));
        let seconds = format!("{:.1}", gap.as_secs_f64());
        let text = text!("heard-link-back", seconds = seconds);
        Some(Notice::about(vehicle.id, now, Severity::Notice, text))
    }
}

/// Returns a notice if the vehicle has just become silent for too long.
pub(super) fn watch_silence(vehicle: &mut Vehicle, now: Duration) -> Option<Notice> {
    let link = &mut vehicle.link;
    let silent = link
        .last_heard
        .is_some_and(|heard| now.saturating_sub(heard) >= LOST_AFTER);
    if !silent || std::mem::replace(&mut link.lost, true) {
        return None;
    }
    let text = text!("heard-link-lost");
    Some(Notice {
        kind: Some(AlertKind::LinkLost),
        ..Notice::about(vehicle.id, now, Severity::Critical, text)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn silence_is_told_as_a_lost_link() {
        let mut vehicle = Vehicle::new(1, 1);
        vehicle.link.last_heard = Some(Duration::ZERO);
        let notice = watch_silence(&mut vehicle, LOST_AFTER).expect("a notice");
        assert_eq!(notice.kind, Some(AlertKind::LinkLost));
        assert_eq!(watch_silence(&mut vehicle, LOST_AFTER), None);
    }
}
