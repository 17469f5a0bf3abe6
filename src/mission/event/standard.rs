//! Events that an instructor can trigger in every mission that allows them, without entries in its
//! file.

use std::time::Duration;

use super::Action;
use super::fault::{Fault, FaultKind, Victim};
use super::mover::{MoverKind, Spawn};
use super::weather::{Change, Element, Target};
use crate::mission::{Mission, Point};
use crate::scoring::AlertLevel;
use crate::text;
use crate::text::Text;

/// The duration of a temporary inject.
const WHILE: Duration = Duration::from_secs(20);
/// The ids of the movers that every mission with an instructor may have.
pub(in crate::mission) const ALWAYS_MOVING: [&str; 2] = [PERSON, AIRCRAFT];
const PERSON: &str = "person";
const AIRCRAFT: &str = "aircraft";
/// The distance from the working area at which an aircraft appears and disappears.
const APPROACH_M: f64 = 600.0;
/// The distance from the working area at which people appear and disappear.
const WALK_M: f64 = 40.0;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Standard {
    /// Stronger wind for a while.
    Gust,
    /// Wind from another direction, for the rest of the flight.
    WindShift,
    /// No satellite navigation for a while.
    GnssJam,
    /// No radio for a while.
    LinkLoss,
    MotorFail,
    /// A battery weakened by cold.
    BatteryCold,
    /// A battery with a dead cell.
    BatteryCell,
    /// A person walks through the working area.
    Person,
    /// An aircraft flies over the working area.
    Aircraft,
}

/// The title of a threat, from its name in files; `None` if there is none.
pub fn threat_title(name: &str) -> Option<Text> {
    Standard::named(name).map(Standard::title)
}

impl Standard {
    /// All injects by their names in files.
    pub const ALL: [(&str, Self); 9] = [
        ("gust", Self::Gust),
        ("wind_shift", Self::WindShift),
        ("gnss_jam", Self::GnssJam),
        ("link_loss", Self::LinkLoss),
        ("motor_fail", Self::MotorFail),
        ("battery_cold", Self::BatteryCold),
        ("battery_cell", Self::BatteryCell),
        ("person", Self::Person),
        ("aircraft", Self::Aircraft),
    ];

    pub fn names() -> [&'static str; Self::ALL.len()] {
        Self::ALL.map(|(name, _)| name)
    }

    /// The inject's name in files.
    pub fn name(self) -> &'static str {
        let found = Self::ALL.iter().find(|(_, known)| *known == self);
        found.map_or("", |(name, _)| name)
    }

    /// The inject with this name; `None` if there is none.
    pub fn named(name: &str) -> Option<Self> {
        let found = Self::ALL.iter().find(|(known, _)| *known == name);
        found.map(|(_, standard)| *standard)
    }

    /// The inject's title, for display.
    pub fn title(self) -> Text {
        match self {
            Self::Gust => text!("threat-gust"),
            Self::WindShift => text!("threat-wind-shift"),
            Self::GnssJam => text!("threat-gnss-jam"),
            Self::LinkLoss => text!("threat-link-loss"),
            Self::MotorFail => text!("threat-motor-fail"),
            Self::BatteryCold => text!("threat-battery-cold"),
            Self::BatteryCell => text!("threat-battery-cell"),
            Self::Person => text!("threat-person"),
            Self::Aircraft => text!("threat-aircraft"),
        }
    }

    pub(super) fn actions(self, mission: &Mission) -> Vec<Action> {
        let deed = self.deed(mission);
        // The telemetry shows faults on board, so they need no notice.
        if matches!(deed, Action::Fault(_)) {
            return vec![deed];
        }
        let level = match self {
            Self::Person | Self::Aircraft => AlertLevel::Critical,
            Self::Gust
            | Self::WindShift
            | Self::GnssJam
            | Self::LinkLoss
            | Self::MotorFail
            | Self::BatteryCold
            | Self::BatteryCell => AlertLevel::Warning,
        };
        let told = Action::Alert {
            level,
            text: self.title(),
            ok: None,
            within: level.usual_limit(),
            about: None,
        };
        vec![deed, told]
    }

    fn deed(self, mission: &Mission) -> Action {
        let more_wind = |element, more, lasts| {
            Action::Weather(Change {
                element,
                to: Target::More(more),
                ramp: Duration::from_secs(4),
                lasts,
            })
        };
        let fault = |kind, to, lasts| {
            Action::Fault(Fault {
                kind,
                victim: Victim::Chance,
                to,
                lasts,
            })
        };
        match self {
            Self::Gust => more_wind(Element::WindSpeed, 7.0, Some(WHILE)),
            Self::WindShift => more_wind(Element::WindDirection, 60.0, None),
            Self::GnssJam => fault(FaultKind::Gps, 1.0, Some(WHILE)),
            Self::LinkLoss => fault(FaultKind::Link, 1.0, Some(WHILE)),
            Self::MotorFail => fault(FaultKind::Motor, 0.75, None),
            Self::BatteryCold => fault(FaultKind::Battery, 0.94, None),
            Self::BatteryCell => fault(FaultKind::Battery, 0.88, None),
            Self::Person => Action::Spawn(passer_by(mission)),
            Self::Aircraft => Action::Spawn(overflight(mission)),
        }
    }
}

fn passer_by(mission: &Mission) -> Spawn {
    let [east, north] = place_of_work(mission);
    Spawn {
        id: PERSON.to_owned(),
        kind: MoverKind::Person,
        callsign: String::new(),
        path: vec![[east - WALK_M, north], [east + WALK_M, north]],
        speed_m_s: 1.2,
        height_m: 0.0,
        keep_out_m: 15.0,
        jitter_m: 5.0,
    }
}

fn overflight(mission: &Mission) -> Spawn {
    let [east, north] = place_of_work(mission);
    Spawn {
        id: AIRCRAFT.to_owned(),
        kind: MoverKind::Aircraft,
        callsign: "AIRCRAFT".to_owned(),
        path: vec![[east - APPROACH_M, north], [east + APPROACH_M, north]],
        speed_m_s: 30.0,
        height_m: 80.0,
        keep_out_m: 60.0,
        jitter_m: 20.0,
    }
}

/// The centre of the first task zone, or the first pad.
fn place_of_work(mission: &Mission) -> Point {
    let mut tasks = mission.site.zones.iter();
    let task = tasks.find(|zone| zone.kind == crate::mission::zone::ZoneKind::Task);
    let middle = task.map(|zone| {
        let (low, high) = zone.shape.bounds();
        [
            f64::midpoint(low[0], high[0]),
            f64::midpoint(low[1], high[1]),
        ]
    });
    middle
        .or_else(|| mission.seats.pads.first().copied())
        .unwrap_or_default()
}
