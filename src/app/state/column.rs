//! The columns of the swarm table: what they are called and by what their rows are ordered.

use std::cmp::Ordering;

use super::{Session, Standing};
use crate::text::Text;
use crate::vehicle::Vehicle;

/// A column.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Column {
    /// Its number.
    Id,
    /// What it is.
    Name,
    /// Flight mode.
    Mode,
    /// Whether it is armed, or ready to be.
    Armed,
    /// On the ground or in the air.
    State,
    /// Height above home.
    Altitude,
    /// Speed over ground.
    Speed,
    /// Charge left.
    Battery,
    /// Kind of fix, and satellites.
    Gps,
    /// How much of what it sends arrives.
    Link,
    /// Distance to home.
    Home,
    /// The groups it belongs to.
    Group,
    /// The newest command and its state.
    Command,
    /// Distance to its target.
    ToGo,
    /// Heading.
    Heading,
    /// Climb rate.
    Climb,
    /// Voltage of the pack.
    Voltage,
    /// Current drawn.
    Current,
    /// Charge used.
    Used,
    /// Horizontal dilution of precision.
    Hdop,
    /// Round trip of a message.
    RoundTrip,
    /// The worst test ratio of the filter.
    Ekf,
    /// The worst vibration.
    Vibration,
    /// The item of the plan that is flown.
    Item,
    /// Height above the sea.
    Sea,
    /// Latitude.
    Latitude,
    /// Longitude.
    Longitude,
    /// The worst alert, and since when.
    Alert,
}

/// What a row is ordered by.
#[derive(Debug, Clone, PartialEq)]
pub enum Key {
    /// A figure.
    Number(f64),
    /// A word.
    Word(String),
    /// Not known: last in either direction.
    Missing,
}

/// What the table is ordered by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sort {
    /// The column.
    pub column: Column,
    /// Whether the largest comes first.
    pub reversed: bool,
}

impl Column {
    /// Every column with its name in the configuration and on the command line, in the order of display.
    pub const ALL: &[(&'static str, Self)] = &[
        ("id", Self::Id),
        ("name", Self::Name),
        ("group", Self::Group),
        ("mode", Self::Mode),
        ("armed", Self::Armed),
        ("state", Self::State),
        ("alt", Self::Altitude),
        ("speed", Self::Speed),
        ("bat", Self::Battery),
        ("gps", Self::Gps),
        ("link", Self::Link),
        ("home", Self::Home),
        ("command", Self::Command),
        ("to-go", Self::ToGo),
        ("heading", Self::Heading),
        ("climb", Self::Climb),
        ("volt", Self::Voltage),
        ("amps", Self::Current),
        ("used", Self::Used),
        ("hdop", Self::Hdop),
        ("ping", Self::RoundTrip),
        ("ekf", Self::Ekf),
        ("vibe", Self::Vibration),
        ("item", Self::Item),
        ("sea", Self::Sea),
        ("lat", Self::Latitude),
        ("lon", Self::Longitude),
        ("alert", Self::Alert),
    ];

    /// Its name in the configuration and on the command line.
    pub fn name(self) -> &'static str {
        let mut all = Self::ALL.iter();
        all.find(|(_, column)| *column == self)
            .map_or("", |(name, _)| name)
    }

    /// What stands above it.
    pub fn title(self) -> Text {
        Text::new(format!("column-{}", self.name()), Vec::new())
    }

    /// The column of a name.
    pub fn named(name: &str) -> Option<Self> {
        let mut all = Self::ALL.iter();
        all.find(|(known, _)| *known == name)
            .map(|(_, column)| *column)
    }

    /// The names of all columns in one line.
    pub fn names() -> String {
        let names: Vec<&str> = Self::ALL.iter().map(|(name, _)| *name).collect();
        names.join(" ")
    }

    /// What a vehicle's row is ordered by. Words come as they are shown in English.
    pub fn key(self, vehicle: &Vehicle, session: &Session) -> Key {
        match self {
            Self::Name => Key::word(Session::class(vehicle)),
            Self::Mode => vehicle
                .mode()
                .map_or(Key::Missing, |mode| Key::word(&mode.to_string())),
            Self::Group => Key::word(&session.groups_of(vehicle.id).join(" ")),
            Self::Command => session
                .latest(vehicle.id)
                .map_or(Key::Missing, |(entry, _)| Key::word(&entry.verb)),
            _ => self
                .number(vehicle, session)
                .map_or(Key::Missing, Key::Number),
        }
    }

    /// The figure in a column, in the column's unit; words are numbered by how much they matter.
    pub fn number(self, vehicle: &Vehicle, session: &Session) -> Option<f64> {
        let battery = vehicle.battery();
        let place = vehicle.global.map(|global| global.at_point);
        match self {
            Self::Id => Some(f64::from(vehicle.id)),
            Self::Name | Self::Mode | Self::Group | Self::Command => None,
            Self::Armed => vehicle.heartbeat.map(|_| armed(vehicle)),
            Self::State => Some(f64::from(vehicle.landed as u8)),
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
            Self::Sea => vehicle.global.map(|global| global.altitude_amsl_m),
            Self::Latitude => place.map(|place| place.lat_deg),
            Self::Longitude => place.map(|place| place.lon_deg),
            Self::Alert => session
                .alarms
                .worst(vehicle.id)
                .map(|one| seriousness(session, one)),
        }
    }

    /// How much a figure has to change before its row may move.
    pub fn step(self) -> f64 {
        match self {
            Self::Heading | Self::Home | Self::ToGo | Self::RoundTrip => 5.0,
            Self::Altitude | Self::Speed | Self::Link | Self::Sea => 1.0,
            Self::Battery | Self::Vibration => 2.0,
            Self::Used => 20.0,
            Self::Climb | Self::Current => 0.5,
            Self::Voltage | Self::Hdop | Self::Ekf => 0.1,
            Self::Latitude | Self::Longitude => 0.00005,
            _ => 0.0,
        }
    }
}

/// How much of what it sends arrives, in percent.
fn heard(vehicle: &Vehicle) -> f64 {
    if vehicle.link.lost {
        0.0
    } else {
        f64::from(vehicle.link.percent())
    }
}

/// Armed first, then ready, then the rest.
fn armed(vehicle: &Vehicle) -> f64 {
    match (vehicle.armed(), vehicle.ready_to_arm()) {
        (true, _) => 0.0,
        (false, true) => 1.0,
        (false, false) => 2.0,
    }
}

/// The worst first; what is calm after what is not.
fn seriousness(session: &Session, one: &Standing) -> f64 {
    let calm = if session.alarms.is_calm(one) {
        10.0
    } else {
        0.0
    };
    calm + f64::from(one.alert.severity as u8)
}

impl Key {
    fn word(word: &str) -> Self {
        if word.is_empty() {
            Self::Missing
        } else {
            Self::Word(word.to_owned())
        }
    }

    /// Whether this is so near to what it was that its row should stay.
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

impl Sort {
    /// By number, as long as nobody wants anything else.
    pub const BY_ID: Self = Self {
        column: Column::Id,
        reversed: false,
    };

    /// Reads `bat` or `-bat`; `None` if there is no such column.
    pub fn named(text: &str) -> Option<Self> {
        let name = text.strip_prefix('-');
        let column = Column::named(name.unwrap_or(text))?;
        Some(Self {
            column,
            reversed: name.is_some(),
        })
    }

    /// The same in writing.
    pub fn name(self) -> String {
        let mark = if self.reversed { "-" } else { "" };
        format!("{mark}{}", self.column.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_orders_read_back() {
        for (name, column) in Column::ALL {
            assert_eq!(Column::named(name), Some(*column));
            assert_eq!(column.name(), *name);
            let reversed = format!("-{name}");
            assert_eq!(Sort::named(&reversed).map(Sort::name), Some(reversed));
        }
        assert_eq!(Sort::named("colour"), None);
    }

    #[test]
    fn what_is_not_known_comes_last_in_either_direction() {
        for reversed in [false, true] {
            let known = Key::Number(3.0);
            assert_eq!(known.compare(&Key::Missing, reversed), Ordering::Less);
            assert_eq!(Key::Missing.compare(&known, reversed), Ordering::Greater);
        }
        let (few, many) = (Key::Number(1.0), Key::Number(2.0));
        assert_eq!(few.compare(&many, false), Ordering::Less);
        assert_eq!(few.compare(&many, true), Ordering::Greater);
    }
}
