//! Orders that lead out of a mission's fence, or above its ceiling, which breaks a rule of the mission, and vehicles that
//! are there.

use std::collections::BTreeMap;

use super::FlightView;
use crate::commands::{Act, Command, FlightCommand, Manoeuvre, MotionCommand, Order, PlanTask};
use crate::geo::{LatLon, Outline};
use crate::mission::{Area, AreaKind, SWING_M};
use crate::plan::generate::{Course, USUAL_HEIGHT_M};
use crate::swarm::{Rules, outermost_places};
use crate::text;
use crate::text::{Text, figure};
use crate::vehicle::{FenceArea, FencePlan, FenceShape, Vehicle, VehicleId};

/// Where an order leads.
#[derive(Debug, Clone, Copy)]
struct WayEnd {
    /// `None` if the order leads to no other place.
    place: Option<LatLon>,
    /// The height above home in metres, if the order sets one.
    height_m: Option<f64>,
}

impl WayEnd {
    fn at_height(height_m: Option<f64>) -> Self {
        Self {
            place: None,
            height_m,
        }
    }
}

/// How a vehicle breaks a fence of the mission.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FenceBreach {
    Outside,
    /// Above the height that the fence allows, in metres above home.
    Above {
        ceiling_m: f64,
    },
}

impl FlightView {
    /// The vehicles in the air that break a fence of the mission. A vehicle that reports a breach of its own fence is
    /// left out, because it has that alert already.
    pub(in crate::app) fn breaches(&self) -> BTreeMap<VehicleId, FenceBreach> {
        let areas = self.task.areas.iter();
        let fences: Vec<&Area> = areas
            .filter(|area| area.kind == AreaKind::Geofence)
            .collect();
        if fences.is_empty() {
            return BTreeMap::new();
        }
        let flying = self.vehicles.values().filter(|it| {
            let has_alert = it.fence.is_some_and(|fence| fence.breached);
            it.airborne() && !has_alert
        });
        let breach = |vehicle: &Vehicle| {
            let here = vehicle.global?;
            let outside = fences.iter().any(|fence| !fence.contains(here.at_point));
            let ceilings = fences.iter().filter_map(|fence| fence.ceiling_m);
            let above = ceilings
                .filter(|ceiling_m| here.altitude_m > ceiling_m + SWING_M)
                .min_by(f64::total_cmp);
            let outside = outside.then_some(FenceBreach::Outside);
            outside.or(above.map(|ceiling_m| FenceBreach::Above { ceiling_m }))
        };
        flying
            .filter_map(|vehicle| Some((vehicle.id, breach(vehicle)?)))
            .collect()
    }

    /// Why an order needs a confirmation: it leads out of a fence of the mission, or above its ceiling.
    pub(super) fn fence_hazard(&self, order: &Order) -> Option<Text> {
        let ends = self.ends(order);
        let kept = self.kept_fence(order);
        let areas = self.task.areas.iter();
        let mut fences = areas.filter(|area| area.kind == AreaKind::Geofence);
        fences.find_map(|area| {
            let is_kept = kept.is_some_and(|fence| lies_within(fence, area));
            let is_outside =
                |end: &WayEnd| !is_kept && end.place.is_some_and(|place| !area.contains(place));
            if ends.iter().any(is_outside) {
                return Some(text!("hazard-outside-fence", fence = &area.name));
            }
            let ceiling_m = area.ceiling_m?;
            let is_above = |end: &WayEnd| end.height_m.is_some_and(|height_m| height_m > ceiling_m);
            ends.iter().any(is_above).then(|| {
                let ceiling = figure(ceiling_m, 0);
                text!(
                    "hazard-above-ceiling",
                    ceiling = ceiling,
                    fence = &area.name
                )
            })
        })
    }

    /// Where an order leads its targets, as far as it is known before.
    fn ends(&self, order: &Order) -> Vec<WayEnd> {
        let targets = order.targets.iter().filter_map(|id| self.vehicles.get(id));
        match &order.act {
            Act::Command(Command::Motion(MotionCommand::Goto { destination, .. })) => targets
                .filter_map(|vehicle| destination.of(vehicle))
                .map(|(place, height_m)| WayEnd {
                    place: Some(place),
                    height_m,
                })
                .collect(),
            Act::Command(
                Command::Motion(MotionCommand::Altitude { altitude_m })
                | Command::Flight(FlightCommand::Takeoff { altitude_m }),
            ) => vec![WayEnd::at_height(Some(*altitude_m))],
            Act::Plans(task) => self.task_ends(task, order),
            Act::Manoeuvre(manoeuvre) => self.manoeuvre_ends(manoeuvre, order),
            Act::Command(_) | Act::Deed(_) | Act::Rehearse { .. } => Vec::new(),
        }
    }

    /// The outermost places of a task, at its height.
    fn task_ends(&self, task: &PlanTask, order: &Order) -> Vec<WayEnd> {
        let listing = self.task.listing.as_ref();
        let rules = listing.map_or_else(Rules::default, |listing| listing.swarm_rules);
        let height_m = Some(task.up_m().unwrap_or(USUAL_HEIGHT_M));
        let places = outermost_places(task, rules, &order.targets, &self.vehicles);
        let ends = places.into_iter().map(|place| WayEnd {
            place: Some(place),
            height_m,
        });
        ends.collect()
    }

    fn manoeuvre_ends(&self, manoeuvre: &Manoeuvre, order: &Order) -> Vec<WayEnd> {
        let first = order.targets.first().and_then(|id| self.vehicles.get(id));
        let here_m = first.and_then(|first| first.global).map(|it| it.altitude_m);
        let task = match manoeuvre {
            Manoeuvre::Survey {
                ground,
                spacing_m,
                up_m,
                ..
            } => PlanTask::Survey {
                ground: ground.clone(),
                spacing_m: *spacing_m,
                up_m: up_m.or(here_m),
                course: Course::Best,
            },
            Manoeuvre::Search {
                pattern,
                datum,
                radius_m,
                spacing_m,
                up_m,
            } => PlanTask::Search {
                pattern: *pattern,
                datum: *datum,
                radius_m: *radius_m,
                spacing_m: *spacing_m,
                up_m: up_m.or(here_m),
            },
            Manoeuvre::Formation { up_m, .. }
            | Manoeuvre::Follow { up_m, .. }
            | Manoeuvre::Chain { up_m, .. } => return vec![WayEnd::at_height(*up_m)],
            Manoeuvre::Spread { .. } | Manoeuvre::Disband => return Vec::new(),
        };
        self.task_ends(&task, order)
    }

    /// The fence in force on board the first target, inside which the plans of a task stay; `None`
    /// for other orders.
    fn kept_fence(&self, order: &Order) -> Option<&FencePlan> {
        let is_task = matches!(order.act, Act::Plans(_));
        let first = order.targets.first().filter(|_| is_task)?;
        self.vehicles.get(first)?.fence_in_force()
    }
}

/// Whether a fence on board keeps a vehicle inside an area.
fn lies_within(fence: &FencePlan, area: &Area) -> bool {
    let is_inside = |it: &FenceArea| {
        let corners = match &it.shape {
            FenceShape::Polygon(corners) => corners.clone(),
            FenceShape::Circle { center, radius_m } => {
                let (centre, radius_m) = (*center, f64::from(*radius_m));
                Outline::Circle { centre, radius_m }.corners()
            }
        };
        it.inclusion
            && corners
                .into_iter()
                .all(|corner| area.contains_nearly(corner))
    };
    fence.areas.iter().any(is_inside)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::app::testing::{HOME, at_home, carry_fence, read, switch_fence_on};
    use crate::vehicle::LandedState;

    /// A vehicle at home, inside a square fence with sides of 200 m and a ceiling of 50 m.
    fn view(kind: AreaKind) -> FlightView {
        let mut view = FlightView::default();
        view.insert(Arc::new(at_home(0.0)));
        view.task.areas = vec![Area {
            name: "border".to_owned(),
            kind,
            outline: Outline::square(HOME, 200.0),
            ceiling_m: Some(50.0),
        }];
        view
    }

    fn asks(view: &FlightView, line: &str) -> bool {
        view.hazard(&read(line)).is_some()
    }

    #[test]
    fn a_vehicle_that_is_out_of_the_fence_breaks_it_while_it_flies() {
        let breach = |north_m: f64, altitude_m: f64, landed: LandedState| {
            let mut vehicle = at_home(altitude_m);
            vehicle.landed = landed;
            if let Some(here) = &mut vehicle.global {
                here.at_point = HOME.moved(north_m, 0.0);
            }
            let mut view = view(AreaKind::Geofence);
            view.insert(Arc::new(vehicle));
            view.breaches().remove(&1)
        };
        let outside = Some(FenceBreach::Outside);
        let above = Some(FenceBreach::Above { ceiling_m: 50.0 });
        for (north_m, altitude_m, expected) in [
            (90.0, 20.0, None),
            (110.0, 20.0, outside),
            (0.0, 50.5, None),
            (0.0, 55.0, above),
            (110.0, 55.0, outside),
        ] {
            let found = breach(north_m, altitude_m, LandedState::InAir);
            assert_eq!(found, expected, "{north_m} {altitude_m}");
        }
        assert_eq!(breach(110.0, 0.0, LandedState::OnGround), None);
    }

    #[test]
    fn an_order_that_leads_out_of_the_fence_asks() {
        let view = view(AreaKind::Geofence);
        for (line, out) in [
            ("1 goto by n 90 e 90", false),
            ("1 goto by n 110 e 0", true),
            ("1 goto by n 10 e 0 up 40", false),
            ("1 goto by n 10 e 0 up 60", true),
            ("1 goto 50.4505 30.5205", false),
            ("1 plan orbit 50.45 30.52 radius 20 up 60", true),
            ("1 goto 50.46 30.52", true),
            (
                "1 plan search square around 50.4501 30.5201 radius 40",
                false,
            ),
            (
                "1 plan search square around 50.4501 30.5201 radius 400",
                true,
            ),
            ("1 plan orbit 50.46 30.52 radius 20", true),
            ("1 plan survey around 50.46 30.53 radius 50", true),
            ("1 land", false),
            ("1 takeoff 50", false),
            ("1 takeoff 60", true),
            ("1 altitude 60", true),
            ("1 survey around 50.45 30.52 radius 50", false),
            ("1 survey around 50.45 30.52 radius 50 up 60", true),
            ("1 survey around 50.46 30.53 radius 50", true),
            ("1 formation line up 60", true),
        ] {
            assert_eq!(asks(&view, line), out, "{line}");
        }
    }

    #[test]
    fn the_corners_of_a_search_square_count() {
        let mut view = view(AreaKind::Geofence);
        // Inside a square fence they lie at the radius, beyond it if the last turn is.
        let around = "1 plan search square around 50.45 30.52";
        assert!(!asks(&view, &format!("{around} radius 80 spacing 20")));
        assert!(asks(&view, &format!("{around} radius 90 spacing 80")));
        view.task.areas[0].outline = Outline::Circle {
            centre: HOME,
            radius_m: 100.0,
        };
        assert!(!asks(&view, &format!("{around} radius 60 spacing 20")));
        assert!(asks(&view, &format!("{around} radius 80 spacing 20")));
    }

    /// Lanes lie side by side along the line, at the default spacing of 20 m.
    #[test]
    fn the_outer_lanes_beside_a_line_count() {
        let mut view = view(AreaKind::Geofence);
        let second = Vehicle {
            id: 2,
            ..Vehicle::clone(&view.vehicles[&1])
        };
        view.insert(Arc::new(second));
        let along = "plan line 50.4499 30.52132 50.4501 30.52132";
        assert!(!asks(&view, &format!("1 {along}")));
        assert!(asks(&view, &format!("1-2 {along}")));
        assert!(!asks(&view, &format!("1-2 {along} spacing 4")));
    }

    #[test]
    fn the_question_says_whether_the_place_or_the_height_is_wrong() {
        let view = view(AreaKind::Geofence);
        let said = |line: &str| view.hazard(&read(line)).expect("it asks").to_string();
        assert!(said("1 takeoff 60").contains("ceiling of 50 m"));
        assert!(said("1 goto 50.46 30.52").contains("out of the mission's fence"));
    }

    #[test]
    fn only_a_fence_on_board_inside_that_of_the_mission_answers_the_question() {
        let mut view = view(AreaKind::Geofence);
        let line = "1 plan survey around 50.45 30.52 radius 150";
        for (side_m, out) in [(None, true), (Some(200.0), false), (Some(400.0), true)] {
            let vehicle = Arc::make_mut(view.vehicles.get_mut(&1).expect("inserted"));
            carry_fence(vehicle, side_m);
            switch_fence_on(vehicle);
            assert_eq!(asks(&view, line), out, "{side_m:?}");
            assert!(asks(&view, &format!("{line} up 60")));
        }
    }

    #[test]
    fn other_areas_ask_nothing() {
        assert!(!asks(&view(AreaKind::Task), "1 goto 50.46 30.52"));
    }
}
