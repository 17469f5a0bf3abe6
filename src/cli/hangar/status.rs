//! `sortie hangar status`: the state of the services.

use std::process::ExitCode;

use clap::Args;
use futures_util::future::join_all;
use serde::Serialize;

use super::super::settings::CliSettings;
use super::super::{Failure, runtime};
use super::services::ServiceOptions;
use crate::hangar::client::{HangarAddress, RemoteHangar};
use crate::hangar::service::{PORT, Status};
use crate::hangar::{HangarToken, Instance};

/// Options of `sortie hangar status`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie hangar status\n  \
    sortie hangar status --hangar http://127.0.0.1:5700 --json")]
pub(super) struct StatusArguments {
    /// Print one JSON document instead of lines.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    services: ServiceOptions,
}

/// The known state of one service.
#[derive(Debug, Serialize)]
struct StatusAnswer {
    hangar: String,
    status: Option<Status>,
    vehicles: Vec<Instance>,
    /// Why the state is unknown, if it is.
    fault: Option<String>,
}

/// Requests the state of the services and prints it; exit code 1 if one of them does not answer.
pub(super) fn status(
    options: &StatusArguments,
    settings: &CliSettings,
) -> Result<ExitCode, Failure> {
    let mut remotes = options.services.remotes(settings)?;
    if remotes.is_empty() {
        let host = "127.0.0.1".to_owned();
        let here = HangarAddress { host, port: PORT };
        let token = super::token_file(None, settings)
            .ok()
            .and_then(|file| HangarToken::load(&file).ok());
        remotes.push(RemoteHangar::new(here, token));
    }
    let answers: Vec<StatusAnswer> = runtime()?.block_on(join_all(remotes.iter().map(ask)));
    if options.json {
        say!("{}", serde_json::to_string_pretty(&answers)?)?;
    } else {
        for answer in &answers {
            tell(answer)?;
        }
    }
    let all_answer = answers.iter().all(|answer| answer.fault.is_none());
    Ok(ExitCode::from(u8::from(!all_answer)))
}

async fn ask(remote: &RemoteHangar) -> StatusAnswer {
    let (status, vehicles, fault) = match tokio::try_join!(remote.status(), remote.instances()) {
        Ok((status, vehicles)) => (Some(status), vehicles, None),
        Err(error) => (None, Vec::new(), Some(error.to_string())),
    };
    StatusAnswer {
        hangar: remote.to_string(),
        status,
        vehicles,
        fault,
    }
}

fn tell(answer: &StatusAnswer) -> Result<(), Failure> {
    if let Some(fault) = &answer.fault {
        tell!("sortie: {fault}");
    }
    let Some(status) = &answer.status else {
        return Ok(());
    };
    let (running, free) = (status.capacity.running, status.capacity.free);
    say!(
        "{}: sortie {}, {running} running, room for {free} more",
        answer.hangar,
        status.version
    )?;
    for program in &status.programs {
        say!("  can start {} ({})", program.file, program.identity)?;
    }
    for leftover in &status.leftovers {
        say!("  left over: {leftover}")?;
    }
    for instance in &answer.vehicles {
        let (id, system) = (instance.id, instance.system);
        let fault = instance.fault.as_ref().map(|fault| format!(": {fault}"));
        let stage = instance.stage.word();
        say!(
            "  vehicle {id} (system {system}): {stage}{}",
            fault.unwrap_or_default()
        )?;
    }
    Ok(())
}
