//! A mission file while it is being read: the results of earlier sections, references to them, and the faults so far.

use std::collections::BTreeMap;
use std::ops::Range;
use std::time::Duration;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::{FileFaults, NameKind};
use crate::mission::Point;
use crate::mission::pad::pad_name;
use crate::mission::sensor::Sensor;
use crate::mission::survey::SurveyPlan;
use crate::mission::zone::{Zone, ZoneKind};
use crate::text;

/// The results of earlier sections, for the sections that refer to them.
#[derive(Debug, Default)]
pub(in crate::mission) struct Draft {
    pub faults: FileFaults,
    pub zones: Vec<Zone>,
    /// Every sensor that some vehicle carries.
    pub sensors: Vec<&'static Sensor>,
    pub surveys: Vec<SurveyPlan>,
    pub places: Vec<NamedPlace>,
    pub pads: Vec<Point>,
    pub time_limit: Option<Duration>,
    /// Whether the vehicles carry plans at the start.
    pub has_plans: bool,
    /// The highest difficulty that the head names.
    pub tier: u8,
    /// The names of places that earlier objectives will define.
    pub drawn: Vec<String>,
    /// The ids of each section so far, in file order, including those of tables with faults.
    ids: BTreeMap<&'static str, Vec<String>>,
    /// All names in the file that can be referred to, including those of tables with faults.
    pub declared: Declared,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NamedPlace {
    pub name: String,
    pub at: Point,
    /// The position of the name in the file.
    pub written: Range<usize>,
}

/// All names in a file.
#[derive(Debug, Default)]
pub(in crate::mission) struct Declared {
    /// The names of zones, places, hazards, objectives and sensors.
    all: Vec<String>,
    pub events: Vec<String>,
    /// The names of the movers that events add.
    pub movers: Vec<String>,
}

impl Draft {
    /// A draft before any section is read.
    pub fn of(root: &DeTable<'_>) -> Self {
        Self {
            declared: Declared::of(root),
            ..Self::default()
        }
    }

    /// Adds the id of a table; also adds a fault if the section already has that id.
    pub fn add_id(&mut self, section: &'static str, id: &Spanned<String>) {
        let seen = self.ids.entry(section).or_default();
        if seen.contains(id.get_ref()) {
            let fault = text!("fault-id-twice", id = id.get_ref());
            self.faults.add(id.span(), fault);
        }
        seen.push(id.get_ref().clone());
    }

    /// The ids of a section so far, in file order.
    pub fn ids(&self, section: &str) -> &[String] {
        self.ids.get(section).map_or(&[], Vec::as_slice)
    }

    /// A zone of kind `task` by name.
    pub fn task_zone(&mut self, name: &Spanned<String>) -> Option<Zone> {
        let tasks = self.zones.iter().filter(|zone| zone.kind == ZoneKind::Task);
        let known: Vec<String> = tasks.map(|zone| zone.id.clone()).collect();
        self.refer(NameKind::TaskZone, name, &known)?;
        let mut zones = self.zones.iter();
        zones.find(|zone| zone.id == *name.get_ref()).cloned()
    }

    /// A sensor that the fleet carries.
    pub fn fitted_sensor(&mut self, name: &Spanned<String>) -> Option<&'static Sensor> {
        let known = self.sensors.iter().map(|sensor| sensor.id.to_owned());
        let index = self.refer(NameKind::FleetSensor, name, &known.collect::<Vec<_>>())?;
        Some(self.sensors[index])
    }

    /// The index of a hazard in the file, by name.
    pub fn hazard(&mut self, name: &Spanned<String>) -> Option<usize> {
        let known = self.ids("hazards").to_vec();
        self.refer(NameKind::Hazard, name, &known)
    }

    /// The survey of an objective earlier in the file.
    pub fn survey(&mut self, name: &Spanned<String>) -> Option<SurveyPlan> {
        let known = self.surveys.iter().map(|survey| survey.id.clone());
        let index = self.refer(NameKind::EarlierSurvey, name, &known.collect::<Vec<_>>())?;
        Some(self.surveys[index].clone())
    }

    /// A place in the file, or a pad, by name.
    pub fn place(&mut self, name: &Spanned<String>) -> Option<Point> {
        let named = self
            .places
            .iter()
            .map(|place| (place.name.clone(), place.at));
        let pads = (1..)
            .zip(&self.pads)
            .map(|(number, &pad)| (pad_name(number), pad));
        let (names, points): (Vec<String>, Vec<Point>) = named.chain(pads).unzip();
        let index = self.refer(NameKind::Place, name, &names)?;
        Some(points[index])
    }

    /// A place in the file, or a pad, with its name and the position of the reference.
    pub fn named_place(&mut self, name: &Spanned<String>) -> Option<NamedPlace> {
        Some(NamedPlace {
            at: self.place(name)?,
            name: name.get_ref().clone(),
            written: name.span(),
        })
    }

    /// Adds a fault if the file does not declare this name.
    pub fn check_declared(&mut self, kind: NameKind, name: &Spanned<String>) {
        if !self.declared.all.contains(name.get_ref()) {
            let known: Vec<&str> = self.declared.all.iter().map(String::as_str).collect();
            self.faults.unknown(kind, name, &known);
        }
    }

    /// The index of a name among the known ones. An unknown name is a fault, unless that merely follows from an
    /// earlier fault.
    fn refer(&mut self, kind: NameKind, name: &Spanned<String>, known: &[String]) -> Option<usize> {
        let found = known.iter().position(|known| known == name.get_ref());
        let is_declared = known.is_empty() || self.declared.all.contains(name.get_ref());
        if found.is_none() && (self.faults.is_empty() || !is_declared) {
            let known: Vec<&str> = known.iter().map(String::as_str).collect();
            self.faults.unknown(kind, name, &known);
        }
        found
    }
}

impl Declared {
    /// The names declared in a file; tables that cannot be read are skipped.
    pub fn of(root: &DeTable<'_>) -> Self {
        let value = |key: &str| root.get(key).map(Spanned::get_ref);
        let sections = ["zones", "places", "hazards", "objectives"];
        let tables = sections.into_iter().flat_map(|key| items(value(key)));
        let ids = tables.filter_map(|table| word(table, "id"));
        let fleet = value("fleet");
        let vehicles = items(fleet.and_then(|fleet| field(fleet, "vehicles")));
        let fitted = fleet.into_iter().chain(vehicles);
        let sensors = fitted
            .flat_map(|table| items(field(table, "sensors")))
            .filter_map(|item| item.as_str().map(str::to_owned));
        let events = || items(value("events"));
        let actions = events().flat_map(|event| items(field(event, "do")));
        let brought = |action| word(action, "id").or_else(|| word(action, "spawn"));
        Self {
            all: ids.chain(sensors).collect(),
            events: events()
                .map(|event| word(event, "id").unwrap_or_default())
                .collect(),
            movers: actions.filter_map(brought).collect(),
        }
    }
}

fn field<'t, 'i>(table: &'t DeValue<'i>, key: &str) -> Option<&'t DeValue<'i>> {
    table.get(key).map(Spanned::get_ref)
}

fn word(table: &DeValue<'_>, key: &str) -> Option<String> {
    field(table, key)?.as_str().map(str::to_owned)
}

fn items<'t, 'i>(list: Option<&'t DeValue<'i>>) -> impl Iterator<Item = &'t DeValue<'i>> {
    let list = list.and_then(DeValue::as_array);
    list.into_iter().flatten().map(Spanned::get_ref)
}
