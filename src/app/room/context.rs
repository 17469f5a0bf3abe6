//! Views of the state that depend on the rooms' own state.

use super::State;
use crate::language::{Channel, Context, Listed, NameList, Named, Names, VehicleChoice};
use crate::preflight::summary;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// The names that the state knows, with those of the rooms.
#[derive(Debug)]
struct Known<'a>(&'a State);

impl Names for Known<'_> {
    fn listed(&self, list: NameList) -> Listed {
        if list != NameList::Draft {
            return self.0.listed(list);
        }
        let drafts = self.0.rooms.plans.drafts().all();
        if drafts.is_empty() {
            return Listed::Nothing(text!("draft-none"));
        }
        let named = drafts.iter().map(|draft| Named {
            name: draft.name().to_owned(),
            meaning: summary(draft.document()),
        });
        Listed::Names(named.collect())
    }
}

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
            names: &Known(self),
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
