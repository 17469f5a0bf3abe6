//! Finds the position of a seat in its journal.

use std::sync::Arc;
use std::time::Duration;

use super::plan::LessonPlan;
use super::position::{FoundWay, GivenDeed, GivenNote, HoldReason, LessonPosition, REMEMBERED};
use crate::{Deed, Happening, JournalCopy, NotedStep, OrderId, Outcome, Words};

/// A position that was found.
pub(crate) struct FoundPosition {
    pub position: LessonPosition,
    /// The orders of the step that were given already.
    pub given: Vec<GivenDeed>,
}

/// A note in a journal.
struct Note<'a> {
    id: OrderId,
    outcome: Outcome,
    step: &'a NotedStep,
}

/// The notes, newest first; a note with a condition has several outcomes.
fn notes(journal: &JournalCopy) -> impl Iterator<Item = Note<'_>> {
    journal
        .entries()
        .rev()
        .filter_map(|entry| match &entry.what {
            Happening::Order {
                id,
                deed: Deed::Step(step),
                outcome,
                ..
            } => Some(Note {
                id: *id,
                outcome: *outcome,
                step,
            }),
            _ => None,
        })
}

/// The lesson that a seat is in, by its journal.
pub(crate) fn lesson_in(journal: &JournalCopy) -> Option<&Words> {
    let newest = newest(journal)?;
    newest.step.step.as_ref().map(|_| &newest.step.lesson)
}

/// The newest note. The end of the note before it follows it in the journal.
fn newest(journal: &JournalCopy) -> Option<Note<'_>> {
    notes(journal).find(|note| note.outcome != Outcome::Disarmed)
}

/// The position of a seat in a lesson, by its journal; `None` if the plan has no such step.
pub(crate) fn position_in(
    journal: &JournalCopy,
    plan: &Arc<LessonPlan>,
    now: Duration,
) -> Option<FoundPosition> {
    let note = newest(journal)?;
    let step = plan.step(note.step.step.as_ref()?)?;
    let way = way_in(journal, plan, note.step.before);
    let given = given_in(journal, &note, &plan.steps[step].deeds);
    let is_held = note.step.is_held;
    let note = GivenNote {
        id: Some(note.id),
        at: now,
        outcome: Some(note.outcome),
    };
    let mut position = LessonPosition::found(Arc::clone(plan), step, way, note, now);
    if is_held {
        position.hold(HoldReason::Back);
    }
    Some(FoundPosition { position, given })
}

/// The way of a seat through a lesson to the step with this many steps before it.
fn way_in(journal: &JournalCopy, plan: &LessonPlan, before: u32) -> FoundWay {
    let mut way = FoundWay {
        path: Vec::new(),
        forgotten: before,
    };
    let same = notes(journal).take_while(|note| note.step.lesson == plan.name);
    for NotedStep { step, before, .. } in same.map(|note| note.step) {
        // Of a step that was noted again, and of those from which the instructor went back, only the newest count.
        let is_before = *before < way.forgotten && way.path.len() < REMEMBERED;
        let known = step.as_ref().filter(|_| is_before);
        if let Some(step) = known.and_then(|id| plan.step(id)) {
            way.path.push(step);
            way.forgotten = *before;
        }
    }
    way.path.reverse();
    way
}

/// The first orders of a step that were given after its note, as far as they follow each other.
fn given_in(journal: &JournalCopy, note: &Note<'_>, deeds: &[Deed]) -> Vec<GivenDeed> {
    let ended: Vec<_> = journal
        .entries()
        .filter_map(|entry| match &entry.what {
            Happening::Order {
                id, deed, outcome, ..
            } => Some((*id, deed, *outcome)),
            _ => None,
        })
        .collect();
    // Orders of another opening of the desk were given before the note.
    let later = |id: OrderId| id.desk == note.id.desk && id.number > note.id.number;
    let mut given = Vec::new();
    let mut after = note.id.number;
    for deed in deeds {
        let mut same = ended
            .iter()
            .filter(|(id, it, _)| later(*id) && id.number > after && *it == deed);
        let Some((id, ..)) = same.next() else {
            break;
        };
        after = id.number;
        let newest = ended.iter().rev().find(|(it, ..)| it == id);
        given.push(GivenDeed {
            outcome: newest.map(|(.., outcome)| *outcome),
            ..GivenDeed::new(*id, deed)
        });
    }
    given
}
