//! The words that completion offers for a kind of value.

use mavlink::dialects::ardupilotmega::MavMessage;

use super::super::Context;
use super::super::argument::{Kind, Unit};
use super::super::modes::{mode_names, mode_summary};
use super::super::names::{Listed, NameList};
use super::super::targets::Targets;
use crate::commands::command_names;
use crate::config::Column;
use crate::parameters::{ParameterList, shown};
use crate::plan::field;
use crate::text;
use crate::text::Text;

impl Kind {
    /// The words that are possible for this kind of value, with their meaning.
    pub(in crate::language) fn names(self, context: &Context) -> Vec<(String, Text)> {
        match self {
            Self::Choice(choices) => unexplained(choices).collect(),
            Self::Mode => modes(context),
            Self::Point => places(context),
            Self::Area => {
                let areas = context.areas.into_iter().flatten();
                areas
                    .map(|(name, _)| (name.clone(), text!("grammar-area")))
                    .collect()
            }
            Self::Message => MavMessage::all_messages()
                .iter()
                .map(|(name, id)| ((*name).to_owned(), text!("grammar-message", id = *id)))
                .collect(),
            Self::MavCommand => mav_commands(),
            Self::Parameter => parameters(context),
            Self::Name(list) | Self::Proposed(list) => listed(list, context),
            Self::Group => context
                .groups
                .iter()
                .map(|(name, ids)| (name.clone(), Targets::Ids(ids.clone()).to_string().into()))
                .collect(),
            Self::Sort => {
                let falling = Column::NAMES
                    .iter()
                    .map(|name| (format!("-{name}"), text!("grammar-largest-first")));
                unexplained(Column::NAMES).chain(falling).collect()
            }
            Self::PlanCommand => field::plan_words()
                .map(|(word, name)| (word.to_owned(), Text::verbatim(name)))
                .collect(),
            Self::PlanField => plan_fields(context),
            Self::PlanFile => listed(NameList::PlanFile, context),
            Self::Flag
            | Self::Number(..)
            | Self::Whole(..)
            | Self::Vehicles
            | Self::Items
            | Self::Fields
            | Self::Rest => Vec::new(),
        }
    }
}

fn listed(list: NameList, context: &Context) -> Vec<(String, Text)> {
    let listed = context.names.listed(list).names().into_iter();
    listed.map(|named| (named.name, named.meaning)).collect()
}

/// The parameters of the current item with their values, otherwise all parameters with their units.
fn plan_fields(context: &Context) -> Vec<(String, Text)> {
    match context.names.listed(NameList::ItemField) {
        Listed::Anything => field::field_names()
            .map(|(name, unit)| (name.to_owned(), Unit::of_field(unit).symbol().into()))
            .collect(),
        Listed::Names(_) | Listed::Nothing(_) => listed(NameList::ItemField, context),
    }
}

fn unexplained<'a>(words: &'a [&'a str]) -> impl Iterator<Item = (String, Text)> {
    words
        .iter()
        .map(|word| ((*word).to_owned(), Text::default()))
}

fn modes(context: &Context) -> Vec<(String, Text)> {
    let explained = |name: &str| (name.to_owned(), mode_summary(name, context));
    mode_names(context).into_iter().map(explained).collect()
}

fn places(context: &Context) -> Vec<(String, Text)> {
    let places = context.places.into_iter().flatten();
    let explained = places.map(|(name, at)| {
        let degrees = format!("{:.6} {:.6}", at.lat_deg, at.lon_deg);
        (name.clone(), degrees.into())
    });
    explained.collect()
}

fn mav_commands() -> Vec<(String, Text)> {
    let explained = |(number, name): &(u16, &str)| {
        let hint = text!("grammar-mav-command", number = *number);
        ((*name).to_owned(), hint)
    };
    command_names().iter().map(explained).collect()
}

fn parameters(context: &Context) -> Vec<(String, Text)> {
    let known = context.parameters.into_iter().flat_map(ParameterList::iter);
    let meaning = |name: &str, value: f64| {
        let about = context.names.about_parameter(name, value);
        Text::verbatim(format!("= {} {about}", shown(value)).trim_end())
    };
    known
        .map(|(name, known)| (name.to_owned(), meaning(name, known.value)))
        .collect()
}
