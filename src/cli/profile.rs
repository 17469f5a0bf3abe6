//! `sortie profile`: the profiles of trainees.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::SystemTime;

use clap::{Args, Subcommand};
use serde::Serialize;

use super::settings::CliSettings;
use super::{Failure, progress, trainee};
use crate::campaign::{CareerProgress, CareerStanding};
use crate::store::{self, Profile, ProfileError, ProfileFile, Profiles, day_of, utc};
use crate::text;
use crate::text::{Locale, Text};
use crate::workshop::part;

/// Options of `sortie profile`.
#[derive(Debug, Args)]
pub(super) struct ProfileArguments {
    #[command(subcommand)]
    command: ProfileCommand,
}

#[derive(Debug, Subcommand)]
enum ProfileCommand {
    /// Creates a new profile.
    #[command(
        after_help = "Examples:\n  sortie profile create anna\n  sortie profile create 'Anna K.'"
    )]
    Create {
        /// The trainee's name: one line of at most 40 letters.
        name: String,
    },
    /// Lists all profiles with their progress.
    #[command(
        after_help = "Examples:\n  sortie profile list\n  sortie profile list --json --data /srv/course"
    )]
    List {
        /// Print one JSON document instead of a table.
        #[arg(long)]
        json: bool,
    },
    /// Shows credits, level, licence, missions, skills, and what to train next.
    #[command(after_help = "Examples:\n  sortie profile show anna\n  sortie profile show --json")]
    Show {
        /// The profile; by default the one in the settings, or the only one.
        name: Option<String>,
        /// Print one JSON document instead of tables.
        #[arg(long)]
        json: bool,
    },
    /// Exports a profile with all its flights as JSON, to move it to another machine.
    #[command(after_help = "Examples:\n  \
                            sortie profile export anna > anna.json\n  \
                            sortie profile export anna --output anna.json")]
    Export {
        /// The profile; by default the one in the settings, or the only one.
        name: Option<String>,
        /// Write to this file; `-` is standard output.
        #[arg(long, value_name = "FILE", default_value = "-")]
        output: PathBuf,
    },
    /// Imports an exported profile.
    #[command(after_help = "Examples:\n  \
                            sortie profile import anna.json\n  \
                            sortie profile import anna.json --name anna-2")]
    Import {
        /// A file written by `sortie profile export`.
        file: PathBuf,
        /// Store the profile under this name; by default the exported one.
        #[arg(long)]
        name: Option<String>,
    },
    /// Deletes a profile with all its flights and designs, but keeps its recordings.
    #[command(after_help = "Examples:\n  \
                            sortie profile export anna --output anna.json\n  \
                            sortie profile delete anna --yes")]
    Delete {
        /// The profile to delete.
        name: String,
        /// Delete the profile without asking for confirmation.
        #[arg(long)]
        yes: bool,
    },
    /// Buys the right to use a part, with the credits of the profile that `--profile` names.
    #[command(after_help = "Examples:\n  \
                            sortie workshop parts radio\n  \
                            sortie profile buy r_rfd900 --profile anna")]
    Buy {
        /// The id of the part; `sortie workshop parts` lists all ids.
        part: String,
    },
}

impl ProfileArguments {
    /// Whether the command changes no profile.
    pub(super) fn only_reads(&self) -> bool {
        match self.command {
            ProfileCommand::List { .. }
            | ProfileCommand::Show { .. }
            | ProfileCommand::Export { .. } => true,
            ProfileCommand::Create { .. }
            | ProfileCommand::Import { .. }
            | ProfileCommand::Delete { .. }
            | ProfileCommand::Buy { .. } => false,
        }
    }
}

/// Carries out the command.
pub(super) fn profile(
    options: &ProfileArguments,
    settings: &CliSettings,
) -> Result<ExitCode, Failure> {
    let locale = Locale::new(settings.language());
    let profiles = if options.only_reads() {
        trainee::open_to_read(settings, &locale)?
    } else {
        trainee::open(settings, &locale)?
    };
    let mut commands = ProfileCommands {
        profiles,
        settings,
        locale,
    };
    match &options.command {
        ProfileCommand::Create { name } => commands.create(name),
        ProfileCommand::List { json } => commands.list(*json),
        ProfileCommand::Show { name, json } => commands.show(name.as_deref(), *json),
        ProfileCommand::Export { name, output } => commands.export(name.as_deref(), output),
        ProfileCommand::Import { file, name } => commands.import(file, name.as_deref()),
        ProfileCommand::Delete { name, yes } => commands.delete(name, *yes),
        ProfileCommand::Buy { part } => commands.buy(part),
    }
}

/// The profiles, settings and locale that the subcommands share.
struct ProfileCommands<'a> {
    profiles: Profiles,
    settings: &'a CliSettings,
    locale: Locale,
}

#[derive(Debug, Serialize)]
struct ListedProfile {
    name: String,
    since: String,
    credits: u32,
    level: u32,
    licence: u8,
    flights: u32,
}

/// A profile with its progress, as JSON.
#[derive(Debug, Serialize)]
struct ShownProfile<'a> {
    name: &'a str,
    since: &'a str,
    lang: Option<&'a str>,
    aids: &'static str,
    #[serde(flatten)]
    progress: &'a CareerProgress,
}

impl ProfileCommands<'_> {
    fn refused(&self, error: &ProfileError) -> Failure {
        trainee::refused(error, &self.locale)
    }

    fn of(&self, name: Option<&str>) -> Result<Profile, Failure> {
        trainee::choose(&self.profiles, name, self.settings, &self.locale)
    }

    fn progress(&self, profile: &Profile) -> Result<CareerProgress, Failure> {
        let history = self
            .profiles
            .history(profile)
            .map_err(|error| self.refused(&error))?;
        let today = day_of(SystemTime::now());
        Ok(CareerProgress::of(&store::course(), &history, today))
    }

    fn create(&self, name: &str) -> Result<ExitCode, Failure> {
        let made = self.profiles.create(name, &utc(SystemTime::now()));
        let profile = made.map_err(|error| self.refused(&error))?;
        let text = text!("profile-created", name = profile.name);
        trainee::done(&text, &self.locale)
    }

    fn list(&self, json: bool) -> Result<ExitCode, Failure> {
        let (mut members, mut code) = (Vec::new(), ExitCode::SUCCESS);
        for profile in self.profiles.list().map_err(|error| self.refused(&error))? {
            // An unreadable profile does not hide the others.
            match self.member(&profile) {
                Ok(member) => members.push(member),
                Err(error) => {
                    let words = self.locale.text(&error.text());
                    tell!("sortie: {}: {words}", profile.name);
                    code = ExitCode::FAILURE;
                }
            }
        }
        if json {
            say!("{}", serde_json::to_string_pretty(&members)?)?;
        } else if members.is_empty() && code == ExitCode::SUCCESS {
            say!("{}", self.locale.text(&text!("profile-none")))?;
        } else {
            for member in &members {
                let line = text!(
                    "profile-member",
                    name = member.name.as_str(),
                    credits = member.credits,
                    level = member.level,
                    licence = member.licence,
                    flights = member.flights
                );
                say!("{}", self.locale.text(&line))?;
            }
        }
        Ok(code)
    }

    fn member(&self, profile: &Profile) -> Result<ListedProfile, ProfileError> {
        let standing = CareerStanding::of(&self.profiles.history(profile)?);
        Ok(ListedProfile {
            name: profile.name.clone(),
            since: profile.since.clone(),
            credits: standing.credits(),
            level: standing.experience().1,
            licence: standing.licence(),
            flights: standing.flights(),
        })
    }

    fn show(&self, name: Option<&str>, json: bool) -> Result<ExitCode, Failure> {
        let profile = self.of(name)?;
        let progress = self.progress(&profile)?;
        let aids = profile.settings.aids;
        if json {
            let shown = ShownProfile {
                name: &profile.name,
                since: &profile.since,
                lang: profile.settings.lang.as_deref(),
                aids: aids.code(),
                progress: &progress,
            };
            say!("{}", serde_json::to_string_pretty(&shown)?)?;
            return Ok(ExitCode::SUCCESS);
        }
        let words = |text: &Text| self.locale.text(text);
        say!("{}", profile.name)?;
        for line in progress::heading(&progress) {
            say!("  {}", words(&line))?;
        }
        let level = aids.title();
        say!("  {}", words(&text!("progress-aids", aids = level)))?;
        if let Some(lang) = &profile.settings.lang {
            let lang = lang.as_str();
            say!("  {}", words(&text!("progress-lang", lang = lang)))?;
        }
        say!("\n{}", words(&text!("progress-missions")))?;
        say!(
            "{}",
            progress::missions(&progress, &self.locale)
                .plain()
                .trim_end()
        )?;
        say!("\n{}", words(&text!("progress-skills")))?;
        say!(
            "{}",
            progress::skills(&progress, &self.locale).plain().trim_end()
        )?;
        Ok(ExitCode::SUCCESS)
    }

    fn export(&self, name: Option<&str>, output: &Path) -> Result<ExitCode, Failure> {
        let profile = self.of(name)?;
        let file = self.profiles.export(&profile);
        let readers = self.settings.config.results.readers;
        let text = file.map_err(|error| self.refused(&error))?.write();
        store::write_output(output, &format!("{}\n", text.trim_end()), readers)?;
        Ok(ExitCode::SUCCESS)
    }

    fn import(&mut self, path: &Path, name: Option<&str>) -> Result<ExitCode, Failure> {
        let file = ProfileFile::open(path).map_err(|error| self.refused(&error))?;
        let (file, told) = file.borne_out();
        let name = name.unwrap_or(&file.name);
        let taken_in = self.profiles.import(&file, name);
        let profile = taken_in.map_err(|error| self.refused(&error))?;
        for text in told {
            tell!("sortie: {}", self.locale.text(&text));
        }
        let flights = self.progress(&profile)?.flights;
        let text = text!("profile-imported", name = profile.name, flights = flights);
        trainee::done(&text, &self.locale)
    }

    fn delete(&self, name: &str, yes: bool) -> Result<ExitCode, Failure> {
        let profile = self.of(Some(name))?;
        let name = profile.name.as_str();
        if !yes {
            let flights = self.progress(&profile)?.flights;
            let text = text!("profile-delete", name = name, flights = flights);
            return Err(trainee::invalid(&text, &self.locale));
        }
        let deleted = self.profiles.delete(&profile);
        deleted.map_err(|error| self.refused(&error))?;
        trainee::done(&text!("profile-deleted", name = name), &self.locale)
    }

    fn buy(&mut self, id: &str) -> Result<ExitCode, Failure> {
        let profile = self.of(None)?;
        let when = utc(SystemTime::now());
        let bought = self.profiles.buy(&profile, id, &store::course(), &when);
        let purchase = bought.map_err(|error| self.refused(&error))?;
        let left = self.progress(&profile)?.credits;
        let name = part(id).map_or_else(|| Text::verbatim(id), crate::workshop::Part::name);
        let text = text!(
            "profile-bought",
            part = name,
            price = purchase.credits,
            left = left
        );
        trainee::done(&text, &self.locale)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::Language;

    #[test]
    fn the_list_counts_in_the_grammar_of_each_language() {
        for (language, count, expected) in [
            (
                Language::English,
                1,
                "1 credit, level 2, licence for 1 drone,",
            ),
            (
                Language::English,
                3,
                "3 credits, level 2, licence for 3 drones,",
            ),
            (
                Language::Ukrainian,
                1,
                "1 кредит, рівень 2, ліцензія на 1 дрон,",
            ),
            (
                Language::Ukrainian,
                3,
                "3 кредити, рівень 2, ліцензія на 3 дрони,",
            ),
            (
                Language::Ukrainian,
                5,
                "5 кредитів, рівень 2, ліцензія на 5 дронів,",
            ),
        ] {
            let line = text!(
                "profile-member",
                name = "Anna",
                credits = count,
                level = 2,
                licence = count,
                flights = count
            );
            let line = Locale::new(language).text(&line);
            assert!(line.contains(expected), "{line}");
        }
    }
}
