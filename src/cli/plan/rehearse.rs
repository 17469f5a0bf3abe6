//! `sortie plan rehearse`: flies plans together in the embedded simulator.

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use clap::Args;
use serde::Serialize;

mod recording;

use super::ground::GroundArguments;
use super::{Failure, ShapeArguments, invalid, load_all};
use crate::cli::backend::frame;
use crate::cli::home::StartPlace;
use crate::cli::table::{Side, TextTable};
use crate::operator::ending_words;
use crate::plan::check::Severity;
use crate::plan::{Document as PlanDocument, Item, Loaded};
use crate::preflight::{approach_words, finding_words, list_words};
use crate::rehearsal::{
    self, Conditions, FlightEnding, Flown, Outcome, Participant, RehearsalError,
};
use crate::text;
use crate::text::{Locale, Text, clock_s, figure, rounded};

/// The number of pairs that are listed in addition to those that are too close.
const LISTED: usize = 3;

/// Options of `sortie plan rehearse`.
#[derive(Debug, Args)]
pub(super) struct RehearseArguments {
    /// The plan of each vehicle, in any format.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    #[command(flatten)]
    flying: FlyingArguments,
    #[command(flatten)]
    ground: GroundArguments,
    /// Write the telemetry of all vehicles to this file, for `sortie replay` and other programs.
    #[arg(long, value_name = "FILE")]
    tlog: Option<PathBuf>,
    /// Print one JSON document instead of the table.
    #[arg(long)]
    json: bool,
}

/// Options for the vehicles and the weather.
#[derive(Debug, Args)]
pub(super) struct FlyingArguments {
    /// Start vehicles here if their file has no home: latitude, longitude, height above sea level in metres, heading in
    /// degrees.
    #[arg(long, allow_hyphen_values = true, value_name = "LAT,LON,ALT,HDG")]
    home: Option<StartPlace>,
    #[command(flatten)]
    air: AirArguments,
    #[command(flatten)]
    shapes: ShapeArguments,
}

/// The airframes and the weather of a rehearsal.
#[derive(Debug, Args)]
pub(super) struct AirArguments {
    /// Use this airframe: a frame file of ArduPilot's SITL, in JSON. Use the option once for all vehicles, or several
    /// times: one file for each vehicle; the last one applies to all further vehicles.
    #[arg(long = "frame", value_name = "FILE")]
    frames: Vec<PathBuf>,
    /// The mean wind: speed in m/s, and the direction from which it blows, in degrees.
    #[arg(long, value_name = "M/S[,FROM]", value_parser = parse_wind)]
    wind: Option<(f32, f32)>,
    /// The strength of gusts (`SIM_WIND_TURB`).
    #[arg(long, default_value_t = 0.0)]
    turbulence: f32,
    /// Set a parameter of all vehicles, such as `WPNAV_SPEED=800`; repeat the option for several parameters.
    #[arg(long = "param", value_name = "NAME=VALUE", value_parser = parse_parameter)]
    parameters: Vec<(String, f32)>,
    /// Use this seed for the gusts.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Stop after this many minutes of flight.
    #[arg(long, value_name = "MIN", default_value_t = 60, value_parser = clap::value_parser!(u32).range(1..=600))]
    limit: u32,
}

fn parse_wind(text: &str) -> Result<(f32, f32), String> {
    let (speed, from) = text.split_once(',').unwrap_or((text, "0"));
    let number = |text: &str| {
        text.trim()
            .parse()
            .ok()
            .filter(|number: &f32| number.is_finite())
    };
    let wind = number(speed).zip(number(from));
    wind.filter(|(speed, _)| (0.0..=60.0).contains(speed))
        .ok_or_else(|| "expected M/S or M/S,FROM, such as 8,270; at most 60 m/s".to_owned())
}

fn parse_parameter(text: &str) -> Result<(String, f32), String> {
    let parts = text.split_once('=');
    let parsed = parts
        .and_then(|(name, value)| Some((name.trim().to_uppercase(), value.trim().parse().ok()?)));
    parsed.ok_or_else(|| "expected NAME=VALUE, such as WPNAV_SPEED=800".to_owned())
}

/// The vehicles with their files and plans, and the weather.
pub(super) struct Cast {
    pub(super) names: Vec<String>,
    pub(super) participants: Vec<Participant>,
    pub(super) conditions: Conditions,
}

impl FlyingArguments {
    pub(super) fn cast(&self, files: &[PathBuf]) -> Result<Cast, Failure> {
        let loaded: Vec<(String, Loaded)> = load_all(files, self.shapes.options())?;
        let documents = loaded.into_iter();
        let documents = documents.map(|(name, loaded)| (name, loaded.document));
        self.air.cast(documents.collect(), self.home)
    }
}

impl AirArguments {
    /// Prepares plans with their names for a rehearsal.
    pub(super) fn cast(
        &self,
        plans: Vec<(String, PlanDocument)>,
        home: Option<StartPlace>,
    ) -> Result<Cast, Failure> {
        let frames: Result<Vec<_>, Failure> = self.frames.iter().map(|path| frame(path)).collect();
        let frames = frames?;
        let (wind_m_s, wind_from_deg) = self.wind.unwrap_or_default();
        let airframe = |vehicle: usize| frames.get(vehicle).or(frames.last()).cloned();
        Ok(Cast {
            names: plans.iter().map(|(name, _)| name.clone()).collect(),
            participants: plans
                .into_iter()
                .enumerate()
                .map(|(vehicle, (_, document))| Participant {
                    document,
                    airframe: airframe(vehicle),
                    charge_percent: None,
                    delay_s: 0.0,
                    parameters: Vec::new(),
                    fence_switch: None,
                })
                .collect(),
            conditions: Conditions {
                home: home.map(|place| place.0),
                wind_m_s,
                wind_from_deg,
                turbulence: self.turbulence,
                seed: self.seed,
                parameters: self.parameters.clone(),
                limit_s: f64::from(self.limit) * 60.0,
            },
        })
    }
}

/// The text that explains why plans cannot be flown.
pub(super) fn unfit(error: &RehearsalError, names: &[String], locale: &Locale) -> Failure {
    let file = |vehicle: &usize| names.get(*vehicle).map_or("", String::as_str);
    let text = match error {
        RehearsalError::NoPlan(vehicle) => text!("plan-rehearse-no-plan", file = file(vehicle)),
        RehearsalError::NoHome(vehicle) => text!("plan-rehearse-no-home", file = file(vehicle)),
        RehearsalError::Refused(vehicle, kind) => text!(
            "plan-rehearse-refused",
            file = file(vehicle),
            list = list_words(*kind)
        ),
        RehearsalError::NoParameter(name) => text!("plan-rehearse-no-parameter", name = name),
    };
    invalid(&text, locale)
}

pub(super) fn rehearse(options: &RehearseArguments, locale: &Locale) -> Result<ExitCode, Failure> {
    let cast = options.flying.cast(&options.files)?;
    let begun = Instant::now();
    let flown = match &options.tlog {
        Some(path) => recording::rehearse_into(path, &cast, locale)?,
        None => rehearsal::rehearse(&cast.participants, &cast.conditions),
    };
    let outcome = flown.map_err(|error| unfit(&error, &cast.names, locale))?;
    let wall_time_s = begun.elapsed().as_secs_f64();
    if options.json {
        let document = Document::of(&outcome, &cast.names, wall_time_s);
        say!("{}", serde_json::to_string_pretty(&document)?)?;
    } else {
        print(&outcome, &cast, locale)?;
        let simulated = clock_s(outcome.simulated_s);
        let wall = figure(wall_time_s, 2);
        let done = text!("plan-rehearse-done", simulated = simulated, wall = wall);
        say!("{}", locale.text(&done))?;
    }
    let is_low = print_low_legs(&cast, &options.ground, locale)?;
    Ok(ExitCode::from(u8::from(is_low || !outcome.is_as_planned())))
}

/// Prints legs that come too close to the ground; returns whether there are any.
fn print_low_legs(cast: &Cast, ground: &GroundArguments, locale: &Locale) -> Result<bool, Failure> {
    let mut is_low = false;
    for (participant, name) in cast.participants.iter().zip(&cast.names) {
        let document = &participant.document;
        let ground = ground.below(document, locale)?;
        if ground.is_none() && document.plan.iter().any(Item::is_above_terrain) {
            tell!("{name}: {}", locale.text(&text!("plan-rehearse-level")));
        }
        let findings = ground.map(|ground| ground.findings(document));
        for finding in findings.into_iter().flatten() {
            is_low |= finding.severity() == Severity::Error;
            tell!("{name}: {}", locale.text(&finding_words(&finding)));
        }
    }
    Ok(is_low)
}

pub(super) fn print(outcome: &Outcome, cast: &Cast, locale: &Locale) -> Result<(), Failure> {
    let columns = [
        (text!("plan-rehearse-vehicle"), Side::Right),
        (text!("plan-rehearse-file"), Side::Left),
        (text!("plan-rehearse-time"), Side::Right),
        (text!("plan-rehearse-energy"), Side::Right),
        (text!("plan-rehearse-farthest"), Side::Right),
        (text!("plan-rehearse-fence"), Side::Left),
        (text!("plan-rehearse-end"), Side::Left),
    ];
    let mut table = TextTable::new(locale, &columns);
    for (vehicle, (flown, name)) in outcome.vehicles.iter().zip(&cast.names).enumerate() {
        table.push(vec![
            (vehicle + 1).to_string(),
            name.clone(),
            clock_s(flown.time_s),
            format!("{} %", figure(100.0 - flown.energy_used_percent, 0)),
            format!("{} m", figure(flown.farthest_m, 0)),
            locale.text(&fence_words(flown)),
            locale.text(&ending_words(flown.ending)),
        ]);
    }
    say!("{}", table.plain().trim_end())?;
    for (vehicle, flown) in outcome.vehicles.iter().enumerate() {
        if flown.was_kept_armed {
            let waits = text!("plan-rehearse-waits", vehicle = vehicle + 1);
            say!("{}", locale.text(&waits))?;
        }
        if flown.moved_east_m > 0.0 {
            let distance = figure(flown.moved_east_m, 0);
            let moved = text!(
                "plan-rehearse-moved",
                vehicle = vehicle + 1,
                distance = distance
            );
            say!("{}", locale.text(&moved))?;
        }
    }
    print_approaches(outcome, locale)
}

/// Prints the pairs that come close to each other.
pub(super) fn print_approaches(outcome: &Outcome, locale: &Locale) -> Result<(), Failure> {
    for (place, approach) in outcome.closest.iter().enumerate() {
        if approach.is_conflict() || place < LISTED {
            let names = [approach.a, approach.b].map(|vehicle| (vehicle + 1).into());
            say!("{}", locale.text(&approach_words(names, approach)))?;
        }
    }
    for approach in &outcome.closest {
        if let Some(late_s) = approach.late_s.filter(|late_s| *late_s > 0) {
            let (a, b) = (approach.a + 1, approach.b + 1);
            let late = text!("plan-rehearse-late", a = a, b = b, late = late_s);
            say!("{}", locale.text(&late))?;
        }
    }
    Ok(())
}

fn fence_words(flown: &Flown) -> Text {
    match flown.broke_fence_s {
        Some(at_s) => text!("plan-rehearse-fence-broken", time = clock_s(at_s)),
        None if flown.has_fence => text!("plan-rehearse-fence-kept"),
        None => text!("plan-rehearse-fence-none"),
    }
}

/// The outcome as JSON, for other programs.
#[derive(Debug, Serialize)]
struct Document<'a> {
    vehicles: Vec<VehicleRow<'a>>,
    closest: Vec<PairRow>,
    wall_time_s: f64,
}

#[derive(Debug, Serialize)]
struct VehicleRow<'a> {
    vehicle: usize,
    file: &'a str,
    time_s: f64,
    energy_left_percent: f64,
    farthest_m: f64,
    fence_ok: bool,
    ending: &'static str,
}

#[derive(Debug, Serialize)]
struct PairRow {
    a: usize,
    b: usize,
    horizontal_m: f64,
    vertical_m: f64,
    at_s: f64,
    conflict: bool,
    /// The shortest delay of one vehicle that brings the pair into conflict, in seconds; `null` if
    /// more than 3 s.
    late_s: Option<u32>,
}

impl<'a> Document<'a> {
    fn of(outcome: &Outcome, names: &'a [String], wall_time_s: f64) -> Self {
        let vehicles = outcome.vehicles.iter().zip(names).enumerate();
        Self {
            vehicles: vehicles
                .map(|(vehicle, (flown, file))| VehicleRow {
                    vehicle: vehicle + 1,
                    file,
                    time_s: rounded(flown.time_s, 2),
                    energy_left_percent: rounded(100.0 - flown.energy_used_percent, 1),
                    farthest_m: rounded(flown.farthest_m, 1),
                    fence_ok: flown.broke_fence_s.is_none(),
                    ending: ending_name(flown.ending),
                })
                .collect(),
            closest: outcome
                .closest
                .iter()
                .map(|approach| PairRow {
                    a: approach.a + 1,
                    b: approach.b + 1,
                    horizontal_m: rounded(approach.horizontal_m, 2),
                    vertical_m: rounded(approach.vertical_m, 2),
                    at_s: rounded(approach.at_s, 2),
                    conflict: approach.is_conflict(),
                    late_s: approach.late_s,
                })
                .collect(),
            wall_time_s: rounded(wall_time_s, 3),
        }
    }
}

fn ending_name(ending: FlightEnding) -> &'static str {
    match ending {
        FlightEnding::Landed => "landed",
        FlightEnding::InAir => "in_air",
        FlightEnding::LeftPlan(_) => "left_plan",
        FlightEnding::Grounded => "grounded",
        FlightEnding::Crashed | FlightEnding::HitGround(_) => "crashed",
        FlightEnding::TimeUp => "time_up",
    }
}
