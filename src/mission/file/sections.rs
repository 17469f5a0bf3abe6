//! Putting the sections of a mission file together.

use std::collections::BTreeMap;
use std::time::Duration;

use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::fleet::{self, Fleet};
use super::place;
use super::{
    Draft, Faults, HEAD, SECTIONS, Section, by_kind, check_unique, events, kinded, names,
    objective, points, radio, zones,
};
use crate::diagnostic::Diagnostic;
use crate::mission::event::Event;
use crate::mission::event::expression::Names;
use crate::mission::hazard::{self, Hazard};
use crate::mission::objective::Objective;
use crate::mission::radio::Radio;
use crate::mission::weather::Weather;
use crate::mission::{Clue, Hint, Mission, NEXT_CELL, Origin, Phase};
use crate::scoring::Rules;

/// The only version of the format so far.
const SCHEMA: u32 = 1;

/// The sections of a file by name.
struct Sections<'i>(BTreeMap<&'static str, Spanned<DeValue<'i>>>);

/// What the sections about where and with what establish.
struct Setting {
    time_limit: Duration,
    origin: Origin,
    weather: Weather,
    max_height_m: f64,
    land_reserve_percent: f64,
    min_separation_m: f64,
    fleet: Fleet,
}

/// What happens in the mission.
struct Content {
    draft: Draft,
    hazards: Vec<Box<dyn Hazard>>,
    objectives: Vec<Objective>,
    hints: Vec<Hint>,
    clues: Vec<Clue>,
    threats: Threats,
}

/// What happens to the mission.
struct Threats {
    events: Vec<Event>,
    radio: Option<Radio>,
    may_inject: Vec<String>,
}

/// Reads all sections; `None` where one that is needed could not be read.
pub(super) fn mission(root: Section<'_>, faults: &mut Faults) -> Option<Mission> {
    let span = root.span();
    let mut root = root.into_inner();
    check_keys(&root, faults);
    let declared = declared_names(&root);
    let named = SECTIONS
        .iter()
        .filter_map(|&name| Some((name, root.remove(name)?)));
    let mut sections = Sections(named.collect());
    let head = HEAD
        .iter()
        .filter_map(|&name| root.remove_entry(name))
        .collect();
    let head: Option<HeadFile> = faults.read(Spanned::new(span, head));
    let head = head.map(|head| head.checked(faults));
    let setting = setting(&mut sections, faults);
    let content = content(&mut sections, setting.as_ref(), declared, faults);
    let limit = setting.as_ref().map(|setting| setting.time_limit);
    let scoring = scoring(&mut sections, &content.objectives, limit, faults);
    let (head, setting) = (head?, setting?);
    Some(Mission {
        id: head.id.into_inner(),
        rev: head.rev,
        title: faults.written(head.title, head.title_uk, "title_uk"),
        brief: faults.written(head.brief, head.brief_uk, "brief_uk"),
        untranslated: Vec::new(),
        source: String::new(),
        tier: head.tier,
        tags: head.tags,
        authors: head.authors,
        drill_of: head.drill_of.map(Spanned::into_inner),
        vehicles: setting.fleet.pads.len(),
        sensors: setting.fleet.sensors(),
        time_limit: setting.time_limit,
        hints: content.hints,
        clues: content.clues,
        scoring: scoring?,
        origin: setting.origin,
        weather: setting.weather,
        pads: setting.fleet.pads,
        fits: setting.fleet.fits,
        zones: content.draft.zones,
        places: content.draft.places,
        hazards: content.hazards,
        objectives: content.objectives,
        max_height_m: setting.max_height_m,
        land_reserve_percent: setting.land_reserve_percent,
        min_separation_m: setting.min_separation_m,
        events: content.threats.events,
        radio: content.threats.radio,
        may_inject: content.threats.may_inject,
    })
}

impl<'i> Sections<'i> {
    fn optional(&mut self, name: &str) -> Option<Spanned<DeValue<'i>>> {
        self.0.remove(name)
    }

    fn needed(&mut self, name: &str, faults: &mut Faults) -> Option<Spanned<DeValue<'i>>> {
        let found = self.optional(name);
        if found.is_none() {
            faults.add(0..0, format!("the section `{name}` is missing"));
        }
        found
    }
}

fn setting(sections: &mut Sections<'_>, faults: &mut Faults) -> Option<Setting> {
    let sim = sections
        .needed("sim", faults)
        .and_then(|value| place::sim(value, faults));
    let fleet = sections
        .needed("fleet", faults)
        .and_then(|value| fleet::fleet(value, faults));
    let weather = sections
        .optional("weather")
        .map_or(Some(Weather::CALM), |value| place::weather(value, faults));
    let (max_height_m, land_reserve_percent, min_separation_m) =
        place::rules(sections.optional("rules"), faults)?;
    let (time_limit, origin) = sim?;
    Some(Setting {
        time_limit,
        origin,
        weather: weather?,
        max_height_m,
        land_reserve_percent,
        min_separation_m,
        fleet: fleet?,
    })
}

fn content(
    sections: &mut Sections<'_>,
    setting: Option<&Setting>,
    declared: Vec<String>,
    faults: &mut Faults,
) -> Content {
    let hazard_ids = events::declared(sections.0.get("hazards")).0;
    let mut draft = Draft {
        zones: array(sections.optional("zones"), faults, zones::reader()),
        sensors: setting.map_or(Vec::new(), |setting| setting.fleet.sensors()),
        places: array(sections.optional("places"), faults, names::reader()),
        pads: setting.map_or(Vec::new(), |setting| setting.fleet.pads.clone()),
        declared,
        ..Draft::default()
    };
    let (hazards, named) = hazards(sections.optional("hazards"), &draft, faults);
    draft.hazards = named;
    let objectives = objectives(sections.needed("objectives", faults), &mut draft, faults);
    // Hints may refer to objectives and their cells.
    let advice = array(sections.optional("hints"), faults, |value, faults| {
        let hint: HintFile = faults.read_value(value)?;
        hint.checked(&draft, faults)
    });
    let (mut hints, mut clues) = (Vec::new(), Vec::new());
    for one in advice {
        match one {
            Advice::Shown(hint) => hints.push(hint),
            Advice::Asked(clue) => clues.push(clue),
        }
    }
    let threats = threats(
        sections,
        setting,
        (&draft, &hazard_ids, &objectives),
        faults,
    );
    Content {
        draft,
        hazards,
        objectives,
        hints,
        clues,
        threats,
    }
}

/// What happens to the mission; conditions may name what the other sections have.
fn threats(
    sections: &mut Sections<'_>,
    setting: Option<&Setting>,
    (draft, hazards, objectives): (&Draft, &[String], &[Objective]),
    faults: &mut Faults,
) -> Threats {
    let pads = setting.map_or(&[][..], |setting| &setting.fleet.pads);
    let radio = sections.optional("radio");
    let radio = radio.and_then(|value| radio::radio(value, pads.first(), faults));
    let instructor = sections.optional("instructor");
    let may_inject = instructor.and_then(|value| radio::may_inject(value, faults));
    let (events, movers) = events::declared(sections.0.get("events"));
    let sensors: Vec<&'static str> = draft.sensors.iter().map(|sensor| sensor.id).collect();
    let names = Names {
        zones: &draft.zones,
        objectives: &borrowed(objectives.iter().map(|objective| objective.id.as_str())),
        hazards: &borrowed(hazards.iter().map(String::as_str)),
        sensors: &sensors,
        events: &borrowed(events.iter().map(String::as_str)),
        movers: &borrowed(movers.iter().map(String::as_str)),
        vehicles: pads.len(),
    };
    let mut seen = Vec::new();
    let list = sections.optional("events");
    Threats {
        events: array(list, faults, |value, faults| {
            events::event(value, &names, &mut seen, faults)
        }),
        radio,
        may_inject: may_inject.unwrap_or_default(),
    }
}

fn borrowed<'a>(names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    names.collect()
}

fn scoring(
    sections: &mut Sections<'_>,
    objectives: &[Objective],
    time_limit: Option<Duration>,
    faults: &mut Faults,
) -> Option<Rules> {
    let section = sections.needed("scoring", faults)?;
    let ids: Vec<&str> = objectives
        .iter()
        .map(|objective| objective.id.as_str())
        .collect();
    points::rules(section, &ids, time_limit?, faults)
}

/// The names that other sections may refer to, good or faulty.
fn declared_names<'t, 'i>(root: &'t DeTable<'i>) -> Vec<String> {
    let value = |key: &str| root.get(key).map(Spanned::get_ref);
    let ids = ["zones", "places", "hazards", "objectives"]
        .into_iter()
        .filter_map(|key| value(key)?.as_array())
        .flat_map(|items| {
            items
                .iter()
                .filter_map(|item| item.get_ref().get("id")?.get_ref().as_str())
        });
    let list = |table: &'t DeValue<'i>, key| table.get(key)?.get_ref().as_array();
    let fleet = value("fleet").into_iter();
    let vehicles = fleet.clone().filter_map(|fleet| list(fleet, "vehicles"));
    let vehicles = vehicles.flatten().map(Spanned::get_ref);
    let sensors = fleet
        .chain(vehicles)
        .filter_map(|table| list(table, "sensors"));
    let sensors = sensors.flatten().filter_map(|item| item.get_ref().as_str());
    ids.chain(sensors).map(str::to_owned).collect()
}

/// Unknown keys on the top level.
fn check_keys(root: &DeTable<'_>, faults: &mut Faults) {
    let known = || HEAD.iter().chain(&SECTIONS).copied();
    for (key, _) in root {
        let name = key.get_ref().as_ref();
        if !known().any(|known| known == name) {
            let fault = Diagnostic::new(key.span(), format!("unknown key `{name}`"));
            faults.found.push(fault.with_nearest(name, known()));
        }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct HeadFile {
    schema: Spanned<u32>,
    id: Spanned<String>,
    rev: u32,
    title: Spanned<String>,
    title_uk: Option<Spanned<String>>,
    #[serde(default)]
    tier: u8,
    #[serde(default)]
    tags: Vec<String>,
    #[serde(default)]
    authors: Vec<String>,
    brief: Spanned<String>,
    brief_uk: Option<Spanned<String>>,
    drill_of: Option<Spanned<String>>,
}

impl HeadFile {
    fn checked(self, faults: &mut Faults) -> Self {
        if *self.schema.get_ref() != SCHEMA {
            faults.add(
                self.schema.span(),
                format!("this program reads schema {SCHEMA} only"),
            );
        }
        for id in std::iter::once(&self.id).chain(&self.drill_of) {
            if !is_mission_id(id.get_ref()) {
                faults.add(
                    id.span(),
                    "a mission's id is 1 to 40 small letters, digits and `-`",
                );
            }
        }
        if let Some(of) = self.drill_of.as_ref().filter(|of| **of == self.id) {
            faults.add(of.span(), "a mission is no drill of itself");
        }
        for (title, key) in [
            (Some(&self.title), "title"),
            (self.title_uk.as_ref(), "title_uk"),
        ] {
            let Some(title) = title else { continue };
            if !(1..=60).contains(&title.get_ref().chars().count()) {
                let fault = format!("`{key}` must have 1 to 60 characters");
                faults.add(title.span(), fault);
            }
        }
        self
    }
}

fn is_mission_id(id: &str) -> bool {
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    (1..=40).contains(&id.len()) && id.chars().all(plain)
}

/// Reads an array of tables; a missing one is empty.
fn array<'i, T>(
    value: Option<Spanned<DeValue<'i>>>,
    faults: &mut Faults,
    mut read: impl FnMut(Spanned<DeValue<'i>>, &mut Faults) -> Option<T>,
) -> Vec<T> {
    let Some(value) = value else {
        return Vec::new();
    };
    let span = value.span();
    let DeValue::Array(items) = value.into_inner() else {
        faults.add(span, "an array of tables is needed here, as in [[zones]]");
        return Vec::new();
    };
    items
        .into_iter()
        .filter_map(|item| read(item, faults))
        .collect()
}

/// The hazards and their names; those that could not be read have a name only.
fn hazards(
    value: Option<Spanned<DeValue<'_>>>,
    draft: &Draft,
    faults: &mut Faults,
) -> (Vec<Box<dyn Hazard>>, Vec<String>) {
    let mut seen = Vec::new();
    let hazards = array(value, faults, |value, faults| {
        let section = kinded(value, faults)?;
        check_unique(&mut seen, &section.id, faults);
        by_kind("hazard", section, hazard::KINDS, draft, faults)
    });
    (hazards, seen)
}

fn objectives(
    value: Option<Spanned<DeValue<'_>>>,
    draft: &mut Draft,
    faults: &mut Faults,
) -> Vec<Objective> {
    let place = value.as_ref().map(Spanned::span);
    let mut seen = Vec::new();
    let objectives = array(value, faults, |value, faults| {
        objective(value, draft, &mut seen, faults)
    });
    let none_mandatory = !objectives.iter().any(|objective| objective.mandatory);
    if let Some(place) = place.filter(|_| none_mandatory && faults.found.is_empty()) {
        faults.add(
            place,
            "at least one objective must be `mandatory`, or the mission can never be passed",
        );
    }
    objectives
}

/// Advice as the file has it: shown by itself, or to be asked for.
enum Advice {
    Shown(Hint),
    Asked(Clue),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct HintFile {
    phase: Option<Phase>,
    level: Option<Spanned<u8>>,
    objective: Option<Spanned<String>>,
    text: Spanned<String>,
    text_uk: Option<Spanned<String>>,
}

impl HintFile {
    fn checked(self, draft: &Draft, faults: &mut Faults) -> Option<Advice> {
        let no_cells = draft.surveys.is_empty() && faults.found.is_empty();
        for written in std::iter::once(&self.text).chain(&self.text_uk) {
            let text = written.get_ref();
            let rest = text.replace(NEXT_CELL, "");
            if rest.contains(['{', '}']) {
                let message = format!("a hint knows one placeholder only: `{NEXT_CELL}`");
                faults.add(written.span(), message);
            }
            if rest.len() < text.len() && no_cells {
                let message = format!("`{NEXT_CELL}` needs an objective of kind `sample_cells`");
                faults.add(written.span(), message);
            }
        }
        let place = self.text.span();
        let text = faults.written(self.text, self.text_uk, "text_uk");
        let Some(level) = self.level else {
            // Shown by itself, so it has to be said when.
            let Some(phase) = self.phase else {
                faults.add(place, "a hint needs a `phase` to be shown in, or a `level`");
                return None;
            };
            return Some(Advice::Shown(Hint { phase, text }));
        };
        if !(1..=3).contains(level.get_ref()) {
            faults.add(level.span(), "`level` must be 1, 2 or 3");
        }
        if let Some(id) = &self.objective
            && !draft.declared.contains(id.get_ref())
        {
            let known: Vec<&str> = draft.declared.iter().map(String::as_str).collect();
            faults.unknown("objective", id, &known);
        }
        Some(Advice::Asked(Clue {
            level: level.into_inner(),
            phase: self.phase,
            objective: self.objective.map(Spanned::into_inner),
            text,
        }))
    }
}
