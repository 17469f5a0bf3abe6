//! Radios under test.

use crate::app::State;
use crate::app::effect::{Effect, Effects, SessionEffect};
use crate::app::state::Activity;
use crate::language::RadioChoice;
use crate::text;
use crate::text::Text;
use crate::vehicle::{RadioTest, Severity, VehicleId};
use crate::vehicle_id::ranges;

/// Begins or ends a test of the radios of vehicles.
///
/// # Errors
/// There is no session, a mission is being flown, a link or a group is unknown, or no vehicle is
/// addressed.
pub fn carry_out(
    state: &mut State,
    choice: &RadioChoice,
    test: Option<RadioTest>,
) -> Result<Effects, Text> {
    match state.session.activity {
        Some(Activity::Free | Activity::Connected { .. }) => {}
        Some(Activity::Mission { .. }) => return Err(text!("radio-mission")),
        None => return Err(text!("messages-no-links")),
    }
    let vehicles = meant(state, choice)?;
    if vehicles.is_empty() {
        return Err(text!("radio-no-vehicles"));
    }
    let named = ranges(vehicles.iter().copied());
    let said = match test {
        Some(test) => text!("radio-on", vehicles = named, figures = test.text()),
        None => text!("radio-off", vehicles = named),
    };
    state.say(Severity::Notice, said);
    let effect = SessionEffect::Radio { vehicles, test };
    Ok(Effects::from(Effect::Session(effect)))
}

fn meant(state: &State, choice: &RadioChoice) -> Result<Vec<VehicleId>, Text> {
    match choice {
        RadioChoice::Addressed => Ok(state.addressed()),
        RadioChoice::Vehicles(choice) => state.chosen(choice),
        RadioChoice::Link(number) => {
            let count = state.session.connections.links.len();
            if !(1..=count).contains(number) {
                return Err(text!("radio-no-link", link = *number, count = count));
            }
            let mine = state.session.vehicles.values();
            let mine = mine.filter(|it| it.link.via.map(usize::from) == Some(number - 1));
            Ok(mine.map(|vehicle| vehicle.id).collect())
        }
    }
}
