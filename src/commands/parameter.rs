//! Commands about parameters, which have their own messages and answers.

use super::encode;
use super::request::{Answer, Request};
use crate::ledger::Risk;
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
    pub fn outcome(&self, value: f32) -> Result<Text, Text> {
        let (name, wanted) = match self {
            Self::Set { name, value } => (name, *value),
            Self::Get { name } => return Ok(format!("{name} = {value}").into()),
        };
        let carried = wanted as f32;
        let is_kept = (value - carried).abs() <= 1e-6 * carried.abs();
        if !is_kept && (value - carried.trunc()).abs() > f32::EPSILON {
            let (value, wanted) = (value.to_string(), wanted.to_string());
            return Err(text!(
                "refused-value",
                name = name,
                value = value,
                wanted = wanted
            ));
        }
        if is_written_so(value, wanted) {
            return Ok(format!("{name} = {value}").into());
        }
        let (value, wanted) = (value.to_string(), wanted.to_string());
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

/// Whether a value equals the typed one, exactly or in its shortest decimal notation (0.1).
pub fn is_written_so(value: f32, written: f64) -> bool {
    let differs = |value: f64| (value - written).abs() > 0.0;
    let shortest = value.to_string().parse().unwrap_or(f64::NAN);
    !differs(f64::from(value)) || !differs(shortest)
}
