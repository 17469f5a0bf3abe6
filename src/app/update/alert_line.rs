//! Carries out commands about alerts: acknowledge, mute, unmute.

use crate::alert::AlertKind;
use crate::app::State;
use crate::app::room::fly;
use crate::language::AlertLine;
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// Carries out a command.
///
/// # Errors
/// The reason why the vehicles that the command names are invalid.
pub fn carry_out(state: &mut State, line: AlertLine) -> Result<(), Text> {
    match line {
        AlertLine::Mute(kind) => mute(state, kind),
        AlertLine::Unmute(kind) => unmute(state, kind),
        AlertLine::AcknowledgeWorst => fly::acknowledge_pressing(state),
        AlertLine::AcknowledgeKind(kind) => fly::acknowledge(state, |_, known| known == kind),
        AlertLine::AcknowledgeOf(vehicles) => {
            let ids = state.chosen(&vehicles)?;
            fly::acknowledge(state, |id, _| ids.contains(&id));
        }
    }
    Ok(())
}

fn mute(state: &mut State, kind: Option<AlertKind>) {
    let muted = &mut state.config.alerts.mute;
    let text = match kind {
        Some(kind) => {
            if !muted.contains(&kind) {
                muted.push(kind);
            }
            text!("alert-muted", kind = kind.name())
        }
        None if muted.is_empty() => text!("alert-muted-none"),
        None => {
            let names: Vec<&str> = muted.iter().map(|kind| kind.name()).collect();
            text!("alert-muted-list", kinds = names.join(" "))
        }
    };
    state.session.alerts.mute(&state.config.alerts.mute);
    state.say(Severity::Notice, text);
}

fn unmute(state: &mut State, kind: Option<AlertKind>) {
    let text = match kind {
        Some(kind) => text!("alert-unmuted", kind = kind.name()),
        None => text!("alert-muted-none"),
    };
    let muted = &mut state.config.alerts.mute;
    muted.retain(|known| kind.is_some_and(|kind| kind != *known));
    state.session.alerts.mute(&state.config.alerts.mute);
    state.say(Severity::Notice, text);
}
