//! Designs as TOML.

use std::fmt::Write as _;
use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;

use super::Design;
use crate::diagnostic::Diagnostic;
use crate::text;
use crate::workshop::catalogue::{part, parts_for};
use crate::workshop::part::PartSlot;

const SCHEMA: i64 = 1;
/// The maximum number of characters in a name.
const LONGEST_NAME: usize = 40;

/// Every fault of an invalid design file, with its position.
pub type DesignError = Vec<Diagnostic>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct DesignFile {
    schema: Spanned<i64>,
    name: Spanned<String>,
    frame: Option<Spanned<String>>,
    motor: Option<Spanned<String>>,
    propeller: Option<Spanned<String>>,
    esc: Option<Spanned<String>>,
    #[serde(default)]
    battery: Vec<Spanned<String>>,
    autopilot: Option<Spanned<String>>,
    navigation: Option<Spanned<String>>,
    power: Option<Spanned<String>>,
    radio: Option<Spanned<String>>,
    #[serde(default)]
    payload: Vec<Spanned<String>>,
}

impl DesignFile {
    fn slots(self) -> [(PartSlot, Vec<Spanned<String>>); 10] {
        let one = |part: Option<Spanned<String>>| part.into_iter().collect();
        [
            (PartSlot::Frame, one(self.frame)),
            (PartSlot::Motor, one(self.motor)),
            (PartSlot::Propeller, one(self.propeller)),
            (PartSlot::Esc, one(self.esc)),
            (PartSlot::Battery, self.battery),
            (PartSlot::Autopilot, one(self.autopilot)),
            (PartSlot::Navigation, one(self.navigation)),
            (PartSlot::Power, one(self.power)),
            (PartSlot::Radio, one(self.radio)),
            (PartSlot::Payload, self.payload),
        ]
    }
}

impl Design {
    /// Reads a design file.
    ///
    /// # Errors
    /// Every fault with its position: a syntax error, an unknown schema, a part that does not exist or belongs in
    /// another slot, more parts than a slot takes.
    pub fn from_toml(source: &str) -> Result<Self, DesignError> {
        let file: DesignFile =
            toml::from_str(source).map_err(|error| vec![Diagnostic::from_toml(&error)])?;
        let mut faults = Vec::new();
        if *file.schema.get_ref() != SCHEMA {
            let fault = text!(
                "design-schema",
                found = *file.schema.get_ref(),
                known = SCHEMA
            );
            faults.push(Diagnostic::new(file.schema.span(), fault));
        }
        let name = file.name.get_ref().trim();
        if let Err(fault) = checked_name(name) {
            faults.push(Diagnostic::new(file.name.span(), fault));
        }
        let mut design = Self::new(name);
        for (slot, ids) in file.slots() {
            for id in ids {
                match placed(&design, slot, &id) {
                    Ok(changed) => design = changed,
                    Err(fault) => faults.push(fault),
                }
            }
        }
        if faults.is_empty() {
            Ok(design)
        } else {
            Err(faults)
        }
    }

    /// This design as a file.
    pub fn to_toml(&self) -> String {
        let mut file = format!("schema = {SCHEMA}\nname = {}\n", quoted(&self.name));
        for slot in PartSlot::ALL {
            let ids: Vec<String> = self
                .in_slot(slot)
                .iter()
                .map(|part| quoted(part.id))
                .collect();
            let value = match ids.as_slice() {
                [] => continue,
                [id] if slot.room() == 1 => id.clone(),
                ids => format!("[{}]", ids.join(", ")),
            };
            // Writing to a String cannot fail.
            let _ = writeln!(file, "{} = {value}", slot.key());
        }
        file
    }
}

/// Checks that a name is valid for a design: not empty, one line, and short enough for a table.
pub(super) fn checked_name(name: &str) -> Result<(), crate::text::Text> {
    let is_fine = !name.is_empty()
        && name.chars().count() <= LONGEST_NAME
        && !name.chars().any(char::is_control);
    if is_fine {
        Ok(())
    } else {
        Err(text!("design-name", most = LONGEST_NAME))
    }
}

/// A design with one more part, as listed in a file.
fn placed(design: &Design, slot: PartSlot, id: &Spanned<String>) -> Result<Design, Diagnostic> {
    let (name, span): (&str, Range<usize>) = (id.get_ref(), id.span());
    let Some(part) = part(name) else {
        let fault = text!("design-part", part = name, slot = slot.name());
        return Err(
            Diagnostic::new(span, fault).with_nearest(name, parts_for(slot).map(|part| part.id))
        );
    };
    if part.slot() != slot {
        let fault = text!(
            "design-slot",
            part = name,
            slot = slot.key(),
            other = part.slot().key()
        );
        return Err(Diagnostic::new(span, fault));
    }
    let there = design.in_slot(slot);
    if slot == PartSlot::Battery && there.iter().any(|other| other.id != part.id) {
        return Err(Diagnostic::new(span, text!("design-batteries")));
    }
    let changed = design.with(part);
    if changed.in_slot(slot).len() == there.len() {
        let fault = text!(
            "design-full",
            part = name,
            slot = slot.key(),
            most = slot.room()
        );
        return Err(Diagnostic::new(span, fault));
    }
    Ok(changed)
}

fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}
