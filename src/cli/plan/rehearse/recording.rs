//! The telemetry of a rehearsal as a file.

use std::fs::File;
use std::io::{self, BufWriter};
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use super::super::{Failure, invalid};
use super::Cast;
use crate::link::TlogWriter;
use crate::rehearsal::{Heard, Outcome, RehearsalError, rehearse_heard};
use crate::text;
use crate::text::Locale;
use crate::wire::Decoder;

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
    let mut tape = Tape::new(file, cast.participants.len());
    let outcome = rehearse_heard(&cast.participants, &cast.conditions, &mut |heard| {
        tape.take(heard);
    });
    tape.finish().map_err(|error| fault(&error))?;
    Ok(outcome)
}

/// Splits telemetry into frames and writes them with their times.
struct Tape {
    log: TlogWriter<BufWriter<File>>,
    decoders: Vec<Decoder>,
    /// The time of day at which the rehearsal begins, in microseconds since 1970 (UTC).
    begun_us: u64,
    fault: Option<io::Error>,
}

impl Tape {
    fn new(file: File, vehicles: usize) -> Self {
        let since = SystemTime::now().duration_since(UNIX_EPOCH);
        Self {
            log: TlogWriter::new(BufWriter::new(file)),
            decoders: (0..vehicles).map(|_| Decoder::new()).collect(),
            begun_us: since.map_or(0, |since| since.as_micros() as u64),
            fault: None,
        }
    }

    fn take(&mut self, heard: Heard<'_>) {
        let Some(decoder) = self.decoders.get_mut(heard.vehicle) else {
            return;
        };
        let at_us = self.begun_us + (heard.at_s * 1e6) as u64;
        decoder.push(heard.bytes);
        while let Some(frame) = decoder.next_frame() {
            let written = self.log.write(at_us, decoder.bytes_of(&frame));
            self.fault = self.fault.take().or(written.err());
        }
    }

    fn finish(mut self) -> io::Result<()> {
        match self.fault {
            Some(fault) => Err(fault),
            None => self.log.flush(),
        }
    }
}
