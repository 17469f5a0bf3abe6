//! `sortie say`: lines for a console that runs elsewhere on this machine.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use serde::Deserialize;

use super::Failure;
use super::socket::ApiConnection;
use crate::api::Request;

/// Options of `sortie say`.
#[derive(Debug, Args)]
pub(super) struct SayArguments {
    /// The socket of the console, as given with --api.
    socket: PathBuf,
    /// Lines of the command grammar, such as "all takeoff 20"; each one waits until the previous one has ended.
    #[arg(required = true, value_name = "LINE")]
    lines: Vec<String>,
    /// Confirm lines that would ask the user, such as kill.
    #[arg(long)]
    confirm: bool,
    /// Print the console's answers as JSON lines.
    #[arg(long)]
    json: bool,
}

#[derive(Deserialize)]
struct ReadAccepted {
    id: Option<u64>,
    entry: Option<u32>,
    text: Option<String>,
}

#[derive(Deserialize)]
struct ReadFault {
    message: String,
    help: Option<String>,
    span: Option<[usize; 2]>,
    #[serde(default)]
    asks: bool,
}

#[derive(Deserialize)]
struct ReadRow {
    entry: u32,
    vehicle: u16,
    state: String,
    percent: Option<u8>,
    remark: Option<String>,
}

#[derive(Deserialize)]
struct ReadEnded {
    entry: u32,
    done: bool,
}

/// Sends the lines one after the other; stops at the first that is refused or not done.
pub(super) fn say(arguments: &SayArguments) -> Result<ExitCode, Failure> {
    let mut connection = ApiConnection::open(&arguments.socket)?;
    for line in &arguments.lines {
        let request = Request::Say {
            line: line.clone(),
            confirm: arguments.confirm,
        };
        let id = connection.send(&request)?;
        if !follow(&mut connection, arguments, line, id)? {
            return Ok(ExitCode::FAILURE);
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// Prints the outcome of a line; returns whether it was done for every vehicle.
fn follow(
    connection: &mut ApiConnection,
    arguments: &SayArguments,
    line: &str,
    id: u64,
) -> Result<bool, Failure> {
    let mut entry = None;
    while let Some(message) = connection.next()? {
        if arguments.json {
            say!("{}", message.text)?;
        }
        match message.kind.as_str() {
            "ok" => {
                let accepted: ReadAccepted = message.read()?;
                if let Some(text) = accepted.text.as_ref().filter(|_| !arguments.json) {
                    say!("{text}")?;
                }
                if accepted.id == Some(id) && accepted.entry.is_none() {
                    return Ok(true);
                }
                entry = accepted.entry;
            }
            "fault" => {
                explain(line, &message.read()?);
                return Ok(false);
            }
            "row" if !arguments.json => {
                let row: ReadRow = message.read()?;
                if Some(row.entry) == entry {
                    print(&row)?;
                }
            }
            "ended" => {
                let ended: ReadEnded = message.read()?;
                if Some(ended.entry) == entry {
                    return Ok(ended.done);
                }
            }
            _ => {}
        }
    }
    Err(Failure::Failed(anyhow::anyhow!(
        "the console has closed the connection"
    )))
}

fn print(row: &ReadRow) -> std::io::Result<()> {
    let percent = row
        .percent
        .map_or_else(String::new, |it| format!(" {it} %"));
    let remark = row
        .remark
        .as_ref()
        .map_or_else(String::new, |it| format!(": {it}"));
    say!(
        "vehicle {}: {}{percent}{remark}",
        row.vehicle,
        row.state.replace('_', " ")
    )
}

fn explain(line: &str, fault: &ReadFault) {
    tell!("sortie: {}", fault.message);
    if let Some([start, end]) = fault.span {
        let before = line.get(..start).map_or(0, |part| part.chars().count());
        let marked = line.get(start..end).map_or(1, |part| part.chars().count());
        tell!(
            "  {line}\n  {}{}",
            " ".repeat(before),
            "^".repeat(marked.max(1))
        );
    }
    if let Some(help) = &fault.help {
        tell!("{help}");
    }
    if fault.asks {
        tell!("give --confirm to carry it out");
    }
}
