//! What an event does: one table per action, told apart by the key that only it has.

use serde::Deserialize;
use toml::Spanned;
use toml::de::DeValue;

use super::{condition, known_event, section, time};
use crate::mission::Point;
use crate::mission::event::Action;
use crate::mission::event::expression::Names;
use crate::mission::event::fault::{Fault, FaultKind, Victim};
use crate::mission::event::mover::{MoverKind, Spawn};
use crate::mission::event::weather::{Change, Element, Target};
use crate::mission::file::{Faults, Section};
use crate::scoring::AlertLevel;

type Read = fn(Section<'_>, &Names<'_>, &mut Faults) -> Option<Action>;

/// All actions by the key that tells them.
pub(super) const ACTIONS: [(&str, Read); 8] = [
    ("say", say),
    ("alert", alert),
    ("set", set),
    ("zone", zone),
    ("spawn", spawn),
    ("fault", fault),
    ("fail", fail),
    ("event", event),
];
/// Points of one path.
const MOST_POINTS: usize = 100;
const HIGHEST_M: f64 = 5000.0;

/// Reads one action.
pub(super) fn action(
    value: Spanned<DeValue<'_>>,
    names: &Names<'_>,
    faults: &mut Faults,
) -> Option<Action> {
    let span = value.span();
    let known = ACTIONS.map(|(key, _)| key).join(", ");
    let DeValue::Table(table) = value.into_inner() else {
        faults.add(span, format!("an action is a table with one of {known}"));
        return None;
    };
    let found = ACTIONS.iter().find(|(key, _)| table.contains_key(*key));
    let Some((_, read)) = found else {
        faults.add(span, format!("an action needs one of {known}"));
        return None;
    };
    read(section(span, table), names, faults)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SayFile {
    say: Spanned<String>,
    say_uk: Option<Spanned<String>>,
}

fn say(section: Section<'_>, _: &Names<'_>, faults: &mut Faults) -> Option<Action> {
    let file: SayFile = faults.read(section)?;
    Some(Action::Say(faults.written(file.say, file.say_uk, "say_uk")))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FailFile {
    fail: Spanned<String>,
    fail_uk: Option<Spanned<String>>,
}

fn fail(section: Section<'_>, _: &Names<'_>, faults: &mut Faults) -> Option<Action> {
    let file: FailFile = faults.read(section)?;
    let text = faults.written(file.fail, file.fail_uk, "fail_uk");
    Some(Action::Fail(text))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct AlertFile {
    alert: AlertLevel,
    text: Spanned<String>,
    text_uk: Option<Spanned<String>>,
    ok: Option<Spanned<String>>,
    within: Option<Spanned<f64>>,
}

fn alert(section: Section<'_>, names: &Names<'_>, faults: &mut Faults) -> Option<Action> {
    let file: AlertFile = faults.read(section)?;
    if let (None, Some(within)) = (&file.ok, &file.within) {
        let message = "`within` needs an `ok`: the condition that answers the alert";
        faults.add(within.span(), message);
    }
    let within = match &file.within {
        Some(within) => {
            faults.number(within, 1.0..=3600.0, "within");
            time(Some(within), "within", faults)
        }
        None => file.alert.usual_limit(),
    };
    let ok = file.ok.map(|ok| condition(&ok, names, faults));
    Some(Action::Alert {
        level: file.alert,
        text: faults.written(file.text, file.text_uk, "text_uk"),
        ok: ok.flatten(),
        within,
    })
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SetFile {
    set: Spanned<String>,
    to: Spanned<f64>,
    ramp: Option<Spanned<f64>>,
    #[serde(rename = "for")]
    lasts: Option<Spanned<f64>>,
}

fn set(section: Section<'_>, _: &Names<'_>, faults: &mut Faults) -> Option<Action> {
    let file: SetFile = faults.read(section)?;
    let all = &Element::ALL;
    let found = all.iter().find(|(name, ..)| name == file.set.get_ref());
    let Some((name, element, range)) = found else {
        let known = all.each_ref().map(|(name, ..)| *name);
        faults.unknown("quantity", &file.set, &known);
        return None;
    };
    let to = faults.number(&file.to, range.clone(), name);
    Some(Action::Weather(Change {
        element: *element,
        to: Target::Value(to),
        ramp: time(file.ramp.as_ref(), "ramp", faults),
        lasts: file.lasts.map(|lasts| time(Some(&lasts), "for", faults)),
    }))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ZoneFile {
    zone: Spanned<String>,
    active: bool,
}

fn zone(section: Section<'_>, names: &Names<'_>, faults: &mut Faults) -> Option<Action> {
    let file: ZoneFile = faults.read(section)?;
    let zones = names.zones.iter().map(|zone| zone.id.as_str());
    let found = zones.clone().position(|id| id == file.zone.get_ref());
    if found.is_none() {
        faults.unknown("zone", &file.zone, &zones.collect::<Vec<_>>());
    }
    Some(Action::Zone(found?, file.active))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SpawnFile {
    spawn: Spanned<String>,
    id: Option<Spanned<String>>,
    path: Spanned<Vec<Spanned<Point>>>,
    speed: Spanned<f64>,
    height: Option<Spanned<f64>>,
    keep_out: Option<Spanned<f64>>,
    jitter: Option<Spanned<f64>>,
}

/// What can be brought, with how high it moves and how far to keep away unless the file says otherwise.
const MOVERS: [(&str, MoverKind, f64, f64); 3] = [
    ("person", MoverKind::Person, 0.0, 15.0),
    ("aircraft", MoverKind::Aircraft, 80.0, 60.0),
    ("intruder", MoverKind::Intruder, 30.0, 15.0),
];

fn spawn(section: Section<'_>, _: &Names<'_>, faults: &mut Faults) -> Option<Action> {
    let file: SpawnFile = faults.read(section)?;
    let name = file.spawn.get_ref();
    let Some((_, kind, height_m, keep_out_m)) = MOVERS.iter().find(|(known, ..)| known == name)
    else {
        faults.unknown("mover", &file.spawn, &MOVERS.map(|(known, ..)| known));
        return None;
    };
    let points = file.path.get_ref();
    if !(2..=MOST_POINTS).contains(&points.len()) {
        let message = format!("a path has 2 to {MOST_POINTS} points");
        faults.add(file.path.span(), message);
    }
    let path = points.iter().map(|point| faults.point(point, "path"));
    let path = path.collect();
    let mut or = |value: &Option<Spanned<f64>>, most, name, otherwise| {
        value
            .as_ref()
            .map_or(otherwise, |value| faults.number(value, 0.0..=most, name))
    };
    let height_m = or(&file.height, HIGHEST_M, "height", *height_m);
    let keep_out_m = or(&file.keep_out, 1000.0, "keep_out", *keep_out_m);
    let jitter_m = or(&file.jitter, 1000.0, "jitter", 0.0);
    Some(Action::Spawn(Spawn {
        id: file.id.as_ref().map_or(name, Spanned::get_ref).clone(),
        kind: *kind,
        path,
        speed_m_s: faults.number(&file.speed, 0.1..=300.0, "speed"),
        height_m,
        keep_out_m,
        jitter_m,
    }))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FaultFile {
    fault: Spanned<String>,
    vehicle: Spanned<WhomFile>,
    to: Option<Spanned<f64>>,
    #[serde(rename = "for")]
    lasts: Option<Spanned<f64>>,
}

/// A vehicle's number, `all`, or `random`.
#[derive(Deserialize)]
#[serde(untagged)]
enum WhomFile {
    Number(usize),
    Word(String),
}

fn fault(section: Section<'_>, names: &Names<'_>, faults: &mut Faults) -> Option<Action> {
    let file: FaultFile = faults.read(section)?;
    let all = &FaultKind::ALL;
    let found = all.iter().find(|(name, ..)| name == file.fault.get_ref());
    let Some((_, kind, usual, range)) = found else {
        let known = all.each_ref().map(|(name, ..)| *name);
        faults.unknown("fault", &file.fault, &known);
        return None;
    };
    let victim = match file.vehicle.get_ref() {
        WhomFile::Number(number) if (1..=names.vehicles).contains(number) => {
            Victim::One(number - 1)
        }
        WhomFile::Word(word) if word == "all" => Victim::All,
        WhomFile::Word(word) if word == "random" => Victim::Chance,
        _ => {
            let last = names.vehicles;
            let message = format!("`vehicle` is a number from 1 to {last}, \"all\" or \"random\"");
            faults.add(file.vehicle.span(), message);
            return None;
        }
    };
    let to = file
        .to
        .map_or(*usual, |to| faults.number(&to, range.clone(), "to"));
    Some(Action::Fault(Fault {
        kind: *kind,
        victim,
        to,
        lasts: file.lasts.map(|lasts| time(Some(&lasts), "for", faults)),
    }))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct OtherFile {
    event: Spanned<String>,
}

fn event(section: Section<'_>, names: &Names<'_>, faults: &mut Faults) -> Option<Action> {
    let file: OtherFile = faults.read(section)?;
    known_event(&file.event, names, faults).map(Action::Event)
}
