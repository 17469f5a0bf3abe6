//! Moving on through the list: which command is started next, and when the mission is over.

use mavlink::dialects::ardupilotmega::MavSeverity;

use super::{Action, FIRST, State, Wait, sequence};
use crate::autopilot::Autopilot;
use crate::task::{Route, Task};

/// How many items a navigation command may be searched over in one step.
const ITEMS_PER_STEP: usize = 255;

impl Autopilot {
    /// Starts the mission, or goes on where it stands, as `MIS_RESTART` says.
    pub(super) fn start_or_resume(&mut self) {
        let resumes = std::mem::take(&mut self.mission.resumes);
        if self.tuning.flight.auto.restarts && !resumes {
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

    /// Goes on where the mission stands: the action or the navigation command there begins again. A mission that is
    /// complete or stands nowhere starts from the first item.
    pub(super) fn resume_mission(&mut self) {
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
    pub(super) fn prepare(&mut self, from: u16) -> bool {
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

    /// One step of a running mission: what is over is followed by what comes next.
    pub(super) fn update_mission(&mut self) {
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
    pub(super) fn advance_to(&mut self, from: u16) -> bool {
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
    pub(super) fn complete_mission(&mut self) {
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
