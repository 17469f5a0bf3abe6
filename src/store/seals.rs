//! Seals of exams: the result of a try beside its record, signed with the key of the desk.

use std::fs;
use std::io;
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};
use std::time::{Duration, UNIX_EPOCH};

use sha2::{Digest as _, Sha256};

use super::class_records::RecordOwner;
use super::hashes::{hex, sha256_of};
use super::records::ending_of;
use super::regular::read_regular_text;
use super::runs::utc;
use super::signature::{self, RecordKey, RecordPublicKey, SignatureError};
use super::{ClassRecords, KeptRecord, RecordFiles};
use crate::class::{
    CandidateTry, Exam, RecordName, RecordPart, RecordShelf as _, SubmittedPart, Witness,
    WrittenRecord,
};
use crate::class_results::ClassFlight;
use crate::exam_seal::{SEAL, Seal, SealCheck, SealFault, TryReason};
use crate::mission::Stake;
use crate::mission::record::{Stored, time_of_line};
use crate::scoring::MissionFile;

/// The folder of the desk's key in a data folder.
const DESK_KEY: &str = "desk-key";
/// The suffix of a seal.
const SEAL_ENDING: &str = ".seal.json";
/// The maximum size of a seal, in bytes.
const LONGEST: u64 = 256 * 1024;
/// All permissions of users other than the owner.
const OTHERS: u32 = 0o077;
/// The number of digits of a fingerprint.
const FINGERPRINT: usize = 32;

/// The key with which a desk seals.
#[derive(Debug)]
pub struct DeskKey {
    key: RecordKey,
    public: String,
}

impl DeskKey {
    /// The key in a data folder; it is created at first use.
    ///
    /// # Errors
    /// It cannot be read or written, or others can read it.
    pub fn open(data: &Path) -> Result<Self, SignatureError> {
        let folder = data.join(DESK_KEY);
        if !signature::secret_key_in(&folder).exists() {
            match RecordKey::create(&folder, false) {
                // Another desk was faster.
                Ok(_) | Err(SignatureError::Exists(_)) => {}
                Err(error) => return Err(error),
            }
        }
        let path = signature::secret_key_in(&folder);
        require_private(&path)?;
        let key = RecordKey::read(&path)?;
        let public = key.public(&path)?;
        if Self::public_in(data) != Some(public.text()) {
            // The desk that made the key was killed before it had written both files.
            public.write(&folder)?;
        }
        Ok(Self {
            key,
            public: public.text(),
        })
    }

    /// The public key in a data folder, if there is one.
    pub fn public_in(data: &Path) -> Option<String> {
        let path = signature::public_key_in(&data.join(DESK_KEY));
        let text = fs::read_to_string(path).ok()?;
        Some(text.lines().nth(1)?.trim().to_owned())
    }

    /// The public key, in the format of minisign.
    pub fn public(&self) -> &str {
        &self.public
    }

    /// The fingerprint of a public key.
    pub fn fingerprint(public: &str) -> String {
        let hash = hex(Sha256::digest(public.as_bytes()));
        let digits: Vec<char> = hash.chars().take(FINGERPRINT).collect();
        let groups = digits.chunks(4).map(|group| group.iter().collect());
        groups.collect::<Vec<String>>().join(" ")
    }
}

fn require_private(path: &Path) -> Result<(), SignatureError> {
    let file = |error| SignatureError::File {
        path: path.to_owned(),
        error,
    };
    let mode = fs::metadata(path).map_err(file)?.permissions().mode();
    if mode & OTHERS == 0 {
        return Ok(());
    }
    let why = format!(
        "its mode is {:04o}, so others can use it; chmod 600",
        mode & 0o777
    );
    Err(SignatureError::Key {
        path: path.to_owned(),
        why,
    })
}

/// A try whose record is complete at the desk.
pub struct SealedTry<'a> {
    pub class: &'a str,
    pub exam: &'a Exam,
    pub flown: &'a CandidateTry,
    pub kept: &'a KeptRecord,
    pub flight: &'a ClassFlight,
    /// When the record was complete, in seconds since 1970.
    pub handed_in: u64,
}

/// Seals a try. The seal of a record is never replaced.
///
/// # Errors
/// The record cannot be read, or the seal cannot be written.
pub fn seal_record(
    records: &ClassRecords,
    sealed: &SealedTry<'_>,
    key: &DeskKey,
) -> Result<(), SignatureError> {
    // One without a signature is left from a crash.
    if is_sealed(&sealed.kept.files) {
        return Ok(());
    }
    let run = sealed.kept.files.run.as_deref().unwrap_or(Path::new(""));
    let file = |error| SignatureError::File {
        path: run.to_owned(),
        error,
    };
    let content = fs::read(run).map_err(file)?;
    let record = RecordName::try_from(sealed.flight.record.clone())
        .map_err(|error| file(io::Error::other(error)))?;
    let submission = records
        .kept(&sealed.kept.user, &record)
        .map_err(|fault| file(io::Error::other(fault.0)))?
        .ok_or_else(|| file(io::ErrorKind::NotFound.into()))?;
    let written = WrittenRecord {
        name: &record,
        content: &content,
        time_of: time_of_line,
    };
    let stored = stored_in(&content);
    let seen = SeenRecord {
        witness: Witness::of(sealed.flown, &written),
        has_checksum: has_checksum(stored.as_ref()),
        was_left: stored.is_some_and(|it| it.was_left()),
        parts: submission.parts,
    };
    let seal = seal(sealed, seen, key);
    let path = seal_path(run, &seal.record);
    let text = serde_json::to_string_pretty(&seal).map_err(|error| file(error.into()))?;
    super::write(&path, &text, true).map_err(|error| file(io::Error::other(error.to_string())))?;
    let about = format!("exam:{}\tuser:{}", seal.exam, seal.user);
    signature::sign(&path, &key.key, &about)?;
    Ok(())
}

/// The record in a file, if it can be read.
fn stored_in(content: &[u8]) -> Option<Stored> {
    let text = std::str::from_utf8(content).ok()?;
    Stored::read(text).ok()
}

/// Whether the end of a record has a checksum. A record without an end was cut off, and has none.
fn has_checksum(stored: Option<&Stored>) -> bool {
    stored.is_some_and(|it| it.end().is_none() || it.has_checksum())
}

/// What is known of a record from the outside.
struct SeenRecord {
    witness: Witness,
    /// Whether its end has a checksum, if it has an end.
    has_checksum: bool,
    /// Whether the flight was left before the mission was over.
    was_left: bool,
    /// The files of the record, with their hashes.
    parts: Vec<SubmittedPart>,
}

impl SeenRecord {
    /// The length of the record of the mission, in bytes.
    fn length(&self) -> u64 {
        let mut parts = self.parts.iter();
        let run = parts.find(|it| it.part == RecordPart::Run);
        run.map_or(0, |it| it.bytes)
    }
}

fn seal(sealed: &SealedTry<'_>, seen: SeenRecord, key: &DeskKey) -> Seal {
    let SealedTry {
        exam,
        flown,
        flight,
        ..
    } = sealed;
    let moment = |seconds: u64| {
        let time = UNIX_EPOCH.checked_add(Duration::from_secs(seconds));
        utc(time.unwrap_or(UNIX_EPOCH))
    };
    let mut missions = exam.plan().missions.iter();
    let mission = missions.find(|it| it.mission == flown.name.mission);
    let reasons = reasons(sealed, &seen);
    Seal {
        sortie_seal: SEAL,
        class: sealed.class.to_owned(),
        exam: exam.plan().name.to_string(),
        exam_sha256: exam.file().as_str().to_owned(),
        begun: moment(exam.begun()),
        user: sealed.kept.user.clone(),
        mission: flown.name.mission.to_string(),
        number: flown.name.number,
        tries: mission.map_or(0, |it| it.tries),
        openings: u32::try_from(flown.openings.len()).unwrap_or(u32::MAX),
        seed: flight.seed,
        record: flight.record.clone(),
        files: seen.parts,
        score: flight.flight.score,
        passed: flight.flight.passed,
        opened: flown.opened.map(moment),
        until: moment(flown.opening().until),
        ended: flown.ended.map(|(at, _)| moment(at)),
        handed_in: moment(sealed.handed_in),
        reasons,
        witness: seen.witness,
        public_key: key.public.clone(),
    }
}

fn reasons(sealed: &SealedTry<'_>, seen: &SeenRecord) -> Vec<TryReason> {
    let (flown, witness, length) = (sealed.flown, &seen.witness, seen.length());
    let flight = &sealed.flight.flight;
    let by_hand = flight.flown_by.unwrap_or_default().is_by_hand();
    let is_course = sealed.flight.mission_file == Some(MissionFile::Course);
    let mission_time = Duration::try_from_secs_f64(sealed.flight.sim_time_s).unwrap_or_default();
    let is_mission = flight.mission == flown.name.mission.as_str();
    let mut parts = seen.parts.iter();
    let has_inputs = parts.any(|it| it.part == RecordPart::Inputs);
    let is_late = Exam::is_late(flown, length, mission_time);
    // What follows the last head may have been written by anyone.
    let is_end_known = flown.has_end_seen(length) || flown.was_desk_away;
    let found = [
        (flight.stake != Stake::Exam, TryReason::NoExam),
        (!by_hand, TryReason::Script),
        (!is_course || !is_mission, TryReason::Mission),
        (sealed.flight.has_own_fleet, TryReason::Fleet),
        (sealed.flight.has_pause, TryReason::Paused),
        (!has_inputs, TryReason::NoInputs),
        (is_late, TryReason::Late),
        (*witness == Witness::Unseen, TryReason::Unseen),
        (
            !witness.fits() && *witness != Witness::Unseen,
            TryReason::Rewritten,
        ),
        (seen.was_left, TryReason::Left),
        // A console ends with a flight that is left, so that its end is never seen.
        (
            witness.fits() && !is_end_known && !seen.was_left,
            TryReason::EndUnseen,
        ),
        (!seen.has_checksum, TryReason::NoChecksum),
    ];
    let reasons = found.into_iter().filter(|(holds, _)| *holds);
    reasons.map(|(_, reason)| reason).collect()
}

/// Whether a record has a signed seal, which may be that of another key: it is not replaced.
pub fn is_sealed(files: &RecordFiles) -> bool {
    let Some(run) = files.run.as_deref() else {
        return false;
    };
    let signature = signature::check(&seal_path(run, &files.stem), None);
    matches!(signature, Some(Ok(_)))
}

fn seal_path(run: &Path, record: &str) -> PathBuf {
    run.with_file_name(format!("{record}{SEAL_ENDING}"))
}

/// Checks the seal beside a record; `None` if there is none. `expected` is the public key that must have made it.
pub fn check_seal(files: &RecordFiles, expected: Option<&str>) -> Option<SealCheck> {
    let run = files.run.as_deref().or(files.inputs.as_deref())?;
    let path = seal_path(run, &files.stem);
    let text = match read_regular_text(&path, LONGEST) {
        Ok(text) => text,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return None,
        Err(error) => return Some(SealCheck::faulty(SealFault::Unreadable(error.to_string()))),
    };
    let Ok(seal) = serde_json::from_str::<Seal>(&text) else {
        return Some(SealCheck::faulty(SealFault::Damaged));
    };
    let is_known_key = expected.map(|key| key == seal.public_key);
    Some(SealCheck {
        fingerprint: Some(DeskKey::fingerprint(&seal.public_key)),
        is_known_key,
        fault: fault_of(&seal, &path, files, is_known_key).err(),
        seal: Some(seal),
    })
}

fn fault_of(
    seal: &Seal,
    path: &Path,
    files: &RecordFiles,
    is_known_key: Option<bool>,
) -> Result<(), SealFault> {
    let key = RecordPublicKey::from_text(&seal.public_key).ok_or(SealFault::Damaged)?;
    match signature::check(path, Some(&key)) {
        None => return Err(SealFault::Unsigned),
        Some(Err(_)) => return Err(SealFault::Signature),
        Some(Ok(_)) => {}
    }
    if is_known_key == Some(false) {
        return Err(SealFault::OtherKey);
    }
    if seal.record != files.stem {
        return Err(SealFault::OtherRecord(seal.record.clone()));
    }
    if let Some(owner) = RecordOwner::of(path) {
        if !owner.is_user(&seal.user) {
            return Err(SealFault::OtherUser(seal.user.clone()));
        }
        if !owner.is_class(&seal.class) {
            return Err(SealFault::OtherClass(seal.class.clone()));
        }
    }
    check_files(seal, path, files)
}

/// Compares the files of a record with the hashes in its seal.
fn check_files(seal: &Seal, path: &Path, files: &RecordFiles) -> Result<(), SealFault> {
    for part in RecordPart::ALL {
        let name = format!("{}{}", files.stem, ending_of(part));
        let is_sealed = seal.files.iter().any(|sealed| sealed.part == part);
        if !is_sealed && path.with_file_name(&name).exists() {
            return Err(SealFault::NotSealed(name));
        }
    }
    for sealed in &seal.files {
        let name = format!("{}{}", files.stem, ending_of(sealed.part));
        match sha256_of(&path.with_file_name(&name)) {
            Ok(hash) if hash == sealed.sha256 => {}
            Ok(_) => return Err(SealFault::Changed(name)),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                return Err(SealFault::Missing(name));
            }
            Err(error) => return Err(SealFault::Unreadable(error.to_string())),
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
