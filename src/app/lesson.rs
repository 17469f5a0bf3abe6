//! The keys of a lesson's steps.

use super::State;
use super::action::Action;
use super::keymap::{Keymap, Meaning, Place};
use super::room_list::Room;
use crate::mission::{Progress, STEP_KEY};

/// Inserts the currently bound key into a lesson's step.
pub fn name_key(state: &State, progress: &mut Progress) {
    if let Some(step) = &mut progress.lesson
        && let Some(name) = step.key.take()
    {
        // Without a key, the step shows the word to type.
        let key = key_of(&state.keymap, &name).unwrap_or(name);
        step.text = step.text.filled(STEP_KEY, &key);
    }
}

/// The label of the key that performs the named action, or opens the command line with the named
/// verb, in flight; `None` if no key is bound.
pub fn key_of(keymap: &Keymap, name: &str) -> Option<String> {
    let meaning = match Action::named(name) {
        Some(action) => Meaning::Do(action),
        None => Meaning::Write(name.to_owned().into()),
    };
    keymap.label(&meaning, Place::In(Room::Fly))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mission::Mission;

    #[test]
    fn every_key_of_the_first_lesson_is_there() {
        let source = include_str!("../../missions/00-first-flight.toml");
        let mission = Mission::parse(source).expect("it is good");
        let names: Vec<&str> = mission
            .advice
            .lesson
            .iter()
            .filter_map(|it| it.key.as_deref())
            .collect();
        assert!(names.len() > 4, "{names:?}");
        for name in names {
            assert!(key_of(&Keymap::default(), name).is_some(), "{name}");
        }
    }
}
