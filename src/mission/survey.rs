//! A survey: a grid of cells to sample with a sensor.

use super::craft::Craft;
use super::sensor::{ProbeSpec, Sensor};
use super::{Point, TICK};
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// A survey as the mission defines it.
#[derive(Debug, Clone)]
pub(crate) struct SurveyPlan {
    /// The id of its objective.
    pub id: String,
    pub cells: Vec<CellPlan>,
    pub side_m: f64,
    pub sensor: &'static Sensor,
    pub probe: &'static ProbeSpec,
    pub dwell_s: f64,
    pub max_speed_m_s: f64,
    /// The lowest and the highest valid height, above the origin.
    pub heights_m: [f64; 2],
}

/// A cell of a survey.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CellPlan {
    pub name: String,
    pub centre: Point,
}

/// The progress of a survey.
#[derive(Debug, Clone)]
pub(crate) struct Survey {
    pub plan: SurveyPlan,
    cells: Vec<CellLog>,
}

#[derive(Debug, Clone, Copy, Default)]
struct CellLog {
    ticks: u32,
    sum: f64,
}

impl Survey {
    pub fn new(plan: &SurveyPlan) -> Self {
        Self {
            cells: vec![CellLog::default(); plan.cells.len()],
            plan: plan.clone(),
        }
    }

    /// Whether a vehicle at this place, height and speed samples an unfinished cell.
    pub fn wants(&self, at: Point, height_m: f64, speed_m_s: f64) -> bool {
        let cell = self.cell_under(at, height_m, speed_m_s);
        cell.is_some_and(|index| !self.is_sampled(index))
    }

    /// Counts one tick of a vehicle; returns the index of the cell that this completes, if any.
    pub fn step(&mut self, at: Point, height_m: f64, speed_m_s: f64, shown: f64) -> Option<usize> {
        let index = self.cell_under(at, height_m, speed_m_s)?;
        let before = self.is_sampled(index);
        let cell = &mut self.cells[index];
        cell.ticks += 1;
        cell.sum += shown;
        (!before && self.is_sampled(index)).then_some(index)
    }

    /// The cell that a vehicle is in, if its height and speed are valid.
    fn cell_under(&self, at: Point, height_m: f64, speed_m_s: f64) -> Option<usize> {
        let [low, high] = self.plan.heights_m;
        if !(low..=high).contains(&height_m)
            || !(0.0..=self.plan.max_speed_m_s).contains(&speed_m_s)
        {
            return None;
        }
        let half = self.plan.side_m / 2.0;
        let inside = |cell: &CellPlan| {
            (at[0] - cell.centre[0]).abs() <= half && (at[1] - cell.centre[1]).abs() <= half
        };
        self.plan.cells.iter().position(inside)
    }

    /// The time for which a cell has been sampled, in seconds.
    pub fn dwell_s(&self, index: usize) -> f64 {
        f64::from(self.cells[index].ticks) * TICK.as_secs_f64()
    }

    /// Whether a cell has been sampled for long enough.
    pub fn is_sampled(&self, index: usize) -> bool {
        self.dwell_s(index) >= self.plan.dwell_s - 1e-9
    }

    /// The number of sampled cells.
    pub fn sampled(&self) -> usize {
        (0..self.cells.len())
            .filter(|&index| self.is_sampled(index))
            .count()
    }

    /// The mean of a cell's readings, in the sensor's unit; `None` without readings.
    pub fn mean(&self, index: usize) -> Option<f64> {
        let cell = self.cells[index];
        (cell.ticks > 0).then(|| cell.sum / f64::from(cell.ticks))
    }
}

/// The surveys of one flight.
#[derive(Debug, Clone, Default)]
pub(crate) struct Surveys(Vec<Survey>);

impl Surveys {
    /// A survey for each plan.
    pub fn of<'p>(plans: impl Iterator<Item = &'p SurveyPlan>) -> Self {
        Self(plans.map(Survey::new).collect())
    }

    pub fn all(&self) -> &[Survey] {
        &self.0
    }

    /// Whether a vehicle samples an unfinished cell.
    pub fn want(&self, craft: &Craft) -> bool {
        let wants = |at| {
            let mut surveys = self.0.iter();
            surveys.any(|survey| survey.wants(at, craft.height_m, craft.speed_m_s))
        };
        craft.at.is_some_and(wants)
    }

    /// Counts one tick of all vehicles; reports each completed cell with its vehicle.
    pub fn step(&mut self, crafts: &[Craft], mut tell: impl FnMut(VehicleId, Text)) {
        for survey in &mut self.0 {
            for craft in crafts.iter().filter(|craft| craft.can_see()) {
                let mut probes = craft.probes.iter();
                let probe = probes.find(|probe| *probe.sensor == *survey.plan.sensor);
                let (Some(at), Some(probe)) = (craft.at, probe) else {
                    continue;
                };
                let sampled = survey.step(at, craft.height_m, craft.speed_m_s, probe.shown);
                if let Some(cell) = sampled {
                    let text = text!(
                        "mission-cell-sampled",
                        cell = &survey.plan.cells[cell].name,
                        count = survey.sampled(),
                        all = survey.plan.cells.len()
                    );
                    tell(craft.id, text);
                }
            }
        }
    }
}

/// `A`, `B`, .. `Z`, `AA`, .. for 0, 1, ..
pub(super) fn letters(mut column: usize) -> String {
    let mut name = String::new();
    loop {
        name.insert(0, char::from(b'A' + (column % 26) as u8));
        if column < 26 {
            return name;
        }
        column = column / 26 - 1;
    }
}
