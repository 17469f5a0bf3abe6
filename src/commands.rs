//! Typed commands to a vehicle.
//!
//! Each command is a value with named fields in physical units. It provides the MAVLink request for a given vehicle
//! ([`Command::request`]) with the answer to wait for ([`Request::answer`]), and the effect to expect in telemetry
//! ([`Command::effect`]).
//!
//! # How the parts fit
//! - What a command is, by subject: `arming`, `flight`, `motion` with `destination`, `plan_flight`, `device`,
//!   `control`, `query`, `parameter`, `log`, `file`, `plan`, `sticks`, `raw`; for several vehicles `manoeuvre` and
//!   `task` (pure data); for the mission `deed`, with `find_kind`. `order` is a line with its targets.
//! - Whether it is possible now, and which messages it takes: `request`, `encode`, `mav_cmd`, `modes`, `setpoint`
//!   (when setpoints are ignored), `px4` (what PX4 needs instead).
//! - When it is done: `effect`. When something else has taken over the vehicle: `claim`. When commanded speeds must
//!   be sent again: `speeds`. Why a command was refused: `explain`.

use crate::ledger::Risk;
use crate::signing::SigningChange;
use crate::text;
use crate::text::Text;
use crate::vehicle::{PauseChange, Vehicle};

mod arming;
mod claim;
mod control;
mod deed;
mod destination;
mod device;
mod effect;
mod encode;
mod explain;
mod file;
mod find_kind;
mod flight;
mod log;
mod manoeuvre;
mod mav_cmd;
mod modes;
mod motion;
mod nearness;
mod order;
mod parameter;
mod plan;
mod plan_flight;
mod px4;
mod query;
mod raw;
mod request;
mod setpoint;
mod speeds;
mod sticks;
mod suits;
mod task;
#[cfg(test)]
mod tests;

pub use arming::ArmingCommand;
pub use claim::Claim;
pub use control::{ControlChange, REQUEST_CONTROL};
pub use deed::{Deed, Goal, GoalComponent, Spot, Subject};
pub use destination::{Destination, Heading};
pub use device::DeviceCommand;
pub use effect::Effect;
pub use explain::{AckResult, explain};
pub use file::{FileCommand, folder_of, last_part, path_in};
pub use find_kind::{CONTACT_STEMS, FindKind, PEAK_PLACE, is_contact_name, is_peak_name};
pub use flight::FlightCommand;
pub use log::{LogChoice, LogCommand, LogGroup};
pub use manoeuvre::{Datum, FarEnd, Ground, Manoeuvre, Pattern, Shape};
pub use mav_cmd::{command_by_name, command_name, command_names};
pub use motion::MotionCommand;
pub use nearness::{is_back, stopped_m};
pub use order::{Act, Order};
pub use parameter::{ParameterCommand, is_written_so};
pub use plan::{PlanCommand, PlanDeed, PlanSource, ProtectedItem, protected_item};
pub use plan_flight::PlanFlight;
pub use query::QueryCommand;
pub use raw::{RawCommand, RawMessage};
pub use request::{Answer, Offboard, Repeat, Request};
pub use setpoint::{Setpoint, ready_for};
pub use speeds::{CHANGE_SPEED, asked_again};
pub use sticks::{
    CENTRE_US, StickChange, hold_message, may_ignore_sticks, release_message, stick_obstacle,
};
pub use suits::suits;
pub use task::PlanTask;

/// A command to one vehicle, grouped by subject. Every command in these groups has one verb of the
/// grammar.
#[derive(Debug, Clone, PartialEq)]
pub enum Command {
    Arming(ArmingCommand),
    /// Begins, ends and interrupts a flight.
    Flight(FlightCommand),
    /// Flies the plan on board, or interrupts it.
    PlanFlight(PlanFlight),
    /// Sets where and how a vehicle flies, its point of interest, and its home.
    Motion(MotionCommand),
    /// Sets outputs, switches the fence, or reboots the autopilot.
    Device(DeviceCommand),
    Query(QueryCommand),
    Parameter(ParameterCommand),
    /// The logs that the vehicle keeps of its flights.
    Log(LogCommand),
    /// The files that the vehicle offers.
    File(FileCommand),
    /// The lists that the vehicle carries: plan, fence and rally points.
    Plan(PlanCommand),
    /// The key with which the vehicle signs.
    Signing(SigningChange),
    /// Sent as typed, without interpretation.
    Raw(RawCommand),
}

/// The change that a command makes to a vehicle's setup, apart from its flight.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Setup<'command> {
    /// The parameter with this name.
    Parameter(&'command str),
    /// Home: the reference of the vehicle's heights, and the place to which it returns.
    Home,
    /// The areas that the vehicle must keep to, or the places where a return may end.
    Limits,
    /// An item of a plan that changes home or the fence when it is flown.
    PlanItem(ProtectedItem),
    /// A file on board, which may contain parameters, a plan or a script.
    Files,
    /// The channels of the transmitter.
    Sticks,
    /// Anything: a raw command is not interpreted.
    Anything,
}

impl Command {
    /// The change that the command makes to the vehicle's setup, if any.
    pub fn setup(&self) -> Option<Setup<'_>> {
        match self {
            Self::Parameter(ParameterCommand::Set { name, .. }) => Some(Setup::Parameter(name)),
            Self::Motion(MotionCommand::SetHome { .. }) => Some(Setup::Home),
            Self::Plan(command) => command.setup(),
            Self::Device(DeviceCommand::Fence { .. }) => Some(Setup::Limits),
            Self::File(command) => command.changes_files().then_some(Setup::Files),
            Self::Device(DeviceCommand::Sticks(StickChange::Hold { .. })) => Some(Setup::Sticks),
            Self::Raw(_) => Some(Setup::Anything),
            Self::Parameter(ParameterCommand::Get { .. })
            | Self::Motion(_)
            | Self::Arming(_)
            | Self::Flight(_)
            | Self::PlanFlight(_)
            | Self::Device(_)
            | Self::Query(_)
            | Self::Log(_)
            | Self::Signing(_) => None,
        }
    }

    /// The messages for `vehicle` in its current state.
    ///
    /// Relative commands (an offset, the current height) are resolved here from the vehicle's state, so call it once
    /// per transaction and resend the same messages for another attempt ([`Request::again`]): a second call would move
    /// the target.
    ///
    /// # Errors
    /// A text if it is not possible for this vehicle now: a mode that its class lacks, a setpoint outside GUIDED
    /// (ArduCopter would ignore it silently), a relative target without a position, a value that is not a finite
    /// number.
    pub fn request(&self, vehicle: &Vehicle, confirmation: u8) -> Result<Request, Text> {
        if let Some(reason) = vehicle
            .not_in_control()
            .filter(|_| self.is_ignored_silently())
        {
            return Err(reason);
        }
        if vehicle.runs_px4()
            && let Some(request) = px4::request(self, vehicle, confirmation)
        {
            return request;
        }
        let long = |fields| Request::long(vehicle, &fields, confirmation);
        match self {
            Self::Arming(command) => long(command.fields(vehicle)?),
            Self::Flight(command) => long(command.fields(vehicle)?),
            Self::PlanFlight(command) => command.request(vehicle, confirmation),
            Self::Motion(command) => command.request(vehicle, confirmation),
            Self::Device(command) => long(command.fields(vehicle)?),
            Self::Query(command) => long(command.fields()),
            Self::Parameter(command) => command.request(vehicle),
            // A session reads logs separately from its commands.
            Self::Log(_) => Err(text!("refused-logs-here")),
            // Nor are files and lists transferred as commands.
            Self::File(_) => Err(text!("refused-files-here")),
            Self::Plan(_) => Err(text!("refused-plan-here")),
            Self::Signing(_) => Err(text!("refused-signing-here")),
            Self::Raw(command) => command.request(vehicle, confirmation),
        }
    }

    /// Whether a vehicle that obeys another ground station ignores the command without an answer that says so.
    fn is_ignored_silently(&self) -> bool {
        match self {
            Self::Motion(command) => command.is_setpoint(),
            Self::Parameter(command) => matches!(command, ParameterCommand::Set { .. }),
            Self::Arming(_)
            | Self::Flight(_)
            | Self::PlanFlight(_)
            | Self::Device(_)
            | Self::Query(_)
            | Self::Log(_)
            | Self::File(_)
            | Self::Plan(_)
            | Self::Signing(_)
            | Self::Raw(_) => false,
        }
    }

    /// How the command's message must be repeated; `None` if it is sent only once.
    pub fn repeat(&self) -> Option<Repeat> {
        match self {
            Self::Motion(command) => command.repeat(),
            Self::Arming(_)
            | Self::Flight(_)
            | Self::PlanFlight(_)
            | Self::Device(_)
            | Self::Query(_)
            | Self::Parameter(_)
            | Self::Log(_)
            | Self::File(_)
            | Self::Plan(_)
            | Self::Signing(_)
            | Self::Raw(_) => None,
        }
    }

    /// The change that the command makes to the pause of a vehicle that flies its plan, if any.
    pub fn changes_pause(&self) -> Option<PauseChange> {
        match self {
            Self::Flight(FlightCommand::Hold) | Self::PlanFlight(PlanFlight::Pause) => {
                Some(PauseChange::Begins)
            }
            Self::Flight(FlightCommand::Resume) => Some(PauseChange::Ends),
            other => other.sets_plan_item().then_some(PauseChange::Ends),
        }
    }

    /// Whether the command sets the plan item at which the vehicle continues.
    pub fn sets_plan_item(&self) -> bool {
        match self {
            Self::PlanFlight(command) => command.sets_item(),
            Self::Arming(_)
            | Self::Flight(_)
            | Self::Motion(_)
            | Self::Device(_)
            | Self::Query(_)
            | Self::Parameter(_)
            | Self::Log(_)
            | Self::File(_)
            | Self::Plan(_)
            | Self::Signing(_)
            | Self::Raw(_) => false,
        }
    }

    /// The effect to expect in telemetry, given the vehicle when the command was sent.
    pub fn effect(&self, before: &Vehicle) -> Effect {
        match self {
            Self::Arming(command) => command.effect(),
            Self::Flight(command) => command.effect(before),
            Self::PlanFlight(command) => command.effect(before),
            Self::Motion(command) => command.effect(before),
            Self::Device(command) => command.effect(before),
            Self::Query(_)
            | Self::Parameter(_)
            | Self::Log(_)
            | Self::File(_)
            | Self::Plan(_)
            | Self::Signing(_)
            | Self::Raw(_) => Effect::nothing(),
        }
    }

    /// Why the command needs a confirmation for this vehicle now, although its verb does not;
    /// `None` if it needs none.
    pub fn hazard(&self, vehicle: &Vehicle) -> Option<Text> {
        match self {
            Self::Plan(command) => command.hazard(vehicle),
            Self::File(command) => command.hazard(),
            Self::Device(command) => command.hazard(vehicle),
            Self::Signing(change) => Some(signing_hazard(*change)),
            Self::Raw(command) => Some(command.hazard()),
            Self::Arming(_)
            | Self::Flight(_)
            | Self::PlanFlight(_)
            | Self::Motion(_)
            | Self::Query(_)
            | Self::Parameter(_)
            | Self::Log(_) => None,
        }
    }

    /// The command's risk, the same whether it is given by its own verb or as a raw command.
    pub fn risk(&self) -> Risk {
        match self {
            Self::Arming(command) => command.risk(),
            Self::Parameter(command) => command.risk(),
            Self::Raw(command) => command.risk(),
            Self::Flight(_)
            | Self::PlanFlight(_)
            | Self::Motion(_)
            | Self::Device(_)
            | Self::Query(_)
            | Self::Log(_)
            | Self::File(_)
            | Self::Plan(_)
            | Self::Signing(_) => Risk::None,
        }
    }
}

/// The hazard of a change to the signing key. A new key crosses the link in clear text; without a
/// key, vehicles obey anyone's frames.
fn signing_hazard(change: SigningChange) -> Text {
    match change {
        SigningChange::SetUp => text!("hazard-signing-setup"),
        SigningChange::Rotate => text!("hazard-signing-rotate"),
        SigningChange::Remove => text!("hazard-signing-remove"),
    }
}
