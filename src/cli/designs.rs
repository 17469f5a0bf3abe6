//! The drones that somebody built, as `run` and `fly` take them.

use clap::Args;

use super::Failure;
use crate::mission::Mission;
use crate::store;
use crate::text::{Locale, Text};
use crate::workshop::Design;

/// Options of commands that fly a mission.
#[derive(Debug, Clone, Default, Args)]
pub(super) struct DesignArguments {
    /// A drone of the workshop that flies the mission: a design file, or the name of a design. Give one for all seats, or
    /// one for each, the last one for all that follow; several are separated by commas, or the option is repeated.
    #[arg(
        long = "design",
        value_name = "DESIGN",
        value_delimiter = ',',
        requires = "mission",
        conflicts_with = "frames"
    )]
    designs: Vec<String>,
}

impl DesignArguments {
    /// The mission with the drones that were named, or with its own.
    ///
    /// # Errors
    /// A design cannot be read, or the mission cannot be flown so: every reason.
    pub fn equip(&self, mission: Mission, locale: &Locale) -> Result<Mission, Failure> {
        let fleet: Result<Vec<Design>, Failure> =
            self.designs.iter().map(|name| find(name, locale)).collect();
        let id = mission.id.clone();
        mission.with_fleet(fleet?).map_err(|faults| {
            let lines = faults.iter().map(|fault| locale.text(fault));
            let lines: Vec<String> = lines.map(|line| format!("sortie: {id}: {line}")).collect();
            Failure::Invalid(lines.join("\n"))
        })
    }
}

/// A design by path or name.
///
/// # Errors
/// It is not there, or what is wrong with it, in words.
pub(super) fn find(name: &str, locale: &Locale) -> Result<Design, Failure> {
    store::design(name).map_err(|error| match &error {
        store::StoreError::Faulty { file, faults } => {
            let lines = faults
                .iter()
                .map(|fault| fault.one_line(&file.name, &file.text));
            Failure::Invalid(lines.collect::<Vec<_>>().join("\n"))
        }
        _ => Failure::Invalid(format!("sortie: {}", locale.text(&Text::from(&error)))),
    })
}
