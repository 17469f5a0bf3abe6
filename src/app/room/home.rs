//! Where to begin: missions, free flight, vehicles elsewhere.

use crate::app::action::Action;
use crate::app::effect::Effect;
use crate::app::keymap::{ENTER, Row, does, key};
use crate::app::state::{Overlay, Prompt, Purpose, State};
use crate::app::update::act::{guarded, quit};
use crate::app::update::mission;
use crate::mission::Listing;
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// What the home screen remembers.
#[derive(Debug, Clone, Default)]
pub struct Home {
    /// The line under the cursor: the missions first, then the other [`HomeItem`]s.
    pub cursor: usize,
}

/// What the home screen offers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HomeItem {
    /// The mission at this place of [`State::missions`].
    Mission(usize),
    /// Fly without a task.
    Free,
    /// Fly without a task, with ArduPilot's SITL.
    ArduPilot,
    /// Connect to vehicles elsewhere.
    Connect,
    /// Leave the program.
    Quit,
}

/// Its keys.
pub const KEYS: &[Row] = &[
    does(ENTER, Action::Submit),
    does(key('t'), Action::Drill),
    does(key('q'), Action::Quit),
];

/// What the home screen offers, from the top.
pub fn items(state: &State) -> Vec<HomeItem> {
    let mut missions: Vec<usize> = (0..state.missions.len())
        .filter(|&at| of_drill(state, &state.missions[at]).is_none())
        .collect();
    missions.sort_by_key(|&at| state.missions[at].tier);
    let missions = missions.into_iter().map(HomeItem::Mission);
    let ardupilot = state.has_ardupilot.then_some(HomeItem::ArduPilot);
    let others = [HomeItem::Connect, HomeItem::Quit];
    missions
        .chain([HomeItem::Free])
        .chain(ardupilot)
        .chain(others)
        .collect()
}

/// The mission that a drill trains for, if it is on offer: such a drill is not listed by itself.
fn of_drill<'a>(state: &'a State, drill: &Listing) -> Option<&'a Listing> {
    let of = drill.drill_of.as_ref()?;
    state.missions.iter().find(|mission| mission.id == *of)
}

/// The drill for a mission, by the mission's id.
pub fn drill<'a>(state: &'a State, mission: &str) -> Option<&'a Listing> {
    let mut all = state.missions.iter();
    all.find(|listing| listing.drill_of.as_deref() == Some(mission))
}

/// Flies the drill for a mission.
pub fn fly_drill(state: &mut State, mission: &str) -> Vec<Effect> {
    let Some(id) = drill(state, mission).map(|drill| drill.id.clone()) else {
        state.say(Severity::Notice, text!("home-no-drill"));
        return Vec::new();
    };
    mission::start(state, state.launch(&id))
}

/// What its actions do.
pub fn act(state: &mut State, action: Action) -> Option<Vec<Effect>> {
    match action {
        Action::Move(step) => {
            let cursor = state.rooms.home.cursor;
            state.rooms.home.cursor = step.apply(cursor, items(state).len());
            // The room of the mission shows another one now.
            state.rooms.mission.scroll = 0;
            Some(Vec::new())
        }
        Action::Drill => {
            let item = items(state).get(state.rooms.home.cursor).copied();
            let Some(HomeItem::Mission(at)) = item else {
                return Some(Vec::new());
            };
            let id = state.missions[at].id.clone();
            Some(fly_drill(state, &id))
        }
        Action::Submit => {
            let item = items(state).get(state.rooms.home.cursor).copied();
            Some(item.map_or_else(Vec::new, |item| enter(state, item)))
        }
        _ => None,
    }
}

/// Takes the addresses that were entered. The prompt stays until the session has started, or says there why
/// it could not.
///
/// # Errors
/// There is no address.
pub fn connect(state: &mut State, entered: &str) -> Result<Vec<Effect>, Text> {
    let addresses: Vec<String> = entered.split_whitespace().map(str::to_owned).collect();
    if addresses.is_empty() {
        return Err(text!("home-connect-empty"));
    }
    state.overlay = Some(Overlay::Prompt(Prompt {
        input: entered.into(),
        ..Prompt::new(Purpose::Connect)
    }));
    Ok(vec![Effect::Connect(addresses)])
}

fn enter(state: &mut State, item: HomeItem) -> Vec<Effect> {
    match item {
        HomeItem::Mission(at) => {
            let id = state.missions[at].id.clone();
            state.say(Severity::Info, text!("home-starting-mission"));
            mission::start(state, state.launch(&id))
        }
        HomeItem::Free => {
            state.say(Severity::Info, text!("home-starting-simulator"));
            guarded(state, text!("ask-start"), Effect::StartFree)
        }
        HomeItem::ArduPilot => guarded(state, text!("ask-start"), Effect::StartArduPilot),
        HomeItem::Connect => {
            state.overlay = Some(Overlay::Prompt(Prompt::new(Purpose::Connect)));
            Vec::new()
        }
        HomeItem::Quit => quit(state),
    }
}
