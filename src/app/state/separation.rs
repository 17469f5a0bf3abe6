//! Vehicles in the air that come too close to each other.

use std::collections::BTreeMap;
use std::iter;

use crate::config::AlertsConfig;
use crate::geo::{LocalFrame, maths};
use crate::rehearsal::{Separation, SeparationLimits};
use crate::vehicle::{GlobalPosition, Vehicle, VehicleId, Vehicles};

/// The limits in the configuration; a horizontal limit of 0 turns the check off.
pub fn separation_limits(config: &AlertsConfig) -> SeparationLimits {
    SeparationLimits {
        across_m: f64::from(config.separation),
        height_m: f64::from(config.separation_height),
    }
}

/// The vehicle that is closest to another one, if it is too close.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CloseVehicle {
    pub vehicle: VehicleId,
    /// The horizontal distance, in metres.
    pub across_m: f64,
    /// The difference in height, in metres.
    pub height_m: f64,
}

/// A vehicle in the air.
struct Flyer {
    vehicle: VehicleId,
    /// The cell of its position, counted north and east from the origin.
    cell: [i32; 2],
}

/// The vehicles in the air, in square cells as wide as the horizontal limit: only vehicles in the
/// same or in neighbouring cells can be too close to each other, so the cost grows with their
/// number and not with its square.
struct CellGrid<'a> {
    vehicles: &'a Vehicles,
    limits: SeparationLimits,
    /// Ordered by cell: cells from west to east are neighbours here. Only what the search needs is
    /// kept, as most vehicles have no neighbours.
    flyers: Vec<Flyer>,
    frame: LocalFrame,
}

/// Each vehicle that is too close to others, with the closest of them.
pub fn too_close(
    vehicles: &Vehicles,
    limits: SeparationLimits,
) -> BTreeMap<VehicleId, CloseVehicle> {
    if limits.across_m <= 0.0 || limits.height_m <= 0.0 {
        return BTreeMap::new();
    }
    let grid = CellGrid::new(vehicles, limits);
    grid.map(|grid| grid.too_close()).unwrap_or_default()
}

impl<'a> CellGrid<'a> {
    /// The grid around the first vehicle in the air; `None` without one.
    fn new(vehicles: &'a Vehicles, limits: SeparationLimits) -> Option<Self> {
        let mut flying = vehicles.values().filter_map(|it| Some((it.id, place(it)?)));
        let (first, origin) = flying.next()?;
        let frame = LocalFrame::at(origin.at_point);
        let flyer = |(vehicle, place): (VehicleId, GlobalPosition)| {
            let cell = |metres: f64| (metres / limits.across_m).floor() as i32;
            let point = point(&frame, place);
            let is_known = point.iter().all(|metres| metres.is_finite());
            is_known.then(|| Flyer {
                vehicle,
                cell: [cell(point[0]), cell(point[1])],
            })
        };
        let all = iter::once((first, origin)).chain(flying);
        let mut flyers: Vec<Flyer> = all.filter_map(flyer).collect();
        flyers.sort_by_key(|flyer| flyer.cell);
        Some(Self {
            vehicles,
            limits,
            flyers,
            frame,
        })
    }

    fn too_close(&self) -> BTreeMap<VehicleId, CloseVehicle> {
        let closest = |flyer: &Flyer| {
            let others = self.around(flyer).map(|other| other.vehicle);
            let close = others.filter_map(|other| self.nearness(flyer.vehicle, other));
            let close = close.filter(|(nearness, _)| *nearness < 1.0);
            let (_, other) = close.min_by(|(a, _), (b, _)| a.total_cmp(b))?;
            Some((flyer.vehicle, other))
        };
        self.flyers.iter().filter_map(closest).collect()
    }

    /// The other vehicles in the cells around a vehicle.
    fn around(&self, flyer: &Flyer) -> impl Iterator<Item = &Flyer> {
        let own = flyer.vehicle;
        let [north, east] = flyer.cell;
        let rows = [north.saturating_sub(1), north, north.saturating_add(1)];
        let [west, east] = [east.saturating_sub(1), east.saturating_add(1)];
        let found = rows.into_iter().flat_map(move |row| {
            let first = self.flyers.partition_point(|it| it.cell < [row, west]);
            let from_there = self.flyers[first..].iter();
            from_there.take_while(move |it| it.cell <= [row, east])
        });
        found.filter(move |other| other.vehicle != own)
    }

    /// The distance from a vehicle to another one relative to the limits, by the rules of a
    /// rehearsal; less than 1 is too close.
    fn nearness(&self, own: VehicleId, vehicle: VehicleId) -> Option<(f64, CloseVehicle)> {
        let pair = [self.vehicles.get(&own)?, self.vehicles.get(&vehicle)?];
        let places = [place(pair[0])?, place(pair[1])?];
        let points = places.map(|place| point(&self.frame, place));
        let starts = pair[0].home.zip(pair[1].home);
        let starts = starts.map(|(own, other)| {
            [own, other].map(|home| <[f64; 2]>::from(self.frame.offset_to(home.at_point)))
        });
        let rule = Separation::new(starts, self.limits);
        let [north, east, up] = [0, 1, 2].map(|axis| points[1][axis] - points[0][axis]);
        let close = CloseVehicle {
            vehicle,
            across_m: maths::hypot(north, east),
            height_m: up.abs(),
        };
        Some((rule.nearness(points), close))
    }
}

/// A vehicle's place, if it is in contact and in the air.
fn place(vehicle: &Vehicle) -> Option<GlobalPosition> {
    let is_flying = !vehicle.link.lost && vehicle.airborne();
    vehicle.global.filter(|_| is_flying)
}

/// Metres north and east of the frame's origin, and above mean sea level.
fn point(frame: &LocalFrame, place: GlobalPosition) -> [f64; 3] {
    let (north_m, east_m) = frame.offset_to(place.at_point);
    [north_m, east_m, place.altitude_amsl_m]
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::time::{Duration, Instant};

    use super::*;
    use crate::geo::LatLon;
    use crate::vehicle::{LandedState, Place};

    const ORIGIN: LatLon = LatLon::new(50.45, 30.52);
    const LIMITS: SeparationLimits = SeparationLimits {
        across_m: 5.0,
        height_m: 3.0,
    };

    fn at(id: VehicleId, [north_m, east_m, up_m]: [f64; 3]) -> Vehicle {
        let mut vehicle = Vehicle::new(1, 1);
        vehicle.id = id;
        vehicle.landed = LandedState::InAir;
        vehicle.global = Some(GlobalPosition {
            at_point: ORIGIN.moved(north_m, east_m),
            altitude_amsl_m: 170.0 + up_m,
            altitude_m: up_m,
            north_m_s: 0.0,
            east_m_s: 0.0,
            down_m_s: 0.0,
            heading_deg: None,
            at: Duration::ZERO,
        });
        vehicle
    }

    fn swarm(vehicles: impl IntoIterator<Item = Vehicle>) -> Vehicles {
        let vehicles = vehicles.into_iter();
        vehicles.map(|it| (it.id, Arc::new(it))).collect()
    }

    fn ids(close: &BTreeMap<VehicleId, CloseVehicle>) -> Vec<(VehicleId, VehicleId)> {
        close.iter().map(|(id, it)| (*id, it.vehicle)).collect()
    }

    #[test]
    fn both_limits_count_and_only_vehicles_in_the_air() {
        let near = [at(1, [0.0, 0.0, 20.0]), at(2, [0.0, 4.9, 22.9])];
        let close = too_close(&swarm(near.clone()), LIMITS);
        assert_eq!(ids(&close), [(1, 2), (2, 1)]);
        assert!((close[&1].across_m - 4.9).abs() < 0.1 && (close[&1].height_m - 2.9).abs() < 0.1);
        for apart in [[0.0, 5.2, 20.0], [0.0, 1.0, 23.2], [-4.0, -4.0, 20.0]] {
            let close = too_close(&swarm([near[0].clone(), at(2, apart)]), LIMITS);
            assert_eq!(ids(&close), [], "{apart:?}");
        }
        let mut landed = near.clone();
        landed[1].landed = LandedState::OnGround;
        assert_eq!(ids(&too_close(&swarm(landed), LIMITS)), []);
        let mut lost = near.clone();
        lost[1].link.lost = true;
        assert_eq!(ids(&too_close(&swarm(lost), LIMITS)), []);
        let off = SeparationLimits {
            across_m: 0.0,
            ..LIMITS
        };
        assert_eq!(ids(&too_close(&swarm(near), off)), []);
    }

    fn with_home(vehicle: Vehicle, east_m: f64) -> Vehicle {
        let home = Place {
            at_point: ORIGIN.moved(0.0, east_m),
            altitude_amsl_m: 170.0,
        };
        Vehicle {
            home: Some(home),
            ..vehicle
        }
    }

    /// Two vehicles from pads 4 m apart, `north_m` north of their pads and `apart_m` apart.
    fn neighbours(north_m: f64, apart_m: f64) -> Vehicles {
        swarm([
            with_home(at(1, [north_m, 0.0, 5.0]), 0.0),
            with_home(at(2, [north_m, apart_m, 5.0]), 4.0),
        ])
    }

    /// As in a rehearsal: neighbours may be closer within 15 m of a start, and nowhere else.
    #[test]
    fn vehicles_beside_neighbouring_pads_may_be_closer() {
        for beside_m in [0.0, 14.0] {
            assert_eq!(ids(&too_close(&neighbours(beside_m, 3.9), LIMITS)), []);
            assert_eq!(ids(&too_close(&neighbours(beside_m, 2.5), LIMITS)).len(), 2);
        }
        for away_m in [16.0, 80.0] {
            assert_eq!(ids(&too_close(&neighbours(away_m, 3.9), LIMITS)).len(), 2);
        }
    }

    #[test]
    fn vehicles_that_report_the_same_home_have_the_usual_limit() {
        let same = [at(1, [0.0, 0.0, 5.0]), at(2, [0.0, 4.5, 5.0])];
        let same = same.map(|vehicle| with_home(vehicle, 0.0));
        assert_eq!(ids(&too_close(&swarm(same), LIMITS)).len(), 2);
    }

    /// A horizontal distance of 3.6 m is farther below its limit of 5 m than a height difference of
    /// 2.9 m is below its limit of 3 m.
    #[test]
    fn the_closest_vehicle_is_that_nearest_to_the_limits() {
        let near = [
            at(1, [0.0, 0.0, 20.0]),
            at(2, [0.0, 3.6, 20.0]),
            at(3, [0.0, 0.0, 22.9]),
        ];
        assert_eq!(too_close(&swarm(near), LIMITS)[&1].vehicle, 2);
    }

    /// A thousand vehicles side by side are compared with their neighbours only.
    #[test]
    fn the_cost_grows_with_the_number_of_vehicles() {
        let compared = |count: u16, in_row: u16| {
            let place = |at: u16| [at / in_row, at % in_row].map(|it| 6.0 * f64::from(it));
            let vehicles = (0..count).map(|id| {
                let [north_m, east_m] = place(id);
                at(id + 1, [north_m, east_m, 20.0])
            });
            let vehicles = swarm(vehicles);
            let begun = Instant::now();
            let close = too_close(&vehicles, LIMITS);
            let taken = begun.elapsed();
            assert!(close.is_empty());
            let grid = CellGrid::new(&vehicles, LIMITS).expect("they fly");
            let compared: usize = grid.flyers.iter().map(|it| grid.around(it).count()).sum();
            println!("{count} vehicles: {compared} comparisons, {taken:?}");
            compared
        };
        for in_row in [40, 1, 2000] {
            assert!(compared(1000, in_row) <= 8 * 1000);
            assert!(compared(2000, in_row) <= 8 * 2000);
        }
    }
}
