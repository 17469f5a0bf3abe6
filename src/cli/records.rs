//! `sortie records`: the recorded flights.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use clap::{Args, Subcommand};
use serde::Serialize;

use super::Failure;
use super::settings::CliSettings;
use super::table::{Side, TextTable};
use crate::record::{Head, JournalFit, JournalNeighbours};
use crate::replay::{Replay, TlogSpan};
use crate::scoring::Medal;
use crate::store::{RecordFiles, Records};
use crate::text;
use crate::text::{Locale, Text, clock, figure, utc_minute_of, utc_of};
use crate::vehicle_id::parse_ranges;

mod export;
mod join;
mod show;
mod sign;

use export::RecordFormat;
use join::JoinArguments;
use sign::{KeyArguments, SignArguments};

/// The maximum number of columns of the list, and the index of the column that is cut for that.
const WIDTH: usize = 80;
const SUBJECT: usize = 2;

/// Options of `sortie records`.
#[derive(Debug, Args)]
pub(super) struct RecordsArguments {
    #[command(subcommand)]
    command: RecordsCommand,
}

#[derive(Debug, Subcommand)]
enum RecordsCommand {
    /// Lists the records, the newest first.
    #[command(after_help = "Examples:\n  sortie records list\n  sortie records list --json")]
    List {
        /// Print one JSON document instead of a table.
        #[arg(long)]
        json: bool,
    },
    /// Shows the content of a record: its files, its duration, its moments.
    #[command(after_help = "Examples:\n  sortie records show\n  sortie records show 3 --json")]
    Show {
        /// The number in the list, or a file; by default the newest record.
        #[arg(default_value = "1")]
        record: String,
        /// Print one JSON document instead of tables.
        #[arg(long)]
        json: bool,
    },
    /// Exports a record or any tlog, with all vehicles and messages, for other programs; or exports its review.
    #[command(after_help = "Examples:\n  \
                            sortie records export 1 --format kml --output flight.kml\n  \
                            sortie records export flight.tlog --format csv --output tables\n  \
                            sortie records export 1 --format mcap --output flight.mcap\n  \
                            sortie records export 1 --format md --output review.md")]
    Export {
        /// The number in the list, or a file.
        record: String,
        /// Write this format: csv (a folder with a table for each kind of message), kml, gpx, geojson, mcap, or md
        /// (the review).
        #[arg(long, value_enum)]
        format: RecordFormat,
        /// Write to this file or folder, which must not exist yet, a device or a FIFO; `-` is standard output.
        #[arg(long, value_name = "PATH")]
        output: PathBuf,
    },
    /// Creates a key for signing records, as `minisign -G` does.
    #[command(
        after_help = "Examples:\n  sortie records key\n  sortie records key --output keys --no-password"
    )]
    Key(KeyArguments),
    /// Signs the files of a record with your key; `sortie verify --public-key` and `minisign -V` check the signatures.
    #[command(
        after_help = "Examples:\n  sortie records sign\n  sortie records sign 3 --key keys/minisign.key"
    )]
    Sign(SignArguments),
    /// Joins the `DataFlash` log of a vehicle to a record: modes, errors, events, changed parameters, vibration, EKF
    /// and battery become moments.
    #[command(
        after_help = "Examples:\n  sortie records join logs/v3-log12.bin\n  sortie records join flight.bin 4 --vehicle 3"
    )]
    Join(JoinArguments),
    /// Deletes records; profiles keep the flights that count.
    #[command(after_help = "Examples:\n  sortie records delete 3 5-7 --yes")]
    Delete {
        /// The numbers in the list: `3`, `2-5` or `1,4-6`.
        #[arg(required = true, value_name = "NUMBERS")]
        records: Vec<String>,
        /// Delete the records; without this option, the command only names them.
        #[arg(long)]
        yes: bool,
    },
}

#[derive(Debug, Serialize)]
struct ListedRecord {
    /// The record's number in the list; `None` for a file from elsewhere.
    number: Option<usize>,
    name: String,
    began: String,
    #[serde(skip)]
    began_unix_us: Option<u64>,
    subject: String,
    profile: Option<String>,
    /// Whether the record belongs to a run of a mission.
    has_run: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    seed: Option<u64>,
    /// The result of the mission, if it was flown to its end.
    #[serde(skip_serializing_if = "Option::is_none")]
    result: Option<ListedResult>,
    /// Whether the console was killed during the flight, so the journal has no end.
    cut_off: bool,
    duration_s: Option<f64>,
    bytes: u64,
    being_recorded: bool,
}

#[derive(Debug, Clone, Copy, Serialize)]
struct ListedResult {
    score: u16,
    passed: bool,
    medal: Option<Medal>,
}

/// Carries out the command.
pub(super) fn records(
    arguments: &RecordsArguments,
    settings: &CliSettings,
) -> Result<ExitCode, Failure> {
    let records = settings
        .records()
        .ok_or_else(|| Failure::Failed(anyhow::anyhow!("no folder for records: use --data")))?;
    let commands = RecordsCommands {
        locale: Locale::new(settings.language()),
        settings,
        records,
    };
    match &arguments.command {
        RecordsCommand::List { json } => commands.list(*json),
        RecordsCommand::Show { record, json } => commands.show(record, *json),
        RecordsCommand::Export {
            record,
            format,
            output,
        } => commands.export(record, *format, output),
        RecordsCommand::Key(arguments) => commands.make_key(arguments),
        RecordsCommand::Sign(arguments) => commands.sign(arguments),
        RecordsCommand::Join(arguments) => commands.join(arguments),
        RecordsCommand::Delete { records, yes } => commands.delete(records, *yes),
    }?;
    Ok(ExitCode::SUCCESS)
}

pub(super) struct RecordsCommands<'a> {
    pub(super) records: Records,
    pub(super) locale: Locale,
    /// The user's settings; for example, they decide which alerts a replay raises.
    settings: &'a CliSettings,
}

impl RecordsCommands<'_> {
    fn invalid(&self, fault: &Text) -> Failure {
        Failure::Invalid(format!("sortie: {}", self.locale.text(fault)))
    }

    /// The records with their numbers, the newest first.
    fn numbered(&self) -> impl Iterator<Item = (usize, RecordFiles)> {
        (1..).zip(self.records.list().into_iter().rev())
    }

    /// The record named by its number in the list or by one of its files.
    pub(super) fn find(&self, named: &str) -> Result<RecordFiles, Failure> {
        self.settings.find_record(named)
    }

    /// A record for the list; `number` is its number in the list, or `None` for a file from
    /// elsewhere.
    fn listed(&self, number: Option<usize>, files: &RecordFiles) -> ListedRecord {
        // The first and the last frame give the duration: a list of 200 records must not require
        // reading all frames.
        let span = TlogSpan::of(files);
        let head = files.head().ok();
        let run = files.run_outline();
        let beside = JournalNeighbours {
            mission: run.as_ref().map(|(head, _)| head.mission.as_str()),
            first_unix_us: span.map(|it| it.first_unix_us),
        };
        let fits = |head: &&Head| JournalFit::of(head, beside) == JournalFit::Fits;
        let journalled = head.as_ref().filter(fits).map(|it| it.began_unix_us);
        let began = journalled.or(span.map(|it| it.first_unix_us));
        ListedRecord {
            number,
            name: files.stem.clone(),
            began: began.map(utc_of).unwrap_or_default(),
            began_unix_us: began,
            subject: head
                .as_ref()
                .map(|it| self.locale.text(&it.subject.text()))
                .unwrap_or_default(),
            profile: head.and_then(|it| it.profile),
            has_run: files.run.is_some(),
            seed: run.as_ref().map(|(head, _)| head.seed),
            result: run.and_then(|(_, end)| end).map(|end| ListedResult {
                score: end.score,
                passed: end.passed,
                medal: end.medal,
            }),
            cut_off: files.is_cut_off(),
            duration_s: span
                .zip(began)
                .map(|(span, began)| span.length_from(began).as_secs_f64()),
            bytes: files.bytes,
            being_recorded: files.is_written(),
        }
    }

    fn list(&self, json: bool) -> Result<(), Failure> {
        self.settings.require_records(&self.locale)?;
        let all: Vec<ListedRecord> = self
            .numbered()
            .map(|(number, files)| self.listed(Some(number), &files))
            .collect();
        if json {
            say!("{}", serde_json::to_string_pretty(&all)?)?;
            return Ok(());
        }
        let bytes: u64 = all.iter().map(|it| it.bytes).sum();
        if !all.is_empty() {
            let table = self.table(&all).fitted(SUBJECT, WIDTH);
            say!("{}", table.plain().trim_end())?;
        }
        let limits = self.records.limits();
        let text = text!(
            "records-total",
            count = all.len(),
            size = mebibytes(bytes),
            most = limits.count,
            space = mebibytes(limits.bytes)
        );
        say!("{}", self.locale.text(&text))?;
        Ok(())
    }

    /// The list as a table that fits into 80 columns; `records show` adds the seed, JSON the seconds too.
    fn table(&self, records: &[ListedRecord]) -> TextTable {
        let columns = [
            (text!("records-number"), Side::Right),
            (text!("records-began"), Side::Left),
            (text!("records-subject"), Side::Left),
            (text!("records-length"), Side::Right),
            (text!("records-result"), Side::Left),
            ("MiB".into(), Side::Right),
            (text!("records-profile"), Side::Left),
        ];
        let mut table = TextTable::new(&self.locale, &columns);
        for record in records {
            let length = record.duration_s.map(Duration::from_secs_f64).map(clock);
            table.push(vec![
                record.number.map_or("-".to_owned(), |it| it.to_string()),
                record.began_unix_us.map(utc_minute_of).unwrap_or_default(),
                record.subject.clone(),
                length.unwrap_or_default(),
                self.locale.text(&result_of(record)),
                mebibytes(record.bytes),
                record.profile.clone().unwrap_or_default(),
            ]);
        }
        table
    }

    /// Reads a recording completely.
    fn read(&self, files: &RecordFiles) -> Result<Replay, Failure> {
        let Some(frames) = &files.frames else {
            let text = text!("replay-no-frames", file = files.stem.as_str());
            return Err(self.invalid(&text));
        };
        Replay::read_through(frames, &self.settings.config).map_err(|fault| self.invalid(&fault))
    }

    fn delete(&self, listed: &[String], yes: bool) -> Result<(), Failure> {
        let mut numbers = BTreeSet::new();
        for ranges in listed {
            let wrong = |_| self.invalid(&text!("records-not-numbers", word = ranges.as_str()));
            if let Some(range) = ranges.split(',').find(|range| is_reversed(range)) {
                return Err(self.invalid(&text!("records-reversed", range = range)));
            }
            numbers.extend(parse_ranges(ranges).map_err(wrong)?);
        }
        self.settings.require_records(&self.locale)?;
        let found = numbers
            .into_iter()
            .map(|number| {
                let found = self.records.numbered(usize::from(number));
                found.map_err(|fault| self.invalid(&fault))
            })
            .collect::<Result<Vec<RecordFiles>, Failure>>()?;
        for files in &found {
            if files.is_written() {
                let text = text!("records-in-use", name = files.stem.as_str());
                return Err(self.invalid(&text));
            }
        }
        if !yes {
            let question = text!("records-confirm", count = found.len());
            let names = found.iter().map(|it| format!("  {}", it.stem).into());
            let lines = std::iter::once(question).chain(names).collect();
            return Err(self.invalid(&Text::joined("\n", lines)));
        }
        for files in &found {
            files.delete()?;
            files.delete_review()?;
            let text = text!("records-deleted", name = files.stem.as_str());
            say!("{}", self.locale.text(&text))?;
        }
        Ok(())
    }
}

/// The entry in the column "result": the mission's result, "recording" or "cut off"; empty for other records.
fn result_of(record: &ListedRecord) -> Text {
    match record.result {
        _ if record.being_recorded => text!("records-now"),
        None if record.cut_off => text!("records-cut-off"),
        None => Text::default(),
        Some(ListedResult {
            score,
            passed: false,
            ..
        }) => text!("records-failed", score = score),
        Some(ListedResult {
            score, medal: None, ..
        }) => text!("records-passed", score = score),
        Some(ListedResult {
            score,
            medal: Some(medal),
            ..
        }) => Text::joined(" ", vec![medal.title(), score.to_string().into()]),
    }
}

/// Whether a range of numbers ends before it begins. Such a typing error must not delete anything.
fn is_reversed(range: &str) -> bool {
    let ends = range.split_once('-').and_then(|(first, last)| {
        let number = |word: &str| word.trim().parse::<usize>().ok();
        Some((number(first)?, number(last)?))
    });
    ends.is_some_and(|(first, last)| first > last)
}

fn mebibytes(bytes: u64) -> String {
    figure(bytes as f64 / f64::from(1024 * 1024), 1)
}
