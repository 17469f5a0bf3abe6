//! The autopilot of a rover: its modes, its steps on the ground, and its reactions.

use glam::DVec3;
use mavlink::dialects::ardupilotmega::{MISSION_ITEM_REACHED_DATA, MavMessage, MavSeverity};

use super::Autopilot;
use crate::arming::ArmingMethod;
use crate::mode::rover::REFUSAL;
use crate::mode::{Mode, ModeEntry, ModeId};
use crate::output_test::{OutputTest, SUSPENDED, TestRequest};
use crate::reaction::FailsafeAction;
use crate::task::{Drive, DriveNews, Loiter, Task, on_surface};

impl Autopilot {
    /// Whether a rover refuses a mode now; reports the reason.
    pub(super) fn refuses_to_drive(&mut self, mode: &Mode) -> bool {
        let vehicle = &mut self.vehicle;
        let has_mission = vehicle.plans.mission.len() > 1;
        if mode.id == ModeId::Auto && !has_mission {
            let text = "No Mission. Can't set AUTO.";
            vehicle.say(MavSeverity::MAV_SEVERITY_NOTICE, text);
        }
        let is_trusted = !self.failsafe.falls_back() && !self.failsafe.distrusts_estimate();
        let is_known = vehicle.is_ready() && is_trusted;
        let is_lost = mode.needs_position() && vehicle.safety.armed && !is_known;
        let refuses = is_lost
            || match mode.id {
                ModeId::Follow => vehicle.tuning.flight.follow.is_none(),
                ModeId::Auto => !has_mission,
                ModeId::Rtl => vehicle.datum.home().is_none(),
                ModeId::SmartRtl => !vehicle.flight.trail.is_active(),
                _ => false,
            };
        let reasons = match mode.entry {
            ModeEntry::Refused(reasons) => Some(reasons),
            _ => None,
        };
        for reason in reasons.into_iter().flatten() {
            vehicle.say(MavSeverity::MAV_SEVERITY_NOTICE, reason);
        }
        let refuses = refuses || reasons.is_some();
        if refuses {
            vehicle.say(MavSeverity::MAV_SEVERITY_WARNING, REFUSAL);
        }
        refuses
    }

    /// The task of the mode.
    pub(super) fn first_drive(&mut self) -> Task {
        let mode = self.vehicle.flight.mode.id;
        if mode == ModeId::Circle {
            self.vehicle.warn_of_the_circle();
        }
        Task::Drive(self.vehicle.with_cockpit(|_, cockpit| {
            let Some(rules) = cockpit.tuning.helm.as_deref() else {
                return Drive::Hold;
            };
            match mode {
                ModeId::Manual => Drive::Manual,
                ModeId::Acro => Drive::Acro,
                ModeId::Steering => Drive::Steering,
                ModeId::Simple => Drive::Simple {
                    ahead_deg: cockpit.body.yaw_deg,
                },
                ModeId::Guided | ModeId::Auto => Drive::rest(cockpit, rules),
                ModeId::Loiter => Drive::Loiter(Loiter::here(cockpit, rules)),
                ModeId::Rtl => Drive::home(cockpit, rules),
                ModeId::SmartRtl => Drive::retracing(cockpit, rules),
                ModeId::Circle => Drive::circle(cockpit, rules),
                ModeId::Follow => Drive::Follow(rules.speed_max_m_s),
                _ => Drive::Hold,
            }
        }))
    }

    /// Drives for one step, and reports what happened.
    pub(super) fn drive(&mut self) {
        let vehicle = &mut self.vehicle;
        vehicle.keep_offset();
        match vehicle.drive(self.workbench.output_test.as_ref()) {
            Some(DriveNews::Reached) => {
                let reached = MISSION_ITEM_REACHED_DATA { seq: 0 };
                vehicle
                    .outbox
                    .push(MavMessage::MISSION_ITEM_REACHED(reached));
            }
            Some(DriveNews::Say(severity, text)) => vehicle.say(severity, text),
            None => {}
        }
        self.watch_output_test();
    }

    /// Begins a motor test, or goes on with another one; returns whether it was possible.
    pub(crate) fn test_output(&mut self, request: TestRequest) -> bool {
        let now = self.vehicle.uptime();
        if let Some(test) = &mut self.workbench.output_test {
            test.replace(request, now);
            return true;
        }
        if let Some(text) = self.output_test_obstacle(&request) {
            self.vehicle.say(MavSeverity::MAV_SEVERITY_CRITICAL, &text);
            return false;
        }
        if !self.arm(ArmingMethod::Command) {
            return false;
        }
        let parameters = &mut self.vehicle.parameters;
        let suspended = SUSPENDED.map(|name| {
            let before = parameters.value(name) as f32;
            parameters.set(name, 0.0);
            before
        });
        self.vehicle.retune();
        self.workbench.output_test = Some(OutputTest::new(request, now, suspended));
        true
    }

    fn output_test_obstacle(&self, request: &TestRequest) -> Option<String> {
        if self.vehicle.boot.is_initialising() {
            Some("Motor Test: Board initialising".to_owned())
        } else if request.needs_radio() && !self.arming_checks().radio_is_calibrated() {
            Some("Motor Test: RC not calibrated".to_owned())
        } else if self.workbench.safety_on {
            Some("Motor Test: Safety switch".to_owned())
        } else {
            request.fault()
        }
    }

    /// Ends a motor test whose time is over: the vehicle disarms, and the failsafes are as before.
    fn watch_output_test(&mut self) {
        let now = self.vehicle.uptime();
        let Some(test) = self.workbench.output_test.take_if(|it| it.is_over(now)) else {
            return;
        };
        self.disarm();
        self.resume_failsafes(&test);
        self.vehicle.retune();
    }

    /// Sets the failsafes that a motor test has switched off as they were.
    pub(super) fn resume_failsafes(&mut self, test: &OutputTest) {
        for (name, before) in SUSPENDED.iter().zip(test.suspended) {
            self.vehicle.parameters.set(name, before);
        }
    }

    /// Carries out the action of a failsafe or of the fence: a mode that cannot be entered is followed by a simpler one.
    pub(super) fn act_on_the_ground(&mut self, action: FailsafeAction) {
        let modes: &[ModeId] = match action {
            FailsafeAction::Return => &[ModeId::Rtl, ModeId::Hold],
            FailsafeAction::PathBackOrReturn => &[ModeId::SmartRtl, ModeId::Rtl, ModeId::Hold],
            FailsafeAction::PathBackOrHold => &[ModeId::SmartRtl, ModeId::Hold],
            FailsafeAction::Hold => &[ModeId::Hold],
            FailsafeAction::Terminate => {
                self.disarm();
                &[]
            }
            _ => &[],
        };
        modes.iter().any(|&mode| self.set_mode(mode));
    }

    /// Drives to a place in GUIDED.
    pub(crate) fn drive_to(&mut self, goal_m: DVec3) {
        let goal_m = on_surface(goal_m);
        self.vehicle
            .with_cockpit(|task, cockpit| *task = task.drive_to(goal_m, cockpit));
    }
}
