//! Joins the log of a vehicle to a recording.

use std::collections::BTreeMap;
use std::time::Duration;

use super::Film;
use super::export::records;
use crate::dataflash::{JoinedLog, LoggedFlight, Misfit, VehicleClock};
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::wire::{AUTOPILOT_COMPONENT, Decoder};

/// Joins a log to a recording. `vehicle` is needed only if the log does not name its vehicle and
/// the recording has several.
///
/// # Errors
/// The file is not a log, `vehicle` is missing or differs from the vehicle that the log names, the
/// vehicle is not in the recording, or the log is from another time.
pub fn join_log(
    film: &Film,
    bytes: &[u8],
    file: &str,
    vehicle: Option<VehicleId>,
) -> Result<JoinedLog, Text> {
    let flight = LoggedFlight::read(bytes)?;
    let clocks = clocks(film)?;
    if let (Some(named), Some(wanted)) = (flight.vehicle, vehicle)
        && named != wanted
    {
        return Err(text!("log-other-vehicle", named = named, wanted = wanted));
    }
    let only = || clocks.keys().next().copied().filter(|_| clocks.len() == 1);
    let Some(vehicle) = vehicle.or(flight.vehicle).or_else(only) else {
        return Err(text!("log-no-vehicle", count = clocks.len()));
    };
    let Some(clock) = clocks.get(&vehicle) else {
        return Err(text!("log-not-in-record", vehicle = vehicle));
    };
    let alignment = clock.align(&flight).map_err(Misfit::text)?;
    let length = film.length();
    Ok(JoinedLog::new(vehicle, file, &flight, &alignment, length))
}

fn clocks(film: &Film) -> Result<BTreeMap<VehicleId, VehicleClock>, Text> {
    let mut clocks: BTreeMap<VehicleId, VehicleClock> = BTreeMap::new();
    for record in records(film)? {
        let mut decoder = Decoder::new();
        decoder.push(&record.bytes);
        let Some(frame) = decoder.next_frame() else {
            continue;
        };
        if frame.component != AUTOPILOT_COMPONENT {
            continue;
        }
        let at_us = record.unix_us.saturating_sub(film.began_unix_us());
        let clock = clocks.entry(VehicleId::from(frame.system)).or_default();
        clock.hear(&frame, Duration::from_micros(at_us));
    }
    Ok(clocks)
}
