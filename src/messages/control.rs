//! `CONTROL_STATUS`: the ground station in control of a vehicle. The dialect lacks the message, so it is read by hand.

use super::HandlerNotices;
use crate::text;
use crate::vehicle::{ControlStatus, Severity, Vehicle};

/// The flag of a status for the whole vehicle.
const SYSTEM_MANAGER: u8 = 1;
const TAKEOVER_ALLOWED: u8 = 2;

pub(super) fn apply(vehicle: &mut Vehicle, payload: &[u8], report: &mut HandlerNotices<'_>) {
    let [flags, owner, others @ ..] = payload else {
        return;
    };
    if flags & SYSTEM_MANAGER == 0 {
        return;
    }
    let mut list = [0; 10];
    for (other, heard) in list.iter_mut().zip(others) {
        *other = *heard;
    }
    let status = ControlStatus {
        owner: Some(*owner).filter(|owner| *owner != 0),
        others: list,
        takeover: flags & TAKEOVER_ALLOWED != 0,
    };
    let before = vehicle.control.replace(status);
    if before.is_none_or(|before| before.owner == status.owner) {
        return;
    }
    match status.owner {
        None => report.say(Severity::Info, text!("heard-control-free")),
        Some(owner) if owner == vehicle.station => {
            report.say(Severity::Info, text!("heard-control-ours"));
        }
        Some(owner) => report.say(
            Severity::Warning,
            text!("heard-control-theirs", station = owner),
        ),
    }
}
