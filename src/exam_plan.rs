//! Exams: TOML files with the missions that trainees fly under the eyes of the desk.
//!
//! Hints, scripts and pauses are never permitted in an exam, so there are no keys for them. How an exam is held is in
//! the library [`class`](crate::class).

use std::sync::Arc;
use std::time::Duration;

use chrono::NaiveDate;
use serde::Deserialize;
use toml::Spanned;
use toml::value::{Datetime, Offset};

use crate::campaign::MissionCourse;
use crate::class::{ExamLayout, ExamMission, ExamPlan};
use crate::diagnostic::Diagnostic;
use crate::language::mission_meant;
use crate::lesson_plan::Findings;
use crate::text;
use crate::text::Text;

/// The version of the format.
const SCHEMA: i64 = 1;
/// The first-level keys of an exam, by which a file is known to be one.
pub const EXAM_KEYS: [&str; 9] = [
    "schema", "title", "title_uk", "about", "about_uk", "layout", "opens", "closes", "missions",
];
/// The maximum number of missions.
const MOST_MISSIONS: usize = 20;
/// The maximum number of tries at a mission.
const MOST_TRIES: u32 = 10;
/// The longest time for a try, in minutes.
const LONGEST_MINUTES: u32 = 240;

/// An exam with its texts.
#[derive(Debug, Clone, PartialEq)]
pub struct ExamFile {
    pub plan: Arc<ExamPlan>,
    pub title: Text,
    /// What the exam is for.
    pub about: Text,
    /// Texts without a translation, which are not faults.
    pub untranslated: Vec<Diagnostic>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenExam {
    schema: Spanned<i64>,
    title: Spanned<String>,
    title_uk: Option<Spanned<String>>,
    about: Spanned<String>,
    about_uk: Option<Spanned<String>>,
    layout: Option<Spanned<String>>,
    opens: Option<Spanned<Datetime>>,
    closes: Option<Spanned<Datetime>>,
    missions: Spanned<Vec<WrittenMission>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenMission {
    mission: Spanned<String>,
    tries: Spanned<u32>,
    minutes: Spanned<u32>,
}

impl ExamFile {
    /// Reads an exam. `name` is the name by which the desk knows it; its missions are those of the course.
    ///
    /// # Errors
    /// The faults with their positions: the first one of the structure, otherwise all.
    pub fn parse(
        name: &str,
        source: &str,
        course: &MissionCourse,
    ) -> Result<Self, Vec<Diagnostic>> {
        let written: WrittenExam =
            toml::from_str(source).map_err(|error| vec![Diagnostic::from_toml(&error)])?;
        let mut findings = Findings::default();
        if *written.schema.get_ref() != SCHEMA {
            let found = *written.schema.get_ref();
            let fault = text!("exam-schema", found = found, known = SCHEMA);
            findings.fault(written.schema.span(), fault);
        }
        let title = findings.text(&written.title, written.title_uk.as_ref(), "title_uk");
        let about = findings.text(&written.about, written.about_uk.as_ref(), "about_uk");
        let plan = ExamPlan {
            name: name.into(),
            title: written.title.get_ref().as_str().into(),
            title_uk: written
                .title_uk
                .as_ref()
                .map(|it| it.get_ref().as_str().into()),
            layout: layout(written.layout.as_ref(), &mut findings),
            opens: moment(written.opens.as_ref(), &mut findings),
            closes: moment(written.closes.as_ref(), &mut findings),
            missions: missions(&written.missions, course, &mut findings),
        };
        if let (Some(opens), Some(closes), Some(place)) = (plan.opens, plan.closes, &written.closes)
            && closes <= opens
        {
            findings.fault(place.span(), text!("exam-window"));
        }
        let untranslated = findings.untranslated()?;
        Ok(Self {
            plan: Arc::new(plan),
            title,
            about,
            untranslated,
        })
    }
}

fn layout(written: Option<&Spanned<String>>, findings: &mut Findings) -> ExamLayout {
    const LAYOUTS: [(&str, ExamLayout); 2] = [("own", ExamLayout::Own), ("same", ExamLayout::Same)];
    let Some(written) = written else {
        return ExamLayout::default();
    };
    let word = written.get_ref().as_str();
    let known = LAYOUTS.iter().find(|(name, _)| *name == word);
    known.map_or_else(
        || {
            let fault = Diagnostic::new(written.span(), text!("exam-layout", word = word));
            let names = LAYOUTS.iter().map(|(name, _)| *name);
            findings.faults.push(fault.with_nearest(word, names));
            ExamLayout::default()
        },
        |(_, layout)| *layout,
    )
}

/// A time in seconds since 1970.
fn moment(written: Option<&Spanned<Datetime>>, findings: &mut Findings) -> Option<u64> {
    let written = written?;
    let seconds = seconds_of(written.get_ref());
    if seconds.is_none() {
        findings.fault(written.span(), text!("exam-time"));
    }
    seconds
}

fn seconds_of(written: &Datetime) -> Option<u64> {
    let (date, time) = (written.date?, written.time?);
    let ahead = match written.offset? {
        Offset::Z => 0,
        Offset::Custom { minutes } => i64::from(minutes) * 60,
    };
    let day = NaiveDate::from_ymd_opt(date.year.into(), date.month.into(), date.day.into())?;
    let second = time.second.unwrap_or_default();
    let moment = day.and_hms_opt(time.hour.into(), time.minute.into(), second.into())?;
    u64::try_from(moment.and_utc().timestamp() - ahead).ok()
}

fn missions(
    written: &Spanned<Vec<WrittenMission>>,
    course: &MissionCourse,
    findings: &mut Findings,
) -> Vec<ExamMission> {
    let all = written.get_ref();
    if all.is_empty() || all.len() > MOST_MISSIONS {
        let fault = text!("exam-missions", count = all.len(), most = MOST_MISSIONS);
        findings.fault(written.span(), fault);
    }
    let ids: Vec<&str> = course.offers().iter().map(|it| it.id.as_str()).collect();
    let mut read: Vec<ExamMission> = Vec::new();
    for one in all {
        let word = one.mission.get_ref().as_str();
        let meant = mission_meant(word, &ids);
        if meant.is_none() {
            let fault = Diagnostic::new(one.mission.span(), text!("exam-no-mission", name = word));
            let fault = fault.with_help(text!("exam-no-mission-help"));
            findings
                .faults
                .push(fault.with_nearest(word, ids.iter().copied()));
        }
        let mission = meant.unwrap_or(word).into();
        if read.iter().any(|it| it.mission == mission) {
            findings.fault(one.mission.span(), text!("exam-mission-twice", name = word));
        }
        read.push(ExamMission {
            mission,
            tries: bounded(&one.tries, MOST_TRIES, "tries", findings),
            limit: Duration::from_secs(
                60 * u64::from(bounded(&one.minutes, LONGEST_MINUTES, "minutes", findings)),
            ),
        });
    }
    read
}

/// A number from 1 to a maximum.
fn bounded(written: &Spanned<u32>, most: u32, key: &str, findings: &mut Findings) -> u32 {
    let found = *written.get_ref();
    if found == 0 || found > most {
        let fault = text!("exam-number", key = key, most = most, found = found);
        findings.fault(written.span(), fault);
    }
    found
}

#[cfg(test)]
mod tests;
