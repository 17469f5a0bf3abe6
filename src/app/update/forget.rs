//! Forgetting vehicles that are gone.

use crate::app::State;
use crate::app::effect::{Effect, Effects, SessionEffect};
use crate::app::room::{files, fly};
use crate::app::state::Activity;
use crate::language::VehicleChoice;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, Vehicle, VehicleId};
use crate::vehicle_id::ranges;
use crate::verb::CrewDuty;

/// Forgets vehicles whose link is lost: the chosen ones, or all.
///
/// # Errors
/// The session is not connected to running vehicles (simulated ones would appear again), no chosen
/// vehicle is known, one is still heard or flown by somebody else, or no link is lost.
pub fn forget(state: &mut State, choice: Option<&VehicleChoice>) -> Result<Effects, Text> {
    if !matches!(state.session.activity, Some(Activity::Connected { .. })) {
        return Err(text!("forget-not-here"));
    }
    let named = match choice {
        Some(choice) => state.chosen(choice)?,
        None => of(state, |vehicle| vehicle.link.lost),
    };
    let (ids, missing): (Vec<VehicleId>, Vec<VehicleId>) = named
        .into_iter()
        .partition(|id| state.session.vehicles.contains_key(id));
    if ids.is_empty() {
        return Err(if missing.is_empty() {
            text!("forget-none-lost")
        } else {
            text!("select-missing", vehicles = ranges(missing))
        });
    }
    let heard = of(state, |vehicle| {
        ids.contains(&vehicle.id) && !vehicle.link.lost
    });
    if !heard.is_empty() {
        return Err(text!("forget-heard", vehicles = ranges(heard)));
    }
    let taken = ids
        .iter()
        .find_map(|&id| state.session.pilots.refusal(id, None, CrewDuty::Flying));
    if let Some(reason) = taken {
        return Err(reason);
    }
    for &id in &ids {
        state.session.forget(id, state.now);
        state.rooms.parameters.forget(id);
        files::forget(state, id);
        state.rooms.map.trails.remove(&id);
    }
    fly::forget(state, &ids);
    let vehicles = ranges(ids.iter().copied());
    state.say(Severity::Notice, text!("forget-done", vehicles = vehicles));
    Ok(Effects::from(Effect::Session(SessionEffect::Forget(ids))))
}

fn of(state: &State, is_so: impl Fn(&Vehicle) -> bool) -> Vec<VehicleId> {
    let vehicles = state.session.vehicles.iter();
    vehicles
        .filter(|(_, vehicle)| is_so(vehicle))
        .map(|(&id, _)| id)
        .collect()
}
