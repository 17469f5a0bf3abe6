//! The autopilot's estimate of its motion: the truth, with an error from faulty sensors.
//!
//! The model stores the error, not the estimate: without faults, the estimate is the truth itself at no cost. Times,
//! thresholds and texts were measured with the EKF3 of `ArduCopter` in SITL. GPS innovations beyond a gate are rejected
//! for ten seconds; then the position jumps to the GPS. Without GPS the estimate is blind, distrusted after seven
//! seconds and abandoned after fifteen.

mod barometer;
mod compass;
mod faults;
mod gps;
mod lanes;
mod trust;

use std::time::Duration;

use glam::{DVec2, DVec3};
use mavlink::dialects::ardupilotmega::{EkfStatusFlags, MavMessage, MavSeverity};

use self::barometer::Barometer;
use self::compass::Compass;
pub(super) use self::faults::{Faults, GpsUnused, RadioFault};
pub(super) use self::gps::Fix;
use self::gps::Receiver;
use self::trust::Trust;
pub(super) use self::trust::{FLAGS_GIVEN_UP, FLAGS_GOOD, Ratios};
use super::body::Body;
use super::kind::VehicleKind;
use super::kinematics::STEP_S;
use super::texts;

/// The time without a GPS position after which the horizontal estimate is distrusted, and after which it is abandoned.
const DISTRUSTED_AFTER: Duration = Duration::from_secs(7);
const GIVEN_UP_AFTER: Duration = Duration::from_secs(15);
/// The GPS counts as unused after this time without an accepted position.
const UNUSED_AFTER: Duration = Duration::from_secs(4);
/// A position rejected for this long is adopted after all.
const ADOPTED_AFTER: Duration = Duration::from_millis(9900);
/// The delay before a glitch is reported, and before it is cleared.
const GLITCH_AFTER: Duration = Duration::from_secs(1);
const GLITCH_OVER_AFTER: Duration = Duration::from_secs(10);
/// The delay before a new report enters the estimate (the fusion horizon).
const FUSION_DELAY: Duration = Duration::from_millis(60);
/// The greatest position innovation that passes the test (111 m gave a ratio of 28.7), and its growth per second
/// without an accepted position.
const GATE_M: f64 = 3.73;
const GATE_GROWTH_PER_S: f64 = 0.0265;
/// The greatest velocity innovation that passes the test, in m/s.
const GATE_M_S: f64 = 1.5;
/// The time constant with which the position follows accepted reports, in seconds.
const FOLLOWS_S: f64 = 1.5;
/// The drift of an uncorrected estimate: 0.4 m in 7 s.
const BLIND_ACCEL_M_S2: f64 = 0.014;
/// The lean error of a vehicle without a position: it drifts at 0.19 m/s.
const LEVEL_ERROR_M_S2: f64 = 0.05;
const NEGLIGIBLE_M: f64 = 1e-3;

/// The inputs of one step of the estimator.
pub(super) struct Surroundings<'a> {
    pub(super) now: Duration,
    pub(super) truth: &'a Body,
    pub(super) faults: &'a Faults,
    pub(super) latitude_deg: f64,
}

/// The estimator of one vehicle.
#[derive(Debug, Clone)]
pub(super) struct Estimator {
    /// Whether there is or was any fault; otherwise the estimate is the truth.
    disturbed: bool,
    belief: Option<Box<Body>>,
    error_m: DVec3,
    velocity_error_m_s: DVec3,
    /// The direction of this vehicle's sensor errors.
    bias: DVec2,
    trust: Trust,
    receiver: Receiver,
    ratios: Ratios,
    last_accepted: Duration,
    /// The error of the last accepted position.
    accepted_m: DVec2,
    rejecting_since: Option<Duration>,
    last_rejected: Option<Duration>,
    glitching: bool,
    /// The EKF core in use, and whether a rejected position makes the autopilot try the other one.
    lane: usize,
    tries_lanes: bool,
    stuck_since: Option<Duration>,
    /// The velocity error from a stuck accelerometer.
    shake_m_s: DVec3,
    barometer: Barometer,
    compass: Compass,
    /// The last known position, reported while the position is abandoned.
    last_known_m: Option<DVec3>,
}

impl Estimator {
    /// An estimator without error; `seed` sets the direction of its small errors.
    pub(super) fn new(seed: u64, kind: VehicleKind) -> Self {
        let angle = (seed % 3600) as f64 * (std::f64::consts::TAU / 3600.0);
        Self {
            disturbed: false,
            belief: None,
            error_m: DVec3::ZERO,
            velocity_error_m_s: DVec3::ZERO,
            bias: DVec2::from_angle(angle),
            trust: Trust::Good,
            receiver: Receiver::new(seed),
            ratios: Ratios::GOOD,
            last_accepted: Duration::ZERO,
            accepted_m: DVec2::ZERO,
            rejecting_since: None,
            last_rejected: None,
            glitching: false,
            lane: 0,
            tries_lanes: kind == VehicleKind::Copter,
            stuck_since: None,
            shake_m_s: DVec3::ZERO,
            barometer: Barometer::default(),
            compass: Compass::default(),
            last_known_m: None,
        }
    }

    /// The autopilot's estimate of a body.
    pub(super) fn belief<'a>(&'a self, truth: &'a Body) -> &'a Body {
        self.belief.as_deref().unwrap_or(truth)
    }

    /// Whether the horizontal position is good enough to fly.
    pub(super) fn has_position(&self) -> bool {
        self.trust == Trust::Good
    }

    /// Whether reports of the GPS arrive, but have not been accepted for a while.
    pub(super) fn ignores_gps(&self, now: Duration) -> bool {
        self.disturbed && self.receiver.fix.is_locked() && now >= self.last_accepted + UNUSED_AFTER
    }

    /// Whether the position is still estimated, well or badly.
    pub(super) fn is_aiding(&self) -> bool {
        self.trust != Trust::GivenUp
    }

    /// The last known position, metres from the start, while the position is abandoned.
    pub(super) fn last_known_m(&self) -> Option<DVec3> {
        self.last_known_m
    }

    /// Whether the GPS contradicts the other sensors.
    pub(super) fn is_glitching(&self) -> bool {
        self.glitching
    }

    /// The current flags of `EKF_STATUS_REPORT`.
    pub(super) fn flags(&self) -> EkfStatusFlags {
        let mut flags = self.trust.flags();
        if self.barometer.lost {
            flags.remove(EkfStatusFlags::EKF_POS_VERT_ABS);
        }
        if self.glitching {
            flags.insert(EkfStatusFlags::EKF_GPS_GLITCHING);
        }
        flags
    }

    pub(super) fn ratios(&self) -> Ratios {
        self.ratios
    }

    /// The GPS report, as the difference from the truth; `None` without a fault.
    pub(super) fn fix(&self) -> Option<Fix> {
        self.disturbed.then_some(self.receiver.fix)
    }

    /// The barometer's error, in metres up.
    pub(super) fn barometer_offset_m(&self) -> f64 {
        self.barometer.offset_m
    }

    /// Whether the first compass delivers data.
    pub(super) fn compass_is_healthy(&self) -> bool {
        self.compass.healthy.unwrap_or(true)
    }

    /// The number of the compass in use, counted from 0; `None` if all have failed.
    pub(super) fn compass_in_use(&self) -> Option<usize> {
        self.compass.in_use()
    }

    /// The horizontal acceleration from a wrong level estimate.
    pub(super) fn level_error_m_s2(&self) -> DVec2 {
        self.bias * LEVEL_ERROR_M_S2
    }

    /// Whether [`Estimator::step`] has anything to do.
    pub(super) fn has_work(&self, faults: &Faults) -> bool {
        self.disturbed || faults.any
    }

    /// Advances by one step. Returns the jump of the estimated position, if any.
    pub(super) fn step(
        &mut self,
        around: &Surroundings<'_>,
        outbox: &mut Vec<MavMessage>,
    ) -> Option<DVec3> {
        if !self.disturbed {
            self.begin(around);
        }
        let mut jump = self.watch_gps(around, outbox);
        self.watch_lanes(around, outbox);
        let mut error_up_m = -self.error_m.z;
        let height_m = around.truth.height_m();
        let before_m = error_up_m;
        self.barometer.random = self.receiver.random();
        if self
            .barometer
            .step(around.now, height_m, &mut error_up_m, around.faults)
        {
            jump.get_or_insert(DVec3::ZERO).z += before_m - error_up_m;
        }
        self.error_m.z = -error_up_m;
        self.watch_compass(around, outbox);
        self.end_if_quiet(around);
        self.believe(around.truth);
        jump
    }

    fn begin(&mut self, around: &Surroundings<'_>) {
        self.disturbed = true;
        self.last_accepted = Receiver::last_arrival(around.now, &around.faults.gps) + FUSION_DELAY;
    }

    fn end_if_quiet(&mut self, around: &Surroundings<'_>) {
        let right = self.error_m.length() < NEGLIGIBLE_M && self.trust == Trust::Good;
        let settled = self.barometer.is_settled() && self.compass.is_settled();
        let known = self.receiver.fix.is_locked() && self.receiver.fix.offset_m == DVec3::ZERO;
        if around.faults.any || !right || !settled || !known || self.glitching {
            return;
        }
        if self.last_rejected.is_some() || self.shake_m_s != DVec3::ZERO {
            return;
        }
        self.disturbed = false;
        self.error_m = DVec3::ZERO;
        self.velocity_error_m_s = DVec3::ZERO;
        self.ratios = Ratios::GOOD;
    }

    fn believe(&mut self, truth: &Body) {
        if !self.disturbed {
            self.belief = None;
            return;
        }
        let belief = self.belief.get_or_insert_with(|| Box::new(truth.clone()));
        belief.as_mut().clone_from(truth);
        belief.position_m += self.error_m;
        belief.velocity_m_s += self.velocity_error_m_s + self.shake_m_s;
    }

    fn watch_gps(
        &mut self,
        around: &Surroundings<'_>,
        outbox: &mut Vec<MavMessage>,
    ) -> Option<DVec3> {
        let now = around.now;
        let arrived = self
            .receiver
            .step(now, around.latitude_deg, &around.faults.gps);
        let jump = if arrived && self.receiver.fix.is_locked() {
            self.fuse(now, outbox)
        } else {
            None
        };
        if now < self.last_accepted + Duration::from_millis(500) {
            let way = (self.accepted_m - self.error_m.truncate()) * (STEP_S / FOLLOWS_S);
            self.error_m += way.extend(0.0);
        } else {
            self.run_away(around.truth);
        }
        self.watch_glitches(now);
        self.watch_trust(around, outbox);
        jump
    }

    /// Accepts or rejects a position.
    fn fuse(&mut self, now: Duration, outbox: &mut Vec<MavMessage>) -> Option<DVec3> {
        let fix = self.receiver.fix;
        let blind_s = now.saturating_sub(self.last_accepted).as_secs_f64();
        let gate_m = GATE_M * (1.0 + GATE_GROWTH_PER_S * blind_s);
        let innovation_m = (fix.offset_m - self.error_m).truncate();
        self.ratios.position = innovation_m.length() / gate_m;
        self.ratios.velocity = Ratios::GOOD.velocity + fix.velocity_offset_m_s.length() / GATE_M_S;
        if self.trust == Trust::GivenUp {
            for core in 0..2 {
                let text = format!("EKF3 IMU{core} is using GPS");
                texts::say(outbox, MavSeverity::MAV_SEVERITY_INFO, &text);
            }
        }
        let late = self.trust != Trust::Good || now >= self.last_accepted + ADOPTED_AFTER;
        if late {
            let jump = innovation_m.extend(0.0);
            self.error_m += jump;
            self.accept(now);
            return Some(jump);
        }
        if self.ratios.position < 1.0 && self.ratios.velocity < 1.0 {
            self.accept(now);
            return None;
        }
        if self.rejecting_since.is_none() {
            self.rejecting_since = Some(now);
            if self.tries_lanes {
                self.switch_lane(outbox);
            }
        }
        self.last_rejected = Some(now);
        None
    }

    fn accept(&mut self, now: Duration) {
        self.last_accepted = now;
        self.accepted_m = self.receiver.fix.offset_m.truncate();
        self.rejecting_since = None;
        self.trust = Trust::Good;
        self.last_known_m = None;
        self.velocity_error_m_s = DVec3::ZERO;
    }

    /// Lets an estimate without a position drift, unless the vehicle is on the ground.
    fn run_away(&mut self, truth: &Body) {
        if truth.on_ground {
            self.velocity_error_m_s = DVec3::ZERO;
            return;
        }
        // The estimate lags behind the true motion.
        self.velocity_error_m_s -= (self.bias * (BLIND_ACCEL_M_S2 * STEP_S)).extend(0.0);
        self.error_m += self.velocity_error_m_s * STEP_S;
    }

    fn watch_glitches(&mut self, now: Duration) {
        if self
            .rejecting_since
            .is_some_and(|since| now >= since + GLITCH_AFTER)
        {
            self.glitching = true;
        }
        if self
            .last_rejected
            .is_some_and(|last| now >= last + GLITCH_OVER_AFTER)
        {
            self.last_rejected = None;
            self.glitching = false;
        }
    }

    fn watch_trust(&mut self, around: &Surroundings<'_>, outbox: &mut Vec<MavMessage>) {
        let blind = around.now.saturating_sub(self.last_accepted);
        if blind >= DISTRUSTED_AFTER && self.trust == Trust::Good && self.is_blind() {
            self.trust = Trust::Distrusted;
        }
        if blind >= GIVEN_UP_AFTER && self.trust == Trust::Distrusted {
            self.trust = Trust::GivenUp;
            self.last_known_m = Some(around.truth.position_m + self.error_m);
            for core in 0..2 {
                let text = format!("EKF3 IMU{core} stopped aiding");
                texts::say(outbox, MavSeverity::MAV_SEVERITY_WARNING, &text);
            }
        }
    }

    /// Whether positions are missing, rather than wrong.
    fn is_blind(&self) -> bool {
        !self.receiver.fix.is_locked()
    }

    fn watch_compass(&mut self, around: &Surroundings<'_>, outbox: &mut Vec<MavMessage>) {
        if let Some(next) = self.compass.step(around.now, around.faults) {
            for core in 0..2 {
                let text = format!("EKF3 IMU{core} switching to compass {next}");
                texts::say(outbox, MavSeverity::MAV_SEVERITY_INFO, &text);
            }
        }
        self.ratios.compass = self.compass.ratio(around.faults);
        self.ratios.height = self.barometer.ratio;
    }
}
