//! `[[events]]`: when something happens, and what.

use std::time::Duration;

use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use super::{Faults, Section, seconds};
use crate::diagnostic::Diagnostic;
use crate::mission::event::expression::{Expression, Names};
use crate::mission::event::{Event, Trigger};

mod action;

/// Actions of one event.
const MOST_ACTIONS: usize = 50;
/// Characters of one condition, which is looked at several times a second.
const LONGEST_CONDITION: usize = 1000;
/// The longest time that an event may name.
const LONGEST_S: f64 = 86_400.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct EventFile {
    id: Spanned<String>,
    title: Option<Spanned<String>>,
    title_uk: Option<Spanned<String>>,
    at: Option<Spanned<f64>>,
    when: Option<Spanned<String>>,
    after: Option<Spanned<String>>,
    delay: Option<Spanned<f64>>,
    by: Option<Spanned<String>>,
    once: Option<bool>,
    jitter: Option<Spanned<f64>>,
    p: Option<Spanned<f64>>,
}

/// The ids of events and of what they bring, as far as they can be made out, for those who refer to them.
pub(super) fn declared(value: Option<&Spanned<DeValue<'_>>>) -> (Vec<String>, Vec<String>) {
    let tables = value.and_then(|value| value.get_ref().as_array());
    let tables = || tables.into_iter().flatten().map(Spanned::get_ref);
    let word = |table: &DeValue<'_>, key: &str| {
        let word = table.get(key)?.get_ref().as_str();
        word.map(str::to_owned)
    };
    let events = tables().map(|table| word(table, "id").unwrap_or_default());
    let spawned = tables()
        .filter_map(|table| table.get("do")?.get_ref().as_array())
        .flatten()
        .filter_map(|action| {
            let action = action.get_ref();
            word(action, "id").or_else(|| word(action, "spawn"))
        });
    (events.collect(), spawned.collect())
}

/// The keys that tell actions, one each.
pub(in crate::mission) fn action_keys() -> impl IntoIterator<Item = &'static str> {
    action::ACTIONS.map(|(key, _)| key)
}

/// Reads one event.
pub(super) fn event(
    value: Spanned<DeValue<'_>>,
    names: &Names<'_>,
    seen: &mut Vec<String>,
    faults: &mut Faults,
) -> Option<Event> {
    let span = value.span();
    let DeValue::Table(mut table) = value.into_inner() else {
        faults.add(span, "a table is needed here, as in [[events]]");
        return None;
    };
    let actions = table.remove("do");
    let file: EventFile = faults.read(Spanned::new(span.clone(), table))?;
    super::check_unique(seen, &file.id, faults);
    let once = file.once.unwrap_or(true);
    let chance = file
        .p
        .as_ref()
        .map_or(1.0, |p| faults.number(p, 0.0..=1.0, "p"));
    let jitter = time(file.jitter.as_ref(), "jitter", faults);
    let id = file.id.get_ref().clone();
    let trigger = trigger(&file, span.clone(), names, faults);
    let actions = match actions.map(|actions| (actions.span(), actions.into_inner())) {
        Some((span, DeValue::Array(list))) => action_list(list, span, names, faults),
        Some((span, _)) => {
            faults.add(span, "a list of actions is needed here: do = [{ .. }]");
            Vec::new()
        }
        None => {
            faults.add(span, "missing field `do`");
            Vec::new()
        }
    };
    let title = match file.title {
        Some(title) => faults.written(title, file.title_uk, "title_uk"),
        None => crate::text::Text::verbatim(id.clone()),
    };
    Some(Event {
        id,
        title,
        trigger: trigger?,
        once,
        jitter,
        chance,
        actions,
    })
}

fn action_list(
    list: DeArray<'_>,
    span: std::ops::Range<usize>,
    names: &Names<'_>,
    faults: &mut Faults,
) -> Vec<crate::mission::event::Action> {
    if !(1..=MOST_ACTIONS).contains(&list.len()) {
        faults.add(span, format!("an event has 1 to {MOST_ACTIONS} actions"));
        return Vec::new();
    }
    let list = list.into_iter();
    list.filter_map(|value| action::action(value, names, faults))
        .collect()
}

fn trigger(
    file: &EventFile,
    span: std::ops::Range<usize>,
    names: &Names<'_>,
    faults: &mut Faults,
) -> Option<Trigger> {
    let delay = time(file.delay.as_ref(), "delay", faults);
    match (&file.at, &file.when, &file.after, &file.by) {
        (Some(at), None, None, None) => Some(Trigger::At(time(Some(at), "at", faults))),
        (None, Some(when), None, None) => condition(when, names, faults).map(Trigger::When),
        (None, None, Some(after), None) => {
            Some(Trigger::After(known_event(after, names, faults)?, delay))
        }
        (None, None, None, Some(by)) if by.get_ref() == "instructor" => Some(Trigger::Instructor),
        (None, None, None, Some(by)) => {
            faults.unknown("originator", by, &["instructor"]);
            None
        }
        _ => {
            let message = "an event has exactly one of `at` (seconds), `when` (a condition), `after` \
                           (another event) and `by = \"instructor\"`";
            faults.add(span, message);
            None
        }
    }
}

/// A length of time; a missing one is none.
fn time(value: Option<&Spanned<f64>>, name: &str, faults: &mut Faults) -> Duration {
    let value_s = value.map_or(0.0, |value| faults.number(value, 0.0..=LONGEST_S, name));
    seconds(value_s).unwrap_or_default()
}

/// A condition; a fault in it is placed within its string.
fn condition(
    written: &Spanned<String>,
    names: &Names<'_>,
    faults: &mut Faults,
) -> Option<Expression> {
    if written.get_ref().len() > LONGEST_CONDITION {
        let fault = format!("a condition may have {LONGEST_CONDITION} characters");
        faults.add(written.span(), fault);
        return None;
    }
    match Expression::parse(written.get_ref(), names) {
        Ok(expression) => Some(expression),
        Err(fault) => {
            let fault: Diagnostic = fault.in_string(written.span(), written.get_ref().len());
            faults.found.push(fault);
            None
        }
    }
}

/// The place of an event in the file, by its id.
fn known_event(name: &Spanned<String>, names: &Names<'_>, faults: &mut Faults) -> Option<usize> {
    let found = names.events.iter().position(|id| id == name.get_ref());
    if found.is_none() {
        faults.unknown("event", name, names.events);
    }
    found
}

/// A table as a section, for reading it into a type.
fn section(span: std::ops::Range<usize>, table: DeTable<'_>) -> Section<'_> {
    Spanned::new(span, table)
}
