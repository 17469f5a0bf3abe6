//! The recording of the last rehearsal, which `replay rehearsal` plays.

use std::fs;
use std::io;
use std::time::{Duration, SystemTime};

use crate::link::RehearsalTape;
use crate::notice::Notice;
use crate::rehearsal::Heard;
use crate::store::Records;
use crate::text;
use crate::vehicle::{Severity, VehicleId};

/// Begins a recording that replaces the one before it; `None` if flights are not recorded.
fn begin(records: Option<&Records>, vehicles: &[VehicleId]) -> io::Result<Option<RehearsalTape>> {
    let Some(records) = records else {
        return Ok(None);
    };
    fs::create_dir_all(records.folder())?;
    let vehicles = vehicles.iter().copied();
    RehearsalTape::begin(&records.rehearsal(), vehicles, SystemTime::now()).map(Some)
}

/// Flies a rehearsal and records it; returns its result with the notice about the recording, if
/// there is one.
pub(super) fn recorded<R>(
    records: Option<&Records>,
    vehicles: &[VehicleId],
    fly: impl FnOnce(&mut dyn FnMut(Heard<'_>)) -> R,
) -> (R, Option<Notice>) {
    let begun = begin(records, vehicles);
    let (mut recording, begun) = match begun {
        Ok(recording) => (recording, Ok(())),
        Err(error) => (None, Err(error)),
    };
    let result = fly(&mut |heard| {
        if let Some(recording) = &mut recording {
            recording.take(heard);
        }
    });
    let is_recorded = recording.is_some();
    let written = begun.and_then(|()| recording.map_or(Ok(()), RehearsalTape::finish));
    let (severity, text) = match written {
        Ok(()) if !is_recorded => return (result, None),
        Ok(()) => (Severity::Info, text!("rehearse-replay")),
        Err(error) => {
            let reason = error.to_string();
            (
                Severity::Warning,
                text!("rehearse-unwritten", reason = reason),
            )
        }
    };
    let notice = Notice::general(Duration::ZERO, severity, text);
    (result, Some(notice))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::{Document, Home, Item, command};
    use crate::rehearsal::{Conditions, Participant, rehearse_heard};
    use crate::wire::Decoder;

    /// A short flight straight up and down.
    fn participant() -> Participant {
        let item = |command, z| Item {
            command,
            frame: 3,
            auto_continue: true,
            z,
            ..Item::default()
        };
        let (x, y) = (504_500_000, 305_200_000);
        Participant {
            document: Document {
                home: Some(Home { x, y, z: 170.0 }),
                plan: vec![
                    item(command::TAKEOFF, 5.0),
                    item(command::RETURN_TO_LAUNCH, 0.0),
                ],
                ..Document::default()
            },
            ..Participant::default()
        }
    }

    #[test]
    fn the_last_rehearsal_is_found_by_its_name_with_the_numbers_of_its_vehicles() {
        let folder = tempfile::tempdir().expect("a folder");
        let records = Records::at(folder.path());
        let fly = |listener: &mut dyn FnMut(Heard<'_>)| {
            rehearse_heard(&[participant()], &Conditions::default(), listener)
        };
        for _ in 0..2 {
            let (outcome, notice) = recorded(Some(&records), &[7], fly);
            assert!(outcome.is_ok());
            let notice = notice.expect("a notice");
            assert!(notice.text.to_string().contains("replay rehearsal"));
        }
        let found = Records::find(Some(&records), "rehearsal").expect("the recording");
        let bytes = fs::read(found.frames().expect("frames")).expect("a file");
        let mut decoder = Decoder::new();
        // Each frame follows 8 bytes with its time, which the decoder skips.
        decoder.push(&bytes);
        let frames: Vec<_> = std::iter::from_fn(|| decoder.next_frame()).collect();
        assert!(frames.len() > 100, "{}", frames.len());
        assert!(
            frames
                .iter()
                .filter(|it| it.is_verified())
                .all(|it| it.system == 7)
        );
        assert!(records.list().is_empty(), "it is no record of a flight");
        let (outcome, notice) = recorded(None, &[7], fly);
        assert!(outcome.is_ok() && notice.is_none());
    }
}
