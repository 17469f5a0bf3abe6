//! Commands that fly the plan on board.

use mavlink::dialects::ardupilotmega::MavCmd;

use super::claim::Claim;
use super::effect::{Effect, PlanAim, SOON, Watched, mode_effect};
use super::encode::LongFields;
use super::flight::{FlightCommand, mode_fields};
use super::request::Request;
use crate::text;
use crate::text::Text;
use crate::vehicle::{PlanPhase, Vehicle, VehicleClass};

/// The mode that flies a plan.
pub(super) const AUTO: &str = "AUTO";
/// The mode of PX4 that flies a plan.
pub(super) const MISSION: &str = "AUTO.MISSION";
/// The modes in which a plan that has begun waits: those of `hold`, and those in which a pilot holds a vehicle.
const WAITING_MODES: [&str; 6] = ["BRAKE", "LOITER", "GUIDED", "POSHOLD", "HOLD", "ALT_HOLD"];
/// The first item of a plan on board, after home.
const FIRST_ITEM: u16 = 1;
/// A vehicle below this speed over ground counts as standing still.
const STANDING_M_S: f32 = 0.5;

/// Flies the plan on board, or interrupts it. Items are numbered as on board: 0 is home.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlanFlight {
    /// Fly the plan in AUTO; on the ground, the vehicle takes off.
    Start,
    /// Continue at an item, in AUTO or when AUTO is entered.
    Goto { item: u16 },
    /// Stop on the way and hold position.
    Pause,
    /// Continue in AUTO at the current item, or at another one; never at the first item, even if
    /// `MIS_RESTART` is set.
    Resume { item: Option<u16> },
    /// Continue at the item after the current one.
    Skip,
    /// Leave AUTO and return.
    Abort,
}

/// The mode in which this vehicle flies a plan.
fn plan_mode(vehicle: &Vehicle) -> &'static str {
    if vehicle.runs_px4() { MISSION } else { AUTO }
}

impl PlanFlight {
    pub(super) fn request(self, vehicle: &Vehicle, confirmation: u8) -> Result<Request, Text> {
        let one = |fields| Request::long(vehicle, &fields, confirmation);
        match self {
            Self::Start => {
                carries_plan(vehicle)?;
                // Most vehicles cannot be armed in AUTO.
                if !vehicle.armed() {
                    return Err(text!("refused-plan-not-armed"));
                }
                Request::chain(vehicle, &start(vehicle), confirmation)
            }
            Self::Goto { item } => {
                exists(vehicle, item)?;
                one(set_item(item, false))
            }
            Self::Pause => {
                in_auto(vehicle)?;
                if vehicle.has_paused() {
                    return Err(text!("refused-plan-paused"));
                }
                one(FlightCommand::Hold.fields(vehicle)?)
            }
            Self::Resume { item } => {
                let steps = resume(vehicle, item)?;
                Request::chain(vehicle, &steps, confirmation)
            }
            Self::Skip => {
                in_auto(vehicle)?;
                let next = vehicle.plan.current.saturating_add(1);
                if last_item(vehicle)? < next {
                    return Err(text!("refused-plan-last", item = vehicle.plan.current));
                }
                one(set_item(next, false))
            }
            Self::Abort => {
                is_under_way(vehicle)?;
                one(FlightCommand::ReturnToLaunch.fields(vehicle)?)
            }
        }
    }

    /// Whether the command sets the item at which to continue.
    pub(super) fn sets_item(self) -> bool {
        match self {
            Self::Start | Self::Goto { .. } | Self::Resume { .. } | Self::Skip => true,
            Self::Pause | Self::Abort => false,
        }
    }

    pub(super) fn effect(self, before: &Vehicle) -> Effect {
        let at_item = |item| Effect::new(Watched::PlanItem(PlanAim::new(before, item)), SOON);
        match self {
            Self::Start => mode_effect(before, plan_mode(before)),
            Self::Goto { item } => at_item(item),
            Self::Pause => FlightCommand::Hold.effect(before),
            Self::Resume { item } => {
                let item = item.unwrap_or(before.plan.current);
                Effect::new(Watched::PlanFlown(PlanAim::new(before, item)), SOON)
            }
            Self::Skip => at_item(before.plan.current.saturating_add(1)),
            Self::Abort => FlightCommand::ReturnToLaunch.effect(before),
        }
    }

    pub(super) fn claim(self, before: &Vehicle) -> Claim {
        match self {
            Self::Start | Self::Resume { .. } => Claim::mode(before, plan_mode(before)),
            Self::Pause => FlightCommand::Hold.claim(before),
            Self::Abort => FlightCommand::ReturnToLaunch.claim(before),
            Self::Goto { .. } | Self::Skip => Claim::default(),
        }
    }

    pub(super) fn likely_reason(self) -> Option<Text> {
        match self {
            Self::Pause => Some(text!("reason-plan-pause")),
            Self::Start | Self::Goto { .. } | Self::Resume { .. } | Self::Skip | Self::Abort => {
                None
            }
        }
    }
}

/// The messages of a start, in order.
///
/// `ArduPlane` continues where it was, after a landing at the landing (`AP_Landing::restart_landing_sequence`). On the
/// ground, it therefore begins at the first item.
fn start(vehicle: &Vehicle) -> Vec<LongFields> {
    let is_plane = vehicle.class() == VehicleClass::Plane;
    let first = (is_plane && !vehicle.is_under_way()).then(|| set_item(FIRST_ITEM, false));
    let start = LongFields::new(MavCmd::MAV_CMD_MISSION_START, &[]);
    first.into_iter().chain([start]).collect()
}

/// The messages of a resumption, in order.
///
/// With `MIS_RESTART`, AUTO begins at the first item, so the item is set again once AUTO is
/// accepted. The item is also set before AUTO, so that the vehicle does not begin a wrong leg.
fn resume(vehicle: &Vehicle, from: Option<u16>) -> Result<Vec<LongFields>, Text> {
    carries_plan(vehicle)?;
    if !vehicle.is_under_way() {
        return Err(text!("refused-plan-on-ground"));
    }
    let progress = vehicle.plan;
    let is_over = progress.phase == Some(PlanPhase::Complete);
    let item = match from {
        Some(item) => item,
        None if is_over => return Err(text!("refused-plan-over")),
        None if progress.current == 0 => return Err(text!("refused-plan-not-begun")),
        None => progress.current,
    };
    exists(vehicle, item)?;
    if !vehicle.flies_plan() {
        let before = (item != progress.current).then(|| set_item(item, false));
        let auto = [mode_fields(vehicle, AUTO)?, set_item(item, false)];
        return Ok(before.into_iter().chain(auto).collect());
    }
    let go_on = LongFields::new(MavCmd::MAV_CMD_DO_PAUSE_CONTINUE, &[1.0]);
    match progress.phase {
        // A mission that has stopped in AUTO begins only with a reset of its jumps.
        Some(PlanPhase::Complete | PlanPhase::NotStarted) => Ok(vec![set_item(item, true)]),
        _ if vehicle.has_paused() => {
            let at = from.map(|item| set_item(item, false));
            Ok(at.into_iter().chain([go_on]).collect())
        }
        Some(PlanPhase::Active | PlanPhase::Paused | PlanPhase::NoPlan) | None
            if from.is_some() =>
        {
            Ok(vec![set_item(item, false)])
        }
        // Older autopilots do not report whether they pause.
        None => Ok(vec![go_on]),
        // A vehicle that reaches its item while slowing down for a pause stands still, and reports
        // the next item as active.
        Some(PlanPhase::Active) if stands(vehicle) && pauses(vehicle) => Ok(vec![go_on]),
        Some(PlanPhase::Active | PlanPhase::Paused | PlanPhase::NoPlan) => {
            Err(text!("refused-plan-flown", item = progress.current))
        }
    }
}

/// Whether a vehicle pauses in AUTO; all but copters leave it to hold.
fn pauses(vehicle: &Vehicle) -> bool {
    vehicle.class() == VehicleClass::Copter
}

/// Whether a vehicle is known to stand still.
fn stands(vehicle: &Vehicle) -> bool {
    let speed_m_s = vehicle.ground_speed_m_s();
    speed_m_s.is_some_and(|speed_m_s| speed_m_s < STANDING_M_S)
}

/// `DO_SET_MISSION_CURRENT`; with `resets`, it resets the jumps and begins a plan that has stopped.
fn set_item(item: u16, resets: bool) -> LongFields {
    let given = [f32::from(item), f32::from(u8::from(resets))];
    LongFields::new(MavCmd::MAV_CMD_DO_SET_MISSION_CURRENT, &given)
}

/// Refuses a vehicle that is known to carry no plan.
fn carries_plan(vehicle: &Vehicle) -> Result<(), Text> {
    if vehicle.last_item() == Some(0) {
        Err(text!("refused-plan-none"))
    } else {
        Ok(())
    }
}

fn last_item(vehicle: &Vehicle) -> Result<u16, Text> {
    carries_plan(vehicle)?;
    vehicle
        .last_item()
        .ok_or_else(|| text!("refused-plan-unread"))
}

/// Refuses an item that the plan does not have.
fn exists(vehicle: &Vehicle, item: u16) -> Result<(), Text> {
    let last = last_item(vehicle)?;
    if item > last {
        return Err(text!("refused-plan-item-none", item = item, last = last));
    }
    Ok(())
}

/// Refuses a vehicle that does not fly its plan.
fn in_auto(vehicle: &Vehicle) -> Result<(), Text> {
    carries_plan(vehicle)?;
    if vehicle.flies_plan() {
        return Ok(());
    }
    Err(not_flown(vehicle))
}

/// Refuses a vehicle that neither flies its plan nor waits on the way.
fn is_under_way(vehicle: &Vehicle) -> Result<(), Text> {
    carries_plan(vehicle)?;
    let waits = vehicle
        .mode()
        .is_some_and(|mode| WAITING_MODES.iter().any(|name| mode.is(name)));
    if vehicle.flies_plan() || waits && vehicle.is_under_way() {
        return Ok(());
    }
    Err(not_flown(vehicle))
}

fn not_flown(vehicle: &Vehicle) -> Text {
    match vehicle.mode() {
        Some(mode) if vehicle.armed() => text!("refused-plan-mode", mode = vehicle.name_of(mode)),
        _ => text!("refused-plan-not-armed"),
    }
}
