//! Changing the mode.

use std::time::Duration;

use glam::DVec2;
use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{HEARTBEAT_DATA, MavMessage, MavSeverity};

use super::{Autopilot, telemetry};
use crate::estimator::RadioFault;
use crate::mode::{self, Mode, ModeEntry};
use crate::task::{Attitude, Landing, Lift, Pilot, Returning, Task};
use crate::vehicle::AskedSpeeds;
use crate::yaw::YawDemand;

impl Autopilot {
    /// Enters a mode, or reports why not; returns whether the vehicle is in the mode. Entering the
    /// current mode changes nothing.
    pub(crate) fn set_mode(&mut self, number: u8) -> bool {
        let Some(mode) = Mode::numbered(number) else {
            self.vehicle.say(
                MavSeverity::MAV_SEVERITY_WARNING,
                &format!("No such mode {number}"),
            );
            return false;
        };
        if number == mode::AUTO_RTL && (self.fly_return_path() || self.fly_landing_sequence()) {
            return true;
        }
        if mode == self.vehicle.flight.mode {
            return true;
        }
        let texts: &[&str] = match mode.entry {
            ModeEntry::Refused(texts) => texts,
            ModeEntry::Plan if self.auto_plan.refuses(&mut self.vehicle) => return false,
            ModeEntry::Position if self.vehicle.safety.armed && !self.vehicle.is_ready() => {
                self.vehicle.say(
                    MavSeverity::MAV_SEVERITY_WARNING,
                    &format!("Mode change to {} failed: requires position", mode.name),
                );
                return false;
            }
            ModeEntry::Position
                if mode.number == mode::SMART_RTL && !self.vehicle.flight.trail.is_active() =>
            {
                &["Mode change to SMARTRTL failed: init failed"]
            }
            ModeEntry::Free | ModeEntry::Position | ModeEntry::Plan => &[],
        };
        if !texts.is_empty() {
            for text in texts {
                self.vehicle.say(MavSeverity::MAV_SEVERITY_WARNING, text);
            }
            return false;
        }
        self.enter(mode);
        true
    }

    /// Enters LOITER, or else `ALT_HOLD`, when the time of the pause button's BRAKE is up.
    pub(super) fn watch_brake(&mut self) {
        let now = self.vehicle.uptime();
        if self
            .vehicle
            .flight
            .brake_until
            .is_some_and(|until| now >= until)
        {
            self.vehicle.flight.brake_until = None;
            if self.vehicle.flight.mode.number == mode::BRAKE && !self.set_mode(mode::LOITER) {
                self.set_mode(mode::ALT_HOLD);
            }
        }
    }

    fn enter(&mut self, mode: Mode) {
        if self.vehicle.flight.mode.number == mode::AUTO {
            self.auto_plan.leave();
        }
        self.vehicle.flight.mode = mode;
        self.vehicle.flight.speeds = AskedSpeeds::default();
        self.vehicle.flight.paused = None;
        self.vehicle
            .flight
            .control
            .take_over(self.vehicle.estimator.belief(&self.vehicle.plant.body));
        self.vehicle
            .flight
            .yaw
            .settle(self.vehicle.plant.body.yaw_deg);
        self.vehicle.flight.pilot = Pilot::begin(mode.number, self.vehicle.plant.body.lean_m_s2);
        self.vehicle.flight.task = self.first_task();
        match mode.number {
            mode::AUTO => self.auto_plan.enter(),
            mode::RTL => self.vehicle.flight.yaw.demand = self.vehicle.default_yaw_home(),
            _ => {}
        }
        // The heartbeat precedes waiting texts.
        let before_texts = self
            .vehicle
            .outbox
            .iter()
            .position(|message| matches!(message, MavMessage::STATUSTEXT(_)))
            .unwrap_or(self.vehicle.outbox.len());
        if let Some(heartbeat) = telemetry::message(HEARTBEAT_DATA::ID, self) {
            self.vehicle.outbox.insert(before_texts, heartbeat);
        }
        self.vehicle.fence.mode_changed(self.vehicle.uptime());
    }

    /// Enters the first mode: that of the mode switch or, without a remote control, that of
    /// `INITIAL_MODE`; STABILIZE if that mode is always refused.
    pub(super) fn begin_first_mode(&mut self) {
        let vehicle = &mut self.vehicle;
        if vehicle.tuning.faults.radio != RadioFault::Silent {
            vehicle.radio.read_first(&vehicle.tuning.flight.radio);
        }
        self.go_back_to_first_mode();
    }

    /// At the end of the initialisation, enters the first mode, whatever was requested before.
    pub(super) fn go_back_to_first_mode(&mut self) {
        let switch = self.vehicle.radio.mode_parameter();
        let name = switch.as_deref().unwrap_or("INITIAL_MODE");
        let number = self.vehicle.parameters.value(name) as u8;
        let first = Mode::numbered(number)
            .filter(|mode| !matches!(mode.entry, ModeEntry::Refused(_)))
            .unwrap_or(Mode::BOOT);
        if self.vehicle.flight.mode != first {
            self.vehicle.flight.mode = first;
            self.vehicle.flight.pilot = Pilot::begin(first.number, DVec2::ZERO);
            self.vehicle.flight.task = self.first_task();
            if first.number == mode::AUTO {
                self.auto_plan.enter();
            }
        }
    }

    fn first_task(&mut self) -> Task {
        let flying = self.vehicle.safety.armed && !self.vehicle.plant.body.on_ground;
        match self.vehicle.flight.mode.number {
            mode::STABILIZE | mode::ACRO | mode::DRIFT => Task::Manual,
            mode::LAND => Task::Land(Landing::default()),
            mode::RTL => Task::Return(
                self.vehicle
                    .with_cockpit(|_, cockpit| Returning::new(cockpit)),
            ),
            mode::SMART_RTL => Task::Return(
                self.vehicle
                    .with_cockpit(|_, cockpit| Returning::retracing(cockpit)),
            ),
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
                let circle = Task::circle(self.vehicle.believed(), &self.vehicle.tuning.flight);
                if let Task::Circle(circle) = &circle {
                    self.vehicle.flight.yaw.demand = YawDemand::Towards(circle.centre_m);
                }
                circle
            }
            _ => Task::Piloted,
        }
    }

    /// `MISSION_START`: enters AUTO and allows the takeoff; `false` if AUTO is refused. A landed
    /// vehicle without a mission enters LAND.
    pub(crate) fn start_mission(&mut self) -> bool {
        if !self.set_mode(mode::AUTO) {
            return false;
        }
        self.auto_plan.allow_lifting();
        if self.vehicle.plans.mission.len() < 2 && self.vehicle.safety.landed {
            return self.set_mode(mode::LAND);
        }
        self.auto_plan.start_unless_running(&mut self.vehicle);
        true
    }

    /// Continues at the nearest leg after a `DO_RETURN_PATH_START`, in a mode reported as AUTO RTL; `false` if there is
    /// none.
    pub(crate) fn fly_return_path(&mut self) -> bool {
        let leg = self.auto_plan.return_path(&self.vehicle);
        leg.is_some_and(|at| self.rejoin(at, "Return path started"))
    }

    /// Continues at the nearest `DO_LAND_START`, in a mode reported as AUTO RTL; `false` if there is none.
    pub(crate) fn fly_landing_sequence(&mut self) -> bool {
        let start = self.auto_plan.landing_start(&self.vehicle);
        start.is_some_and(|at| self.rejoin(at, "Landing sequence start"))
    }

    fn rejoin(&mut self, at: u16, text: &str) -> bool {
        if !self.auto_plan.set_item(&mut self.vehicle, at) {
            return false;
        }
        self.vehicle.say(MavSeverity::MAV_SEVERITY_INFO, text);
        self.auto_plan.go_on(&mut self.vehicle);
        let returns = self.set_mode(mode::AUTO);
        self.auto_plan.set_returning(returns);
        returns
    }

    /// Interrupts the flight in AUTO or GUIDED, or continues it; `false` if that is not possible
    /// now.
    pub(crate) fn pause(&mut self, pause: bool) -> bool {
        let flight = &mut self.vehicle.flight;
        if flight.mode.number == mode::AUTO {
            return self.auto_plan.pause(&mut self.vehicle, pause);
        }
        if !mode::is_guided(flight.mode.number) {
            return false;
        }
        if self.vehicle.safety.landed {
            return true;
        }
        if !pause {
            if let Some(task) = flight.paused.take() {
                flight.task = task;
            }
        } else if flight.paused.is_none() {
            flight.paused = Some(std::mem::replace(&mut flight.task, Task::STOP));
        }
        true
    }

    /// The mode in telemetry: AUTO during a landing sequence has its own number.
    pub(crate) fn reported_mode(&self) -> u8 {
        if self.vehicle.flight.mode.number == mode::AUTO && self.auto_plan.is_returning() {
            mode::AUTO_RTL
        } else {
            self.vehicle.flight.mode.number
        }
    }

    /// Enters the mode of the switch's position (`FLTMODE1` to 6).
    pub(crate) fn obey_mode_switch(&mut self) {
        if let Some(name) = self.vehicle.radio.mode_parameter() {
            let number = self.vehicle.parameters.value(&name) as i32;
            let entered = self.set_mode(number as u8);
            if let Some(position) = self.vehicle.radio.mode_position().filter(|_| entered) {
                self.choose_simple(position);
            }
        }
    }
}
