//! From a line to the vehicles: targets, the question before something dangerous, the ledger.

use super::{act, batch};
use crate::app::State;
use crate::app::action::Action;
use crate::app::effect::{Effect, SessionEffect};
use crate::app::keymap::Place;
use crate::app::lines;
use crate::app::room::{Room, parameters, workshop};
use crate::app::state::{Confirm, Consequence, Overlay};
use crate::commands::{Act, Deed, Order};
use crate::diagnostic::Diagnostic;
use crate::language::{Meaning, Statement, ranges};
use crate::ledger::{LedgerEntry, RowUpdate};
use crate::operator::{first_word, read_order};
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::verb::Danger;

/// Up to so many targets are named one by one.
const NAMED_TARGETS: usize = 12;

/// Reads a command line and finds its targets.
pub fn prepare(state: &State, line: &str) -> Result<Order, Diagnostic> {
    state.with_context(|context| {
        let permit = |statement: &Statement| permit(state, line, statement);
        read_order(line, context, &state.addressed(), permit)
    })
}

/// Refuses what cannot be said now.
fn permit(state: &State, line: &str, statement: &Statement) -> Result<(), Diagnostic> {
    if state.session.is_starting() && state.flown_mission().is_some() {
        return Err(Diagnostic::new(
            first_word(line),
            text!(
                "hangar-not-begun",
                key = state.key(Action::Show(Room::Hangar))
            ),
        ));
    }
    if state.session.paused && !is_word(state, statement) {
        return Err(
            Diagnostic::new(first_word(line), text!("pause-refuses")).with_help(text!(
                "pause-refuses-help",
                key = state.key(Action::PauseMission)
            )),
        );
    }
    match statement.meaning {
        Meaning::Wait(_) => Err(lines::only_in_scripts(line)),
        Meaning::Act(_) => Ok(()),
    }
}

/// Whether it is nothing but the trainee's word before launch, which moves nothing.
fn is_word(state: &State, statement: &Statement) -> bool {
    if !state.can_pledge() {
        return false;
    }
    matches!(
        statement.meaning,
        Meaning::Act(Act::Deed(Deed::Predict { .. } | Deed::Goal(_)))
    )
}

/// What Enter does with an order.
pub fn announced(state: &State, order: &Order) -> Text {
    let targets = ranges(order.targets.iter().copied());
    let key = state.keymap.key(Action::Submit, Place::Prompt);
    match order.verb.danger {
        Danger::None => text!("palette-sends", key = key, vehicles = targets),
        Danger::Confirm => text!("palette-asks", key = key, vehicles = targets),
    }
}

/// Sends a command off, or asks before a dangerous one.
pub fn give(state: &mut State, order: Order) -> Vec<Effect> {
    if order.verb.danger == Danger::None {
        return carry_out(state, Consequence::Order(order));
    }
    let count = order.targets.len();
    let named = if count > NAMED_TARGETS {
        ranges(order.targets.iter().copied())
    } else {
        let ids = order.targets.iter().map(VehicleId::to_string);
        ids.collect::<Vec<_>>().join(" ")
    };
    state.overlay = Some(Overlay::Confirm(Confirm {
        question: text!(
            "order-question",
            verb = order.verb.name.to_uppercase(),
            count = count,
            vehicles = named
        ),
        reason: Text::new(format!("verb-{}", order.verb.name), Vec::new()),
        answer: count.to_string(),
        typed: String::new(),
        cancelled: false,
        then: Consequence::Order(order),
    }));
    Vec::new()
}

/// Does what was confirmed, or needed no question.
pub fn carry_out(state: &mut State, consequence: Consequence) -> Vec<Effect> {
    let order = match consequence {
        Consequence::Order(order) => order,
        Consequence::Effect(effect) => {
            if effect == Effect::Session(SessionEffect::Leave) {
                act::go_home(state);
            }
            return vec![effect];
        }
        Consequence::Parameters(settings) => return batch::begin(state, settings),
        Consequence::Design(design) => {
            workshop::lay(state, design);
            return Vec::new();
        }
    };
    let now = state.now;
    let entry = state.session.open(now, order.given(), &order.targets);
    parameters::note_order(state, &order, entry);
    state.rooms.ledger.spoil();
    vec![Effect::Order { entry, order }]
}

/// An order advanced with one vehicle: the ledger takes it over, and what waited for it may follow.
pub fn advanced(state: &mut State, row: &RowUpdate) -> Vec<Effect> {
    let ledger = &mut state.session.ledger;
    let was_over = ledger.entry(row.entry).is_none_or(LedgerEntry::is_final);
    ledger.apply(row);
    state.rooms.ledger.spoil();
    if !was_over {
        parameters::tell(state, row.entry);
    }
    batch::advance(state)
}
