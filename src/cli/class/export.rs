//! `sortie class export`: the results of a class for other programs.

use std::fs::DirBuilder;
use std::io;
use std::os::unix::fs::DirBuilderExt as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, ValueEnum};

use super::grades::{self, ReadGrades};
use super::results::ReadClass;
use super::tables;
use super::xapi::Statements;
use crate::class_results::{ClassFlight, ClassTrainee};
use crate::cli::Failure;
use crate::cli::progress;
use crate::cli::settings::CliSettings;
use crate::cli::table::escaped;
use crate::store::{StoreError, is_stream, write_new_output};
use crate::text;
use crate::text::{Locale, Text};

/// Options of `sortie class export`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
                        sortie class export 9-A --format csv --output 9-A.csv\n  \
                        sortie class export 9-A --format moodle --output grades.csv\n  \
                        sortie class export 9-A --format md --output 9-A\n  \
                        sortie class export 9-A --format xapi --home-page https://lab.example.org --output 9-A.jsonl")]
pub(super) struct ExportArguments {
    /// The name of the class, or the path of its folder; by default your user name.
    #[arg(value_name = "NAME|PATH")]
    name: Option<String>,
    /// Write the results in this format.
    #[arg(long, value_enum)]
    format: ClassFormat,
    /// Write to this file, or with `md` to this folder, which must not exist yet; `-` is standard output.
    #[arg(long, value_name = "PATH")]
    output: PathBuf,
    /// The address of the system on which the trainees have their accounts, for xAPI; by default that of this host.
    #[arg(long, value_name = "URL", value_parser = home_page)]
    home_page: Option<String>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum ClassFormat {
    /// Comma-separated values: a row for each trainee and objective.
    Csv,
    /// Comma-separated values for Moodle's import of grades: a row for each trainee, in percent.
    Moodle,
    /// Markdown: a folder with a file for each trainee.
    Md,
    /// xAPI statements, one per line: every flight.
    Xapi,
    /// Comma-separated values: a row for each graded element and grader.
    Grades,
}

/// An address for accounts: an absolute one without spaces.
fn home_page(text: &str) -> Result<String, String> {
    let is_address = (text.starts_with("https://") || text.starts_with("http://"))
        && text.len() > "https://".len()
        && !text.contains(char::is_whitespace);
    if is_address {
        Ok(text.to_owned())
    } else {
        Err("expected an address, such as https://lab.example.org".to_owned())
    }
}

pub(super) fn export(
    arguments: &ExportArguments,
    settings: &CliSettings,
) -> Result<ExitCode, Failure> {
    let output = &arguments.output;
    let locale = &Locale::new(settings.language());
    let name = arguments.name.as_deref();
    let read = || ReadClass::read(name, settings);
    let text = match arguments.format {
        ClassFormat::Md => {
            write_folder(&read()?, output).map_err(|error| failed(locale, &error))?;
            return done(locale, output);
        }
        ClassFormat::Csv => tables::rows(&read()?.trainees, locale).csv()?,
        ClassFormat::Moodle => tables::moodle(&read()?.results(), locale).csv()?,
        ClassFormat::Grades => {
            let grades = ReadGrades::read(name, settings, locale)?;
            grades::rows(&grades, locale).csv()?
        }
        ClassFormat::Xapi => {
            let class = read()?;
            let home_page = arguments.home_page.clone().unwrap_or_else(own_home_page);
            let statements = Statements {
                class: &class.name,
                home_page: &home_page,
            };
            statements.lines(&class.trainees)
        }
    };
    write(output, &text, locale)
}

fn write(output: &Path, text: &str, locale: &Locale) -> Result<ExitCode, Failure> {
    write_new_output(output, text).map_err(|error| failed(locale, &error))?;
    done(locale, output)
}

fn done(locale: &Locale, output: &Path) -> Result<ExitCode, Failure> {
    if !is_stream(output) {
        let text = text!("export-done", path = output.display().to_string());
        say!("{}", locale.text(&text))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn failed(locale: &Locale, error: &StoreError) -> Failure {
    Failure::Failed(anyhow::anyhow!(locale.text(&Text::from(error))))
}

/// The address of this host.
fn own_home_page() -> String {
    let name = std::fs::read_to_string("/proc/sys/kernel/hostname").unwrap_or_default();
    let plain = |c: &char| c.is_ascii_alphanumeric() || matches!(c, '-' | '.');
    let name: String = name.trim().chars().filter(plain).collect();
    let host = if name.is_empty() { "localhost" } else { &name };
    format!("https://{host}")
}

/// Writes a file for each trainee.
fn write_folder(class: &ReadClass, folder: &Path) -> Result<(), StoreError> {
    let made = DirBuilder::new().mode(0o700).create(folder);
    made.map_err(|error| {
        let path = folder.to_owned();
        match error.kind() {
            io::ErrorKind::AlreadyExists => StoreError::Exists { path },
            _ => StoreError::Unwritable { path, error },
        }
    })?;
    for trainee in &class.trainees {
        let plain = |c: char| if c == '/' || c.is_control() { '_' } else { c };
        let name: String = trainee.user.chars().map(plain).collect();
        let path = folder.join(format!("{name}.md"));
        write_new_output(&path, &markdown(class, trainee))?;
    }
    Ok(())
}

/// The results of a trainee.
fn markdown(class: &ReadClass, trainee: &ClassTrainee) -> String {
    let locale = &class.locale;
    let words = |text| locale.text(&text);
    let mut progress = trainee.progress(&class.course, class.day);
    progress.missions.retain(|it| it.tries > 0);
    let flights = trainee.flights.len();
    let mut text = format!(
        "# {}\n\n{}{}\n\n## {}\n\n{}\n## {}\n\n{}",
        escaped(&trainee.user),
        words(text!(
            "class-report-trainee",
            class = escaped(&class.name),
            count = flights
        )),
        of_profiles(trainee, locale),
        words(text!("progress-missions")),
        progress::missions(&progress, locale).markdown(),
        words(text!("progress-skills")),
        progress::skills(&progress, locale).markdown(),
    );
    let uncounted = tables::uncounted(trainee, locale);
    if !uncounted.is_empty() {
        let heading = words(text!("class-report-uncounted"));
        text += &["\n## ", &heading, "\n\n", &uncounted.markdown()].concat();
    }
    let instructed = tables::instructed(std::slice::from_ref(trainee), locale);
    if !instructed.is_empty() {
        let heading = words(text!("class-report-instructed"));
        text += &["\n## ", &heading, "\n\n", &instructed.markdown()].concat();
    }
    let mut missing = class.missing.clone();
    missing.retain(|it| it.user == trainee.user);
    let exams = tables::exams(std::slice::from_ref(trainee), &missing, locale);
    if !exams.is_empty() {
        let heading = words(text!("class-report-exams"));
        text += &["\n## ", &heading, "\n\n", &exams.markdown()].concat();
    }
    for best in trainee.best_flights() {
        text += &best_markdown(class, best);
    }
    text
}

/// The names of the trainee's profiles, if there are some.
fn of_profiles(trainee: &ClassTrainee, locale: &Locale) -> String {
    let profiles = trainee.profiles();
    if profiles.is_empty() {
        return String::new();
    }
    let profiles = escaped(&profiles.join(", "));
    let text = text!("class-report-of-profiles", profiles = profiles);
    format!(" {}", locale.text(&text))
}

fn best_markdown(class: &ReadClass, best: &ClassFlight) -> String {
    let locale = &class.locale;
    let heading = text!(
        "class-report-best",
        mission = escaped(&best.flight.mission),
        score = best.flight.score,
        when = best.when.as_str()
    );
    let table = tables::objectives_of(&best.objectives, locale);
    format!("\n## {}\n\n{}", locale.text(&heading), table.markdown())
}
