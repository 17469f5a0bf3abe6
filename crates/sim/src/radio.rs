//! The transmitter's channels, and ground stations that override it (`RC_CHANNELS_OVERRIDE`, `MANUAL_CONTROL`).

mod neutral;
mod simple;
mod switches;

use std::time::Duration;

use self::neutral::NeutralRules;
pub(super) use self::simple::{SimpleMode, SimpleSticks};
use self::switches::Switches;
pub(super) use self::switches::{
    ARM_OR_EMERGENCY_STOP, MOTOR_EMERGENCY_STOP, MOTOR_INTERLOCK, SwitchMove, SwitchPosition,
};
use super::estimator::RadioFault;
use super::kind::VehicleKind;
use super::parameters::Parameters;

/// Channels that can be overridden.
pub(super) const CHANNELS: usize = 16;
/// Special values of a channel in an override: the first leaves it unchanged; the second releases it (only channels
/// from the ninth on).
const UNCHANGED: u16 = u16::MAX;
const GIVEN_BACK: u16 = u16::MAX - 1;
/// The longest pulse that a receiver can send, in microseconds.
const PULSE_MAX_US: u16 = 2500;
/// The duration of an override that has no time limit.
const FOR_EVER: Duration = Duration::from_secs(1 << 40);
/// Upper limits of the pulse width for the first five positions of the mode switch, in
/// microseconds.
const SWITCH_US: [u16; 5] = [1230, 1360, 1490, 1620, 1749];
/// The number of further identical readings, at ten per second, before the switch counts.
const STEADY_LOOKS: u8 = 2;
/// The number of checks for which the sticks must be held in the corner that arms.
const CORNER_LOOKS: u8 = 20;
/// The minimum deflection of the yaw stick in that corner (-1 to 1).
const CORNER: f64 = 4000.0 / 4500.0;

/// The rules for the channels, from `RCn_*`, `RC_OVERRIDE_TIME` and others.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RadioRules {
    /// Roll, pitch, throttle, yaw.
    pub(super) sticks: [StickRange; 4],
    /// The duration of an override; `None` if overrides are refused.
    override_time: Option<Duration>,
    mode_channel: usize,
    rudder_arms: bool,
    /// The function of each channel's switch (`RCn_OPTION`); 0 for none.
    functions: [u16; CHANNELS],
    neutral: NeutralRules,
}

impl RadioRules {
    /// Whether a switch has a function.
    pub(super) fn has_switch(&self, function: u16) -> bool {
        self.functions.contains(&function)
    }

    /// Whether the motors turn only while a switch allows it.
    pub(super) fn has_interlock(&self) -> bool {
        self.has_switch(MOTOR_INTERLOCK)
    }

    /// Whether a switch stops the motors.
    pub(super) fn has_emergency_stop(&self) -> bool {
        self.has_switch(MOTOR_EMERGENCY_STOP) || self.has_switch(ARM_OR_EMERGENCY_STOP)
    }
}

/// The pulse widths of one stick, in microseconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct StickRange {
    min: f64,
    trim: f64,
    max: f64,
    dead: f64,
    sign: f64,
}

impl RadioRules {
    pub(super) fn read(all: &Parameters) -> Self {
        let stick = |n: usize| {
            let of = |what: &str| all.value(&format!("RC{n}_{what}"));
            StickRange {
                min: of("MIN"),
                trim: of("TRIM"),
                max: of("MAX"),
                dead: of("DZ").max(0.0),
                sign: if of("REVERSED") > 0.0 { -1.0 } else { 1.0 },
            }
        };
        let channel = |name| (all.value(name) as usize).clamp(1, CHANNELS);
        let lasts_s = all.value("RC_OVERRIDE_TIME");
        let channels = ["RCMAP_ROLL", "RCMAP_PITCH", "RCMAP_THROTTLE", "RCMAP_YAW"].map(channel);
        Self {
            neutral: NeutralRules::read(all, channels),
            sticks: channels.map(stick),
            override_time: if lasts_s == 0.0 {
                None
            } else if lasts_s < 0.0 {
                Some(FOR_EVER)
            } else {
                Some(Duration::from_secs_f64(lasts_s.min(1e6)))
            },
            mode_channel: all.value(all.kind().mode_channel()) as usize,
            rudder_arms: all.value("ARMING_RUDDER") > 0.0,
            functions: std::array::from_fn(|channel| {
                all.value(&format!("RC{}_OPTION", channel + 1)) as u16
            }),
        }
    }
}

impl StickRange {
    /// A stick's deflection, -1 to 1; zero within the dead zone.
    pub(super) fn off_centre(&self, pulse_us: u16) -> f64 {
        let off = f64::from(pulse_us) - self.trim;
        let (beyond, travel) = if off > 0.0 {
            (off - self.dead, self.max - self.trim - self.dead)
        } else {
            (off + self.dead, self.trim - self.min - self.dead)
        };
        if beyond * off <= 0.0 || travel <= 0.0 {
            return 0.0;
        }
        (beyond / travel).clamp(-1.0, 1.0) * self.sign
    }

    /// A stick's deflection from its end, 0 to 1; zero within the dead zone.
    pub(super) fn pushed(&self, pulse_us: u16) -> f64 {
        let from = self.min + self.dead;
        let travel = (self.max - from).max(1.0);
        let share = ((f64::from(pulse_us) - from) / travel).clamp(0.0, 1.0);
        if self.sign < 0.0 { 1.0 - share } else { share }
    }

    /// The value of [`pushed`](Self::pushed) for a centred stick.
    pub(super) fn middle(&self) -> f64 {
        let from = self.min + self.dead;
        let travel = (self.max - from).max(1.0);
        ((f64::midpoint(self.min, self.max) - from) / travel).clamp(0.05, 0.95)
    }

    /// The pulse of a share of the whole travel.
    fn pulse(&self, share: f64) -> u16 {
        (self.min + (self.max - self.min) * share).clamp(0.0, f64::from(PULSE_MAX_US)) as u16
    }
}

/// Pulse widths of the channels in microseconds: roll, pitch, throttle, yaw, then switches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sticks {
    pub(super) channels_us: [u16; CHANNELS],
}

impl Sticks {
    /// Sticks centred and throttle down, as on a SITL without a transmitter.
    pub(super) const RELEASED: Self = Self {
        channels_us: [
            1500, 1500, 1000, 1500, 1800, 1000, 1000, 1800, 0, 0, 0, 0, 0, 0, 0, 0,
        ],
    };

    /// Whether the throttle is at its minimum.
    pub(super) fn throttle_is_low(&self) -> bool {
        self.channels_us[2] <= 1050
    }
}

/// The latest input of the transmitter, or of ground stations that override it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Radio {
    kind: VehicleKind,
    overrides: [(u16, Duration); CHANNELS],
    /// The latest time at which overrides end.
    pub(super) until: Duration,
    switch: (usize, u8),
    /// The position of the mode switch that was obeyed last; `None` before the first.
    obeyed: Option<usize>,
    switches: Switches,
    corner: u8,
    /// Whether a receiver or an override has been heard since boot.
    pub(super) was_heard: bool,
    /// Whether a switch has made the vehicle ignore overrides.
    overrides_off: bool,
}

impl Radio {
    pub(super) fn new(kind: VehicleKind) -> Self {
        let rest = switch_position(Sticks::RELEASED.channels_us[4]);
        Self {
            kind,
            overrides: [(0, Duration::ZERO); CHANNELS],
            until: Duration::ZERO,
            switch: (rest, 0),
            obeyed: None,
            switches: Switches::default(),
            corner: 0,
            was_heard: false,
            overrides_off: false,
        }
    }
}

impl Radio {
    /// The current channels: those of the transmitter unless overridden.
    #[inline]
    pub(super) fn sticks(&self, now: Duration) -> Sticks {
        if now < self.until {
            self.overridden(now)
        } else {
            self.released()
        }
    }

    /// The sticks without a transmitter: a rover's throttle is centred.
    fn released(&self) -> Sticks {
        let mut sticks = Sticks::RELEASED;
        if self.kind != VehicleKind::Copter {
            sticks.channels_us[2] = sticks.channels_us[0];
        }
        sticks
    }

    fn overridden(&self, now: Duration) -> Sticks {
        let mut sticks = self.released();
        for (channel, (pulse_us, until)) in sticks.channels_us.iter_mut().zip(&self.overrides) {
            if now < *until && *pulse_us != 0 {
                *channel = *pulse_us;
            }
        }
        sticks
    }

    /// Obeys overrides, or ends them and ignores further ones.
    pub(super) fn allow_overrides(&mut self, allowed: bool) {
        self.overrides_off = !allowed;
        if self.overrides_off {
            self.until = Duration::ZERO;
        }
    }

    fn override_time(&self, rules: &RadioRules) -> Option<Duration> {
        rules.override_time.filter(|_| !self.overrides_off)
    }

    fn set(&mut self, channel: usize, pulse_us: u16, until: Duration) {
        if let Some(slot) = self.overrides.get_mut(channel) {
            *slot = (pulse_us, until);
            self.until = self.until.max(until);
        }
    }
}

/// The position of the mode switch, from 0.
fn switch_position(pulse_us: u16) -> usize {
    SWITCH_US
        .iter()
        .take_while(|limit| pulse_us > **limit)
        .count()
}

/// The requests of sticks and switches.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct StickRequests {
    /// Whether the mode switch has a new position.
    pub(super) moved_switch: bool,
    /// Whether the sticks were held in the corner that arms.
    pub(super) arms: bool,
    /// Switches with a function that were moved.
    pub(super) moves: Vec<SwitchMove>,
}

impl Radio {
    /// Applies `RC_CHANNELS_OVERRIDE`: 65535 leaves a channel as it is, 0 releases one of the first eight, 65534
    /// one of the others.
    pub(super) fn override_channels(
        &mut self,
        asked: [u16; CHANNELS],
        rules: &RadioRules,
        now: Duration,
    ) {
        let Some(lasts) = self.override_time(rules) else {
            return;
        };
        let until = now.saturating_add(lasts);
        for (channel, pulse_us) in asked.into_iter().enumerate() {
            let front = channel < 8;
            match pulse_us {
                UNCHANGED => {}
                0 if !front => {}
                GIVEN_BACK if !front => self.set(channel, 0, until),
                pulse_us => self.set(channel, pulse_us.min(PULSE_MAX_US), until),
            }
        }
    }

    /// Applies `MANUAL_CONTROL`: pitch, roll, throttle and yaw in thousandths; 32767 leaves an axis unchanged. A
    /// message with a negative throttle is ignored.
    pub(super) fn control_manually(
        &mut self,
        [x, y, z, r]: [i16; 4],
        rules: &RadioRules,
        now: Duration,
    ) {
        let Some(lasts) = self.override_time(rules) else {
            return;
        };
        if z < 0 {
            return;
        }
        let until = now.saturating_add(lasts);
        let centred = |value: i16| (f64::from(value) + 1000.0) / 2000.0;
        let shares = [
            (y, centred(y)),
            (x, centred(x.saturating_neg())),
            (z, f64::from(z) / 1000.0),
            (r, centred(r)),
        ];
        for (channel, (value, share)) in shares.into_iter().enumerate() {
            let pulse_us = if value == i16::MAX {
                0
            } else {
                rules.sticks[channel].pulse(share)
            };
            self.set(channel, pulse_us, until);
        }
    }

    /// Checks the mode switch and the corner of the sticks that arms; to be called ten times a second.
    pub(super) fn watch(
        &mut self,
        rules: &RadioRules,
        armed: bool,
        now: Duration,
    ) -> StickRequests {
        let sticks = self.sticks(now);
        let channel = rules.mode_channel.wrapping_sub(1);
        let pulse_us = sticks.channels_us.get(channel);
        let moved_switch = pulse_us.is_some_and(|us| self.watch_switch(switch_position(*us)));
        let [.., throttle, yaw] = rules.sticks;
        let low = throttle.pushed(sticks.channels_us[2]) <= 0.0;
        let cornered = low && yaw.off_centre(sticks.channels_us[3]) > CORNER;
        self.corner = if cornered && !armed && rules.rudder_arms {
            self.corner.saturating_add(1)
        } else {
            0
        };
        StickRequests {
            moved_switch,
            arms: self.corner == CORNER_LOOKS,
            moves: self.switches.watch(&rules.functions, &sticks.channels_us),
        }
    }

    fn watch_switch(&mut self, position: usize) -> bool {
        self.switch = if position == self.switch.0 {
            (position, self.switch.1.saturating_add(1))
        } else {
            (position, 0)
        };
        let moved = self.obeyed != Some(position) && self.switch.1 >= STEADY_LOOKS;
        if moved {
            self.obeyed = Some(position);
        }
        moved
    }

    /// The parameter with the mode of the switch's position: `FLTMODE1` to 6, or `MODE1` to 6; `None` before it was read.
    pub(super) fn mode_parameter(&self) -> Option<String> {
        let parameters = self.kind.mode_parameters();
        Some(format!("{parameters}{}", self.obeyed? + 1))
    }

    /// The position of the mode switch, from 0; `None` before it was read.
    pub(super) fn mode_position(&self) -> Option<usize> {
        self.obeyed
    }

    /// Reads the receiver for the first time: its mode switch chooses the mode, and most other switches do not act
    /// until they are moved.
    pub(super) fn read_first(&mut self, rules: &RadioRules) {
        let channels = Sticks::RELEASED.channels_us;
        self.obeyed = channels
            .get(rules.mode_channel.wrapping_sub(1))
            .map(|pulse_us| switch_position(*pulse_us));
        self.switches = Switches::at_rest(&rules.functions, &channels);
        self.was_heard = true;
    }

    /// Whether there is any input: from a receiver that sends, or from a ground station that
    /// overrides it.
    pub(super) fn hears(&self, fault: RadioFault, now: Duration) -> bool {
        fault != RadioFault::Silent || now < self.until
    }

    /// Forgets the positions of the switches, so that the first reading acts.
    pub(super) fn forget_switches(&mut self) {
        self.switches = Switches::default();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sticks_are_read_with_their_dead_zones() {
        let rules = RadioRules::read(&Parameters::new(crate::VehicleKind::Copter, 1));
        let [roll, _, throttle, _] = rules.sticks;
        // A stick at 1300 leans by 0.375 of the maximum: 11.25 of 30 degrees.
        assert!((roll.off_centre(1300) + 0.375).abs() < 1e-9);
        assert!(roll.off_centre(1515) == 0.0 && roll.off_centre(1485) == 0.0);
        assert!((throttle.pushed(1700) - 670.0 / 970.0).abs() < 1e-9);
        assert!(throttle.pushed(1020) == 0.0);
        assert!((throttle.middle() - 470.0 / 970.0).abs() < 1e-9);
    }

    #[test]
    fn the_mode_switch_has_six_positions() {
        for (pulse_us, position) in [
            (1000, 0),
            (1231, 1),
            (1490, 2),
            (1500, 3),
            (1749, 4),
            (1800, 5),
        ] {
            assert_eq!(switch_position(pulse_us), position);
        }
    }
}
