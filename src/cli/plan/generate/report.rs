//! Checks, rehearses, prints and writes the generated plans.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::super::rehearse::{Cast, print_approaches, unfit};
use super::super::{Failure, convert, invalid};
use super::team::TeamArguments;
use crate::cli::table::{Side, TextTable};
use crate::operator::ending_words;
use crate::plan::Document;
use crate::plan::check::{CheckOptions, Severity, check};
use crate::plan::generate::Generated;
use crate::preflight::{self, finding_words, idle_words};
use crate::rehearsal::{Outcome, rehearse};
use crate::store;
use crate::text;
use crate::text::{Locale, Text, clock_s, figure};

/// The name of a vehicle's file if no name was given.
const USUAL_NAME: &str = "part-{id}.plan";
/// The part of a name that stands for the vehicle's number.
const NUMBER: &str = "{id}";

pub(super) fn report(
    plans: &Generated,
    team: &TeamArguments,
    locale: &Locale,
) -> Result<ExitCode, Failure> {
    let named = plans.parts.iter().map(|part| {
        let name = path_of(team.write.as_deref(), part.vehicle + 1);
        let name = name.file_name().unwrap_or(name.as_os_str());
        (name.to_string_lossy().into_owned(), part.document.clone())
    });
    let cast = team.air.cast(named.collect(), None)?;
    let outcome = rehearse(&cast.participants, &cast.conditions)
        .map_err(|error| unfit(&error, &cast.names, locale))?;
    print(plans, &outcome, &cast, locale)?;
    for (vehicle, why) in &plans.idle {
        let idle = text!(
            "plan-generate-idle",
            vehicle = vehicle + 1,
            reason = idle_words(*why)
        );
        say!("{}", locale.text(&idle))?;
    }
    if plans.uncovered >= 0.0005 {
        let share = figure(plans.uncovered * 100.0, 1);
        say!(
            "{}",
            locale.text(&text!("plan-generate-uncovered", share = share))
        )?;
    }
    print_approaches(&outcome, locale)?;
    let faulty = print_faults(&cast, locale)?;
    if team.write.is_some() {
        write_all(plans, team, locale)?;
    }
    Ok(ExitCode::from(u8::from(faulty || !outcome.is_as_planned())))
}

/// Prints the plans, with the times and batteries of their rehearsal.
fn print(
    plans: &Generated,
    outcome: &Outcome,
    cast: &Cast,
    locale: &Locale,
) -> Result<(), Failure> {
    let used: Vec<f64> = outcome
        .vehicles
        .iter()
        .map(|flown| flown.energy_used_percent)
        .collect();
    let all: f64 = used.iter().sum::<f64>().max(f64::EPSILON);
    let mut table = TextTable::new(locale, &columns());
    let rows = plans.parts.iter().zip(&outcome.vehicles).zip(&cast.names);
    for (((part, flown), name), used) in rows.zip(&used) {
        table.push(vec![
            (part.vehicle + 1).to_string(),
            name.clone(),
            format!("{} m", figure(part.length_m, 0)),
            clock_s(flown.time_s),
            format!("{} %", figure(*used, 0)),
            format!("{} %", figure(100.0 * used / all, 0)),
            format!("{} m", figure(part.layer_m, 0)),
            locale.text(&ending_words(flown.ending)),
        ]);
    }
    say!("{}", table.plain().trim_end())?;
    print_imbalance(&used, locale)
}

fn columns() -> [(Text, Side); 8] {
    [
        (text!("plan-rehearse-vehicle"), Side::Right),
        (text!("plan-rehearse-file"), Side::Left),
        (text!("plan-generate-length"), Side::Right),
        (text!("plan-rehearse-time"), Side::Right),
        (text!("plan-generate-used"), Side::Right),
        (text!("plan-generate-share"), Side::Right),
        (text!("plan-generate-layer"), Side::Right),
        (text!("plan-rehearse-end"), Side::Left),
    ]
}

/// Prints how much more the vehicle with the largest share uses than the one with the smallest.
fn print_imbalance(used: &[f64], locale: &Locale) -> Result<(), Failure> {
    let most = used.iter().copied().fold(0.0, f64::max);
    let least = used.iter().copied().fold(f64::INFINITY, f64::min);
    if used.len() > 1 && least > 0.0 {
        let times = figure(most / least, 2);
        let imbalance = text!("plan-generate-imbalance", times = times);
        say!("{}", locale.text(&imbalance))?;
    }
    Ok(())
}

/// Prints the faults for which a vehicle would refuse a plan; returns whether there are any.
fn print_faults(cast: &Cast, locale: &Locale) -> Result<bool, Failure> {
    let mut faulty = false;
    for (participant, name) in cast.participants.iter().zip(&cast.names) {
        let findings = check(&participant.document, &CheckOptions::default());
        let errors = findings
            .iter()
            .filter(|it| it.severity() == Severity::Error);
        for finding in errors {
            faulty = true;
            say!("{name}: {}", locale.text(&finding_words(finding)))?;
        }
    }
    Ok(faulty)
}

fn path_of(write: Option<&Path>, number: usize) -> PathBuf {
    let pattern = match write {
        Some(path) if path.to_string_lossy().contains(NUMBER) => path.to_path_buf(),
        Some(folder) => folder.join(USUAL_NAME),
        None => PathBuf::from(USUAL_NAME),
    };
    let name = pattern.to_string_lossy();
    PathBuf::from(name.replace(NUMBER, &number.to_string()))
}

fn write_all(plans: &Generated, team: &TeamArguments, locale: &Locale) -> Result<(), Failure> {
    for part in &plans.parts {
        let path = path_of(team.write.as_deref(), part.vehicle + 1);
        write_one(&path, &part.document, team.force, locale)?;
    }
    Ok(())
}

fn write_one(
    path: &Path,
    document: &Document,
    force: bool,
    locale: &Locale,
) -> Result<(), Failure> {
    let name = path.to_string_lossy();
    let written = convert::written(&name, document);
    let (name, text) = written.map_err(|reason| invalid(&convert::lost(reason), locale))?;
    let path = Path::new(&name);
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    store::write(path, &text, force).map_err(|error| invalid(&Text::from(&error), locale))?;
    let content = preflight::summary(document);
    let written = text!("plan-written", path = name, content = content);
    say!("{}", locale.text(&written))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_the_vehicles_number() {
        let path = |write: Option<&str>| path_of(write.map(Path::new), 3);
        assert_eq!(path(None), Path::new("part-3.plan"));
        assert_eq!(path(Some("out")), Path::new("out/part-3.plan"));
        assert_eq!(path(Some("out/v{id}.kml")), Path::new("out/v3.kml"));
    }
}
