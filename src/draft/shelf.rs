//! The drafts that are open at the same time.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::Draft;
use crate::plan::Document;
use crate::vehicle_id::VehicleId;

/// Drafts in the order in which they were opened; one of them is the current one, if there are any.
#[derive(Debug, Clone, Default)]
pub struct Drafts {
    all: Vec<Draft>,
    current: usize,
}

impl Drafts {
    pub fn all(&self) -> &[Draft] {
        &self.all
    }

    /// The index of the current draft; 0 if there are none.
    pub fn current_index(&self) -> usize {
        self.current
    }

    pub fn current(&self) -> Option<&Draft> {
        self.all.get(self.current)
    }

    pub fn current_mut(&mut self) -> Option<&mut Draft> {
        self.all.get_mut(self.current)
    }

    /// Records that a draft was written to a file, which becomes the draft's file. The draft is
    /// also named after the file, unless it is meant for a vehicle or another draft has that name.
    pub fn note_saved(&mut self, name: &str, path: &str, document: Arc<Document>) {
        let is_free = name == path || self.all.iter().all(|draft| draft.name != path);
        let Some(draft) = self.all.iter_mut().find(|draft| draft.name == name) else {
            return;
        };
        draft.kept = Some(document);
        draft.file = Some(path.to_owned());
        if is_free && draft.vehicle.is_none() {
            path.clone_into(&mut draft.name);
        }
    }

    /// Adds drafts, and makes the first of them the current one. An open draft of the same name
    /// takes over the new content; undo restores the earlier content.
    pub fn put(&mut self, drafts: impl IntoIterator<Item = Draft>) {
        let mut first = None;
        for mut draft in drafts {
            draft.slot = self.free_slot();
            let known = self.all.iter().position(|it| it.name == draft.name);
            let at = known.unwrap_or(self.all.len());
            match known {
                Some(at) => self.all[at].become_draft(draft),
                None => self.all.push(draft),
            }
            first.get_or_insert(at);
        }
        self.current = first.unwrap_or(self.current);
    }

    /// Replaces the content of the draft that has exactly the content `before`; undo restores it.
    pub fn change(&mut self, before: &Arc<Document>, document: Arc<Document>) {
        let mut all = self.all.iter_mut();
        if let Some(draft) = all.find(|draft| Arc::ptr_eq(&draft.now, before)) {
            draft.note_change(document);
        }
    }

    /// Whether a draft still has exactly this content (this document, not an equal one).
    pub fn has_content(&self, document: &Arc<Document>) -> bool {
        self.all
            .iter()
            .any(|draft| Arc::ptr_eq(&draft.now, document))
    }

    /// Makes a draft the current one; false if none has this name.
    pub fn choose(&mut self, name: &str) -> bool {
        let at = self.all.iter().position(|draft| draft.name == name);
        self.current = at.unwrap_or(self.current);
        at.is_some()
    }

    /// Makes another draft the current one: the draft `by` places further on in the order, which
    /// wraps around at the ends.
    pub fn turn(&mut self, by: isize) {
        let count = self.all.len() as isize;
        if count > 0 {
            self.current = (self.current as isize + by).rem_euclid(count) as usize;
        }
    }

    /// Closes the drafts that are meant for one of these vehicles.
    pub fn drop_of(&mut self, vehicles: &[VehicleId]) {
        let is_theirs = |draft: &Draft| draft.vehicle.is_some_and(|id| vehicles.contains(&id));
        let before = self.all.iter().take(self.current);
        self.current -= before.filter(|draft| is_theirs(draft)).count();
        self.all.retain(|draft| !is_theirs(draft));
        self.current = self.current.min(self.all.len().saturating_sub(1));
    }

    /// Closes the current draft.
    pub fn close(&mut self) {
        if self.current < self.all.len() {
            self.all.remove(self.current);
        }
        self.current = self.current.min(self.all.len().saturating_sub(1));
    }

    /// The lowest number that is free among the drafts without a vehicle.
    fn free_slot(&self) -> usize {
        let own = self.all.iter().filter(|draft| draft.vehicle.is_none());
        let taken: BTreeSet<usize> = own.map(|draft| draft.slot).collect();
        (0..=taken.len())
            .find(|slot| !taken.contains(slot))
            .unwrap_or_default()
    }

    /// A name that no draft has: the proposed name, with a number appended if it is taken.
    pub fn free_name(&self, proposed: &str) -> String {
        let is_free = |name: &str| self.all.iter().all(|draft| draft.name != name);
        let numbered = (2..).map(|number: usize| format!("{proposed}-{number}"));
        let mut names = std::iter::once(proposed.to_owned()).chain(numbered);
        names.find(|name| is_free(name)).unwrap_or_default()
    }
}
