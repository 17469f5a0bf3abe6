//! `GPS_RAW_INT`: fix, satellites and accuracy.

use mavlink::dialects::ardupilotmega::GPS_RAW_INT_DATA;

use super::HandlerNotices;
use crate::alert::AlertKind;
use crate::text;
use crate::vehicle::{FixType, Gps, GpsAccuracy, Severity, Vehicle};

/// Applies `GPS_RAW_INT`, with a notice when the fix is lost or found. Its position is ignored:
/// before the fix, it is arbitrary.
pub(super) fn apply(
    vehicle: &mut Vehicle,
    data: &GPS_RAW_INT_DATA,
    report: &mut HandlerNotices<'_>,
) {
    let gps = Gps {
        fix: FixType::from_wire(data.fix_type as u8),
        satellites: (data.satellites_visible != u8::MAX).then_some(data.satellites_visible),
        hdop: (data.eph != u16::MAX).then(|| f32::from(data.eph) * 0.01),
        at: report.now,
    };
    // Senders without the extension fields give 0, and others give the end of the range for an unknown accuracy.
    let is_known = |accuracy| !matches!(accuracy, 0 | u32::MAX);
    // Without a fix, some receivers repeat the last accuracy or a constant.
    let is_fixed = gps.fix >= FixType::Fix2d;
    let is_given = is_known(data.h_acc) && is_known(data.v_acc);
    vehicle.gps_accuracy = (is_given && is_fixed).then_some(GpsAccuracy {
        horizontal_m: data.h_acc as f32 * 1e-3,
        vertical_m: data.v_acc as f32 * 1e-3,
    });
    let Some(before) = vehicle.gps.replace(gps) else {
        return;
    };
    match (locates(before.fix), locates(gps.fix)) {
        (true, false) => report.alert(
            Severity::Warning,
            AlertKind::Gps,
            text!("heard-fix-lost", fix = gps.fix.text()),
        ),
        (false, true) => report.say(Severity::Notice, text!("heard-fix", fix = gps.fix.text())),
        _ => {}
    }
}

/// Whether a fix gives a position in three dimensions.
fn locates(fix: FixType) -> bool {
    fix >= FixType::Fix3d
}
