//! The keymap file: contexts with keys, each bound to an action's name or to a line of the command
//! language.
//!
//! ```toml
//! [anywhere]
//! "f5" = "all rtl"        # runs at once; a dangerous line still asks for confirmation
//! "f6" = "all takeoff ..." # opened in the command line, to be completed
//!
//! [fly]
//! "x" = "select-all"      # an action
//! "a" = false             # means nothing here
//! ```

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;

use crossterm::event::KeyCode;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::{Binding, Keymap, Meaning, Place, Press};
use crate::app::action::Action;
use crate::app::lines;
use crate::diagnostic::Diagnostic;
use crate::language::{Channel, VerbRow, rows};
use crate::text;

/// The ending of a line that the user must complete.
const OPEN_END: &str = " ...";

/// A row of a file: the meaning of a key in a context; `None` disables the key.
#[derive(Debug)]
struct FileRow {
    press: Press,
    place: Place,
    meaning: Option<Meaning>,
    key: Spanned<String>,
}

impl Keymap {
    /// Applies a keymap file to this keymap: a row replaces the key's meaning in its context. Valid rows apply even if
    /// others are invalid. `themes` are the valid theme names.
    ///
    /// # Errors
    /// Every fault, with its position.
    pub fn overlay(&mut self, source: &str, themes: &[String]) -> Result<(), Vec<Diagnostic>> {
        let mut reading = KeymapReading {
            source,
            themes,
            rows: Vec::new(),
            faults: Vec::new(),
        };
        let (table, errors) = DeTable::parse_recoverable(source);
        // Later syntax errors tend to follow from the first.
        let first = errors.first().map(Diagnostic::from_toml);
        reading.faults.extend(first);
        reading.contexts(table.into_inner());
        reading.shadows();
        let KeymapReading {
            rows, mut faults, ..
        } = reading;
        faults.sort_by_key(|fault| fault.span.start);
        self.lay(rows);
        if faults.is_empty() {
            Ok(())
        } else {
            Err(faults)
        }
    }

    fn lay(&mut self, rows: Vec<FileRow>) {
        let replaced = |binding: &Binding| {
            let mut rows = rows.iter();
            rows.any(|row| row.press == binding.press && row.place == binding.place)
        };
        let others = self.bindings.drain(..).filter(|binding| !replaced(binding));
        let kept: Vec<Binding> = others.collect();
        for FileRow {
            press,
            place,
            meaning,
            ..
        } in rows
        {
            match meaning {
                Some(meaning) => self.bindings.push(Binding {
                    press,
                    place,
                    meaning,
                }),
                None => self.silent.push((press, place)),
            }
        }
        // Arrows with Shift are arrows too: more specific keys go first, and the user's keys before families of keys.
        self.bindings
            .sort_by_key(|binding| !matches!(binding.press, Press::With(..)));
        self.bindings.extend(kept);
    }
}

/// The names of the contexts, in the order of the help.
pub(super) fn contexts() -> impl Iterator<Item = &'static str> {
    Place::all().map(Place::name)
}

struct KeymapReading<'a> {
    source: &'a str,
    themes: &'a [String],
    rows: Vec<FileRow>,
    faults: Vec<Diagnostic>,
}

impl KeymapReading<'_> {
    fn contexts(&mut self, table: DeTable<'_>) {
        for (name, value) in table {
            let place = Place::all().find(|place| place.name() == name.get_ref());
            let Some(place) = place else {
                let text = text!("keymap-no-context", name = name.get_ref().as_ref());
                let fault = Diagnostic::new(name.span(), text);
                self.faults
                    .push(fault.with_nearest(name.get_ref(), contexts()));
                continue;
            };
            let span = value.span();
            if let DeValue::Table(keys) = value.into_inner() {
                self.keys(place, keys);
            } else {
                let text = text!("keymap-context", name = place.name());
                self.faults.push(Diagnostic::new(span, text));
            }
        }
    }

    fn keys(&mut self, place: Place, keys: DeTable<'_>) {
        // In file order, so that the later of two identical rows counts as the duplicate.
        let keys: BTreeMap<usize, _> = keys
            .into_iter()
            .map(|(key, value)| (key.span().start, (key, value)))
            .collect();
        for (key, value) in keys.into_values() {
            // After an error of the syntax, the reader puts a stand-in elsewhere; the error is enough.
            let is_table = matches!(value.get_ref(), DeValue::Table(_));
            if !is_table && value.span().start < key.span().start {
                continue;
            }
            let key = Spanned::new(key.span(), key.get_ref().to_string());
            match self.row(place, key, &value) {
                Ok(row) => self.rows.push(row),
                Err(fault) => self.faults.push(fault),
            }
        }
    }

    fn row(
        &self,
        place: Place,
        key: Spanned<String>,
        value: &Spanned<DeValue<'_>>,
    ) -> Result<FileRow, Diagnostic> {
        let fault = |text| Diagnostic::new(key.span(), text);
        let press = Press::read(key.get_ref()).map_err(fault)?;
        let mut rows = self.rows.iter();
        if let Some(first) = rows.find(|row| row.press == press && row.place == place) {
            let line = self.line(first.key.span());
            let name = key.get_ref().as_str();
            return Err(fault(text!("keymap-twice", key = name, line = line)));
        }
        let span = value.span();
        if matches!(value.get_ref(), DeValue::Table(_)) {
            return Err(fault(text!("keymap-meaning")));
        }
        let meaning = meaning(value, self.themes)?;
        let is_room = matches!(place, Place::Anywhere | Place::In(_));
        if let (Some(Meaning::Give(_) | Meaning::Write(_)), false) = (&meaning, is_room) {
            let text = text!("keymap-only-actions", name = place.name());
            return Err(Diagnostic::new(span, text));
        }
        if let (Press::Plain(KeyCode::Char(_)), Place::Prompt) = (press, place) {
            let name = key.get_ref().as_str();
            return Err(fault(text!("keymap-is-text", key = name)));
        }
        Ok(FileRow {
            press,
            place,
            meaning,
            key,
        })
    }

    /// Reports a room's key that the same file also binds under `anywhere`; disabling a key in a room is allowed.
    fn shadows(&mut self) {
        let general = |row: &&FileRow| row.place == Place::Anywhere && row.meaning.is_some();
        for row in &self.rows {
            if !matches!(row.place, Place::In(_)) || row.meaning.is_none() {
                continue;
            }
            let mut others = self.rows.iter().filter(general);
            if let Some(other) = others.find(|other| other.press == row.press) {
                let line = self.line(other.key.span());
                let name = row.key.get_ref().as_str();
                let text = text!("keymap-shadows", key = name, line = line);
                let advice = text!("keymap-shadows-advice");
                let fault = Diagnostic::new(row.key.span(), text).with_help(advice);
                self.faults.push(fault);
            }
        }
    }

    fn line(&self, span: Range<usize>) -> usize {
        Diagnostic::new(span, "").line_column(self.source).0
    }
}

/// The meaning of a key's value in the file: an action or a line; `None` for `false` or an empty
/// text, which leaves the key without one.
fn meaning(value: &Spanned<DeValue<'_>>, themes: &[String]) -> Result<Option<Meaning>, Diagnostic> {
    let span = value.span();
    let line = match value.get_ref() {
        DeValue::Boolean(false) => return Ok(None),
        DeValue::String(line) => line.trim(),
        _ => return Err(Diagnostic::new(span, text!("keymap-meaning"))),
    };
    if line.is_empty() {
        return Ok(None);
    }
    if let Some(action) = Action::named(line) {
        return Ok(Some(Meaning::Do(action)));
    }
    let owned = |line: &str| Cow::Owned(line.to_owned());
    let in_file = |fault: Diagnostic| fault.in_string(span.clone(), line.len());
    if let Some(beginning) = line
        .strip_suffix(OPEN_END.trim_start())
        .filter(|it| it.is_empty() || it.ends_with(' '))
    {
        lines::check_beginning(beginning.trim_end()).map_err(in_file)?;
        return Ok(Some(Meaning::Write(owned(beginning))));
    }
    lines::check(line, themes).map_err(|fault| {
        if line.contains(char::is_whitespace) {
            return in_file(fault);
        }
        // A single word may be meant as an action or as a line.
        let actions = Action::all().map(Action::name);
        let screen_rows = rows().filter(|row| row.scope.includes(Channel::Screen));
        let commands = screen_rows.map(VerbRow::name);
        let text = text!("keymap-no-action", name = line);
        Diagnostic::new(span.clone(), text).with_nearest(line, actions.chain(commands))
    })?;
    Ok(Some(Meaning::Give(owned(line))))
}

#[cfg(test)]
mod tests;
