//! The telemetry of a rehearsal as a file.

use std::fs::File;
use std::io::{self, BufWriter};
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use super::super::{Failure, invalid};
use super::Cast;
use crate::link::RehearsalTape;
use crate::rehearsal::{Outcome, RehearsalError, rehearse_heard};
use crate::text;
use crate::text::Locale;

/// The largest number of a vehicle.
const SYSTEMS: u8 = 250;

/// Rehearses, and writes the telemetry of all vehicles to a new file.
///
/// # Errors
/// The file cannot be written, or exists already.
pub(super) fn rehearse_into(
    path: &Path,
    cast: &Cast,
    locale: &Locale,
) -> Result<Result<Outcome, RehearsalError>, Failure> {
    let fault = |error: &io::Error| {
        let (path, reason) = (path.display().to_string(), error.to_string());
        invalid(
            &text!("plan-rehearse-tlog", path = path, reason = reason),
            locale,
        )
    };
    let file = File::create_new(path).map_err(|error| fault(&error))?;
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    let begun_us = since.map_or(0, |since| since.as_micros() as u64);
    let systems = (1..=SYSTEMS).cycle().take(cast.participants.len());
    let mut tape = RehearsalTape::new(BufWriter::new(file), systems, begun_us);
    let outcome = rehearse_heard(&cast.participants, &cast.conditions, &mut |heard| {
        tape.take(heard);
    });
    tape.finish().map_err(|error| fault(&error))?;
    Ok(outcome)
}
