//! Operator control: requests to a vehicle to obey one ground station (`MAV_CMD_REQUEST_OPERATOR_CONTROL`).

use super::effect::{Effect, SOON, Watched};
use super::encode::LongFields;
use crate::text;
use crate::text::Text;
use crate::vehicle::Vehicle;

/// `MAV_CMD_REQUEST_OPERATOR_CONTROL`, which the dialect lacks.
pub const REQUEST_CONTROL: u16 = 32100;
/// How long the station in control has to answer a request, in seconds.
const ANSWER_WITHIN_S: f32 = 10.0;

/// A change to the station in control of a vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ControlChange {
    /// Take control, or ask the station in control for it.
    Request {
        /// Whether other stations may take control later without asking.
        takeover: bool,
    },
    /// Give control up: every station may command the vehicle.
    Release,
    /// Let another station take control, for this many seconds.
    Allow { seconds: u16 },
}

impl ControlChange {
    pub(super) fn fields(self, vehicle: &Vehicle) -> Result<LongFields, Text> {
        if vehicle.control.is_none() {
            return Err(text!("refused-no-control"));
        }
        let is_owner_needed = !matches!(self, Self::Request { .. });
        if is_owner_needed && !vehicle.is_controlled_here() {
            let refused = || text!("refused-control-not-here");
            return Err(vehicle.not_in_control().unwrap_or_else(refused));
        }
        let (action, takeover) = match self {
            Self::Request { takeover } => (1.0, takeover),
            Self::Release => (0.0, false),
            Self::Allow { .. } => (1.0, true),
        };
        let takeover = f32::from(u8::from(takeover));
        let station = f32::from(vehicle.station);
        let given = [action, takeover, ANSWER_WITHIN_S, station];
        Ok(LongFields::numbered(REQUEST_CONTROL, &given))
    }

    pub(super) fn effect(self, before: &Vehicle) -> Effect {
        let owner = match self {
            Self::Request { .. } | Self::Allow { .. } => Some(before.station),
            Self::Release => None,
        };
        Effect::new(Watched::Owner(owner), SOON)
    }

    /// Why a vehicle refuses a request: the station in control was asked.
    pub(super) fn likely_reason(self, vehicle: &Vehicle) -> Option<Text> {
        let owner = vehicle.barred_by()?;
        match self {
            Self::Request { .. } => Some(text!("reason-control-asked", station = owner)),
            Self::Release | Self::Allow { .. } => None,
        }
    }
}
