//! From a finished flight to what a career keeps of it; and runs that a killed program has recorded but not stored.
//!
//! A run's record is written line by line, its end last; only then the profile gets it. What lies between is made up for
//! at the next start: a finished record that names a profile and that the profile does not have is scored again and stored.

use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use super::runs::{ENDING, outline, run_id};
use super::{Profile, ProfileError, Profiles, RunEntry, Runs, read_run, utc};
use crate::campaign::{CareerFlight, Stake, day_and_stake};
use crate::mission::Mission;
use crate::mission::record::Stored;
use crate::scoring::Report;
use crate::text;
use crate::text::Text;
use crate::workshop::Design;

/// Seconds of a day.
const DAY_S: u64 = 24 * 60 * 60;

/// What a flight does not know of itself when it has ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Landing {
    /// What no other run is called: [`RunFile::id`](super::RunFile::id).
    pub id: String,
    /// Whether its record is whole.
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
    /// What a profile keeps of a finished flight: the mission as it was flown, and its report.
    pub fn of(mission: &Mission, report: &Report, landing: Landing) -> Self {
        let (day, stake) = day_and_stake(landing.stake, report.seed, day_of(landing.when));
        Self {
            when: utc(landing.when),
            flight: CareerFlight::of(mission, report, stake, day),
            // What the shell adds belongs to the moment at which it is shown.
            report: Report {
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

/// A run that was finished and recorded, but not stored.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Recovery {
    pub profile: String,
    pub mission: String,
    /// What it was scored.
    pub score: u16,
}

impl Recovery {
    pub fn text(&self) -> Text {
        text!(
            "profiles-recovered",
            profile = self.profile.as_str(),
            mission = self.mission.as_str(),
            score = self.score
        )
    }
}

/// Opens the profiles of a data folder and makes up for what was left undone. The texts tell what was.
///
/// # Errors
/// The profiles cannot be had; see [`Profiles::open`].
pub fn open_profiles(data: &Path) -> Result<(Profiles, Vec<Text>), ProfileError> {
    let (mut profiles, rescue) = Profiles::open(data)?;
    let mut told: Vec<Text> = rescue.iter().map(super::Rescue::text).collect();
    let recovered = recover(&mut profiles, &Runs::within(data))?;
    told.extend(recovered.iter().map(Recovery::text));
    Ok((profiles, told))
}

/// Stores the finished runs of a folder that name a profile and that no profile has, each once, whoever else is at it.
/// Where none is missing, only names are read, and the first and last line of records that are nobody's.
///
/// # Errors
/// The database cannot be read or written; what was stored until then stays.
pub fn recover(profiles: &mut Profiles, runs: &Runs) -> Result<Vec<Recovery>, ProfileError> {
    let others = runs.others(&profiles.run_ids()?);
    let everybody = profiles.list()?;
    let mut recovered = Vec::new();
    for path in others {
        let Some((profile, run)) = left_behind(&path, &everybody) else {
            continue;
        };
        if profiles.store(profile, &run)? {
            recovered.push(Recovery {
                profile: profile.name.clone(),
                mission: run.flight.mission,
                score: run.flight.score,
            });
        }
    }
    Ok(recovered)
}

/// What a recorded run means to the one whose it is; `None` if it is nobody's, or has no end. A profile that was made
/// later has only the name in common with whoever flew it.
fn left_behind<'a>(path: &Path, everybody: &'a [Profile]) -> Option<(&'a Profile, RunEntry)> {
    let (head, end) = outline(path).ok()?;
    end?;
    let name = head.profile.as_deref()?;
    let profile = everybody
        .iter()
        .find(|it| it.name.eq_ignore_ascii_case(name) && it.since <= head.when)?;
    let when = path.metadata().and_then(|file| file.modified()).ok()?;
    let stored = Stored::read(&read_run(path).ok()?).ok()?;
    stored.end()?;
    let report = stored.rescore().ok()?.report;
    let mission = stored.head.flown().ok()?;
    let landing = Landing {
        id: run_id(path).to_owned(),
        is_recorded: true,
        when,
        stake: head.stake,
    };
    Some((profile, RunEntry::of(&mission, &report, landing)))
}

#[cfg(test)]
mod tests;
