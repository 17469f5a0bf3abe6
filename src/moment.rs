//! Moments of a flight that are worth coming back to.

use std::time::Duration;

use strum::{EnumIter, EnumString, IntoStaticStr, VariantNames};

use crate::pilot_in_command::Person;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// A moment worth coming back to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Moment {
    /// Its time, from the beginning of the record.
    pub at: Duration,
    /// The vehicles concerned; empty if it concerns the whole flight.
    pub vehicles: Vec<VehicleId>,
    pub kind: MomentKind,
    /// Who gave the command that it is about; `None` for the user of the console, and for moments of another kind.
    pub by: Option<Person>,
    /// The event in a few words.
    pub text: Text,
}

impl Moment {
    /// The event, after the name of the person who gave the command.
    pub fn said(&self) -> Text {
        Person::said(self.by.as_ref(), self.text.clone())
    }
}

/// The kind of a moment. The names are those of the command line.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    EnumIter,
    EnumString,
    IntoStaticStr,
    VariantNames,
)]
#[strum(serialize_all = "kebab-case")]
pub enum MomentKind {
    /// The operator set a bookmark.
    Bookmark,
    /// A vehicle refused a command, or a command had no effect.
    Refusal,
    /// A command was not sent, because another person flies the vehicle. This costs no points.
    Barred,
    /// An alert of a vehicle began.
    Alert,
    /// A vehicle changed its mode.
    Mode,
    /// A vehicle was armed or disarmed.
    Arming,
    /// An objective of the mission was reached or missed.
    Objective,
    /// A safety rule of the mission was broken.
    Rule,
    /// An event of the mission, or an inject of the instructor, changed something; or a command with a risk was given.
    Event,
    /// Two flying vehicles came close to each other, or were at their closest in the whole flight.
    Separation,
    /// An event in a vehicle's log that was joined to the record.
    Log,
}

impl MomentKind {
    /// The names of all kinds.
    pub const NAMES: &'static [&'static str] = Self::VARIANTS;

    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Its name on the screen.
    pub fn text(self) -> Text {
        Text::new(format!("moment-kind-{}", self.name()), Vec::new())
    }

    /// Whether a review lists it: events of logs, and changes of mode and arming, which happen in
    /// every flight, are left out.
    pub fn is_reviewed(self) -> bool {
        match self {
            Self::Mode | Self::Arming | Self::Log => false,
            Self::Bookmark
            | Self::Refusal
            | Self::Barred
            | Self::Alert
            | Self::Objective
            | Self::Rule
            | Self::Event
            | Self::Separation => true,
        }
    }

    /// Its importance compared with that of other kinds: higher is more important.
    pub fn weight(self) -> u8 {
        match self {
            Self::Mode | Self::Arming => 0,
            Self::Event | Self::Log | Self::Barred => 1,
            Self::Objective => 2,
            Self::Refusal | Self::Separation => 3,
            Self::Alert | Self::Rule => 4,
            Self::Bookmark => 5,
        }
    }

    /// The kind with this name, if any.
    pub fn named(name: &str) -> Option<Self> {
        name.parse().ok()
    }
}

/// The event by which the times of two flights are aligned. The names are those of the command line.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, EnumString, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Alignment {
    /// The beginning of the mission.
    #[default]
    Start,
    /// The takeoff of the first vehicle.
    Takeoff,
    /// The first objective that was reached.
    Objective,
    /// The first alert of the mission.
    Alert,
    /// The first command that was refused.
    Refusal,
    /// The first bookmark with the same text in both flights, otherwise the first bookmark of each.
    Bookmark,
}

impl Alignment {
    /// The names of all alignments, as in commands and files.
    pub const NAMES: &'static [&'static str] = Self::VARIANTS;

    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The alignment with this name, if any.
    pub fn named(name: &str) -> Option<Self> {
        name.parse().ok()
    }

    /// Its name on the screen.
    pub fn text(self) -> Text {
        Text::new(format!("alignment-{}", self.name()), Vec::new())
    }
}
