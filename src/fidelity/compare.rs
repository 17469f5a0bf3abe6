//! Two flights with the same commands, manoeuvre by manoeuvre.

use serde::Serialize;

use super::answers::Answers;
use super::{Aim, Manoeuvre, Observed};
use crate::geo::maths;
use crate::geo::wrap_180;

/// The interval between the points of a comparison, in seconds.
const EVERY_S: f64 = 0.1;
/// A vehicle slower than this counts as stationary, in m/s.
const STANDS_M_S: f64 = 0.2;
/// How long a stationary vehicle is still compared, in seconds.
const REST_S: f64 = 2.0;
/// A place counts as reached within this distance, in metres.
const NEAR_M: f64 = 1.0;
/// A height counts as reached within this difference, in metres.
const NEAR_HEIGHT_M: f64 = 0.5;
/// A heading counts as reached within this difference, in degrees.
const NEAR_DEG: f64 = 2.0;
/// A velocity counts as reached within this share of the change.
const NEAR_SHARE: f64 = 0.1;
/// Changes of velocity up to this, in m/s, are not counted.
const CHANGE_M_S: f64 = 0.5;

/// Root-mean-square and largest difference of one quantity.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Difference {
    /// Root of the mean square of the difference.
    pub rms: f64,
    pub largest: f64,
}

/// One manoeuvre of both vehicles.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Flight {
    /// The name of the commanded manoeuvre.
    pub name: String,
    /// The time of the command, in seconds since the recording began.
    pub at_s: f64,
    /// The compared duration: until both vehicles are stationary, or the next manoeuvre begins.
    pub compared_s: f64,
    /// The real vehicle's highest speed, in m/s.
    pub top_speed_m_s: f64,
    /// The distance between the vehicles at the beginning, in metres; the differences below leave
    /// it out.
    pub apart_at_start_m: f64,
    /// Distance between the vehicles, in metres.
    pub position_m: Difference,
    /// Difference in height, in metres.
    pub altitude_m: Difference,
    /// Length of the difference of the velocities, in m/s.
    pub velocity_m_s: Difference,
    pub roll_deg: Difference,
    pub pitch_deg: Difference,
    pub yaw_deg: Difference,
    pub voltage_v: Difference,
    /// The time that the real vehicle took to reach the aim, in seconds; `None` if it never did, or
    /// was there from the start.
    pub recorded_reach_s: Option<f64>,
    /// The time that the simulated vehicle took to reach the aim, in seconds; `None` if it never
    /// did, or was there from the start.
    pub simulated_reach_s: Option<f64>,
}

impl Flight {
    /// How much later the simulated vehicle reached the aim than the real one, in percent; `None`
    /// if one of them has no such time.
    pub fn later_percent(&self) -> Option<f64> {
        let (real, simulated) = self.recorded_reach_s.zip(self.simulated_reach_s)?;
        (real > 0.0).then(|| (simulated - real) / real * 100.0)
    }
}

/// Two flights with the same commands.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Comparison {
    /// The manoeuvres in order.
    pub manoeuvres: Vec<Flight>,
    /// The answers since the position was known: acks, texts, modes, reached.
    pub answers: Vec<Answers>,
}

/// Compares two flights with the same commands.
pub fn compare(manoeuvres: &[Manoeuvre], real: &Observed, simulated: &Observed) -> Comparison {
    let from_s = real.begin_s();
    let kinds = [
        ("acks", &real.acks, &simulated.acks),
        ("modes", &real.modes, &simulated.modes),
        ("texts", &real.texts, &simulated.texts),
        ("reached", &real.reached, &simulated.reached),
    ];
    Comparison {
        manoeuvres: manoeuvres
            .iter()
            .filter_map(|manoeuvre| ManoeuvrePair::new(manoeuvre, real, simulated)?.flight())
            .collect(),
        answers: kinds
            .map(|(kind, real, simulated)| Answers::new(kind, from_s, real, simulated))
            .into(),
    }
}

struct ManoeuvrePair<'a> {
    manoeuvre: &'a Manoeuvre,
    real: &'a Observed,
    simulated: &'a Observed,
    /// The simulated vehicle's position relative to the real one's at the beginning.
    offset_m: [f64; 3],
    to_s: f64,
}

impl<'a> ManoeuvrePair<'a> {
    fn new(manoeuvre: &'a Manoeuvre, real: &'a Observed, simulated: &'a Observed) -> Option<Self> {
        let at = |observed: &Observed| observed.position_ned_m.at(manoeuvre.from_s);
        let mut pair = Self {
            manoeuvre,
            real,
            simulated,
            offset_m: minus(at(simulated)?, at(real)?),
            to_s: manoeuvre.to_s,
        };
        let moves = |at_s: &f64| pair.moves(real, *at_s) || pair.moves(simulated, *at_s);
        let rest_s = pair.times().rev().find(moves).unwrap_or(manoeuvre.from_s) + REST_S;
        pair.to_s = rest_s.min(manoeuvre.to_s);
        Some(pair)
    }

    fn times(&self) -> impl DoubleEndedIterator<Item = f64> + use<> {
        let count = ((self.to_s - self.manoeuvre.from_s) / EVERY_S) as u32;
        let from_s = self.manoeuvre.from_s;
        (0..=count).map(move |place| from_s + f64::from(place) * EVERY_S)
    }

    fn moves(&self, observed: &Observed, at_s: f64) -> bool {
        let fast = observed
            .velocity_ned_m_s
            .at(at_s)
            .is_some_and(|velocity| length(velocity) > STANDS_M_S);
        let heading = |at_s| observed.attitude_deg.at(at_s).map(|angles| angles[2]);
        let turning = heading(at_s)
            .zip(heading(self.to_s.min(observed.end_s() - EVERY_S)))
            .is_some_and(|(now, last)| (now - last).abs() > NEAR_DEG);
        fast || turning
    }

    fn flight(&self) -> Option<Flight> {
        let mut tally = Tally::default();
        let mut top_speed_m_s: f64 = 0.0;
        for at_s in self.times() {
            let velocity = self.real.velocity_ned_m_s.at(at_s);
            top_speed_m_s = top_speed_m_s.max(velocity.map_or(0.0, length));
            self.note(at_s, &mut tally);
        }
        let [
            position_m,
            altitude_m,
            velocity_m_s,
            roll_deg,
            pitch_deg,
            yaw_deg,
            voltage_v,
        ] = tally.differences()?;
        Some(Flight {
            name: self.manoeuvre.name.clone(),
            at_s: self.manoeuvre.from_s,
            compared_s: self.to_s - self.manoeuvre.from_s,
            top_speed_m_s,
            apart_at_start_m: length(self.offset_m),
            position_m,
            altitude_m,
            velocity_m_s,
            roll_deg,
            pitch_deg,
            yaw_deg,
            voltage_v,
            recorded_reach_s: self.reach_s(self.real),
            simulated_reach_s: self.reach_s(self.simulated),
        })
    }

    /// Adds the differences at one time, if the states of both vehicles are known around it.
    fn note(&self, at_s: f64, tally: &mut Tally) {
        let (real, simulated) = (self.real, self.simulated);
        let place = real
            .position_ned_m
            .at(at_s)
            .zip(simulated.position_ned_m.at(at_s));
        if let Some((real, simulated)) = place {
            let apart = minus(minus(simulated, real), self.offset_m);
            tally.add(0, length(apart));
            tally.add(1, apart[2]);
        }
        let velocity = real
            .velocity_ned_m_s
            .at(at_s)
            .zip(simulated.velocity_ned_m_s.at(at_s));
        if let Some((real, simulated)) = velocity {
            tally.add(2, length(minus(simulated, real)));
        }
        let attitude = real
            .attitude_deg
            .at(at_s)
            .zip(simulated.attitude_deg.at(at_s));
        if let Some((real, simulated)) = attitude {
            let apart = minus(simulated, real);
            tally.add(3, apart[0]);
            tally.add(4, apart[1]);
            tally.add(5, wrap_180(apart[2]));
        }
        if let Some(([real], [simulated])) =
            real.voltage_v.at(at_s).zip(simulated.voltage_v.at(at_s))
        {
            tally.add(6, simulated - real);
        }
    }

    /// The time that a vehicle took to reach the aim; `None` if it never did, or was there from the start.
    fn reach_s(&self, observed: &Observed) -> Option<f64> {
        let Manoeuvre { from_s, to_s, .. } = *self.manoeuvre;
        if self.manoeuvre.aim == Aim::Landed {
            let mut after = observed.armed.iter().filter(|(at, _)| *at > from_s);
            let (at, _) = after
                .find(|(_, armed)| !armed)
                .filter(|(at, _)| *at <= to_s)?;
            return Some(at - from_s);
        }
        if let Aim::Told(words) = self.manoeuvre.aim {
            let mut after = observed.texts.iter().filter(|said| said.at_s > from_s);
            let said = after
                .find(|said| said.text.contains(words))
                .filter(|said| said.at_s <= to_s)?;
            return Some(said.at_s - from_s);
        }
        let goal = self.goal()?;
        let steps = ((self.to_s - from_s) / STEP_S) as u32;
        let there = (0..=steps)
            .map(|step| from_s + f64::from(step) * STEP_S)
            .find(|at_s| goal.reached(observed, *at_s) == Some(true))?;
        (there > from_s).then_some(there - from_s)
    }

    /// The criterion for reaching the aim, for both vehicles; `None` if the aim cannot be
    /// determined.
    fn goal(&self) -> Option<ManoeuvreGoal> {
        let known_s = self.real.position_ned_m.last()?.0;
        let asked_s = self.manoeuvre.last_asked_s.min(known_s);
        Some(match self.manoeuvre.aim {
            Aim::Height(height) => ManoeuvreGoal::Height(height),
            Aim::Place(place) => ManoeuvreGoal::Place(place),
            Aim::Heading => ManoeuvreGoal::Heading(self.real.attitude_deg.at(asked_s)?[2]),
            Aim::Velocity | Aim::Landed | Aim::Told(_) => {
                let wanted = self.real.velocity_ned_m_s.at(asked_s)?;
                let before = self.real.velocity_ned_m_s.at(self.manoeuvre.from_s)?;
                let change = length(minus(wanted, before));
                (change > CHANGE_M_S)
                    .then_some(ManoeuvreGoal::Velocity(wanted, NEAR_SHARE * change))?
            }
        })
    }
}

enum ManoeuvreGoal {
    Height(f64),
    Place([f64; 3]),
    Heading(f64),
    /// A velocity, with its tolerance.
    Velocity([f64; 3], f64),
}

impl ManoeuvreGoal {
    fn reached(&self, observed: &Observed, at_s: f64) -> Option<bool> {
        let position = observed.position_ned_m.at(at_s)?;
        Some(match *self {
            Self::Height(height) => height + position[2] < NEAR_HEIGHT_M,
            Self::Place(place) => length(minus(position, place)) < NEAR_M,
            Self::Heading(heading) => {
                let yaw = observed.attitude_deg.at(at_s)?[2];
                wrap_180(yaw - heading).abs() < NEAR_DEG
            }
            Self::Velocity(wanted, near) => {
                length(minus(observed.velocity_ned_m_s.at(at_s)?, wanted)) < near
            }
        })
    }
}

/// The resolution in seconds of the times at which an aim is reached.
const STEP_S: f64 = 0.02;
const QUANTITIES: usize = 7;

/// Squares and maxima of the differences so far, by quantity.
#[derive(Default)]
struct Tally {
    count: [f64; QUANTITIES],
    squares: [f64; QUANTITIES],
    largest: [f64; QUANTITIES],
}

impl Tally {
    fn add(&mut self, quantity: usize, difference: f64) {
        self.count[quantity] += 1.0;
        self.squares[quantity] += difference * difference;
        self.largest[quantity] = self.largest[quantity].max(difference.abs());
    }

    /// The differences; `None` if the vehicles were never observed at the same time.
    fn differences(&self) -> Option<[Difference; QUANTITIES]> {
        (self.count[0] > 0.0).then(|| {
            std::array::from_fn(|quantity| Difference {
                rms: (self.squares[quantity] / self.count[quantity].max(1.0)).sqrt(),
                largest: self.largest[quantity],
            })
        })
    }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn length(v: [f64; 3]) -> f64 {
    maths::hypot(maths::hypot(v[0], v[1]), v[2])
}
