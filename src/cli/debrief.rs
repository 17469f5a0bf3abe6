//! `sortie debrief`: scores a recorded run again and prints its debrief.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;

use super::Failure;
use super::settings::CliSettings;
use crate::campaign::without_end;
use crate::debrief;
use crate::mission::record::{Rescored, Stored};
use crate::replay::TlogSpan;
use crate::store::{self, RecordFiles, Runs};
use crate::text;
use crate::text::{Locale, Text};

/// Options of `sortie debrief`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie debrief                             the newest run of the console\n  \
    sortie debrief last --json\n  \
    sortie debrief runs/2026-11-20T14-03-22Z_01-air-sample_4711-00.run.jsonl")]
pub(super) struct DebriefArguments {
    /// The run: `last` for the newest one of the console, a number in `sortie records list`, a name or a file.
    #[arg(default_value = "last", value_name = "RUN")]
    run: String,
    /// Print one JSON document instead of the debrief.
    #[arg(long)]
    json: bool,
}

/// Scores the run again, and prints the report and any difference from the flight. The exit code shows whether the
/// mission was passed.
pub(super) fn debrief(
    options: &DebriefArguments,
    settings: &CliSettings,
) -> Result<ExitCode, Failure> {
    let locale = Locale::new(settings.language());
    let runs = settings.data.runs();
    let path = file_of_run(&options.run, runs.as_ref(), settings)?;
    let name = path.display().to_string();
    let faulty = |fault: Text| {
        invalid(
            &Text::joined(": ", vec![name.as_str().into(), fault]),
            &locale,
        )
    };
    let stored = stored_run(&path, runs.as_ref()).map_err(faulty)?;
    let head = &stored.head;
    let again = stored
        .rescore(without_end(head.stake, head.flown_by))
        .map_err(faulty)?;
    for doubt in doubts(&stored, &path, &again) {
        tell!("sortie: {name}: {}", locale.text(&doubt));
    }
    let mut report = again.report;
    if let Some(runs) = &runs {
        let whose = head.profile.as_deref();
        report.tries = runs.tries_at(whose, &report.mission, report.revision);
    }
    let files = RecordFiles::beside(&path);
    report.instructor = files.instructor();
    let recorded = files.head().ok();
    if let Some(viewpoint) = recorded.and_then(|head| files.viewpoint(&head)) {
        report.seen_from(&viewpoint);
    }
    store::complete(&mut report, &head.flown().map_err(faulty)?);
    if options.json {
        say!("{}", serde_json::to_string_pretty(&report)?)?;
    } else {
        say!("{}", debrief::text(&report, &locale).trim_end())?;
    }
    Ok(ExitCode::from(u8::from(!report.passed)))
}

/// The run in a file, unless it is still being flown.
fn stored_run(path: &Path, runs: Option<&Runs>) -> Result<Stored, Text> {
    let text = store::read_run(path).map_err(|error| Text::verbatim(error.to_string()))?;
    let stored = Stored::read(&text)?;
    // A debrief shows the truth, which would help a flight that is still under way; so would the debrief of a copy.
    let head = &stored.head;
    if runs.is_some_and(|runs| runs.is_flown_now(&head.mission, head.seed)) {
        return Err(text!("record-under-way"));
    }
    Ok(stored)
}

/// Why the debrief of a record may not match its flight: damage, edits, a journal of another
/// flight, another score.
fn doubts(stored: &Stored, path: &Path, again: &Rescored) -> Vec<Text> {
    let files = RecordFiles::beside(path);
    let first_unix_us = TlogSpan::of(&files).map(|it| it.first_unix_us);
    let journal = files.head().ok();
    let now = again.report.score;
    let before = again.before.map(|end| end.score);
    let doubts = [
        stored.damage.clone(),
        stored.is_altered().then(|| text!("verify-altered")),
        journal.and_then(|head| stored.journal_fit(&head, first_unix_us).fault()),
        before
            .filter(|before| *before != now)
            .map(|before| text!("record-differs", before = before, now = now)),
    ];
    doubts.into_iter().flatten().collect()
}

/// The file of a run that is named by `last`, by its path, or by its record's number or name.
fn file_of_run(run: &str, runs: Option<&Runs>, settings: &CliSettings) -> Result<PathBuf, Failure> {
    let locale = Locale::new(settings.language());
    match (run, runs) {
        ("last", Some(runs)) => {
            settings.require_records(&locale)?;
            runs.newest().ok_or_else(|| {
                let folder = runs.folder().display().to_string();
                invalid(&text!("record-no-runs", folder = folder), &locale)
            })
        }
        (path, _) if Path::new(path).is_file() => {
            let path = PathBuf::from(path);
            Ok(RecordFiles::beside(&path).run.unwrap_or(path))
        }
        (named, _) => {
            let files = settings.find_record(named)?;
            let none = || text!("ghost-no-run", file = files.stem.as_str());
            files.run.clone().ok_or_else(|| invalid(&none(), &locale))
        }
    }
}

fn invalid(text: &Text, locale: &Locale) -> Failure {
    Failure::Invalid(format!("sortie: {}", locale.text(text)))
}
