//! Checks of an imported profile. A file proves nothing on its own. A flight counts only by its
//! report, only if its mission belongs to this course, and in the order in which the flights were
//! flown. Claims that the report does not support are left out or count as practice, and all
//! entries are marked as imported.

use std::collections::BTreeSet;

use super::{EntryDocument, ProfileFile, RunDocument};
use crate::campaign::{
    AttemptTrainee, CareerEntry, CareerFlight, CareerStanding, ExamKey, FlightClaim, MissionCourse,
    Offer, PracticeReason, Purchase, Stake,
};
use crate::mission::Mission;
use crate::notice::sanitised;
use crate::scoring::Report;
use crate::store::runs::moment;
use crate::store::{course_missions, day_of};
use crate::text;
use crate::text::Text;
use crate::workshop::Design;

impl ProfileFile {
    /// The profile reduced to the claims that its reports support, and remarks on the claims that
    /// are left out or become practice.
    #[must_use]
    pub fn borne_out(self) -> (Self, Vec<Text>) {
        let missions = course_missions();
        let course = MissionCourse::new(missions.iter().map(Offer::of));
        let exams = self.exam_key();
        let mut claims = Claims {
            exams,
            missions: &missions,
            course: &course,
            standing: CareerStanding::default(),
            ids: BTreeSet::new(),
            reports: Vec::new(),
            told: Vec::new(),
        };
        let mut entries = Vec::new();
        for row in self.entries {
            let run = self.runs.iter().find(|run| run.id == row.id);
            match claims.entry(&row, run) {
                Ok(entry) => {
                    claims.standing.enter(&entry);
                    entries.push(EntryDocument { entry, ..row });
                }
                Err(why) => claims
                    .told
                    .push(text!("import-left-out", id = row.id, why = why)),
            }
        }
        let mut ids = BTreeSet::new();
        let is_kept = |run: &RunDocument| entries.iter().any(|row| row.id == run.id);
        let claimed = self.runs.into_iter();
        let runs = claimed.filter(|run| is_kept(run) && ids.insert(run.id.clone()));
        let borne_out = Self {
            runs: runs.collect(),
            entries,
            ..self
        };
        (borne_out, claims.told)
    }
}

/// The state while the entries of a file are checked, oldest first.
struct Claims<'a> {
    missions: &'a [Mission],
    course: &'a MissionCourse,
    exams: ExamKey,
    standing: CareerStanding,
    ids: BTreeSet<String>,
    /// The reports of the flights that counted.
    reports: Vec<Report>,
    told: Vec<Text>,
}

impl Claims<'_> {
    /// The checked version of an entry.
    ///
    /// # Errors
    /// The reason why the import leaves the flight out.
    fn entry(
        &mut self,
        row: &EntryDocument,
        run: Option<&RunDocument>,
    ) -> Result<CareerEntry, Text> {
        if !self.ids.insert(row.id.clone()) {
            return Err(text!("import-twice"));
        }
        match &row.entry {
            CareerEntry::Purchase(Purchase { part, .. }) => {
                let bought = self.standing.buy(part, self.course);
                bought
                    .map(CareerEntry::Purchase)
                    .map_err(|refusal| refusal.text())
            }
            CareerEntry::Flight(claimed) => {
                let run = run.ok_or_else(|| text!("import-no-report"))?;
                let flight = self.flight(&row.id, claimed, run)?;
                Ok(CareerEntry::Flight(flight))
            }
        }
    }

    fn flight(
        &mut self,
        id: &str,
        claimed: &CareerFlight,
        run: &RunDocument,
    ) -> Result<CareerFlight, Text> {
        let report = &run.report;
        let other_mission = (claimed.mission != report.mission)
            .then(|| format!("the report is of mission {:?}", report.mission));
        if let Some(fault) = other_mission.or_else(|| report.fault()) {
            return Err(text!("import-unfit", fault = sanitised(&fault)));
        }
        let known = self.missions.iter().find(|it| it.id == report.mission);
        let Some(mission) = known.filter(|_| claimed.stake != Stake::Practice) else {
            return Ok(practice(claimed, run));
        };
        if self.reports.contains(report) {
            return Err(text!("import-twice"));
        }
        let flown = with_airframes(mission, run).ok_or_else(|| text!("import-fleet"))?;
        if let Some(fault) = unlike(&flown, report) {
            return Err(text!("import-unfit", fault = fault));
        }
        let claim = FlightClaim {
            mission: &flown,
            stake: claimed.stake,
            seed: report.seed,
            mission_file: report.mission_file,
            flown_by: report.flown_by,
            ended: day(run),
            is_confirmed: true,
        };
        let settled = claim.settle(AttemptTrainee {
            standing: &self.standing,
            course: self.course,
            exams: self.exams,
        });
        if !settled.reduced.is_empty() {
            let why = PracticeReason::sentence(&settled.reduced);
            self.told.push(text!("import-practice", id = id, why = why));
            return Ok(practice(claimed, run));
        }
        self.reports.push(report.clone());
        Ok(CareerFlight {
            imported: true,
            ..CareerFlight::of(&flown, report, settled.stake, settled.day)
        })
    }
}

/// The mission with the trainee's own drones, if the run was flown with any; `None` if these drones
/// could not fly the mission.
fn with_airframes(mission: &Mission, run: &RunDocument) -> Option<Mission> {
    let designs = run.airframes.iter().map(|it| Design::from_toml(it).ok());
    let fleet: Vec<Design> = designs.collect::<Option<_>>()?;
    let mission = Mission::parse(&mission.file.text).ok()?;
    mission.with_fleet(fleet).ok()
}

/// The flight as practice, which earns nothing. The trainee's own drones that were lost stay lost.
fn practice(claimed: &CareerFlight, run: &RunDocument) -> CareerFlight {
    let report = &run.report;
    CareerFlight {
        mission: report.mission.clone(),
        stake: Stake::Practice,
        flown_by: report.flown_by,
        day: day(run),
        score: report.score,
        passed: report.passed,
        medal: report.medal,
        imported: true,
        ..claimed.clone()
    }
}

fn day(run: &RunDocument) -> i64 {
    moment(&run.ended).map_or(0, day_of)
}

/// Why a report is impossible for a flight of the mission, in English; `None` if it is possible.
fn unlike(mission: &Mission, report: &Report) -> Option<String> {
    if report.medal > mission.scoring.medals.won(report.score, true) {
        return Some(format!("no such medal for {} points", report.score));
    }
    if report.revision != mission.rev {
        return None;
    }
    let of_mission = mission.objectives.iter();
    let asked = of_mission.map(|it| (it.id.as_str(), it.mandatory));
    let of_report = report.objectives.iter();
    let told = of_report.map(|it| (it.id.as_str(), it.mandatory));
    (!told.eq(asked)).then(|| "its objectives are not those of the mission".to_owned())
}
