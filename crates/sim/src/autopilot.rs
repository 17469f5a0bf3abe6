//! The autopilot of one vehicle: its parts, and their order in a step. A part owns its state; it gets other parts'
//! state as arguments, and returns its requests.

mod arming;
pub(super) mod auxiliary;
mod driving;
mod modes;
mod reactions;
pub(super) mod telemetry;

use std::sync::Arc;
use std::time::Duration;

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{HEARTBEAT_DATA, MavMessage, MavSeverity, TIMESYNC_DATA};

use super::Start;
use super::airframe::Airframe;
use super::arming::{GroundInputs, ImuWatch};
use super::auto_plan::AutoPlan;
use super::boot::{Boot, BootEvent};
use super::counters::{CounterInputs, Counters};
use super::crash::{CrashInputs, CrashWatch};
use super::failsafe::{self, Failsafe};
use super::kind::VehicleKind;
use super::mode::ModeId;
use super::operator::OperatorControl;
use super::parameters::Parameters;
use super::plan::ListKind;
use super::vehicle::{Build, Vehicle};
use super::wind::Wind;
use super::workbench::Workbench;
use super::{adsb, fence, trail};

/// The delay between the acknowledgement of a reboot and the loss of the links.
const REBOOT_AFTER: Duration = Duration::from_millis(200);
/// The drop of the voltage of a rover's battery at full throttle.
const ROVER_SAG_V: f64 = 0.7;
const TIMESYNC_EVERY_STEPS: u64 = 1000;

/// The autopilot of one vehicle, together with that vehicle.
#[derive(Debug, Clone)]
pub(super) struct Autopilot {
    pub(super) vehicle: Vehicle,
    pub(super) auto_plan: AutoPlan,
    pub(super) failsafe: Failsafe,
    crash: CrashWatch,
    counters: Counters,
    imu_watch: ImuWatch,
    pub(super) workbench: Workbench,
    /// Which ground station is in control; `None` if every one may command the vehicle.
    pub(super) operator: Option<Box<OperatorControl>>,
    reboot_at: Option<Duration>,
}

impl Autopilot {
    /// A vehicle that has just been switched on.
    pub(super) fn new(
        kind: VehicleKind,
        system: u8,
        start: Start,
        airframe: Arc<Airframe>,
        mut wind: Wind,
    ) -> Self {
        let board_id = wind.board_id();
        let parameters = factory_parameters(kind, system, &airframe);
        let build = Build {
            kind,
            system,
            board_id,
            airframe,
            start,
        };
        let mut new = Self::booted(Vehicle::booted(build, parameters, wind));
        new.begin_first_mode();
        new
    }

    fn booted(vehicle: Vehicle) -> Self {
        Self {
            vehicle,
            auto_plan: AutoPlan::default(),
            failsafe: Failsafe::default(),
            crash: CrashWatch::default(),
            counters: Counters::default(),
            imu_watch: ImuWatch::default(),
            workbench: Workbench::default(),
            operator: None,
            reboot_at: None,
        }
    }

    /// The vehicle, and the state of all other parts.
    pub(super) fn state(&self) -> (&Vehicle, [&dyn std::fmt::Debug; 7]) {
        let Self {
            vehicle,
            auto_plan,
            failsafe,
            crash,
            counters,
            imu_watch,
            workbench,
            operator: _,
            reboot_at,
        } = self;
        let watches: [&dyn std::fmt::Debug; 7] = [
            auto_plan, failsafe, crash, counters, imu_watch, workbench, reboot_at,
        ];
        (vehicle, watches)
    }

    /// The vehicle with a realistic boot time.
    pub(super) fn booting_realistically(mut self) -> Self {
        self.vehicle.boot = Boot::new(self.vehicle.kind, true);
        self.vehicle.radio.forget_switches();
        self
    }

    /// The vehicle after its boot. What it said meanwhile has passed.
    pub(super) fn switched_on_long_ago(mut self) -> Self {
        while !self.vehicle.boot.is_over() {
            for event in self.vehicle.boot.step(false) {
                self.pass(event);
            }
        }
        self.vehicle.outbox.clear();
        self
    }

    /// Schedules a reboot; [`Autopilot::take_reboot`] performs it when due.
    pub(super) fn schedule_reboot(&mut self) {
        let at = self.vehicle.uptime() + REBOOT_AFTER;
        self.reboot_at.get_or_insert(at);
    }

    /// Performs a reboot that is due, and returns whether one was: as when SITL starts again, the
    /// vehicle is back at its start. Parameters, lists and logs survive.
    pub(super) fn take_reboot(&mut self) -> bool {
        let is_due = self.reboot_at.is_some_and(|at| self.vehicle.uptime() >= at);
        if is_due {
            self.reboot();
        }
        is_due
    }

    fn reboot(&mut self) {
        if let Some(test) = self.workbench.output_test.take() {
            self.resume_failsafes(&test);
        }
        let before = &mut self.vehicle;
        let mut parameters = if self.workbench.erased {
            factory_parameters(before.kind, before.system, &before.plant.airframe)
        } else {
            before.parameters.clone().rebooted()
        };
        let boots = parameters.value("STAT_BOOTCNT") as f32 + 1.0;
        parameters.set("STAT_BOOTCNT", boots);
        let build = Build {
            kind: before.kind,
            system: before.parameters.value("SYSID_THISMAV").clamp(1.0, 255.0) as u8,
            board_id: before.board_id,
            airframe: Arc::clone(&before.plant.airframe),
            start: before.datum.start,
        };
        let mut vehicle = Vehicle::booted(build, parameters, before.plant.wind.clone());
        vehicle.boot = Boot::new(before.kind, before.boot.realistic);
        vehicle.plans = std::mem::take(&mut before.plans);
        vehicle.log = std::mem::take(&mut before.log).rebooted();
        vehicle.fence_changed();
        let operator = self.operator.take().map(|_| Box::default());
        *self = Self::booted(vehicle);
        self.operator = operator;
        self.begin_first_mode();
        if self.vehicle.boot.realistic {
            self.vehicle.radio.forget_switches();
        }
    }

    /// Advances by one step.
    pub(super) fn step(&mut self) {
        self.vehicle.steps += 1;
        let steps = self.vehicle.steps;
        self.step_boot();
        if self.vehicle.flight.mode.id == ModeId::Auto {
            self.auto_plan.step(&mut self.vehicle);
            if let Some(mode) = self.auto_plan.take_end() {
                self.set_mode(mode);
            }
        }
        self.move_body();
        self.power();
        if self.vehicle.kind == VehicleKind::Copter {
            self.watch_flight();
        }
        self.watch_radio();
        self.report_obstacles();
        if steps.is_multiple_of(failsafe::EVERY_STEPS) {
            self.watch_failsafes();
            self.watch_workbench();
            self.count();
            self.watch_sticks();
        }
        if steps.is_multiple_of(fence::EVERY_STEPS) {
            self.watch_fence();
        }
        if steps.is_multiple_of(trail::EVERY_STEPS) {
            self.vehicle.watch_trail();
        }
        if steps.is_multiple_of(adsb::EVERY_STEPS) {
            self.vehicle.watch_traffic();
        }
        self.vehicle.record();
        if steps.is_multiple_of(TIMESYNC_EVERY_STEPS) {
            self.ask_time();
        }
    }

    /// Handles a change in a list.
    pub(super) fn plans_changed(&mut self, kind: ListKind) {
        match kind {
            ListKind::Plan => self.auto_plan.list_changed(&mut self.vehicle),
            ListKind::Fence => self.vehicle.fence_changed(),
            ListKind::Rally => {}
        }
    }

    fn step_boot(&mut self) {
        let gps = &self.vehicle.tuning.faults.gps;
        let is_blind = gps.disabled || gps.jammed || self.vehicle.uptime() < gps.lock_after;
        for event in self.vehicle.boot.step(is_blind) {
            self.pass(event);
        }
    }

    fn pass(&mut self, event: BootEvent) {
        let vehicle = &mut self.vehicle;
        match event {
            BootEvent::Say(text) => vehicle.say(MavSeverity::MAV_SEVERITY_INFO, text),
            BootEvent::Print(text) => vehicle.boot.print(text),
            BootEvent::Initialised => {
                self.go_back_to_first_mode();
                let heartbeat = telemetry::message(HEARTBEAT_DATA::ID, self);
                self.vehicle.outbox.extend(heartbeat);
            }
            BootEvent::Origin if vehicle.safety.armed => vehicle.set_home_in_flight(),
            BootEvent::Origin => vehicle.set_home_here(),
            BootEvent::Elevation => {
                let elevation_m = vehicle.datum.start.altitude_amsl_m;
                let text = format!("Field Elevation Set: {elevation_m:.0}m");
                vehicle.say(MavSeverity::MAV_SEVERITY_INFO, &text);
            }
            BootEvent::Ready => vehicle.boot.finish(),
        }
    }

    /// Moves the vehicle for one step, by air or on the surface.
    fn move_body(&mut self) {
        match self.vehicle.kind {
            VehicleKind::Copter => self.fly(),
            VehicleKind::Rover(_) => self.drive(),
        }
    }

    /// Checks what only a vehicle that flies has: crashes, landings, modes that end by themselves.
    fn watch_flight(&mut self) {
        self.watch_crash();
        self.watch_ground();
        self.vehicle.watch_alignment();
        if self.vehicle.steps.is_multiple_of(failsafe::EVERY_STEPS) {
            self.watch_brake();
            self.watch_zigzag();
        }
    }

    /// Flies, unless the vehicle is parked with its motors off.
    fn fly(&mut self) {
        let vehicle = &mut self.vehicle;
        let is_asleep = vehicle.plant.body.on_ground && !vehicle.safety.armed;
        let impact_m_s = if is_asleep { None } else { vehicle.fly() };
        if let Some(impact_m_s) = impact_m_s {
            let reaction = self.crash.touch(impact_m_s);
            self.react(reaction);
        }
    }

    /// Updates the estimator and the battery.
    fn power(&mut self) {
        let vehicle = &mut self.vehicle;
        let power_w = vehicle.power_w();
        vehicle.estimate();
        let plant = &mut vehicle.plant;
        let set_v = vehicle.tuning.battery_set_v;
        plant.battery.step(power_w, set_v, &plant.airframe);
        if vehicle.kind != VehicleKind::Copter {
            let drop_v = ROVER_SAG_V * plant.body.throttle.abs();
            plant.battery.sag(drop_v, &plant.airframe);
        }
    }

    fn watch_crash(&mut self) {
        let vehicle = &self.vehicle;
        let reactions = self.crash.step(&CrashInputs {
            body: &vehicle.plant.body,
            is_flying: vehicle.safety.armed && !vehicle.safety.landed,
            checks_crash: vehicle.tuning.crash_check,
            mode: vehicle.flight.mode.id,
        });
        if !reactions.is_empty() {
            self.react(reactions);
        }
    }

    fn watch_ground(&mut self) {
        let vehicle = &mut self.vehicle;
        let may_rest = vehicle.safety.armed && vehicle.plant.body.on_ground;
        let is_stopped = vehicle.is_stopped();
        let inputs = GroundInputs {
            now: vehicle.uptime(),
            on_ground: vehicle.plant.body.on_ground,
            touched: vehicle.flight.task.touched_in_landing(),
            is_resting: may_rest && (is_stopped || vehicle.has_nothing_to_do()),
            // Stopped motors do not show that the vehicle is armed.
            disarm_delay: if is_stopped {
                vehicle.tuning.disarm_delay / 2
            } else {
                vehicle.tuning.disarm_delay
            },
        };
        if vehicle.safety.watch_ground(&inputs) {
            self.disarm();
        }
    }

    fn watch_workbench(&mut self) {
        if self.workbench.step(self.vehicle.uptime()) {
            let text = "finished motor test";
            self.vehicle.say(MavSeverity::MAV_SEVERITY_INFO, text);
        }
    }

    /// Updates the statistics and stores them.
    fn count(&mut self) {
        let vehicle = &mut self.vehicle;
        let report = self.counters.step(&CounterInputs {
            now: vehicle.uptime(),
            armed: vehicle.safety.armed,
            landed: vehicle.safety.landed,
            body: &vehicle.plant.body,
            hover: vehicle.tuning.flight.pilot.hover(),
            parameters: &vehicle.parameters,
        });
        for (name, value) in report.times {
            vehicle.store_parameter(name, value);
        }
        if let Some(hover) = report.hover {
            vehicle.store_parameter("MOT_THST_HOVER", hover);
            vehicle.retune();
        }
    }

    fn ask_time(&mut self) {
        let ns = self.vehicle.uptime().as_nanos() as i64;
        self.vehicle
            .outbox
            .push(MavMessage::TIMESYNC(TIMESYNC_DATA {
                tc1: 0,
                ts1: ns + i64::from(self.vehicle.system),
                ..Default::default()
            }));
    }
}

/// The factory parameters: the defaults, with the vehicle's system id and its airframe's values.
pub(super) fn factory_parameters(kind: VehicleKind, system: u8, airframe: &Airframe) -> Parameters {
    let mut parameters = Parameters::new(kind, system);
    if let Some(chassis) = kind.chassis() {
        for &(name, value) in chassis.parameters() {
            parameters.set(name, value);
        }
        if airframe.gear().is_none() {
            return parameters;
        }
    } else {
        parameters.set("FRAME_CLASS", airframe.frame_class());
    }
    let capacity_ah = airframe.battery_capacity_ah() as f32;
    parameters.set("SIM_BATT_VOLTAGE", airframe.full_voltage_v() as f32);
    parameters.set("SIM_BATT_CAP_AH", capacity_ah);
    if capacity_ah > 0.0 {
        parameters.set("BATT_CAPACITY", capacity_ah * 1000.0);
    }
    for &(name, value) in airframe.parameters() {
        parameters.set(name, value as f32);
    }
    if let (Some(chassis), Some(gear)) = (kind.chassis(), airframe.gear()) {
        for (name, value) in gear.tuning(chassis) {
            parameters.set(name, value as f32);
        }
    }
    parameters
}
