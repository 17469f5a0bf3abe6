//! The keys of the help: which of them belong to the section of a place, in the room and the kind of session where the
//! help is opened.
//!
//! They are apart because they follow from the keymap alone, as the commands do from the table of verbs.

use super::desk_keys::DeskView;
use super::line::HelpLine;
use super::replayed::{ReplayUse, replayed};
use crate::app::State;
use crate::app::keymap::{Binding, Keymap, Place, Press};
use crate::app::room_list::Room;
use crate::app::state::MemberPlace;
use crate::app::state::member_rights::is_meant_for_member;
use crate::crew::Role;
use crate::text::{Locale, Text};

/// The context of the help: keymap, room and kind of session.
#[derive(Debug, Clone, Copy)]
pub struct HelpScene<'a> {
    pub keymap: &'a Keymap,
    pub here: Room,
    /// Whether a recorded flight is shown; it takes no commands.
    pub is_replay: bool,
    /// Whether it is an instructor's desk, which flies no vehicles of its own.
    pub is_desk: bool,
    /// The page of the room of the class at a desk.
    pub desk_view: Option<DeskView>,
    /// The role at a member of a crew.
    pub member: Option<Role>,
}

impl State {
    /// The current context of the help.
    pub fn help_scene(&self) -> HelpScene<'_> {
        HelpScene {
            keymap: &self.keymap,
            here: self.room,
            is_desk: self.class.desk().is_some() && self.session.activity.is_none(),
            desk_view: self.class.desk().map(|_| self.rooms.class.view()),
            is_replay: self.shows_past(),
            member: self.crew.member().map(MemberPlace::role),
        }
    }
}

impl HelpScene<'_> {
    /// The keys of a place; keys with the same meaning share a line.
    pub(super) fn keys(self, place: Place, locale: &Locale) -> Vec<HelpLine> {
        let mut rows: Vec<(String, Text)> = Vec::new();
        for binding in self.keymap.bindings() {
            let Some(about) = self.description(binding, place) else {
                continue;
            };
            let label = binding.press.label();
            match rows.iter_mut().find(|(_, known)| *known == about) {
                Some((labels, _)) => {
                    labels.push(' ');
                    labels.push_str(&label);
                }
                None => rows.push((label, about)),
            }
        }
        let lines = rows.into_iter();
        lines
            .map(|(labels, about)| HelpLine::Entry(labels, locale.text(&about)))
            .collect()
    }

    /// Whether the keys of a place can be of use elsewhere than in the present room. A desk without a flight has no rooms
    /// for one; it has no debrief either.
    pub(super) fn has(self, place: Place) -> bool {
        let Place::In(room) = place else {
            return true;
        };
        let is_of_flight = !room.is_apart_from_flight() || room == Room::Debrief;
        !(self.is_desk && !self.is_replay && is_of_flight)
    }

    /// The description of a key in the section of a place; `None` if the key belongs to another
    /// section, or has no effect.
    fn description(&self, binding: &Binding, place: Place) -> Option<Text> {
        let of_desk = self
            .desk_view
            .filter(|_| place == Place::In(Room::Class) && DeskView::knows(&binding.meaning));
        let of_desk = match of_desk {
            Some(view) => Some(view.use_of(&binding.meaning)?),
            None => None,
        };
        let usual = || {
            let general = || self.keymap.description(&binding.meaning);
            of_desk.clone().unwrap_or_else(general)
        };
        // The section of general keys lists only those that the current room leaves as they are.
        let is_changed_here = binding.place == Place::Anywhere
            && !self.keymap.is_general(binding.press, Place::In(self.here));
        if is_changed_here {
            return None;
        }
        if let Some(role) = self.member {
            let is_open =
                binding.place == place && is_meant_for_member(place, &binding.meaning, role);
            return is_open.then(usual);
        }
        if !self.is_replay {
            return (binding.place == place).then(usual);
        }
        let is_replaced = binding.place != Place::Replay && self.is_of_replay(binding.press);
        match replayed(&binding.meaning) {
            ReplayUse::Same => (binding.place == place && !is_replaced).then(usual),
            // Such a key controls the replay wherever it is bound.
            ReplayUse::Control(id) => {
                (place == Place::Replay && !is_replaced).then(|| Text::new(id, Vec::new()))
            }
            ReplayUse::None => None,
        }
    }

    /// Whether a replay handles a key before the rooms do.
    fn is_of_replay(&self, press: Press) -> bool {
        let mut bindings = self.keymap.bindings().iter();
        bindings.any(|it| it.place == Place::Replay && it.press == press)
    }
}

#[cfg(test)]
impl<'a> HelpScene<'a> {
    /// The help in a room, outside of a replay.
    pub(super) fn of_flight(keymap: &'a Keymap, here: Room) -> Self {
        Self {
            keymap,
            here,
            is_replay: false,
            is_desk: false,
            desk_view: None,
            member: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::state::help::help_lines;
    use crate::text::Language;

    /// On the home screen, `p` starts practice; in the other rooms it pauses.
    #[test]
    fn each_key_is_listed_once_with_the_meaning_that_it_has_in_the_room() {
        let locale = Locale::new(Language::English);
        let keymap = Keymap::default();
        for room in Room::ALL {
            let scene = HelpScene::of_flight(&keymap, room);
            let here = [Place::In(room), Place::Anywhere];
            let listed = keymap.bindings().iter().filter(|binding| {
                let mut places = here.iter();
                places.any(|&place| scene.description(binding, place).is_some())
            });
            let presses: Vec<Press> = listed.map(|binding| binding.press).collect();
            for (at, press) in presses.iter().enumerate() {
                assert!(!presses[..at].contains(press), "{room:?}: {press:?}");
            }
        }
        let home = help_lines(HelpScene::of_flight(&keymap, Room::Home), &locale);
        let pause = locale.say("action-pause-mission");
        let end = home
            .iter()
            .position(|line| *line == HelpLine::Title(locale.say("help-commands")));
        let is_pause =
            |line: &HelpLine| matches!(line, HelpLine::Entry(_, meaning) if *meaning == pause);
        assert!(!home[..end.expect("the commands")].iter().any(is_pause));
    }
}
