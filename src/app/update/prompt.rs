//! Prompts for a line.

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::{batch, mission, order, profiles, typing};
use crate::app::State;
use crate::app::action::Action;
use crate::app::effect::Effects;
use crate::app::keymap::Place;
use crate::app::room::{self, files, home, parameters, workshop};
use crate::app::state::{Overlay, Prompt, Purpose};
use crate::text::Text;

/// Handles a key in a prompt.
pub fn key(state: &mut State, mut prompt: Prompt, key: KeyEvent) -> Effects {
    let submitted = match state.keymap.action(key, Place::Prompt) {
        Some(Action::Escape) => return Effects::none(),
        Some(Action::Submit) => true,
        _ if edit(&mut prompt, key) => false,
        _ => {
            state.overlay = Some(Overlay::Prompt(prompt));
            return Effects::none();
        }
    };
    prompt.fault = None;
    let outcome = if submitted || prompt.purpose.is_live() {
        let entered = prompt.input.value().to_owned();
        take(state, &prompt.purpose, &entered)
    } else {
        Ok(Effects::none())
    };
    let is_wrong = outcome.is_err();
    let effects = outcome.unwrap_or_else(|fault| {
        prompt.fault = Some(fault);
        Effects::none()
    });
    if !submitted || is_wrong {
        state.overlay = Some(Overlay::Prompt(prompt));
    }
    effects
}

/// Applies a key to the line; returns false if it is not an editing key. A letter replaces a
/// proposed text.
fn edit(prompt: &mut Prompt, key: KeyEvent) -> bool {
    let commands = KeyModifiers::CONTROL | KeyModifiers::ALT;
    let is_letter = matches!(key.code, KeyCode::Char(_)) && !key.modifiers.intersects(commands);
    if std::mem::take(&mut prompt.is_proposal) && is_letter {
        prompt.input.reset();
    }
    typing::edit(&mut prompt.input, key)
}

/// Carries out the purpose of a prompt with the line entered.
///
/// # Errors
/// The fault of the line; the prompt stays open and shows it.
fn take(state: &mut State, purpose: &Purpose, entered: &str) -> Result<Effects, Text> {
    match purpose {
        Purpose::Connect => home::connect(state, entered),
        Purpose::NewProfile => profiles::created(state, entered),
        Purpose::Seed(mission) => {
            let launch = home::practice(state, mission, entered)?;
            Ok(mission::start(state, launch))
        }
        Purpose::Filter(room) => {
            room::filter(state, *room, entered);
            Ok(Effects::none())
        }
        Purpose::Parameter { name, vehicles } => {
            let line = parameters::entered(state, name, vehicles, entered)?;
            batch::give(state, &line)
        }
        Purpose::PutFile { vehicle, folder } => {
            let line = files::put_line(*vehicle, folder, entered)?;
            let order = order::prepare(state, &line).map_err(|fault| fault.message)?;
            Ok(order::give(state, order))
        }
        Purpose::SaveParameters => parameters::save(state, entered),
        Purpose::LoadParameters | Purpose::CompareParameters => parameters::load(state, entered),
        Purpose::SaveDesign => workshop::saved_as(state, entered),
        Purpose::CopyDesign(of) => workshop::copied(state, of, entered),
        Purpose::RenameDesign(old) => workshop::renamed(state, old, entered),
        Purpose::ExportDesign => workshop::exported(state, entered),
        Purpose::ImportDesign => workshop::imported(entered),
    }
}
