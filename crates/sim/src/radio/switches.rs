//! The switches of the remote control that have a function (`RCn_OPTION`).

use super::CHANNELS;

/// Pulse widths beyond these limits are not a valid reading of a switch, in microseconds.
const VALID_US: std::ops::Range<u16> = 801..2200;
/// Pulse widths below the first are low, above the second high.
const LOW_BELOW_US: u16 = 1200;
const HIGH_ABOVE_US: u16 = 1800;
/// The number of further identical readings, at ten per second, before a position counts.
const STEADY_LOOKS: u8 = 2;
/// Functions with a part in the checks before arming.
pub(crate) const MOTOR_EMERGENCY_STOP: u16 = 31;
pub(crate) const MOTOR_INTERLOCK: u16 = 32;
pub(crate) const ARM_OR_EMERGENCY_STOP: u16 = 165;
/// Functions that act at boot, by the position in which their switch is found: the reference of the
/// sticks, the fence, the ACRO trainer, the motors, overrides, the GPS, stand-by.
const ACTING_AT_BOOT: &[u16] = &[
    3,
    11,
    13,
    14,
    MOTOR_EMERGENCY_STOP,
    MOTOR_INTERLOCK,
    46,
    65,
    76,
];
/// Functions that ignore the position in which their switch is found: to arm, to release the parachute.
const WAITING_FOR_MOVE: &[u16] = &[22, 153, 154, ARM_OR_EMERGENCY_STOP];

/// A position of a three-position switch, by its pulse width or its number in `DO_AUX_FUNCTION`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SwitchPosition {
    Low,
    Middle,
    High,
}

impl SwitchPosition {
    fn of(pulse_us: u16) -> Option<Self> {
        VALID_US.contains(&pulse_us).then_some({
            if pulse_us < LOW_BELOW_US {
                Self::Low
            } else if pulse_us > HIGH_ABOVE_US {
                Self::High
            } else {
                Self::Middle
            }
        })
    }

    /// The position with a number of `DO_AUX_FUNCTION`.
    pub(crate) fn numbered(number: i32) -> Option<Self> {
        [Self::Low, Self::Middle, Self::High]
            .get(usize::try_from(number).ok()?)
            .copied()
    }

    /// The position's number in `DO_AUX_FUNCTION`.
    pub(crate) fn number(self) -> u8 {
        match self {
            Self::Low => 0,
            Self::Middle => 1,
            Self::High => 2,
        }
    }

    /// The position's name in texts.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Low => "LOW",
            Self::Middle => "MIDDLE",
            Self::High => "HIGH",
        }
    }
}

/// A switch that has a new position.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct SwitchMove {
    /// The channel of the switch, counted from 1.
    pub(crate) channel: usize,
    pub(crate) function: u16,
    pub(crate) position: SwitchPosition,
}

#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Switch {
    position: Option<SwitchPosition>,
    /// A position not yet steady, and how many times it was read again.
    candidate: Option<SwitchPosition>,
    steady: u8,
    was_read: bool,
}

/// The switches of all channels.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Switches([Switch; CHANNELS]);

impl Switches {
    /// The switches with a function in the positions they have now: most do not act until they are moved.
    pub(super) fn at_rest(functions: &[u16; CHANNELS], channels_us: &[u16; CHANNELS]) -> Self {
        let mut all = Self::default();
        for ((switch, function), pulse_us) in all.0.iter_mut().zip(functions).zip(channels_us) {
            if *function != 0 && !ACTING_AT_BOOT.contains(function) {
                switch.position = SwitchPosition::of(*pulse_us);
                switch.was_read = switch.position.is_some();
            }
        }
        all
    }

    /// Reads the switches with a function; to be called ten times a second.
    pub(super) fn watch(
        &mut self,
        functions: &[u16; CHANNELS],
        channels_us: &[u16; CHANNELS],
    ) -> Vec<SwitchMove> {
        let mut moves = Vec::new();
        for (place, switch) in self.0.iter_mut().enumerate() {
            let function = functions[place];
            if function != 0
                && let Some(read) = SwitchPosition::of(channels_us[place])
                && switch.reads(read, function)
            {
                moves.push(SwitchMove {
                    channel: place + 1,
                    function,
                    position: read,
                });
            }
        }
        moves
    }
}

impl Switch {
    /// Takes a reading; returns whether the switch has a new position.
    fn reads(&mut self, read: SwitchPosition, function: u16) -> bool {
        if !std::mem::replace(&mut self.was_read, true) && WAITING_FOR_MOVE.contains(&function) {
            self.position = Some(read);
        }
        if self.position == Some(read) {
            self.candidate = None;
            return false;
        }
        if self.candidate != Some(read) {
            (self.candidate, self.steady) = (Some(read), 0);
            return false;
        }
        self.steady += 1;
        let moved = self.steady >= STEADY_LOOKS;
        if moved {
            (self.position, self.candidate) = (Some(read), None);
        }
        moved
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_switch_counts_once_it_is_steady_and_one_that_arms_only_when_it_is_moved() {
        let mut functions = [0; CHANNELS];
        (functions[6], functions[7]) = (4, 153);
        let mut channels = [1000; CHANNELS];
        channels[7] = 1900;
        let mut all = Switches::default();
        let at = |all: &mut Switches, channels: &[u16; CHANNELS]| {
            (0..3)
                .map(|_| all.watch(&functions, channels))
                .collect::<Vec<_>>()
        };
        let first = at(&mut all, &channels);
        assert_eq!(first.iter().map(Vec::len).collect::<Vec<_>>(), [0, 0, 1]);
        assert_eq!(
            (first[2][0].channel, first[2][0].position),
            (7, SwitchPosition::Low)
        );
        channels[7] = 1000;
        let second = at(&mut all, &channels);
        assert_eq!(
            (second[2][0].function, second[2][0].position),
            (153, SwitchPosition::Low)
        );
        channels[7] = 0;
        assert_eq!(at(&mut all, &channels).concat(), []);
    }
}
