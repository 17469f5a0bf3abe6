//! The telemetry of a rehearsal as a recording.

use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use super::TlogWriter;
use crate::rehearsal::Heard;
use crate::sim::SYSTEMS;
use crate::vehicle_id::VehicleId;
use crate::wire::{Content, Decoder, Encoder, SystemId};

/// Writes the frames that the vehicles of a rehearsal send, each as a system of its own, to a file
/// that appears when it is complete.
#[derive(Debug)]
pub struct RehearsalTape {
    log: TlogWriter<BufWriter<File>>,
    vehicles: Vec<(Decoder, Encoder)>,
    /// The time of day at which the rehearsal begins, in microseconds since 1970 (UTC).
    begun_us: u64,
    is_empty: bool,
    fault: Option<io::Error>,
    /// The file being written.
    part: PathBuf,
    path: PathBuf,
}

impl RehearsalTape {
    /// Begins a recording of vehicles with these numbers.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn begin(
        path: &Path,
        vehicles: impl IntoIterator<Item = VehicleId>,
        begun: SystemTime,
    ) -> io::Result<Self> {
        let mut part = path.as_os_str().to_owned();
        part.push(".part");
        let part = PathBuf::from(part);
        let vehicles = vehicles.into_iter().map(|vehicle| {
            let encoder = Encoder::new(system(vehicle), VEHICLE_COMPONENT);
            (Decoder::new(), encoder)
        });
        let since = begun.duration_since(UNIX_EPOCH);
        Ok(Self {
            log: TlogWriter::new(BufWriter::new(File::create(&part)?)),
            vehicles: vehicles.collect(),
            begun_us: since.map_or(0, |since| since.as_micros() as u64),
            is_empty: true,
            fault: None,
            part,
            path: path.to_owned(),
        })
    }

    /// Adds the frames that a vehicle has sent.
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
            self.is_empty = false;
            self.fault = self.fault.take().or(written.err());
        }
    }

    /// Ends the recording, which replaces an earlier one. A rehearsal in which nothing was heard leaves no file.
    ///
    /// # Errors
    /// The first error of the file.
    pub fn finish(mut self) -> io::Result<()> {
        let written = match self.fault.take() {
            Some(fault) => Err(fault),
            None => self.log.flush(),
        };
        if written.is_err() || self.is_empty {
            let removed = fs::remove_file(&self.part);
            return written.and(removed);
        }
        fs::rename(&self.part, &self.path)
    }
}

/// The system id of a vehicle, as in the simulator: a larger swarm repeats them.
fn system(vehicle: VehicleId) -> SystemId {
    let index = usize::from(vehicle.max(1) - 1) % SYSTEMS;
    index as SystemId + 1
}

const VEHICLE_COMPONENT: u8 = 1;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_vehicle_has_the_system_id_of_a_ground_station() {
        let systems: Vec<SystemId> = [1, 254, 255, 508, 509].map(system).to_vec();
        assert_eq!(systems, [1, 254, 1, 254, 1]);
    }
}
