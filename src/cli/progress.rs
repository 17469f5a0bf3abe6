//! A profile's progress as tables, for `sortie profile show` and `sortie report`.

use std::time::{Duration, UNIX_EPOCH};

use super::table::{Side, TextTable};
use crate::campaign::{CareerProgress, Mastery, MissionState, Stake, VehicleProgress};
use crate::scoring::{FlownBy, Medal};
use crate::store::{PastRun, utc};
use crate::text;
use crate::text::{Locale, Text};

/// A day as `2026-11-20`; empty for a day out of range.
pub(super) fn date(day: i64) -> String {
    let seconds = u64::try_from(day)
        .unwrap_or_default()
        .saturating_mul(24 * 60 * 60);
    let time = UNIX_EPOCH.checked_add(Duration::from_secs(seconds));
    time.map_or_else(String::new, |time| utc(time).chars().take(10).collect())
}

/// Credits, level, licence, kinds of vehicles, and the recommended training.
pub(super) fn heading(progress: &CareerProgress) -> Vec<Text> {
    let mut lines = vec![text!(
        "progress-standing",
        credits = progress.credits,
        level = progress.level,
        experience = progress.experience,
        next = progress.next_level_experience,
        licence = progress.licence,
        flights = progress.flights
    )];
    lines.push(VehicleProgress::line(&progress.vehicles));
    if progress.imported_flights > 0 {
        lines.push(text!(
            "progress-imported",
            count = progress.imported_flights
        ));
    }
    let next = progress.next.as_ref();
    lines.extend(next.map(|next| {
        let (skill, mission) = (&next.skill_title, &next.mission_title);
        text!("progress-next", skill = skill, mission = mission)
    }));
    lines
}

/// The state of each mission.
pub(super) fn missions(progress: &CareerProgress, locale: &Locale) -> TextTable {
    let columns = [
        (text!("progress-mission"), Side::Left),
        (text!("progress-state"), Side::Left),
        (text!("progress-medal"), Side::Left),
        (text!("progress-best"), Side::Right),
        (text!("progress-tries"), Side::Right),
        (text!("progress-first"), Side::Right),
        (text!("progress-last"), Side::Right),
        (text!("progress-trend"), Side::Right),
        (text!("progress-why"), Side::Left),
    ];
    let mut table = TextTable::new(locale, &columns);
    for mission in &progress.missions {
        let reasons = Text::joined("; ", mission.reasons.clone());
        table.push(vec![
            mission.id.clone(),
            locale.text(&state(mission.state)),
            medal(mission.medal, locale),
            figure(mission.best),
            mission.tries.to_string(),
            figure(mission.first),
            figure(mission.last),
            mission
                .trend
                .map_or_else(String::new, |it| format!("{it:+.0}")),
            locale.text(&reasons),
        ]);
    }
    table
}

/// The state of each skill.
pub(super) fn skills(progress: &CareerProgress, locale: &Locale) -> TextTable {
    let columns = [
        (text!("progress-skill"), Side::Left),
        (text!("progress-chance"), Side::Right),
        (text!("progress-mastery"), Side::Left),
        (text!("progress-shown"), Side::Right),
        (text!("progress-due"), Side::Left),
    ];
    let mut table = TextTable::new(locale, &columns);
    for skill in &progress.skills {
        table.push(vec![
            locale.text(&skill.title),
            match skill.mastery {
                Mastery::Unknown => "-".to_owned(),
                Mastery::Learning | Mastery::Mastered | Mastery::Due => {
                    format!("{} %", skill.percent)
                }
            },
            locale.text(&skill.mastery.title()),
            skill.opportunities.to_string(),
            skill.due_day.map(date).unwrap_or_default(),
        ]);
    }
    table
}

/// The runs, oldest first.
pub(super) fn runs(runs: &[PastRun], locale: &Locale) -> TextTable {
    let columns = [
        (text!("progress-ended"), Side::Left),
        (text!("progress-mission"), Side::Left),
        (text!("progress-score"), Side::Right),
        (text!("progress-medal"), Side::Left),
        (text!("progress-passed"), Side::Left),
        (text!("progress-stake"), Side::Left),
        (text!("progress-flown-by"), Side::Left),
        (text!("progress-seed"), Side::Right),
        (text!("progress-recording"), Side::Left),
        (text!("progress-is-imported"), Side::Left),
    ];
    let mut table = TextTable::new(locale, &columns);
    for run in runs {
        table.push(vec![
            run.when.clone(),
            run.flight.mission.clone(),
            run.flight.score.to_string(),
            medal(run.flight.medal, locale),
            locale.text(&answer(run.flight.passed)),
            locale.text(&stake(run.flight.stake)),
            run.flight
                .flown_by
                .map(flown_by)
                .map(|text| locale.text(&text))
                .unwrap_or_default(),
            run.seed.to_string(),
            run.recording.clone().unwrap_or_default(),
            locale.text(&answer(run.flight.imported)),
        ]);
    }
    table
}

/// The answer to a question in words: yes or no.
pub(super) fn answer(yes: bool) -> Text {
    if yes {
        text!("answer-yes")
    } else {
        text!("answer-no")
    }
}

fn state(state: MissionState) -> Text {
    match state {
        MissionState::Locked => text!("mission-state-locked"),
        MissionState::Open => text!("mission-state-open"),
        MissionState::Passed => text!("mission-state-passed"),
    }
}

fn flown_by(flown_by: FlownBy) -> Text {
    match flown_by {
        FlownBy::Hand => text!("flown-by-hand"),
        FlownBy::Script => text!("flown-by-script"),
        FlownBy::BundledPilot => text!("flown-by-bundled-pilot"),
    }
}

fn stake(stake: Stake) -> Text {
    match stake {
        Stake::Graded => text!("stake-graded"),
        Stake::Practice => text!("stake-practice"),
        Stake::Exam => text!("stake-exam"),
        Stake::Daily => text!("stake-daily"),
    }
}

fn medal(medal: Option<Medal>, locale: &Locale) -> String {
    medal.map_or_else(|| "-".to_owned(), |medal| locale.text(&medal.title()))
}

fn figure(score: Option<u16>) -> String {
    score.map_or_else(String::new, |score| score.to_string())
}

#[cfg(test)]
mod tests {
    use super::date;

    #[test]
    fn every_day_has_a_date_or_none_and_ends_no_program() {
        assert_eq!(date(20_412), "2025-11-20");
        assert_eq!(date(-1), "1970-01-01");
        for day in [120_000_000_000_000, i64::MAX] {
            assert_eq!(date(day), "");
        }
    }
}
