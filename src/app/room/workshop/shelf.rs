//! All designs: the trainee's own, and those that all users share.

use super::{Page, air};
use crate::app::State;
use crate::app::action::{Action, Step, WorkshopAction};
use crate::app::effect::{CareerEffect, Effect};
use crate::app::keymap::Place;
use crate::app::room::Room;
use crate::app::state::Consequence;
use crate::text;
use crate::vehicle::Severity;
use crate::workshop::{Design, Sheet};

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stored<'a> {
    pub design: &'a Design,
    /// Whether the design is the trainee's own.
    pub is_own: bool,
}

/// All designs, the trainee's own first.
pub fn stored(state: &State) -> Vec<Stored<'_>> {
    let own_designs = state
        .training
        .career
        .iter()
        .flat_map(|career| &career.designs);
    let own = own_designs.map(|design| Stored {
        design,
        is_own: true,
    });
    let stock = state.training.stock.iter().map(|design| Stored {
        design,
        is_own: false,
    });
    own.chain(stock).collect()
}

/// Whether the design on the bench is stored without changes, or the bench is empty.
pub fn is_saved(state: &State) -> bool {
    let design = state.rooms.workshop.bench.design();
    design.is_empty() || stored(state).iter().any(|it| it.design == design)
}

/// Handles a change to the trainee's own designs: the bench may match one of them now.
pub fn heard(state: &mut State) {
    let bench = &mut state.rooms.workshop.bench;
    let own = state
        .training
        .career
        .iter()
        .flat_map(|career| &career.designs);
    if own.into_iter().any(|design| design == bench.design()) {
        let design = bench.design().clone();
        let origin = Some(design.name.clone());
        bench.rename(design, origin);
    }
}

/// Opens a design on the bench. Asks first if an unsaved one would be replaced.
pub fn open(state: &mut State, design: Design) {
    if is_saved(state) {
        return lay(state, design);
    }
    let name = state.rooms.workshop.bench.design().name.clone();
    let question = text!("bench-ask-replace", name = name);
    let reason = text!(
        "bench-ask-replace-reason",
        key = state.keymap.key(
            Action::Workshop(WorkshopAction::Undo),
            Place::In(Room::Workshop)
        )
    );
    state.ask(question, reason, Consequence::Design(design));
}

/// Opens a design on the bench.
pub fn lay(state: &mut State, design: Design) {
    let career = state.training.career.as_ref();
    let is_own = career.is_some_and(|it| it.designs.contains(&design));
    let origin = is_own.then(|| design.name.clone());
    let room = &mut state.rooms.workshop;
    room.bench.open(design, origin, air());
    room.page = Page::Bench;
    room.pane = super::Pane::Slots;
}

pub(super) fn begin(state: &mut State) {
    let name = state.locale.say("bench-new-name");
    open(state, Design::new(name));
}

/// In the list, compares the bench with the design under the cursor; elsewhere, opens or closes the
/// list.
pub(super) fn compare_or_choose(state: &mut State) {
    let room = &mut state.rooms.workshop;
    match room.page {
        Page::Compare => room.page = Page::Bench,
        Page::Bench | Page::Fleet => {
            room.page = Page::Designs;
            let key = state.key(Action::Workshop(WorkshopAction::CompareDesign));
            state.say(Severity::Notice, text!("bench-choose-compared", key = key));
        }
        Page::Designs => compare(state),
    }
}

/// A design in the list: the trainee's own, or a shared one.
pub(super) struct ListedDesign {
    pub design: Design,
    /// Whether the design is the trainee's own.
    pub is_own: bool,
}

pub(super) fn under_cursor(state: &State) -> Option<ListedDesign> {
    let all = stored(state);
    let at = state.rooms.workshop.shelf.min(all.len().saturating_sub(1));
    all.get(at).map(|it| ListedDesign {
        design: it.design.clone(),
        is_own: it.is_own,
    })
}

pub(super) fn step(state: &mut State, step: Step) {
    let count = stored(state).len();
    let at = state.rooms.workshop.shelf.min(count.saturating_sub(1));
    state.rooms.workshop.shelf = step.apply(at, count);
}

/// Opens the design under the cursor on the bench.
pub(super) fn open_listed(state: &mut State) {
    if let Some(listed) = under_cursor(state) {
        open(state, listed.design);
    }
}

pub(super) fn ask_take_out(state: &mut State) {
    match under_cursor(state) {
        Some(ListedDesign {
            design,
            is_own: true,
        }) => ask_drop(state, &design),
        Some(_) => refuse(state),
        None => {}
    }
}

/// Reports that shared designs, those of the program or of the administrator, cannot be changed.
pub(super) fn refuse(state: &mut State) {
    state.say(Severity::Warning, text!("bench-not-own"));
}

fn compare(state: &mut State) {
    let all = stored(state);
    let at = state.rooms.workshop.shelf.min(all.len().saturating_sub(1));
    let Some(design) = all.get(at).map(|it| it.design.clone()) else {
        return;
    };
    let sheet = Sheet::of(&design, air());
    let room = &mut state.rooms.workshop;
    room.compared = Some((design, sheet));
    room.page = Page::Compare;
    room.scroll = 0;
}

fn ask_drop(state: &mut State, design: &Design) {
    let name = design.name.as_str();
    let question = text!("bench-ask-delete", name = name);
    let reason = text!("bench-ask-delete-reason");
    let effect = Effect::Career(CareerEffect::DropDesign(name.to_owned()));
    state.ask(question, reason, Consequence::Effect(effect));
}
