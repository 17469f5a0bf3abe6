//! `sortie class grades` and `sortie class rubrics`: what graders have judged, and with which rubrics.

use std::collections::{BTreeMap, BTreeSet};
use std::process::ExitCode;

use clap::Args;
use serde::Serialize;

use super::results::records_of;
use crate::cli::Failure;
use crate::cli::settings::CliSettings;
use crate::cli::table::{Side, TextTable};
use crate::grading::{Agreement, Grade, GradeSheet, GraderMarks, Rubric, agreement, marks_of};
use crate::store::{self, KeptSheet, StoreError};
use crate::text;
use crate::text::{Locale, Text, figure};

/// Options of `sortie class grades`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
                        sortie class grades 9-A\n  \
                        sortie class grades 9-A --json > grades.json\n  \
                        sortie class export 9-A --format grades --output grades.csv")]
pub(super) struct GradesArguments {
    /// The name of the class, or the path of its folder; by default your user name.
    #[arg(value_name = "NAME|PATH")]
    name: Option<String>,
    /// Print one JSON document instead of tables.
    #[arg(long)]
    json: bool,
}

/// The grades of a class, with the rubrics that they refer to.
pub(super) struct ReadGrades {
    /// The name of the class.
    pub class: String,
    pub sheets: Vec<KeptSheet>,
    /// The rubrics by name; a rubric that is gone is missing.
    pub rubrics: BTreeMap<String, Rubric>,
    /// Whether grades or rubrics cannot be read.
    is_incomplete: bool,
}

/// How far two graders agree.
#[derive(Serialize)]
struct GraderPair {
    first: String,
    second: String,
    rubric: String,
    #[serde(flatten)]
    agreement: Agreement,
}

#[derive(Serialize)]
struct GradesDocument<'a> {
    class: &'a str,
    sheets: Vec<SheetDocument<'a>>,
    agreement: &'a [GraderPair],
}

#[derive(Serialize)]
struct SheetDocument<'a> {
    user: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    profile: Option<&'a str>,
    record: &'a str,
    #[serde(flatten)]
    sheet: &'a GradeSheet,
}

impl ReadGrades {
    /// Reads the grades of the class with this name, by default the user's own; names those that cannot be read.
    ///
    /// # Errors
    /// Nothing was ever handed in to the class.
    pub fn read(
        named: Option<&str>,
        settings: &CliSettings,
        locale: &Locale,
    ) -> Result<Self, Failure> {
        let (class, records) = records_of(named, settings, locale)?;
        let (sheets, mut faults) = records.sheets();
        let names: BTreeSet<&str> = sheets.iter().map(|it| it.sheet.rubric.as_str()).collect();
        let mut rubrics = BTreeMap::new();
        for name in names {
            match store::rubric(name) {
                Ok(rubric) => drop(rubrics.insert(name.to_owned(), rubric)),
                Err(error) => faults.push(Text::from(&error)),
            }
        }
        for fault in &faults {
            tell!("sortie: {}", locale.text(fault));
        }
        Ok(Self {
            class,
            sheets,
            rubrics,
            is_incomplete: !faults.is_empty(),
        })
    }

    /// The sheets of a rubric with their means per category.
    fn table(&self, rubric: &Rubric, locale: &Locale) -> TextTable {
        let categories = rubric.categories.iter();
        let titled = categories.map(|it| (it.title.clone(), Side::Right));
        let columns: Vec<(Text, Side)> = [
            (text!("progress-trainee"), Side::Left),
            (text!("class-report-profile"), Side::Left),
            (text!("class-report-record"), Side::Left),
            (text!("grades-grader"), Side::Left),
        ]
        .into_iter()
        .chain(titled)
        .chain([(text!("grades-open"), Side::Right)])
        .collect();
        let mut table = TextTable::new(locale, &columns);
        for KeptSheet {
            user,
            profile,
            record,
            sheet,
        } in self
            .sheets
            .iter()
            .filter(|it| it.sheet.rubric == rubric.name)
        {
            let means = rubric.categories.iter().map(|category| {
                let mean = sheet.mean(&category.elements);
                mean.map_or_else(|| "-".to_owned(), |it| figure(it, 1))
            });
            let profile = profile.clone().unwrap_or_default();
            let head = [user.clone(), profile, record.clone(), sheet.grader.clone()];
            let open = sheet.open(rubric).count().to_string();
            table.push(head.into_iter().chain(means).chain([open]).collect());
        }
        table
    }

    /// Each pair of graders who have graded the same flights with the same rubric.
    fn pairs(&self) -> Vec<GraderPair> {
        let mut marks: BTreeMap<(&str, &str), GraderMarks> = BTreeMap::new();
        for kept in &self.sheets {
            let of = (kept.sheet.rubric.as_str(), kept.sheet.grader.as_str());
            let graded = marks_of(&kept.user, &kept.record, &kept.sheet);
            marks.entry(of).or_default().extend(graded);
        }
        let mut pairs = Vec::new();
        for (&(rubric, first), one) in &marks {
            let others = marks.range((rubric, first)..).skip(1);
            for (&(_, second), other) in others.take_while(|((name, _), _)| *name == rubric) {
                if one.keys().any(|graded| other.contains_key(graded)) {
                    pairs.push(GraderPair {
                        first: first.to_owned(),
                        second: second.to_owned(),
                        rubric: rubric.to_owned(),
                        agreement: agreement(one, other),
                    });
                }
            }
        }
        pairs
    }
}

/// A row for each graded element.
pub(super) fn rows(grades: &ReadGrades, locale: &Locale) -> TextTable {
    let mut table = TextTable::new(
        locale,
        &[
            (text!("progress-trainee"), Side::Left),
            (text!("class-report-profile"), Side::Left),
            (text!("class-report-record"), Side::Left),
            (text!("grades-grader"), Side::Left),
            (text!("grades-rubric"), Side::Left),
            (text!("grades-element"), Side::Left),
            (text!("grades-title"), Side::Left),
            (text!("grades-rating"), Side::Right),
            (text!("grades-state"), Side::Left),
            (text!("grades-remark"), Side::Left),
            (text!("grades-bookmarks"), Side::Left),
        ],
    );
    for kept in &grades.sheets {
        let rubric = grades.rubrics.get(&kept.sheet.rubric);
        for (element, grade) in &kept.sheet.grades {
            let known = rubric.and_then(|it| it.elements().find(|it| it.id == *element));
            let seconds = |ms: &u64| format!("{:.1}", *ms as f64 / 1000.0);
            let bookmarks: Vec<String> = grade.bookmarks_ms.iter().map(seconds).collect();
            table.push(vec![
                kept.user.clone(),
                kept.profile.clone().unwrap_or_default(),
                kept.record.clone(),
                kept.sheet.grader.clone(),
                kept.sheet.rubric.clone(),
                element.clone(),
                known.map_or_else(String::new, |it| locale.text(&it.title)),
                grade
                    .mark
                    .map_or_else(String::new, |it| it.number().to_string()),
                locale.text(&state(grade)),
                grade.text.clone(),
                bookmarks.join(" "),
            ]);
        }
    }
    table
}

/// Whether a grade counts.
fn state(grade: &Grade) -> Text {
    match (grade.mark, grade.counted_mark()) {
        (None, _) => text!("grades-unobserved"),
        (Some(_), None) => text!("grades-no-reason"),
        (Some(_), Some(_)) => text!("grades-counts"),
    }
}

/// Prints the grades of a class.
pub(super) fn grades(
    arguments: &GradesArguments,
    settings: &CliSettings,
) -> Result<ExitCode, Failure> {
    let locale = Locale::new(settings.language());
    let grades = ReadGrades::read(arguments.name.as_deref(), settings, &locale)?;
    let pairs = grades.pairs();
    if arguments.json {
        let sheets = grades.sheets.iter().map(|kept| SheetDocument {
            user: &kept.user,
            profile: kept.profile.as_deref(),
            record: &kept.record,
            sheet: &kept.sheet,
        });
        let document = GradesDocument {
            class: &grades.class,
            sheets: sheets.collect(),
            agreement: &pairs,
        };
        say!("{}", serde_json::to_string_pretty(&document)?)?;
        return Ok(ExitCode::SUCCESS);
    }
    if grades.sheets.is_empty() {
        say!("{}", locale.text(&text!("grades-none")))?;
    }
    for rubric in grades.rubrics.values() {
        let table = grades.table(rubric, &locale);
        say!("{}\n{}", locale.text(&rubric.title), table.plain())?;
        for pair in pairs.iter().filter(|it| it.rubric == rubric.name) {
            say_pair(pair, rubric, &locale)?;
        }
    }
    Ok(ExitCode::from(u8::from(grades.is_incomplete)))
}

fn say_pair(pair: &GraderPair, rubric: &Rubric, locale: &Locale) -> Result<(), Failure> {
    let found = &pair.agreement;
    let kappa = found.kappa;
    let line = text!(
        "grades-agreement",
        first = pair.first.as_str(),
        second = pair.second.as_str(),
        marks = found.marks,
        equal = found.equal,
        within = found.within_one,
        difference = format!("{:+.2}", found.mean_difference),
        kappa = kappa.map_or_else(|| "-".to_owned(), |it| format!("{it:.2}")),
        single = found.observed_by_one
    );
    say!("{}", locale.text(&line))?;
    for apart in &found.far_apart {
        let id = &apart.graded.element;
        let title = rubric.elements().find(|it| it.id == *id);
        let line = text!(
            "grades-apart",
            user = apart.graded.user.as_str(),
            record = apart.graded.record.as_str(),
            element = title.map_or_else(|| Text::verbatim(id), |it| it.title.clone()),
            one = apart.first.number(),
            other = apart.second.number()
        );
        say!("  {}", locale.text(&line))?;
    }
    Ok(())
}

/// Prints the rubrics, one per line; of one with faults, what they are.
pub(super) fn rubrics(settings: &CliSettings) -> Result<ExitCode, Failure> {
    let locale = Locale::new(settings.language());
    let mut is_faulty = false;
    for source in store::rubrics() {
        match Rubric::parse(source.stem(), &source.text) {
            Ok(rubric) => {
                let (title, about) = (locale.text(&rubric.title), locale.text(&rubric.about));
                say!("{}: {title}. {about}", rubric.name)?;
            }
            Err(faults) => {
                is_faulty = true;
                let file = source;
                let error = StoreError::Faulty { file, faults };
                tell!("sortie: {}", locale.text(&Text::from(&error)));
            }
        }
    }
    Ok(ExitCode::from(u8::from(is_faulty)))
}
