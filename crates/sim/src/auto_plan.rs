//! AUTO: carrying out the mission, one navigation command and one parallel action at a time
//! (`AP_Mission` with `ArduCopter`'s `mode_auto`).
//!
//! The vehicle's plans contain the list; this module keeps the position in it. A navigation command
//! becomes the vehicle's task, so that takeoffs, returns and landings are the same as in the other
//! modes.

mod advance;
mod command;
mod driving;
mod guided;
mod place;
mod sequence;
mod start;
mod verify;

#[cfg(test)]
mod tests;

use std::time::Duration;

use glam::DVec3;
use mavlink::dialects::ardupilotmega::{
    MISSION_ITEM_REACHED_DATA, MavMessage, MavSeverity, MissionState,
};

use self::guided::GuidedLimits;
use self::sequence::Jumps;
use super::mode::ModeId;
use super::plan::Item;
use super::task::{Orbit, Task};
use super::vehicle::Vehicle;

/// The first command; item 0 is home.
const FIRST: u16 = 1;

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum PlanState {
    #[default]
    Stopped,
    Running,
    Complete,
}

/// The action that runs in parallel with the navigation command.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct PlanAction {
    at: Option<u16>,
    /// Whether the action is under way.
    loaded: bool,
    /// Whether all actions before the next navigation command are done.
    all_done: bool,
    since: Duration,
}

/// The condition that the current navigation command waits for.
#[derive(Debug, Clone, PartialEq, Default)]
enum PlanWait {
    #[default]
    Nothing,
    /// A takeoff to a height (metres above the start) that waits for the motors and the throttle.
    Throttle(f64),
    /// A wait at the goal, with the time of arrival.
    Stay(Option<Duration>),
    /// The flight to the edge of a circle, where the circle begins.
    Edge(Orbit),
    /// The flight to the place above which a landing begins.
    LandingPlace,
    /// A climb or descent at a place to a height (metres down from the start), with the distance that remained in the
    /// last step.
    Height { down_m: f64, left_m: Option<f64> },
    /// A time since boot.
    Until(Duration),
    /// Setpoints from a ground station: when and where their control began.
    Guided { since: Duration, from_m: DVec3 },
}

/// The vehicle's position in the mission.
#[derive(Debug, Clone, PartialEq, Default)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a fact of its own, and any may hold beside any other"
)]
pub(super) struct AutoPlan {
    state: PlanState,
    /// The navigation command, and whether it is under way.
    nav: Option<u16>,
    nav_loaded: bool,
    /// The command as it was when it began; the list may have changed since.
    nav_item: Item,
    wait: PlanWait,
    action: PlanAction,
    jumps: Jumps,
    /// Whether AUTO has been entered, but the mission has not been started yet.
    starting: bool,
    /// Whether the throttle was raised, a takeoff commanded or a mission started since arming.
    may_lift: bool,
    /// Whether the nose points at a region of interest.
    looks_at_place: bool,
    paused: bool,
    /// Whether the next start resumes at the current item, whatever the value of `MIS_RESTART`.
    resumes: bool,
    /// Whether a requested landing sequence is being flown.
    returns: bool,
    guided_limits: GuidedLimits,
    /// The mode in which a rover ends its mission, once it has.
    ends_in: Option<ModeId>,
    /// The last item reached in this step: one slot, as in the real vehicle.
    reached: Option<u16>,
}

impl AutoPlan {
    /// The item that `MISSION_CURRENT` shows.
    pub(super) fn current(&self) -> u16 {
        self.nav.unwrap_or(0)
    }

    /// Whether the mission was flown to its end.
    pub(super) fn is_complete(&self) -> bool {
        self.state == PlanState::Complete
    }

    /// The state that `MISSION_CURRENT` shows for a list of `items`, home included.
    pub(super) fn reported_state(&self, items: usize) -> MissionState {
        match self.state {
            _ if self.paused => MissionState::MISSION_STATE_PAUSED,
            _ if items < 2 => MissionState::MISSION_STATE_NO_MISSION,
            PlanState::Stopped => MissionState::MISSION_STATE_NOT_STARTED,
            PlanState::Running => MissionState::MISSION_STATE_ACTIVE,
            PlanState::Complete => MissionState::MISSION_STATE_COMPLETE,
        }
    }

    /// The mode in which the mission ended, if it is another one: once.
    pub(super) fn take_end(&mut self) -> Option<ModeId> {
        self.ends_in.take()
    }

    /// Notes a commanded takeoff: a takeoff of the mission no longer waits for the throttle.
    pub(super) fn allow_lifting(&mut self) {
        self.may_lift = true;
    }

    /// Resets the plan when the motors stop.
    fn disarm(&mut self, vehicle: &mut Vehicle) {
        if vehicle.disarm() {
            self.reset();
        }
    }

    /// Starts the mission, or resumes it at the current item, unless it is running.
    pub(super) fn start_unless_running(&mut self, vehicle: &mut Vehicle) {
        if self.state != PlanState::Running {
            self.start_or_resume(vehicle);
        }
    }

    /// Resumes at the current item: in AUTO at once, otherwise when AUTO is entered.
    pub(super) fn go_on(&mut self, vehicle: &mut Vehicle) {
        if vehicle.flight.mode.id != ModeId::Auto {
            self.resumes = true;
        } else if self.state == PlanState::Stopped {
            self.resume(vehicle);
        }
    }

    /// Whether a requested landing sequence is being flown.
    pub(super) fn is_returning(&self) -> bool {
        self.returns
    }

    /// Notes the start or end of a requested landing sequence.
    pub(super) fn set_returning(&mut self, returns: bool) {
        self.returns = returns;
    }

    /// Resets the position to before the first item, as after every disarming. A running mission
    /// continues.
    pub(super) fn reset(&mut self) {
        self.nav = None;
        self.nav_loaded = false;
        self.wait = PlanWait::Nothing;
        self.action = PlanAction::default();
        self.jumps.clear();
        self.may_lift = false;
    }
}

impl AutoPlan {
    /// Whether AUTO is refused now; reports the reason. A disarmed vehicle can always enter AUTO.
    pub(super) fn refuses(&mut self, vehicle: &mut Vehicle) -> bool {
        if !vehicle.safety.armed {
            return false;
        }
        let items = &vehicle.plans.mission;
        let stands = self.nav.filter(|_| !vehicle.tuning.flight.auto.restarts);
        let from = stands.unwrap_or(FIRST);
        let lifts = sequence::takes_off_first(items, from, &self.jumps);
        let empty = items.len() < 2;
        let missing = !empty && vehicle.safety.landed && !lifts;
        if missing {
            vehicle.say(
                MavSeverity::MAV_SEVERITY_CRITICAL,
                "Auto: Missing Takeoff Cmd",
            );
        }
        if empty || missing {
            vehicle.say(
                MavSeverity::MAV_SEVERITY_WARNING,
                "Mode change to AUTO failed: init failed",
            );
        }
        empty || missing
    }

    /// Handles the entry into AUTO: the mission starts with the next step.
    pub(super) fn enter(&mut self) {
        self.starting = true;
        self.ends_in = None;
        self.guided_limits = GuidedLimits::default();
        self.paused = false;
        self.looks_at_place = false;
    }

    /// Handles the exit from AUTO.
    pub(super) fn leave(&mut self) {
        if self.state == PlanState::Running {
            self.state = PlanState::Stopped;
        }
        self.starting = false;
        self.ends_in = None;
        self.returns = false;
        self.wait = PlanWait::Nothing;
    }

    /// One step in AUTO, before the step of the task.
    pub(super) fn step(&mut self, vehicle: &mut Vehicle) {
        let said_before = vehicle.outbox.len();
        if self.starting {
            if vehicle.datum.home().is_some() {
                self.start_or_resume(vehicle);
                self.starting = false;
            }
        } else if self.state == PlanState::Running && vehicle.plans.mission.len() > 1 {
            self.update(vehicle);
        }
        if vehicle.safety.armed {
            self.lift_if_allowed(vehicle);
        }
        if let Some(seq) = self.reached.take() {
            let reached = MavMessage::MISSION_ITEM_REACHED(MISSION_ITEM_REACHED_DATA { seq });
            // The message precedes the texts of its step.
            vehicle
                .outbox
                .insert(said_before.min(vehicle.outbox.len()), reached);
        }
    }

    /// Handles a changed mission: called for every stored item, and whenever the length changes. If
    /// the vehicle is flying to a place, the command begins again with the new item; an emptied
    /// mission is reset.
    pub(super) fn list_changed(&mut self, vehicle: &mut Vehicle) {
        let runs = self.state == PlanState::Running;
        if vehicle.plans.mission.is_empty() && !(runs && vehicle.safety.armed) {
            self.nav = None;
            self.nav_loaded = false;
            self.action = PlanAction::default();
            self.state = PlanState::Stopped;
        }
        if !runs
            || vehicle.flight.mode.id != ModeId::Auto
            || !matches!(vehicle.flight.task, Task::Route(_))
        {
            return;
        }
        let at = self.nav.filter(|&at| vehicle.plans.item(at).is_some());
        let restarted = at.is_some_and(|at| at != 0 && self.set_item(vehicle, at));
        vehicle.say(
            MavSeverity::MAV_SEVERITY_CRITICAL,
            if restarted {
                "Auto mission changed, restarted command"
            } else {
                "Auto mission changed but failed to restart command"
            },
        );
    }

    /// Makes an item the current one; `false` if that is not possible. A stopped mission continues from there when
    /// started.
    pub(super) fn set_item(&mut self, vehicle: &mut Vehicle, at: u16) -> bool {
        if usize::from(at) >= vehicle.plans.mission.len() || vehicle.plans.mission.len() == 1 {
            return false;
        }
        self.action = PlanAction::default();
        self.nav_loaded = false;
        self.returns = false;
        if at == 0 || self.state == PlanState::Complete {
            self.jumps.clear();
        }
        let at = at.max(FIRST);
        if self.state != PlanState::Running {
            return self.prepare(vehicle, at);
        }
        // The new leg begins at once.
        self.paused = false;
        let worked = self.advance_to(vehicle, at);
        if !worked {
            self.complete(vehicle);
        }
        worked
    }

    /// Like `set_item`, but resets the jump counters and starts a stopped mission.
    pub(super) fn reset_to_item(&mut self, vehicle: &mut Vehicle, at: u16) -> bool {
        let may_lift = self.may_lift;
        self.reset();
        self.may_lift = may_lift;
        let worked = self.set_item(vehicle, at);
        if worked {
            self.resume(vehicle);
        }
        worked
    }

    /// Continues at the first item with a tag; `false` if that is not possible.
    pub(super) fn jump_to_tag(&mut self, vehicle: &mut Vehicle, tag: u16) -> bool {
        sequence::tagged(&vehicle.plans.mission, tag).is_some_and(|at| self.set_item(vehicle, at))
    }

    /// Pauses or resumes. Only a flight to a place can be paused; otherwise returns `false`.
    pub(super) fn pause(&mut self, vehicle: &mut Vehicle, pause: bool) -> bool {
        let Task::Route(route) = &mut vehicle.flight.task else {
            return !pause;
        };
        if pause && route.reached {
            return false;
        }
        route.paused = pause;
        self.paused = pause;
        true
    }
}
