//! What a seat says of itself.

use serde::{Deserialize, Serialize};

use super::{FlownTry, Words};

/// A seat's state. Only the newest one matters.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct SeatReport {
    /// The name of the trainee's profile; empty without one.
    pub trainee: Words,
    /// The flight; `None` while the trainee flies nothing.
    pub flight: Option<FlightReport>,
    /// Whether the trainee sees what the desk shows to the class.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub looks_on: bool,
    /// The columns and rows of the trainee's terminal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub screen: Option<[u16; 2]>,
}

/// The state of a seat's flight. Ages are in seconds of the seat's clock, so the clocks of the machines do not matter.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FlightReport {
    /// The id of the mission; `None` in free flight and on vehicles of others.
    pub mission: Option<Words>,
    /// Whether the flight is an exam.
    pub exam: bool,
    /// The try of an exam that the desk has opened.
    #[serde(default, rename = "try", skip_serializing_if = "Option::is_none")]
    pub exam_try: Option<FlownTry>,
    /// How far the flight is.
    pub stage: Stage,
    /// The time since the start of the mission.
    pub clock_s: f64,
    /// The score if the mission ended now, 0 to 1000; `None` before the first takeoff and without a mission.
    pub score: Option<u16>,
    /// The number of objectives that are met.
    pub objectives_done: u16,
    /// The number of all objectives.
    pub objectives: u16,
    /// The number of objectives that can still be met.
    pub objectives_open: u16,
    /// The number of vehicles.
    pub vehicles: u16,
    /// The number of vehicles in the air.
    pub airborne: u16,
    /// The number of serious alerts that the trainee has not answered.
    pub alerts: u16,
    /// The age of the oldest of them.
    pub oldest_alert_s: Option<f64>,
    /// A collision or a broken fence that is near.
    pub danger: Option<Danger>,
    /// How often a vehicle did not carry out a command: it refused, did not answer, or had no effect to show.
    pub failures: u32,
    /// The least distance so far between two vehicles in the air, in metres.
    pub least_separation_m: Option<f64>,
    /// The workload: how many of the last 60 s the trainee was occupied, in percent.
    pub workload_percent: Option<u8>,
    /// The trainee's newest command; `None` before the first one.
    pub last_command: Option<LastCommand>,
    /// Whether a script or a program gives the commands.
    pub by_script: bool,
    /// The injects that the mission permits.
    #[serde(default)]
    pub injects: Vec<OfferedInject>,
    /// The injects that wait for their conditions.
    #[serde(default)]
    pub armed: Vec<ArmedInject>,
    /// The situations that were captured, in the order of their numbers.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub situations: Vec<CapturedSituation>,
    /// The vehicles that the instructor flies.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub taken: Vec<u16>,
}

impl FlightReport {
    /// The situation that is meant by its name, or by its number from 1.
    pub fn situation(&self, wanted: &Words) -> Option<&CapturedSituation> {
        let all = &self.situations;
        let named = all.iter().find(|it| it.name == *wanted);
        named.or_else(|| {
            let number: usize = wanted.as_str().parse().ok()?;
            all.get(number.checked_sub(1)?)
        })
    }
}

/// A situation of a flight that was captured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CapturedSituation {
    /// Its name in orders: its number, unless the instructor has given it one.
    pub name: Words,
    /// Whether the instructor has named it.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_named: bool,
    /// The time of the flight then, as in its [report](FlightReport::clock_s).
    pub clock_s: f64,
}

/// An inject that a mission permits.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct OfferedInject {
    /// Its name in orders.
    pub name: Words,
    /// What it does, in the language of the trainee.
    pub title: Words,
}

/// An inject that waits for its condition.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ArmedInject {
    /// Its name in orders.
    pub name: Words,
    /// The condition that triggers it.
    pub when: Words,
}

/// How far a flight is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stage {
    /// The trainee reads the brief, or the vehicles are starting.
    #[default]
    Reading,
    /// The trainee reads the brief, and the desk starts the mission.
    Held,
    /// The time of the flight passes.
    Flying,
    /// The trainee has paused the flight.
    Paused,
    /// The desk has frozen the flight.
    Frozen,
    /// The mission is over.
    Over,
}

/// An event that must be averted within seconds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Danger {
    /// What must be averted.
    pub kind: DangerKind,
    /// The time until then, in seconds; 0 if it has happened already.
    pub in_s: f64,
}

/// What a [`Danger`] is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DangerKind {
    /// Two vehicles come closer to each other than allowed.
    Collision,
    /// A vehicle leaves the mission's fence.
    Fence,
}

/// A command and its age.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LastCommand {
    /// The line as the trainee gave it.
    pub line: Words,
    /// The time since it was given, in seconds.
    pub age_s: f64,
}
