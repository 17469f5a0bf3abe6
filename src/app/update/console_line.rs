//! The console's own lines, carried out.

use std::sync::Arc;

use super::{act, macros, mission, swarm};
use crate::app::State;
use crate::app::console::{BareLine, ConsoleLine, ParamsDeed};
use crate::app::effect::{CareerEffect, Effect, Effects, SessionEffect, TerminalEffect};
use crate::app::room::{Room, hangar, parameters};
use crate::app::setting::Setting;
use crate::app::state::{Log, Overlay};
use crate::config::Symbols;
use crate::diagnostic::Diagnostic;
use crate::language::{parse_ranges, ranges, words};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

/// Does what a line says.
///
/// # Errors
/// A word of it names what there is not.
pub fn carry_out(state: &mut State, line: &str, own: ConsoleLine) -> Result<Effects, Diagnostic> {
    let last_word = words(line).pop().map_or(0..0, |word| word.span);
    let at_last_word = |text: Text| Diagnostic::new(last_word.clone(), text);
    match own {
        ConsoleLine::Select(targets) => {
            let ids = targeted(state, &targets).map_err(at_last_word)?;
            act::select(state, &ids);
        }
        ConsoleLine::Group { name, targets } => {
            let ids = targeted(state, &targets).map_err(at_last_word)?;
            group(state, name, ids).map_err(at_last_word)?;
        }
        ConsoleLine::Hangar(None) => act::show(state, Room::Hangar),
        ConsoleLine::Hangar(Some((deed, vehicle))) => {
            return Ok(hangar::order(state, deed, vehicle));
        }
        ConsoleLine::Show(room) => act::show(state, room),
        ConsoleLine::Fly(mission) => {
            return Ok(match mission {
                Some(id) => mission::start(state, state.launch(&id)),
                None => act::guarded(
                    state,
                    text!("ask-start"),
                    Effect::Session(SessionEffect::StartFree),
                ),
            });
        }
        ConsoleLine::Params(deed) => {
            return params(state, deed).map_err(at_last_word);
        }
        ConsoleLine::Swarm(own) => swarm::carry_out(state, own).map_err(at_last_word)?,
        ConsoleLine::Connect(addresses) => {
            let effect = Effect::Session(SessionEffect::Connect(addresses));
            return Ok(act::guarded(state, text!("ask-start"), effect));
        }
        ConsoleLine::Inject(_) if state.session.paused => {
            return Err(at_last_word(text!("pause-refuses")));
        }
        ConsoleLine::Inject(name) => {
            return Ok(Effects::from(Effect::Session(SessionEffect::Inject(name))));
        }
        ConsoleLine::Macro(name) => {
            macros::check(state, &name, last_word)?;
            let lines = state.config.macros.get(&name).cloned().unwrap_or_default();
            for line in lines.into_iter().rev() {
                state.pending.push_front(line);
            }
        }
        ConsoleLine::Set(setting) => return Ok(set(state, &setting)),
        ConsoleLine::Bare(line) => return Ok(bare(state, line)),
    }
    Ok(Effects::none())
}

/// The vehicles that a word names; nothing means those that a command would go to.
pub fn targeted(state: &State, word: &str) -> Result<Vec<VehicleId>, Text> {
    match word {
        "" => Ok(state.addressed()),
        "none" => Ok(Vec::new()),
        "filter" => Ok(state.rooms.fly.rows().to_vec()),
        "invert" => {
            let shown = state.rooms.fly.rows().iter().copied();
            let others = shown.filter(|id| !state.session.selection.contains(id));
            Ok(others.collect())
        }
        "all" => Ok(state.session.vehicles.keys().copied().collect()),
        _ => match word.strip_prefix('@') {
            Some(name) => {
                let members = state.session.groups.get(name).cloned();
                members.ok_or_else(|| text!("group-unknown", name = name))
            }
            None => parse_ranges(word),
        },
    }
}

/// Takes a setting over.
fn set(state: &mut State, setting: &Setting) -> Effects {
    setting.apply(&mut state.config);
    match setting {
        Setting::Theme(name) => {
            state.theme.clone_from(name);
            Effects::from(Effect::Terminal(TerminalEffect::SetTheme(name.clone())))
        }
        Setting::Fps(fps) => Effects::from(Effect::Terminal(TerminalEffect::SetFps(*fps))),
        Setting::Lang(language) => {
            if !state.speak(*language) {
                state.say(Severity::Warning, text!("setting-lang-ascii"));
                return Effects::none();
            }
            let is_kept = state.career.is_some();
            let keep = is_kept.then_some(Effect::Career(CareerEffect::SetLanguage(*language)));
            keep.into_iter().collect()
        }
        Setting::Symbols(Symbols::Ascii) => {
            state.locale = Arc::default();
            Effects::none()
        }
        Setting::Symbols(_) | Setting::Bell(_) | Setting::Notify(_) => Effects::none(),
    }
}

fn params(state: &mut State, deed: ParamsDeed) -> Result<Effects, Text> {
    match deed {
        ParamsDeed::Save(path) => return parameters::save(state, &path),
        ParamsDeed::Compare(other) => return parameters::load(state, &other),
        ParamsDeed::Fetch => parameters::fetch(state),
        ParamsDeed::Show => {}
    }
    act::show(state, Room::Parameters);
    Ok(Effects::none())
}

fn bare(state: &mut State, line: BareLine) -> Effects {
    match line {
        BareLine::Help => state.overlay = Some(Overlay::Help { scroll: 0 }),
        BareLine::Links => act::show(state, Room::Links),
        BareLine::Ledger => act::show(state, Room::Ledger),
        BareLine::Notices => act::look_back(state, Log::Notices),
        BareLine::Brief => act::brief(state),
        BareLine::Pause => return mission::pause(state),
        BareLine::Continue => return mission::go_on(state),
        BareLine::Abandon => return mission::abandon(state),
        BareLine::Restart => return mission::restart(state, false),
        BareLine::Leave => return act::leave(state),
        BareLine::Quit => return act::quit(state),
    }
    Effects::none()
}

fn group(state: &mut State, name: String, ids: Vec<VehicleId>) -> Result<(), Text> {
    let word = |c: char| c.is_alphanumeric() || c == '_' || c == '-';
    if name.is_empty() || !name.chars().all(word) {
        return Err(text!("group-name", name = name));
    }
    if ids.is_empty() {
        return Err(text!("group-empty"));
    }
    let members = ranges(ids.iter().copied());
    state.say(
        Severity::Notice,
        text!("group-is", name = &name, members = members),
    );
    state.session.groups.insert(name, ids);
    Ok(())
}
