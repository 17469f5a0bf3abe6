//! Finds the position of a seat in its journal.

use std::sync::Arc;
use std::time::Duration;

use super::plan::LessonPlan;
use super::position::{GivenDeed, GivenNote, HoldReason, LessonPosition};
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
    let steps = path_in(journal, plan);
    let given = given_in(journal, &note, &plan.steps[step].deeds);
    // A step to which the instructor has gone back is noted without its condition.
    let is_planned = plan.note(Some(step)) == Deed::Step(note.step.clone());
    let note = GivenNote {
        id: Some(note.id),
        at: now,
        outcome: Some(note.outcome),
    };
    let mut position = LessonPosition::found(Arc::clone(plan), &steps, note, now)?;
    if !is_planned {
        position.hold(HoldReason::Back);
    }
    Some(FoundPosition { position, given })
}

/// The steps of the lesson since it began, oldest first.
fn path_in(journal: &JournalCopy, plan: &LessonPlan) -> Vec<usize> {
    let mut seen: Vec<(OrderId, usize)> = Vec::new();
    for note in notes(journal) {
        let is_same = note.step.lesson == plan.name;
        let Some(id) = note.step.step.as_ref().filter(|_| is_same) else {
            break;
        };
        let is_new = seen.iter().all(|(id, _)| *id != note.id);
        if let Some(step) = plan.step(id).filter(|_| is_new) {
            seen.push((note.id, step));
        }
    }
    seen.reverse();
    seen.into_iter().map(|(_, step)| step).collect()
}

/// The first orders of a step that were given after its note, as far as they follow each other.
fn given_in(journal: &JournalCopy, note: &Note<'_>, deeds: &[Deed]) -> Vec<GivenDeed> {
    let ended: Vec<_> = journal
        .entries()
        .filter_map(|entry| match &entry.what {
            Happening::Order { id, deed, outcome } => Some((*id, deed, *outcome)),
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
