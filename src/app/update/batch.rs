//! Parameters set one after another.

use super::{order, relay};
use crate::app::State;
use crate::app::effect::Effects;
use crate::app::room::parameters::setting_line;
use crate::app::state::ParameterSetting;
use crate::crew::protocol::Confirmed;
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// Starts setting values, or adds them to the batch that is under way.
pub fn begin(state: &mut State, settings: Vec<ParameterSetting>) -> Effects {
    if let Some(reason) = relay::own_files(state) {
        state.say(Severity::Warning, reason);
        return Effects::none();
    }
    let room = &mut state.rooms.parameters;
    if let Some(comparison) = &mut room.comparison {
        let names = settings.iter().map(|setting| setting.name.clone());
        comparison.set.extend(names);
    }
    let batch = room.batch.get_or_insert_default();
    batch.add(settings);
    advance(state)
}

/// Counts ended commands and sends the next ones; called when a row of the ledger changes.
pub fn advance(state: &mut State) -> Effects {
    let Some(mut batch) = state.rooms.parameters.batch.take() else {
        return Effects::none();
    };
    batch.count(&state.session.commands.ledger, &state.rooms.parameters);
    let mut effects = Effects::none();
    while let Some(setting) = batch.take_next() {
        match order::prepare(state, &setting_line(&setting)) {
            Ok(order) => {
                let sent = order::send(state, order);
                batch.sent(sent.entry, setting);
                effects.extend([sent.effect]);
            }
            Err(_) => batch.not_sent(&setting),
        }
    }
    match batch.result() {
        Some((confirmed, failed)) => {
            let severity = match failed {
                0 => Severity::Info,
                _ => Severity::Warning,
            };
            let text = text!(
                "parameters-set-done",
                confirmed = confirmed,
                failed = failed
            );
            state.say(severity, text);
        }
        None => state.rooms.parameters.batch = Some(batch),
    }
    effects
}

/// Sends a `param set` without asking for confirmation.
///
/// # Errors
/// The fault of the line, such as a missing target vehicle.
pub fn give(state: &mut State, line: &str) -> Result<Effects, Text> {
    let order = order::prepare(state, line).map_err(|fault| fault.message)?;
    Ok(order::dispatch(state, order, Confirmed::Danger))
}
