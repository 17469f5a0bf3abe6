//! A vehicle at home and the fence around it, for tests of orders that lead out of a fence.

use std::sync::Arc;
use std::time::Duration;

use crate::commands::Order;
use crate::geo::{LatLon, Outline};
use crate::language::Context;
use crate::operator::read_order;
use crate::vehicle::{FenceArea, FencePlan, FenceShape, GlobalPosition, Health, Transfer, Vehicle};

pub(super) const HOME: LatLon = LatLon::new(50.45, 30.52);

/// Vehicle 1 above its home, at a height in metres.
pub(super) fn at_home(altitude_m: f64) -> Vehicle {
    let mut vehicle = Vehicle::new(1, 1);
    vehicle.global = Some(GlobalPosition {
        at_point: HOME,
        altitude_amsl_m: 180.0,
        altitude_m,
        north_m_s: 0.0,
        east_m_s: 0.0,
        down_m_s: 0.0,
        heading_deg: None,
        at: Duration::ZERO,
    });
    vehicle
}

/// Puts a square fence around home on board, with sides of this length in metres; without a length, a fence that has no
/// areas.
pub(super) fn carry_fence(vehicle: &mut Vehicle, side_m: Option<f64>) {
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
}

pub(super) fn switch_fence_on(vehicle: &mut Vehicle) {
    vehicle.health = Some(Health {
        present: Health::FENCE,
        enabled: Health::FENCE,
        healthy: 0,
        load_percent: 0.0,
        at: Duration::ZERO,
    });
}

/// The order of a line, in a session with the vehicles 1 and 2.
pub(super) fn read(line: &str) -> Order {
    let context = Context {
        vehicles: &[1, 2],
        ..Context::default()
    };
    read_order(line, &context, &[1]).expect("a good line")
}
