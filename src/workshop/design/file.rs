//! Designs as TOML.

use std::borrow::Cow;
use std::fmt::Write as _;
use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::Design;
use crate::diagnostic::{Diagnostic, nearest, toml_value};
use crate::text;
use crate::workshop::catalogue::{part, parts_for};
use crate::workshop::part::PartSlot;

const SCHEMA: i64 = 1;
/// The key of the format's version.
const SCHEMA_KEY: &str = "schema";
/// The key of the design's name.
const NAME_KEY: &str = "name";
/// The maximum number of characters in a name.
const LONGEST_NAME: usize = 40;

/// Every fault of an invalid design file, with its position.
pub type DesignError = Vec<Diagnostic>;

/// A design file while it is being read.
#[derive(Default)]
struct DesignReading {
    schema: Option<Spanned<i64>>,
    name: Option<Spanned<String>>,
    parts: Vec<(PartSlot, Spanned<String>)>,
    /// The known keys that are in the file, also misspelt ones.
    meant: Vec<&'static str>,
    faults: DesignError,
}

impl DesignReading {
    fn of(source: &str) -> Result<Self, DesignError> {
        let root = DeTable::parse(source).map_err(|error| vec![Diagnostic::from_toml(&error)])?;
        let mut reading = Self::default();
        for (key, value) in root.into_inner() {
            reading.key(&key, value);
        }
        // Parts take their places in the order of the slots and, within a slot, of the file.
        reading.parts.sort_by_key(|(slot, part)| {
            (
                PartSlot::ALL.iter().position(|it| it == slot),
                part.span().start,
            )
        });
        Ok(reading)
    }

    fn key(&mut self, key: &Spanned<Cow<'_, str>>, value: Spanned<DeValue<'_>>) {
        let name = key.get_ref().as_ref();
        let slot = PartSlot::ALL.into_iter().find(|slot| slot.key() == name);
        match (name, slot) {
            (SCHEMA_KEY, _) => {
                self.meant.push(SCHEMA_KEY);
                self.schema = self.read(value);
            }
            (NAME_KEY, _) => {
                self.meant.push(NAME_KEY);
                self.name = self.read(value);
            }
            (_, Some(slot)) => self.slot(slot, value),
            (_, None) => {
                let fault = Diagnostic::new(key.span(), text!("fault-key-unknown", name = name));
                self.meant.extend(nearest(name, known_keys()));
                self.faults.push(fault.with_nearest(name, known_keys()));
            }
        }
    }

    fn slot(&mut self, slot: PartSlot, value: Spanned<DeValue<'_>>) {
        let place = value.span();
        let items = match value.into_inner() {
            DeValue::Array(items) if slot.room() > 1 => items.into_iter().collect(),
            _ if slot.room() > 1 => {
                let fault = text!("fault-list", name = slot.key());
                self.faults.push(Diagnostic::new(place, fault));
                return;
            }
            single => vec![Spanned::new(place, single)],
        };
        for item in items {
            let part = self.read(item);
            self.parts.extend(part.map(|part| (slot, part)));
        }
    }

    fn read<T: for<'i> Deserialize<'i>>(
        &mut self,
        value: Spanned<DeValue<'_>>,
    ) -> Option<Spanned<T>> {
        let place = value.span();
        match toml_value(value) {
            Ok(read) => Some(Spanned::new(place, read)),
            Err(fault) => {
                self.faults.push(fault);
                None
            }
        }
    }

    /// Adds a fault for a required key that is missing. One that is only misspelt is not missing, too.
    fn need(&mut self, key: &'static str) {
        if !self.meant.contains(&key) {
            let fault = text!("fault-key-missing", name = key);
            self.faults.push(Diagnostic::new(0..0, fault));
        }
    }
}

fn known_keys() -> impl Iterator<Item = &'static str> {
    let slots = PartSlot::ALL.into_iter().map(PartSlot::key);
    [SCHEMA_KEY, NAME_KEY].into_iter().chain(slots)
}

impl Design {
    /// Reads a design file.
    ///
    /// # Errors
    /// Every fault with its position: an error of the syntax, or all unknown keys, wrong types, an unknown schema, a part that does not exist or belongs in
    /// another slot, more parts than a slot takes.
    pub fn from_toml(source: &str) -> Result<Self, DesignError> {
        let mut reading = DesignReading::of(source)?;
        reading.need(SCHEMA_KEY);
        reading.need(NAME_KEY);
        let DesignReading {
            schema,
            name,
            parts,
            mut faults,
            ..
        } = reading;
        if let Some(schema) = schema.filter(|it| *it.get_ref() != SCHEMA) {
            let fault = text!("design-schema", found = *schema.get_ref(), known = SCHEMA);
            faults.push(Diagnostic::new(schema.span(), fault));
        }
        let mut design = Self::new("");
        if let Some(name) = name {
            design = Self::new(name.get_ref().trim());
            let checked = checked_name(&design.name);
            faults.extend(
                checked
                    .err()
                    .map(|fault| Diagnostic::new(name.span(), fault)),
            );
        }
        for (slot, id) in parts {
            match placed(&design, slot, &id) {
                Ok(changed) => design = changed,
                Err(fault) => faults.push(fault),
            }
        }
        faults.sort_by_key(|fault| fault.span.start);
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

#[cfg(test)]
mod tests {
    use super::*;

    fn faults(source: &str) -> Vec<String> {
        let faults = Design::from_toml(source).expect_err(source);
        let lines = faults.iter().map(|fault| fault.one_line("d.toml", source));
        lines.collect()
    }

    #[test]
    fn every_fault_of_a_design_is_found_at_once_with_the_nearest_name() {
        let source = "schema = 1\nnme = \"Lab\"\nframe = 3\nmotr = \"m2306_2450\"\npropeller = \"p5x4.5\"\n\
                      battery = \"b4s1300\"\nradio = [\"r_elrs24\"]\npayload = [\"s_rgb\", 3]\nesc = \"e4in1_3\"\n";
        assert_eq!(
            faults(source),
            [
                "d.toml:2:1: unknown key `nme` (did you mean `name`?)",
                "d.toml:3:9: expected text in quotes, not `3`",
                "d.toml:4:1: unknown key `motr` (did you mean `motor`?)",
                "d.toml:6:11: `battery` must be a list",
                "d.toml:7:9: expected text in quotes, not a list",
                "d.toml:8:21: expected text in quotes, not `3`",
                "d.toml:9:7: no part `e4in1_3` for the slot speed controllers (did you mean `e4in1_35`?)"
            ]
        );
    }

    #[test]
    fn a_missing_key_is_named_and_an_error_of_the_syntax_stands_alone() {
        assert_eq!(
            faults("schema = 2\n"),
            [
                "d.toml:1:1: missing field `name`",
                "d.toml:1:10: unknown schema 2: this version reads schema 1"
            ]
        );
        assert_eq!(
            faults("schema = = 1\nnme = 3\n"),
            ["d.toml:1:10: one `=` too many"]
        );
    }
}
