//! Makes a plan for each vehicle from a task, for `plan survey` and for `draft survey`: where each
//! plan begins, its default height and spacing, and its fence. [`generate`] plans the routes.

use glam::DVec2;

use super::fitting::fitted;
use super::planner::SQUARE_TURNS;
use super::site::Site;
use super::{Conductor, Rules};
use crate::commands::{Datum, Ground, Pattern, PlanTask};
use crate::draft::rings;
use crate::geo::{LatLon, Outline};
use crate::plan::generate::{
    GenerateError, Idle, Manner, Task, USUAL_HEIGHT_M, USUAL_SECTOR_M, USUAL_TURNS, generate,
    source,
};
use crate::plan::pattern::square;
use crate::plan::{Document, Home, Item};
use crate::preflight::{idle_words, ungenerated};
use crate::text;
use crate::text::{Text, figure};
use crate::vehicle::{Vehicle, VehicleId, Vehicles};
use crate::vehicle_id::ranges;

impl Conductor {
    /// The plan of each target that has a part in the task. Plans begin and end where the vehicles
    /// stand, or at home for vehicles in the air; they stay inside the fence that the first target
    /// has switched on, and outside the areas `keep_out` and the holes of the area.
    ///
    /// # Errors
    /// A vehicle has no position, or the task has no plans.
    pub fn plans(
        &self,
        task: &PlanTask,
        targets: &[VehicleId],
        vehicles: &Vehicles,
        keep_out: &[Item],
    ) -> Result<DividedPlans, Text> {
        let team = TaskTeam::new(self.rules, targets, vehicles)?;
        let (task, height_m) = team.task(task)?;
        let cover = self.cover(&task, height_m);
        let manner = Manner {
            height_m,
            layer_m: self.rules.clearance().above_m,
            speed_m_s: None,
            fence: team.fence(&task, keep_out),
        };
        let plans = generate(&task, &team.homes, &manner).map_err(|error| {
            let number = match error {
                GenerateError::NoWay(vehicle) => targets.get(vehicle).copied(),
                GenerateError::NoVehicle
                | GenerateError::Empty
                | GenerateError::TooMany(_)
                | GenerateError::TooNarrow(_)
                | GenerateError::Fence
                | GenerateError::OutsideFence => None,
            };
            ungenerated(error, number.map(usize::from).unwrap_or_default())
        })?;
        let parts = plans.parts.into_iter();
        let named = parts.filter_map(|part| {
            let id = *targets.get(part.vehicle)?;
            Some((id, fitted(part.document, vehicles.get(&id)?)))
        });
        let idle = plans.idle.into_iter();
        let idle = idle.filter_map(|(vehicle, why)| Some((*targets.get(vehicle)?, why)));
        Ok(DividedPlans {
            plans: named.collect(),
            idle: idle.collect(),
            cover,
        })
    }

    /// The part of its area that a survey covers; `None` for other tasks, and without a sensor.
    fn cover(&self, task: &Task, height_m: f64) -> Option<Cover> {
        let Task::Survey { spacing_m, .. } = task else {
            return None;
        };
        let strip_m = self.rules.strip_m(height_m)?;
        Some(Cover {
            strip_m,
            spacing_m: *spacing_m,
        })
    }
}

/// How much of an area parallel lines cover.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cover {
    /// The width of the sensor's strip at the height of the lines, in metres.
    pub strip_m: f64,
    /// The line spacing in metres.
    pub spacing_m: f64,
}

impl Cover {
    fn words(self) -> Text {
        let share = (self.strip_m / self.spacing_m).min(1.0);
        text!(
            "outcome-plan-covers",
            percent = figure(100.0 * share, 0),
            strip = figure(self.strip_m, 1),
            spacing = figure(self.spacing_m, 1)
        )
    }
}

/// The plans into which a task was divided.
#[derive(Debug, Clone, PartialEq)]
pub struct DividedPlans {
    pub plans: Vec<(VehicleId, Document)>,
    /// The vehicles without a part.
    pub idle: Vec<(VehicleId, Idle)>,
    /// The part of the area that a survey covers, if it is known.
    pub cover: Option<Cover>,
}

impl DividedPlans {
    /// The number of vehicles with a part, and why the others have none; `None` if all have one.
    pub fn share_words(&self) -> Option<Text> {
        let (count, idle) = (self.plans.len(), self.idle.len());
        (idle > 0).then(|| {
            text!(
                "outcome-plan-share",
                count = count,
                all = count + idle,
                why = Text::joined("; ", self.idle_words())
            )
        })
    }

    /// The part of the area that a survey covers, before it is flown; `None` if it is unknown.
    pub fn cover_words(&self) -> Option<Text> {
        self.cover.map(Cover::words)
    }

    /// The vehicles without a part, and why they have none; empty if all have one.
    pub fn idle_words(&self) -> Vec<Text> {
        let of = |why: Idle| {
            let ids = self.idle.iter().filter(|(_, own)| *own == why);
            let ids: Vec<VehicleId> = ids.map(|(id, _)| *id).collect();
            let text = || {
                text!(
                    "plan-idle",
                    vehicles = ranges(ids.clone()),
                    reason = idle_words(why)
                )
            };
            (!ids.is_empty()).then(text)
        };
        Idle::ALL.into_iter().filter_map(of).collect()
    }
}

struct TaskTeam<'a> {
    rules: Rules,
    first: &'a Vehicle,
    homes: Vec<Home>,
    site: Site,
}

impl<'a> TaskTeam<'a> {
    fn new(rules: Rules, targets: &[VehicleId], vehicles: &'a Vehicles) -> Result<Self, Text> {
        let unheard = || text!("refused-not-heard");
        let all: Option<Vec<&Vehicle>> = targets
            .iter()
            .map(|id| vehicles.get(id).map(AsRef::as_ref))
            .collect();
        let all = all.ok_or_else(unheard)?;
        let first = *all.first().ok_or_else(unheard)?;
        let homes: Option<Vec<Home>> = all.iter().map(|vehicle| base(vehicle)).collect();
        let homes = homes.ok_or_else(|| text!("refused-no-position"))?;
        let origin = homes.first().map(|home| LatLon::from_e7(home.x, home.y));
        Ok(Self {
            rules,
            first,
            site: Site::new(origin.unwrap_or(LatLon::new(0.0, 0.0))),
            homes,
        })
    }

    /// The task with places on the earth, and its height.
    fn task(&self, task: &PlanTask) -> Result<(Task, f64), Text> {
        let height_m = task.up_m().unwrap_or(USUAL_HEIGHT_M);
        let spaced = |asked_m: &Option<f64>| self.spacing_m(*asked_m, height_m);
        let placed = match task {
            PlanTask::Survey {
                ground,
                spacing_m,
                course,
                ..
            } => Task::Survey {
                rings: self.rings(ground)?,
                spacing_m: spaced(spacing_m),
                course: *course,
            },
            PlanTask::Search {
                pattern,
                datum,
                radius_m,
                spacing_m,
                ..
            } => search(*pattern, self.place(*datum)?, *radius_m, spaced(spacing_m)),
            PlanTask::Line {
                points, spacing_m, ..
            } => Task::Line {
                points: points.clone(),
                spacing_m: spaced(spacing_m),
            },
            PlanTask::Orbit {
                centre,
                radius_m,
                turns,
                ..
            } => Task::Orbit {
                centre: self.place(*centre)?,
                radius_m: *radius_m,
                turns: turns.unwrap_or(USUAL_TURNS),
            },
        };
        Ok((placed, height_m))
    }

    fn spacing_m(&self, asked_m: Option<f64>, height_m: f64) -> f64 {
        asked_m.unwrap_or_else(|| self.rules.line_spacing_m(height_m))
    }

    fn place(&self, datum: Datum) -> Result<LatLon, Text> {
        let spot = self.site.spot(datum, self.first);
        let spot = spot.ok_or_else(|| text!("refused-no-position"))?;
        Ok(self.site.place(spot))
    }

    /// The outline of an area, and its holes.
    fn rings(&self, ground: &Ground) -> Result<Vec<Vec<LatLon>>, Text> {
        Ok(match ground {
            Ground::Outline(outline) => rings(outline),
            Ground::Between(from, to) => {
                let spot = |datum| self.place(datum).map(|place| self.site.flat(place));
                let (from, to) = (spot(*from)?, spot(*to)?);
                let corners = [
                    (from.x, from.y),
                    (to.x, from.y),
                    (to.x, to.y),
                    (from.x, to.y),
                ];
                let place = |corner: (f64, f64)| self.site.place(corner.into());
                vec![corners.map(place).to_vec()]
            }
            Ground::Around { centre, radius_m } => {
                let (centre, radius_m) = (self.place(*centre)?, *radius_m);
                vec![Outline::Circle { centre, radius_m }.corners()]
            }
        })
    }

    /// The fence of the first vehicle, if it is on and has been read, with the areas to stay out of: those given,
    /// otherwise the holes of the task's area.
    fn fence(&self, task: &Task, keep_out: &[Item]) -> Vec<Item> {
        let in_force = self.first.fence_in_force();
        let fence = in_force.map(|fence| fence.items.clone());
        let fence = fence.unwrap_or_default();
        match task {
            Task::Survey { rings, .. } if keep_out.is_empty() => {
                source::with_areas(fence, &source::holes(rings))
            }
            Task::Survey { .. }
            | Task::Square { .. }
            | Task::Sector { .. }
            | Task::Line { .. }
            | Task::Orbit { .. } => source::with_areas(fence, keep_out),
        }
    }
}

fn search(pattern: Pattern, datum: LatLon, radius_m: Option<f64>, spacing_m: f64) -> Task {
    match pattern {
        Pattern::Square => Task::Square {
            datum,
            spacing_m,
            radius_m: radius_m.unwrap_or(spacing_m * SQUARE_TURNS),
        },
        Pattern::Sector => Task::Sector {
            datum,
            radius_m: radius_m.unwrap_or(USUAL_SECTOR_M),
        },
    }
}

/// The outermost places of a task; empty if the positions of its vehicles are unknown.
pub fn outermost_places(
    task: &PlanTask,
    rules: Rules,
    targets: &[VehicleId],
    vehicles: &Vehicles,
) -> Vec<LatLon> {
    let team = TaskTeam::new(rules, targets, vehicles);
    let Ok((task, _)) = team.and_then(|team| team.task(task)) else {
        return Vec::new();
    };
    let around = |centre, radius_m| Outline::Circle { centre, radius_m }.corners();
    match task {
        Task::Survey { rings, .. } => rings.into_iter().next().unwrap_or_default(),
        Task::Square {
            datum,
            spacing_m,
            radius_m,
        } => square(spacing_m, radius_m)
            .into_iter()
            .map(|point| datum.moved(point.x, point.y))
            .collect(),
        Task::Sector { datum, radius_m } => around(datum, radius_m),
        Task::Line { points, spacing_m } => {
            beside(&points, spacing_m * (targets.len() as f64 - 1.0) / 2.0)
        }
        Task::Orbit {
            centre, radius_m, ..
        } => around(centre, radius_m),
    }
}

/// The ends of a line's parts, moved to both sides by a distance in metres.
fn beside(points: &[LatLon], aside_m: f64) -> Vec<LatLon> {
    let parts = points.windows(2).flat_map(|part| {
        let along = DVec2::from(part[0].offset_to(part[1]));
        let aside = along.normalize_or_zero().perp() * aside_m;
        [part[0], part[1]]
            .into_iter()
            .flat_map(move |end| [aside, -aside].map(|aside| end.moved(aside.x, aside.y)))
    });
    parts.collect()
}

/// Where a vehicle's flight begins and ends: where it stands, or home if it is in the air; `None`
/// if that place is unknown.
pub fn base(vehicle: &Vehicle) -> Option<Home> {
    let (at, amsl_m) = if vehicle.airborne() {
        let home = vehicle.home?;
        (home.at_point, home.altitude_amsl_m)
    } else {
        let here = vehicle.global?;
        (here.at_point, here.altitude_amsl_m)
    };
    let (x, y) = at.to_e7();
    Some(Home {
        x,
        y,
        z: amsl_m as f32,
    })
}
