//! `sortie workshop`: parts, designs, and the performance of designs.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Subcommand};
use serde_json::Value;
use unicode_width::UnicodeWidthStr as _;

use super::Failure;
use super::designs::find;
use super::settings::CliSettings;
use crate::mission::Mission;
use crate::sitl::gear_parameters;
use crate::store;
use crate::text;
use crate::text::{Locale, Text, rounded};
use crate::workshop::{
    Air, AirframeBuild, Design, DesignKind, FindingSeverity, Measure, Part, PartSlot, Sheet,
    parts_for,
};

/// Options of `sortie workshop`.
#[derive(Debug, Args)]
pub(super) struct WorkshopArguments {
    #[command(subcommand)]
    command: WorkshopCommand,
}

#[derive(Debug, Subcommand)]
enum WorkshopCommand {
    /// Lists the parts of all slots, or of one.
    #[command(after_help = "Examples:\n  sortie workshop parts\n  sortie workshop parts motor")]
    Parts {
        /// The slot: frame, motor, propeller, esc, battery, autopilot, navigation, power, radio or payload; of robots
        /// also chassis and drive, of boats hull and drive.
        slot: Option<String>,
    },
    /// Shows the parts of a design, its performance, and its problems.
    #[command(after_help = "Examples:\n  \
                            sortie workshop show starter\n  \
                            sortie workshop show my-drone.toml --altitude 1500 --battery-temperature -5")]
    Show {
        /// A design file, or the name of a design.
        design: String,
        #[command(flatten)]
        air: AirArguments,
        /// Print one JSON document instead of a sheet.
        #[arg(long)]
        json: bool,
    },
    /// Compares two designs side by side and shows the differences.
    #[command(after_help = "Examples:\n  \
                            sortie workshop compare starter scout\n  \
                            sortie workshop compare mine.toml theirs.toml --temperature 35")]
    Compare {
        /// A design file, or the name of a design.
        before: String,
        /// The design to compare it with.
        after: String,
        #[command(flatten)]
        air: AirArguments,
    },
    /// Compares a design with the requirements of a mission for its vehicles.
    #[command(after_help = "Examples:\n  \
                            sortie workshop fit starter 01\n  \
                            sortie workshop fit my-drone.toml 05-night-search")]
    Fit {
        /// A design file, or the name of a design.
        design: String,
        /// A mission file, or the name or number of a mission.
        mission: String,
    },
    /// Writes a design for ArduPilot's SITL: NAME.parm for `--defaults`, and of a drone also NAME.json for `--model`.
    #[command(after_help = "Examples:\n  \
                            sortie workshop export scout\n  \
                            sortie workshop export my-drone.toml --to airframes")]
    Export {
        /// A design file, or the name of a design.
        design: String,
        /// Write the files to this folder.
        #[arg(long, default_value = ".", value_name = "FOLDER")]
        to: PathBuf,
    },
}

/// The conditions of the flight.
#[derive(Debug, Args)]
struct AirArguments {
    /// Assume this altitude above sea level, in metres.
    #[arg(long, default_value_t = 0.0, value_parser = within::<-400, 6000>, allow_negative_numbers = true, value_name = "M")]
    altitude: f64,
    /// Assume this air temperature, in degrees Celsius.
    #[arg(long, default_value_t = 15.0, value_parser = within::<-40, 50>, allow_negative_numbers = true, value_name = "C")]
    temperature: f64,
    /// Assume this battery temperature, in degrees Celsius.
    #[arg(long, default_value_t = 25.0, value_parser = within::<-40, 60>, allow_negative_numbers = true, value_name = "C")]
    battery_temperature: f64,
}

impl AirArguments {
    fn air(&self) -> Air {
        Air {
            altitude_m: self.altitude,
            temperature_c: self.temperature,
            battery_c: self.battery_temperature,
        }
    }
}

fn within<const LEAST: i32, const MOST: i32>(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|value: &f64| (f64::from(LEAST)..=f64::from(MOST)).contains(value))
        .ok_or_else(|| format!("expected a number from {LEAST} to {MOST}"))
}

/// Carries out the subcommand.
pub(super) fn workshop(
    options: &WorkshopArguments,
    settings: &CliSettings,
) -> Result<ExitCode, Failure> {
    let locale = Locale::new(settings.config.lang.unwrap_or_default());
    match &options.command {
        WorkshopCommand::Parts { slot } => list_parts(slot.as_deref(), &locale),
        WorkshopCommand::Show { design, air, json } => {
            let design = find(design, settings, &locale)?;
            if *json {
                show_json(&design, air.air(), &locale)
            } else {
                show(&design, air.air(), &locale)
            }
        }
        WorkshopCommand::Compare { before, after, air } => {
            let before = find(before, settings, &locale)?;
            let after = find(after, settings, &locale)?;
            compare(&before, &after, air.air(), &locale)
        }
        WorkshopCommand::Fit { design, mission } => {
            let mission = super::run::load_mission(mission)?;
            fit(&find(design, settings, &locale)?, &mission, &locale)
        }
        WorkshopCommand::Export { design, to } => {
            export(&find(design, settings, &locale)?, to, &locale)
        }
    }
}

/// The parts of a slot under the name that it has in one or more kinds of vehicles.
struct Shelf {
    slot: PartSlot,
    key: &'static str,
    name: Text,
}

impl Shelf {
    /// The shelves of all kinds of vehicles, in the order of building.
    fn all() -> Vec<Self> {
        let mut shelves: Vec<Self> = Vec::new();
        for slot in PartSlot::ALL {
            for kind in DesignKind::ALL {
                let key = kind.slot_key(slot);
                if kind.slots().contains(&slot) && shelves.iter().all(|shelf| shelf.key != key) {
                    let name = kind.slot_name(slot);
                    shelves.push(Self { slot, key, name });
                }
            }
        }
        shelves
    }

    /// The parts of the slot that fit a kind of vehicle in which it has this name.
    fn parts(&self) -> impl Iterator<Item = &'static Part> {
        let has_name = |kind: DesignKind| kind.slot_key(self.slot) == self.key;
        parts_for(self.slot).filter(move |part| {
            let mut kinds = DesignKind::ALL.into_iter();
            kinds.any(|kind| has_name(kind) && part.fits(kind))
        })
    }
}

fn list_parts(slot: Option<&str>, locale: &Locale) -> Result<ExitCode, Failure> {
    let shelves = Shelf::all();
    let is_asked =
        |shelf: &&Shelf| slot.is_none_or(|key| shelf.key == key || shelf.slot.key() == key);
    let asked: Vec<&Shelf> = shelves.iter().filter(is_asked).collect();
    if asked.is_empty() {
        let known: Vec<&str> = shelves.iter().map(|shelf| shelf.key).collect();
        let text = text!(
            "workshop-slot",
            slot = slot.unwrap_or_default(),
            known = known.join(", ")
        );
        return Err(Failure::Invalid(format!("sortie: {}", locale.text(&text))));
    }
    for shelf in asked {
        say!("{}", locale.text(&shelf.name))?;
        for part in shelf.parts() {
            let name = locale.text(&part.name());
            say!(
                "  {:<13} {} {:>7.1} g {:>5} cr",
                part.id,
                padded(&name, 40),
                part.mass_g,
                part.credits
            )?;
        }
    }
    Ok(ExitCode::SUCCESS)
}

fn show(design: &Design, air: Air, locale: &Locale) -> Result<ExitCode, Failure> {
    let heading = |id: &'static str| locale.text(&Text::new(id, Vec::new()));
    say!("{}", design.name)?;
    say!("\n{}", heading("workshop-parts"))?;
    for (part, pieces) in design.pieces() {
        let slot = locale.text(&design.kind().slot_name(part.slot()));
        let name = locale.text(&part.name());
        let mass_g = part.mass_g * f64::from(pieces);
        let credits = part.credits * pieces;
        say!(
            "  {} {pieces:>2} x {} {mass_g:>7.1} g {credits:>5} cr",
            padded(&slot, 18),
            padded(&name, 32)
        )?;
    }
    say!("\n{}", heading("workshop-figures"))?;
    let sheet = Sheet::of(design, air);
    for measure in sheet.measures() {
        let value = measure
            .of(&sheet)
            .map_or_else(|| "-".to_owned(), |it| measure.shown(it));
        say!(
            "  {} {value:>10}",
            padded(&locale.text(&measure.name()), 22)
        )?;
    }
    say!("\n{}", heading("workshop-findings"))?;
    let findings = design.findings(air);
    if findings.is_empty() {
        say!("  {}", heading(design.kind().none_found()))?;
    }
    for finding in &findings {
        let mark = match finding.severity() {
            FindingSeverity::Fault => "x",
            FindingSeverity::Warning => "!",
        };
        say!("  {mark} {}", locale.text(&finding.text))?;
    }
    Ok(ExitCode::from(u8::from(!design.is_airworthy(air))))
}

fn show_json(design: &Design, air: Air, locale: &Locale) -> Result<ExitCode, Failure> {
    let sheet = Sheet::of(design, air);
    let parts: Vec<_> = design
        .pieces()
        .map(|(part, pieces)| serde_json::json!({ "slot": part.slot().key(), "part": part.id, "pieces": pieces }))
        .collect();
    let findings: Vec<_> = design
        .findings(air)
        .iter()
        .map(|it| {
            let is_fault = it.severity() == FindingSeverity::Fault;
            serde_json::json!({ "slot": it.slot.key(), "fault": is_fault, "text": locale.text(&it.text) })
        })
        .collect();
    let document = serde_json::json!({
        "name": design.name,
        "kind": design.kind().id(),
        "parts": parts,
        "mass_kg": rounded(design.mass_kg(), 3),
        "credits": design.credits(),
        "figures": with_rounded_numbers(serde_json::to_value(sheet.performance)?),
        "findings": findings,
    });
    say!("{}", serde_json::to_string_pretty(&document)?)?;
    Ok(ExitCode::from(u8::from(!design.is_airworthy(air))))
}

fn compare(
    before: &Design,
    after: &Design,
    air: Air,
    locale: &Locale,
) -> Result<ExitCode, Failure> {
    let (one, two) = (Sheet::of(before, air), Sheet::of(after, air));
    say!(
        "{} {:>14} {:>14}",
        padded("", 22),
        short(&before.name),
        short(&after.name)
    )?;
    for measure in Measure::of_both(&one, &two) {
        let (from, to) = (measure.of(&one), measure.of(&two));
        let shown =
            |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |it| measure.shown(it));
        let change = from.zip(to).and_then(|(from, to)| measure.change(from, to));
        let name = padded(&locale.text(&measure.name()), 22);
        say!(
            "{name} {:>14} {:>14} {:>14}",
            shown(from),
            shown(to),
            change.unwrap_or_default()
        )?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Prints how well a design meets a mission's requirements; seats with the same requirements are
/// merged. Exit code 1 if the design cannot do the task of any seat.
fn fit(design: &Design, mission: &Mission, locale: &Locale) -> Result<ExitCode, Failure> {
    let mut fits_somewhere = false;
    for need in mission.needs() {
        let seats: Vec<String> = need.seats.iter().map(ToString::to_string).collect();
        let heading = text!("workshop-fit-seats", seats = seats.join(", "));
        say!("{}", locale.text(&heading))?;
        let lines = need.fit(design);
        fits_somewhere |= lines.iter().all(|line| !line.is_block);
        for line in lines {
            let mark = match (line.met, line.is_block) {
                (true, _) => "+",
                (false, false) => "!",
                (false, true) => "x",
            };
            let [what, required, has] =
                [line.what, line.required, line.has].map(|text| locale.text(&text));
            say!("  {mark} {} {has:>10} / {required}", padded(&what, 46))?;
        }
    }
    Ok(ExitCode::from(u8::from(!fits_somewhere)))
}

fn export(design: &Design, folder: &std::path::Path, locale: &Locale) -> Result<ExitCode, Failure> {
    let Some(airframe) = design.airframe() else {
        let text = text!("workshop-incomplete", name = design.name.as_str());
        return Err(Failure::Invalid(format!("sortie: {}", locale.text(&text))));
    };
    let stem = file_stem(&design.name);
    let mut all = airframe.parameters;
    let parameters = folder.join(format!("{stem}.parm"));
    let mut files = parameters.display().to_string();
    match &airframe.build {
        AirframeBuild::Frame(frame) => {
            let file = folder.join(format!("{stem}.json"));
            let text = serde_json::to_string_pretty(frame)? + "\n";
            store::write(&file, &text, true)?;
            files = format!("{}, {files}", file.display());
        }
        AirframeBuild::Gear(gear) => {
            all.extend(gear_parameters(design.vehicle_kind(), gear));
        }
    }
    let lines: Vec<String> = all
        .iter()
        .map(|(name, value)| format!("{name} {value}\n"))
        .collect();
    store::write(&parameters, &lines.concat(), true)?;
    say!(
        "{}",
        locale.text(&text!("workshop-exported", files = files))
    )?;
    Ok(ExitCode::SUCCESS)
}

/// A design's name as the name of a file.
fn file_stem(name: &str) -> String {
    let plain = |c: char| {
        if c.is_ascii_alphanumeric() {
            c.to_ascii_lowercase()
        } else {
            '-'
        }
    };
    name.chars().map(plain).collect()
}

/// A document with its numbers rounded to thousandths, because further digits are arithmetic noise.
fn with_rounded_numbers(value: Value) -> Value {
    match value {
        Value::Number(number) if number.is_f64() => {
            rounded(number.as_f64().unwrap_or_default(), 3).into()
        }
        Value::Object(map) => map
            .into_iter()
            .map(|(key, value)| (key, with_rounded_numbers(value)))
            .collect(),
        other => other,
    }
}

fn padded(word: &str, columns: usize) -> String {
    let width = word.width();
    format!("{word}{}", " ".repeat(columns.saturating_sub(width)))
}

/// A name's beginning, for the head of a column.
fn short(name: &str) -> String {
    name.chars().take(14).collect()
}
