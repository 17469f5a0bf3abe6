//! The step from a finished flight to its entry in a career, and the recovery of runs that a killed
//! program recorded but did not store.
//!
//! The record of a run is written line by line, its end last; only then is it stored in the
//! profile. If the program is killed in between, the next start recovers it: a finished record that
//! is missing from its profile is scored again and stored. The record of a flight that counts but
//! has no end, because the program was killed or the terminal disappeared, is stored too, and
//! counts as left early: otherwise killing the program would avoid the entry that `leave` makes.
//!
//! A record is an untrusted file. Its stake is kept only if the career allows it: the mission is
//! that of the course and open to the trainee, an exam has its seed, and the flight, repeated from
//! the record's inputs, matches. Anything else is practice.

use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use super::append::is_written;
use super::runs::{ENDING, outline, run_id};
use super::{Profile, ProfileError, Profiles, RecordFiles, Rescue, RunEntry, Runs, read_run, utc};
use crate::campaign::{
    AttemptTrainee, CareerFlight, CareerStanding, FlightClaim, PracticeReason, SettledFlight,
    Stake, is_practice, without_end,
};
use crate::mission::Mission;
use crate::mission::record::{Head, Stored};
use crate::record::{InstructorPart, StoredInputs};
use crate::scoring::Report;
use crate::text;
use crate::text::Text;
use crate::workshop::Design;

const DAY_S: u64 = 24 * 60 * 60;

/// Facts about a finished flight that are not part of the flight itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Landing {
    /// The unique id of the run: [`RunFile::id`](super::RunFile::id).
    pub id: String,
    /// Whether the flight's record is complete.
    pub is_recorded: bool,
    pub when: SystemTime,
    pub stake: Stake,
}

/// Days since 1970 in UTC.
pub fn day_of(time: SystemTime) -> i64 {
    let since = time.duration_since(UNIX_EPOCH).unwrap_or_default();
    i64::try_from(since.as_secs() / DAY_S).unwrap_or(i64::MAX)
}

impl RunEntry {
    /// The profile's entry for a finished flight: the mission as flown, and its report.
    pub fn of(mission: &Mission, report: &Report, landing: Landing) -> Self {
        Self {
            when: utc(landing.when),
            flight: CareerFlight::of(mission, report, landing.stake, day_of(landing.when)),
            // The shell's additions apply only when the report is shown.
            report: Report {
                instructor: InstructorPart::default(),
                drill: None,
                tries: Vec::new(),
                wall_time_s: None,
                ..report.clone()
            },
            airframes: mission.fleet().iter().map(Design::to_toml).collect(),
            recording: (landing.is_recorded).then(|| format!("{}{ENDING}", landing.id)),
            id: landing.id,
        }
    }
}

/// A recorded run that was missing from its profile, and was recovered.
#[derive(Debug, Clone, PartialEq)]
pub struct Recovery {
    pub profile: String,
    pub mission: String,
    pub score: u16,
    /// How the run counts, if it was left unfinished.
    pub left: Option<LeftFlight>,
    /// Why the run counts for less than its record claims; empty if it does not.
    pub reduced: Vec<PracticeReason>,
}

/// An unfinished flight that counts as ended where its record ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LeftFlight {
    Exam,
    /// An attempt at a mission other than an exam.
    Attempt,
}

impl Recovery {
    pub fn text(&self) -> Text {
        let profile = self.profile.as_str();
        let mission = self.mission.as_str();
        let score = self.score;
        let recovered = match self.left {
            Some(LeftFlight::Exam) => text!(
                "profiles-left-exam",
                profile = profile,
                mission = mission,
                score = score
            ),
            Some(LeftFlight::Attempt) => text!(
                "profiles-left-attempt",
                profile = profile,
                mission = mission,
                score = score
            ),
            None => text!(
                "profiles-recovered",
                profile = profile,
                mission = mission,
                score = score
            ),
        };
        if self.reduced.is_empty() {
            return recovered;
        }
        Text::joined(
            "; ",
            vec![recovered, PracticeReason::sentence(&self.reduced)],
        )
    }
}

/// Opens the profiles of a data folder and recovers unfinished work; the texts report it.
///
/// # Errors
/// The profiles cannot be opened; see [`Profiles::open`].
pub fn open_profiles(data: &Path) -> Result<(Profiles, Vec<Text>), ProfileError> {
    let (profiles, rescue) = Profiles::open(data)?;
    completed(data, profiles, rescue.as_ref())
}

/// As [`open_profiles`], for commands that only read: a missing folder is not created.
///
/// # Errors
/// The profiles cannot be opened; see [`Profiles::open_to_read`].
pub fn open_profiles_to_read(data: &Path) -> Result<(Profiles, Vec<Text>), ProfileError> {
    let (profiles, rescue) = Profiles::open_to_read(data)?;
    completed(data, profiles, rescue.as_ref())
}

/// Recovers unfinished work, if the profiles can be written.
fn completed(
    data: &Path,
    mut profiles: Profiles,
    rescue: Option<&Rescue>,
) -> Result<(Profiles, Vec<Text>), ProfileError> {
    let mut told: Vec<Text> = rescue.into_iter().map(Rescue::text).collect();
    if profiles.is_read_only() {
        return Ok((profiles, told));
    }
    told.extend(profiles.mend()?.text());
    let recovered = recover(&mut profiles, &Runs::within(data))?;
    told.extend(recovered.iter().map(Recovery::text));
    Ok((profiles, told))
}

/// Stores the finished runs of a folder that are missing from their profiles, and the unfinished
/// runs that count, each once even if several consoles start together. If no run is missing, only
/// file names are read, and the first and last lines of records without a profile.
///
/// # Errors
/// The database cannot be read or written; entries stored before that stay.
pub fn recover(profiles: &mut Profiles, runs: &Runs) -> Result<Vec<Recovery>, ProfileError> {
    let others = runs.others(&profiles.run_ids()?);
    let everybody = profiles.list()?;
    let mut recovered = Vec::new();
    for path in others {
        let Some(left) = LeftRun::read(&path, &everybody) else {
            continue;
        };
        let standing = CareerStanding::of(&profiles.history(left.profile)?);
        let settled = left.settle(&standing);
        let run = left.entry(settled.stake);
        if profiles.store(left.profile, &run)? {
            recovered.push(Recovery {
                profile: left.profile.name.clone(),
                mission: run.flight.mission,
                score: run.flight.score,
                left: left.left,
                reduced: settled.reduced,
            });
        }
    }
    Ok(recovered)
}

/// A recorded run that is missing from its trainee's profile.
struct LeftRun<'a> {
    profile: &'a Profile,
    head: Head,
    mission: Mission,
    report: Report,
    id: String,
    /// When its record was last written.
    when: SystemTime,
    left: Option<LeftFlight>,
    /// Whether the flight, repeated from the files beside the record, matches it. A flight that was
    /// left early gains nothing, so it is not repeated.
    is_confirmed: bool,
}

impl<'a> LeftRun<'a> {
    /// Reads a record; `None` if it belongs to none of these profiles, or is still being written. A
    /// profile created after the record does not count, even if it has the same name.
    fn read(path: &Path, everybody: &'a [Profile]) -> Option<Self> {
        let (head, end) = outline(path).ok()?;
        let left = match end {
            Some(_) => None,
            None => Some(left(&head).filter(|_| !is_written(path))?),
        };
        let name = head.profile.as_deref()?;
        let profile = everybody
            .iter()
            .find(|it| it.name.eq_ignore_ascii_case(name) && it.since <= head.when)?;
        let when = path.metadata().and_then(|file| file.modified()).ok()?;
        let stored = Stored::read(&read_run(path).ok()?).ok()?;
        match left {
            None => {
                stored.end()?;
            }
            Some(LeftFlight::Attempt) if !stored.is_open() => return None,
            Some(LeftFlight::Attempt | LeftFlight::Exam) => {}
        }
        let without_end = without_end(head.stake, head.flown_by);
        let mut report = stored.rescore(without_end).ok()?.report;
        // A flight has not begun if only its brief was read.
        if left.is_some() && report.sim_time_s <= 0.0 {
            return None;
        }
        let mission = stored.head.flown().ok()?;
        super::complete(&mut report, &mission);
        Some(Self {
            profile,
            head,
            mission,
            report,
            id: run_id(path).to_owned(),
            when,
            left,
            is_confirmed: left.is_some() || is_confirmed(path, &stored),
        })
    }

    /// How the flight counts, given the state of the career.
    fn settle(&self, standing: &CareerStanding) -> SettledFlight {
        let claim = FlightClaim {
            mission: &self.mission,
            stake: self.head.stake,
            seed: self.head.seed,
            mission_file: Some(super::mission_file(&self.mission)),
            flown_by: self.head.flown_by,
            ended: day_of(self.when),
            is_confirmed: self.is_confirmed,
        };
        claim.settle(AttemptTrainee {
            standing,
            course: &super::course(),
            exams: self.profile.exam_key(),
        })
    }

    fn entry(&self, stake: Stake) -> RunEntry {
        let landing = Landing {
            id: self.id.clone(),
            is_recorded: true,
            when: self.when,
            stake,
        };
        RunEntry::of(&self.mission, &self.report, landing)
    }
}

/// How a flight without an end counts; `None` if it does not count.
fn left(head: &Head) -> Option<LeftFlight> {
    if is_practice(head.stake, head.flown_by) {
        return None;
    }
    Some(match head.stake {
        Stake::Exam => LeftFlight::Exam,
        Stake::Graded | Stake::Daily | Stake::Practice => LeftFlight::Attempt,
    })
}

/// Whether a flight, repeated from the files beside its record, matches the recorded run.
fn is_confirmed(path: &Path, stored: &Stored) -> bool {
    let files = RecordFiles::beside(path);
    let inputs = files.inputs.as_deref().and_then(|inputs| {
        let text = read_run(inputs).ok()?;
        StoredInputs::read(&text).ok()
    });
    stored.is_confirmed(files.head().ok().as_ref(), inputs.as_ref())
}

#[cfg(test)]
mod tests;
