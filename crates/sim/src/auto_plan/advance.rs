//! Advancing through the list: the next command, and the end of the mission.

use mavlink::dialects::ardupilotmega::MavSeverity;

use super::{AutoPlan, FIRST, PlanAction, PlanState, PlanWait, sequence};
use crate::kind::VehicleKind;
use crate::task::{Route, Task};
use crate::vehicle::Vehicle;

/// The maximum number of items searched for a navigation command in one step.
const ITEMS_PER_STEP: usize = 255;

impl AutoPlan {
    /// Starts the mission, or resumes it, according to `MIS_RESTART`.
    pub(super) fn start_or_resume(&mut self, vehicle: &mut Vehicle) {
        let resumes = std::mem::take(&mut self.resumes);
        if vehicle.tuning.flight.auto.restarts && !resumes {
            self.start_from_first(vehicle);
        } else {
            self.resume(vehicle);
        }
    }

    fn start_from_first(&mut self, vehicle: &mut Vehicle) {
        let may_lift = self.may_lift;
        self.reset();
        self.may_lift = may_lift;
        self.state = PlanState::Running;
        if !self.advance_to(vehicle, FIRST) {
            self.complete(vehicle);
        }
    }

    /// Resumes at the current item: its action or navigation command begins again. A mission that is complete or has
    /// no current item starts from the first one.
    pub(super) fn resume(&mut self, vehicle: &mut Vehicle) {
        let at = self.nav.filter(|&at| vehicle.plans.item(at).is_some());
        let Some(at) = at.filter(|_| self.state != PlanState::Complete) else {
            self.start_from_first(vehicle);
            return;
        };
        self.state = PlanState::Running;
        let action = self.action;
        match action.at {
            Some(action) if self.action.loaded => self.set_item(vehicle, action),
            _ => self.nav_loaded && self.set_item(vehicle, at),
        };
    }

    /// Finds the navigation command of a stopped mission, and the action before it.
    pub(super) fn prepare(&mut self, vehicle: &mut Vehicle, from: u16) -> bool {
        let mut at = from;
        for _ in 0..ITEMS_PER_STEP {
            let Some(found) = self.next_counted(vehicle, at) else {
                break;
            };
            let navigates = vehicle
                .plans
                .item(found)
                .is_some_and(|item| sequence::is_navigation(item.command));
            if navigates {
                self.nav = Some(found);
                self.nav_loaded = true;
                self.action.all_done = !self.action.loaded;
                self.state = PlanState::Stopped;
                return true;
            }
            if !self.action.loaded {
                self.action.at = Some(found);
                self.action.loaded = true;
            }
            at = found + 1;
        }
        self.nav = None;
        false
    }

    /// One step of a running mission: finished commands are followed by the next ones.
    pub(super) fn update(&mut self, vehicle: &mut Vehicle) {
        match self.nav.filter(|_| self.nav_loaded) {
            None => {
                let next = self.nav.map_or(FIRST, |at| at.saturating_add(1));
                if !self.advance_to(vehicle, next) {
                    self.complete(vehicle);
                    return;
                }
            }
            Some(at) if self.navigation_is_over(vehicle, at) => {
                self.nav_loaded = false;
                if !self.advance_to(vehicle, at.saturating_add(1)) {
                    self.complete(vehicle);
                    return;
                }
            }
            Some(_) => {}
        }
        match self.action.at.filter(|_| self.action.loaded) {
            None => self.advance_action(vehicle),
            Some(at) => {
                if self.action_is_over(vehicle, at) {
                    self.action.loaded = false;
                }
            }
        }
    }

    /// Starts the first navigation command at or after an item, and the first action on the way there.
    pub(super) fn advance_to(&mut self, vehicle: &mut Vehicle, from: u16) -> bool {
        self.action = PlanAction::default();
        let mut at = from;
        for _ in 0..ITEMS_PER_STEP {
            let Some(found) = self.next_counted(vehicle, at) else {
                return false;
            };
            let navigates = vehicle
                .plans
                .item(found)
                .is_some_and(|item| sequence::is_navigation(item.command));
            if navigates {
                self.nav = Some(found);
                if self.start_navigation(vehicle, found) {
                    self.nav_loaded = true;
                    self.action.all_done = !self.action.loaded;
                    return true;
                }
            } else if !self.action.loaded {
                self.load_action(vehicle, found);
            }
            at = found + 1;
        }
        false
    }

    fn advance_action(&mut self, vehicle: &mut Vehicle) {
        if self.action.all_done {
            return;
        }
        let from = self.action.at.map_or(FIRST, |at| at + 1);
        let items = &vehicle.plans.mission;
        let next = sequence::next_ahead(items, from, &self.jumps).filter(|&at| {
            items
                .get(usize::from(at))
                .is_some_and(|item| !sequence::is_navigation(item.command))
        });
        match next {
            Some(at) => self.load_action(vehicle, at),
            None => self.action.all_done = true,
        }
    }

    fn load_action(&mut self, vehicle: &mut Vehicle, at: u16) {
        self.action.at = Some(at);
        self.action.loaded = true;
        self.action.since = vehicle.uptime();
        self.start_action(vehicle, at);
    }

    fn next_counted(&mut self, vehicle: &mut Vehicle, from: u16) -> Option<u16> {
        let mut texts = Vec::new();
        let items = &vehicle.plans.mission;
        let found = sequence::next_counting(items, from, &mut self.jumps, &mut texts);
        for text in texts {
            vehicle.say(MavSeverity::MAV_SEVERITY_INFO, &text);
        }
        found
    }

    /// The end of the mission: hover in the air, disarm on the ground.
    pub(super) fn complete(&mut self, vehicle: &mut Vehicle) {
        self.state = PlanState::Complete;
        self.wait = PlanWait::Nothing;
        if vehicle.kind != VehicleKind::Copter {
            self.park(vehicle);
        } else if vehicle.safety.landed || vehicle.landing_is_over() {
            self.disarm(vehicle);
        } else {
            let route = vehicle.with_cockpit(|_, cockpit| Route::standing(cockpit));
            vehicle.flight.task = Task::Route(Box::new(route));
            vehicle.flight.yaw.settle(vehicle.plant.body.yaw_deg);
        }
    }
}
