//! Arming and disarming.

use mavlink::dialects::ardupilotmega::MavSeverity;

use super::Autopilot;
use crate::arming::{ArmingChecks, ArmingMethod, LOOK_STEPS, Reason, Safety};
use crate::kind::VehicleKind;
use crate::mode::ModeId;
use crate::vehicle::Vehicle;

impl Autopilot {
    /// Arms, or reports why not; returns whether the vehicle is armed. When forced, only the
    /// mandatory checks apply.
    pub(crate) fn arm(&mut self, method: ArmingMethod) -> bool {
        if self.vehicle.safety.armed {
            return true;
        }
        let forced = method == ArmingMethod::ForcedCommand;
        let mandatory = if forced {
            self.arming_checks().mandatory_obstacles()
        } else {
            Vec::new()
        };
        if !forced || !mandatory.is_empty() {
            refuse(&mut self.vehicle, "Arm", &mandatory);
            let mut reasons = self.arming_checks().obstacles();
            if reasons.is_empty() {
                let last = self
                    .mode_obstacle()
                    .or_else(|| self.arming_checks().last_obstacle(method));
                reasons.extend(last);
            }
            if reasons.is_empty() {
                reasons.extend(self.stick_obstacles(method));
            }
            if !reasons.is_empty() {
                refuse(&mut self.vehicle, "Arm", &reasons);
                return false;
            }
        }
        start_motors(&mut self.vehicle, forced);
        true
    }

    /// The reasons from the last check, which concerns the positions of sticks and switches.
    fn stick_obstacles(&self, method: ArmingMethod) -> Vec<Reason> {
        let vehicle = &self.vehicle;
        if !self.arming_checks().checks_sticks() {
            return Vec::new();
        }
        let rules = &vehicle.tuning.flight.radio;
        let by_yaw_stick = method == ArmingMethod::YawStick;
        let reasons = rules.arming_obstacles(&vehicle.sticks(), by_yaw_stick);
        reasons.into_iter().map(Reason::from).collect()
    }

    fn mode_obstacle(&self) -> Option<Reason> {
        let mode = self.vehicle.flight.mode;
        let may_arm = mode.id == ModeId::Auto && self.vehicle.tuning.flight.auto.may_arm;
        let reason = || match self.vehicle.kind {
            VehicleKind::Copter => format!("{} mode not armable", mode.name),
            VehicleKind::Rover(_) => "Mode not armable".to_owned(),
        };
        (!mode.armable && !may_arm).then(|| reason().into())
    }

    /// Disarms, even in the air.
    pub(crate) fn disarm(&mut self) {
        let keeps_place =
            self.vehicle.kind != VehicleKind::Copter && self.vehicle.flight.mode.id == ModeId::Auto;
        if self.vehicle.disarm() && !keeps_place {
            self.auto_plan.reset();
        }
    }

    /// The checks before arming, for the vehicle's current state.
    pub(crate) fn arming_checks(&self) -> ArmingChecks<'_> {
        let vehicle = &self.vehicle;
        let tuning = &vehicle.tuning;
        let voltage_v = vehicle.plant.battery.voltage_v;
        let battery = &tuning.failsafes.battery;
        let fence = &tuning.flight.fence;
        let [_, _, throttle, _] = &tuning.flight.radio.sticks;
        let throttle_us = vehicle.sticks().channels_us[2];
        ArmingChecks {
            rules: &tuning.arming,
            failsafe_rules: &tuning.failsafes,
            faults: &tuning.faults,
            boot: &vehicle.boot,
            estimator: &vehicle.estimator,
            failsafe: &self.failsafe,
            mode: &vehicle.flight.mode,
            has_home: vehicle.datum.home().is_some(),
            received_throttle_us: vehicle.reception().throttle_us,
            throttle_us,
            throttle_is_down: throttle.pushed(throttle_us) == 0.0,
            is_stopped: vehicle.safety.emergency_stop,
            interlock: vehicle.interlock(),
            has_stop_switch: tuning.flight.radio.has_emergency_stop(),
            radio_was_heard: vehicle.radio.was_heard,
            radio_calibrates: self.workbench.radio_calibrates,
            inertial_doubts: self.imu_watch.doubts(&tuning.faults, vehicle.uptime()),
            mission: &vehicle.plans.mission,
            has_rally_point: !vehicle.plans.rally.is_empty(),
            battery: battery.obstacle(voltage_v, vehicle.charge_left_mah()),
            workbench: self.workbench.obstacles().collect(),
            fence: vehicle.fence.arming_obstacle(fence, vehicle.is_ready()),
        }
    }

    /// Whether `SYS_STATUS` reports that all pre-arm checks pass.
    pub(crate) fn is_armable(&self) -> bool {
        let is_checked = self.vehicle.boot.is_checked();
        self.vehicle.safety.armed || (is_checked && self.arming_checks().obstacles().is_empty())
    }

    /// Reports the reasons not to arm when a report is due.
    pub(super) fn report_obstacles(&mut self) {
        let vehicle = &self.vehicle;
        let looks = vehicle.steps.is_multiple_of(LOOK_STEPS);
        if vehicle.safety.armed || !looks || vehicle.boot.is_initialising() {
            return;
        }
        let now = vehicle.uptime();
        self.imu_watch.look(&vehicle.tuning.faults, now);
        let reasons = self.arming_checks().obstacles();
        if self.vehicle.safety.tells_obstacles(reasons.is_empty(), now) {
            refuse(&mut self.vehicle, "PreArm", &reasons);
        }
    }
}

/// Reports each reason in a text of its own.
fn refuse(vehicle: &mut Vehicle, what: &str, reasons: &[Reason]) {
    for reason in reasons {
        let text = format!("{what}: {reason}");
        vehicle.say(MavSeverity::MAV_SEVERITY_CRITICAL, &text);
    }
}

fn start_motors(vehicle: &mut Vehicle, forced: bool) {
    // A rover with its motors armed is under way, even while it stands.
    let on_ground = vehicle.plant.body.on_ground && vehicle.kind == VehicleKind::Copter;
    let height_m = vehicle.believed().height_m();
    let interlock = vehicle.safety.interlock;
    vehicle.safety = Safety::armed(on_ground, height_m, vehicle.uptime());
    vehicle.safety.interlock = interlock;
    vehicle.flight.simple.reset(vehicle.believed().yaw_deg);
    vehicle.begin_trail(vehicle.knows_place());
    if vehicle.kind == VehicleKind::Copter && vehicle.datum.arming_moves_home() {
        vehicle.set_home(vehicle.here());
    }
    if !forced && vehicle.tuning.arming.is_off() {
        let text = "Warning: Arming Checks Disabled";
        vehicle.say(MavSeverity::MAV_SEVERITY_WARNING, text);
    }
    vehicle.say(MavSeverity::MAV_SEVERITY_INFO, vehicle.kind.armed_text());
    let believed = vehicle.estimator.belief(&vehicle.plant.body);
    vehicle.flight.control.take_over(believed);
    vehicle.flight.yaw.settle(vehicle.plant.body.yaw_deg);
    if on_ground {
        vehicle.flight.wait_on_ground();
    }
}
