//! `sortie plan deconflict`: proposes later starts or separate heights.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;

use super::rehearse::{Cast, FlyingArguments, print, unfit};
use super::{Failure, convert, invalid};
use crate::rehearsal::{self, Proposal, Remedy};
use crate::store;
use crate::text;
use crate::text::{Locale, Text, clock_s, figure};

/// Options of `sortie plan deconflict`.
#[derive(Debug, Args)]
pub(super) struct DeconflictArguments {
    /// The plan of each vehicle, in any format.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Keep the separate heights this far apart, in metres.
    #[arg(long, value_name = "M", default_value_t = 6.0, value_parser = parse_layer)]
    layer: f32,
    /// Write all plans, changed or not, to this folder; existing files are not replaced.
    #[arg(long, value_name = "DIR")]
    write: Option<PathBuf>,
    #[command(flatten)]
    flying: FlyingArguments,
}

pub(super) fn parse_layer(text: &str) -> Result<f32, String> {
    let metres = text.parse().ok();
    metres
        .filter(|metres: &f32| (3.5..=100.0).contains(metres))
        .ok_or_else(|| "expected a number of metres from 3.5 to 100".to_owned())
}

pub(super) fn deconflict(
    options: &DeconflictArguments,
    locale: &Locale,
) -> Result<ExitCode, Failure> {
    let cast = options.flying.cast(&options.files)?;
    let found = rehearsal::deconflict(&cast.participants, &cast.conditions, options.layer);
    let found = found.map_err(|error| unfit(&error, &cast.names, locale))?;
    let Some(proposal) = found else {
        let text = locale.text(&text!("plan-deconflict-impossible"));
        say!("{text}")?;
        return Ok(ExitCode::FAILURE);
    };
    let is_changed = proposal.remedies.iter().any(|it| *it != Remedy::Nothing);
    if !is_changed {
        say!("{}", locale.text(&text!("plan-deconflict-none")))?;
        say!("{}", locale.text(&margin_words(&proposal)))?;
        if let Some(folder) = &options.write {
            write_all(folder, &proposal, &cast, locale)?;
        }
        return Ok(ExitCode::SUCCESS);
    }
    for (vehicle, (remedy, name)) in proposal.remedies.iter().zip(&cast.names).enumerate() {
        say!("{}", locale.text(&remedy_words(*remedy, vehicle + 1, name)))?;
    }
    let lost = clock_s(proposal.lost_s);
    say!(
        "{}",
        locale.text(&text!("plan-deconflict-cost", time = lost))
    )?;
    say!("{}", locale.text(&margin_words(&proposal)))?;
    print(&proposal.outcome, &cast, locale)?;
    if let Some(folder) = &options.write {
        write_all(folder, &proposal, &cast, locale)?;
    }
    Ok(ExitCode::from(u8::from(!proposal.outcome.is_as_planned())))
}

fn remedy_words(remedy: Remedy, vehicle: usize, file: &str) -> Text {
    match remedy {
        Remedy::Nothing => text!("plan-deconflict-keep", vehicle = vehicle, file = file),
        Remedy::Delay(seconds) => {
            let time = format!("{seconds} s");
            text!(
                "plan-deconflict-delay",
                vehicle = vehicle,
                file = file,
                time = time
            )
        }
        Remedy::Layer(metres) => {
            let height = figure(metres, 0);
            text!(
                "plan-deconflict-layer",
                vehicle = vehicle,
                file = file,
                height = height
            )
        }
    }
}

/// The text about how late a vehicle may be without a conflict.
fn margin_words(proposal: &Proposal) -> Text {
    match proposal.late_s {
        0 => text!("plan-deconflict-tight", late = rehearsal::LATE_S),
        late_s => text!("plan-deconflict-margin", late = late_s),
    }
}

/// Writes all plans, changed or not, as a complete set.
fn write_all(
    folder: &Path,
    proposal: &Proposal,
    cast: &Cast,
    locale: &Locale,
) -> Result<(), Failure> {
    fs::create_dir_all(folder)?;
    let changed = proposal
        .remedies
        .iter()
        .zip(&cast.participants)
        .zip(&cast.names);
    let mut delays = false;
    for ((remedy, participant), name) in changed {
        delays |= matches!(remedy, Remedy::Delay(_));
        let document = remedy.apply(&participant.document);
        let written = convert::written(name, &document);
        let (name, text) = written.map_err(|reason| invalid(&convert::lost(reason), locale))?;
        let path = folder.join(name);
        store::write(&path, &text, false).map_err(|error| invalid(&Text::from(&error), locale))?;
        let content = crate::preflight::summary(&document);
        let path = path.display().to_string();
        say!(
            "{}",
            locale.text(&text!("plan-written", path = path, content = content))
        )?;
    }
    if delays {
        say!("{}", locale.text(&text!("plan-deconflict-disarm")))?;
    }
    Ok(())
}
