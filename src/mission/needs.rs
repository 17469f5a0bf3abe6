//! The needs of a mission for its vehicles, and whether a design meets them.

use std::time::Duration;

use super::event::Action;
use super::fleet::{DROPPER, FLAIL, TANK_S};
use super::ground_truth::Load;
use super::report::distance_m;
use super::sensor::Sensor;
use super::world::World;
use super::zone::ZoneKind;
use super::{Mission, Point};
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::workshop::{
    Air, Design, DesignKind, Figures, GOOD_THRUST, LEAST_THRUST, Part, Performance, part,
};

/// The margin on the range: paths are not straight, and wind and headings are unknown.
const REACH: f64 = 1.3;
/// The usual height of a flight, unless the mission sets a lower one.
pub(super) const USUAL_HEIGHT_M: f64 = 20.0;
/// Wind above this has gusts that need [`GUSTY_THRUST`].
const CALM_M_S: f64 = 3.0;
/// The thrust-to-weight ratio needed to hold a position.
const CALM_THRUST: f64 = LEAST_THRUST;
/// The ratio needed to hold a position in gusts without saturating the motors.
const GUSTY_THRUST: f64 = GOOD_THRUST;

/// The needs of some seats of a mission.
#[derive(Debug, Clone, PartialEq)]
pub struct Need {
    /// The seats, by vehicle number.
    pub seats: Vec<VehicleId>,
    /// The kind of vehicle that the seats take.
    pub kind: DesignKind,
    pub sensors: Vec<&'static str>,
    /// Loads, and the parts that release or spray them, by id and count.
    pub loads: Vec<(&'static str, u32)>,
    /// The required range of a flight out and back, as a one-way distance in metres: the distance
    /// to the farthest point of the task plus 30 %.
    pub reach_m: f64,
    /// The required radio range: the distance to the farthest point of the task, in metres.
    pub far_m: f64,
    /// The height for both ranges, above the ground, in metres.
    pub height_m: f64,
    /// The strongest wind in which to hold a position, in m/s.
    pub wind_m_s: f64,
    pub time: Duration,
    /// The battery required at landing, in percent.
    pub reserve_percent: f64,
    /// The air at the site.
    pub air: Air,
    /// A seat's share of the budget in credits; `None` without a budget.
    pub credits: Option<u32>,
}

/// One need, compared with a design.
#[derive(Debug, Clone, PartialEq)]
pub struct FitLine {
    pub what: Text,
    /// The required value with its unit.
    pub required: Text,
    pub has: Text,
    /// Whether the design meets the need.
    pub met: bool,
    /// Whether the task is impossible if the need is not met; otherwise it is only risky or slow.
    pub is_block: bool,
}

impl Mission {
    /// The needs that built vehicles must meet, in the order of the seats; seats with the same needs share an entry.
    pub fn needs(&self) -> Vec<Need> {
        let mut needs: Vec<Need> = Vec::new();
        let far_m = self.farthest_m();
        let seats = (1..).zip(&self.seats.asked).zip(self.seat_kinds());
        for ((vehicle, asked), kind) in seats {
            let loads = parts(asked.loads.iter().map(|(load, count)| (*load, *count)));
            let flail = asked.flail.then_some((FLAIL, 1));
            let need = Need {
                seats: vec![vehicle],
                kind,
                sensors: asked.sensors.iter().map(|sensor| sensor.id).collect(),
                loads: loads.into_iter().chain(flail).collect(),
                reach_m: far_m * REACH,
                far_m,
                height_m: match kind {
                    DesignKind::Drone => USUAL_HEIGHT_M.min(self.rules.max_height_m),
                    DesignKind::Robot | DesignKind::Boat => 0.0,
                },
                wind_m_s: self.strongest_wind_m_s(),
                time: self.scoring.par_time,
                reserve_percent: self.rules.land_reserve_percent,
                air: self.air(),
                credits: self
                    .seats
                    .outlay
                    .budget
                    .map(|all| all / self.seats.count.max(1) as u32),
            };
            let alike = |it: &&mut Need| {
                it.kind == need.kind && it.sensors == need.sensors && it.loads == need.loads
            };
            match needs.iter_mut().find(alike) {
                Some(known) => known.seats.push(vehicle),
                None => needs.push(need),
            }
        }
        needs
    }

    /// Why the built vehicles cannot do the tasks of their seats: a text for each design and each need that it does not
    /// meet.
    pub fn misfits(&self) -> Vec<Text> {
        let designs = self.designs();
        let design_of = |vehicle: VehicleId| designs.get(usize::from(vehicle) - 1).copied()?;
        let mut misfits = Vec::new();
        for need in self.needs() {
            let mut seats = need.seats.clone();
            while let Some(&first) = seats.first() {
                let design = design_of(first);
                let (alike, others) = seats.into_iter().partition(|&it| design_of(it) == design);
                seats = others;
                misfits.extend(design.into_iter().flat_map(|it| need.misfits(it, &alike)));
            }
        }
        misfits
    }

    /// The greatest distance from a pad to a point of the task; without such points, to the edge of the fence.
    fn farthest_m(&self) -> f64 {
        let world = World::new(self, 0);
        let trackers = self.objectives.iter().map(|it| it.kind.start(&world));
        let seeded = trackers.flat_map(|tracker| tracker.places());
        let surveyed = self.objectives.iter().filter_map(|it| it.kind.survey());
        let cells = surveyed.flat_map(|plan| plan.cells.iter().map(|cell| cell.centre));
        let mut points: Vec<Point> = self.site.places.iter().map(|(_, at)| *at).collect();
        points.extend(seeded.map(|(_, at)| at).chain(cells));
        let zones = |wanted: fn(&ZoneKind) -> bool| {
            let mut of_kind = self
                .site
                .zones
                .iter()
                .filter(move |zone| wanted(&zone.kind));
            let from = &self.seats.pads;
            let mut far_m: f64 = 0.0;
            for zone in &mut of_kind {
                let each = from.iter().map(|&pad| zone.shape.farthest_m(pad));
                far_m = each.fold(far_m, f64::max);
            }
            far_m
        };
        let to_points = self.seats.pads.iter().flat_map(|&pad| {
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

    /// The strongest mean wind, at the start or after an event, with the gusts.
    fn strongest_wind_m_s(&self) -> f64 {
        let mean_m_s = self.site.weather.wind.speed_m_s;
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
        later.fold(mean_m_s, f64::max) + self.site.weather.gust_m_s
    }
}

/// The parts for these loads. Loads counted in pieces need a dropper.
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
    /// Compares a design: required equipment first, then required figures. Figures are left out while parts of the
    /// drive are missing. With another kind of vehicle, nothing else is compared.
    pub fn fit(&self, design: &Design) -> Vec<FitLine> {
        if design.kind() != self.kind && !design.is_empty() {
            return vec![FitLine {
                what: text!("need-kind"),
                required: self.kind.name(),
                has: design.kind().name(),
                met: false,
                is_block: true,
            }];
        }
        let sensors = self.sensors.iter().map(|id| sensor_line(design, id));
        let loads = self.loads.iter().map(|&(id, count)| {
            let pieces = design.pieces().filter(|(part, _)| part.id == id);
            mounted_line(id, pieces.map(|(_, pieces)| pieces).sum(), count)
        });
        let mut lines: Vec<FitLine> = sensors.chain(loads).collect();
        match design.performance(self.air) {
            Some(Performance::Flight(figures)) => lines.extend([
                self.radius(figures.radius_m(self.wind_m_s)),
                self.time(figures.hover_80_s),
                self.thrust(&figures),
            ]),
            Some(Performance::Drive(figures)) => lines.extend([
                self.radius(figures.radius_m()),
                self.time(figures.drive_80_s),
            ]),
            None => {}
        }
        lines.push(self.link(design));
        lines.extend(self.cost(design));
        lines
    }

    /// Why a design cannot do the task of some seats.
    fn misfits(&self, design: &Design, seats: &[VehicleId]) -> Vec<Text> {
        let blocks = self.fit(design).into_iter().filter(|line| line.is_block);
        let vehicles: Vec<String> = seats.iter().map(ToString::to_string).collect();
        let misfit = |line: FitLine| {
            text!(
                "fleet-misfit",
                design = design.name.as_str(),
                count = seats.len(),
                vehicles = vehicles.join(", "),
                what = line.what,
                has = line.has,
                required = line.required
            )
        };
        blocks.map(misfit).collect()
    }

    fn radius(&self, has_m: f64) -> FitLine {
        let wind = format!("{:.0}", self.wind_m_s);
        FitLine {
            what: match self.kind {
                DesignKind::Drone => text!("need-radius", wind = wind),
                DesignKind::Robot | DesignKind::Boat => text!("need-drive-radius"),
            },
            required: metres(self.reach_m),
            has: metres(has_m),
            met: has_m >= self.reach_m,
            is_block: has_m < self.far_m,
        }
    }

    /// Compares the hover or driving time down to the reserve, by that to 20 %.
    fn time(&self, until_80_s: f64) -> FitLine {
        let share = 1.0 - self.reserve_percent / 100.0;
        let has_s = until_80_s * share / 0.8;
        let reserve = format!("{:.0}", self.reserve_percent);
        FitLine {
            what: match self.kind {
                DesignKind::Drone => text!("need-time", reserve = reserve),
                DesignKind::Robot | DesignKind::Boat => {
                    text!("need-drive-time", reserve = reserve)
                }
            },
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
            what: match self.kind {
                DesignKind::Drone => text!("need-link", height = format!("{:.0}", self.height_m)),
                DesignKind::Robot | DesignKind::Boat => text!("need-ground-link"),
            },
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
            what: match self.kind {
                DesignKind::Drone => text!("need-cost"),
                DesignKind::Robot | DesignKind::Boat => text!("need-vehicle-cost"),
            },
            required: Text::verbatim(share.to_string()),
            has: Text::verbatim(credits.to_string()),
            met: credits <= share,
            // Another seat may cost less: only the whole fleet must keep within the budget.
            is_block: false,
        })
    }
}

/// Compares a sensor; a design may carry another sensor that can replace it.
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
        // Pieces are reloaded on the pad, but there must be room for one.
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
