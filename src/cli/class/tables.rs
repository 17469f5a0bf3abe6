//! The tables of a class.

use crate::campaign::{Skill, Stake};
use crate::class::TryVerdict;
use crate::class_results::{
    ClassFlight, ClassResults, ClassTrainee, FlownObjective, Spread, TraineeResults,
    TryWithoutRecord, number_of_mission,
};
use crate::cli::progress::answer;
use crate::cli::table::{Side, TextTable};
use crate::exam_seal::{SealCheck, witness_text};
use crate::text;
use crate::text::{Locale, Text, figure, utc_minute_of};

/// The cell of a figure that there is not.
const NONE: &str = "-";
/// The number of columns to which the titles of objectives are cut.
const WIDTH: usize = 110;

/// A column for the trainee, and one for each mission with the best score and the number of tries.
pub(super) fn by_mission(results: &ClassResults, locale: &Locale) -> TextTable {
    let missions = results.missions.iter();
    let ids: Vec<&str> = missions.map(|it| it.mission.as_str()).collect();
    let numbered = ids
        .iter()
        .map(|id| (number_of_mission(id).into(), Side::Right));
    let columns: Vec<(Text, Side)> = [
        (text!("progress-trainee"), Side::Left),
        (text!("class-report-practice"), Side::Right),
    ]
    .into_iter()
    .chain(numbered)
    .collect();
    let mut table = TextTable::new(locale, &columns);
    for trainee in &results.trainees {
        let cells = ids.iter().map(|id| result_cell(trainee, id));
        let head = [trainee.user.clone(), trainee.practice.to_string()];
        table.push(head.into_iter().chain(cells).collect());
    }
    table
}

/// The best score and the number of tries; a pass has a tick.
fn result_cell(trainee: &TraineeResults, id: &str) -> String {
    let Some((mission, best)) = trainee.mission(id).zip(trainee.best(id)) else {
        return "-".to_owned();
    };
    let tick = if mission.is_passed() { "✓" } else { "" };
    format!("{tick}{best}/{}", mission.tries)
}

/// A column for the trainee, and one for each skill that any trainee has shown.
pub(super) fn by_skill(results: &ClassResults, locale: &Locale) -> TextTable {
    let is_shown = |skill: &&Skill| results.skills.iter().any(|it| it.skill == **skill);
    let skills: Vec<Skill> = Skill::ALL.iter().filter(is_shown).copied().collect();
    // Without a skill there is nothing to show of a trainee.
    let shown_to = if skills.is_empty() {
        &[][..]
    } else {
        &results.trainees
    };
    let coded = skills.iter().map(|it| (it.code().into(), Side::Right));
    let columns: Vec<(Text, Side)> = std::iter::once((text!("progress-trainee"), Side::Left))
        .chain(coded)
        .collect();
    let mut table = TextTable::new(locale, &columns);
    for trainee in shown_to {
        let cells = skills.iter().map(|skill| match trainee.skill(*skill) {
            Some(shown) => format!("{} %", shown.percent),
            None => "-".to_owned(),
        });
        table.push(std::iter::once(trainee.user.clone()).chain(cells).collect());
    }
    table
}

/// The spread of the best scores per mission.
pub(super) fn missions(results: &ClassResults, locale: &Locale) -> TextTable {
    let columns = [
        (text!("progress-mission"), Side::Left),
        (text!("class-report-trainees"), Side::Right),
        (text!("progress-passed"), Side::Right),
        (text!("progress-tries"), Side::Right),
        (text!("class-report-least"), Side::Right),
        (text!("class-report-median"), Side::Right),
        (text!("class-report-most"), Side::Right),
    ];
    let mut table = TextTable::new(locale, &columns);
    for mission in &results.missions {
        let counts = [mission.trainees, mission.passed, mission.tries];
        let head = std::iter::once(mission.mission.clone());
        let cells = head.chain(counts.map(|count| count.to_string()));
        table.push(cells.chain(spread_cells(mission.scores)).collect());
    }
    table
}

fn spread_cells(spread: Spread) -> [String; 3] {
    [spread.least, spread.median, spread.most].map(|it| figure(it, 0))
}

/// How well the class meets each objective, the least known first.
pub(super) fn objectives(results: &ClassResults, locale: &Locale) -> TextTable {
    let columns = [
        (text!("progress-mission"), Side::Left),
        (text!("class-report-objective"), Side::Left),
        (text!("progress-skill"), Side::Left),
        (text!("class-report-met"), Side::Right),
        (text!("class-report-share"), Side::Right),
    ];
    let mut table = TextTable::new(locale, &columns);
    for objective in &results.objectives {
        table.push(vec![
            objective.mission.clone(),
            locale.text(&objective.title),
            objective
                .skill
                .map(Skill::code)
                .unwrap_or_default()
                .to_owned(),
            format!("{}/{}", objective.met, objective.trainees),
            format!("{} %", figure(objective.mean_percent, 0)),
        ]);
    }
    table.fitted(1, WIDTH)
}

/// How well the class masters each skill, the least known first.
pub(super) fn skills(results: &ClassResults, locale: &Locale) -> TextTable {
    let columns = [
        ("".into(), Side::Left),
        (text!("progress-skill"), Side::Left),
        (text!("class-report-trainees"), Side::Right),
        (text!("class-report-mastered"), Side::Right),
        (text!("class-report-least"), Side::Right),
        (text!("class-report-median"), Side::Right),
        (text!("class-report-most"), Side::Right),
    ];
    let mut table = TextTable::new(locale, &columns);
    for skill in &results.skills {
        let head = [
            skill.skill.code().to_owned(),
            locale.text(&skill.title),
            skill.trainees.to_string(),
            skill.mastered.to_string(),
        ];
        let spread = spread_cells(skill.percent).map(|it| format!("{it} %"));
        table.push(head.into_iter().chain(spread).collect());
    }
    table
}

/// A row for each try of an exam: those with records, and those without.
pub(super) fn exams(
    trainees: &[ClassTrainee],
    missing: &[TryWithoutRecord],
    locale: &Locale,
) -> TextTable {
    let columns = [
        (text!("progress-trainee"), Side::Left),
        (text!("class-report-exam"), Side::Left),
        (text!("class-report-began"), Side::Left),
        (text!("progress-mission"), Side::Left),
        (text!("class-report-try"), Side::Right),
        (text!("class-report-score"), Side::Right),
        (text!("class-report-seal"), Side::Left),
        (text!("class-report-witness"), Side::Left),
    ];
    let mut table = TextTable::new(locale, &columns);
    for trainee in trainees {
        for flight in &trainee.flights {
            if let Some(check) = &flight.seal {
                table.push(try_cells(&trainee.user, flight, check, locale).into());
            }
        }
    }
    for it in missing {
        let record = match it.verdict {
            TryVerdict::Open => text!("class-report-try-open"),
            TryVerdict::Left => text!("class-report-try-left"),
            TryVerdict::Passed | TryVerdict::Failed | TryVerdict::TimeUp | TryVerdict::Unseen => {
                text!("class-report-no-record")
            }
        };
        let cells = [
            it.user.clone(),
            it.exam.clone(),
            utc_minute_of(it.opened * 1_000_000),
            it.mission.clone(),
            format!("{}/{}", it.number, it.tries),
            NONE.to_owned(),
            locale.text(&record),
            NONE.to_owned(),
        ];
        table.push(cells.into());
    }
    table
}

/// A row for each flight in which an instructor flew vehicles, or recalled a situation.
pub(super) fn instructed(trainees: &[ClassTrainee], locale: &Locale) -> TextTable {
    let columns = [
        (text!("progress-trainee"), Side::Left),
        (text!("progress-mission"), Side::Left),
        (text!("class-report-began"), Side::Left),
        (text!("class-report-instructor"), Side::Left),
    ];
    let mut table = TextTable::new(locale, &columns);
    for trainee in trainees {
        for flight in trainee.instructed() {
            let acts = flight.instructor.acts().iter();
            let acts: Vec<String> = acts.map(|act| locale.text(&act.text())).collect();
            table.push(vec![
                trainee.user.clone(),
                flight.flight.mission.clone(),
                minute(&flight.when),
                acts.join("; "),
            ]);
        }
    }
    table
}

/// A time in UTC to the minute: `2026-11-20T14:03:22Z` becomes `2026-11-20 14:03`.
fn minute(when: &str) -> String {
    when.get(..16).unwrap_or(when).replace('T', " ")
}

/// A row for each flight of a trainee that does not count, and why not.
pub(super) fn uncounted(trainee: &ClassTrainee, locale: &Locale) -> TextTable {
    let columns = [
        (text!("progress-mission"), Side::Left),
        (text!("class-report-began"), Side::Left),
        (text!("class-report-why-not"), Side::Left),
    ];
    let mut table = TextTable::new(locale, &columns);
    for flight in trainee.flights.iter().filter(|it| !it.counts()) {
        let why_not = match &flight.seal {
            Some(check) => check.standing(),
            None if flight.flight.stake == Stake::Practice => text!("class-report-as-practice"),
            None => text!("class-report-script"),
        };
        table.push(vec![
            flight.flight.mission.clone(),
            minute(&flight.when),
            locale.text(&why_not),
        ]);
    }
    table
}

fn try_cells(user: &str, flight: &ClassFlight, check: &SealCheck, locale: &Locale) -> [String; 8] {
    let seal = check.seal.as_ref();
    let said = |text: Option<String>| text.unwrap_or_else(|| NONE.to_owned());
    [
        user.to_owned(),
        said(seal.map(|it| it.exam.clone())),
        minute(&flight.when),
        flight.flight.mission.clone(),
        said(seal.map(|it| format!("{}/{}", it.number, it.tries))),
        if check.has_result() {
            flight.flight.score.to_string()
        } else {
            NONE.to_owned()
        },
        locale.text(&check.standing()),
        said(seal.map(|it| locale.text(&witness_text(&it.witness)))),
    ]
}

/// A row for each trainee and objective, from the best flights that count.
pub(super) fn rows(trainees: &[ClassTrainee], locale: &Locale) -> TextTable {
    let of_flight = [
        (text!("progress-trainee"), Side::Left),
        (text!("class-report-profile"), Side::Left),
        (text!("progress-mission"), Side::Left),
        (text!("class-report-revision"), Side::Right),
        (text!("progress-tries"), Side::Right),
        (text!("progress-best"), Side::Right),
        (text!("progress-passed"), Side::Left),
    ];
    let after = [
        (text!("progress-seed"), Side::Right),
        (text!("class-report-began"), Side::Left),
        (text!("class-report-record"), Side::Left),
        (text!("class-report-exam"), Side::Left),
        (text!("class-report-seal"), Side::Left),
    ];
    let mut columns = of_flight.to_vec();
    columns.extend(objective_columns());
    columns.extend(after);
    let mut table = TextTable::new(locale, &columns);
    for trainee in trainees {
        for best in trainee.best_flights() {
            push_objectives(&mut table, trainee, best, locale);
        }
    }
    table
}

/// Adds a row for each objective of a flight.
fn push_objectives(
    table: &mut TextTable,
    trainee: &ClassTrainee,
    best: &ClassFlight,
    locale: &Locale,
) {
    let mission = &best.flight.mission;
    let tries = trainee.flights.iter().filter(|it| it.counts());
    let tries = tries.filter(|it| it.flight.mission == *mission).count();
    for objective in &best.objectives {
        let of_flight = [
            trainee.user.clone(),
            best.profile.clone().unwrap_or_default(),
            mission.clone(),
            best.revision.to_string(),
            tries.to_string(),
            best.flight.score.to_string(),
            locale.text(&answer(best.flight.passed)),
        ];
        let after = [
            best.seed.to_string(),
            best.when.clone(),
            best.record.clone(),
            exam_of(best),
            seal_of(best, locale),
        ];
        let cells = of_flight
            .into_iter()
            .chain(objective_cells(objective, locale));
        table.push(cells.chain(after).collect());
    }
}

/// The exam whose seal a flight has; empty without one.
fn exam_of(flight: &ClassFlight) -> String {
    let seal = flight.seal.as_ref().and_then(|it| it.seal.as_ref());
    seal.map(|it| it.exam.clone()).unwrap_or_default()
}

/// Whether the try counts by its seal; empty without one.
fn seal_of(flight: &ClassFlight, locale: &Locale) -> String {
    let seal = flight.seal.as_ref();
    seal.map(|it| locale.text(&it.standing()))
        .unwrap_or_default()
}

/// The columns of [`objective_cells`].
fn objective_columns() -> [(Text, Side); 8] {
    [
        (text!("class-report-objective"), Side::Left),
        (text!("class-report-objective-title"), Side::Left),
        (text!("progress-skill"), Side::Left),
        (text!("class-report-mandatory"), Side::Left),
        (text!("class-report-met"), Side::Left),
        (text!("class-report-points"), Side::Right),
        (text!("class-report-points-max"), Side::Right),
        (text!("class-report-result"), Side::Left),
    ]
}

fn objective_cells(objective: &FlownObjective, locale: &Locale) -> [String; 8] {
    let result = &objective.result;
    [
        result.id.clone(),
        locale.text(&result.title),
        objective
            .skill
            .map(Skill::code)
            .unwrap_or_default()
            .to_owned(),
        locale.text(&answer(result.mandatory)),
        locale.text(&answer(result.met)),
        figure(result.points, 1),
        figure(result.points_max, 1),
        locale.text(&result.result),
    ]
}

/// The objectives of one flight.
pub(super) fn objectives_of(objectives: &[FlownObjective], locale: &Locale) -> TextTable {
    let mut table = TextTable::new(locale, &objective_columns());
    for objective in objectives {
        table.push(objective_cells(objective, locale).into());
    }
    table
}

/// The best scores in percent, in columns that Moodle's import of grades maps: a user name, and one per mission.
pub(super) fn moodle(results: &ClassResults, locale: &Locale) -> TextTable {
    let missions = results.missions.iter().map(|it| {
        let title = format!("{} {}", it.mission, locale.text(&it.title));
        (Text::verbatim(title), Side::Right)
    });
    let columns: Vec<(Text, Side)> = std::iter::once(("username".into(), Side::Left))
        .chain(missions)
        .collect();
    let mut table = TextTable::new(locale, &columns);
    for trainee in &results.trainees {
        let grade = |id: &str| {
            trainee
                .best(id)
                .map(|best| format!("{:.1}", f64::from(best) / 10.0))
        };
        let grades = results.missions.iter();
        let grades = grades.map(|it| grade(&it.mission).unwrap_or_default());
        table.push(
            std::iter::once(trainee.user.clone())
                .chain(grades)
                .collect(),
        );
    }
    table
}
