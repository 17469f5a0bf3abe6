//! The flights of a class, scored again from the records that its trainees have handed in.

use std::time::SystemTime;

use super::runs::moment;
use super::{ClassRecords, DeskKey, KeptRecord, check_seal, complete, day_of, read_run};
use crate::campaign::without_end;
use crate::class::Exam;
use crate::class_results::{ClassFlight, ClassTrainee, add_flight};
use crate::exam_seal::SealCheck;
use crate::mission::Mission;
use crate::mission::record::Stored;
use crate::scoring::Report;
use crate::text;
use crate::text::Text;

/// A flight that was scored again.
pub(super) struct RescoredFlight {
    pub stored: Stored,
    pub mission: Mission,
    pub report: Report,
}

/// Scores a flight again from its record.
///
/// # Errors
/// A text if the record cannot be read, or was changed after the flight.
pub(super) fn rescored(kept: &KeptRecord) -> Result<RescoredFlight, Text> {
    let stem = kept.files.stem.as_str();
    let faulty = |fault: Text| {
        let place = format!("{}/{stem}", kept.user);
        Text::joined(": ", vec![place.into(), fault])
    };
    let run = kept.files.run.as_deref();
    let run = run.ok_or_else(|| faulty(text!("ghost-no-run", file = stem)))?;
    let text = read_run(run).map_err(|error| faulty(Text::verbatim(error.to_string())))?;
    let stored = Stored::read(&text).map_err(faulty)?;
    if stored.is_altered() {
        return Err(faulty(text!("verify-altered")));
    }
    let head = &stored.head;
    let mission = head.flown().map_err(faulty)?;
    let again = stored.rescore(without_end(head.stake, head.flown_by));
    let mut report = again.map_err(faulty)?.report;
    complete(&mut report, &mission);
    Ok(RescoredFlight {
        stored,
        mission,
        report,
    })
}

/// A flight from its record. `own_key` is the public key that must have sealed it; the tries of these exams must have a
/// seal.
///
/// # Errors
/// A text if the record cannot be read, or was changed after the flight.
pub fn class_flight(
    kept: &KeptRecord,
    own_key: Option<&str>,
    exams: &[Exam],
) -> Result<ClassFlight, Text> {
    let RescoredFlight {
        stored,
        mission,
        report,
    } = rescored(kept)?;
    let head = &stored.head;
    let began = moment(&head.when).unwrap_or(SystemTime::UNIX_EPOCH);
    let record = kept.files.stem.clone();
    let flight = ClassFlight::of(record, head, &mission, report, day_of(began));
    let mut exams = exams.iter();
    let is_try = exams.any(|exam| exam.try_of(&kept.user, flight.seed).is_some());
    Ok(ClassFlight {
        seal: check_seal(&kept.files, own_key).or_else(|| is_try.then(SealCheck::missing)),
        has_pause: stored.has_pauses(),
        has_end: stored.end().is_some(),
        instructor: kept.files.instructor(),
        ..flight
    })
}

/// The trainees of a class with their flights, and why records cannot be read. The tries of these exams must have a seal.
pub fn class_trainees(records: &ClassRecords, exams: &[Exam]) -> (Vec<ClassTrainee>, Vec<Text>) {
    let mut trainees: Vec<ClassTrainee> = Vec::new();
    let mut faults = Vec::new();
    let own_key = DeskKey::public_in(records.data());
    for kept in records.all() {
        match class_flight(&kept, own_key.as_deref(), exams) {
            Ok(flight) => add_flight(&mut trainees, &kept.user, flight),
            Err(fault) => faults.push(fault),
        }
    }
    (trainees, faults)
}
