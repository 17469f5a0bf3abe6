//! Orders that lead out of the fence of a mission, which breaks one of its rules.

use super::FlightView;
use crate::commands::{Act, Command, MotionCommand, Order};
use crate::geo::LatLon;
use crate::mission::AreaKind;
use crate::swarm::outermost_places;
use crate::text;
use crate::text::Text;

impl FlightView {
    /// Why an order needs a confirmation: it leads out of a fence of the mission.
    pub(super) fn fence_hazard(&self, order: &Order) -> Option<Text> {
        let mut areas = self.task.areas.iter();
        let places = self.destinations(order);
        let left = areas.find(|area| {
            let is_outside = |place: &LatLon| !area.contains(*place);
            area.kind == AreaKind::Geofence && places.iter().any(is_outside)
        })?;
        Some(text!("hazard-outside-fence", fence = &left.name))
    }

    /// The places to which a `goto` or a task leads. A task for vehicles with a fence of their own has none: its plans
    /// keep inside that fence.
    fn destinations(&self, order: &Order) -> Vec<LatLon> {
        let mut targets = order.targets.iter().filter_map(|id| self.vehicles.get(id));
        match &order.act {
            Act::Command(Command::Motion(MotionCommand::Goto { destination, .. })) => targets
                .filter_map(|vehicle| destination.of(vehicle))
                .map(|(place, _)| place)
                .collect(),
            Act::Plans(task) => {
                let fenced = targets.next().and_then(|first| first.fence_in_force());
                if fenced.is_some() {
                    return Vec::new();
                }
                outermost_places(task, &order.targets, &self.vehicles)
            }
            Act::Command(_) | Act::Deed(_) | Act::Manoeuvre(_) | Act::Rehearse { .. } => Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::time::Duration;

    use super::*;
    use crate::geo::Outline;
    use crate::language::Context;
    use crate::mission::Area;
    use crate::operator::read_order;
    use crate::vehicle::{GlobalPosition, Vehicle};

    const HOME: LatLon = LatLon::new(50.45, 30.52);

    /// A vehicle at home, inside a square fence with sides of 200 m.
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
            ("1 goto 50.4505 30.5205", false),
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
    fn other_areas_ask_nothing() {
        assert!(!asks(&view(AreaKind::Task), "1 goto 50.46 30.52"));
    }
}
