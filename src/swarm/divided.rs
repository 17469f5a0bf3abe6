//! Vehicles whose plans are parts of the same work.

use std::collections::{BTreeMap, BTreeSet};

use crate::vehicle::{VehicleId, Vehicles};

/// For each vehicle, the last work in which it has had a part.
#[derive(Debug, Clone, Default)]
pub struct DividedWork {
    /// The number of the work, from 1.
    last: BTreeMap<VehicleId, u32>,
    /// The number of the newest work.
    count: u32,
}

impl DividedWork {
    /// Notes work that is divided among `vehicles`. Returns the vehicles that shared earlier work
    /// with any of them and have no part now: their old plans lead them through the parts of other
    /// vehicles.
    pub fn divide(&mut self, vehicles: &[VehicleId]) -> Vec<VehicleId> {
        let earlier = vehicles.iter().filter_map(|id| self.last.get(id));
        let earlier: BTreeSet<u32> = earlier.copied().collect();
        let shared = self.last.iter().filter(|(_, work)| earlier.contains(work));
        let left = shared
            .map(|(id, _)| *id)
            .filter(|id| !vehicles.contains(id));
        let left: Vec<VehicleId> = left.collect();
        self.count += 1;
        let all = vehicles.iter().chain(&left).copied();
        let all: Vec<VehicleId> = all.collect();
        self.last.extend(all.into_iter().map(|id| (id, self.count)));
        left
    }

    /// Forgets the part of a vehicle that has received another plan, or none.
    pub fn forget(&mut self, vehicle: VehicleId) {
        self.last.remove(&vehicle);
    }
}

/// The vehicles among `ids` that are known to carry a plan.
pub fn carrying(ids: &[VehicleId], vehicles: &Vehicles) -> Vec<VehicleId> {
    let carries = |id: &VehicleId| {
        let plan = vehicles
            .get(id)
            .and_then(|it| it.plans.plan.content.as_ref());
        plan.is_some_and(|plan| !plan.flown().is_empty())
    };
    ids.iter().copied().filter(carries).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vehicles_without_a_part_in_smaller_work_are_named_until_they_get_another_plan() {
        let mut work = DividedWork::default();
        let none: [VehicleId; 0] = [];
        assert_eq!(work.divide(&[1, 2, 3, 4]), none);
        assert_eq!(work.divide(&[5, 6]), none, "other vehicles");
        assert_eq!(work.divide(&[1, 2]), [3, 4]);
        assert_eq!(work.divide(&[2]), [1, 3, 4], "still");
        work.forget(3);
        assert_eq!(work.divide(&[1, 2]), [4]);
        assert_eq!(work.divide(&[5]), [6]);
        assert_eq!(work.divide(&[1, 2, 3, 4, 5, 6]), none);
    }
}
