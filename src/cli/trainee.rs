//! Opens the profiles for the subcommands, finds them by name and explains failures.

use std::path::Path;
use std::process::ExitCode;

use super::Failure;
use super::settings::CliSettings;
use crate::store::{Profile, ProfileError, Profiles, open_profiles, open_profiles_to_read};
use crate::text;
use crate::text::{Locale, Text};

/// Opens the profiles of the data folder, and prints warnings about repaired files and recovered
/// flights.
///
/// # Errors
/// The data folder is missing, or its profiles cannot be opened or written.
pub(super) fn open(settings: &CliSettings, locale: &Locale) -> Result<Profiles, Failure> {
    let profiles = opened_by(open_profiles, settings, locale)?;
    let written = profiles.require_writable();
    written.map_err(|error| refused(&error, locale))?;
    Ok(profiles)
}

/// The profiles of the data folder, for a command that only reads.
///
/// # Errors
/// A data folder that the user named does not exist, or its profiles cannot be read.
pub(super) fn open_to_read(settings: &CliSettings, locale: &Locale) -> Result<Profiles, Failure> {
    settings.data.require(locale)?;
    opened_by(open_profiles_to_read, settings, locale)
}

type OpenProfiles = fn(&Path) -> Result<(Profiles, Vec<Text>), ProfileError>;

fn opened_by(
    open: OpenProfiles,
    settings: &CliSettings,
    locale: &Locale,
) -> Result<Profiles, Failure> {
    let Some(data) = settings.data.path() else {
        return Err(invalid(&text!("career-nowhere"), locale));
    };
    let (profiles, told) = open(data).map_err(|error| refused(&error, locale))?;
    for text in told {
        tell!("sortie: {}", locale.text(&text));
    }
    Ok(profiles)
}

/// The profile with a name; without a name, that of the settings, or the only one.
///
/// # Errors
/// The name is unknown, no profile exists, or several exist and none is chosen.
pub(super) fn choose(
    profiles: &Profiles,
    name: Option<&str>,
    settings: &CliSettings,
    locale: &Locale,
) -> Result<Profile, Failure> {
    if let Some(name) = name.or(settings.config.profile.as_deref()) {
        return profiles.find(name).map_err(|error| refused(&error, locale));
    }
    let all = profiles.list().map_err(|error| refused(&error, locale))?;
    match &all[..] {
        [only] => Ok(only.clone()),
        [] => Err(invalid(&text!("profile-none"), locale)),
        several => {
            let names: Vec<&str> = several.iter().map(|it| it.name.as_str()).collect();
            let text = text!("profile-choose", known = names.join(", "));
            Err(invalid(&text, locale))
        }
    }
}

/// Converts a fault of profiles to a failure of the command: a wrong name or file is a usage error.
pub(super) fn refused(error: &ProfileError, locale: &Locale) -> Failure {
    let words = locale.text(&error.text());
    match error {
        ProfileError::Unknown { .. }
        | ProfileError::Exists { .. }
        | ProfileError::Name
        | ProfileError::NoProfile { .. } => Failure::Invalid(format!("sortie: {words}")),
        ProfileError::Unusable { .. }
        | ProfileError::Unreadable { .. }
        | ProfileError::Forbidden { .. }
        | ProfileError::ReadOnly { .. }
        | ProfileError::Newer { .. }
        | ProfileError::Older { .. }
        | ProfileError::LogAlone { .. }
        | ProfileError::Database { .. }
        | ProfileError::Damaged { .. }
        | ProfileError::Refused(_) => Failure::Failed(anyhow::anyhow!(words)),
    }
}

/// A failure for a usage error.
pub(super) fn invalid(text: &Text, locale: &Locale) -> Failure {
    Failure::Invalid(format!("sortie: {}", locale.text(text)))
}

/// Prints a text and returns success.
pub(super) fn done(text: &Text, locale: &Locale) -> Result<ExitCode, Failure> {
    say!("{}", locale.text(text))?;
    Ok(ExitCode::SUCCESS)
}
