//! Changing the mode.

use std::time::Duration;

use glam::DVec2;
use mavlink::dialects::ardupilotmega::{MavMessage, MavSeverity};

use super::autopilot::{Autopilot, Speeds};
use super::mode::{self, Entry, Mode};
use super::task::{Attitude, Landing, Lift, Pilot, Returning, Task};
use super::telemetry;
use super::yaw::YawDemand;

impl Autopilot {
    /// Enters a mode, or says why not. Entering the present mode changes nothing.
    pub(super) fn set_mode(&mut self, number: u8) -> bool {
        let Some(mode) = Mode::numbered(number) else {
            self.say(
                MavSeverity::MAV_SEVERITY_WARNING,
                &format!("No such mode {number}"),
            );
            return false;
        };
        if number == mode::AUTO_RTL && self.landing_start().is_some() {
            return self.fly_landing_sequence();
        }
        if mode == self.mode {
            return true;
        }
        let texts: &[&str] = match mode.entry {
            Entry::Refused(texts) => texts,
            Entry::Plan if self.mission_refuses() => return false,
            Entry::Position if self.safety.armed && !self.is_ready() => {
                self.say(
                    MavSeverity::MAV_SEVERITY_WARNING,
                    &format!("Mode change to {} failed: requires position", mode.name),
                );
                return false;
            }
            Entry::Position if mode.number == mode::SMART_RTL && !self.trail.is_active() => {
                &["Mode change to SMARTRTL failed: init failed"]
            }
            Entry::Free | Entry::Position | Entry::Plan => &[],
        };
        if !texts.is_empty() {
            for text in texts {
                self.say(MavSeverity::MAV_SEVERITY_WARNING, text);
            }
            return false;
        }
        self.enter(mode);
        true
    }

    /// Ends the BRAKE of the pause button.
    pub(super) fn watch_brake(&mut self) {
        let now = self.uptime();
        if self.brake_until.is_some_and(|until| now >= until) {
            self.brake_until = None;
            if self.mode.number == mode::BRAKE && !self.set_mode(mode::LOITER) {
                self.set_mode(mode::ALT_HOLD);
            }
        }
    }

    fn enter(&mut self, mode: Mode) {
        if self.mode.number == mode::AUTO {
            self.leave_mission();
        }
        self.mode = mode;
        self.speeds = Speeds::default();
        self.paused = None;
        self.control.take_over(self.estimator.belief(&self.body));
        self.yaw.settle(self.body.yaw_deg);
        self.pilot = Pilot::begin(mode.number, self.body.lean_m_s2);
        self.task = self.first_task();
        match mode.number {
            mode::AUTO => self.enter_mission(),
            mode::RTL => self.yaw.demand = self.default_yaw_home(),
            _ => {}
        }
        // The heartbeat overtakes the texts that wait to be sent.
        let before_texts = self
            .outbox
            .iter()
            .position(|message| matches!(message, MavMessage::STATUSTEXT(_)))
            .unwrap_or(self.outbox.len());
        if let Some(heartbeat) = telemetry::message(0, self) {
            self.outbox.insert(before_texts, heartbeat);
        }
        self.fence.mode_changed(self.uptime());
    }

    /// At the end of the initialisation the first mode is entered, whatever was asked before.
    pub(super) fn go_back_to_first_mode(&mut self) {
        if self.mode != Mode::BOOT {
            self.mode = Mode::BOOT;
            self.task = self.first_task();
        }
    }

    fn first_task(&mut self) -> Task {
        let flying = self.safety.armed && !self.body.on_ground;
        match self.mode.number {
            mode::STABILIZE | mode::ACRO | mode::DRIFT => Task::Manual,
            mode::LAND => Task::Land(Landing::default()),
            mode::RTL => Task::Return(self.with_cockpit(|_, cockpit| Returning::new(cockpit))),
            mode::SMART_RTL => {
                Task::Return(self.with_cockpit(|_, cockpit| Returning::retracing(cockpit)))
            }
            mode::GUIDED | mode::GUIDED_NOGPS | mode::BRAKE | mode::CIRCLE | mode::AUTO
                if !flying =>
            {
                Task::Wait
            }
            mode::GUIDED | mode::AUTO => Task::STOP,
            mode::GUIDED_NOGPS => Task::Attitude(Attitude {
                lean_rad: DVec2::ZERO,
                rates_rad_s: DVec2::ZERO,
                lift: Lift::Climb(0.0),
                until: Duration::ZERO,
            }),
            mode::BRAKE => Task::Brake,
            mode::CIRCLE => {
                let circle = Task::circle(self.believed(), &self.tuning.flight);
                if let Task::Circle(circle) = &circle {
                    self.yaw.demand = YawDemand::Towards(circle.centre_m);
                }
                circle
            }
            _ => Task::Piloted,
        }
    }
}
