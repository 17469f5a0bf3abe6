//! `sortie hangar identify`: the SITL programs that are found, and their versions.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use serde::Serialize;

use super::super::programs::ProgramOptions;
use super::super::settings::CliSettings;
use super::super::{Failure, runtime};
use crate::hangar::programs::{self, PATIENCE, ProgramIdentity};
use crate::sitl::SitlKind;

/// Options of `sortie hangar identify`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie hangar identify\n  \
    sortie hangar identify ~/ardupilot/build/sitl/bin/arducopter")]
pub(super) struct IdentifyArguments {
    /// The programs to identify; by default those that a hangar would start.
    #[arg(value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Print one JSON document instead of lines.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    programs: ProgramOptions,
}

#[derive(Debug, Serialize)]
struct IdentifyAnswer {
    /// The vehicle type for which the program was looked up, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    wanted: Option<SitlKind>,
    file: Option<PathBuf>,
    /// Why this file was chosen: the option, the setting or the search.
    by: Option<String>,
    identity: Option<ProgramIdentity>,
    fault: Option<String>,
}

/// Identifies the programs and prints the results; exit code 1 if a program is not as expected, or
/// none was found.
pub(super) fn identify(
    options: &IdentifyArguments,
    settings: &CliSettings,
) -> Result<ExitCode, Failure> {
    let answers = runtime()?.block_on(async {
        let mut answers = Vec::new();
        for file in &options.files {
            answers.push(ask(file, None, None).await);
        }
        if options.files.is_empty() {
            let programs = options.programs.find(settings);
            for &kind in SitlKind::ALL {
                answers.push(match programs.of(kind) {
                    Ok(found) => ask(&found.file, Some(kind), Some(found.by.clone())).await,
                    Err(missing) => IdentifyAnswer {
                        wanted: Some(kind),
                        file: None,
                        by: None,
                        identity: None,
                        fault: Some(missing.to_string()),
                    },
                });
            }
        }
        answers
    });
    if options.json {
        say!("{}", serde_json::to_string_pretty(&answers)?)?;
    } else {
        for answer in &answers {
            say!("{}", line(answer))?;
        }
    }
    // Few users have all four programs; a missing one is not a fault, unless all are missing.
    let is_wrong = |it: &IdentifyAnswer| it.file.is_some() && it.fault.is_some();
    let is_bad = answers.iter().any(is_wrong) || answers.iter().all(|it| it.file.is_none());
    Ok(ExitCode::from(u8::from(is_bad)))
}

async fn ask(file: &Path, wanted: Option<SitlKind>, by: Option<String>) -> IdentifyAnswer {
    let (identity, mut fault) = match programs::identify(file, PATIENCE).await {
        Ok(identity) => (Some(identity), None),
        Err(unknown) => (None, Some(unknown.to_string())),
    };
    if let (Some(wanted), Some(identity)) = (wanted, &identity)
        && wanted != identity.kind
    {
        fault = Some(format!(
            "it is a {}, but a {} is expected here",
            identity.kind.name(),
            wanted.name()
        ));
    }
    IdentifyAnswer {
        wanted,
        file: Some(file.to_owned()),
        by,
        identity,
        fault,
    }
}

fn line(answer: &IdentifyAnswer) -> String {
    let mut words = Vec::new();
    if let Some(wanted) = answer.wanted {
        words.push(format!("{:<7}", wanted.name()));
    }
    if let (Some(file), Some(identity)) = (&answer.file, &answer.identity) {
        let ProgramIdentity {
            kind,
            version,
            hash,
            ..
        } = identity;
        words.push(format!(
            "{}: {} {version} ({hash})",
            file.display(),
            kind.name()
        ));
        words.extend(answer.by.as_ref().map(|by| format!("[{by}]")));
    }
    words.extend(answer.fault.as_ref().map(|fault| format!("FAULT {fault}")));
    words.join(" ")
}
