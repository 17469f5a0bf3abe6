//! The channels of a transmitter, overridden by this program (`RC_CHANNELS_OVERRIDE`), for tests.

use mavlink::dialects::ardupilotmega::{MavMessage, RC_CHANNELS_OVERRIDE_DATA};

use crate::parameters::{ParameterList, StationRight, right_of};
use crate::text;
use crate::text::Text;
use crate::vehicle::{HeldChannels, Vehicle};
use crate::wire::GROUND_STATION_SYSTEM;

/// The pulse width of a centred stick, in microseconds.
pub const CENTRE_US: u16 = 1500;
/// The values that leave a channel alone and release it; the first eight channels are released by 0.
const UNCHANGED: u16 = u16::MAX;
const RELEASED: u16 = u16::MAX - 1;

/// A change to the overridden channels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StickChange {
    /// Hold a channel until it is released.
    Hold {
        /// Channel number, 1 first.
        channel: u8,
        /// Pulse width in microseconds.
        pulse_us: u16,
    },
    /// Give all held channels back to the transmitter.
    Release,
}

/// Why a vehicle would ignore the channels that this station holds; `None` if it obeys, or if that is unknown.
pub fn stick_obstacle(vehicle: &Vehicle, list: &ParameterList) -> Option<Text> {
    match right_here(vehicle, list) {
        StationRight::Ignored { parameter, station } => Some(text!(
            "refused-sticks-station",
            own = vehicle.station,
            station = station,
            parameter = parameter
        )),
        StationRight::Obeyed | StationRight::Unknown => None,
    }
}

/// Whether it is unknown if a vehicle obeys the channels that this station holds. The usual station is obeyed, unless
/// the vehicle is set otherwise.
pub fn may_ignore_sticks(vehicle: &Vehicle, list: &ParameterList) -> bool {
    let is_usual = vehicle.station == GROUND_STATION_SYSTEM;
    !is_usual && right_here(vehicle, list) == StationRight::Unknown
}

/// The right of this station, which only `ArduPilot` limits.
fn right_here(vehicle: &Vehicle, list: &ParameterList) -> StationRight {
    let limits = vehicle.heartbeat.is_some_and(|it| it.is_ardupilot());
    if limits {
        right_of(vehicle.station, list)
    } else {
        StationRight::Obeyed
    }
}

/// The message that holds channels, and leaves the others to the transmitter.
pub fn hold_message(vehicle: &Vehicle, held: &HeldChannels) -> MavMessage {
    message(vehicle, held, |_, pulse_us| pulse_us)
}

/// The message that gives channels back to the transmitter.
pub fn release_message(vehicle: &Vehicle, held: &HeldChannels) -> MavMessage {
    message(
        vehicle,
        held,
        |channel, _| {
            if channel < 8 { 0 } else { RELEASED }
        },
    )
}

fn message(
    vehicle: &Vehicle,
    held: &HeldChannels,
    value: impl Fn(usize, u16) -> u16,
) -> MavMessage {
    let of = |channel: usize| {
        let pulse_us = held.pulse_us(channel);
        pulse_us.map_or(UNCHANGED, |pulse_us| value(channel, pulse_us))
    };
    MavMessage::RC_CHANNELS_OVERRIDE(RC_CHANNELS_OVERRIDE_DATA {
        target_system: vehicle.system,
        target_component: vehicle.component,
        chan1_raw: of(0),
        chan2_raw: of(1),
        chan3_raw: of(2),
        chan4_raw: of(3),
        chan5_raw: of(4),
        chan6_raw: of(5),
        chan7_raw: of(6),
        chan8_raw: of(7),
        chan9_raw: of(8),
        chan10_raw: of(9),
        chan11_raw: of(10),
        chan12_raw: of(11),
        chan13_raw: of(12),
        chan14_raw: of(13),
        chan15_raw: of(14),
        chan16_raw: of(15),
        chan17_raw: UNCHANGED,
        chan18_raw: UNCHANGED,
    })
}
