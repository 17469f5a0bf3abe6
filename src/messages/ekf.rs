//! `EKF_STATUS_REPORT` of ArduPilot and `ESTIMATOR_STATUS` of PX4: flags and test ratios of the estimator.

use mavlink::dialects::ardupilotmega::{
    EKF_STATUS_REPORT_DATA, ESTIMATOR_STATUS_DATA, EstimatorStatusFlags,
};

use super::HandlerNotices;
use crate::alert::AlertKind;
use crate::text;
use crate::vehicle::{Ekf, EkfFlags, Severity, Vehicle};

/// The flags that have the same bits in both messages.
const SHARED_FLAGS: u16 = 0x03ff;

/// Applies `EKF_STATUS_REPORT`, with a notice when the filter loses or finds its global position.
pub(super) fn apply(
    vehicle: &mut Vehicle,
    data: &EKF_STATUS_REPORT_DATA,
    report: &mut HandlerNotices<'_>,
) {
    let ekf = Ekf {
        flags: EkfFlags(data.flags.bits()),
        velocity_variance: data.velocity_variance,
        position_horizontal_variance: data.pos_horiz_variance,
        position_vertical_variance: data.pos_vert_variance,
        compass_variance: data.compass_variance,
        at: report.now,
    };
    note(vehicle, ekf, report);
}

/// Applies `ESTIMATOR_STATUS` as [`apply`] does with ArduPilot's message.
pub(super) fn apply_estimator(
    vehicle: &mut Vehicle,
    data: &ESTIMATOR_STATUS_DATA,
    report: &mut HandlerNotices<'_>,
) {
    let glitch = EstimatorStatusFlags::ESTIMATOR_GPS_GLITCH;
    let glitching = if data.flags.contains(glitch) {
        EkfFlags::GPS_GLITCHING
    } else {
        0
    };
    let ekf = Ekf {
        flags: EkfFlags(data.flags.bits() & SHARED_FLAGS | glitching),
        velocity_variance: data.vel_ratio,
        position_horizontal_variance: data.pos_horiz_ratio,
        position_vertical_variance: data.pos_vert_ratio,
        compass_variance: data.mag_ratio,
        at: report.now,
    };
    note(vehicle, ekf, report);
}

fn note(vehicle: &mut Vehicle, ekf: Ekf, report: &mut HandlerNotices<'_>) {
    let Some(before) = vehicle.ekf.replace(ekf) else {
        return;
    };
    let knows = |ekf: Ekf| ekf.flags.has(EkfFlags::POSITION_HORIZONTAL_ABSOLUTE);
    match (knows(before), knows(ekf)) {
        (true, false) => {
            report.alert(Severity::Error, AlertKind::Ekf, text!("heard-ekf-lost"));
        }
        (false, true) => report.say(Severity::Notice, text!("heard-ekf-good")),
        _ => {}
    }
}
