//! Telemetry: the changes that each `MAVLink` message makes to the model of its vehicle, and the
//! resulting notices. One match chooses the handler; the handlers are in one file per subject.
//!
//! # How the parts fit
//! - Is it there and able to fly: `heartbeat`, `health`, `landed`, `clock` (a reboot), `idle` (why it disarmed).
//! - Where it is, and how well it knows: `position`, `attitude`, `speed`, `gps`, `ekf`, `vibration`, `rangefinder`.
//! - What it has and does: `battery`, `outputs`, `fence`, `plan` (progress), `target`, `modes`, `control`, `version`.
//! - What it says: `status_text` (with the reasons not to arm), `parameters`, `traffic`.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{HEARTBEAT_DATA, MavCmd, MavMessage};

use crate::alert::AlertKind;
use crate::notice::{Notice, NoticeSource};
use crate::parameters::ParameterList;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Place, Severity, Vehicle, VehicleId};
use crate::wire::{CONTROL_STATUS, Content, Frame, boot_ms};

mod attitude;
mod battery;
mod clock;
mod control;
mod ekf;
mod fence;
mod gps;
mod health;
mod heartbeat;
mod idle;
mod landed;
mod modes;
mod outputs;
mod parameters;
mod plan;
mod position;
mod rangefinder;
mod speed;
mod status_text;
mod target;
#[cfg(test)]
mod testing;
mod traffic;
mod version;
mod vibration;

pub use parameters::{parameter_encoding, parameter_value};

const HEARTBEAT_ID: u32 = HEARTBEAT_DATA::ID;
/// The parameter for the time after which a vehicle on the ground disarms, in seconds; 0 for never.
const DISARM_DELAY: &str = "DISARM_DELAY";

/// The state of one vehicle's handlers that is not in the model: incomplete texts, parameters, and
/// the state of its clock.
#[derive(Debug, Clone, Default)]
pub struct Inbox {
    texts: status_text::Assembly,
    // Shared with readers; copied on a change while a reader holds it.
    parameters: Arc<ParameterList>,
    clock: clock::BootClock,
    /// The time of the last reason not to arm: reasons that arrive together replace earlier ones.
    reasons_at: Option<Duration>,
    /// When `BATTERY_STATUS` last reported pack 0, which then overrides `SYS_STATUS`.
    pack_heard_at: Option<Duration>,
    /// `GPS_GLOBAL_ORIGIN`: the origin of local coordinates.
    origin: Option<Place>,
    plan: plan::PlanWatch,
    /// The time armed on the ground.
    idle: idle::IdleWatch,
}

/// The notices of a handler, with their time.
struct HandlerNotices<'a> {
    vehicle: VehicleId,
    now: Duration,
    notices: &'a mut Vec<Notice>,
}

impl HandlerNotices<'_> {
    fn say(&mut self, severity: Severity, text: Text) {
        let notice = Notice::about(self.vehicle, self.now, severity, text);
        self.notices.push(notice);
    }

    fn alert(&mut self, severity: Severity, kind: AlertKind, text: Text) {
        self.notices.push(Notice {
            kind: Some(kind),
            ..Notice::about(self.vehicle, self.now, severity, text)
        });
    }

    /// Passes on a text of the vehicle as a notice.
    fn repeat(&mut self, severity: Severity, kind: AlertKind, text: String) {
        self.notices.push(Notice {
            kind: Some(kind),
            source: NoticeSource::Vehicle,
            ..Notice::about(self.vehicle, self.now, severity, text.into())
        });
    }
}

impl Inbox {
    /// An inbox for a vehicle that has not been heard yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Applies one frame of this vehicle, received at `now`. `notices` receives the notices.
    ///
    /// State comes from the vehicle's autopilot component only; a text may come from any component, and traffic from an
    /// ADS-B receiver.
    pub fn apply(
        &mut self,
        vehicle: &mut Vehicle,
        frame: &Frame,
        now: Duration,
        notices: &mut Vec<Notice>,
    ) {
        let mut report = HandlerNotices {
            vehicle: vehicle.id,
            now,
            notices,
        };
        if let Content::Message(MavMessage::STATUSTEXT(data)) = &frame.content {
            let chunk = status_text::Chunk::new(frame.component, data);
            for text in self.texts.accept(chunk, now) {
                self.take_text(vehicle, &text, &mut report);
            }
            return;
        }
        if let Content::Message(MavMessage::ADSB_VEHICLE(data)) = &frame.content
            && [vehicle.component, traffic::RECEIVER].contains(&frame.component)
        {
            return traffic::apply(vehicle, data, now);
        }
        if frame.component != vehicle.component {
            return;
        }
        match &frame.content {
            Content::Message(message) => {
                if let Some(boot_ms) = boot_ms(message) {
                    self.note_clock(vehicle, boot_ms, &mut report);
                }
                self.dispatch(vehicle, message, &mut report);
            }
            Content::Undecoded { id, payload } if *id == HEARTBEAT_ID => {
                let beat = heartbeat::Beat::from_payload(payload);
                heartbeat::apply(vehicle, beat, &mut self.idle, &mut report);
            }
            Content::Undecoded { id, payload } if *id == CONTROL_STATUS => {
                control::apply(vehicle, &payload[..12], &mut report);
            }
            Content::Undecoded { .. } | Content::Unknown { .. } => {}
        }
    }

    /// The parameters received so far.
    pub fn parameters(&self) -> &Arc<ParameterList> {
        &self.parameters
    }

    /// Forgets which parameters of the list have been heard: the list is about to be sent again.
    pub fn expect_parameters_again(&mut self) {
        Arc::make_mut(&mut self.parameters).expect_again();
    }

    /// Stores the defaults of the parameters.
    pub fn note_defaults(&mut self, defaults: BTreeMap<String, f64>) {
        Arc::make_mut(&mut self.parameters).note_defaults(defaults);
    }

    /// Forgets all parameters that have been heard.
    pub fn forget_parameters(&mut self) {
        Arc::make_mut(&mut self.parameters).forget();
    }

    /// Handles time-outs: releases chunked texts with missing parts (after 1 s), with `...` in
    /// their place, and drops a target and traffic that are no longer sent. Must be called a few
    /// times a second.
    pub fn poll(&mut self, vehicle: &mut Vehicle, now: Duration, notices: &mut Vec<Notice>) {
        let mut report = HandlerNotices {
            vehicle: vehicle.id,
            now,
            notices,
        };
        for text in self.texts.expire(now) {
            self.take_text(vehicle, &text, &mut report);
        }
        target::expire(vehicle, now);
        vehicle.traffic.expire(now);
    }

    /// Handles a restart of the autopilot: its earlier state is void. A heartbeat gives its mode and whether it is
    /// armed.
    pub fn restarted(&mut self, vehicle: &mut Vehicle, now: Duration, notices: &mut Vec<Notice>) {
        let mut report = HandlerNotices {
            vehicle: vehicle.id,
            now,
            notices,
        };
        self.forget(vehicle, &mut report);
        vehicle.heartbeat = None;
    }

    fn dispatch(
        &mut self,
        vehicle: &mut Vehicle,
        message: &MavMessage,
        report: &mut HandlerNotices<'_>,
    ) {
        use MavMessage as M;
        let now = report.now;
        match message {
            M::HEARTBEAT(data) => {
                heartbeat::apply(vehicle, data.into(), &mut self.idle, report);
            }
            M::COMMAND_ACK(data) if data.command == MavCmd::MAV_CMD_COMPONENT_ARM_DISARM => {
                self.idle.note_answer(vehicle, now);
            }
            M::AVAILABLE_MODES(data) => modes::apply(vehicle, data),
            M::AVAILABLE_MODES_MONITOR(data) => vehicle.modes.note_monitor(data.seq),
            M::CURRENT_MODE(data) => modes::apply_current(vehicle, data),
            M::ATTITUDE(data) => attitude::apply(vehicle, data, now),
            M::GLOBAL_POSITION_INT(data) => position::apply_global(vehicle, data, now),
            M::LOCAL_POSITION_NED(data) => position::apply_local(vehicle, data, now),
            M::HOME_POSITION(data) => position::apply_home(vehicle, data),
            M::GPS_GLOBAL_ORIGIN(data) => self.origin = position::origin(data),
            // A disarmed vehicle has no target, whatever it reports.
            M::POSITION_TARGET_GLOBAL_INT(_) | M::POSITION_TARGET_LOCAL_NED(_)
                if vehicle.heartbeat.is_some_and(|beat| !beat.armed) => {}
            M::POSITION_TARGET_GLOBAL_INT(data) => target::apply_global(vehicle, data, now),
            M::POSITION_TARGET_LOCAL_NED(data) => {
                target::apply_local(vehicle, data, self.origin, now);
            }
            M::GPS_RAW_INT(data) => gps::apply(vehicle, data, report),
            M::VFR_HUD(data) => speed::apply_hud(vehicle, data, now),
            M::WIND(data) => speed::apply_wind(vehicle, data),
            M::SYS_STATUS(data) => {
                health::apply(vehicle, data, now);
                battery::apply_summary(vehicle, data, self.pack_heard_at, now);
            }
            M::BATTERY_STATUS(data) => {
                if data.id == battery::MAIN_PACK {
                    self.pack_heard_at = Some(now);
                }
                battery::apply(vehicle, data, now);
            }
            M::EKF_STATUS_REPORT(data) => ekf::apply(vehicle, data, report),
            M::ESTIMATOR_STATUS(data) if vehicle.runs_px4() => {
                ekf::apply_estimator(vehicle, data, report);
            }
            M::VIBRATION(data) => vibration::apply(vehicle, data),
            M::EXTENDED_SYS_STATE(data) => landed::apply(vehicle, data),
            M::MISSION_CURRENT(data) => self.plan.apply_current(vehicle, data, report),
            M::MISSION_ITEM_REACHED(data) => self.plan.apply_reached(vehicle, data),
            M::FENCE_STATUS(data) => fence::apply(vehicle, data, report),
            M::RANGEFINDER(data) => rangefinder::apply(vehicle, data),
            M::DISTANCE_SENSOR(data) => rangefinder::apply_sensor(vehicle, data),
            M::RC_CHANNELS(data) => outputs::apply_rc(vehicle, data),
            M::SERVO_OUTPUT_RAW(data) => outputs::apply_servos(vehicle, data),
            M::AUTOPILOT_VERSION(data) => version::apply(vehicle, data),
            M::PARAM_VALUE(data) => {
                if data.param_id.to_str() == Ok(DISARM_DELAY) {
                    self.idle.delay_s = Some(data.param_value);
                }
                if let Ok(name) = data.param_id.to_str() {
                    vehicle.arrival.note(name, data.param_value);
                }
                parameters::apply(Arc::make_mut(&mut self.parameters), data, vehicle);
            }
            _ => {}
        }
    }

    fn take_text(
        &mut self,
        vehicle: &mut Vehicle,
        text: &status_text::Joined,
        report: &mut HandlerNotices<'_>,
    ) {
        status_text::apply(vehicle, text, &mut self.reasons_at, report);
        plan::apply_text(vehicle, &text.text, report);
    }

    fn note_clock(&mut self, vehicle: &mut Vehicle, boot_ms: u32, report: &mut HandlerNotices<'_>) {
        match self.clock.note(vehicle.boot_ms, boot_ms, report.now) {
            clock::Step::Onward => {}
            clock::Step::Rebooted => self.forget(vehicle, report),
            clock::Step::TwoClocks => report.say(
                Severity::Error,
                text!("heard-two-vehicles", system = vehicle.id),
            ),
        }
        vehicle.boot_ms = Some(boot_ms);
    }

    /// Drops state that a reboot makes stale; statistics of the link stay.
    fn forget(&mut self, vehicle: &mut Vehicle, report: &mut HandlerNotices<'_>) {
        report.say(Severity::Warning, text!("heard-rebooted"));
        vehicle.link.reboots += 1;
        *vehicle = Vehicle {
            heartbeat: vehicle.heartbeat,
            station: vehicle.station,
            held: vehicle.held,
            twin: vehicle.twin,
            link: vehicle.link,
            texts: std::mem::take(&mut vehicle.texts),
            ..Vehicle::new(vehicle.system, vehicle.component)
        };
        for text in self.texts.drain() {
            self.take_text(vehicle, &text, report);
        }
        // Reasons in half-received texts belong to the old run as well.
        vehicle.prearm.clear();
        self.reasons_at = None;
        self.pack_heard_at = None;
        self.origin = None;
        self.plan = plan::PlanWatch::default();
        self.idle = idle::IdleWatch::default();
    }
}

#[cfg(test)]
mod tests;
