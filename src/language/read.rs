//! Parses words into values.

mod candidates;

use std::collections::BTreeMap;

use mavlink::dialects::ardupilotmega::MavMessage;

use super::argument::{Kind, Unit, Value};
use super::lexer::Word;
use super::modes::mode_named;
use super::{Context, VehicleChoice};
use crate::commands::{command_by_name, is_contact_name, is_peak_name};
use crate::config::TableSort;
use crate::draft::Items;
use crate::geo::{LatLon, Outline};
use crate::plan::field;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleClass;

/// Message ids have 24 bits.
const HIGHEST_MESSAGE: u32 = 0x00FF_FFFF;

/// Why words are not the expected value.
pub(super) enum Misread {
    /// Words of the value are missing.
    Incomplete,
    /// A word is wrong.
    Wrong {
        /// The index of the word in the value.
        word: usize,
        /// Whether the word is of the right kind and only its value is invalid, so no other
        /// argument was meant.
        specific: bool,
        message: Text,
    },
}

impl Misread {
    fn kind(message: Text) -> Self {
        Self::Wrong {
            word: 0,
            specific: false,
            message,
        }
    }

    fn value(message: Text) -> Self {
        Self::Wrong {
            word: 0,
            specific: true,
            message,
        }
    }

    /// Converts a fault in a part to a fault in the whole value, given the part's first word and
    /// its name.
    fn part(self, at: usize, name: &'static str) -> Self {
        match self {
            Self::Wrong {
                word,
                specific,
                message,
            } => Self::Wrong {
                word: word + at,
                specific,
                message: Text::joined(": ", vec![name.into(), message]),
            },
            Self::Incomplete => Self::Incomplete,
        }
    }
}

impl Kind {
    /// Parses a value at the beginning of `words`, which must not be empty. Also returns the number of words used.
    pub(super) fn read(self, words: &[Word], context: &Context) -> Result<(Value, usize), Misread> {
        let Some(first) = words.first() else {
            return Err(Misread::Incomplete);
        };
        let text = first.text;
        let value = match self {
            Self::Flag => Value::Flag,
            Self::Number(unit, least, greatest) => {
                Value::Number(number(text, unit, least, greatest)?)
            }
            Self::Whole(unit, least, greatest) => {
                let value = number(text, unit, least, greatest)?;
                if value.fract() != 0.0 {
                    return Err(Misread::value(text!("grammar-not-whole", word = text)));
                }
                Value::Number(value)
            }
            Self::Choice(choices) => {
                let chosen = choices.iter().find(|choice| first.is(choice));
                let word = *chosen.ok_or_else(|| self.none_of(choices, text))?;
                Value::Word(word.to_owned())
            }
            Self::Mode => Value::Word(mode(text, context)?),
            Self::Point => return point(words, context),
            Self::Area => Value::Area(area(text, context)?),
            Self::Parameter => Value::Word(parameter(text)?),
            Self::Message => Value::Number(f64::from(message(text)?)),
            Self::MavCommand => Value::Number(f64::from(command(text)?)),
            Self::Name(list) => {
                let listed = context.names.listed(list);
                Value::Word(listed.meant(list, text).map_err(Misread::kind)?)
            }
            Self::Group => Value::Word(text.trim_start_matches('@').to_owned()),
            Self::Vehicles => Value::Vehicles(VehicleChoice::read(first).map_err(Misread::kind)?),
            Self::Sort => Value::Word(sort(text)?),
            Self::Items => Value::Items(items(text)?),
            Self::PlanCommand => Value::Number(f64::from(plan_command(text)?)),
            Self::PlanField => Value::Word(plan_field(text)?.to_owned()),
            Self::Rest | Self::Proposed(_) | Self::PlanFile | Self::Fields => {
                return Ok((Value::Word(first.tail.to_owned()), words.len()));
            }
        };
        Ok((value, 1))
    }

    /// The fault of a word that is not one of the choices, with a short list of them.
    fn none_of(self, choices: &[&str], word: &str) -> Misread {
        Misread::kind(if self.fits_a_usage() {
            let choices = choices.join(", ");
            text!("grammar-none-of", word = word, choices = choices)
        } else {
            text!("grammar-no-name", word = word)
        })
    }
}

/// Parses a number that may have a unit, converts it to the first spelling of `unit`, and checks
/// its range.
fn number(text: &str, unit: Unit, least: f64, greatest: f64) -> Result<f64, Misread> {
    let (digits, suffix) = text.split_at(number_length(text));
    let Ok(written) = digits.parse::<f64>() else {
        return Err(Misread::kind(text!("grammar-no-number", word = text)));
    };
    let spelling = unit
        .spellings()
        .iter()
        .find(|(spelling, _)| suffix.is_empty() || spelling.eq_ignore_ascii_case(suffix));
    let factor = match (spelling, suffix) {
        (_, "") => 1.0,
        (Some(&(_, factor)), _) => factor,
        (None, _) => return Err(Misread::value(wrong_unit(text, suffix, unit))),
    };
    let value = written * factor;
    // This range check also fails for NaN.
    if (least..=greatest).contains(&value) {
        return Ok(value);
    }
    let limits = Kind::Number(unit, least, greatest).limits();
    Err(Misread::value(match limits {
        Some(limits) if value.is_finite() => {
            text!("grammar-out-of-range", word = text, limits = limits)
        }
        _ => text!("grammar-too-large", word = text),
    }))
}

fn wrong_unit(text: &str, suffix: &str, unit: Unit) -> Text {
    let known: Vec<&str> = unit.spellings().iter().map(|&(name, _)| name).collect();
    if known.is_empty() {
        text!("grammar-no-unit-here", word = text)
    } else {
        let known = known.join(", ");
        text!("grammar-wrong-unit", unit = suffix, known = known)
    }
}

/// The length in bytes of the decimal number at the start of `text`: sign, digits with a point, exponent.
pub(super) fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| {
        bytes[from..]
            .iter()
            .take_while(|byte| byte.is_ascii_digit())
            .count()
    };
    let mut at = usize::from(text.starts_with(['+', '-']));
    at += digits(at);
    if bytes.get(at) == Some(&b'.') {
        at += 1 + digits(at + 1);
    }
    if matches!(bytes.get(at), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(at + 1), Some(b'+' | b'-')));
        let exponent = digits(at + 1 + sign);
        if exponent > 0 {
            at += 1 + sign + exponent;
        }
    }
    at
}

/// The highest number of an item.
const LAST_ITEM: usize = 9999;

fn items(text: &str) -> Result<Items, Misread> {
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    let number = |word: &str| word.parse().ok().filter(|it| (1..=LAST_ITEM).contains(it));
    let (Some(first), Some(last)) = (number(first), number(last)) else {
        return Err(Misread::kind(text!("grammar-no-items", word = text)));
    };
    Ok(Items {
        first: first.min(last),
        last: first.max(last),
    })
}

fn plan_command(text: &str) -> Result<u16, Misread> {
    field::command_of(text)
        .ok_or_else(|| Misread::value(text!("grammar-no-plan-command", word = text)))
}

fn plan_field(text: &str) -> Result<&'static str, Misread> {
    let mut names = field::field_names().map(|(name, _)| name);
    names
        .find(|name| name.eq_ignore_ascii_case(text))
        .ok_or_else(|| Misread::kind(text!("grammar-no-plan-field", word = text)))
}

/// The value of an item's parameter, in the unit that its name has.
///
/// # Errors
/// The word is not a number, or has a different unit.
pub(super) fn field_value(name: &str, text: &str) -> Result<f32, Text> {
    let mut known = field::field_names().filter(|(known, _)| *known == name);
    let unit = known
        .next()
        .map_or(Unit::None, |(_, unit)| Unit::of_field(unit));
    match number(text, unit, f64::from(f32::MIN), f64::from(f32::MAX)) {
        Ok(value) => Ok(value as f32),
        Err(Misread::Wrong { message, .. }) => Err(message),
        Err(Misread::Incomplete) => Err(text!("grammar-no-number", word = text)),
    }
}

fn mode(text: &str, context: &Context) -> Result<String, Misread> {
    if text.parse::<u8>().is_ok() {
        return Ok(text.to_owned());
    }
    mode_named(text, context).map(str::to_owned).ok_or_else(|| {
        Misread::kind(match context.class {
            VehicleClass::Copter => text!("grammar-no-mode-copter", mode = text),
            VehicleClass::Plane => text!("grammar-no-mode-plane", mode = text),
            VehicleClass::Rover => text!("grammar-no-mode-rover", mode = text),
            VehicleClass::Sub => text!("grammar-no-mode-sub", mode = text),
            VehicleClass::Px4 => text!("grammar-no-mode-px4", mode = text),
            VehicleClass::Other => text!("grammar-no-mode", mode = text),
        })
    })
}

fn sort(text: &str) -> Result<String, Misread> {
    match TableSort::read(text) {
        Ok(sort) => Ok(sort.name()),
        Err(fault) => Err(Misread::kind(fault.message)),
    }
}

/// The maximum number of contacts that a fault lists one by one.
const MOST_CONTACTS: usize = 8;
/// The position of a place known only by name, to which no vehicle can fly.
const NOWHERE: LatLon = LatLon::new(f64::NAN, f64::NAN);

fn point(words: &[Word], context: &Context) -> Result<(Value, usize), Misread> {
    let Some(first) = words.first() else {
        return Err(Misread::Incomplete);
    };
    if let Some(&place) = context.places.and_then(|places| places.get(first.text)) {
        return Ok((Value::Point(place), 1));
    }
    if number_length(first.text) == 0 || first.text.parse::<f64>().is_err() {
        let Some(places) = context.places else {
            return Ok((Value::Point(NOWHERE), 1));
        };
        return Err(no_place(first.text, places));
    }
    let lat_deg =
        number(first.text, Unit::Degrees, -90.0, 90.0).map_err(|misread| misread.part(0, "LAT"))?;
    let Some(second) = words.get(1) else {
        return Err(Misread::Incomplete);
    };
    let lon_deg = number(second.text, Unit::Degrees, -180.0, 180.0)
        .map_err(|misread| misread.part(1, "LON"))?;
    Ok((Value::Point(LatLon::new(lat_deg, lon_deg)), 2))
}

/// The fault of an unknown place. The name of a contact can be no other argument, so its fault names the contacts; the
/// place of the highest reading has a name before it is known.
fn no_place(word: &str, places: &BTreeMap<String, LatLon>) -> Misread {
    if is_peak_name(word) {
        return Misread::value(text!("grammar-no-peak-yet", peak = word));
    }
    if !is_contact_name(word) {
        return Misread::kind(text!("grammar-no-place", place = word));
    }
    let names = places.keys().map(String::as_str);
    let mut known: Vec<&str> = names.filter(|name| is_contact_name(name)).collect();
    // By number: `c2` before `c10`.
    known.sort_unstable_by_key(|name| (name.len(), *name));
    Misread::value(match known.as_slice() {
        [] => text!("grammar-no-contact-yet", contact = word),
        [first, second, .., last] if known.len() > MOST_CONTACTS => {
            let known = format!("{first}, {second} .. {last}");
            text!("grammar-no-contact", contact = word, known = known)
        }
        known => {
            let known = known.join(", ");
            text!("grammar-no-contact", contact = word, known = known)
        }
    })
}

/// The area with this name. An area known only by name has no corners, so no vehicle can fly there.
fn area(text: &str, context: &Context) -> Result<Outline, Misread> {
    match context.areas {
        None if number_length(text) == 0 => Ok(Outline::Polygon(Vec::new())),
        Some(areas) if areas.contains_key(text) => Ok(areas[text].clone()),
        _ => Err(Misread::kind(text!("grammar-no-area", area = text))),
    }
}

fn parameter(text: &str) -> Result<String, Misread> {
    let good = text
        .bytes()
        .all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
    if good && text.len() <= 16 {
        Ok(text.to_ascii_uppercase())
    } else {
        Err(Misread::value(text!("grammar-no-parameter", word = text)))
    }
}

fn message(text: &str) -> Result<u32, Misread> {
    if let Ok(id) = text.parse::<u32>() {
        return if id <= HIGHEST_MESSAGE {
            Ok(id)
        } else {
            Err(Misread::value(text!(
                "grammar-no-message-id",
                word = text,
                highest = HIGHEST_MESSAGE
            )))
        };
    }
    MavMessage::all_messages()
        .iter()
        .find(|(name, _)| name.eq_ignore_ascii_case(text))
        .map(|&(_, id)| id)
        .ok_or_else(|| Misread::kind(text!("grammar-no-message", word = text)))
}

fn command(text: &str) -> Result<u16, Misread> {
    if text.bytes().all(|byte| byte.is_ascii_digit()) {
        return text
            .parse()
            .map_err(|_| Misread::value(text!("grammar-no-mav-cmd-number", word = text)));
    }
    command_by_name(text).ok_or_else(|| Misread::kind(text!("grammar-no-mav-cmd", word = text)))
}
