//! The telemetry of a rehearsal as a file.

use std::io::{self, ErrorKind};
use std::path::Path;
use std::time::SystemTime;

use super::super::{Failure, invalid};
use super::Cast;
use crate::link::RehearsalTape;
use crate::rehearsal::{Outcome, RehearsalError, rehearse_heard};
use crate::text;
use crate::text::Locale;

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
    if path.exists() {
        return Err(fault(&ErrorKind::AlreadyExists.into()));
    }
    let vehicles = (1..).take(cast.participants.len());
    let tape = RehearsalTape::begin(path, vehicles, SystemTime::now());
    let mut tape = tape.map_err(|error| fault(&error))?;
    let outcome = rehearse_heard(&cast.participants, &cast.conditions, &mut |heard| {
        tape.take(heard);
    });
    tape.finish().map_err(|error| fault(&error))?;
    Ok(outcome)
}
