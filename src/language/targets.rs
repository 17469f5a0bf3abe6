//! The target vehicles of a line.

use std::fmt;

use super::Context;
use super::lexer::Word;
use crate::diagnostic::{Diagnostic, nearest};
use crate::text;
use crate::text::Text;
use crate::vehicle_id::{HIGHEST_VEHICLE, VehicleId, ranges};

/// The targets of a line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Targets {
    Selection,
    All,
    /// These vehicles, sorted, each once.
    Ids(Vec<VehicleId>),
    /// A named group, without the `@`.
    Group(String),
}

impl fmt::Display for Targets {
    /// Writes the targets in the notation of a line; nothing for the selection. Consecutive ids are
    /// joined.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Selection => Ok(()),
            Self::All => f.write_str("all"),
            Self::Group(name) => write!(f, "@{name}"),
            Self::Ids(ids) => f.write_str(&ranges(ids.iter().copied())),
        }
    }
}

impl Targets {
    /// The target vehicles.
    ///
    /// # Errors
    /// A text if there is no target: the selection is empty, or the group or a vehicle is unknown.
    pub fn resolve(
        &self,
        selection: &[VehicleId],
        context: &Context,
    ) -> Result<Vec<VehicleId>, Text> {
        let ids = match self {
            Self::Selection if selection.is_empty() => {
                return Err(text!("grammar-none-selected"));
            }
            Self::Selection => selection.to_vec(),
            Self::All if context.expected.is_empty() => context.vehicles.to_vec(),
            Self::All => {
                let expected = |id: &&VehicleId| context.expected.contains(id);
                context.vehicles.iter().filter(expected).copied().collect()
            }
            Self::Ids(ids) => {
                if let Some(&missing) = ids.iter().find(|&&id| !exists(id, context)) {
                    return Err(no_vehicle(missing, context));
                }
                ids.clone()
            }
            Self::Group(name) => context
                .groups
                .get(name)
                .ok_or_else(|| text!("grammar-no-group", group = name))?
                .clone(),
        };
        if ids.is_empty() {
            return Err(match self {
                Self::Group(name) => text!("grammar-group-empty", group = name),
                Self::All if !context.vehicles.is_empty() => none_expected(context),
                Self::Selection | Self::All | Self::Ids(_) => text!("grammar-no-vehicles-yet"),
            });
        }
        Ok(ids)
    }

    /// Reads a word such as `all`, `1-4,7` or `@red`.
    pub(super) fn read(word: &Word, context: &Context) -> Result<Self, Diagnostic> {
        if word.is("all") {
            return Ok(Self::All);
        }
        if let Some(name) = word.text.strip_prefix('@') {
            return if context.groups.contains_key(name) {
                Ok(Self::Group(name.to_owned()))
            } else {
                Err(unknown_group(name, word, context))
            };
        }
        let mut ids = Vec::new();
        let mut start = word.span.start;
        for part in word.text.split(',') {
            let span = start..start + part.len();
            ids.extend(range(part, context).map_err(|reason| Diagnostic::new(span, reason))?);
            start += part.len() + 1;
        }
        ids.sort_unstable();
        ids.dedup();
        Ok(Self::Ids(ids))
    }
}

/// Why `all` means no vehicle, although vehicles are heard.
fn none_expected(context: &Context) -> Text {
    text!(
        "grammar-none-expected",
        expected = ranges(context.expected.iter().copied()),
        heard = ranges(context.vehicles.iter().copied())
    )
}

fn unknown_group(name: &str, word: &Word, context: &Context) -> Diagnostic {
    let fault = Diagnostic::new(word.span.clone(), text!("grammar-no-group", group = name));
    let names = context.groups.keys().map(String::as_str);
    if let Some(near) = nearest(name, names.clone()) {
        fault.with_help(text!("grammar-did-you-mean", name = format!("@{near}")))
    } else if context.groups.is_empty() {
        fault.with_help(text!("grammar-no-groups"))
    } else {
        let known: Vec<String> = names.map(|name| format!("@{name}")).collect();
        fault.with_help(text!("grammar-there-are", names = known.join(", ")))
    }
}

/// The ids of `4` or `1-4`.
fn range(part: &str, context: &Context) -> Result<Vec<VehicleId>, Text> {
    if part.is_empty() {
        return Err(text!("grammar-empty-part"));
    }
    let (first, last) = match part.split_once('-') {
        Some((first, last)) => (id(first, part)?, id(last, part)?),
        None => (id(part, part)?, id(part, part)?),
    };
    if first > last {
        let turned = format!("{last}-{first}");
        return Err(text!("grammar-backwards", range = part, turned = turned));
    }
    match (first..=last).find(|&id| !exists(id, context)) {
        Some(missing) => Err(no_vehicle(missing, context)),
        None => Ok((first..=last).collect()),
    }
}

fn id(text: &str, part: &str) -> Result<VehicleId, Text> {
    if text.is_empty() || !text.bytes().all(|byte| byte.is_ascii_digit()) {
        return Err(text!("grammar-no-targets", word = part));
    }
    text.parse()
        .ok()
        .filter(|id| (1..=HIGHEST_VEHICLE).contains(id))
        .ok_or_else(|| {
            text!(
                "grammar-no-vehicle-number",
                word = text,
                highest = HIGHEST_VEHICLE
            )
        })
}

fn exists(id: VehicleId, context: &Context) -> bool {
    context.vehicles.is_empty() || context.vehicles.contains(&id)
}

fn no_vehicle(id: VehicleId, context: &Context) -> Text {
    let mut known = context.vehicles.to_vec();
    known.sort_unstable();
    text!(
        "grammar-no-vehicle",
        vehicle = id,
        known = Targets::Ids(known).to_string()
    )
}
