//! Putting the sections of a mission file together.

use std::collections::BTreeMap;
use std::time::Duration;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::fleet::{self, Fleet};
use super::head::HeadFile;
use super::hints::{Advice, HintFile};
use super::place::{self, RuleSet};
use super::{
    Draft, Faults, HEAD, SECTIONS, Section, by_kind, campaign, check_unique, events, kinded, names,
    objective, points, radio, zones,
};
use crate::diagnostic::Diagnostic;
use crate::mission::event::Event;
use crate::mission::event::expression::Names;
use crate::mission::hazard::{self, Hazard};
use crate::mission::objective::Objective;
use crate::mission::radio::Radio;
use crate::mission::weather::Weather;
use crate::mission::{Clue, Hint, Mission, Origin, Requires, Rewards};
use crate::scoring::Rules;

/// Zones, places, events and hints of one mission.
const MOST_TABLES: usize = 200;
/// Each may have ten thousands of cells.
const MOST_HAZARDS: usize = 20;
/// As with hazards.
const MOST_OBJECTIVES: usize = 50;

/// The sections of a file by name.
struct Sections<'i>(BTreeMap<&'static str, Spanned<DeValue<'i>>>);

/// What the sections about where and with what establish.
struct Setting {
    time_limit: Duration,
    origin: Origin,
    weather: Weather,
    rules: RuleSet,
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
    let tier = head.as_ref().map_or(0, |head| head.tier);
    let campaign = career(&mut sections, tier, faults);
    let (head, setting) = (head?, setting?);
    Some(Mission {
        id: head.id.into_inner(),
        rev: head.rev,
        title: faults.written(head.title, head.title_uk, "title_uk"),
        brief: faults.written(head.brief, head.brief_uk, "brief_uk"),
        untranslated: Vec::new(),
        source: String::new(),
        tier: head.tier,
        tags: head.tags.into_inner(),
        authors: head.authors.into_inner(),
        drill_of: head.drill_of.map(Spanned::into_inner),
        requires: campaign.0,
        rewards: campaign.1,
        pausable: setting.rules.pausable,
        vehicles: setting.fleet.pads.len(),
        sensors: setting.fleet.sensors(),
        time_limit: setting.time_limit,
        hints: content.hints,
        clues: content.clues,
        scoring: scoring?,
        origin: setting.origin,
        weather: setting.weather,
        pads: setting.fleet.pads,
        asked: setting.fleet.fits.clone(),
        fits: setting.fleet.fits,
        fleet: Vec::new(),
        outlay: setting.fleet.outlay,
        zones: content.draft.zones,
        places: content.draft.places,
        hazards: content.hazards,
        objectives: content.objectives,
        max_height_m: setting.rules.max_height_m,
        land_reserve_percent: setting.rules.land_reserve_percent,
        separation_m: setting.rules.separation_m,
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
    let rules = place::rules(sections.optional("rules"), faults);
    let (time_limit, origin) = sim?;
    Some(Setting {
        time_limit,
        origin,
        weather: weather?,
        rules: rules?,
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
    let place_ids = names::written(sections.0.get("places"));
    let mut draft = Draft {
        zones: array(
            sections.optional("zones"),
            MOST_TABLES,
            faults,
            zones::reader(),
        ),
        sensors: setting.map_or(Vec::new(), |setting| setting.fleet.sensors()),
        places: array(
            sections.optional("places"),
            MOST_TABLES,
            faults,
            names::reader(),
        ),
        pads: setting.map_or(Vec::new(), |setting| setting.fleet.pads.clone()),
        declared,
        ..Draft::default()
    };
    let (hazards, named) = hazards(sections.optional("hazards"), &draft, faults);
    draft.hazards = named;
    let objectives = objectives(sections.needed("objectives", faults), &mut draft, faults);
    names::check_no_cells(&place_ids, &draft, faults);
    // Hints may refer to objectives and their cells.
    let (hints, clues) = advice(sections.optional("hints"), &draft, faults);
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

/// The hints that are shown by themselves, and those that have to be asked for.
fn advice(
    written: Option<Spanned<DeValue<'_>>>,
    draft: &Draft,
    faults: &mut Faults,
) -> (Vec<Hint>, Vec<Clue>) {
    let all = array(written, MOST_TABLES, faults, |value, faults| {
        let hint: HintFile = faults.read_value(value)?;
        hint.checked(draft, faults)
    });
    let (mut hints, mut clues) = (Vec::new(), Vec::new());
    for one in all {
        match one {
            Advice::Shown(hint) => hints.push(hint),
            Advice::Asked(clue) => clues.push(clue),
        }
    }
    (hints, clues)
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
        events: array(list, MOST_TABLES, faults, |value, faults| {
            events::event(value, &names, &mut seen, faults)
        }),
        radio,
        may_inject: may_inject.unwrap_or_default(),
    }
}

/// What it asks of a career, and gives to it.
fn career(sections: &mut Sections<'_>, tier: u8, faults: &mut Faults) -> (Requires, Rewards) {
    let requires = sections.optional("requires");
    let requires = requires.and_then(|value| campaign::requires(value, faults));
    let rewards = sections.optional("rewards");
    let rewards = rewards.and_then(|value| campaign::rewards(value, tier, faults));
    (requires.unwrap_or_default(), rewards.unwrap_or_default())
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

/// Reads an array of tables, so many at most; a missing one is empty.
fn array<'i, T>(
    value: Option<Spanned<DeValue<'i>>>,
    most: usize,
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
    if let Some(beyond) = items.get(most) {
        let fault = format!("a mission has {most} of these at most, not {}", items.len());
        faults.add(beyond.span(), fault);
    }
    items
        .into_iter()
        .take(most)
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
    let hazards = array(value, MOST_HAZARDS, faults, |value, faults| {
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
    let objectives = array(value, MOST_OBJECTIVES, faults, |value, faults| {
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
