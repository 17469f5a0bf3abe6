//! Views of the state that depend on the rooms' own state.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::State;
use std::collections::BTreeSet;

use crate::class::SeatRecord;
use crate::geo::Outline;
use crate::language::{
    Channel, Context, Listed, NameList, Named, Names, OfferedModes, VehicleChoice, field_text,
};
use crate::parameters::ParameterDocuments;
use crate::plan::field;
use crate::preflight::summary;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::vehicle_id::ranges;

/// The names known to the state and to the rooms.
#[derive(Debug)]
struct Known<'a>(&'a State);

impl Names for Known<'_> {
    fn listed(&self, list: NameList) -> Listed {
        match list {
            NameList::Draft => drafts(self.0),
            NameList::ItemField => Listed::Names(item_fields(self.0)),
            NameList::Room
            | NameList::Theme
            | NameList::Mission
            | NameList::Inject
            | NameList::Macro
            | NameList::PlanFile
            | NameList::Seat
            | NameList::SeatInject
            | NameList::Situation
            | NameList::Crew => self.0.listed(list),
            NameList::Lesson => lessons(self.0),
            NameList::Trainee => trainees(self.0),
            NameList::Exam => exams(self.0),
            NameList::Rubric => Listed::Anything,
        }
    }

    fn about_parameter(&self, name: &str, value: f64) -> String {
        let document = self.0.documents().get(name);
        document.map_or_else(String::new, |it| it.about(value))
    }
}

/// The trainees who have handed something in or have a seat; before the records are read, any name will do.
fn trainees(state: &State) -> Listed {
    let Some(desk) = state.class.desk() else {
        return Listed::Nothing(text!("class-no-desk"));
    };
    let Some(results) = state.rooms.class.results() else {
        return Listed::Anything;
    };
    let seated = desk.seats().iter().map(SeatRecord::user);
    let users = results.trainees.iter().map(|it| it.user.as_str());
    let users: BTreeSet<&str> = users.chain(seated).collect();
    let named = users.into_iter().map(|user| Named {
        name: user.to_owned(),
        meaning: Text::default(),
    });
    Listed::Names(named.collect())
}

/// The lessons of the desk; before they are read, any name will do.
fn lessons(state: &State) -> Listed {
    if state.class.desk().is_none() {
        return Listed::Nothing(text!("class-no-desk"));
    }
    let Some(listed) = state.rooms.class.lessons.listed() else {
        return Listed::Anything;
    };
    let good = listed.good.iter().map(|lesson| Named {
        name: lesson.plan.name.to_string(),
        meaning: lesson.title.clone(),
    });
    // The desk that begins one shows its faults.
    let faulty = listed.faulty.iter().map(|lesson| Named {
        name: lesson.name.clone(),
        meaning: text!("class-lesson-has-faults"),
    });
    Listed::Names(good.chain(faulty).collect())
}

/// The exams of the desk; before they are read, any name will do.
fn exams(state: &State) -> Listed {
    if state.class.desk().is_none() {
        return Listed::Nothing(text!("class-no-desk"));
    }
    let Some(listed) = &state.rooms.class.exams else {
        return Listed::Anything;
    };
    Listed::Names(listed.clone())
}

fn drafts(state: &State) -> Listed {
    let drafts = state.rooms.plans.drafts().all();
    if drafts.is_empty() {
        return Listed::Nothing(text!("draft-none"));
    }
    let named = drafts.iter().map(|draft| Named {
        name: draft.name().to_owned(),
        meaning: summary(draft.document()),
    });
    Listed::Names(named.collect())
}

/// The parameters of the plan item under the cursor, with their values.
fn item_fields(state: &State) -> Vec<Named> {
    let room = &state.rooms.plans;
    let item = room.row().and_then(|row| room.items().get(row));
    let fields = item.map_or(&[][..], |item| field::fields(item.command));
    let value = |field: &field::Field| item.map_or(0.0, |item| field.value(item));
    let named = fields.iter().map(|field| Named {
        name: field.name.to_owned(),
        meaning: Text::verbatim(field_text(value(field), field.unit)),
    });
    named.collect()
}

/// The name of the area that is drawn in the current draft.
const DRAWN: &str = "drawn";

/// The areas of the current draft by name: the one under the cursor as `drawn`, and each as
/// `drawn-N` if there are several. At a member of a crew there are none: its lines are read again by the host, who has
/// other drafts.
fn drawn(state: &State) -> Vec<(String, Outline)> {
    if state.crew.member().is_some() {
        return Vec::new();
    }
    let (areas, at) = state.rooms.plans.drawn();
    let own = areas.get(at).map(|area| (DRAWN.to_owned(), area.clone()));
    let numbered = areas.iter().enumerate().filter(|_| areas.len() > 1);
    let numbered = numbered.map(|(at, area)| (format!("{DRAWN}-{}", at + 1), area.clone()));
    own.into_iter().chain(numbered).collect()
}

impl State {
    /// The documentation of parameters for the vehicle under the cursor.
    pub fn documents(&self) -> &ParameterDocuments {
        self.documents_of(self.session.choice.cursor)
    }

    /// The documentation of a vehicle's parameters: its own, once that has been read, otherwise that of the user's file.
    pub fn documents_of(&self, vehicle: Option<VehicleId>) -> &ParameterDocuments {
        let own = vehicle.and_then(|vehicle| self.rooms.parameters.own_documents(vehicle));
        own.unwrap_or(&self.documents)
    }

    /// Runs `work` with the grammar's context: groups, places, vehicles.
    pub fn with_context<T>(&self, work: impl FnOnce(&Context<'_>) -> T) -> T {
        let vehicles: Vec<VehicleId> = self.session.vehicles.keys().copied().collect();
        let named = self.session.task.areas.iter();
        let named = named.map(|area| (area.name.clone(), area.outline.clone()));
        // Of two areas with the same name, that of the mission counts.
        let areas: BTreeMap<String, Outline> = drawn(self).into_iter().chain(named).collect();
        let first = self.addressed().first().copied();
        let parameters = first.and_then(|id| self.rooms.parameters.lists.get(&id));
        let modes = OfferedModes::of(self.session.vehicles.values().map(Arc::as_ref));
        work(&Context {
            modes: modes.as_ref(),
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

    /// Refuses vehicles that have not been heard from, because the grammar accepts every number.
    ///
    /// # Errors
    /// The first unknown vehicle, with the list of known ones.
    pub(in crate::app) fn check_known(&self, ids: &[VehicleId]) -> Result<(), Text> {
        let known = &self.session.vehicles;
        let Some(unknown) = ids.iter().find(|id| !known.contains_key(id)) else {
            return Ok(());
        };
        if known.is_empty() {
            return Err(text!("grammar-no-vehicles-yet"));
        }
        let known = ranges(known.keys().copied());
        Err(text!(
            "grammar-no-vehicle",
            vehicle = *unknown,
            known = known
        ))
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
