//! Combines defaults, file, environment and flags.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;

use serde::Deserialize as _;
use toml::de::{DeTable, DeValue, ValueDeserializer};
use toml::{Spanned, Table, Value};

use super::{Config, SETTINGS, Setting, SettingKind};
use crate::diagnostic::Diagnostic;
use crate::text;
use crate::text::Text;

/// Checks a word or line of a file, given its setting's name. The caller provides it, since the valid themes and
/// commands are not known here.
pub type WordCheck<'a> = &'a dyn Fn(&str, &str) -> Result<(), Diagnostic>;

/// The source of a value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Origin {
    /// Not set anywhere: the default.
    Default,
    File {
        name: String,
        /// The line in the file, from 1.
        line: usize,
        /// The position of the value in the file, in bytes.
        span: Range<usize>,
    },
    Environment(&'static str),
    /// A flag of the command line.
    Flag(&'static str),
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Default => f.write_str("default"),
            Self::File { name, line, .. } => write!(f, "{name}:{line}"),
            Self::Environment(variable) => write!(f, "environment {variable}"),
            Self::Flag(flag) => write!(f, "flag {flag}"),
        }
    }
}

/// The values so far. Later layers take precedence; a layer leaves settings that it does not contain as they are.
#[derive(Debug, Clone, PartialEq)]
pub struct Layers {
    values: BTreeMap<String, (Value, Origin)>,
}

impl Default for Layers {
    fn default() -> Self {
        let defaults = Table::try_from(Config::default()).unwrap_or_default();
        let mut layers = Self {
            values: BTreeMap::new(),
        };
        for setting in SETTINGS.iter().filter(|it| it.kind != SettingKind::Lines) {
            if let Some(value) = found(&defaults, setting) {
                layers.set(setting.name, value.clone(), Origin::Default);
            }
        }
        layers
    }
}

impl Layers {
    /// Adds a configuration file. Valid entries apply even if others have faults.
    ///
    /// # Errors
    /// Every fault, at its place.
    pub fn file(
        &mut self,
        name: &str,
        source: &str,
        check: WordCheck<'_>,
    ) -> Result<(), Vec<Diagnostic>> {
        let mut faults = Vec::new();
        let (table, errors) = DeTable::parse_recoverable(source);
        // Of several syntax errors, the later ones usually follow from the first.
        faults.extend(errors.first().map(Diagnostic::from_toml));
        let mut reading = LayerReading {
            name,
            source,
            check,
            layers: self,
            faults,
        };
        reading.table("", table.into_inner());
        reading.faults.sort_by_key(|fault| fault.span.start);
        if reading.faults.is_empty() {
            Ok(())
        } else {
            Err(reading.faults)
        }
    }

    /// Applies the environment; an empty variable counts as not set.
    ///
    /// # Errors
    /// The fault of each variable that is left out.
    pub fn environment(
        &mut self,
        variable: impl Fn(&str) -> Option<String>,
    ) -> Result<(), Vec<Text>> {
        let mut faults = Vec::new();
        for setting in SETTINGS {
            let Some(name) = setting.variable else {
                continue;
            };
            if let Some(word) = variable(name).filter(|word| !word.is_empty()) {
                let set = self.word(setting, name, Origin::Environment(name), &word);
                faults.extend(set.err());
            }
        }
        if faults.is_empty() {
            Ok(())
        } else {
            Err(faults)
        }
    }

    /// Applies a flag of the command line to a setting.
    ///
    /// # Errors
    /// The fault of its value.
    pub fn flag(&mut self, setting: &str, flag: &'static str, word: &str) -> Result<(), Text> {
        match Setting::named(setting) {
            Some(setting) => self.word(setting, flag, Origin::Flag(flag), word),
            None => Ok(()),
        }
    }

    /// Sets a default that follows from another variable, unless the setting has a value.
    pub fn follow(&mut self, setting: &str, variable: &'static str, word: &str) {
        if !self.values.contains_key(setting) {
            let value = Value::String(word.to_owned());
            self.set(setting, value, Origin::Environment(variable));
        }
    }

    pub fn config(&self) -> Config {
        let mut table = Table::new();
        for (name, (value, _)) in &self.values {
            match name.split_once('.') {
                Some((section, key)) => {
                    let section = table
                        .entry(section)
                        .or_insert_with(|| Value::Table(Table::new()));
                    if let Value::Table(section) = section {
                        section.insert(key.to_owned(), value.clone());
                    }
                }
                None => drop(table.insert(name.clone(), value.clone())),
            }
        }
        // Each value has been checked before it was applied; a test does so for the table of settings.
        Config::deserialize(Value::Table(table)).unwrap_or_default()
    }

    /// The source of a setting's value.
    pub fn origin(&self, setting: &str) -> &Origin {
        self.values
            .get(setting)
            .map_or(&Origin::Default, |(_, origin)| origin)
    }

    /// The value of a setting, if it has one.
    pub(super) fn value(&self, setting: &str) -> Option<&Value> {
        self.values.get(setting).map(|(value, _)| value)
    }

    /// The names of the values in a section.
    pub(super) fn names_in(&self, section: &str) -> impl Iterator<Item = &str> {
        let prefix = format!("{section}.");
        let names = self.values.keys().map(String::as_str);
        names.filter(move |name| name.starts_with(&prefix))
    }

    fn word(
        &mut self,
        setting: &Setting,
        written: &str,
        origin: Origin,
        word: &str,
    ) -> Result<(), Text> {
        let value = setting.kind.read(word).ok_or_else(|| {
            let expected = setting.kind.expected();
            text!(
                "config-wrong-word",
                name = written,
                expected = expected,
                word = word
            )
        })?;
        self.set(setting.name, value, origin);
        Ok(())
    }

    fn set(&mut self, name: &str, value: Value, origin: Origin) {
        self.values.insert(name.to_owned(), (value, origin));
    }
}

/// The value of a setting in a table that contains all sections.
fn found<'a>(table: &'a Table, setting: &Setting) -> Option<&'a Value> {
    match setting.name.split_once('.') {
        Some((section, key)) => table.get(section)?.get(key),
        None => table.get(setting.name),
    }
}

struct LayerReading<'a> {
    name: &'a str,
    source: &'a str,
    check: WordCheck<'a>,
    layers: &'a mut Layers,
    faults: Vec<Diagnostic>,
}

impl LayerReading<'_> {
    fn table(&mut self, section: &str, table: DeTable<'_>) {
        for (key, value) in table {
            let name = match section {
                "" => key.get_ref().to_string(),
                section => format!("{section}.{}", key.get_ref()),
            };
            let is_known = SETTINGS.iter().any(|setting| setting.section() == name);
            let is_section = is_known && !name.is_empty();
            // A quoted name with a dot is not a setting.
            let setting = match section {
                "macros" => Setting::named(section),
                _ => Setting::named(&name).filter(|it| it.key() == key.get_ref()),
            };
            if is_section {
                let span = value.span();
                match value.into_inner() {
                    DeValue::Table(inner) => self.table(&name, inner),
                    _ => self.fault(span, text!("config-section", name = name)),
                }
            } else if let Some(setting) = setting {
                self.setting(setting, &name, key.span(), value);
            } else {
                let siblings = SETTINGS.iter().filter_map(|setting| match section {
                    "" if setting.section().is_empty() => Some(setting.name),
                    "" => Some(setting.section()),
                    _ => (setting.section() == section).then(|| setting.key()),
                });
                let fault = Diagnostic::new(key.span(), text!("config-unknown", name = name));
                self.faults
                    .push(fault.with_nearest(key.get_ref(), siblings));
            }
        }
    }

    /// Sets the value of a setting; the value of a macro is stored under the macro's name.
    fn setting(
        &mut self,
        setting: &Setting,
        name: &str,
        key: Range<usize>,
        value: Spanned<DeValue<'_>>,
    ) {
        let span = match value.get_ref() {
            DeValue::Table(_) => key,
            _ => value.span(),
        };
        let words = words(&value);
        let Some(mut value) = plain(value) else {
            return;
        };
        if let Err(fault) = setting.kind.check(&value) {
            return self.wrong(name, span, fault);
        }
        for word in &words {
            let named = setting.kind.check_word(word.get_ref());
            if let Err(fault) = named.and_then(|()| (self.check)(setting.name, word.get_ref())) {
                let fault = fault.in_string(word.span(), word.get_ref().len());
                return self.faults.push(fault);
            }
        }
        if setting.kind == SettingKind::Lines {
            // A single line counts as a list of one.
            let lines = words.into_iter().map(Spanned::into_inner);
            value = Value::Array(lines.map(Value::String).collect());
        }
        self.set(name, span, value);
    }

    fn set(&mut self, name: &str, span: Range<usize>, value: Value) {
        let (line, _) = Diagnostic::new(span.clone(), "").line_column(self.source);
        let name_of_file = self.name.to_owned();
        let origin = Origin::File {
            name: name_of_file,
            line,
            span,
        };
        self.layers.set(name, value, origin);
    }

    fn wrong(&mut self, name: &str, span: Range<usize>, fault: Diagnostic) {
        let message = text!("config-wrong", name = name, expected = fault.message);
        self.faults.push(Diagnostic {
            span,
            message,
            help: fault.help,
        });
    }

    fn fault(&mut self, span: Range<usize>, message: Text) {
        self.faults.push(Diagnostic::new(span, message));
    }
}

/// The texts of a value: the value itself, or the items of its list.
fn words(value: &Spanned<DeValue<'_>>) -> Vec<Spanned<String>> {
    let word = |word: &Spanned<DeValue<'_>>| {
        let text = word.get_ref().as_str()?;
        Some(Spanned::new(word.span(), text.to_owned()))
    };
    match value.get_ref() {
        DeValue::Array(list) => list.iter().filter_map(word).collect(),
        _ => word(value).into_iter().collect(),
    }
}

/// A value without positions; `None` if a syntax error, which has been reported, left no value.
fn plain(value: Spanned<DeValue<'_>>) -> Option<Value> {
    Value::deserialize(ValueDeserializer::from(value)).ok()
}
