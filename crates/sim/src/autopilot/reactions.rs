//! The autopilot's reactions to its monitoring parts.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::MavSeverity;

use super::{Autopilot, telemetry};
use crate::failsafe::{Failsafe, FailsafeInputs};
use crate::kind::VehicleKind;
use crate::mode::ModeId;
use crate::reaction::{FailsafeAction, Reaction};
use crate::task::Task;

/// The delay before the descent of a landing begun by a failsafe.
const PAUSE: Duration = Duration::from_secs(4);
const FENCE_STATUS: u32 = 162;

/// A check that may trigger a failsafe.
type Watch = fn(&mut Failsafe, &FailsafeInputs<'_>) -> Vec<Reaction>;

impl Autopilot {
    /// Carries out the parts' reactions, in order.
    pub(super) fn react(&mut self, reactions: impl IntoIterator<Item = Reaction>) {
        for reaction in reactions {
            match reaction {
                Reaction::Say(severity, text) => self.vehicle.say(severity, &text),
                Reaction::Disarm => self.disarm(),
                Reaction::ReleaseSticks => self.vehicle.radio.until = Duration::ZERO,
                Reaction::Act(action) => self.act(action),
                Reaction::LeavePosition { holds_height } => self.leave_position(holds_height),
                Reaction::BoostThrust => {
                    if let Some(upset) = &mut self.vehicle.plant.body.upset {
                        upset.mixer.boost = true;
                    }
                }
                Reaction::EnterFirst(modes) => {
                    modes.iter().any(|&mode| self.set_mode(mode));
                }
            }
        }
    }

    /// Checks the links, the estimate and the battery, in order; each check takes account of the
    /// effects of the previous one.
    pub(super) fn watch_failsafes(&mut self) {
        const COPTER: &[Watch] = &[
            Failsafe::watch_station,
            Failsafe::watch_estimate,
            Failsafe::watch_battery,
        ];
        const ROVER: &[Watch] = &[
            Failsafe::watch_surface_links,
            Failsafe::watch_surface_estimate,
            Failsafe::watch_battery,
        ];
        let watches = match self.vehicle.kind {
            VehicleKind::Copter => COPTER,
            VehicleKind::Rover(_) => ROVER,
        };
        for &watch in watches {
            self.watch_failsafe(watch);
        }
    }

    /// Checks the remote control.
    pub(super) fn watch_radio(&mut self) {
        let is_copter = self.vehicle.kind == VehicleKind::Copter;
        if is_copter && self.failsafe.doubts_radio(self.vehicle.tuning.faults.radio) {
            self.watch_failsafe(Failsafe::watch_radio);
        }
    }

    fn watch_failsafe(&mut self, watch: Watch) {
        let vehicle = &self.vehicle;
        let inputs = FailsafeInputs {
            now: vehicle.uptime(),
            rules: &vehicle.tuning.failsafes,
            armed: vehicle.safety.armed,
            landed: vehicle.safety.landed,
            mode: vehicle.flight.mode,
            is_rover: vehicle.kind != VehicleKind::Copter,
            is_landing: vehicle.flight.is_landing(),
            throttle_is_low: vehicle.sticks().throttle_is_low(),
            is_booted: vehicle.boot.is_over(),
            estimator: &vehicle.estimator,
            battery: &vehicle.plant.battery,
            battery_capacity_mah: vehicle.tuning.battery_capacity_mah,
            radio: vehicle.reception(),
        };
        let reactions = watch(&mut self.failsafe, &inputs);
        self.react(reactions);
    }

    fn act(&mut self, action: FailsafeAction) {
        if self.vehicle.kind != VehicleKind::Copter {
            return self.act_on_the_ground(action);
        }
        match action {
            FailsafeAction::Nothing | FailsafeAction::Hold | FailsafeAction::PathBackOrHold => {}
            FailsafeAction::Land => self.land_after_pause(),
            FailsafeAction::Return => self.return_or_land(),
            FailsafeAction::PathBackOrReturn => {
                if !self.set_mode(ModeId::SmartRtl) {
                    self.warn("SmartRTL Unavailable, Trying RTL Mode");
                    self.return_or_land();
                }
            }
            FailsafeAction::PathBackOrLand => {
                if !self.set_mode(ModeId::SmartRtl) {
                    self.warn("SmartRTL Unavailable, Using Land Mode");
                    self.land_after_pause();
                }
            }
            FailsafeAction::Terminate => self.disarm(),
            FailsafeAction::PlannedLanding => {
                if !self.set_mode(ModeId::AutoRtl) {
                    self.warn("Trying RTL Mode");
                    self.return_or_land();
                }
            }
            FailsafeAction::BrakeOrLand => {
                if !self.set_mode(ModeId::Brake) {
                    self.warn("Trying Land Mode");
                    self.land_after_pause();
                }
            }
        }
    }

    fn leave_position(&mut self, holds_height: bool) {
        if !(holds_height && self.set_mode(ModeId::AltHold)) {
            self.land_after_pause();
        }
        let name = self.vehicle.flight.mode.name;
        let text = format!("EKF Failsafe: changed to {name} Mode");
        self.vehicle.say(MavSeverity::MAV_SEVERITY_CRITICAL, &text);
    }

    fn land_after_pause(&mut self) {
        let already = self.vehicle.flight.mode.id == ModeId::Land;
        if self.set_mode(ModeId::Land) && !already {
            let until = self.vehicle.uptime() + PAUSE;
            if let Task::Land(landing) = &mut self.vehicle.flight.task {
                landing.waits_until = Some(until);
            }
        }
    }

    fn return_or_land(&mut self) {
        if !self.set_mode(ModeId::Rtl) {
            self.land_after_pause();
        }
    }

    fn warn(&mut self, text: &str) {
        self.vehicle.say(MavSeverity::MAV_SEVERITY_WARNING, text);
    }

    /// Checks the fences and reacts to a breach.
    pub(super) fn watch_fence(&mut self) {
        let vehicle = &mut self.vehicle;
        let rules = &vehicle.tuning.flight.fence;
        let believed = vehicle.estimator.belief(&vehicle.plant.body);
        let points_m = [believed.position_m, vehicle.datum.home_point()];
        let now = vehicle.uptime();
        let Some(breach) = vehicle.fence.watch(rules, points_m, now) else {
            return;
        };
        let (armed, landed) = (vehicle.safety.armed, vehicle.safety.landed);
        if armed && vehicle.kind != VehicleKind::Copter {
            let action = vehicle.fence.action_on_the_ground(breach, rules);
            self.act_on_the_ground(action);
        } else if armed {
            let throttle_is_low = vehicle.sticks().throttle_is_low();
            let idles = !vehicle.flight.mode.controls_height && throttle_is_low;
            let rules = &vehicle.tuning.flight.fence;
            let reaction = vehicle.fence.reaction(breach, rules, landed, idles);
            self.react(reaction);
        }
        if breach.is_told {
            let status = telemetry::message(FENCE_STATUS, self);
            self.vehicle.outbox.extend(status);
        }
        if armed && !landed && self.vehicle.kind == VehicleKind::Copter {
            self.vehicle
                .say(MavSeverity::MAV_SEVERITY_NOTICE, "Fence Breached");
        }
    }
}
