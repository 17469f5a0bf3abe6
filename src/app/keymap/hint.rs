//! Keys in hints and messages: the keys for an action at a place.

use std::borrow::Cow;

use super::{Keymap, Meaning, Place, Press};
use crate::app::action::Action;
use crate::app::room_list::Room;
use crate::language::{VerbRow, rows, words};
use crate::text;
use crate::text::Text;

/// Keys with their meaning, for the last line of the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct KeyHint {
    pub keys: HintKeys,
    /// The id of the message that describes the keys.
    pub about: &'static str,
}

/// The keys of a hint, selected by meaning.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HintKeys {
    /// The first key of each action.
    Actions(&'static [Action]),
    /// The key that opens the command line with this text.
    Words(&'static str),
    /// The keys that open the command line with these texts.
    Lines(&'static [&'static str]),
    /// The keys of a vehicle list, and the one that submits it.
    VehicleList,
}

/// A hint for the keys of actions.
pub const fn hint(actions: &'static [Action], about: &'static str) -> KeyHint {
    let keys = HintKeys::Actions(actions);
    KeyHint { keys, about }
}

/// A hint for the key that opens the command line with a text.
pub const fn hint_words(words: &'static str, about: &'static str) -> KeyHint {
    let keys = HintKeys::Words(words);
    KeyHint { keys, about }
}

impl From<Action> for Meaning {
    fn from(action: Action) -> Self {
        Self::Do(action)
    }
}

impl Meaning {
    /// The meaning that opens the command line with a text.
    pub const fn words(words: &'static str) -> Self {
        Self::Write(Cow::Borrowed(words))
    }

    /// Whether both meanings are the same, apart from trailing spaces in a line, and whether the line is carried out at
    /// once.
    fn leads_where(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Write(one) | Self::Give(one), Self::Write(other) | Self::Give(other)) => {
                one.trim_end() == other.trim_end()
            }
            _ => self == other,
        }
    }
}

impl Keymap {
    /// The label of the first key with a meaning at a place; `None` if no key has it.
    pub fn label(&self, meaning: &Meaning, place: Place) -> Option<String> {
        self.first(meaning, place).map(Press::symbol)
    }

    /// The label of the first key with a meaning at a place, for a message; a fallback text if no
    /// key has it.
    pub fn key(&self, meaning: impl Into<Meaning>, place: Place) -> Text {
        let label = self.label(&meaning.into(), place);
        label.map_or_else(|| text!("key-none"), Text::verbatim)
    }

    /// The first key of each action, in a message.
    pub fn keys(&self, actions: &'static [Action], place: Place) -> Text {
        let label = self.hint_label(HintKeys::Actions(actions), place);
        label.map_or_else(|| text!("key-none"), Text::verbatim)
    }

    /// The description of a meaning, for the help.
    pub fn description(&self, meaning: &Meaning) -> Text {
        match meaning {
            Meaning::Do(action) => Text::new(format!("action-{}", action.name()), Vec::new()),
            Meaning::Write(line) => text!(
                "keys-writes",
                line = line.trim_end(),
                key = self.key(Action::Submit, Place::Prompt)
            ),
            Meaning::Give(line) => text!("keys-gives", line = line.as_ref()),
            Meaning::Type => {
                // All rooms with vehicles have the same key.
                let key = self.key(Action::Submit, Place::In(Room::Fly));
                text!("keys-types", key = key)
            }
        }
    }

    /// The labels of a hint's keys; `None` without any.
    pub fn hint_label(&self, keys: HintKeys, place: Place) -> Option<String> {
        self.open_label(keys, place, |_| true)
    }

    /// The labels of a hint's keys, without those that write lines that are not open; `None` without any.
    pub fn open_label(
        &self,
        keys: HintKeys,
        place: Place,
        is_open: impl Fn(&str) -> bool,
    ) -> Option<String> {
        let label = |meaning: &Meaning| self.label(meaning, place);
        match keys {
            HintKeys::Actions(actions) => {
                let labelled = actions.iter().filter_map(|it| label(&Meaning::Do(*it)));
                let labels: Vec<String> = labelled.collect();
                // The four arrow keys are shown as one.
                let is_cursor = |action: &Action| matches!(action, Action::Move(_));
                let is_short = labels.iter().all(|label| label.len() == 1);
                let is_one = labels.len() == 4 && is_short && actions.iter().all(is_cursor);
                let gap = if is_one { "" } else { " " };
                (!labels.is_empty()).then(|| labels.join(gap))
            }
            HintKeys::Words(words) => label(&Meaning::words(words)),
            HintKeys::Lines(lines) => {
                let open = lines.iter().filter(|line| is_open(line));
                let labelled = open.filter_map(|words| label(&Meaning::words(words)));
                let labels: Vec<String> = labelled.collect();
                (!labels.is_empty()).then(|| labels.join(" "))
            }
            HintKeys::VehicleList => {
                let list = label(&Meaning::Type)?;
                let submit = label(&Meaning::Do(Action::Submit))?;
                Some(format!("{list} {submit}"))
            }
        }
    }

    /// The keys that give commands to vehicles at a place, one for each verb, in the order of the verbs. Keys whose
    /// line names its own targets are left out.
    pub fn command_labels(&self, place: Place) -> Vec<String> {
        let to_vehicles = rows().filter(|row| row.scope.takes_targets());
        let key_of = |row: &VerbRow| {
            let mut bound = self.bindings.iter().map(|binding| &binding.meaning);
            bound.find_map(|meaning| match meaning {
                Meaning::Write(line) | Meaning::Give(line) => {
                    let says = words(line).first().is_some_and(|it| row.is_called(it.text));
                    says.then(|| self.label(meaning, place)).flatten()
                }
                Meaning::Do(_) | Meaning::Type => None,
            })
        };
        to_vehicles.filter_map(key_of).collect()
    }

    fn first(&self, meaning: &Meaning, place: Place) -> Option<Press> {
        let at = |place: Place| {
            let here = self.bindings.iter();
            here.filter(move |it| it.place == place)
        };
        let own = at(place).find(|it| it.meaning.leads_where(meaning));
        let Place::In(_) = place else {
            return own.map(|binding| binding.press);
        };
        own.or_else(|| {
            let mut general = at(Place::Anywhere);
            general.find(|it| it.meaning.leads_where(meaning) && self.is_general(it.press, place))
        })
        .map(|binding| binding.press)
    }

    /// Whether a key has its general meaning at a place: the place neither redefines nor disables
    /// it.
    pub fn is_general(&self, press: Press, place: Place) -> bool {
        let is_silent = self.silent.contains(&(press, place));
        let mut here = self.bindings.iter().filter(|it| it.place == place);
        !is_silent && here.all(|it| !it.press.covers(press))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::action::WorkshopAction;
    use crate::app::keymap::{Binding, key};

    fn keymap(rows: &[(char, Place, Action)]) -> Keymap {
        let bindings = rows.iter().map(|&(c, place, action)| Binding {
            press: key(c),
            place,
            meaning: Meaning::Do(action),
        });
        Keymap::new(bindings.collect())
    }

    #[test]
    fn a_key_that_means_something_else_in_the_room_is_not_shown() {
        let room = Place::In(Room::Workshop);
        let keymap = keymap(&[
            ('b', Place::Anywhere, Action::Brief),
            ('e', Place::Anywhere, Action::Brief),
            ('b', room, Action::Workshop(WorkshopAction::BuyPart)),
            ('q', Place::Anywhere, Action::Quit),
            ('q', room, Action::Leave),
        ]);
        let label = |action: Action, place| keymap.label(&action.into(), place);
        assert_eq!(label(Action::Brief, room), Some("e".to_owned()));
        assert_eq!(label(Action::Brief, Place::Anywhere), Some("b".to_owned()));
        assert_eq!(label(Action::Quit, room), None);
        assert_eq!(keymap.key(Action::Quit, room), text!("key-none"));
    }

    #[test]
    fn keys_of_a_family_hide_those_that_hold_anywhere() {
        let room = Place::In(Room::Fly);
        let mut keymap = keymap(&[('3', Place::Anywhere, Action::Help)]);
        keymap.bindings.push(Binding {
            press: Press::Number,
            place: room,
            meaning: Meaning::Type,
        });
        assert_eq!(keymap.label(&Action::Help.into(), room), None);
    }
}
