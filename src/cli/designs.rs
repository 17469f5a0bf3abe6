//! Options for the drones of a mission, shared by `run` and `fly`.

use std::path::Path;

use clap::Args;

use super::settings::CliSettings;
use super::{Failure, trainee};
use crate::mission::Mission;
use crate::store;
use crate::text::{Locale, Text};
use crate::workshop::Design;

/// Options of commands that fly a mission.
#[derive(Debug, Clone, Default, Args)]
pub(super) struct DesignArguments {
    /// Use this design of the workshop in the mission: a design file, or the name of a design. One design applies to
    /// all vehicles of its kind (drones, ground robots, boats); with several of a kind, each vehicle takes the next one,
    /// and the last one applies to all further ones. Separate them with commas, or repeat the option.
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
    /// The mission with the named drones, or with its own.
    ///
    /// # Errors
    /// A design cannot be read, or the mission cannot be flown with it: all reasons.
    pub fn equip(&self, mission: Mission, settings: &CliSettings) -> Result<Mission, Failure> {
        let locale = &Locale::new(settings.language());
        let designs = self.designs.iter();
        let fleet: Result<Vec<Design>, Failure> =
            designs.map(|name| find(name, settings, locale)).collect();
        let id = mission.id.clone();
        mission.with_fleet(fleet?).map_err(|faults| {
            let lines: Vec<String> = faults
                .iter()
                .map(|fault| locale.text(fault))
                .map(|line| format!("sortie: {id}: {line}"))
                .collect();
            Failure::Invalid(lines.join("\n"))
        })
    }
}

/// A design by path or name: the trainee's own design of this name, otherwise a shared one.
///
/// # Errors
/// The design does not exist or is faulty; the error describes the faults.
pub(super) fn find(name: &str, settings: &CliSettings, locale: &Locale) -> Result<Design, Failure> {
    if !Path::new(name).is_file()
        && settings.config.profile.is_some()
        && let Some(own) = own(name, settings, locale)?
    {
        return Ok(own);
    }
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

/// The trainee's own design of a name; case does not matter.
fn own(name: &str, settings: &CliSettings, locale: &Locale) -> Result<Option<Design>, Failure> {
    let profiles = trainee::open_to_read(settings, locale)?;
    let profile = trainee::choose(&profiles, None, settings, locale)?;
    let designs = profiles
        .designs(&profile)
        .map_err(|error| trainee::refused(&error, locale))?;
    let is_meant = |design: &Design| design.name.to_lowercase() == name.to_lowercase();
    Ok(designs.into_iter().find(is_meant))
}
