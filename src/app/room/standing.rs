//! The trainee's progress: skills and why they changed, scores by mission, credits and experience.

use crossterm::event::KeyCode;

use crate::app::State;
use crate::app::action::{Action, Step, ViewAction};
use crate::app::effect::{CareerEffect, Effect};
use crate::app::keymap::{ENTER, ESCAPE, KeyHint, KeyRow, Press, does, hint, key};
use crate::app::room::home;
use crate::app::room::{Answer, Room, RoomModel, RoomRequest, footer_keys};
use crate::app::state::Career;
use crate::campaign::{Offer, Skill};
use crate::text;
use crate::vehicle::Severity;

/// The minimum width and height to show everything at once.
const WIDE: (u16, u16) = (140, 40);

/// The state of the room.
#[derive(Debug, Clone, Default)]
pub struct Standing {
    /// The pane with the cursor.
    pub(in crate::app) pane: Pane,
    /// The line under the cursor in the list of skills.
    pub(in crate::app) skill: usize,
    /// The line under the cursor in the list of missions.
    pub(in crate::app) mission: usize,
}

impl Standing {
    /// The pane with the cursor.
    pub fn pane(&self) -> Pane {
        self.pane
    }

    /// The line under the cursor in the list of skills.
    pub fn skill(&self) -> usize {
        self.skill
    }

    /// The line under the cursor in the list of missions.
    pub fn mission(&self) -> usize {
        self.mission
    }
}

/// The panes; small screens show one at a time.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Pane {
    /// The skills, and the evidence for the one under the cursor.
    #[default]
    Skills,
    /// The missions flown, and the scores of the mission under the cursor.
    Scores,
    /// Credits and experience over time.
    Wealth,
}

impl Pane {
    fn next(self) -> Self {
        match self {
            Self::Skills => Self::Scores,
            Self::Scores => Self::Wealth,
            Self::Wealth => Self::Skills,
        }
    }
}

/// Whether a screen of this size shows all panes.
pub fn shows_all(width: u16, height: u16) -> bool {
    width >= WIDE.0 && height >= WIDE.1
}

/// The missions and drills that the trainee has flown, in the order of the course.
pub fn flown(career: &Career) -> Vec<&Offer> {
    let offers = career.course.offers().iter();
    offers
        .filter(|offer| !career.growth.tries(&offer.id).is_empty())
        .collect()
}

const HINTS: &[KeyHint] = &[
    footer_keys::MOVE,
    hint(&[Action::View(ViewAction::NextPage)], "hint-page"),
    hint(&[Action::Submit], "hint-mission"),
    hint(&[Action::Aids], "hint-aids"),
    hint(&[Action::Profiles], "hint-trainee"),
    footer_keys::BACK,
    footer_keys::COMMAND,
    footer_keys::HELP,
];

/// The key hints of the pane with the curves, which has no cursor.
const WEALTH_HINTS: &[KeyHint] = &[
    hint(&[Action::View(ViewAction::NextPage)], "hint-page"),
    hint(&[Action::Aids], "hint-aids"),
    hint(&[Action::Profiles], "hint-trainee"),
    footer_keys::BACK,
    footer_keys::COMMAND,
    footer_keys::HELP,
];

impl RoomModel for Standing {
    const KEYS: &'static [KeyRow] = &[
        does(ENTER, Action::Submit),
        does(ESCAPE, Action::Escape),
        does(
            Press::Plain(KeyCode::Tab),
            Action::View(ViewAction::NextPage),
        ),
        does(key('a'), Action::Aids),
        does(key('u'), Action::Profiles),
    ];

    fn hints(state: &State) -> &'static [KeyHint] {
        match state.rooms.standing.pane {
            Pane::Skills | Pane::Scores => HINTS,
            Pane::Wealth => WEALTH_HINTS,
        }
    }

    fn step(state: &mut State, step: Step) -> Answer {
        walk(state, step);
        Some(Vec::new())
    }

    fn submit(state: &mut State) -> Answer {
        Some(match state.rooms.standing.pane {
            Pane::Skills => to_training(state),
            Pane::Scores => to_mission(state),
            Pane::Wealth => Vec::new(),
        })
    }

    fn escape(_state: &mut State) -> Answer {
        Some(vec![RoomRequest::Show(Room::Home)])
    }

    fn view(state: &mut State, action: ViewAction) -> Answer {
        match action {
            ViewAction::NextPage => {
                let pane = &mut state.rooms.standing.pane;
                *pane = pane.next();
                Some(Vec::new())
            }
            ViewAction::Filter
            | ViewAction::Sort
            | ViewAction::SortReverse
            | ViewAction::NextVehicle
            | ViewAction::PreviousVehicle
            | ViewAction::Window => None,
        }
    }

    fn forget_session(&mut self) {}
}

fn walk(state: &mut State, step: Step) {
    let missions = state
        .training
        .career
        .as_ref()
        .map_or(0, |it| flown(it).len());
    let room = &mut state.rooms.standing;
    match room.pane {
        Pane::Skills => room.skill = step.apply(room.skill, Skill::ALL.len()),
        Pane::Scores => room.mission = step.apply(room.mission, missions),
        Pane::Wealth => {}
    }
}

/// Switches to the next level of advice; the change applies at once, even in flight.
pub fn change_aids(state: &mut State) -> Vec<RoomRequest> {
    let Some(career) = &state.training.career else {
        return ask_for_profile(state);
    };
    let aids = career.aids.next();
    state.say(Severity::Notice, aids.explained());
    vec![Effect::Career(CareerEffect::SetAids(aids)).into()]
}

fn ask_for_profile(state: &mut State) -> Vec<RoomRequest> {
    let key = state.key(Action::Profiles);
    state.say(Severity::Notice, text!("standing-choose-first", key = key));
    Vec::new()
}

/// Goes to the mission that trains the skill under the cursor, or says why there is none.
fn to_training(state: &mut State) -> Vec<RoomRequest> {
    let Some(career) = &state.training.career else {
        return ask_for_profile(state);
    };
    let Some(&skill) = Skill::ALL.get(state.rooms.standing.skill) else {
        return Vec::new();
    };
    if let Some(offer) = career.training(skill) {
        let mission = mission_of(offer);
        return show_mission(state, &mission);
    }
    let trains = |offer: &&Offer| offer.drill_of.is_none() && offer.skills.contains(&skill);
    let mut locked = career.course.offers().iter().filter(trains);
    let why = locked.find_map(|offer| career.lock(&offer.id));
    let text = match why {
        Some(why) => text!("standing-skill-locked", skill = skill.title(), why = why),
        None => text!("standing-skill-untrained", skill = skill.title()),
    };
    state.say(Severity::Notice, text);
    Vec::new()
}

/// Goes to the mission under the cursor on the home screen, where it can be flown.
fn to_mission(state: &mut State) -> Vec<RoomRequest> {
    let Some(career) = &state.training.career else {
        return ask_for_profile(state);
    };
    let Some(offer) = flown(career).get(state.rooms.standing.mission).copied() else {
        return Vec::new();
    };
    let mission = mission_of(offer);
    show_mission(state, &mission)
}

/// The id of the mission; for a drill, of the one that it prepares for.
fn mission_of(offer: &Offer) -> String {
    offer.drill_of.clone().unwrap_or_else(|| offer.id.clone())
}

fn show_mission(state: &mut State, mission: &str) -> Vec<RoomRequest> {
    home::point_at(state, Some(mission));
    vec![RoomRequest::Show(Room::Home)]
}
