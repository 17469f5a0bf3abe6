//! States of the console as programs see them. Units are in the names; unknown values are `null`.

use std::collections::BTreeMap;
use std::time::Duration;

use serde::Serialize;
use utoipa::ToSchema;

use crate::app::state::{LinkCounters, LinkSummary, NoticeLine};
use crate::doctor::SealCounts;
use crate::geo::LatLon;
use crate::ledger::{LedgerEntry, LedgerRow, RowState};
use crate::mission::{ObjectiveState, Progress};
use crate::parameters::{ListedParameter, ParameterDocument, decimal};
use crate::text::Locale;
use crate::vehicle::{Severity, Vehicle, VehicleId};

mod forward;
mod plan;

pub use forward::{ForwardView, LinksState};
pub use plan::{PlanItemView, PlanView};

/// A vehicle's latest telemetry.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "telemetry has these facts side by side"
)]
pub struct VehicleView {
    pub vehicle: VehicleId,
    pub system_id: u8,
    pub component_id: u8,
    /// The flight mode by its name, or by its number if it has none.
    pub mode: Option<String>,
    pub armed: bool,
    pub in_air: bool,
    /// Whether an arm command should succeed.
    pub ready_to_arm: bool,
    pub lat_deg: Option<f64>,
    pub lon_deg: Option<f64>,
    /// Height above home, in metres.
    pub altitude_m: Option<f64>,
    /// Height above mean sea level, in metres.
    pub altitude_amsl_m: Option<f64>,
    pub ground_speed_m_s: Option<f32>,
    pub heading_deg: Option<f32>,
    pub home_lat_deg: Option<f64>,
    pub home_lon_deg: Option<f64>,
    pub battery_percent: Option<u8>,
    pub battery_v: Option<f32>,
    pub battery_a: Option<f32>,
    /// The item of the plan that AUTO flies.
    pub plan_item: u16,
    /// Whether the vehicle has been silent for too long.
    pub link_lost: bool,
    /// The share of the vehicle's messages that arrives, in percent.
    pub link_percent: u8,
    /// The vehicle's latest reasons not to arm, newest last.
    pub prearm: Vec<String>,
}

impl From<&Vehicle> for VehicleView {
    fn from(vehicle: &Vehicle) -> Self {
        let at = vehicle.global.map(|global| global.at_point);
        let home = vehicle.home.map(|home| home.at_point);
        let battery = vehicle.battery();
        Self {
            vehicle: vehicle.id,
            system_id: vehicle.system,
            component_id: vehicle.component,
            mode: vehicle.mode_name(),
            armed: vehicle.armed(),
            in_air: vehicle.airborne(),
            ready_to_arm: vehicle.ready_to_arm(),
            lat_deg: at.map(|at| at.lat_deg),
            lon_deg: at.map(|at| at.lon_deg),
            altitude_m: vehicle.altitude_m(),
            altitude_amsl_m: vehicle.global.map(|global| global.altitude_amsl_m),
            ground_speed_m_s: vehicle.ground_speed_m_s(),
            heading_deg: vehicle.heading_deg(),
            home_lat_deg: home.map(|home| home.lat_deg),
            home_lon_deg: home.map(|home| home.lon_deg),
            battery_percent: battery.and_then(|battery| battery.remaining_percent),
            battery_v: battery.and_then(|battery| battery.voltage_v),
            battery_a: battery.and_then(|battery| battery.current_a),
            plan_item: vehicle.plan.current,
            link_lost: vehicle.link.lost,
            link_percent: vehicle.link.percent(),
            prearm: vehicle.prearm.clone(),
        }
    }
}

/// The state of a command for one vehicle.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, ToSchema)]
pub struct RowView {
    /// The command's number in the ledger.
    pub entry: u32,
    /// The whole line, with its targets.
    pub line: String,
    pub vehicle: VehicleId,
    /// `queued`, `sent`, `sent_only` (nothing more is awaited), `in_progress`, `accepted`, `done`, `no_effect`, `refused`,
    /// `timed_out`, `superseded` or `overtaken`.
    #[schema(value_type = String)]
    pub state: &'static str,
    /// The progress that the vehicle reports, in percent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub percent: Option<u8>,
    /// Whether the state is the last one.
    pub is_final: bool,
    /// The number of times that the command has been sent.
    pub tries: u8,
    /// The reason for a refusal, or a remark, if there is one.
    pub remark: Option<String>,
}

impl RowView {
    pub(super) fn new(entry: &LedgerEntry, row: &LedgerRow, locale: &Locale) -> Self {
        Self {
            entry: entry.id.0,
            line: entry.line.clone(),
            vehicle: row.vehicle,
            state: row.state.into(),
            percent: match row.state {
                RowState::InProgress(percent) => Some(percent),
                RowState::Queued
                | RowState::Sent
                | RowState::SentOnly
                | RowState::Accepted
                | RowState::Done
                | RowState::NoEffect
                | RowState::Refused
                | RowState::TimedOut
                | RowState::Superseded
                | RowState::Overtaken
                | RowState::Barred => None,
            },
            is_final: row.state.is_final(),
            tries: row.tries,
            remark: row.remark().map(|remark| locale.text(&remark)),
        }
    }
}

/// A command with its rows.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct EntryView {
    pub entry: u32,
    /// When the command was given, in seconds since the start of the program.
    pub at_s: f64,
    /// The whole line, with its targets.
    pub line: String,
    pub rows: Vec<RowView>,
}

impl EntryView {
    pub(super) fn new(entry: &LedgerEntry, locale: &Locale) -> Self {
        let rows = entry.rows.iter();
        Self {
            entry: entry.id.0,
            at_s: entry.at.as_secs_f64(),
            line: entry.line.clone(),
            rows: rows.map(|row| RowView::new(entry, row, locale)).collect(),
        }
    }
}

/// A notice; identical ones within a short time are merged.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct NoticeView {
    /// When the first of the merged notices arrived, in seconds since the start of the program.
    pub at_s: f64,
    pub vehicle: Option<VehicleId>,
    /// `MAV_SEVERITY`: 0 (emergency) to 7 (debug).
    pub severity: u8,
    pub text: String,
}

impl NoticeView {
    pub(super) fn new(line: &NoticeLine, locale: &Locale) -> Self {
        let notice = &line.notice;
        Self {
            at_s: notice.at.as_secs_f64(),
            vehicle: notice.vehicle,
            severity: number(notice.severity),
            text: locale.text(&notice.text),
        }
    }
}

fn number(severity: Severity) -> u8 {
    severity as u8
}

/// The progress of the current mission.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct MissionView {
    pub title: String,
    pub elapsed_s: f64,
    pub limit_s: f64,
    /// The points earned so far, 0 to 1000, without the cap for mandatory objectives until the mission is over; `null`
    /// before the first takeoff.
    pub score: Option<u16>,
    /// Whether the mission is over.
    pub over: bool,
    pub objectives: Vec<ObjectiveView>,
    pub readings: Vec<ReadingView>,
    /// The contacts that detectors have found so far.
    pub contacts: Vec<ContactView>,
    /// Alerts that need an acknowledgement.
    pub alerts: Vec<String>,
    /// The places that lines may name.
    pub places: Vec<NamedPlaceView>,
}

/// An objective of the mission.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct ObjectiveView {
    pub title: String,
    /// The progress of the objective in words.
    pub detail: String,
    /// The share of the objective that is reached, 0 to 1.
    pub fraction: f64,
    pub met: bool,
}

/// The current reading of a vehicle's sensor.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct ReadingView {
    pub vehicle: VehicleId,
    pub sensor: String,
    pub value: f64,
    #[schema(value_type = String)]
    pub unit: &'static str,
}

/// A contact that detectors have found.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct ContactView {
    pub name: String,
    pub lat_deg: f64,
    pub lon_deg: f64,
}

/// A place with a name that lines may use.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct NamedPlaceView {
    pub name: String,
    pub lat_deg: f64,
    pub lon_deg: f64,
}

impl MissionView {
    /// A mission's progress for programs; `known` are the places that are known from the start.
    pub(super) fn new(
        progress: &Progress,
        known: &BTreeMap<String, LatLon>,
        over: bool,
        locale: &Locale,
    ) -> Self {
        let objectives = progress.objectives.iter().map(|it| ObjectiveView {
            title: locale.text(&it.title),
            detail: locale.text(&it.detail),
            fraction: it.fraction,
            met: it.state == ObjectiveState::Met,
        });
        let readings = progress.readings.iter().map(|it| ReadingView {
            vehicle: it.vehicle,
            sensor: locale.text(&it.sensor),
            value: it.value,
            unit: it.unit,
        });
        let contacts = progress.contacts.iter().map(|it| ContactView {
            name: it.name.clone(),
            lat_deg: it.at.lat_deg,
            lon_deg: it.at.lon_deg,
        });
        let alerts = progress.alerts.iter();
        let places = known.iter().chain(&progress.places);
        Self {
            title: locale.text(&progress.title),
            elapsed_s: progress.elapsed.as_secs_f64(),
            limit_s: progress.limit.as_secs_f64(),
            score: progress.score_so_far,
            over,
            objectives: objectives.collect(),
            readings: readings.collect(),
            contacts: contacts.collect(),
            alerts: alerts.map(|it| locale.text(&it.text)).collect(),
            places: places
                .map(|(name, at)| NamedPlaceView::new(name, *at))
                .collect(),
        }
    }
}

impl NamedPlaceView {
    fn new(name: &str, at: LatLon) -> Self {
        Self {
            name: name.to_owned(),
            lat_deg: at.lat_deg,
            lon_deg: at.lon_deg,
        }
    }
}

/// The counters of a link.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct LinkView {
    pub address: String,
    /// Whether the link carries data.
    pub up: bool,
    /// The reason why the link carries no data.
    pub error: Option<String>,
    pub bytes_in_per_s: f64,
    pub bytes_out_per_s: f64,
    pub messages_in_per_s: f64,
    pub messages_out_per_s: f64,
    /// Frames that are missing by their sequence numbers; `null` in a replay, like the counters below.
    pub lost: Option<u64>,
    /// Frames with a wrong checksum.
    pub bad_crc: Option<u64>,
    pub reconnects: Option<u32>,
    pub round_trip_ms: Option<f64>,
    /// Frames by their signatures; `null` if no signatures are used.
    pub signatures: Option<SignatureView>,
}

/// Frames of a link by their signatures.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct SignatureView {
    /// Signed with the key of their vehicle, at a new time.
    pub right: u64,
    pub unsigned: u64,
    /// Signed, but not with a key that the console has.
    pub wrong_key: u64,
    /// Signed with the right key, at an old time: perhaps replayed.
    pub old_stamp: u64,
}

impl From<SealCounts> for SignatureView {
    fn from(counts: SealCounts) -> Self {
        Self {
            right: counts.right,
            unsigned: counts.unsigned,
            wrong_key: counts.foreign,
            old_stamp: counts.old,
        }
    }
}

impl LinkView {
    pub(super) fn new(link: &LinkSummary, locale: &Locale) -> Self {
        let counters = link.counters.as_ref();
        let ms = |time: Duration| time.as_secs_f64() * 1e3;
        Self {
            address: link.name.to_string(),
            up: link.up,
            error: link.error.as_ref().map(|error| locale.text(error)),
            bytes_in_per_s: link.bytes_in_per_s,
            bytes_out_per_s: link.bytes_out_per_s,
            messages_in_per_s: link.messages_in_per_s,
            messages_out_per_s: link.messages_out_per_s,
            lost: counters.map(LinkCounters::all_lost),
            bad_crc: counters.map(|it| it.bad_crc),
            reconnects: counters.map(|it| it.reconnects),
            round_trip_ms: link.round_trip.map(ms),
            signatures: counters.and_then(|it| it.seals).map(Into::into),
        }
    }
}

/// A parameter of a vehicle.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct ParameterView {
    pub name: String,
    pub value: f64,
    /// The default; `null` if the vehicle has not told it.
    pub default: Option<f64>,
    /// The unit; `null` if none is documented.
    pub unit: Option<String>,
    /// The meaning of the value; `null` if none is documented.
    pub meaning: Option<String>,
}

impl ParameterView {
    pub(super) fn new(
        name: &str,
        parameter: &ListedParameter,
        default: Option<f64>,
        document: Option<&ParameterDocument>,
    ) -> Self {
        let unit = document.map(|it| it.unit.clone());
        Self {
            name: name.to_owned(),
            value: decimal(parameter.value),
            default: default.map(decimal),
            unit: unit.filter(|unit| !unit.is_empty()),
            meaning: document.and_then(|it| it.meaning(parameter.value)),
        }
    }
}

/// The files of a recorded flight.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, ToSchema)]
pub struct RecordView {
    /// The common name of the files, without a suffix.
    pub name: String,
    /// Bytes of frames and journal.
    pub bytes: u64,
    /// The file with the frames of all links, a tlog.
    pub frames: Option<String>,
    /// The record of the mission's run; `null` if there is none.
    pub run: Option<String>,
}
