//! Views of the state that depend on the rooms' own state.

use super::State;
use crate::language::{Channel, Context, VehicleChoice};
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

impl State {
    /// Runs `work` with the grammar's context: groups, places, vehicles.
    pub fn with_context<T>(&self, work: impl FnOnce(&Context<'_>) -> T) -> T {
        let vehicles: Vec<VehicleId> = self.session.vehicles.keys().copied().collect();
        let named = self.session.task.areas.iter();
        let areas = named
            .map(|area| (area.name.clone(), area.outline.clone()))
            .collect();
        let first = self.addressed().first().copied();
        let parameters = first.and_then(|id| self.rooms.parameters.lists.get(&id));
        work(&Context {
            groups: &self.session.choice.groups,
            places: Some(&self.session.places),
            areas: Some(&areas),
            vehicles: &vehicles,
            expected: &self.session.expected,
            class: self.class(),
            parameters: parameters.map(|known| known.list.as_ref()),
            names: self,
            channel: if self.display.has_rooms {
                Channel::Screen
            } else {
                Channel::Plain
            },
        })
    }

    /// The vehicles that a choice selects.
    ///
    /// # Errors
    /// There is no such group.
    pub fn chosen(&self, choice: &VehicleChoice) -> Result<Vec<VehicleId>, Text> {
        Ok(match choice {
            VehicleChoice::All => self.session.all().collect(),
            VehicleChoice::None => Vec::new(),
            VehicleChoice::Filter => self.rooms.fly.rows().to_vec(),
            VehicleChoice::Invert => {
                let shown = self.rooms.fly.rows().iter().copied();
                let others = shown.filter(|id| !self.session.choice.selection.contains(id));
                others.collect()
            }
            VehicleChoice::Ids(ids) => ids.clone(),
            VehicleChoice::Group(name) => {
                let members = self.session.choice.groups.get(name).cloned();
                members.ok_or_else(|| text!("group-unknown", name = name))?
            }
        })
    }
}
