//! The actions of events: one table each, recognised by the key that only that action has.

use std::time::Duration;

use toml::Spanned;
use toml::de::DeValue;

use super::condition::{condition, known_event};
use crate::mission::event::Action;
use crate::mission::event::fault::{Fault, FaultKind, Victim};
use crate::mission::event::mover::{MoverKind, Spawn};
use crate::mission::event::weather::{Change, Element, Target};
use crate::mission::format::{
    Draft, FileShape, FileTable, FileValue, KindOf, NameKind, flag, list, named, not_between,
    number, point, seconds, text, text_by, time, whole, word,
};
use crate::scoring::AlertLevel;
use crate::text;

/// All actions by the key that identifies them.
const ACTIONS: &[KindOf<Action>] = &[
    KindOf {
        name: "say",
        about: "shows the trainee a message",
        read: say,
    },
    KindOf {
        name: "alert",
        about: "raises an alert; with `ok`, the trainee has to make the condition true in time, which counts for attention",
        read: alert,
    },
    KindOf {
        name: "set",
        about: "changes the weather",
        read: set,
    },
    KindOf {
        name: "zone",
        about: "switches a zone on or off",
        read: zone,
    },
    KindOf {
        name: "spawn",
        about: "adds a person, an aircraft or an unknown drone, which follows the path once and then disappears",
        read: spawn,
    },
    KindOf {
        name: "fault",
        about: "causes a fault in a vehicle",
        read: fault,
    },
    KindOf {
        name: "fail",
        about: "ends the mission as failed",
        read: fail,
    },
    KindOf {
        name: "event",
        about: "triggers another event",
        read: event,
    },
];
/// The maximum number of points of one path.
const MOST_POINTS: usize = 100;

const LEVELS: [(&str, AlertLevel); 3] = [
    ("caution", AlertLevel::Caution),
    ("warning", AlertLevel::Warning),
    ("critical", AlertLevel::Critical),
];

pub(super) fn action(table: &mut FileTable<'_>) -> Option<Action> {
    table.need_one_of(text!("name-an-action"), ACTIONS)
}

fn say(table: &mut FileTable<'_>) -> Option<Action> {
    table.need_text("say", "the message").map(Action::Say)
}

fn fail(table: &mut FileTable<'_>) -> Option<Action> {
    table.need_text("fail", "reason").map(Action::Fail)
}

fn alert(table: &mut FileTable<'_>) -> Option<Action> {
    let level = table.need("alert", word(&LEVELS), "level of the alert");
    let text = table.need_text("text", "text of the alert");
    let ok = table.may("ok", condition(), "condition that answers the alert");
    let within = table.may(
        "within",
        seconds(1.0, 3600.0),
        "time to answer (default 60, 30 or 10 s, by level)",
    );
    let about = table.may(
        "vehicle",
        whole(1, 250, ""),
        "number of the vehicle that the alert is about",
    );
    let pads = table.draft().pads.len();
    if about.is_some_and(|number| number as usize > pads) {
        table.fault_of("vehicle", text!("fault-vehicle-number", last = pads));
    }
    if within.is_some() && !table.is_written("ok") {
        table.fault_of("within", text!("fault-within-ok"));
    }
    let level = level?;
    Some(Action::Alert {
        level,
        text: text?,
        ok,
        within: within.unwrap_or_else(|| level.usual_limit()),
        about: about.map(|number| number as usize - 1),
    })
}

fn set(table: &mut FileTable<'_>) -> Option<Action> {
    let quantity_form = named(NameKind::Quantity, Element::names, Element::named);
    let quantity = table.need("set", quantity_form, "quantity that changes");
    let to = table.need("to", number(-40.0, 360.0, ""), "new value");
    let ramp = table.or("ramp", time(), Duration::ZERO, "time over which it changes");
    let lasts = table.may(
        "for",
        time(),
        "time until the old value returns (default permanent)",
    );
    let ((element, range), to) = (quantity?, to?);
    if !range.contains(&to) {
        table.fault_of("to", not_between("to", &range, to));
    }
    Some(Action::Weather(Change {
        element,
        to: Target::Value(to),
        ramp,
        lasts,
    }))
}

fn zone(table: &mut FileTable<'_>) -> Option<Action> {
    let id = table.need("zone", text("id of a zone"), "zone to switch");
    let active = table.need("active", flag(), "`true` switches it on");
    let id = id?;
    let Draft { zones, faults, .. } = table.draft();
    let found = zones.iter().position(|zone| zone.id == *id.get_ref());
    if found.is_none() {
        let known: Vec<&str> = zones.iter().map(|zone| zone.id.as_str()).collect();
        faults.unknown(NameKind::Zone, &id, &known);
    }
    Some(Action::Zone(found?, active?))
}

/// The kinds of movers, with the default height and the default distance to keep.
const MOVERS: [(&str, MoverKind, f64, f64); 3] = [
    ("person", MoverKind::Person, 0.0, 15.0),
    ("aircraft", MoverKind::Aircraft, 80.0, 60.0),
    ("intruder", MoverKind::Intruder, 30.0, 15.0),
];

/// Whether a callsign fits into the report of an ADS-B transmitter.
fn is_callsign(callsign: &str) -> bool {
    (1..=8).contains(&callsign.chars().count()) && !callsign.trim().is_empty()
}

fn spawn(table: &mut FileTable<'_>) -> Option<Action> {
    let mover_form = named(
        NameKind::Mover,
        || MOVERS.map(|(name, ..)| name).to_vec(),
        |name| MOVERS.iter().find(|(known, ..)| *known == name),
    );
    let mover = table.need("spawn", mover_form, "`person`, `aircraft` or `intruder`");
    let id = table.may("id", text(""), "name for conditions (default its kind)");
    let callsign = table.may(
        "callsign",
        text_by("1 to 8 characters", is_callsign, "fault-callsign"),
        "callsign of an aircraft in the list of traffic (default its id in capital letters)",
    );
    let path = table.need("path", list(point(), 2, MOST_POINTS), "points of the path");
    let speed_m_s = table.need("speed", number(0.1, 300.0, "m/s"), "speed along the path");
    let height_m = table.may(
        "height",
        number(0.0, 5000.0, "m"),
        "height (default 0, 80 or 30 m, by kind)",
    );
    let keep_out_m = table.may(
        "keep_out",
        number(0.0, 1000.0, "m"),
        "distance that vehicles must keep (default 15, 60 or 15 m, by kind)",
    );
    let jitter = number(0.0, 1000.0, "m");
    let jitter_m = table.or(
        "jitter",
        jitter,
        0.0,
        "the seed moves the whole path by up to this distance",
    );
    let &(name, kind, usual_height_m, usual_keep_out_m) = mover?;
    if callsign.is_some() && kind != MoverKind::Aircraft {
        let message = format!("only an aircraft has a callsign, not the {name}");
        table.fault_of("callsign", message);
    }
    let id = id.map_or_else(|| name.to_owned(), Spanned::into_inner);
    let usual = id.to_uppercase();
    Some(Action::Spawn(Spawn {
        id,
        kind,
        callsign: callsign.map_or(usual, Spanned::into_inner),
        path: path?,
        speed_m_s: speed_m_s?,
        height_m: height_m.unwrap_or(usual_height_m),
        keep_out_m: keep_out_m.unwrap_or(usual_keep_out_m),
        jitter_m,
    }))
}

fn fault(table: &mut FileTable<'_>) -> Option<Action> {
    let kind_form = named(
        NameKind::Fault,
        || FaultKind::ALL.iter().map(|(name, ..)| *name).collect(),
        |name| {
            FaultKind::ALL
                .into_iter()
                .find(|(known, ..)| *known == name)
        },
    );
    let kind = table.need("fault", kind_form, "kind of fault");
    let victim = table.need("vehicle", VictimValue, "vehicle in which the fault occurs");
    let to = table.may(
        "to",
        number(-1e6, 1e6, ""),
        "severity, in the unit of the fault (by default, the usual one)",
    );
    let lasts = table.may(
        "for",
        time(),
        "time until the fault ends (default permanent)",
    );
    let (_, kind, usual, range) = kind?;
    if let Some(to) = to.filter(|to| !range.contains(to)) {
        table.fault_of("to", not_between("to", &range, to));
    }
    Some(Action::Fault(Fault {
        kind,
        victim: victim?,
        to: to.unwrap_or(usual),
        lasts,
    }))
}

/// A vehicle's number, `all`, or `random`.
struct VictimValue;

impl FileValue for VictimValue {
    type Out = Victim;

    fn shape(&self) -> FileShape {
        FileShape::NumberOrWord("a vehicle's number, `all` or `random`")
    }

    fn read(&self, name: &str, written: Spanned<DeValue<'_>>, draft: &mut Draft) -> Option<Victim> {
        let place = written.span();
        let last = draft.pads.len();
        let victim = match written.get_ref() {
            DeValue::String(word) if word == "all" => Some(Victim::All),
            DeValue::String(word) if word == "random" => Some(Victim::Chance),
            DeValue::Integer(_) => {
                let number: u32 = draft.faults.read(written)?;
                let index = (number as usize).checked_sub(1);
                index.filter(|index| *index < last).map(Victim::One)
            }
            _ => None,
        };
        if victim.is_none() {
            let message = text!("fault-victim", name = name, last = last);
            draft.faults.add(place, message);
        }
        victim
    }
}

fn event(table: &mut FileTable<'_>) -> Option<Action> {
    let id = table.need("event", text("id of an event"), "event to trigger")?;
    known_event(table.draft(), &id).map(Action::Event)
}
