//! The user's choice of vehicles, which outlives a session.

use std::collections::BTreeSet;

use crate::language::Groups;
use crate::vehicle::{VehicleId, Vehicles};

/// Vehicles chosen one by one.
pub type Selection = BTreeSet<VehicleId>;

/// The vehicles that receive commands without targets, and the groups that commands may name.
#[derive(Debug, Clone, Default)]
pub struct Choice {
    /// The selected vehicles; without any, commands go to the one under the cursor.
    pub(in crate::app) selection: Selection,
    /// The vehicle under the cursor.
    pub(in crate::app) cursor: Option<VehicleId>,
    /// The groups that commands may name.
    pub(in crate::app) groups: Groups,
    /// Whether the user has moved the cursor.
    cursor_placed: bool,
}

impl Choice {
    /// Takes over an earlier choice, but its cursor only if the user has placed it.
    pub(super) fn keep(&mut self, before: Self) {
        let placed = before.cursor_placed;
        *self = Self {
            cursor: if placed { before.cursor } else { self.cursor },
            cursor_placed: placed || self.cursor_placed,
            ..before
        };
    }

    /// The chosen vehicles: the selection, or the vehicle under the cursor.
    pub fn vehicles(&self) -> Vec<VehicleId> {
        if self.selection.is_empty() {
            self.cursor.into_iter().collect()
        } else {
            self.selection.iter().copied().collect()
        }
    }

    /// Puts the cursor on a vehicle; it then no longer moves by itself.
    pub(in crate::app) fn place_cursor(&mut self, id: VehicleId) {
        self.cursor = Some(id);
        self.cursor_placed = true;
    }

    /// Handles a new vehicle: until the user moves the cursor, it is on the vehicle with the lowest
    /// number.
    pub(super) fn note(&mut self, id: VehicleId) {
        let is_lower = |cursor| id < cursor && !self.cursor_placed;
        if self.cursor.is_none_or(is_lower) {
            self.cursor = Some(id);
        }
    }

    /// The names of a vehicle's groups.
    pub(super) fn groups_of(&self, vehicle: VehicleId) -> Vec<&str> {
        let mine = |members: &[VehicleId]| members.contains(&vehicle);
        let groups = self.groups.iter().filter(|(_, members)| mine(members));
        groups.map(|(name, _)| name.as_str()).collect()
    }

    /// Drops a vehicle; if the cursor was on it, moves the cursor to the nearest remaining vehicle
    /// by number.
    pub(super) fn forget(&mut self, vehicle: VehicleId, remaining: &Vehicles) {
        self.selection.remove(&vehicle);
        for members in self.groups.values_mut() {
            members.retain(|member| *member != vehicle);
        }
        if self.cursor == Some(vehicle) {
            let below = || remaining.range(..vehicle).next_back();
            let nearest = remaining.range(vehicle..).next().or_else(below);
            self.cursor = nearest.map(|(&id, _)| id);
        }
    }
}
