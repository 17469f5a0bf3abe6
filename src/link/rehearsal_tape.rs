//! The telemetry of a rehearsal as a recording.

use std::io::{self, Write};

use super::TlogWriter;
use crate::rehearsal::Heard;
use crate::wire::{Content, Decoder, Encoder, SystemId};

/// Writes what the vehicles of a rehearsal send, each as a system of its own.
#[derive(Debug)]
pub struct RehearsalTape<W> {
    log: TlogWriter<W>,
    vehicles: Vec<(Decoder, Encoder)>,
    /// The time of day at which the rehearsal begins, in microseconds since 1970 (UTC).
    begun_us: u64,
    fault: Option<io::Error>,
}

impl<W: Write> RehearsalTape<W> {
    /// Begins a recording; `systems` are the numbers of the vehicles.
    pub fn new(output: W, systems: impl IntoIterator<Item = SystemId>, begun_us: u64) -> Self {
        let vehicles = systems.into_iter().map(|system| {
            let encoder = Encoder::new(system, VEHICLE_COMPONENT);
            (Decoder::new(), encoder)
        });
        Self {
            log: TlogWriter::new(output),
            vehicles: vehicles.collect(),
            begun_us,
            fault: None,
        }
    }

    /// Adds what a vehicle has sent.
    pub fn take(&mut self, heard: Heard<'_>) {
        let Some((decoder, encoder)) = self.vehicles.get_mut(heard.vehicle) else {
            return;
        };
        let at_us = self.begun_us + (heard.at_s * 1e6) as u64;
        decoder.push(heard.bytes);
        while let Some(frame) = decoder.next_frame() {
            let Content::Message(message) = &frame.content else {
                continue;
            };
            let mut bytes = Vec::new();
            encoder.encode_message(message, &mut bytes);
            let written = self.log.write(at_us, &bytes);
            self.fault = self.fault.take().or(written.err());
        }
    }

    /// Ends the recording.
    ///
    /// # Errors
    /// The output's first error.
    pub fn finish(mut self) -> io::Result<()> {
        match self.fault {
            Some(fault) => Err(fault),
            None => self.log.flush(),
        }
    }
}

const VEHICLE_COMPONENT: u8 = 1;
