//! The console's own lines about the table and its alerts, carried out.

use crate::alert::AlertKind;
use crate::app::State;
use crate::app::console::swarm::SwarmLine;
use crate::app::room::fly;
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
        SwarmLine::Columns(columns) => state.config.table.columns = columns,
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
    state.session.alarms.mute(&state.config.alerts.mute);
    state.say(Severity::Notice, text);
}

fn unmute(state: &mut State, kind: Option<AlertKind>) {
    let text = match kind {
        Some(kind) => text!("alert-unmuted", kind = kind.name()),
        None => text!("alert-muted-none"),
    };
    let muted = &mut state.config.alerts.mute;
    muted.retain(|known| kind.is_some_and(|kind| kind != *known));
    state.session.alarms.mute(&state.config.alerts.mute);
    state.say(Severity::Notice, text);
}
