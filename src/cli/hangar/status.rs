//! `sortie hangar status`: how the services are doing.

use std::process::ExitCode;

use clap::Args;

use super::super::settings::Settings;
use super::super::{Failure, runtime};
use super::services::ServiceOptions;
use crate::hangar::client::{ClientError, HangarAddress, Remote};
use crate::hangar::service::{PORT, Status};
use crate::hangar::{Instance, Token};

/// Options of `sortie hangar status`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie hangar status\n  \
    sortie hangar status --hangar http://127.0.0.1:5700 --json")]
pub(super) struct StatusArguments {
    #[command(flatten)]
    services: ServiceOptions,
}

/// Asks and prints; the exit code is 1 if one of them does not answer.
pub(super) fn status(options: &StatusArguments, settings: &Settings) -> Result<ExitCode, Failure> {
    let mut remotes = options.services.remotes(settings)?;
    if remotes.is_empty() {
        let host = "127.0.0.1".to_owned();
        let here = HangarAddress { host, port: PORT };
        let token = super::token_file(None, settings)
            .ok()
            .and_then(|file| Token::load(&file).ok());
        remotes.push(Remote::new(here, token));
    }
    let mut code = ExitCode::SUCCESS;
    for remote in remotes {
        match runtime()?.block_on(ask(&remote)) {
            Ok((status, instances)) => tell(&remote, &status, &instances)?,
            Err(error) => {
                eprintln!("sortie: {error}");
                code = ExitCode::from(1);
            }
        }
    }
    Ok(code)
}

async fn ask(remote: &Remote) -> Result<(Status, Vec<Instance>), ClientError> {
    Ok((remote.status().await?, remote.instances().await?))
}

fn tell(remote: &Remote, status: &Status, instances: &[Instance]) -> Result<(), Failure> {
    let (running, free) = (status.capacity.running, status.capacity.free);
    say!(
        "{remote}: sortie {}, {running} running, room for {free} more",
        status.version
    )?;
    for program in &status.programs {
        say!("  can start {} ({})", program.file, program.identity)?;
    }
    for leftover in &status.leftovers {
        say!("  left over: {leftover}")?;
    }
    for instance in instances {
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
