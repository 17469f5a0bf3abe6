//! `sortie bench fidelity`: the embedded simulator compared with recordings of the real
//! `ArduCopter`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use serde::Serialize;

use super::super::Failure;
use crate::fidelity::{self, Answers, Comparison, Flight, Recording};

/// The recordings in a checkout of the sources.
const RECORDINGS: &str = "tests/data/fidelity";
/// The suffix of a recording of sent frames.
const SENT: &str = ".tx.tlog";
/// The maximum number of answers of one kind that the table names.
const NAMED: usize = 6;

/// Options of `sortie bench fidelity`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie bench fidelity\n  \
    sortie bench fidelity --against recordings --json\n\n\
    A recording has two files: NAME.tlog from the vehicle, and NAME.tx.tlog, which was sent to it.")]
pub(in crate::cli) struct FidelityArguments {
    /// Compare with the recordings in this folder [default: tests/data/fidelity, in a checkout of the sources].
    #[arg(long, value_name = "FOLDER")]
    against: Option<PathBuf>,
    /// Print one JSON document instead of the tables.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Serialize)]
struct Compared {
    recording: String,
    #[serde(flatten)]
    comparison: Comparison,
}

/// Repeats the recorded flights in the simulator, compares them, and prints the differences.
pub(in crate::cli) fn fidelity(options: &FidelityArguments) -> Result<ExitCode, Failure> {
    let folder = options.against.clone().unwrap_or_else(|| RECORDINGS.into());
    let mut compared = Vec::new();
    for name in names(&folder)? {
        let heard = bytes(&folder.join(format!("{name}.tlog")))?;
        let sent = bytes(&folder.join(format!("{name}{SENT}")))?;
        let comparison = fidelity::fly(&Recording::from_tlogs(&heard, &sent));
        if !options.json {
            table(&name, &comparison)?;
        }
        compared.push(Compared {
            recording: name,
            comparison,
        });
    }
    if options.json {
        say!("{}", serde_json::to_string(&compared)?)?;
    }
    Ok(ExitCode::SUCCESS)
}

/// The recordings of a folder that hold both directions, in alphabetical order.
fn names(folder: &Path) -> Result<Vec<String>, Failure> {
    let none = |what: String| {
        Failure::Invalid(format!(
            "sortie: {what}: name a folder with NAME.tlog and NAME{SENT} with --against, or start this in a checkout \
             of sortie's sources"
        ))
    };
    let entries = folder
        .read_dir()
        .map_err(|error| none(format!("cannot read {}: {error}", folder.display())))?;
    let mut names: Vec<String> = entries
        .flatten()
        .filter_map(|entry| Some(entry.file_name().to_str()?.strip_suffix(SENT)?.to_owned()))
        .filter(|name| folder.join(format!("{name}.tlog")).exists())
        .collect();
    names.sort();
    if names.is_empty() {
        return Err(none(format!("no recordings in {}", folder.display())));
    }
    Ok(names)
}

fn bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    std::fs::read(path).map_err(|error| {
        Failure::Invalid(format!("sortie: cannot read {}: {error}", path.display()))
    })
}

fn table(name: &str, comparison: &Comparison) -> Result<(), Failure> {
    say!(
        "{name}: root-mean-square and largest difference between the embedded simulator and the recording"
    )?;
    say!(
        "{:<34} {:>6} {:>5} {:>6} {:>13} {:>13} {:>11} {:>11} {:>11} {:>13} {:>11} {:>17}",
        "manoeuvre",
        "at s",
        "for s",
        "top",
        "position m",
        "altitude m",
        "speed m/s",
        "roll deg",
        "pitch deg",
        "yaw deg",
        "voltage V",
        "there, s: it, we"
    )?;
    for flight in &comparison.manoeuvres {
        row(flight)?;
    }
    for answers in &comparison.answers {
        answered(answers)?;
    }
    say!("")?;
    Ok(())
}

fn row(flight: &Flight) -> Result<(), Failure> {
    let pair = |d: fidelity::Difference| format!("{:.2} {:.2}", d.rms, d.largest);
    let seconds = |time: Option<f64>| time.map_or_else(|| "-".to_owned(), |s| format!("{s:.1}"));
    let later = flight
        .later_percent()
        .map_or_else(String::new, |percent| format!(" {percent:+.1} %"));
    say!(
        "{:<34} {:>6.1} {:>5.1} {:>6.1} {:>13} {:>13} {:>11} {:>11} {:>11} {:>13} {:>11} {:>17}",
        flight.name,
        flight.at_s,
        flight.compared_s,
        flight.top_speed_m_s,
        pair(flight.position_m),
        pair(flight.altitude_m),
        pair(flight.velocity_m_s),
        pair(flight.roll_deg),
        pair(flight.pitch_deg),
        pair(flight.yaw_deg),
        pair(flight.voltage_v),
        format!(
            "{} {}{later}",
            seconds(flight.recorded_reach_s),
            seconds(flight.simulated_reach_s)
        )
    )?;
    Ok(())
}

fn answered(answers: &Answers) -> Result<(), Failure> {
    let Answers {
        kind,
        recorded,
        simulated,
        ..
    } = answers;
    let Some(first) = &answers.first_difference else {
        say!("{kind}: {recorded}, identical in order")?;
        return Ok(());
    };
    let said = |text: &Option<String>| text.clone().unwrap_or_else(|| "nothing".to_owned());
    say!(
        "{kind}: {recorded} recorded, {simulated} simulated; the first difference is no. {} at {:.1} s: recorded {}, \
         simulated {}",
        first.place + 1,
        first.at_s,
        said(&first.recorded),
        said(&first.simulated)
    )?;
    for (word, texts) in [("missing", &answers.missing), ("extra", &answers.extra)] {
        for (text, count) in texts.iter().take(NAMED) {
            say!("  {word} {count} times: {text}")?;
        }
        if texts.len() > NAMED {
            say!("  {word}: {} more", texts.len() - NAMED)?;
        }
    }
    Ok(())
}
