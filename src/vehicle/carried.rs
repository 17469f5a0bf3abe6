//! Which of several vehicles carry the same plan, fence or rally points, by content.

use super::{Stored, Transfer, Vehicle, VehicleId};
use crate::plan::{ContentHash, Item, ListKind};
use crate::text;
use crate::text::Text;
use crate::vehicle_id::ranges;

/// The lists of one kind that several vehicles carry.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CarriedLists {
    kind: ListKind,
    /// The vehicles by the content that they carry, the most common content first.
    groups: Vec<SameList>,
    /// The vehicles whose list has not been read.
    unread: Vec<VehicleId>,
    /// The vehicles that have no such list.
    without: Vec<VehicleId>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
struct SameList {
    mark: ContentHash,
    /// The number of items, without home.
    items: usize,
    vehicles: Vec<VehicleId>,
}

impl CarriedLists {
    /// Compares the lists of some vehicles, in the order of their numbers.
    pub fn of<'a>(kind: ListKind, vehicles: impl IntoIterator<Item = &'a Vehicle>) -> Self {
        let mut lists = Self {
            kind,
            groups: Vec::new(),
            unread: Vec::new(),
            without: Vec::new(),
        };
        for vehicle in vehicles {
            lists.add(vehicle);
        }
        // Sorting is stable: of groups of the same size, the one with the first vehicle stays first.
        lists.groups.sort_by_key(|group| {
            let size = group.vehicles.len();
            (std::cmp::Reverse(size), group.items == 0)
        });
        lists
    }

    fn add(&mut self, vehicle: &Vehicle) {
        let (transfer, items) = list(vehicle, self.kind);
        let Some(items) = items.filter(|_| transfer == Transfer::Done) else {
            let others = if transfer == Transfer::Unsupported {
                &mut self.without
            } else {
                &mut self.unread
            };
            others.push(vehicle.id);
            return;
        };
        let mark = ContentHash::of(items);
        let is_same = |group: &&mut SameList| group.mark == mark && group.items == items.len();
        match self.groups.iter_mut().find(is_same) {
            Some(group) => group.vehicles.push(vehicle.id),
            None => self.groups.push(SameList {
                mark,
                items: items.len(),
                vehicles: vec![vehicle.id],
            }),
        }
    }

    /// Whether all the vehicles carry the same list.
    pub fn are_same(&self) -> bool {
        self.groups.len() == 1 && self.unread.is_empty() && self.without.is_empty()
    }

    /// The comparison in words: `12 of 16 carry plan 7f3a (11 items); 4, 9 differ: ..`.
    pub fn text(&self) -> Text {
        let mut parts = Vec::new();
        if let Some((most, others)) = self.groups.split_first() {
            parts.push(self.most(most));
            if !others.is_empty() {
                parts.push(differ(others));
            }
        }
        if !self.unread.is_empty() {
            let vehicles = ranges(self.unread.iter().copied());
            parts.push(text!("carried-unread", vehicles = vehicles));
        }
        if !self.without.is_empty() {
            let vehicles = ranges(self.without.iter().copied());
            parts.push(text!("carried-unsupported", vehicles = vehicles));
        }
        Text::joined("; ", parts)
    }

    fn most(&self, most: &SameList) -> Text {
        let known: usize = self.groups.iter().map(|group| group.vehicles.len()).sum();
        let all = known + self.unread.len() + self.without.len();
        let list = self.kind.name();
        let count = most.vehicles.len();
        if most.items == 0 {
            return text!("carried-most-none", count = count, all = all, list = list);
        }
        text!(
            "carried-most",
            count = count,
            all = all,
            list = list,
            mark = most.mark.to_string(),
            items = most.items
        )
    }
}

/// The vehicles whose list differs from the most common one, with the lists that they carry.
fn differ(groups: &[SameList]) -> Text {
    let mut ids: Vec<VehicleId> = groups
        .iter()
        .flat_map(|group| group.vehicles.iter().copied())
        .collect();
    ids.sort_unstable();
    let mut sorted: Vec<&SameList> = groups.iter().collect();
    sorted.sort_by_key(|group| group.vehicles.first().copied());
    let details = sorted.into_iter().map(|group| {
        let vehicles = ranges(group.vehicles.iter().copied());
        if group.items == 0 {
            return text!("carried-none", vehicles = vehicles);
        }
        let mark = group.mark.to_string();
        text!(
            "carried-other",
            vehicles = vehicles,
            items = group.items,
            mark = mark
        )
    });
    text!(
        "carried-differ",
        count = ids.len(),
        vehicles = ranges(ids),
        details = Text::joined(", ", details.collect())
    )
}

/// A vehicle's list of a kind, without home, and the state of its download.
fn list(vehicle: &Vehicle, kind: ListKind) -> (Transfer, Option<&[Item]>) {
    fn items<T>(stored: &Stored<T>, of: fn(&T) -> &[Item]) -> Option<&[Item]> {
        stored.content.as_deref().map(of)
    }
    let plans = &vehicle.plans;
    match kind {
        ListKind::Plan => (plans.plan.transfer, items(&plans.plan, |it| it.flown())),
        ListKind::Fence => (plans.fence.transfer, items(&plans.fence, |it| &it.items)),
        ListKind::Rally => (plans.rally.transfer, items(&plans.rally, |it| &it.items)),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::vehicle::Plan;

    /// A vehicle with this many items after home; `None` if its plan has not been read.
    fn carrying(id: u8, items: Option<usize>) -> Vehicle {
        let mut vehicle = Vehicle::new(id, 1);
        let item = |at: usize| Item {
            command: 16,
            x: at as i32,
            ..Item::default()
        };
        // Homes differ from vehicle to vehicle, and do not count.
        let home = item(usize::from(id) * 1000);
        vehicle.plans.plan = Stored {
            content: items.map(|count| {
                let items = std::iter::once(home).chain((0..count).map(item));
                Arc::new(Plan {
                    items: items.collect(),
                    home_first: true,
                })
            }),
            transfer: items.map_or(Transfer::Unasked, |_| Transfer::Done),
        };
        vehicle
    }

    fn said(plans: &[Option<usize>]) -> String {
        let vehicles: Vec<Vehicle> = plans
            .iter()
            .zip(1u8..)
            .map(|(items, id)| carrying(id, *items))
            .collect();
        CarriedLists::of(ListKind::Plan, &vehicles)
            .text()
            .to_string()
    }

    #[test]
    fn most_are_named_first_and_then_those_that_differ() {
        let same = said(&[Some(3); 4]);
        assert!(
            same.starts_with("4 of 4 carry plan ") && same.ends_with(" (3 items)"),
            "{same}"
        );
        let mut plans = vec![Some(3); 16];
        (plans[3], plans[8], plans[15]) = (Some(2), Some(0), None);
        let mixed = said(&plans);
        let mark = same.split_whitespace().nth(5).expect("a mark").to_owned();
        let other =
            ContentHash::of(&carrying(1, Some(2)).plans.plan.content.expect("read").items[1..]);
        assert_eq!(
            mixed,
            format!(
                "13 of 16 carry plan {mark} (3 items); 4,9 differ: 4 with 2 items ({other}), 9 with none; not read yet: 16"
            )
        );
    }

    #[test]
    fn nothing_on_board_and_nothing_read_are_different() {
        assert_eq!(said(&[Some(0), Some(0)]), "2 of 2 carry no plan");
        assert_eq!(said(&[None, None]), "not read yet: 1-2");
        assert!(
            said(&[Some(0), Some(5)]).starts_with("1 of 2 carries plan "),
            "a plan before none"
        );
    }

    #[test]
    fn lists_are_the_same_only_if_all_are_known() {
        let same = |plans: &[Option<usize>]| {
            let vehicles: Vec<Vehicle> = plans
                .iter()
                .zip(1u8..)
                .map(|(it, id)| carrying(id, *it))
                .collect();
            CarriedLists::of(ListKind::Plan, &vehicles).are_same()
        };
        assert!(same(&[Some(2), Some(2)]));
        assert!(!same(&[Some(2), None]) && !same(&[Some(2), Some(3)]) && !same(&[]));
        let mut vehicle = carrying(3, Some(1));
        vehicle.plans.fence.transfer = Transfer::Unsupported;
        let fences = CarriedLists::of(ListKind::Fence, [&vehicle]);
        assert_eq!(fences.text().to_string(), "no such list: 3");
    }
}
