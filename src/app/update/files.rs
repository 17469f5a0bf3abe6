//! User files that were written, or exist already.

use super::ending;
use crate::app::State;
use crate::app::effect::{Effect, Effects, FileEffect, FileKind};
use crate::app::room::plans;
use crate::text;
use crate::vehicle::Severity;

pub fn written(state: &mut State, path: &str) {
    plans::written(state, path);
    state.say(Severity::Info, text!("parameters-saved", path = path));
}

/// Asks before replacing an existing file.
pub fn exists(state: &mut State, kind: FileKind, path: String, text: String) -> Effects {
    let question = text!("parameters-ask-replace", path = &path);
    let reason = text!("parameters-ask-replace-reason");
    let effect = FileEffect::Write {
        kind,
        path,
        text,
        replace: true,
    };
    ending::ask(state, question, reason, Effect::File(effect))
}
