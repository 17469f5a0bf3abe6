//! Keys in the workshop.

mod bench;
mod designs;
mod fleet;
mod properties;

use super::*;
use crate::app::Setup;
use crate::app::effect::{CareerEffect, Effect, FileEffect, FileKind, SessionEffect};
use crate::app::event::{CareerEvent, Event, FileEvent, TerminalEvent};
use crate::app::room::Room;
use crate::app::state::{Career, Overlay, Purpose};
use crate::app::update::update;
use crate::campaign::{MissionCourse, Offer};
use crate::mission::Mission;
use crate::workshop::PartSlot;
use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

const STARTER: &str = include_str!("../../../../designs/starter.toml");
const MISSION: &str = include_str!("../../../../missions/01-air-sample.toml");

fn starter() -> Design {
    Design::from_toml(STARTER).expect("it is good")
}

/// The workshop with one design and one mission.
fn workshop(career: Option<Career>) -> State {
    let mission = Mission::parse(MISSION).expect("it is good");
    let mut state = State::new(Setup {
        missions: vec![mission.listing()],
        stock: vec![starter()],
        ..Setup::default()
    });
    state.display.size = (200, 50);
    state.training.career = career;
    press(&mut state, "W");
    state
}

fn career() -> Career {
    let mission = Mission::parse(MISSION).expect("it is good");
    Career::new(
        "Olena",
        Vec::new(),
        MissionCourse::new([Offer::of(&mission)]),
    )
}

fn hear(state: &mut State, event: impl Into<Event>) -> Vec<Effect> {
    update(state, event.into()).into_vec()
}

fn press(state: &mut State, keys: &str) -> Vec<Effect> {
    let mut effects = Vec::new();
    for word in keys.split(' ') {
        let code = match word {
            "enter" => KeyCode::Enter,
            "esc" => KeyCode::Esc,
            "tab" => KeyCode::Tab,
            "home" => KeyCode::Home,
            "left" => KeyCode::Left,
            "right" => KeyCode::Right,
            "ctrl-r" => {
                let key = KeyEvent::new(KeyCode::Char('r'), KeyModifiers::CONTROL);
                effects.extend(hear(state, TerminalEvent::Key(key)));
                continue;
            }
            "clear" => {
                let key = KeyEvent::new(KeyCode::Char('u'), KeyModifiers::CONTROL);
                effects.extend(hear(state, TerminalEvent::Key(key)));
                continue;
            }
            word => {
                for c in word.chars() {
                    let key = KeyEvent::new(KeyCode::Char(c), KeyModifiers::NONE);
                    effects.extend(hear(state, TerminalEvent::Key(key)));
                }
                continue;
            }
        };
        let key = KeyEvent::new(code, KeyModifiers::NONE);
        effects.extend(hear(state, TerminalEvent::Key(key)));
    }
    effects
}

/// Selects a slot and installs a part with the keys a user would press.
fn put(state: &mut State, slot: PartSlot, part: &str) {
    state.rooms.workshop.pane = Pane::Slots;
    press(state, "home");
    while state.rooms.workshop.bench.slot() != slot {
        press(state, "j");
    }
    press(state, "tab home");
    while state.rooms.workshop.bench.candidate().map(|it| it.part.id) != Some(part) {
        let before = state.rooms.workshop.bench.at();
        press(state, "j");
        assert_ne!(
            state.rooms.workshop.bench.at(),
            before,
            "there is no {part}"
        );
    }
    press(state, "enter");
    state.rooms.workshop.pane = Pane::Slots;
}

fn design(state: &State) -> &Design {
    state.rooms.workshop.bench.design()
}
