//! Counts frames that never arrived.

use std::collections::BTreeMap;

use super::{ComponentId, Content, Frame, SystemId, boot_ms, is_clock_step_back};

/// A larger step between sequence numbers counts as a step back: the frame is late, or the sender has restarted.
const LONGEST_GAP: u8 = 127;
/// This many late frames in a row come from a restarted sender and are not duplicates, if their
/// numbers rise and were received before.
const RESTART_AFTER: u8 = 8;
/// The largest step between the numbers of a sender that may have restarted.
const LARGEST_GAP_ANEW: u8 = 8;

/// The meaning of a frame's sequence number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SequenceStep {
    /// The change in the number of missing frames: the length of a gap, or -1 for a late frame that was counted as
    /// missing.
    pub missing: i16,
    /// Whether the number is lower than one already received: the frame is late, or another sender
    /// has the same ids.
    pub is_late: bool,
}

/// Counts frames that never arrived, by the gaps in each sender's sequence numbers. A frame that comes late is no
/// longer missing, however many others have overtaken it.
#[derive(Debug, Clone, Default)]
pub struct LossMeter {
    senders: BTreeMap<(SystemId, ComponentId), Numbering>,
    lost: u64,
}

/// The frames of one sender that arrived, and those that are missing between them.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct SenderLoss {
    numbering: Option<Numbering>,
    received: u64,
    missing: i64,
}

impl SenderLoss {
    /// Counts a frame by its sequence number.
    pub fn note(&mut self, sequence: u8) {
        let known = self.numbering.as_mut();
        match known {
            Some(numbering) => self.missing += i64::from(numbering.step_to(sequence).missing),
            None => self.numbering = Some(Numbering::beginning_at(sequence)),
        }
        self.received += 1;
    }

    /// Restarts the count; the next frame still continues the sequence.
    pub fn reset(&mut self) {
        (self.received, self.missing) = (0, 0);
    }

    /// Frames lost since the reset.
    pub fn lost(&self) -> u64 {
        // A frame lost before the reset may come late after it.
        self.missing.max(0).unsigned_abs()
    }

    /// The share of the frames that were lost, 0 to 1.
    pub fn share(&self) -> f64 {
        self.lost() as f64 / (self.received + self.lost()).max(1) as f64
    }
}

/// The state of one sender's sequence numbers.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Numbering {
    last: u8,
    /// Which of the numbers before the last one have not been received.
    missing: [bool; 256],
    /// The newest number behind the last one, if the last frame was late.
    behind: Option<u8>,
    /// How many late frames in a row had numbers that were received before, and how many had
    /// missing ones, as long as their numbers rise steadily.
    repeated: u8,
    found: u8,
    /// The last time since the sender's boot.
    boot_ms: Option<u32>,
    /// The frames counted as missing since that time.
    missing_since: i16,
}

impl Numbering {
    fn beginning_at(sequence: u8) -> Self {
        Self {
            last: sequence,
            missing: [false; 256],
            behind: None,
            repeated: 0,
            found: 0,
            boot_ms: None,
            missing_since: 0,
        }
    }

    /// The step to a frame. A sender that has booted again begins its numbers anew: what was counted as a gap since its
    /// last sign before the boot is none.
    fn step_of(&mut self, frame: &Frame) -> SequenceStep {
        let mut step = self.step_to(frame.sequence);
        self.missing_since = self.missing_since.saturating_add(step.missing);
        let Content::Message(message) = &frame.content else {
            return step;
        };
        let Some(now_ms) = boot_ms(message) else {
            return step;
        };
        let before_ms = self.boot_ms.replace(now_ms);
        if before_ms.is_some_and(|before_ms| is_clock_step_back(before_ms, now_ms)) {
            step = SequenceStep {
                missing: step.missing.saturating_sub(self.missing_since),
                is_late: false,
            };
            *self = Self {
                boot_ms: Some(now_ms),
                ..Self::beginning_at(frame.sequence)
            };
        }
        self.missing_since = 0;
        step
    }

    fn step_to(&mut self, sequence: u8) -> SequenceStep {
        match sequence.wrapping_sub(self.last) {
            0 => SequenceStep::default(), // the same frame twice, as UDP may deliver it
            step @ 1..=LONGEST_GAP => {
                for passed in 1..step {
                    self.missing[usize::from(self.last.wrapping_add(passed))] = true;
                }
                self.move_to(sequence);
                SequenceStep {
                    missing: i16::from(step - 1),
                    is_late: false,
                }
            }
            _ => SequenceStep {
                missing: self.step_back_to(sequence),
                is_late: true,
            },
        }
    }

    /// The change in the number of missing frames.
    fn step_back_to(&mut self, sequence: u8) -> i16 {
        // After a restart the numbers rise, with small gaps at most.
        let follows = |before: u8| (1..=LARGEST_GAP_ANEW).contains(&sequence.wrapping_sub(before));
        if !self.behind.replace(sequence).is_some_and(follows) {
            (self.repeated, self.found) = (0, 0);
        }
        if std::mem::take(&mut self.missing[usize::from(sequence)]) {
            self.found = self.found.saturating_add(1);
            return -1;
        }
        self.repeated += 1;
        if self.repeated < RESTART_AFTER {
            return 0;
        }
        // The frames taken for late ones were new, so the missing frames are still missing.
        let found = self.found;
        self.missing = [false; 256];
        self.move_to(sequence);
        i16::from(found)
    }

    fn move_to(&mut self, sequence: u8) {
        self.last = sequence;
        self.missing[usize::from(sequence)] = false;
        self.behind = None;
        (self.repeated, self.found) = (0, 0);
    }
}

impl LossMeter {
    /// Counts a frame by its sequence number. A frame of an unknown message may be noise, so it introduces no new
    /// sender.
    pub fn note(&mut self, frame: &Frame) -> SequenceStep {
        let sender = (frame.system, frame.component);
        if !frame.is_verified() && !self.senders.contains_key(&sender) {
            return SequenceStep::default();
        }
        let known = self.senders.entry(sender);
        let numbering = known.or_insert_with(|| Numbering::beginning_at(frame.sequence));
        let step = numbering.step_of(frame);
        self.lost = self.lost.saturating_add_signed(step.missing.into());
        step
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
    use mavlink::dialects::ardupilotmega::{ATTITUDE_DATA, HEARTBEAT_DATA, MavMessage};

    fn frame(component: ComponentId, sequence: u8) -> Frame {
        Frame {
            system: 1,
            component,
            sequence,
            version: MavlinkVersion::V2,
            seal: crate::Seal::Unsigned,
            wire_len: 21,
            content: Content::Message(MavMessage::HEARTBEAT(HEARTBEAT_DATA::default())),
        }
    }

    fn lost(sequences: impl IntoIterator<Item = u32>) -> u64 {
        let mut meter = LossMeter::default();
        let mut sum = 0;
        for sequence in sequences {
            sum += i64::from(meter.note(&frame(1, sequence as u8)).missing);
        }
        assert_eq!(sum, meter.lost() as i64, "the changes add up");
        meter.lost()
    }

    #[test]
    fn a_sender_counts_anew_after_a_reset_but_keeps_its_place() {
        let mut loss = SenderLoss::default();
        for sequence in [250, 251, 253, 255, 0, 2] {
            loss.note(sequence);
        }
        assert_eq!(loss.lost(), 3);
        assert!((loss.share() - 3.0 / 9.0).abs() < 1e-9);
        loss.reset();
        for sequence in [1, 3, 5] {
            loss.note(sequence);
        }
        assert_eq!(loss.lost(), 0, "one is missing, one from before came late");
        loss.note(9);
        assert_eq!(loss.lost(), 3);
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

    /// Delays of up to 40 frames, as caused by a jitter of 400 ms at 100 Hz.
    fn shuffled(count: u32) -> Vec<u32> {
        let mut arrivals: Vec<(u32, u32)> = (0..count)
            .map(|number| (number + number.wrapping_mul(2_654_435_761) % 40, number))
            .collect();
        arrivals.sort_unstable();
        arrivals.into_iter().map(|(_, number)| number).collect()
    }

    #[test]
    fn frames_that_overtake_each_other_by_far_are_not_lost() {
        // Frames that the very first one has overtaken cannot be known to be missing.
        assert_eq!(lost(shuffled(5000)), 0);
    }

    #[test]
    fn of_frames_that_overtake_each_other_the_lost_ones_are_counted() {
        let kept = |number: &u32| !(1000..1100).contains(number) || !number.is_multiple_of(4);
        assert_eq!(lost(shuffled(5000).into_iter().filter(kept)), 25);
    }

    #[test]
    fn doubled_frames_that_come_late_are_no_restart() {
        let doubled = (0..1000).flat_map(|number: u32| {
            let late = number.checked_sub(20).filter(|late| late % 3 == 0);
            std::iter::once(number).chain(late)
        });
        assert_eq!(lost(doubled), 0);
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
            assert_eq!(meter.note(&frame).missing, 0, "{frame:?}");
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
    fn the_numbers_of_a_sender_that_boots_again_are_no_gap() {
        let attitude = |sequence: u8, time_boot_ms: u32| Frame {
            content: Content::Message(MavMessage::ATTITUDE(ATTITUDE_DATA {
                time_boot_ms,
                ..ATTITUDE_DATA::default()
            })),
            ..frame(1, sequence)
        };
        for stopped_at in 0..=255_u8 {
            let mut meter = LossMeter::default();
            meter.note(&attitude(stopped_at.wrapping_sub(3), 90_000));
            meter.note(&attitude(stopped_at, 90_100));
            assert_eq!(meter.lost(), 2, "lost before the boot");
            // A heartbeat says nothing about the boot.
            meter.note(&frame(1, 0));
            meter.note(&frame(1, 1));
            meter.note(&attitude(2, 1_200));
            assert_eq!(meter.lost(), 2, "stopped at {stopped_at}");
            meter.note(&attitude(5, 1_300));
            assert_eq!(meter.lost(), 4, "lost after the boot");
        }
    }

    #[test]
    fn gaps_after_a_restart_are_counted_again() {
        assert_eq!(lost((0..=100).chain(0..20).chain(22..40)), 2);
    }
}
