//! Carries out lines about drafts, except uploads.

use super::{change, divide, files, ground, trial};
use crate::app::State;
use crate::app::effect::{Effect, Effects};
use crate::draft::{EditPart, Refusal, Trial};
use crate::language::{DraftLine, VehicleChoice};
use crate::plan::ListKind;
use crate::text;
use crate::vehicle::{Severity, VehicleId};

/// Carries out a line about drafts, except uploads.
///
/// # Errors
/// The reason why the line cannot be carried out.
pub fn carry_out(state: &mut State, line: DraftLine) -> Result<Effects, Refusal> {
    state.hush();
    match line {
        DraftLine::Show | DraftLine::Upload(_) | DraftLine::UploadEach => {}
        DraftLine::Open(path) => return Ok(files::open(path)),
        DraftLine::Save(path) => return Ok(files::save(state, path)?),
        DraftLine::New(name) => change::begin(state, &plain_name(name)),
        DraftLine::Take(vehicles) => {
            let ids = meant(state, vehicles)?;
            files::take(state, &ids)?;
        }
        DraftLine::Divide { work, vehicles } => {
            let ids = meant(state, vehicles)?;
            divide::divide(state, work, &ids)?;
            let trial = match trial::prepared(state, None) {
                Ok(trial) => trial,
                Err(reason) => {
                    state.say(Severity::Warning, reason);
                    return Ok(Effects::none());
                }
            };
            let trial = Trial {
                // The draft that was divided has no vehicle, so leaving it out needs no report.
                left_out: None,
                ..trial
            };
            return Ok(Effects::from(Effect::TryDrafts(trial)));
        }
        DraftLine::Use(name) => {
            if !state.rooms.plans.drafts.choose(&name) {
                return Err(text!("grammar-no-name", word = name).into());
            }
            change::look_at(state, ListKind::Plan);
        }
        DraftLine::Close => {
            files::ask_close(state)?;
            return Ok(Effects::none());
        }
        DraftLine::Undo => change::travel(state, true),
        DraftLine::Redo => change::travel(state, false),
        DraftLine::Speed(speed_m_s) => {
            state.rooms.plans.speed_m_s = speed_m_s;
            return Ok(Effects::none());
        }
        DraftLine::Try { is_apart, vehicles } => {
            let named = vehicles.map(|it| meant(state, Some(it))).transpose()?;
            return Ok(trial::ask(state, is_apart, named.as_deref())?);
        }
        DraftLine::Ground(folder) => {
            ground::choose(state, folder);
            return Ok(Effects::none());
        }
        DraftLine::Edit(edit) => change::edit(state, &edit)?,
    }
    if state.message().is_none() {
        files::say_summary(state);
    }
    Ok(Effects::none())
}

/// The vehicles that a line names, otherwise the addressed ones.
///
/// # Errors
/// A vehicle or a group is unknown.
pub fn meant(state: &State, vehicles: Option<VehicleChoice>) -> Result<Vec<VehicleId>, Refusal> {
    let Some(vehicles) = vehicles else {
        return Ok(state.addressed());
    };
    let named = state.chosen(&vehicles);
    let known = named.and_then(|ids| state.check_known(&ids).map(|()| ids));
    known.map_err(|reason| Refusal::new(EditPart::Vehicles, reason))
}

/// A name that is valid in a command line: one word, and not a comment.
fn plain_name(name: Option<String>) -> String {
    let name = name.unwrap_or_else(|| "plan".to_owned());
    let words = name.split_whitespace();
    let name = words.collect::<Vec<_>>().join("-");
    let name = name.trim_start_matches('#');
    if name.is_empty() {
        "plan".to_owned()
    } else {
        name.to_owned()
    }
}
