//! The order of the swarm table's rows.

use std::cmp::Ordering;

use super::{FlightView, Standing};
use crate::config::Column;
use crate::pilot_in_command::Person;
use crate::vehicle::{LandedState, Vehicle};

/// The sort key of a row.
#[derive(Debug, Clone, PartialEq)]
pub enum SortKey {
    Number(f64),
    Word(String),
    /// Unknown: last in either direction.
    Missing,
}

impl Column {
    /// A vehicle's sort key. Words are sorted by their English form.
    pub fn key(self, vehicle: &Vehicle, session: &FlightView) -> SortKey {
        match self {
            Self::Name => SortKey::word(FlightView::class(vehicle)),
            Self::Mode => vehicle
                .mode_name()
                .map_or(SortKey::Missing, |mode| SortKey::word(&mode)),
            Self::Group => SortKey::word(&session.groups_of(vehicle.id).join(" ")),
            // The user's own vehicles come first.
            Self::Pilot => SortKey::word(session.pilots().of(vehicle.id).map_or("", Person::name)),
            Self::Command => session
                .latest(vehicle.id)
                .map_or(SortKey::Missing, |(entry, _)| {
                    SortKey::word(entry.verb.name)
                }),
            Self::Id
            | Self::Armed
            | Self::State
            | Self::Altitude
            | Self::Speed
            | Self::Battery
            | Self::Gps
            | Self::Link
            | Self::Home
            | Self::ToGo
            | Self::Heading
            | Self::Climb
            | Self::Voltage
            | Self::Current
            | Self::Used
            | Self::Hdop
            | Self::RoundTrip
            | Self::Ekf
            | Self::Vibration
            | Self::Item
            | Self::Next
            | Self::End
            | Self::Sea
            | Self::Latitude
            | Self::Longitude
            | Self::Alert => self
                .number(vehicle, session)
                .map_or(SortKey::Missing, SortKey::Number),
        }
    }

    /// The value in a column, in the column's unit; states are numbered by importance. `None` for
    /// columns of text and unknown values.
    pub fn number(self, vehicle: &Vehicle, session: &FlightView) -> Option<f64> {
        let battery = vehicle.battery();
        let place = vehicle.global.map(|global| global.at_point);
        match self {
            Self::Id => Some(f64::from(vehicle.id)),
            Self::Name | Self::Mode | Self::Group | Self::Pilot | Self::Command => None,
            Self::Armed => vehicle.heartbeat.map(|_| armed(vehicle)),
            Self::State => Some(f64::from(state(vehicle) as u8)),
            // The height of a rover is that of its road.
            Self::Altitude | Self::Climb if vehicle.is_on_surface() => None,
            Self::Altitude => vehicle.altitude_m(),
            Self::Speed => vehicle.ground_speed_m_s().map(f64::from),
            Self::Battery => battery?.remaining_percent.map(f64::from),
            Self::Gps => vehicle.gps.map(|gps| {
                f64::from(gps.fix as u8) * 100.0 + f64::from(gps.satellites.unwrap_or(0))
            }),
            Self::Link => Some(heard(vehicle)),
            Self::Home => vehicle.distance_home_m(),
            Self::ToGo => place
                .zip(vehicle.target.and_then(|target| target.at_point))
                .map(|(from, to)| from.distance_m(to)),
            Self::Heading => vehicle.heading_deg().map(f64::from),
            Self::Climb => vehicle.global.map(|global| f64::from(-global.down_m_s)),
            Self::Voltage => battery?.voltage_v.map(f64::from),
            Self::Current => battery?.current_a.map(f64::from),
            Self::Used => battery?.consumed_mah.map(f64::from),
            Self::Hdop => vehicle.gps?.hdop.map(f64::from),
            Self::RoundTrip => vehicle.link.round_trip.map(|trip| trip.as_secs_f64() * 1e3),
            Self::Ekf => vehicle.ekf.map(|ekf| f64::from(ekf.worst())),
            Self::Vibration => vehicle
                .vibration
                .map(|it| f64::from(it.level_m_s2.into_iter().fold(0.0, f32::max))),
            Self::Item => vehicle.plan.total.map(|_| f64::from(vehicle.plan.current)),
            Self::Next => vehicle.plan_leg()?.left_m,
            Self::End => vehicle.plan_leg()?.end.map(|end| end.as_secs_f64()),
            Self::Sea => vehicle.global.map(|global| global.altitude_amsl_m),
            Self::Latitude => place.map(|place| place.lat_deg),
            Self::Longitude => place.map(|place| place.lon_deg),
            Self::Alert => session
                .alerts
                .worst(vehicle.id)
                .map(|one| seriousness(session, one)),
        }
    }

    /// The minimum change of a value that moves its row.
    pub fn step(self) -> f64 {
        match self {
            Self::Heading | Self::Home | Self::ToGo | Self::Next | Self::End | Self::RoundTrip => {
                5.0
            }
            Self::Altitude | Self::Speed | Self::Link | Self::Sea => 1.0,
            Self::Battery | Self::Vibration => 2.0,
            Self::Used => 20.0,
            Self::Climb | Self::Current => 0.5,
            Self::Voltage | Self::Hdop | Self::Ekf => 0.1,
            Self::Latitude | Self::Longitude => 0.00005,
            Self::Id
            | Self::Name
            | Self::Group
            | Self::Pilot
            | Self::Mode
            | Self::Armed
            | Self::State
            | Self::Gps
            | Self::Command
            | Self::Item
            | Self::Alert => 0.0,
        }
    }
}

/// The percentage of the vehicle's messages that arrive.
fn heard(vehicle: &Vehicle) -> f64 {
    if vehicle.link.lost {
        0.0
    } else {
        f64::from(vehicle.link.percent())
    }
}

/// The state of a vehicle; of a rover or boat, whether it moves or stands.
fn state(vehicle: &Vehicle) -> LandedState {
    match (vehicle.is_on_surface(), vehicle.moves()) {
        (false, _) => vehicle.landed,
        (true, false) => LandedState::OnGround,
        (true, true) => LandedState::InAir,
    }
}

/// A number that sorts armed vehicles first, then those ready to arm.
fn armed(vehicle: &Vehicle) -> f64 {
    match (vehicle.armed(), vehicle.ready_to_arm()) {
        (true, _) => 0.0,
        (false, true) => 1.0,
        (false, false) => 2.0,
    }
}

/// A number that sorts the most serious alerts first, and acknowledged or muted ones after all
/// others.
fn seriousness(session: &FlightView, one: &Standing) -> f64 {
    let calm = if session.alerts.is_calm(one) {
        10.0
    } else {
        0.0
    };
    calm + f64::from(one.alert.severity as u8)
}

impl SortKey {
    fn word(word: &str) -> Self {
        if word.is_empty() {
            Self::Missing
        } else {
            Self::Word(word.to_owned())
        }
    }

    /// Whether the key is so close to the previous one that the row should stay.
    pub fn is_near(&self, before: &Self, step: f64) -> bool {
        match (self, before) {
            (Self::Number(now), Self::Number(before)) => (now - before).abs() < step,
            _ => self == before,
        }
    }

    /// The order of two rows.
    pub fn compare(&self, other: &Self, reversed: bool) -> Ordering {
        let order = match (self, other) {
            (Self::Missing, Self::Missing) => return Ordering::Equal,
            (Self::Missing, _) => return Ordering::Greater,
            (_, Self::Missing) => return Ordering::Less,
            (Self::Number(a), Self::Number(b)) => a.total_cmp(b),
            (Self::Word(a), Self::Word(b)) => a.cmp(b),
            (Self::Number(_), Self::Word(_)) => Ordering::Less,
            (Self::Word(_), Self::Number(_)) => Ordering::Greater,
        };
        if reversed { order.reverse() } else { order }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_known_comes_last_in_either_direction() {
        for reversed in [false, true] {
            let known = SortKey::Number(3.0);
            assert_eq!(known.compare(&SortKey::Missing, reversed), Ordering::Less);
            assert_eq!(
                SortKey::Missing.compare(&known, reversed),
                Ordering::Greater
            );
        }
        let (few, many) = (SortKey::Number(1.0), SortKey::Number(2.0));
        assert_eq!(few.compare(&many, false), Ordering::Less);
        assert_eq!(few.compare(&many, true), Ordering::Greater);
    }
}
