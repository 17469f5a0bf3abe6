//! Commands about parameters, which have their own messages and answers.

use super::encode;
use super::request::{Answer, Request};
use crate::ledger::Risk;
use crate::parameters::{decimal, written};
use crate::text;
use crate::text::Text;
use crate::vehicle::Vehicle;

/// The parameter that selects the checks before arming; 0 for none.
const ARMING_CHECK: &str = "ARMING_CHECK";

#[derive(Debug, Clone, PartialEq)]
pub enum ParameterCommand {
    Get {
        name: String,
    },
    Set {
        name: String,
        /// The new value as typed; `PARAM_SET` carries the nearest `f32`.
        value: f64,
    },
}

impl ParameterCommand {
    pub(super) fn request(&self, vehicle: &Vehicle) -> Result<Request, Text> {
        let (name, message) = match self {
            Self::Get { name } => (name, encode::read_parameter(vehicle, name)?),
            Self::Set { name, value } => {
                (name, encode::write_parameter(vehicle, name, *value as f32)?)
            }
        };
        Ok(Request::new(message, Answer::Parameter(name.clone())))
    }

    /// The outcome from a `PARAM_VALUE`, such as "`WPNAV_SPEED` = 500", with a remark if rounding has changed the
    /// value.
    ///
    /// # Errors
    /// A text if the vehicle has a different value from the one that was set. Integer parameters truncate the fraction,
    /// which is not a fault.
    pub fn outcome(&self, value: f64) -> Result<Text, Text> {
        let (name, wanted) = match self {
            Self::Set { name, value } => (name, *value),
            Self::Get { name } => return Ok(format!("{name} = {}", written(value)).into()),
        };
        if !is_kept(value, wanted) {
            let (value, wanted) = (written(value), wanted.to_string());
            return Err(text!(
                "refused-value",
                name = name,
                value = value,
                wanted = wanted
            ));
        }
        if is_written_so(value, wanted) {
            return Ok(format!("{name} = {}", written(value)).into());
        }
        let (value, wanted) = (written(value), wanted.to_string());
        Ok(text!(
            "outcome-value-became",
            name = name,
            value = value,
            wanted = wanted
        ))
    }

    pub(super) fn risk(&self) -> Risk {
        match self {
            Self::Set { name, value } if name == ARMING_CHECK && *value == 0.0 => Risk::SkipsChecks,
            Self::Set { .. } | Self::Get { .. } => Risk::None,
        }
    }
}

/// Whether a vehicle that was to have a value has it: a whole number to the last digit; a float as it is sent; the whole
/// part of a number with a fraction, which integer parameters drop.
fn is_kept(value: f64, wanted: f64) -> bool {
    let carried = f64::from(wanted as f32);
    let differs = |other: f64| (value - other).abs() > 0.0;
    let is_near = (value - carried).abs() <= 1e-6 * carried.abs();
    let is_whole = value.fract() == 0.0 && wanted.fract() == 0.0;
    !differs(wanted) || !differs(carried) || !differs(carried.trunc()) || is_near && !is_whole
}

/// Whether a value equals the typed one, exactly or in its shortest decimal notation (0.1).
pub fn is_written_so(value: f64, typed: f64) -> bool {
    let differs = |value: f64| (value - typed).abs() > 0.0;
    !differs(value) || !differs(decimal(value))
}
