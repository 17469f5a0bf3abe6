//! `sortie class`: the instructor's desk, and the results of a class.
//!
//! `open` is the desk, `new` makes the keys of one for several machines, and `remove` takes a seat out of it (`network`).
//! `lessons` and `exams` list the plans that the desk can go through, `key` shows that of its seals. `report` prints the
//! results, and `export` writes them for other programs; both read the records that the trainees have handed in. Their
//! tables are in `tables`, and the statements for learning record stores in `xapi`.

use std::process::ExitCode;

use clap::{Args, Subcommand};

use super::Failure;
use super::fly;
use super::settings::CliSettings;
use crate::carrier::{DeskPlace, EVERY_ADDRESS, own_user_name};
use crate::shell::{ClassOptions, ConsoleOptions, Opening};
use export::ExportArguments;
use grades::GradesArguments;
use network::{NewArguments, RemoveArguments};
use report::ReportArguments;

mod exams;
mod export;
mod grades;
mod lessons;
mod network;
mod report;
mod results;
mod tables;
mod xapi;

/// Options of `sortie class`.
#[derive(Debug, Args)]
pub(super) struct ClassArguments {
    #[command(subcommand)]
    task: ClassTask,
}

#[derive(Debug, Subcommand)]
enum ClassTask {
    /// Makes a class for several machines: the keys of its desk, and a file for each seat with which a trainee joins.
    New(NewArguments),
    /// Takes a seat out of a class for several machines: its file was lost, or its trainee is to be kept out.
    Remove(RemoveArguments),
    /// Opens the instructor's desk: a board of all trainees who join the class, on this host or on several machines.
    #[command(after_help = "Examples:\n  \
                            sortie class open                  a class with your user name\n  \
                            sortie class open 9-A              trainees: sortie fly 00 --class 9-A\n  \
                            sortie class open /srv/class/9-A   a folder that you own\n  \
                            sortie class open 9-A --listen     several machines, after sortie class new 9-A")]
    Open {
        /// The name of the class, or the path of its folder; by default your user name.
        #[arg(value_name = "NAME|PATH")]
        name: Option<String>,
        /// Open the desk for several machines at this address, instead of for this host.
        #[arg(long, value_name = "HOST[:PORT]", num_args = 0..=1, default_missing_value = EVERY_ADDRESS)]
        listen: Option<String>,
        /// Keep grades under this name, so that several graders can be compared; by default your user name.
        #[arg(long, value_name = "NAME", value_parser = grader_name)]
        grader: Option<String>,
    },
    /// Lists the rubrics with which the desk grades flights.
    #[command(after_help = "Examples:\n  \
                            sortie class rubrics             the shipped one, and those in the folder rubrics\n  \
                            sortie check my-rubric.toml      checks a rubric of your own")]
    Rubrics,
    /// Prints the grades of a class: trainee by category, and how far graders agree.
    Grades(GradesArguments),
    /// Lists the lesson plans that the desk can begin.
    #[command(after_help = "Examples:\n  \
                            sortie class lessons             the shipped ones, and those in the folder lessons\n  \
                            sortie check my-lesson.toml      checks a plan of your own")]
    Lessons,
    /// Lists the exams that the desk can hold.
    #[command(after_help = "Examples:\n  \
                            sortie class exams             the shipped ones, and those in the folder exams\n  \
                            sortie check my-exam.toml      checks an exam of your own")]
    Exams,
    /// Prints the public key with which this desk seals exams, and its fingerprint.
    #[command(after_help = "Examples:\n  sortie class key")]
    Key,
    /// Prints the results of a class: trainee by mission, trainee by skill, and what the whole class does not know.
    Report(ReportArguments),
    /// Writes the results of a class for other programs: a spreadsheet, Moodle, xAPI, or a file per trainee.
    Export(ExportArguments),
}

/// Opens the desk of a class, or shows its results.
pub(super) fn class(
    arguments: &ClassArguments,
    settings: CliSettings,
) -> Result<ExitCode, Failure> {
    match &arguments.task {
        ClassTask::Exams => exams::exams(&settings),
        ClassTask::Key => exams::key(&settings),
        ClassTask::Lessons => lessons::lessons(&settings),
        ClassTask::New(arguments) => network::new(arguments, &settings),
        ClassTask::Remove(arguments) => network::remove(arguments, &settings),
        ClassTask::Open {
            name,
            listen,
            grader,
        } => {
            let own = own_user_name();
            let name = name.as_ref().unwrap_or(&own);
            let place = match listen {
                Some(listen) => network::desk(name, listen, &settings)?,
                None => network::desk_on_host(name, &settings)?,
            };
            let grader = grader.as_ref().unwrap_or(&own);
            let class = place
                .class()
                .unwrap_or(results::class_name(name))
                .to_owned();
            open(place, class, grader, settings)
        }
        ClassTask::Rubrics => grades::rubrics(&settings),
        ClassTask::Grades(arguments) => grades::grades(arguments, &settings),
        ClassTask::Report(arguments) => report::report(arguments, &settings),
        ClassTask::Export(arguments) => export::export(arguments, &settings),
    }
}

/// A name of a grader, which becomes part of the names of files.
fn grader_name(text: &str) -> Result<String, String> {
    let is_plain = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_');
    if !text.is_empty() && text.len() <= 64 && text.chars().all(is_plain) {
        Ok(text.to_owned())
    } else {
        Err("expected up to 64 letters, digits, `-` and `_`".to_owned())
    }
}

fn open(
    place: DeskPlace,
    name: String,
    grader: &str,
    settings: CliSettings,
) -> Result<ExitCode, Failure> {
    let class = ClassOptions::Desk {
        place,
        name,
        grader: grader.to_owned(),
    };
    let options = ConsoleOptions {
        class: Some(class),
        ..fly::options(Opening::Home, settings)?
    };
    fly::open(options, false)
}
