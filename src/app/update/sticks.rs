//! Flying a vehicle by keys, for tests: the mode, its keys, and its end.

use std::time::Duration;

use crossterm::event::{KeyCode, KeyEvent};

use super::ending::quit;
use crate::app::State;
use crate::app::action::Action;
use crate::app::effect::{Effect, Effects, SessionEffect};
use crate::app::keymap::Place;
use crate::app::state::{Activity, Overlay, StickAxis, StickMode};
use crate::campaign::Stake;
use crate::commands::stick_obstacle;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};
use crate::verb::CrewDuty;

/// The interval at which unchanged positions are sent: a vehicle's session drops them after a second without any.
const SENT_EVERY: Duration = Duration::from_millis(200);

/// Takes the sticks of the vehicle under the cursor.
pub fn open(state: &mut State) {
    if let Some(reason) = obstacle(state) {
        return state.say(Severity::Notice, reason);
    }
    if let Some(vehicle) = state.session.choice.cursor {
        state.overlay = Some(Overlay::Sticks(StickMode::new(vehicle)));
    }
}

/// Why the sticks of the vehicle under the cursor cannot be taken.
fn obstacle(state: &State) -> Option<Text> {
    if state.replay.is_some() {
        return Some(text!("sticks-replay"));
    }
    if let Some(Activity::Mission { stake, .. }) = &state.session.activity
        && *stake != Stake::Practice
    {
        return Some(text!("refused-protected-sticks"));
    }
    let by_pilot = |id| state.session.pilots.refusal(id, None, CrewDuty::Flying);
    let vehicle = state.session.choice.cursor;
    let vehicle = vehicle.and_then(|id| state.session.vehicles.get(&id));
    match vehicle {
        None => Some(text!("sticks-none")),
        Some(vehicle) => by_pilot(vehicle.id)
            .or_else(|| vehicle.not_in_control())
            .or_else(|| {
                let known = state.rooms.parameters.lists.get(&vehicle.id)?;
                stick_obstacle(vehicle, &known.list)
            }),
    }
}

/// Handles a key while the sticks are held. Only Esc and quitting end the mode.
pub fn key(state: &mut State, mut mode: StickMode, key: KeyEvent) -> Effects {
    if state.keymap.action(key, Place::Anywhere) == Some(Action::Quit) {
        return quit(state);
    }
    if state.keymap.action(key, Place::Prompt) == Some(Action::Escape) {
        return Effects::none();
    }
    match key.code {
        KeyCode::Esc => return Effects::none(),
        KeyCode::Char(' ') => mode.centre(state.wall),
        code => {
            if let Some((axis, up)) = deflection(code) {
                mode.press(axis, up, state.wall);
            }
        }
    }
    state.overlay = Some(Overlay::Sticks(mode));
    Effects::none()
}

/// The stick that a key deflects, and whether its pulses become longer. The letters are those of the same keys in the
/// Ukrainian layout, too. A stick pushed forward gives shorter pulses.
fn deflection(code: KeyCode) -> Option<(StickAxis, bool)> {
    Some(match code {
        KeyCode::Left => (StickAxis::Roll, false),
        KeyCode::Right => (StickAxis::Roll, true),
        KeyCode::Up => (StickAxis::Pitch, false),
        KeyCode::Down => (StickAxis::Pitch, true),
        KeyCode::Char('s' | 'S' | 'і' | 'І') => (StickAxis::Throttle, false),
        KeyCode::Char('w' | 'W' | 'ц' | 'Ц') => (StickAxis::Throttle, true),
        KeyCode::Char('a' | 'A' | 'ф' | 'Ф') => (StickAxis::Yaw, false),
        KeyCode::Char('d' | 'D' | 'в' | 'В') => (StickAxis::Yaw, true),
        _ => return None,
    })
}

/// The vehicle whose sticks are held.
pub fn held(state: &State) -> Option<VehicleId> {
    match &state.overlay {
        Some(Overlay::Sticks(mode)) => Some(mode.vehicle()),
        _ => None,
    }
}

/// Sends the positions of the sticks, and ends the mode if its vehicle can no longer be flown.
pub fn tick(state: &mut State) -> Effects {
    let Some(vehicle) = held(state) else {
        return Effects::none();
    };
    let is_there = state.session.vehicles.contains_key(&vehicle);
    if !is_there || obstacle(state).is_some() {
        state.overlay = None;
        state.touch();
        return Effects::none();
    }
    let wall = state.wall;
    let Some(Overlay::Sticks(mode)) = &mut state.overlay else {
        return Effects::none();
    };
    if !mode.tick(wall, SENT_EVERY) {
        return Effects::none();
    }
    let held = Some(mode.held());
    state.touch();
    Effects::from(Effect::Session(SessionEffect::Sticks { vehicle, held }))
}

/// Releases the sticks that were held before an event, if they are held no longer.
pub fn released(state: &mut State, before: Option<VehicleId>) -> Option<Effect> {
    let vehicle = before.filter(|before| held(state) != Some(*before))?;
    state.say(
        Severity::Notice,
        text!("sticks-released", vehicle = vehicle),
    );
    let held = None;
    Some(Effect::Session(SessionEffect::Sticks { vehicle, held }))
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use crossterm::event::KeyModifiers;

    use super::*;
    use crate::app::event::{Event, TerminalEvent};
    use crate::app::{App, Setup};
    use crate::vehicle::{HeldChannels, Vehicle};

    fn flying(activity: Activity) -> App {
        let mut app = App::new(Setup::default());
        app.state.session.activity = Some(activity);
        app.state
            .session
            .vehicles
            .insert(3, Arc::new(Vehicle::new(3, 1)));
        app.state.session.choice.place_cursor(3);
        app
    }

    fn press(app: &mut App, code: KeyCode) -> Vec<Effect> {
        let key = TerminalEvent::Key(KeyEvent::new(code, KeyModifiers::NONE));
        app.update(key)
    }

    /// The positions that are sent at a time, `None` inside for a release.
    #[expect(clippy::option_option, reason = "nothing sent is not a release")]
    fn sent(app: &mut App, ms: u64) -> Option<Option<HeldChannels>> {
        let now = Duration::from_millis(ms);
        let effects = app.update(Event::Tick { now, wall: now });
        effects.into_iter().find_map(|effect| match effect {
            Effect::Session(SessionEffect::Sticks { held, .. }) => Some(held),
            _ => None,
        })
    }

    fn pulse(app: &mut App, ms: u64, channel: usize) -> Option<u16> {
        sent(app, ms)??.pulse_us(channel)
    }

    #[test]
    fn a_key_deflects_a_stick_until_it_is_no_longer_repeated() {
        let mut app = flying(Activity::Free);
        open(&mut app.state);
        assert_eq!(pulse(&mut app, 1000, 0), Some(1500));
        press(&mut app, KeyCode::Right);
        press(&mut app, KeyCode::Char('ц'));
        assert_eq!(pulse(&mut app, 1010, 0), Some(1700));
        assert_eq!(pulse(&mut app, 1220, 2), Some(1700));
        assert_eq!(sent(&mut app, 1230), None, "unchanged positions can wait");
        for ms in [1500, 1530, 1560] {
            sent(&mut app, ms);
            press(&mut app, KeyCode::Right);
        }
        assert_eq!(pulse(&mut app, 1650, 0), Some(1700), "the key is repeated");
        assert_eq!(pulse(&mut app, 1820, 0), Some(1500), "and released");
    }

    #[test]
    fn the_sticks_are_released_with_the_mode() {
        {
            let mut app = flying(Activity::Free);
            open(&mut app.state);
            assert!(pulse(&mut app, 1000, 0).is_some());
            let effects = press(&mut app, KeyCode::Esc);
            let released = Effect::Session(SessionEffect::Sticks {
                vehicle: 3,
                held: None,
            });
            assert_eq!(effects, [released]);
            assert_eq!(sent(&mut app, 2000), None);
        }
        let mut app = flying(Activity::Free);
        open(&mut app.state);
        app.state.session.vehicles.clear();
        assert_eq!(sent(&mut app, 1000), Some(None), "the vehicle is gone");
    }

    #[test]
    fn the_sticks_cannot_be_taken_in_a_flight_that_counts() {
        let mission = |stake| Activity::Mission {
            id: "01".to_owned(),
            title: Text::from("a mission"),
            stake,
        };
        for (stake, is_open) in [
            (Stake::Graded, false),
            (Stake::Exam, false),
            (Stake::Practice, true),
        ] {
            let mut app = flying(mission(stake));
            open(&mut app.state);
            assert_eq!(held(&app.state).is_some(), is_open, "{stake:?}");
        }
    }
}
