//! The console's own lines about the table and its alerts, carried out.

use crate::app::console::swarm::SwarmLine;
use crate::app::room::fly;
use crate::app::state::{AlertKind, State};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

/// Does what a line says.
///
/// # Errors
/// What is wrong with its last word.
pub fn carry_out(state: &mut State, line: SwarmLine) -> Result<(), Text> {
    match line {
        SwarmLine::Sort(sort) => fly::set_sort(state, sort),
        SwarmLine::Filter(text) => fly::filter(state, &text),
        SwarmLine::Columns(names) => state.config.table.columns = names,
        SwarmLine::Ungroup(name) => ungroup(state, &name)?,
        SwarmLine::Mute(kind) => mute(state, kind),
        SwarmLine::Unmute(kind) => unmute(state, kind),
        SwarmLine::AcknowledgeWorst => fly::acknowledge_pressing(state),
        SwarmLine::AcknowledgeKind(kind) => fly::acknowledge(state, |_, known| known == kind),
        SwarmLine::AcknowledgeOf(word) => {
            let ids: Vec<VehicleId> = super::console_line::targeted(state, &word)?;
            fly::acknowledge(state, |id, _| ids.contains(&id));
        }
    }
    Ok(())
}

fn ungroup(state: &mut State, name: &str) -> Result<(), Text> {
    if state.session.groups.remove(name).is_none() {
        return Err(text!("fly-no-group", name = name));
    }
    state.say(Severity::Notice, text!("fly-ungrouped", name = name));
    Ok(())
}

fn mute(state: &mut State, kind: Option<AlertKind>) {
    let muted = &mut state.config.alerts.mute;
    let text = match kind {
        Some(kind) => {
            let name = kind.name().to_owned();
            if !muted.contains(&name) {
                muted.push(name);
            }
            text!("alert-muted", kind = kind.name())
        }
        None if muted.is_empty() => text!("alert-muted-none"),
        None => text!("alert-muted-list", kinds = muted.join(" ")),
    };
    state.session.alarms.mute(&state.config.alerts.mute);
    state.say(Severity::Notice, text);
}

fn unmute(state: &mut State, kind: Option<AlertKind>) {
    let text = match kind {
        Some(kind) => text!("alert-unmuted", kind = kind.name()),
        None => text!("alert-muted-none"),
    };
    let muted = &mut state.config.alerts.mute;
    muted.retain(|name| kind.is_some_and(|kind| kind.name() != name));
    state.session.alarms.mute(&state.config.alerts.mute);
    state.say(Severity::Notice, text);
}
