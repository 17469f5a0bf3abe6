//! `EKF_STATUS_REPORT`: flags and test ratios of the estimator.

use mavlink::dialects::ardupilotmega::EKF_STATUS_REPORT_DATA;

use super::HandlerNotices;
use crate::alert::AlertKind;
use crate::text;
use crate::vehicle::{Ekf, EkfFlags, Severity, Vehicle};

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
