//! `[[events]]`: triggers and their actions.

use std::time::Duration;

use toml::Spanned;

use super::action;
use super::condition::{condition, known_event};
use crate::mission::event::expression::Expression;
use crate::mission::event::{Event, Trigger};
use crate::mission::format::{FileTable, flag, list, number, table as table_of, text, time, word};
use crate::text::Text;

const MOST_ACTIONS: usize = 50;

/// The trigger keys present in the file.
struct WrittenTrigger {
    at: Option<Duration>,
    when: Option<Expression>,
    after: Option<Spanned<String>>,
    delay: Duration,
    by: Option<()>,
}

pub(super) fn event(table: &mut FileTable<'_>) -> Option<Event> {
    let id = table.need("id", text(""), "name for other events and conditions");
    if let Some(id) = &id {
        table.draft().add_id("events", id);
    }
    let title = table.may_text("title", "title shown to instructors (default the id)");
    let trigger = WrittenTrigger::of(table).trigger(table);
    let once = table.or("once", flag(), true, "whether the event happens only once");
    let jitter = table.or(
        "jitter",
        time(),
        Duration::ZERO,
        "the seed moves the time of the event by up to this, in either direction",
    );
    let chance_form = number(0.0, 1.0, "");
    let chance = table.or(
        "p",
        chance_form,
        1.0,
        "probability that the event happens when it is due",
    );
    let actions_form = list(table_of(action::action), 1, MOST_ACTIONS);
    let actions = table.need(
        "do",
        actions_form,
        "actions, each with one of the keys below",
    );
    let id = id?.into_inner();
    Some(Event {
        title: title.unwrap_or_else(|| Text::verbatim(id.clone())),
        id,
        trigger: trigger?,
        once,
        jitter,
        chance,
        actions: actions?,
    })
}

impl WrittenTrigger {
    fn of(table: &mut FileTable<'_>) -> Self {
        Self {
            at: table.may("at", time(), "the event happens at this mission time"),
            when: table.may(
                "when",
                condition(),
                "the event happens when this becomes true (checked twice a second)",
            ),
            after: table.may(
                "after",
                text("id of an event"),
                "the event happens after this one",
            ),
            delay: table.or(
                "delay",
                time(),
                Duration::ZERO,
                "delay after the event in `after`",
            ),
            by: table.may(
                "by",
                word(&[("instructor", ())]),
                "the event happens when an instructor triggers it",
            ),
        }
    }

    fn trigger(self, table: &mut FileTable<'_>) -> Option<Trigger> {
        let keys = ["at", "when", "after", "by"].into_iter();
        if keys.filter(|key| table.is_written(key)).count() != 1 {
            let message = "an event has exactly one of `at` (seconds), `when` (a condition), `after` \
                           (another event) and `by = \"instructor\"`";
            table.fault(message);
            return None;
        }
        match self {
            Self { at: Some(at), .. } => Some(Trigger::At(at)),
            Self {
                when: Some(when), ..
            } => Some(Trigger::When(when)),
            Self {
                after: Some(after),
                delay,
                ..
            } => Some(Trigger::After(known_event(table.draft(), &after)?, delay)),
            Self { by: Some(()), .. } => Some(Trigger::Instructor),
            // Invalid; the fault is already reported.
            Self { .. } => None,
        }
    }
}
