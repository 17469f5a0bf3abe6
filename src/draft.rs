//! Plans, fences and rally points that are being drawn: their content, every change to it, and how
//! to undo it.
//!
//! Keys and typed lines give the same [`Edit`]s. [`Edit::apply`] makes a new document from the old
//! one, so the history of a draft is the list of its documents.
//!
//! # How the parts fit
//! - A change: `edit` names it, `apply` carries it out, with `plan` and `fence` for the parts of a
//!   document; `place` finds where an item goes, or refuses.
//! - What a draft shows: `profile` (legs, times, slopes and heights), `squares` (the ground it
//!   needs), `area` (outlines for surveys).
//! - Before any vehicle gets it: `trial` is what flies in simulation, `flight` the figures of how
//!   it went.
//! - Between sessions: `shelf` holds the open drafts, `kept` turns unsaved ones into text.

use std::sync::Arc;

use crate::plan::Document;
use crate::vehicle_id::VehicleId;

mod apply;
mod area;
mod edit;
mod fence;
mod flight;
mod kept;
mod place;
mod plan;
mod profile;
mod shelf;
mod squares;
#[cfg(test)]
mod tests;
mod trial;

pub use area::{drawn_areas, rings};
pub use edit::{
    Edit, EditPart, Edited, FenceEdit, Insertion, Items, ItemsChange, NewItem, PlanEdit, PlanFrame,
    Refusal, Spot, Surroundings,
};
pub use fence::areas;
pub use flight::{TrialFlight, TrialPilot};
pub use kept::{kept_drafts, kept_text};
pub use place::place;
pub use plan::needs_ground;
pub use profile::{Profile, Stop, ground_above_home, height_above_home, profile};
pub use shelf::Drafts;
pub use squares::squares;
pub use trial::{PlanVerdict, Trial, TrialDraft, Tried};

/// The maximum number of changes that can be undone.
const MOST_CHANGES: usize = 1000;

/// A document that is being drawn.
#[derive(Debug, Clone)]
pub struct Draft {
    name: String,
    vehicle: Option<VehicleId>,
    /// Its number among the open drafts without a vehicle, which decides its sign on the screen; it
    /// keeps the number while it is open.
    slot: usize,
    /// The file that it was read from or last written to.
    file: Option<String>,
    now: Arc<Document>,
    past: Vec<Arc<Document>>,
    undone: Vec<Arc<Document>>,
    kept: Option<Arc<Document>>,
}

impl Draft {
    /// A draft whose content is stored nowhere else. With a vehicle, it is meant for that vehicle
    /// alone.
    pub fn new(
        name: impl Into<String>,
        document: Arc<Document>,
        vehicle: Option<VehicleId>,
    ) -> Self {
        Self {
            name: name.into(),
            vehicle,
            slot: 0,
            file: None,
            now: document,
            past: Vec::new(),
            undone: Vec::new(),
            kept: None,
        }
    }

    /// Marks the content as also stored elsewhere: in a file, or on board.
    #[must_use]
    pub fn kept(mut self) -> Self {
        self.kept = Some(Arc::clone(&self.now));
        self
    }

    /// A draft that was read from a file and is named after it.
    pub fn of_file(path: impl Into<String>, document: Arc<Document>) -> Self {
        let path = path.into();
        Self {
            file: Some(path.clone()),
            ..Self::new(path, document, None).kept()
        }
    }

    /// The file that the draft was read from or last written to, if any.
    pub fn file(&self) -> Option<&str> {
        self.file.as_deref()
    }

    pub fn name(&self) -> &str {
        &self.name
    }

    /// The draft's name without the folder of its file.
    pub fn short_name(&self) -> &str {
        self.name.rsplit(['/', '\\']).next().unwrap_or_default()
    }

    /// The vehicle that the draft is meant for, if it is meant for one alone.
    pub fn vehicle(&self) -> Option<VehicleId> {
        self.vehicle
    }

    /// The draft's number among the open drafts without a vehicle, from 0.
    pub fn slot(&self) -> usize {
        self.slot
    }

    /// The document after the last edit.
    pub fn document(&self) -> &Arc<Document> {
        &self.now
    }

    /// Whether closing the draft loses nothing: it is empty, or its content is also in a file or on
    /// board.
    pub fn is_kept(&self) -> bool {
        let is_same =
            |kept: &Arc<Document>| Arc::ptr_eq(kept, &self.now) || kept.is_same(&self.now);
        self.now.kinds().next().is_none() || self.kept.as_ref().is_some_and(is_same)
    }

    /// Takes over the content of another draft with the same name; undo restores the previous
    /// content.
    fn become_draft(&mut self, other: Self) {
        self.note_change(other.now);
        self.vehicle = other.vehicle;
        self.file = other.file.or(self.file.take());
        self.kept = other.kept;
    }

    /// Changes the content of the draft, and returns the index of the item that the change affects,
    /// if any.
    ///
    /// # Errors
    /// The reason why the change is not possible; nothing changes.
    pub fn edit(&mut self, edit: &Edit, around: &Surroundings) -> Result<Option<usize>, Refusal> {
        let Edited { document, item } = edit.apply(&self.now, around)?;
        self.note_change(Arc::new(document));
        Ok(item)
    }

    fn note_change(&mut self, document: Arc<Document>) {
        if self.past.len() == MOST_CHANGES {
            self.past.remove(0);
        }
        self.past.push(std::mem::replace(&mut self.now, document));
        self.undone.clear();
    }

    /// Goes back to the content before the last change; false if there is none.
    pub fn undo(&mut self) -> bool {
        let Some(before) = self.past.pop() else {
            return false;
        };
        self.undone.push(std::mem::replace(&mut self.now, before));
        true
    }

    /// Goes forward again after [`Self::undo`]; false if there is nothing to redo.
    pub fn redo(&mut self) -> bool {
        let Some(after) = self.undone.pop() else {
            return false;
        };
        self.past.push(std::mem::replace(&mut self.now, after));
        true
    }
}
