//! `apm.pdef.json` of ArduPilot: parameters by group and name; `parameters.json` of PX4: a list of parameters.

use serde_json::{Map, Value};

use super::{
    DocumentedRange, NamedBit, NamedValue, ParameterDocument, ReadDocuments, bit_number, plain,
};
use crate::diagnostic::Diagnostic;
use crate::text;
use crate::text::Text;

type Fields = Map<String, Value>;

pub(super) fn read(source: &str) -> ReadDocuments {
    let mut found = ReadDocuments::default();
    let content = source.trim_start_matches('\u{feff}');
    let root: Fields = match serde_json::from_str(content) {
        Ok(root) => root,
        Err(error) => {
            let at = source.len() - content.len() + offset(content, error.line(), error.column());
            let said = text!("documentation-json", fault = error.to_string());
            found.faults.push(Diagnostic::new(at..at, said));
            return found;
        }
    };
    let all = match root.get("parameters") {
        Some(Value::Array(list)) => of_px4(list),
        _ => of_ardupilot(&root),
    };
    for (name, document) in all {
        let (document, faults) = document.finished();
        let place = place(source, &name);
        let placed = faults
            .into_iter()
            .map(|it| Diagnostic::new(place.clone(), it));
        found.faults.extend(placed);
        found.documents.add(&name, document);
    }
    if found.documents.is_empty() && found.faults.is_empty() {
        let fault = Diagnostic::new(0..0, text!("documentation-nothing"));
        found.faults.push(fault);
    }
    found
}

/// The offset of a line and column as `serde_json` counts them: from 1, in bytes.
fn offset(text: &str, line: usize, column: usize) -> usize {
    let before = text.split_inclusive('\n').take(line.saturating_sub(1));
    let start: usize = before.map(str::len).sum();
    (start + column.saturating_sub(1)).min(text.len())
}

/// The place of a parameter's name in the file.
fn place(text: &str, name: &str) -> std::ops::Range<usize> {
    let quoted = format!("\"{name}\"");
    let start = text.find(&quoted).unwrap_or(0);
    start..(start + quoted.len()).min(text.len())
}

/// A documentation with the faults found so far.
#[derive(Default)]
struct Draft {
    document: ParameterDocument,
    faults: Vec<Text>,
}

impl Draft {
    fn finished(self) -> (ParameterDocument, Vec<Text>) {
        (self.document, self.faults)
    }

    /// A number, which ArduPilot writes as a string; `None` if it is missing or has a fault.
    fn number(&mut self, value: Option<&Value>) -> Option<f64> {
        let value = value?;
        let number = match value {
            Value::Number(number) => number.as_f64(),
            Value::String(written) => written.trim().parse().ok(),
            Value::Null | Value::Bool(_) | Value::Array(_) | Value::Object(_) => None,
        };
        let finite = number.filter(|number| number.is_finite());
        if finite.is_none() {
            self.faults
                .push(text!("parameters-no-number", value = written(value)));
        }
        finite
    }

    fn value(&mut self, value: &Value, name: &Value) {
        if let Some(value) = self.number(Some(value)) {
            let name = plain(&written(name));
            self.document.values.push(NamedValue { value, name });
        }
    }

    fn bit(&mut self, bit: &str, name: &Value) {
        match bit_number(bit) {
            Some(bit) => {
                let name = plain(&written(name));
                self.document.bits.push(NamedBit { bit, name });
            }
            None => self
                .faults
                .push(text!("documentation-no-bit", written = bit)),
        }
    }

    /// Sets the range; a missing limit is infinite.
    fn range(&mut self, least: Option<&Value>, most: Option<&Value>) {
        if least.is_none() && most.is_none() {
            return;
        }
        let (low, high) = (self.number(least), self.number(most));
        let low = low.unwrap_or(f64::NEG_INFINITY);
        let high = high.unwrap_or(f64::INFINITY);
        self.document.range = DocumentedRange::new(low, high);
        if low > high {
            let range = format!("{low} {high}");
            self.faults
                .push(text!("documentation-no-range", written = range));
        }
    }
}

/// A value as text: strings without quotes.
fn written(value: &Value) -> String {
    value
        .as_str()
        .map_or_else(|| value.to_string(), str::to_owned)
}

fn words(fields: &Fields, key: &str) -> String {
    fields
        .get(key)
        .map(|it| plain(&written(it)))
        .unwrap_or_default()
}

fn of_ardupilot(root: &Fields) -> Vec<(String, Draft)> {
    let groups = root.values().filter_map(Value::as_object);
    let all = groups.flatten().filter_map(|(name, fields)| {
        let own = name.rsplit(':').next().unwrap_or_default();
        Some((own.to_owned(), ardupilot(fields.as_object()?)))
    });
    all.collect()
}

fn ardupilot(fields: &Fields) -> Draft {
    let mut draft = Draft {
        document: ParameterDocument {
            title: words(fields, "DisplayName"),
            description: words(fields, "Description"),
            unit: words(fields, "Units"),
            needs_reboot: words(fields, "RebootRequired").eq_ignore_ascii_case("true"),
            ..ParameterDocument::default()
        },
        faults: Vec::new(),
    };
    draft.document.increment = draft.number(fields.get("Increment"));
    let range = fields.get("Range");
    draft.range(
        range.and_then(|range| range.get("low")),
        range.and_then(|range| range.get("high")),
    );
    let named = |key: &str| {
        fields
            .get(key)
            .and_then(Value::as_object)
            .into_iter()
            .flatten()
    };
    for (code, name) in named("Values") {
        draft.value(&Value::String(code.clone()), name);
    }
    for (bit, name) in named("Bitmask") {
        draft.bit(bit, name);
    }
    draft
}

fn of_px4(list: &[Value]) -> Vec<(String, Draft)> {
    let all = list.iter().filter_map(|parameter| {
        let fields = parameter.as_object()?;
        let name = fields.get("name")?.as_str()?;
        Some((name.to_owned(), px4(fields)))
    });
    all.collect()
}

fn px4(fields: &Fields) -> Draft {
    let is_true = |key: &str| fields.get(key).and_then(Value::as_bool).unwrap_or(false);
    let mut draft = Draft {
        document: ParameterDocument {
            title: words(fields, "shortDesc"),
            description: words(fields, "longDesc"),
            unit: words(fields, "units"),
            needs_reboot: is_true("rebootRequired"),
            ..ParameterDocument::default()
        },
        faults: Vec::new(),
    };
    draft.document.increment = draft.number(fields.get("increment"));
    draft.range(fields.get("min"), fields.get("max"));
    let listed = |key: &str| {
        fields
            .get(key)
            .and_then(Value::as_array)
            .into_iter()
            .flatten()
    };
    for entry in listed("values") {
        if let (Some(value), Some(name)) = (entry.get("value"), entry.get("description")) {
            draft.value(value, name);
        }
    }
    for entry in listed("bitmask") {
        if let (Some(bit), Some(name)) = (entry.get("index"), entry.get("description")) {
            draft.bit(&bit.to_string(), name);
        }
    }
    draft
}
