//! Conditions of events, hints and lessons, and the events that they name.

use toml::Spanned;
use toml::de::DeValue;

use crate::mission::event::expression::{Expression, ExpressionNames, LONGEST};
use crate::mission::format::{Draft, FileShape, FileValue, NameKind};
use crate::text;

/// A condition over the names known so far.
pub(super) fn condition() -> ConditionValue {
    ConditionValue
}

pub(super) struct ConditionValue;

impl FileValue for ConditionValue {
    type Out = Expression;

    fn shape(&self) -> FileShape {
        FileShape::Text("an expression", Some(LONGEST))
    }

    /// Reads a condition; the position of a fault is within the string.
    fn read(
        &self,
        _: &str,
        written: Spanned<DeValue<'_>>,
        draft: &mut Draft,
    ) -> Option<Expression> {
        let place = written.span();
        let source: String = draft.faults.read(written)?;
        if source.len() > LONGEST {
            let fault = text!("fault-condition-long", most = LONGEST);
            draft.faults.add(place, fault);
            return None;
        }
        let names = ExpressionNames {
            zones: &draft.zones,
            objectives: draft.ids("objectives"),
            hazards: draft.ids("hazards"),
            events: &draft.declared.events,
            movers: &draft.declared.movers,
            sensors: &draft.sensors,
            vehicles: draft.pads.len(),
            are_open: false,
        };
        match Expression::parse(&source, &names) {
            Ok(expression) => Some(expression),
            Err(fault) => {
                draft.faults.push(fault.in_string(place, source.len()));
                None
            }
        }
    }
}

/// The index of an event in the file, by its id.
pub(super) fn known_event(draft: &mut Draft, name: &Spanned<String>) -> Option<usize> {
    let events = &draft.declared.events;
    let found = events.iter().position(|id| id == name.get_ref());
    if found.is_none() {
        let known: Vec<&str> = events.iter().map(String::as_str).collect();
        draft.faults.unknown(NameKind::Event, name, &known);
    }
    found
}
