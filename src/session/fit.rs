//! Whether a vehicle could take a parameter's new value.

use crate::commands::{Command, ParameterCommand};
use crate::diagnostic::nearest;
use crate::parameters::ParameterList;
use crate::text;
use crate::text::Text;

/// Checks a command as far as the vehicle's list or the parameter's type is known. `ArduPilot` itself would be silent
/// about a name that it lacks, and cut a value down to something else.
///
/// # Errors
/// Why it could not be.
pub(super) fn check(command: &Command, list: &ParameterList) -> Result<(), Text> {
    let Command::Parameter(ParameterCommand::Set { name, value }) = command else {
        return Ok(());
    };
    let Some(known) = list.get(name) else {
        return if is_known(list) {
            Err(lacking(name, list))
        } else {
            Ok(())
        };
    };
    let checked = known.kind.check(*value);
    checked.map(drop).map_err(|unfit| unfit.text(name))
}

/// Whether a vehicle lacks what is not on its list.
pub(super) fn is_known(list: &ParameterList) -> bool {
    // Others may have appeared since if their number has changed.
    list.is_complete() && !list.is_outdated()
}

/// That a vehicle has no such parameter, and which one may be meant.
fn lacking(name: &str, list: &ParameterList) -> Text {
    let known = list.iter().map(|(name, _)| name);
    match nearest(name, known) {
        Some(nearest) => text!("refused-no-parameter-but", name = name, nearest = nearest),
        None => text!("refused-no-parameter", name = name),
    }
}
