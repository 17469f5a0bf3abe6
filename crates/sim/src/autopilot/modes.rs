//! Changing the mode.

use std::time::Duration;

use glam::DVec2;
use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{HEARTBEAT_DATA, MavMessage, MavSeverity};

use super::{Autopilot, telemetry};
use crate::estimator::RadioFault;
use crate::kind::VehicleKind;
use crate::mode::{self, Mode, ModeEntry, ModeId};
use crate::task::{Attitude, Landing, Lift, Pilot, Returning, Task};
use crate::vehicle::AskedSpeeds;
use crate::yaw::YawDemand;

impl Autopilot {
    /// Enters a mode, or reports why not; returns whether the vehicle is in the mode. Entering the
    /// current mode changes nothing.
    pub(crate) fn set_mode(&mut self, id: ModeId) -> bool {
        let mode = Mode::of(self.vehicle.kind, id);
        mode.is_some_and(|mode| self.change_mode(mode))
    }

    /// Like `set_mode`, for a number of the firmware; reports an unknown one.
    pub(crate) fn set_mode_numbered(&mut self, number: u8) -> bool {
        if let Some(mode) = Mode::numbered(self.vehicle.kind, number) {
            return self.change_mode(mode);
        }
        self.vehicle.say(
            MavSeverity::MAV_SEVERITY_WARNING,
            &format!("No such mode {number}"),
        );
        false
    }

    fn change_mode(&mut self, mode: Mode) -> bool {
        if mode.id == ModeId::AutoRtl && (self.fly_return_path() || self.fly_landing_sequence()) {
            return true;
        }
        if mode == self.vehicle.flight.mode {
            return true;
        }
        let refuses = match self.vehicle.kind {
            VehicleKind::Copter => self.refuses_to_fly(&mode),
            VehicleKind::Rover(_) => self.refuses_to_drive(&mode),
        };
        if !refuses {
            self.enter(mode);
        }
        !refuses
    }

    /// Whether a copter refuses a mode now; reports the reason.
    fn refuses_to_fly(&mut self, mode: &Mode) -> bool {
        let texts: &[&str] = match mode.entry {
            ModeEntry::Refused(texts) => texts,
            ModeEntry::Plan if self.auto_plan.refuses(&mut self.vehicle) => return true,
            ModeEntry::Position if self.vehicle.safety.armed && !self.vehicle.is_ready() => {
                self.vehicle.say(
                    MavSeverity::MAV_SEVERITY_WARNING,
                    &format!("Mode change to {} failed: requires position", mode.name),
                );
                return true;
            }
            ModeEntry::Position
                if mode.id == ModeId::SmartRtl && !self.vehicle.flight.trail.is_active() =>
            {
                &["Mode change to SMARTRTL failed: init failed"]
            }
            ModeEntry::Free | ModeEntry::Position | ModeEntry::Plan => &[],
        };
        for text in texts {
            self.vehicle.say(MavSeverity::MAV_SEVERITY_WARNING, text);
        }
        !texts.is_empty()
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
            if self.vehicle.flight.mode.id == ModeId::Brake && !self.set_mode(ModeId::Loiter) {
                self.set_mode(ModeId::AltHold);
            }
        }
    }

    fn enter(&mut self, mode: Mode) {
        if self.vehicle.flight.mode.id == ModeId::Auto {
            self.auto_plan.leave();
        }
        self.vehicle.flight.mode = mode;
        self.vehicle.flight.speeds = AskedSpeeds::default();
        self.vehicle.flight.paused = None;
        self.vehicle.flight.backs_up = false;
        self.vehicle
            .flight
            .control
            .take_over(self.vehicle.estimator.belief(&self.vehicle.plant.body));
        self.vehicle
            .flight
            .yaw
            .settle(self.vehicle.plant.body.yaw_deg);
        self.vehicle.flight.pilot = Pilot::begin(mode.id, self.vehicle.plant.body.lean_m_s2);
        self.vehicle.flight.task = self.first_task();
        match mode.id {
            ModeId::Auto => self.auto_plan.enter(),
            ModeId::Rtl => self.vehicle.flight.yaw.demand = self.vehicle.default_yaw_home(),
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
        let kind = self.vehicle.kind;
        let first = Mode::numbered(kind, number)
            .filter(|mode| !matches!(mode.entry, ModeEntry::Refused(_)))
            .unwrap_or_else(|| Mode::boot(kind));
        if self.vehicle.flight.mode != first {
            self.vehicle.flight.mode = first;
            self.vehicle.flight.pilot = Pilot::begin(first.id, DVec2::ZERO);
            self.vehicle.flight.task = self.first_task();
            if first.id == ModeId::Auto {
                self.auto_plan.enter();
            }
        }
    }

    fn first_task(&mut self) -> Task {
        if self.vehicle.flight.helm.is_some() {
            return self.first_drive();
        }
        let flying = self.vehicle.safety.armed && !self.vehicle.plant.body.on_ground;
        match self.vehicle.flight.mode.id {
            ModeId::Stabilize | ModeId::Acro | ModeId::Drift => Task::Manual,
            ModeId::Land => Task::Land(Landing::default()),
            ModeId::Rtl => Task::Return(
                self.vehicle
                    .with_cockpit(|_, cockpit| Returning::new(cockpit)),
            ),
            ModeId::SmartRtl => Task::Return(
                self.vehicle
                    .with_cockpit(|_, cockpit| Returning::retracing(cockpit)),
            ),
            ModeId::Guided
            | ModeId::GuidedNoGps
            | ModeId::Brake
            | ModeId::Circle
            | ModeId::Auto
                if !flying =>
            {
                Task::Wait
            }
            ModeId::Guided | ModeId::Auto => Task::STOP,
            ModeId::GuidedNoGps => Task::Attitude(Attitude {
                lean_rad: DVec2::ZERO,
                rates_rad_s: DVec2::ZERO,
                lift: Lift::Climb(0.0),
                until: Duration::ZERO,
            }),
            ModeId::Brake => Task::Brake,
            ModeId::Circle => {
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
        if !self.set_mode(ModeId::Auto) {
            return false;
        }
        self.auto_plan.allow_lifting();
        if self.vehicle.plans.mission.len() < 2 && self.vehicle.safety.landed {
            return self.set_mode(ModeId::Land);
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
        let returns = self.set_mode(ModeId::Auto);
        self.auto_plan.set_returning(returns);
        returns
    }

    /// Interrupts the flight in AUTO or GUIDED, or continues it; `false` if that is not possible
    /// now.
    pub(crate) fn pause(&mut self, pause: bool) -> bool {
        let flight = &mut self.vehicle.flight;
        if flight.mode.id == ModeId::Auto {
            return self.auto_plan.pause(&mut self.vehicle, pause);
        }
        if !mode::is_guided(flight.mode.id) {
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
        if self.vehicle.flight.mode.id == ModeId::Auto && self.auto_plan.is_returning() {
            mode::AUTO_RTL
        } else {
            self.vehicle.flight.mode.number
        }
    }

    /// Enters the mode of the switch's position (`FLTMODE1` to 6).
    pub(crate) fn obey_mode_switch(&mut self) {
        if let Some(name) = self.vehicle.radio.mode_parameter() {
            let number = self.vehicle.parameters.value(&name) as i32;
            let entered = self.set_mode_numbered(number as u8);
            if let Some(position) = self.vehicle.radio.mode_position().filter(|_| entered) {
                self.choose_simple(position);
            }
        }
    }
}
