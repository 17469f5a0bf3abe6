//! The profiles to choose from.

use super::State;

/// One line of the list of profiles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Trainee {
    /// A trainee with a profile.
    Known(String),
    /// The entry to create a profile.
    New,
    /// A guest, whose flights are not saved.
    Guest,
}

impl<R> State<R> {
    /// The entries of the list, in order.
    pub fn trainees(&self) -> Vec<Trainee> {
        let known = self.profiles.iter().cloned().map(Trainee::Known);
        known.chain([Trainee::New, Trainee::Guest]).collect()
    }

    /// Whether this is the current trainee.
    pub fn is_training(&self, trainee: &Trainee) -> bool {
        let current = self.career.as_ref().map(|career| &career.name);
        match trainee {
            Trainee::Known(name) => current == Some(name),
            Trainee::New => false,
            Trainee::Guest => current.is_none(),
        }
    }
}
