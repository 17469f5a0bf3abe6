//! Orders that lead out of a mission's fence, which breaks a rule of the mission.

use super::FlightView;
use crate::commands::{Act, Command, MotionCommand, Order};
use crate::geo::{LatLon, Outline};
use crate::mission::{Area, AreaKind};
use crate::plan::generate::USUAL_HEIGHT_M;
use crate::swarm::outermost_places;
use crate::text;
use crate::text::Text;
use crate::vehicle::{FenceArea, FencePlan, FenceShape};

/// A place to which an order leads, and the height above home in metres, if the order sets one.
type WayEnd = (LatLon, Option<f64>);

impl FlightView {
    /// Why an order needs a confirmation: it leads out of a fence of the mission, or above its ceiling.
    pub(super) fn fence_hazard(&self, order: &Order) -> Option<Text> {
        let ends = self.ends(order);
        let kept = self.kept_fence(order);
        let is_left = |area: &&Area| {
            let is_kept = kept.is_some_and(|fence| lies_within(fence, area));
            let is_beyond = |(place, height_m): &WayEnd| {
                let is_outside = !is_kept && !area.contains(*place);
                let heights = height_m.zip(area.ceiling_m);
                is_outside || heights.is_some_and(|(height_m, ceiling_m)| height_m > ceiling_m)
            };
            area.kind == AreaKind::Geofence && ends.iter().any(is_beyond)
        };
        let left = self.task.areas.iter().find(is_left)?;
        Some(text!("hazard-outside-fence", fence = &left.name))
    }

    /// The places to which a `goto` or a task leads.
    fn ends(&self, order: &Order) -> Vec<WayEnd> {
        let targets = order.targets.iter().filter_map(|id| self.vehicles.get(id));
        match &order.act {
            Act::Command(Command::Motion(MotionCommand::Goto { destination, .. })) => targets
                .filter_map(|vehicle| destination.of(vehicle))
                .collect(),
            Act::Plans(task) => {
                let height_m = Some(task.up_m().unwrap_or(USUAL_HEIGHT_M));
                let places = outermost_places(task, &order.targets, &self.vehicles).into_iter();
                places.map(|place| (place, height_m)).collect()
            }
            Act::Command(_) | Act::Deed(_) | Act::Manoeuvre(_) | Act::Rehearse { .. } => Vec::new(),
        }
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
    use std::time::Duration;

    use super::*;
    use crate::language::Context;
    use crate::operator::read_order;
    use crate::vehicle::{GlobalPosition, Health, Transfer, Vehicle};

    const HOME: LatLon = LatLon::new(50.45, 30.52);

    /// A vehicle at home, inside a square fence with sides of 200 m and a ceiling of 50 m.
    fn view(kind: AreaKind) -> FlightView {
        let mut view = FlightView::default();
        let mut vehicle = Vehicle::new(1, 1);
        vehicle.global = Some(GlobalPosition {
            at_point: HOME,
            altitude_amsl_m: 180.0,
            altitude_m: 0.0,
            north_m_s: 0.0,
            east_m_s: 0.0,
            down_m_s: 0.0,
            heading_deg: None,
            at: Duration::ZERO,
        });
        view.insert(Arc::new(vehicle));
        view.task.areas = vec![Area {
            name: "border".to_owned(),
            kind,
            outline: Outline::square(HOME, 200.0),
            ceiling_m: Some(50.0),
        }];
        view
    }

    fn asks(view: &FlightView, line: &str) -> bool {
        let context = Context {
            vehicles: &[1],
            ..Context::default()
        };
        let order = read_order(line, &context, &[1]).expect("a good line");
        view.hazard(&order).is_some()
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

    #[test]
    fn only_a_fence_on_board_inside_that_of_the_mission_answers_the_question() {
        let mut view = view(AreaKind::Geofence);
        let line = "1 plan survey around 50.45 30.52 radius 150";
        for (side_m, out) in [(None, true), (Some(200.0), false), (Some(400.0), true)] {
            let vehicle = Arc::make_mut(view.vehicles.get_mut(&1).expect("inserted"));
            fence(vehicle, side_m);
            assert_eq!(asks(&view, line), out, "{side_m:?}");
            assert!(asks(&view, &format!("{line} up 60")));
        }
    }

    /// Puts a square fence on board and switches it on.
    fn fence(vehicle: &mut Vehicle, side_m: Option<f64>) {
        let corners = side_m.map(|side_m| Outline::square(HOME, side_m).corners());
        let area = |corners| FenceArea {
            shape: FenceShape::Polygon(corners),
            inclusion: true,
        };
        vehicle.plans.fence.content = Some(Arc::new(FencePlan {
            areas: corners.into_iter().map(area).collect(),
            ..FencePlan::default()
        }));
        vehicle.plans.fence.transfer = Transfer::Done;
        vehicle.health = Some(Health {
            present: Health::FENCE,
            enabled: Health::FENCE,
            healthy: 0,
            load_percent: 0.0,
            at: Duration::ZERO,
        });
    }

    #[test]
    fn other_areas_ask_nothing() {
        assert!(!asks(&view(AreaKind::Task), "1 goto 50.46 30.52"));
    }
}
