//! Short words for commands, and their parameters by name, for people who write plans by hand.

use crate::{Item, board, command};

/// The unit of a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FieldUnit {
    /// A number without a unit.
    None,
    /// A length or a height, in metres.
    Metres,
    /// A speed, in metres per second.
    MetresPerSecond,
    /// A duration, in seconds.
    Seconds,
    /// An angle or a direction, in degrees.
    Degrees,
    /// A rate of turn, in degrees per second.
    DegreesPerSecond,
    /// The length of a servo pulse, in microseconds.
    Microseconds,
    /// A share or a level, in percent.
    Percent,
}

impl FieldUnit {
    /// The symbol of the unit in texts; empty for numbers without a unit.
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::None => "",
            Self::Metres => "m",
            Self::MetresPerSecond => "m/s",
            Self::Seconds => "s",
            Self::Degrees => "°",
            Self::DegreesPerSecond => "°/s",
            Self::Microseconds => "us",
            Self::Percent => "%",
        }
    }
}

/// A parameter of a command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Field {
    /// The parameter's name, a single word.
    pub name: &'static str,
    /// The unit of its value.
    pub unit: FieldUnit,
    /// Its place among the first four parameters, from 0.
    index: usize,
}

impl Field {
    /// The parameter's value in an item.
    pub fn value(&self, item: &Item) -> f32 {
        item.params.get(self.index).copied().unwrap_or_default()
    }

    /// Sets the parameter's value in an item.
    pub fn set(&self, item: &mut Item, value: f32) {
        if let Some(param) = item.params.get_mut(self.index) {
            *param = value;
        }
    }
}

const fn field(index: usize, name: &'static str, unit: FieldUnit) -> Field {
    Field { name, unit, index }
}

const HOLD: Field = field(0, "hold", FieldUnit::Seconds);
const ACCEPT: Field = field(1, "accept", FieldUnit::Metres);
const TIME: Field = field(0, "time", FieldUnit::Seconds);
const RADIUS_FIRST: Field = field(0, "radius", FieldUnit::Metres);
const RADIUS_THIRD: Field = field(2, "radius", FieldUnit::Metres);

/// The words and parameters of commands, by the number of the command. Source: MAVLink's `MAV_CMD` and the commands of
/// ArduPilot 4.6.
const WORDS: &[(u16, &str, &[Field])] = &[
    (
        command::WAYPOINT,
        "waypoint",
        &[HOLD, ACCEPT, field(2, "pass", FieldUnit::Metres)],
    ),
    (command::LOITER_UNLIMITED, "loiter", &[RADIUS_THIRD]),
    (
        command::LOITER_TURNS,
        "turns",
        &[field(0, "turns", FieldUnit::None), RADIUS_THIRD],
    ),
    (command::LOITER_TIME, "wait-here", &[TIME, RADIUS_THIRD]),
    (command::RETURN_TO_LAUNCH, "rtl", &[]),
    (
        command::LAND,
        "land",
        &[field(0, "abort-height", FieldUnit::Metres)],
    ),
    (
        command::TAKEOFF,
        "takeoff",
        &[field(0, "pitch", FieldUnit::Degrees)],
    ),
    (
        command::LOITER_TO_ALTITUDE,
        "climb-here",
        &[field(1, "radius", FieldUnit::Metres)],
    ),
    (command::SPLINE_WAYPOINT, "spline", &[HOLD]),
    (command::VTOL_TAKEOFF, "vtol-takeoff", &[]),
    (command::VTOL_LAND, "vtol-land", &[]),
    (
        command::DELAY,
        "delay",
        &[
            TIME,
            field(1, "hour", FieldUnit::None),
            field(2, "minute", FieldUnit::None),
            field(3, "second", FieldUnit::None),
        ],
    ),
    (
        command::PAYLOAD_PLACE,
        "place",
        &[field(0, "descent", FieldUnit::Metres)],
    ),
    (112, "wait", &[TIME]),
    (
        114,
        "wait-distance",
        &[field(0, "distance", FieldUnit::Metres)],
    ),
    (
        115,
        "yaw",
        &[
            field(0, "angle", FieldUnit::Degrees),
            field(1, "rate", FieldUnit::DegreesPerSecond),
            field(2, "direction", FieldUnit::None),
            field(3, "relative", FieldUnit::None),
        ],
    ),
    (
        command::DO_JUMP,
        "jump",
        &[
            field(0, "to", FieldUnit::None),
            field(1, "times", FieldUnit::None),
        ],
    ),
    (
        command::DO_CHANGE_SPEED,
        "speed",
        &[
            field(0, "kind", FieldUnit::None),
            field(1, "speed", FieldUnit::MetresPerSecond),
            field(2, "throttle", FieldUnit::Percent),
        ],
    ),
    (
        command::DO_SET_HOME,
        "set-home",
        &[field(0, "current", FieldUnit::None)],
    ),
    (
        181,
        "relay",
        &[
            field(0, "number", FieldUnit::None),
            field(1, "state", FieldUnit::None),
        ],
    ),
    (
        183,
        "servo",
        &[
            field(0, "number", FieldUnit::None),
            field(1, "pwm", FieldUnit::Microseconds),
        ],
    ),
    (command::DO_RETURN_PATH_START, "return-start", &[]),
    (command::DO_LAND_START, "land-start", &[]),
    (command::DO_SET_ROI, "roi", &[]),
    (
        205,
        "mount",
        &[
            field(0, "pitch", FieldUnit::Degrees),
            field(1, "roll", FieldUnit::Degrees),
            field(2, "heading", FieldUnit::Degrees),
        ],
    ),
    (
        206,
        "camera-distance",
        &[
            field(0, "distance", FieldUnit::Metres),
            field(2, "once", FieldUnit::None),
        ],
    ),
    (207, "fence", &[field(0, "state", FieldUnit::None)]),
    (208, "parachute", &[field(0, "state", FieldUnit::None)]),
    (
        211,
        "gripper",
        &[
            field(0, "number", FieldUnit::None),
            field(1, "state", FieldUnit::None),
        ],
    ),
    (216, "sprayer", &[field(0, "state", FieldUnit::None)]),
    (
        command::JUMP_TAG,
        "tag",
        &[field(0, "tag", FieldUnit::None)],
    ),
    (
        command::DO_JUMP_TAG,
        "jump-tag",
        &[
            field(0, "tag", FieldUnit::None),
            field(1, "times", FieldUnit::None),
        ],
    ),
    (
        2000,
        "photo",
        &[
            field(1, "interval", FieldUnit::Seconds),
            field(2, "count", FieldUnit::None),
        ],
    ),
    (2001, "photo-stop", &[]),
    (command::FENCE_RETURN_POINT, "return-point", &[]),
    (command::FENCE_POLYGON_INCLUSION, "stay-in", &[]),
    (command::FENCE_POLYGON_EXCLUSION, "stay-out", &[]),
    (
        command::FENCE_CIRCLE_INCLUSION,
        "circle-in",
        &[RADIUS_FIRST],
    ),
    (
        command::FENCE_CIRCLE_EXCLUSION,
        "circle-out",
        &[RADIUS_FIRST],
    ),
    (command::RALLY_POINT, "rally", &[]),
];

/// The parameters of a command that has no row in the table.
const NUMBERED: &[Field] = &[
    field(0, "p1", FieldUnit::None),
    field(1, "p2", FieldUnit::None),
    field(2, "p3", FieldUnit::None),
    field(3, "p4", FieldUnit::None),
];

fn row(command: u16) -> Option<&'static (u16, &'static str, &'static [Field])> {
    let at = WORDS
        .binary_search_by_key(&command, |(number, ..)| *number)
        .ok()?;
    WORDS.get(at)
}

/// The short word of a command, otherwise its name in MAVLink; `None` if plans cannot have it.
pub fn word(command: u16) -> Option<&'static str> {
    row(command)
        .map(|(_, word, _)| *word)
        .or_else(|| board::name(command))
}

/// The plan command that a word stands for: its short word, or its name in MAVLink without
/// `MAV_CMD_`. Case does not matter.
pub fn command_of(written: &str) -> Option<u16> {
    let mut short = WORDS.iter().filter(|(number, ..)| is_of_plan(*number));
    let by_word = short.find(|(_, word, _)| word.eq_ignore_ascii_case(written));
    let by_name = || {
        let mut all = board::commands();
        all.find(|(_, name)| name.eq_ignore_ascii_case(written))
    };
    by_word
        .map(|(number, ..)| *number)
        .or_else(|| by_name().map(|(number, _)| number))
}

/// The commands that plans may have, by their words, with their names in MAVLink.
pub fn plan_words() -> impl Iterator<Item = (&'static str, &'static str)> {
    board::commands().map(|(number, name)| (word(number).unwrap_or(name), name))
}

/// The short words of the commands that plans may have.
pub fn short_plan_words() -> impl Iterator<Item = &'static str> {
    let own = WORDS.iter().filter(|(number, ..)| is_of_plan(*number));
    own.map(|(_, word, _)| *word)
}

fn is_of_plan(number: u16) -> bool {
    !command::is_fence(number) && number != command::RALLY_POINT
}

/// The parameters of a command that have a name. Commands that are rarely used have numbers only: `p1` to `p4`.
pub fn fields(command: u16) -> &'static [Field] {
    row(command).map_or(NUMBERED, |(_, _, fields)| *fields)
}

/// The parameter of a command by its number, from 1 to 4; `None` for other numbers.
pub fn field_numbered(command: u16, number: u8) -> Option<Field> {
    let mut known = fields(command).iter().chain(NUMBERED);
    known
        .find(|field| field.index + 1 == usize::from(number))
        .copied()
}

/// The parameter of a command by its name; case does not matter. `p1` to `p4` name the parameters
/// of every command. `None` for other names.
pub fn field_named(command: u16, name: &str) -> Option<Field> {
    let mut known = fields(command).iter().chain(NUMBERED);
    known
        .find(|field| field.name.eq_ignore_ascii_case(name))
        .copied()
}

/// All parameter names, each once, with their units.
pub fn field_names() -> impl Iterator<Item = (&'static str, FieldUnit)> {
    let all = WORDS.iter().flat_map(|(_, _, fields)| fields.iter());
    let mut names: Vec<(&str, FieldUnit)> = all
        .chain(NUMBERED)
        .map(|field| (field.name, field.unit))
        .collect();
    names.sort_unstable_by_key(|(name, _)| *name);
    names.dedup_by_key(|(name, _)| *name);
    names.into_iter()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[test]
    fn rows_are_in_order_and_words_mean_one_command() {
        assert!(WORDS.is_sorted_by(|a, b| a.0 < b.0));
        for (number, word, _) in WORDS.iter().filter(|(number, ..)| is_of_plan(*number)) {
            assert_eq!(command_of(word), Some(*number), "{word}");
        }
        assert_eq!(command_of("NAV_TAKEOFF"), Some(command::TAKEOFF));
        assert_eq!(command_of("Takeoff"), Some(command::TAKEOFF));
        assert_eq!(
            command_of("stay-in"),
            None,
            "a corner of a fence is no command of a plan"
        );
    }

    #[test]
    fn a_name_has_one_unit_in_all_commands() {
        let mut units = BTreeMap::new();
        for field in WORDS.iter().flat_map(|(_, _, fields)| fields.iter()) {
            let unit = units.entry(field.name).or_insert(field.unit);
            assert_eq!(*unit, field.unit, "{}", field.name);
        }
    }

    #[test]
    fn parameters_are_read_and_set_by_name() {
        let mut item = Item {
            command: command::LOITER_TURNS,
            ..Item::default()
        };
        let radius = field_named(item.command, "radius").expect("known");
        radius.set(&mut item, 25.0);
        let wanted = Item {
            command: command::LOITER_TURNS,
            params: [0.0, 0.0, 25.0, 0.0],
            ..Item::default()
        };
        assert!(item.is_same(&wanted), "{item:?}");
        let third = field_named(item.command, "p3").expect("known");
        assert_eq!(third.value(&item).to_bits(), 25f32.to_bits());
        assert!(field_named(command::LAND, "radius").is_none());
    }
}
