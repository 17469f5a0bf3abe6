//! The profiles to choose from.

use super::State;

/// One line of the list of profiles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Trainee {
    /// Somebody who has a profile.
    Known(String),
    /// Somebody who is to have one.
    New,
    /// Somebody whose flights are not kept.
    Guest,
}

impl<R> State<R> {
    /// Everybody who could train here, in the order of the list.
    pub fn trainees(&self) -> Vec<Trainee> {
        let known = self.profiles.iter().cloned().map(Trainee::Known);
        known.chain([Trainee::New, Trainee::Guest]).collect()
    }

    /// Whether this is who trains here now.
    pub fn is_training(&self, trainee: &Trainee) -> bool {
        let current = self.career.as_ref().map(|career| &career.name);
        match trainee {
            Trainee::Known(name) => current == Some(name),
            Trainee::New => false,
            Trainee::Guest => current.is_none(),
        }
    }
}
