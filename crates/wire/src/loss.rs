//! Frames that never arrived.

use std::collections::BTreeMap;

use super::{ComponentId, Frame, SystemId};

/// A step in the numbering that is longer than this leads back: the frame is late, or the sender has restarted.
const LONGEST_GAP: u8 = 127;
/// So many steps back in a row are no reordering but a sender that has begun to count anew.
const RESTART_AFTER: u8 = 8;

/// Counts frames that never arrived, by the gaps in each sender's sequence numbers.
#[derive(Debug, Clone, Default)]
pub struct LossMeter {
    senders: BTreeMap<(SystemId, ComponentId), Numbering>,
    lost: u64,
}

/// What is known of one sender's numbering.
#[derive(Debug, Clone, Copy)]
struct Numbering {
    last: u8,
    lost: u64,
    /// How many frames in a row have stepped back, and how many of them were taken for found again.
    late: u8,
    found: u8,
}

impl Numbering {
    /// How many more frames are missing than before.
    fn step_to(&mut self, sequence: u8) -> i16 {
        match sequence.wrapping_sub(self.last) {
            0 => return 0, // the same frame twice, as UDP may deliver it
            step @ 1..=LONGEST_GAP => {
                (self.late, self.found) = (0, 0);
                self.last = sequence;
                return i16::from(step - 1);
            }
            _ => self.late += 1,
        }
        if self.late == RESTART_AFTER {
            // What seemed to be found were new frames: those that were missing still are.
            let found = std::mem::take(&mut self.found);
            self.late = 0;
            self.last = sequence;
            return i16::from(found);
        }
        if self.lost == 0 {
            return 0;
        }
        self.found += 1;
        -1
    }
}

impl LossMeter {
    /// Takes note of a frame and returns how many more of its sender are missing now: those that a gap left
    /// out, or -1 when one comes late that was counted as lost. A frame of an unknown message may be noise and
    /// makes no sender known.
    pub fn note(&mut self, frame: &Frame) -> i16 {
        let sender = (frame.system, frame.component);
        if !frame.is_verified() && !self.senders.contains_key(&sender) {
            return 0;
        }
        let numbering = self.senders.entry(sender).or_insert(Numbering {
            last: frame.sequence,
            lost: 0,
            late: 0,
            found: 0,
        });
        let change = numbering.step_to(frame.sequence);
        numbering.lost = numbering.lost.saturating_add_signed(change.into());
        self.lost = self.lost.saturating_add_signed(change.into());
        change
    }

    /// Frames lost so far.
    pub fn lost(&self) -> u64 {
        self.lost
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Content;
    use mavlink::MavlinkVersion;
    use mavlink::dialects::ardupilotmega::{HEARTBEAT_DATA, MavMessage};

    fn frame(component: ComponentId, sequence: u8) -> Frame {
        Frame {
            system: 1,
            component,
            sequence,
            version: MavlinkVersion::V2,
            signed: false,
            wire_len: 21,
            content: Content::Message(MavMessage::HEARTBEAT(HEARTBEAT_DATA::default())),
        }
    }

    fn lost(sequences: impl IntoIterator<Item = u32>) -> u64 {
        let mut meter = LossMeter::default();
        let mut sum = 0;
        for sequence in sequences {
            sum += i64::from(meter.note(&frame(1, sequence as u8)));
        }
        assert_eq!(sum, meter.lost() as i64, "the changes add up");
        meter.lost()
    }

    #[test]
    fn gaps_are_counted_per_sender() {
        let mut meter = LossMeter::default();
        for (component, sequence) in [(1, 0), (1, 1), (154, 99), (1, 4)] {
            meter.note(&frame(component, sequence));
        }
        assert_eq!(meter.lost(), 2);
    }

    #[test]
    fn swapped_neighbours_are_not_lost() {
        assert_eq!(lost((0..1000).map(|number| number ^ 1)), 0);
    }

    #[test]
    fn a_late_frame_does_not_excuse_those_that_stay_away() {
        assert_eq!(lost([0, 1, 5, 3, 6, 7]), 2);
        assert_eq!(lost([250, 251, 3, 252, 4]), 6);
    }

    #[test]
    fn a_frame_from_before_the_first_one_leaves_the_count_alone() {
        assert_eq!(lost([5, 4, 6, 7]), 0);
    }

    #[test]
    fn an_unknown_message_fills_its_place_but_makes_no_sender_known() {
        let unknown = |component, sequence| Frame {
            content: Content::Unknown { id: 60_000 },
            ..frame(component, sequence)
        };
        let mut meter = LossMeter::default();
        for frame in [
            frame(1, 0),
            unknown(1, 1),
            frame(1, 2),
            unknown(7, 9),
            frame(7, 20),
        ] {
            assert_eq!(meter.note(&frame), 0, "{frame:?}");
        }
    }

    #[test]
    fn a_sender_that_restarts_costs_no_more_than_a_gap() {
        for stopped_at in 20..256 {
            let before = (0..=stopped_at).filter(|number| *number != 1);
            let counted = lost(before.chain(0..600));
            let gap = if stopped_at < 129 {
                0
            } else {
                255 - u64::from(stopped_at)
            };
            assert_eq!(counted, 1 + gap, "stopped at {stopped_at}");
        }
    }

    #[test]
    fn gaps_after_a_restart_are_counted_again() {
        assert_eq!(lost((0..=100).chain(0..20).chain(22..40)), 2);
    }
}
