//! The home screen: missions, free flight, connections.

use crate::app::State;
use crate::app::action::{Action, ReplayAction, StartAction, Step};
use crate::app::effect::{Effect, Effects, Launch, SessionEffect};
use crate::app::keymap::{ENTER, KeyHint, KeyRow, does, hint, key};
use crate::app::room::{Answer, Room, RoomModel, RoomRequest, footer_keys};
use crate::app::state::{Career, Purpose};
use crate::campaign::Stake;
use crate::mission::Listing;
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

mod facts;

pub use facts::{Fact, facts, unlocked};

/// The state of the home screen.
#[derive(Debug, Clone, Default)]
pub struct Home {
    /// The index of the entry under the cursor: the missions first, then the other [`HomeItem`]s.
    pub(in crate::app) cursor: usize,
}

impl Home {
    /// The index of the entry under the cursor: the missions first, then the other [`HomeItem`]s.
    pub fn cursor(&self) -> usize {
        self.cursor
    }
}

/// An entry of the home screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HomeItem {
    /// The mission with this index in [`Training::missions`](crate::app::state::Training::missions).
    Mission(usize),
    /// Free flight, without a mission.
    Free,
    /// Free flight with ArduPilot's SITL.
    ArduPilot,
    /// Connect to real vehicles or to a running simulator.
    Connect,
    Quit,
}

/// The items of the home screen, from the top.
pub fn items(state: &State) -> Vec<HomeItem> {
    let mut missions: Vec<usize> = (0..state.training.missions.len())
        .filter(|&at| of_drill(state, &state.training.missions[at]).is_none())
        .collect();
    missions.sort_by_key(|&at| state.training.missions[at].tier);
    let missions = missions.into_iter().map(HomeItem::Mission);
    let ardupilot = state.has_ardupilot.then_some(HomeItem::ArduPilot);
    let others = [HomeItem::Connect, HomeItem::Quit];
    missions
        .chain([HomeItem::Free])
        .chain(ardupilot)
        .chain(others)
        .collect()
}

/// The mission that a drill belongs to, if it is available: such a drill is not listed on its own.
fn of_drill<'a>(state: &'a State, drill: &Listing) -> Option<&'a Listing> {
    let of = drill.drill_of.as_ref()?;
    state
        .training
        .missions
        .iter()
        .find(|mission| mission.id == *of)
}

/// The drill that is flown for a mission, by the mission's id: the recommended one if it belongs to the mission,
/// otherwise the first one that is not passed yet, otherwise the first one; `None` if the mission has no drill.
pub fn drill<'a>(state: &'a State, mission: &str) -> Option<&'a Listing> {
    let all = state.training.missions.iter();
    let drills: Vec<&Listing> = all
        .filter(|listing| listing.drill_of.as_deref() == Some(mission))
        .collect();
    let career = state.training.career.as_ref();
    let advised = career
        .and_then(Career::next)
        .map(|(_, offer)| offer.id.as_str());
    let is_passed = |drill: &Listing| career.is_some_and(|it| it.standing.has_passed(&drill.id));
    let next = drills.iter().find(|it| Some(it.id.as_str()) == advised);
    let open = drills.iter().find(|it| !is_passed(it));
    next.or(open).or(drills.first()).copied()
}

/// Flies the drill for a mission.
pub fn fly_drill(state: &mut State, mission: &str) -> Vec<RoomRequest> {
    let Some(id) = drill(state, mission).map(|drill| drill.id.clone()) else {
        state.say(Severity::Notice, text!("home-no-drill"));
        return Vec::new();
    };
    vec![RoomRequest::Fly(state.training().launch(&id))]
}

const HINTS: &[KeyHint] = &[
    footer_keys::MOVE,
    hint(&[Action::Submit], "hint-take"),
    footer_keys::COMMAND,
    footer_keys::HELP,
    hint(&[Action::Replay(ReplayAction::ReplayNewest)], "hint-replay"),
    hint(&[Action::Profiles], "hint-trainee"),
    hint(&[Action::Show(Room::Standing)], "room-standing"),
    hint(&[Action::Show(Room::Workshop)], "room-workshop"),
    hint(&[Action::Quit], "hint-quit"),
];

impl RoomModel for Home {
    const KEYS: &'static [KeyRow] = &[
        does(ENTER, Action::Submit),
        does(key('t'), Action::Start(StartAction::Drill)),
        does(key('d'), Action::Start(StartAction::Daily)),
        does(key('e'), Action::Start(StartAction::Exam)),
        does(key('p'), Action::Start(StartAction::Practise)),
        does(key('v'), Action::Replay(ReplayAction::ReplayNewest)),
        does(key('u'), Action::Profiles),
        does(key('q'), Action::Quit),
    ];

    fn hints(_state: &State) -> &'static [KeyHint] {
        HINTS
    }

    fn step(state: &mut State, step: Step) -> Answer {
        let cursor = state.rooms.home.cursor;
        state.rooms.home.cursor = step.apply(cursor, items(state).len());
        // The mission room now shows another mission.
        state.rooms.mission.scroll = 0;
        Some(Vec::new())
    }

    fn submit(state: &mut State) -> Answer {
        let item = items(state).get(state.rooms.home.cursor).copied();
        Some(item.map_or_else(Vec::new, |item| enter(state, item)))
    }

    fn start(state: &mut State, action: StartAction) -> Answer {
        let id = under_cursor(state).map(|mission| mission.id.clone());
        Some(id.map_or_else(Vec::new, |id| fly_otherwise(state, action, id)))
    }

    fn forget_session(&mut self) {}
}

/// The mission under the cursor; `None` on any other entry.
pub fn under_cursor(state: &State) -> Option<&Listing> {
    match items(state).get(state.rooms.home.cursor) {
        Some(HomeItem::Mission(at)) => state.training.missions.get(*at),
        Some(HomeItem::Free | HomeItem::ArduPilot | HomeItem::Connect | HomeItem::Quit) | None => {
            None
        }
    }
}

/// Puts the cursor on a mission, or on the first line if it is not listed.
pub fn point_at(state: &mut State, mission: Option<&str>) {
    let is_it = |item: &HomeItem| match item {
        HomeItem::Mission(at) => Some(state.training.missions[*at].id.as_str()) == mission,
        HomeItem::Free | HomeItem::ArduPilot | HomeItem::Connect | HomeItem::Quit => false,
    };
    state.rooms.home.cursor = items(state).iter().position(is_it).unwrap_or(0);
    state.rooms.mission.scroll = 0;
}

/// Flies the mission's drill, its exam, its seed of the day, or a practice flight.
fn fly_otherwise(state: &mut State, how: StartAction, mission: String) -> Vec<RoomRequest> {
    match how {
        StartAction::Drill => fly_drill(state, &mission),
        StartAction::Daily => vec![RoomRequest::Fly(Launch {
            stake: Stake::Daily,
            ..state.training().launch(&mission)
        })],
        StartAction::Exam => vec![RoomRequest::Exam(mission)],
        StartAction::Practise => {
            if let Some(reason) = state.training().lock(&mission) {
                state.say(Severity::Warning, reason);
            } else {
                state.prompt(Purpose::Seed(mission), "");
            }
            Vec::new()
        }
    }
}

/// A practice flight with the seed that was entered; without one, the shell chooses it.
///
/// # Errors
/// The text is not a seed.
pub fn practice(state: &State, mission: &str, entered: &str) -> Result<Launch, Text> {
    let seed = match entered.trim() {
        "" => None,
        written => Some(written.parse().map_err(|_| text!("home-seed-none"))?),
    };
    Ok(Launch {
        stake: Stake::Practice,
        seed,
        ..state.training().launch(mission)
    })
}

/// Connects to the addresses entered. The prompt stays open until the session has started, or shows
/// the error.
///
/// # Errors
/// No address was entered.
pub fn connect(state: &mut State, entered: &str) -> Result<Effects, Text> {
    let addresses: Vec<String> = entered.split_whitespace().map(str::to_owned).collect();
    if addresses.is_empty() {
        return Err(text!("home-connect-empty"));
    }
    state.prompt(Purpose::Connect, entered);
    Ok(Effects::from(Effect::Session(SessionEffect::Connect(
        addresses,
    ))))
}

fn enter(state: &mut State, item: HomeItem) -> Vec<RoomRequest> {
    let start = |effect| RoomRequest::EndSession {
        question: text!("ask-start"),
        effect: Effect::Session(effect),
    };
    vec![match item {
        HomeItem::Mission(at) => {
            RoomRequest::Fly(state.training().launch(&state.training.missions[at].id))
        }
        HomeItem::Free => start(SessionEffect::StartFree),
        HomeItem::ArduPilot => start(SessionEffect::StartArduPilot),
        HomeItem::Connect => {
            state.prompt(Purpose::Connect, "");
            return Vec::new();
        }
        HomeItem::Quit => RoomRequest::Quit,
    }]
}
