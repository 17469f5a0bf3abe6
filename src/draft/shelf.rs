//! The drafts that are open at the same time.

use super::Draft;

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

    /// The index of the current one; 0 if there are none.
    pub fn current_index(&self) -> usize {
        self.current
    }

    pub fn current(&self) -> Option<&Draft> {
        self.all.get(self.current)
    }

    pub fn current_mut(&mut self) -> Option<&mut Draft> {
        self.all.get_mut(self.current)
    }

    pub fn get_mut(&mut self, name: &str) -> Option<&mut Draft> {
        self.all.iter_mut().find(|draft| draft.name == name)
    }

    /// Adds drafts, and makes the first of them the current one. Each takes the place of one of the same name.
    pub fn put(&mut self, drafts: impl IntoIterator<Item = Draft>) {
        let mut first = None;
        for draft in drafts {
            let known = self.all.iter().position(|it| it.name == draft.name);
            let at = known.unwrap_or(self.all.len());
            if known.is_some() {
                self.all[at] = draft;
            } else {
                self.all.push(draft);
            }
            first.get_or_insert(at);
        }
        self.current = first.unwrap_or(self.current);
    }

    /// Makes a draft the current one; false if there is none of this name.
    pub fn choose(&mut self, name: &str) -> bool {
        let at = self.all.iter().position(|draft| draft.name == name);
        self.current = at.unwrap_or(self.current);
        at.is_some()
    }

    /// Makes another draft the current one, by its distance in the order.
    pub fn turn(&mut self, by: isize) {
        let count = self.all.len() as isize;
        if count > 0 {
            self.current = (self.current as isize + by).rem_euclid(count) as usize;
        }
    }

    /// Closes the current one.
    pub fn close(&mut self) {
        if self.current < self.all.len() {
            self.all.remove(self.current);
        }
        self.current = self.current.min(self.all.len().saturating_sub(1));
    }

    /// A name that no draft has: the proposed one, or the same followed by a number.
    pub fn free_name(&self, proposed: &str) -> String {
        let is_free = |name: &str| self.all.iter().all(|draft| draft.name != name);
        let numbered = (2..).map(|number: usize| format!("{proposed}-{number}"));
        let mut names = std::iter::once(proposed.to_owned()).chain(numbered);
        names.find(|name| is_free(name)).unwrap_or_default()
    }
}
