//! Vehicles in the air that come too close to each other.

use std::collections::{BTreeMap, HashMap};

use crate::config::AlertsConfig;
use crate::geo::{LatLon, maths};
use crate::rehearsal::neighbours_limit_m;
use crate::vehicle::{Vehicle, VehicleId, Vehicles};

/// Two vehicles are too close to each other if both of their distances are below these limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeparationLimits {
    /// Horizontal distance, in metres; 0 turns the check off.
    pub across_m: f64,
    /// Vertical distance, in metres.
    pub height_m: f64,
}

impl SeparationLimits {
    /// The limits in the configuration.
    pub fn of(config: &AlertsConfig) -> Self {
        Self {
            across_m: f64::from(config.separation),
            height_m: f64::from(config.separation_height),
        }
    }
}

/// The vehicle that is closest to another one, if it is too close.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CloseVehicle {
    pub vehicle: VehicleId,
    /// The distance across, in metres.
    pub across_m: f64,
    /// The difference in height, in metres.
    pub height_m: f64,
}

/// A vehicle in the air, in metres north, east and up.
struct Flyer {
    vehicle: VehicleId,
    point: [f64; 3],
    /// The place from which it takes off, where vehicles may stand close.
    home: Option<LatLon>,
}

/// The vehicles in the air, in square cells as wide as the limit across: only vehicles in the same or in neighbouring
/// cells can be too close to each other, so that the cost grows with their number and not with its square.
struct CellGrid {
    flyers: Vec<Flyer>,
    cells: HashMap<u64, Vec<usize>>,
    /// The place that points count from.
    origin: Option<LatLon>,
    limits: SeparationLimits,
}

/// Each vehicle that is too close to another one, with the closest.
pub fn too_close(
    vehicles: &Vehicles,
    limits: SeparationLimits,
) -> BTreeMap<VehicleId, CloseVehicle> {
    if limits.across_m <= 0.0 || limits.height_m <= 0.0 {
        return BTreeMap::new();
    }
    CellGrid::new(vehicles, limits).too_close()
}

impl CellGrid {
    fn new(vehicles: &Vehicles, limits: SeparationLimits) -> Self {
        let mut origin = None;
        let mut flyers = Vec::new();
        let mut cells: HashMap<u64, Vec<usize>> = HashMap::new();
        for vehicle in vehicles.values() {
            let Some(flyer) = flyer(vehicle, &mut origin) else {
                continue;
            };
            let place = cell(flyer.point, limits);
            cells.entry(key(place)).or_default().push(flyers.len());
            flyers.push(flyer);
        }
        Self {
            flyers,
            cells,
            origin,
            limits,
        }
    }

    fn too_close(&self) -> BTreeMap<VehicleId, CloseVehicle> {
        let closest = |flyer: &Flyer| {
            let close = self
                .around(flyer)
                .filter_map(|other| self.close(flyer, other));
            let distance = |it: &CloseVehicle| maths::hypot(it.across_m, it.height_m);
            let closest = close.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
            Some((flyer.vehicle, closest))
        };
        self.flyers.iter().filter_map(closest).collect()
    }

    /// The other vehicles in the cells around a vehicle.
    fn around<'a>(&'a self, flyer: &'a Flyer) -> impl Iterator<Item = &'a Flyer> + 'a {
        let own = cell(flyer.point, self.limits);
        let steps = (0..9).map(|at| [at / 3 - 1, at % 3 - 1]);
        let cells = steps.map(move |step| [0, 1].map(|axis| own[axis].wrapping_add(step[axis])));
        let found = cells
            .filter_map(|cell| self.cells.get(&key(cell)))
            .flatten();
        let others = found.map(|at| &self.flyers[*at]);
        others.filter(|other| other.vehicle != flyer.vehicle)
    }

    /// The pad that a vehicle is above.
    fn pad_of(&self, flyer: &Flyer) -> Option<[f64; 2]> {
        let [north_m, east_m, _] = flyer.point;
        let pad = <[f64; 2]>::from(self.origin?.offset_to(flyer.home?));
        (apart_m(pad, [north_m, east_m]) < self.limits.across_m).then_some(pad)
    }

    /// The distance of two vehicles, if they are too close. Above pads that are close together, they may be closer.
    fn close(&self, flyer: &Flyer, other: &Flyer) -> Option<CloseVehicle> {
        let [north, east, up] = [0, 1, 2].map(|axis| other.point[axis] - flyer.point[axis]);
        let close = CloseVehicle {
            vehicle: other.vehicle,
            across_m: maths::hypot(north, east),
            height_m: up.abs(),
        };
        if close.across_m >= self.limits.across_m || close.height_m >= self.limits.height_m {
            return None;
        }
        let pads = self.pad_of(flyer).zip(self.pad_of(other));
        let pads_m = pads.map_or(f64::INFINITY, |(own, other)| apart_m(own, other));
        let limit_m = neighbours_limit_m(pads_m, self.limits.across_m);
        (close.across_m < limit_m).then_some(close)
    }
}

fn apart_m(one: [f64; 2], other: [f64; 2]) -> f64 {
    maths::hypot(one[0] - other[0], one[1] - other[1])
}

/// A vehicle, if it is in the air at a known place; the first one's place is the origin.
fn flyer(vehicle: &Vehicle, origin: &mut Option<LatLon>) -> Option<Flyer> {
    if vehicle.link.lost || !vehicle.airborne() {
        return None;
    }
    let here = vehicle.global?;
    let origin = *origin.get_or_insert(here.at_point);
    let [north_m, east_m] = <[f64; 2]>::from(origin.offset_to(here.at_point));
    let point = [north_m, east_m, here.altitude_amsl_m];
    point
        .iter()
        .all(|metres| metres.is_finite())
        .then_some(Flyer {
            vehicle: vehicle.id,
            point,
            home: vehicle.home.map(|home| home.at_point),
        })
}

/// The cell of a point, counted north and east from the origin.
fn cell([north_m, east_m, _]: [f64; 3], limits: SeparationLimits) -> [i32; 2] {
    [north_m, east_m].map(|metres| (metres / limits.across_m).floor() as i32)
}

/// A cell as one number, which is faster to hash.
fn key([north, east]: [i32; 2]) -> u64 {
    u64::from(north.cast_unsigned()) << 32 | u64::from(east.cast_unsigned())
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::time::{Duration, Instant};

    use super::*;
    use crate::vehicle::{GlobalPosition, LandedState, Place};

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

    #[test]
    fn vehicles_above_neighbouring_pads_are_apart() {
        let home = |metres| {
            Some(Place {
                at_point: ORIGIN.moved(0.0, metres),
                altitude_amsl_m: 170.0,
            })
        };
        let mut pads = [at(1, [0.0, 0.0, 5.0]), at(2, [0.0, 3.9, 5.0])];
        pads[0].home = home(0.0);
        pads[1].home = home(4.0);
        assert_eq!(ids(&too_close(&swarm(pads.clone()), LIMITS)), []);
        pads[1].global = at(2, [0.0, 2.5, 5.0]).global;
        assert_eq!(ids(&too_close(&swarm(pads.clone()), LIMITS)).len(), 2);
        // Away from the pads, the usual limit applies.
        pads[0].global = at(1, [80.0, 0.0, 5.0]).global;
        pads[1].global = at(2, [80.0, 3.9, 5.0]).global;
        assert_eq!(ids(&too_close(&swarm(pads), LIMITS)).len(), 2);
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
            let grid = CellGrid::new(&vehicles, LIMITS);
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
