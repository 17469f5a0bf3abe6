//! A mission's needs of the drones that fly it, and whether a design meets them.

use std::time::Duration;

use super::event::Action;
use super::fleet::{DROPPER, TANK_S};
use super::ground_truth::Load;
use super::report::distance_m;
use super::sensor::Sensor;
use super::world::World;
use super::zone::ZoneKind;
use super::{Mission, Point};
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::workshop::{Air, Design, Figures, GOOD_THRUST, LEAST_THRUST, Part, part};

/// Ways are not straight, and wind and headings are not known: what reaches this much farther is enough.
const REACH: f64 = 1.3;
/// The height at which missions are flown, unless they are to be flown lower.
const USUAL_HEIGHT_M: f64 = 20.0;
/// In more wind than this, gusts want the thrust of [`GUSTY_THRUST`].
const CALM_M_S: f64 = 3.0;
/// Thrust over weight that holds a position, and that holds it in gusts without saturating motors.
const CALM_THRUST: f64 = LEAST_THRUST;
const GUSTY_THRUST: f64 = GOOD_THRUST;

/// What some seats of a mission need of their drones.
#[derive(Debug, Clone, PartialEq)]
pub struct Need {
    /// Which seats, by the numbers of their vehicles.
    pub seats: Vec<VehicleId>,
    /// Parts that measure and see, by id.
    pub sensors: Vec<&'static str>,
    /// Parts that are let go of, sprayed, or needed for that, by id and number.
    pub loads: Vec<(&'static str, u32)>,
    /// How far it has to reach, there and back: the farthest point of the task and 30 % more, in metres.
    pub reach_m: f64,
    /// How far it has to be heard: the farthest point of the task, in metres.
    pub far_m: f64,
    /// At this height above the ground, in metres.
    pub height_m: f64,
    /// The strongest wind to hold, in m/s.
    pub wind_m_s: f64,
    /// How long it should stay in the air.
    pub time: Duration,
    /// Battery to land with, in percent.
    pub reserve_percent: f64,
    /// What it flies in.
    pub air: Air,
    /// A seat's share of the budget, in credits, where there is one.
    pub credits: Option<u32>,
}

/// One thing that is needed, and how a design stands to it.
#[derive(Debug, Clone, PartialEq)]
pub struct FitLine {
    pub what: Text,
    /// How much of it, with its unit.
    pub required: Text,
    /// What the design has.
    pub has: Text,
    /// Whether that is enough.
    pub met: bool,
    /// Whether the task cannot be done as it is; else it is only risky or slow.
    pub is_block: bool,
}

impl Mission {
    /// What it needs of drones that are built for it, in the order of its seats; seats that need the same are together.
    pub fn needs(&self) -> Vec<Need> {
        let mut needs: Vec<Need> = Vec::new();
        let far_m = self.farthest_m();
        for (vehicle, asked) in (1..).zip(&self.asked) {
            let need = Need {
                seats: vec![vehicle],
                sensors: asked.sensors.iter().map(|sensor| sensor.id).collect(),
                loads: parts(asked.loads.iter().map(|(load, count)| (*load, *count))),
                reach_m: far_m * REACH,
                far_m,
                height_m: USUAL_HEIGHT_M.min(self.max_height_m),
                wind_m_s: self.strongest_wind_m_s(),
                time: self.scoring.par_time,
                reserve_percent: self.land_reserve_percent,
                air: self.air(),
                credits: self.outlay.budget.map(|all| all / self.vehicles as u32),
            };
            let alike = |it: &&mut Need| it.sensors == need.sensors && it.loads == need.loads;
            match needs.iter_mut().find(alike) {
                Some(known) => known.seats.push(vehicle),
                None => needs.push(need),
            }
        }
        needs
    }

    /// How far the farthest point of the task is from the farthest pad; where the file names none, the end of the fence.
    fn farthest_m(&self) -> f64 {
        let world = World::new(self, 0);
        let trackers = self.objectives.iter().map(|it| it.kind.start(&world));
        let seeded = trackers.flat_map(|tracker| tracker.places());
        let surveyed = self.objectives.iter().filter_map(|it| it.kind.survey());
        let cells = surveyed.flat_map(|plan| plan.cells.iter().map(|cell| cell.centre));
        let mut points: Vec<Point> = self.places.iter().map(|(_, at)| *at).collect();
        points.extend(seeded.map(|(_, at)| at).chain(cells));
        let zones = |wanted: fn(&ZoneKind) -> bool| {
            let mut of_kind = self.zones.iter().filter(move |zone| wanted(&zone.kind));
            let from = &self.pads;
            let mut far_m: f64 = 0.0;
            for zone in &mut of_kind {
                let each = from.iter().map(|&pad| zone.shape.farthest_m(pad));
                far_m = each.fold(far_m, f64::max);
            }
            far_m
        };
        let to_points = self.pads.iter().flat_map(|&pad| {
            let points = points.iter();
            points.map(move |&point| distance_m(pad, point))
        });
        let tasks_m = zones(|kind| matches!(kind, ZoneKind::Task));
        let far_m = to_points.fold(tasks_m, f64::max);
        if far_m > 0.0 {
            far_m
        } else {
            zones(|kind| matches!(kind, ZoneKind::Geofence { .. }))
        }
    }

    /// The mean wind with its gusts, or what events make of it.
    fn strongest_wind_m_s(&self) -> f64 {
        let mean_m_s = self.weather.wind.speed_m_s;
        let actions = self.events.iter().flat_map(|event| &event.actions);
        let later = actions.filter_map(|action| match action {
            Action::Weather(change) => change.wind_m_s(mean_m_s),
            Action::Say(_)
            | Action::Alert { .. }
            | Action::Zone(..)
            | Action::Spawn(_)
            | Action::Fault(_)
            | Action::Fail(_)
            | Action::Event(_) => None,
        });
        later.fold(mean_m_s, f64::max) + self.weather.gust_m_s
    }
}

/// The parts for some loads. Pieces hang on a dropper.
pub(super) fn parts(loads: impl Iterator<Item = (Load, u32)>) -> Vec<(&'static str, u32)> {
    let mut parts = Vec::new();
    let mut drops = false;
    for (load, count) in loads {
        drops |= load != Load::Spray;
        let pieces = match load {
            Load::Spray => count.div_ceil(TANK_S),
            Load::Ball | Load::Kit | Load::Node => count,
        };
        parts.push((load.part(), pieces));
    }
    if drops {
        parts.insert(0, (DROPPER, 1));
    }
    parts
}

impl Need {
    /// How a design stands to it: what has to be on board first, then what its figures have to be. Figures are missing
    /// as long as parts of the drive are.
    pub fn fit(&self, design: &Design) -> Vec<FitLine> {
        let sensors = self.sensors.iter().map(|id| sensor_line(design, id));
        let loads = self.loads.iter().map(|&(id, count)| {
            let pieces = design.pieces().filter(|(part, _)| part.id == id);
            mounted_line(id, pieces.map(|(_, pieces)| pieces).sum(), count)
        });
        let mut lines: Vec<FitLine> = sensors.chain(loads).collect();
        if let Some(figures) = design.figures(self.air) {
            lines.extend([
                self.radius(&figures),
                self.time(&figures),
                self.thrust(&figures),
            ]);
        }
        lines.push(self.link(design));
        lines.extend(self.cost(design));
        lines
    }

    fn radius(&self, figures: &Figures) -> FitLine {
        let has_m = figures.radius_m(self.wind_m_s);
        let wind = format!("{:.0}", self.wind_m_s);
        FitLine {
            what: text!("need-radius", wind = wind),
            required: metres(self.reach_m),
            has: metres(has_m),
            met: has_m >= self.reach_m,
            is_block: has_m < self.far_m,
        }
    }

    /// In the hover, down to the charge to land with.
    fn time(&self, figures: &Figures) -> FitLine {
        let share = 1.0 - self.reserve_percent / 100.0;
        let has_s = figures.hover_80_s * share / 0.8;
        FitLine {
            what: text!(
                "need-time",
                reserve = format!("{:.0}", self.reserve_percent)
            ),
            required: minutes(self.time.as_secs_f64()),
            has: minutes(has_s),
            met: has_s >= self.time.as_secs_f64(),
            is_block: false,
        }
    }

    fn thrust(&self, figures: &Figures) -> FitLine {
        let required = if self.wind_m_s > CALM_M_S {
            GUSTY_THRUST
        } else {
            CALM_THRUST
        };
        let has = figures.thrust_to_weight;
        FitLine {
            what: text!("need-thrust", wind = format!("{:.0}", self.wind_m_s)),
            required: Text::verbatim(format!("{required:.2}")),
            has: Text::verbatim(format!("{has:.2}")),
            met: has >= required,
            is_block: has < CALM_THRUST,
        }
    }

    fn link(&self, design: &Design) -> FitLine {
        let has_m = design.link(self.height_m).map(|link| link.range_m);
        FitLine {
            what: text!("need-link", height = format!("{:.0}", self.height_m)),
            required: metres(self.far_m),
            has: has_m.map_or_else(|| text!("need-none"), metres),
            met: has_m.is_some_and(|has_m| has_m >= self.far_m),
            is_block: has_m.is_none(),
        }
    }

    fn cost(&self, design: &Design) -> Option<FitLine> {
        let share = self.credits?;
        let credits = design.credits();
        Some(FitLine {
            what: text!("need-cost"),
            required: Text::verbatim(share.to_string()),
            has: Text::verbatim(credits.to_string()),
            met: credits <= share,
            // Another seat may be cheaper: the fleet as a whole has to keep within the budget.
            is_block: false,
        })
    }
}

/// A sensor, or one that does the same.
fn sensor_line(design: &Design, id: &'static str) -> FitLine {
    let wanted = Sensor::by_id(id);
    let does_it = |part: &Part| {
        let mounted = Sensor::by_id(part.id);
        mounted
            .zip(wanted)
            .is_some_and(|(one, wanted)| one.stands_in_for(wanted))
    };
    let fitting = design.pieces().filter(|(part, _)| does_it(part));
    mounted_line(id, fitting.map(|(_, pieces)| pieces).sum(), 1)
}

fn mounted_line(id: &'static str, has: u32, count: u32) -> FitLine {
    FitLine {
        what: part(id).map_or_else(|| Text::verbatim(id), Part::name),
        required: Text::verbatim(count.to_string()),
        has: Text::verbatim(has.to_string()),
        met: has >= count,
        // Pieces are taken on board again on the pad, but there has to be room for one.
        is_block: has == 0,
    }
}

fn metres(metres: f64) -> Text {
    Text::verbatim(if metres < 10_000.0 {
        format!("{metres:.0} m")
    } else {
        format!("{:.0} km", metres / 1000.0)
    })
}

fn minutes(seconds: f64) -> Text {
    Text::verbatim(format!("{:.1} min", seconds / 60.0))
}

#[cfg(test)]
mod tests;
