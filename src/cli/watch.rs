//! `sortie watch`: the state of a console that runs elsewhere on this machine.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use strum::VariantArray as _;

use super::Failure;
use super::socket::ApiConnection;
use crate::api::{self, Request, Topic};

/// Options of `sortie watch`.
#[derive(Debug, Args)]
pub(super) struct WatchArguments {
    /// The socket of the console, as given with --api or --api-read-only.
    #[arg(required_unless_present = "schema")]
    socket: Option<PathBuf>,
    /// The topics: vehicles, notices, ledger, mission; all of them if none is named.
    #[arg(value_name = "TOPIC", value_parser = topic_parser())]
    topics: Vec<Topic>,
    /// Wait at least this many seconds between two states of a topic.
    #[arg(long, value_name = "S", default_value_t = api::USUAL_WATCH_S)]
    every: f64,
    /// Print the JSON schema of the interface and exit.
    #[arg(long)]
    schema: bool,
}

fn topic_parser() -> impl TypedValueParser<Value = Topic> {
    let names = Topic::VARIANTS.iter().map(<&str>::from);
    PossibleValuesParser::new(names).try_map(|name| name.parse::<Topic>())
}

/// Prints the console's messages until the connection ends.
pub(super) fn watch(arguments: &WatchArguments) -> Result<ExitCode, Failure> {
    if arguments.schema {
        say!("{}", serde_json::to_string_pretty(&api::schema())?)?;
        return Ok(ExitCode::SUCCESS);
    }
    let Some(socket) = &arguments.socket else {
        return Ok(ExitCode::SUCCESS);
    };
    let mut connection = ApiConnection::open(socket)?;
    let what = if arguments.topics.is_empty() {
        Topic::VARIANTS.to_vec()
    } else {
        arguments.topics.clone()
    };
    connection.send(&Request::Watch {
        what,
        every_s: Some(arguments.every),
    })?;
    while let Some(message) = connection.next()? {
        match message.kind.as_str() {
            "welcome" | "ok" => {}
            "fault" => return Err(message.fault()),
            _ => say!("{}", message.text)?,
        }
    }
    Ok(ExitCode::SUCCESS)
}
