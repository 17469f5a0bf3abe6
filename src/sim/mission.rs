//! AUTO: carrying out the mission, one navigation command and one action beside it at a time (`AP_Mission` with
//! `ArduCopter`'s `mode_auto`).
//!
//! The list itself lies in the vehicle's plans; this knows where in it the vehicle is. A navigation command becomes
//! the vehicle's task, so that takeoffs, returns and landings are the same as in the other modes.

mod command;
mod place;
mod sequence;
mod start;
mod verify;

#[cfg(test)]
mod tests;

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{
    MISSION_ITEM_REACHED_DATA, MavMessage, MavSeverity, MissionState,
};

use self::sequence::Jumps;
use super::autopilot::Autopilot;
use super::mode;
use super::plan::{Item, ListKind};
use super::task::{Orbit, Route, Task};

/// The first command; item 0 is home.
const FIRST: u16 = 1;
/// How many items a navigation command may be searched over in one step.
const ITEMS_PER_STEP: usize = 255;

/// Whether a mission runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum State {
    #[default]
    Stopped,
    Running,
    Complete,
}

/// The action beside the navigation command.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Action {
    at: Option<u16>,
    /// Whether it is still under way.
    loaded: bool,
    /// Whether there is none left before the navigation command is over.
    all_done: bool,
    since: Duration,
}

/// What the current navigation command waits for.
#[derive(Debug, Clone, PartialEq, Default)]
enum Wait {
    #[default]
    Nothing,
    /// A takeoff to a height (metres above the start) that waits for the motors and the throttle.
    Throttle(f64),
    /// A stay at the goal, since the vehicle got there.
    Stay(Option<Duration>),
    /// A circle that begins when its edge is reached.
    Edge(Orbit),
    /// A landing that begins when its place is reached.
    LandingPlace,
    /// A height (metres down from the start), once the place is reached; then with the way that was left.
    Height { down_m: f64, left_m: Option<f64> },
    /// A time.
    Until(Duration),
    /// Setpoints from outside, for ever.
    Guided,
}

/// Where in the mission the vehicle is.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Mission {
    state: State,
    /// The navigation command, and whether it is under way.
    nav: Option<u16>,
    nav_loaded: bool,
    nav_since: Duration,
    wait: Wait,
    action: Action,
    jumps: Jumps,
    /// AUTO has been entered, but the mission has not been started since.
    starting: bool,
    /// The throttle was raised, or a mission started, since arming.
    may_lift: bool,
    /// When the motors were armed.
    armed_at: Duration,
    /// The nose looks at a place of interest.
    looks_at_place: bool,
    paused: bool,
    /// The next start goes on where the mission stands, whatever `MIS_RESTART` says.
    resumes: bool,
    /// A landing sequence is flown on request.
    returns: bool,
    /// The last item that was reached in this step: one slot, as in the vehicle.
    reached: Option<u16>,
}

impl Mission {
    /// The item that `MISSION_CURRENT` shows.
    pub(super) fn current(&self) -> u16 {
        self.nav.unwrap_or(0)
    }

    /// The state that `MISSION_CURRENT` shows for a list of `items`, home included.
    pub(super) fn reported_state(&self, items: usize) -> MissionState {
        match self.state {
            _ if self.paused => MissionState::MISSION_STATE_PAUSED,
            _ if items < 2 => MissionState::MISSION_STATE_NO_MISSION,
            State::Stopped => MissionState::MISSION_STATE_NOT_STARTED,
            State::Running => MissionState::MISSION_STATE_ACTIVE,
            State::Complete => MissionState::MISSION_STATE_COMPLETE,
        }
    }

    /// Whether the mission hands the vehicle to setpoints from outside.
    pub(super) fn is_guided(&self) -> bool {
        self.wait == Wait::Guided
    }

    /// The motors have been armed; they take their time before they lift.
    pub(super) fn note_arming(&mut self, now: Duration) {
        self.armed_at = now;
    }

    /// Back before the first item, as after every disarming. A running mission goes on running.
    pub(super) fn reset(&mut self) {
        self.nav = None;
        self.nav_loaded = false;
        self.wait = Wait::Nothing;
        self.action = Action::default();
        self.jumps.clear();
        self.may_lift = false;
    }
}

impl Autopilot {
    /// Why AUTO cannot be entered now, as a text; `None` if it can. Disarmed it always can.
    pub(super) fn mission_obstacle(&self) -> Option<&'static [(MavSeverity, &'static str)]> {
        const FAILED: (MavSeverity, &str) = (
            MavSeverity::MAV_SEVERITY_WARNING,
            "Mode change to AUTO failed: init failed",
        );
        const NO_TAKEOFF: (MavSeverity, &str) = (
            MavSeverity::MAV_SEVERITY_CRITICAL,
            "Auto: Missing Takeoff Cmd",
        );
        let items = &self.plans.mission;
        let from = if self.tuning.auto.restarts {
            FIRST
        } else {
            self.mission.nav.unwrap_or(FIRST)
        };
        if !self.safety.armed {
            None
        } else if items.len() < 2 {
            Some(&[FAILED])
        } else if self.safety.landed && !sequence::takes_off_first(items, from, &self.mission.jumps)
        {
            Some(&[NO_TAKEOFF, FAILED])
        } else {
            None
        }
    }

    /// AUTO has been entered: the mission starts with the next step.
    pub(super) fn enter_mission(&mut self) {
        self.mission.starting = true;
        self.mission.paused = false;
        self.mission.looks_at_place = false;
    }

    /// AUTO has been left.
    pub(super) fn leave_mission(&mut self) {
        if self.mission.state == State::Running {
            self.mission.state = State::Stopped;
        }
        self.mission.starting = false;
        self.mission.returns = false;
        self.mission.wait = Wait::Nothing;
    }

    /// `MISSION_START`: enters AUTO and allows the takeoff. A vehicle without a mission lands.
    pub(super) fn start_mission(&mut self) -> bool {
        if !self.set_mode(mode::AUTO) {
            return false;
        }
        self.mission.may_lift = true;
        if self.plans.mission.len() < 2 {
            return self.set_mode(mode::LAND);
        }
        if self.mission.state != State::Running {
            self.start_or_resume();
        }
        true
    }

    /// One step in AUTO, before the step of the task.
    pub(super) fn fly_mission(&mut self) {
        let said_before = self.outbox.len();
        if self.mission.starting {
            if self.home.is_some() {
                self.start_or_resume();
                self.mission.starting = false;
            }
        } else if self.mission.state == State::Running && self.plans.mission.len() > 1 {
            self.update_mission();
        }
        if self.safety.armed {
            self.lift_if_allowed();
        }
        if let Some(seq) = self.mission.reached.take() {
            let reached = MavMessage::MISSION_ITEM_REACHED(MISSION_ITEM_REACHED_DATA { seq });
            // The message overtakes the texts of its step.
            self.outbox
                .insert(said_before.min(self.outbox.len()), reached);
        }
    }

    /// A list was written to: called for every item that was stored, and whenever its length changes. On the way to a
    /// place the command begins again with what the list says now; an emptied mission is forgotten.
    #[cfg_attr(not(test), expect(dead_code, reason = "uploads call it"))]
    pub(super) fn plans_changed(&mut self, kind: ListKind) {
        if kind != ListKind::Mission {
            return;
        }
        let runs = self.mission.state == State::Running;
        if self.plans.mission.is_empty() && !(runs && self.safety.armed) {
            self.mission.nav = None;
            self.mission.nav_loaded = false;
            self.mission.action = Action::default();
            self.mission.state = State::Stopped;
        }
        if !runs || self.mode.number != mode::AUTO || !matches!(self.task, Task::Route(_)) {
            return;
        }
        let at = self.mission.nav.filter(|&at| self.item(at).is_some());
        let restarted = at.is_some_and(|at| at != 0 && self.set_mission_item(at));
        self.say(
            MavSeverity::MAV_SEVERITY_CRITICAL,
            if restarted {
                "Auto mission changed, restarted command"
            } else {
                "Auto mission changed but failed to restart command"
            },
        );
    }

    /// Makes an item the current one; `false` if that is not possible. A mission that does not run goes on from there
    /// when it is started.
    pub(super) fn set_mission_item(&mut self, at: u16) -> bool {
        if usize::from(at) >= self.plans.mission.len() || self.plans.mission.len() == 1 {
            return false;
        }
        self.mission.action = Action::default();
        self.mission.nav_loaded = false;
        self.mission.returns = false;
        if at == 0 || self.mission.state == State::Complete {
            self.mission.jumps.clear();
        }
        let at = at.max(FIRST);
        if self.mission.state != State::Running {
            return self.prepare(at);
        }
        let worked = self.advance_to(at);
        if !worked {
            self.complete_mission();
        }
        worked
    }

    /// The same, with the jumps forgotten and the mission running again.
    pub(super) fn reset_to_mission_item(&mut self, at: u16) -> bool {
        let may_lift = self.mission.may_lift;
        self.mission.reset();
        self.mission.may_lift = may_lift;
        let worked = self.set_mission_item(at);
        if worked {
            self.resume_mission();
        }
        worked
    }

    /// Goes on from the first item with a tag.
    pub(super) fn jump_to_tag(&mut self, tag: u16) -> bool {
        sequence::tagged(&self.plans.mission, tag).is_some_and(|at| self.set_mission_item(at))
    }

    /// Goes on from the nearest `DO_LAND_START`, in a mode that ground stations see as AUTO RTL.
    pub(super) fn fly_landing_sequence(&mut self) -> bool {
        let worked = self
            .landing_start()
            .is_some_and(|at| self.set_mission_item(at));
        if !worked {
            return false;
        }
        self.say(MavSeverity::MAV_SEVERITY_INFO, "Landing sequence start");
        if self.mode.number != mode::AUTO {
            self.mission.resumes = true;
        } else if self.mission.state == State::Stopped {
            self.resume_mission();
        }
        self.mission.returns = self.set_mode(mode::AUTO);
        self.mission.returns
    }

    /// The mode that ground stations see: AUTO on the way to a landing has a number of its own.
    pub(super) fn reported_mode(&self) -> u8 {
        if self.mode.number == mode::AUTO && self.mission.returns {
            mode::AUTO_RTL
        } else {
            self.mode.number
        }
    }

    /// Stops on the way, or goes on. Only a way to a place can be interrupted.
    pub(super) fn pause_mission(&mut self, pause: bool) -> bool {
        let Task::Route(route) = &mut self.task else {
            return !pause;
        };
        if pause && route.reached {
            return false;
        }
        route.paused = pause;
        self.mission.paused = pause;
        true
    }

    fn item(&self, at: u16) -> Option<Item> {
        self.plans.mission.get(usize::from(at)).copied()
    }

    fn start_or_resume(&mut self) {
        let resumes = std::mem::take(&mut self.mission.resumes);
        if self.tuning.auto.restarts && !resumes {
            self.start_from_first();
        } else {
            self.resume_mission();
        }
    }

    fn start_from_first(&mut self) {
        let may_lift = self.mission.may_lift;
        self.mission.reset();
        self.mission.may_lift = may_lift;
        self.mission.state = State::Running;
        if !self.advance_to(FIRST) {
            self.complete_mission();
        }
    }

    fn resume_mission(&mut self) {
        let at = self.mission.nav.filter(|&at| self.item(at).is_some());
        let Some(at) = at.filter(|_| self.mission.state != State::Complete) else {
            self.start_from_first();
            return;
        };
        self.mission.state = State::Running;
        let action = self.mission.action;
        match action.at {
            Some(action) if self.mission.action.loaded => self.set_mission_item(action),
            _ => self.mission.nav_loaded && self.set_mission_item(at),
        };
    }

    /// Finds the navigation command of a mission that does not run, and the action before it.
    fn prepare(&mut self, from: u16) -> bool {
        let mut at = from;
        for _ in 0..ITEMS_PER_STEP {
            let Some(found) = self.next_counted(at) else {
                break;
            };
            let navigates = self
                .item(found)
                .is_some_and(|item| sequence::is_navigation(item.command));
            if navigates {
                self.mission.nav = Some(found);
                self.mission.nav_loaded = true;
                self.mission.action.all_done = !self.mission.action.loaded;
                self.mission.state = State::Stopped;
                return true;
            }
            if !self.mission.action.loaded {
                self.mission.action.at = Some(found);
                self.mission.action.loaded = true;
            }
            at = found + 1;
        }
        self.mission.nav = None;
        false
    }

    fn update_mission(&mut self) {
        match self.mission.nav.filter(|_| self.mission.nav_loaded) {
            None => {
                let next = self.mission.nav.map_or(FIRST, |at| at.saturating_add(1));
                if !self.advance_to(next) {
                    self.complete_mission();
                    return;
                }
            }
            Some(at) if self.navigation_is_over(at) => {
                self.mission.nav_loaded = false;
                if !self.advance_to(at.saturating_add(1)) {
                    self.complete_mission();
                    return;
                }
            }
            Some(_) => {}
        }
        match self
            .mission
            .action
            .at
            .filter(|_| self.mission.action.loaded)
        {
            None => self.advance_action(),
            Some(at) => {
                if self.action_is_over(at) {
                    self.mission.action.loaded = false;
                }
            }
        }
    }

    /// Starts the first navigation command at or after an item, and the first action on the way there.
    fn advance_to(&mut self, from: u16) -> bool {
        self.mission.action = Action::default();
        let mut at = from;
        for _ in 0..ITEMS_PER_STEP {
            let Some(found) = self.next_counted(at) else {
                return false;
            };
            let navigates = self
                .item(found)
                .is_some_and(|item| sequence::is_navigation(item.command));
            if navigates {
                self.mission.nav = Some(found);
                if self.start_navigation(found) {
                    self.mission.nav_loaded = true;
                    self.mission.action.all_done = !self.mission.action.loaded;
                    return true;
                }
            } else if !self.mission.action.loaded {
                self.load_action(found);
            }
            at = found + 1;
        }
        false
    }

    fn advance_action(&mut self) {
        if self.mission.action.all_done {
            return;
        }
        let from = self.mission.action.at.map_or(FIRST, |at| at + 1);
        let items = &self.plans.mission;
        let next = sequence::next_ahead(items, from, &self.mission.jumps).filter(|&at| {
            items
                .get(usize::from(at))
                .is_some_and(|item| !sequence::is_navigation(item.command))
        });
        match next {
            Some(at) => self.load_action(at),
            None => self.mission.action.all_done = true,
        }
    }

    fn load_action(&mut self, at: u16) {
        self.mission.action.at = Some(at);
        self.mission.action.loaded = true;
        self.mission.action.since = self.uptime();
        self.start_action(at);
    }

    fn next_counted(&mut self, from: u16) -> Option<u16> {
        let mut texts = Vec::new();
        let items = &self.plans.mission;
        let found = sequence::next_counting(items, from, &mut self.mission.jumps, &mut texts);
        for text in texts {
            self.say(MavSeverity::MAV_SEVERITY_INFO, &text);
        }
        found
    }

    /// The end of the mission: hover in the air, disarm on the ground.
    fn complete_mission(&mut self) {
        self.mission.state = State::Complete;
        self.mission.wait = Wait::Nothing;
        if self.safety.landed || self.landing_is_over() {
            self.disarm();
        } else {
            let route = self.with_cockpit(|_, cockpit| Route::standing(cockpit));
            self.task = Task::Route(Box::new(route));
            self.yaw.settle(self.body.yaw_deg);
        }
    }
}
