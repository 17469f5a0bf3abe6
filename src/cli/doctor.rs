//! `sortie doctor`: checks of this machine, with advice.

use std::process::ExitCode;

use clap::Args;
use serde::Serialize;

use super::fault::FileFault;
use super::programs::ProgramOptions;
use super::settings::CliSettings;
use super::{Failure, runtime};
use crate::diagnostic::first_shown;
use crate::shell::mission_faults;
use folder::shell_word;

mod class;
mod folder;
mod host;
mod mount;
mod sitl;
mod terminal;

/// Options of `sortie doctor`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie doctor\n  \
    sortie doctor --json | jq '.[] | select(.verdict == \"fault\")'")]
pub(super) struct DoctorArguments {
    /// Print one JSON document instead of lines.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    programs: ProgramOptions,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
enum CheckResult {
    Ok,
    /// The checked part works, with a remark.
    Note,
    /// The checked part does not work.
    Fault,
}

#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
struct HostFinding {
    /// The subject of the check, such as a folder or a program.
    about: String,
    verdict: CheckResult,
    /// The state of the subject, in words.
    found: String,
    /// How to fix the problem, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    mend: Option<String>,
}

impl HostFinding {
    fn ok(about: &str, found: impl Into<String>) -> Self {
        Self {
            about: about.to_owned(),
            verdict: CheckResult::Ok,
            found: found.into(),
            mend: None,
        }
    }

    fn note(about: &str, found: impl Into<String>, mend: impl Into<String>) -> Self {
        Self {
            verdict: CheckResult::Note,
            mend: Some(mend.into()),
            ..Self::ok(about, found)
        }
    }

    fn fault(about: &str, found: impl Into<String>, mend: impl Into<String>) -> Self {
        Self {
            verdict: CheckResult::Fault,
            ..Self::note(about, found, mend)
        }
    }

    fn lines(&self) -> String {
        let verdict = match self.verdict {
            CheckResult::Ok => "ok   ",
            CheckResult::Note => "note ",
            CheckResult::Fault => "FAULT",
        };
        let mend = self
            .mend
            .as_ref()
            .map_or_else(String::new, |mend| format!("\n{:20}-> {mend}", ""));
        format!("{verdict} {:<13} {}{mend}", self.about, self.found)
    }
}

/// The faults of settings, keymap and themes, which are left out until they are corrected.
fn files(faults: &[FileFault]) -> Vec<HostFinding> {
    let findings = faults.iter().flat_map(|fault| match fault {
        FileFault::Inside(source, faults) => {
            let (shown, rest) = first_shown(faults);
            let lines = shown
                .iter()
                .map(|it| it.one_line(&source.name, &source.text));
            let rest = rest.map(|text| text.to_string());
            let mend = "correct it: until then, sortie leaves this line out";
            let finding = |found| HostFinding::fault("settings", found, mend);
            lines.chain(rest).map(finding).collect::<Vec<_>>()
        }
        FileFault::Whole(text) => {
            let mend = "correct or remove the file";
            vec![HostFinding::fault("settings", text.to_string(), mend)]
        }
        FileFault::Closed { folder, text } => {
            let mend = format!(
                "as its owner or root: chmod -R a+rX {}; until then, its files are left out",
                shell_word(folder)
            );
            vec![HostFinding::fault("folders", text.to_string(), mend)]
        }
    });
    findings.collect()
}

/// The faults of missions and themes in the folders, which are left out until they are corrected.
fn faulty_files(settings: &CliSettings) -> Vec<HostFinding> {
    let mend = "correct it, or move it away: `sortie check FILE` shows all its faults";
    let missions = mission_faults();
    let missions = missions.iter().map(|text| ("missions", text.to_string()));
    let is_told = |path: &str| {
        settings
            .faults
            .iter()
            .any(|it| matches!(it, FileFault::Inside(source, _) if source.name == path))
    };
    let themes = settings
        .themes
        .faulty()
        .filter(|(file, _)| !is_told(&file.path));
    let themes = themes.flat_map(|(file, faults)| {
        let (shown, rest) = first_shown(&faults);
        let lines = shown.iter().map(|it| it.one_line(&file.path, &file.text));
        let rest = rest.map(|text| text.to_string());
        let told: Vec<_> = lines.chain(rest).map(|line| ("themes", line)).collect();
        told
    });
    let found = missions.chain(themes);
    found
        .map(|(about, fault)| HostFinding::fault(about, fault, mend))
        .collect()
}

/// Runs all checks and prints the findings; exit code 1 if something does not work.
pub(super) fn doctor(
    options: &DoctorArguments,
    settings: &CliSettings,
) -> Result<ExitCode, Failure> {
    let mut findings = terminal::findings(settings);
    findings.extend(files(&settings.faults));
    findings.extend(faulty_files(settings));
    findings.extend(class::of_configuration(settings));
    findings.extend(host::folders(settings));
    findings.extend(host::database(settings));
    findings.extend(host::machine());
    let programs = options.programs.find(settings);
    findings.extend(runtime()?.block_on(sitl::programs(&programs)));
    findings.extend(sitl::ports());
    findings.extend(sitl::leftovers(settings));
    findings.extend(host::token(settings));
    findings.extend(host::keys(settings));
    if options.json {
        say!("{}", serde_json::to_string_pretty(&findings)?)?;
    } else {
        for finding in &findings {
            say!("{}", finding.lines())?;
        }
    }
    let is_faulty = findings.iter().any(|it| it.verdict == CheckResult::Fault);
    Ok(ExitCode::from(u8::from(is_faulty)))
}
