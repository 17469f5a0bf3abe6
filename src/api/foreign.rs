//! Commands of other ground stations as programs see them.

use serde::Serialize;
use utoipa::ToSchema;

use crate::ledger::ForeignCommand;
use crate::text::Locale;
use crate::vehicle::VehicleId;

/// A command of another ground station to one vehicle; repetitions are counted.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct ForeignView {
    /// The command's number among the commands of other stations.
    pub foreign: u32,
    /// When the command was noticed first and last, in seconds since the start of the program.
    pub at_s: f64,
    pub last_at_s: f64,
    /// The station's system and component: `254/230`.
    pub station: String,
    pub vehicle: VehicleId,
    /// The command in the console's words, or the name of its MAVLink command.
    pub what: String,
    /// How many times the command was noticed.
    pub count: u32,
    /// `sent` while there is no answer; `sent_only` for steering, which is never answered;
    /// `in_progress`, `accepted`, `refused` or `superseded`.
    #[schema(value_type = String)]
    pub state: &'static str,
    /// The reason for a refusal.
    pub remark: Option<String>,
}

impl ForeignView {
    pub(super) fn new(command: &ForeignCommand, locale: &Locale) -> Self {
        Self {
            foreign: command.id.0,
            at_s: command.at.as_secs_f64(),
            last_at_s: command.last_at.as_secs_f64(),
            station: command.station.to_string(),
            vehicle: command.vehicle,
            what: locale.text(&command.what),
            count: command.count,
            state: command.state.into(),
            remark: command.explanation.as_ref().map(|text| locale.text(text)),
        }
    }
}
