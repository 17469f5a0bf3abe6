//! The flags of every command.

use std::path::PathBuf;

use clap::Args;

/// Options of every command.
#[derive(Debug, Default, Args)]
pub(in crate::cli) struct Common {
    /// Read this configuration file instead of the user's.
    #[arg(long, global = true, value_name = "FILE", help_heading = "Settings")]
    pub config: Option<PathBuf>,
    /// Keep profiles and recorded runs in this folder instead of the user's.
    #[arg(long, global = true, value_name = "DIR", help_heading = "Settings")]
    pub data: Option<PathBuf>,
    /// Use this profile: its career, designs and language.
    #[arg(long, global = true, value_name = "NAME", help_heading = "Settings")]
    profile: Option<String>,
    /// Use this language: en, uk.
    #[arg(
        long,
        global = true,
        value_name = "LANGUAGE",
        help_heading = "Settings"
    )]
    lang: Option<String>,
    /// Use this theme: dark, light, high-contrast, monochrome, or one of your own.
    #[arg(long, global = true, value_name = "NAME", help_heading = "Settings")]
    theme: Option<String>,
    /// Draw at most this many frames per second.
    #[arg(long, global = true, value_name = "N", help_heading = "Settings")]
    fps: Option<String>,
    /// Draw curves and maps with these symbols: braille, block, ascii.
    #[arg(long, global = true, value_name = "KIND", help_heading = "Settings")]
    symbols: Option<String>,
    /// Use the mouse: the wheel moves the cursor; a click selects a row, presses a key on the last line, or picks a
    /// place on the map.
    #[arg(
        long,
        global = true,
        num_args = 0,
        default_missing_value = "true",
        help_heading = "Settings"
    )]
    mouse: Option<String>,
    /// Record nothing: flights of this session cannot be replayed.
    #[arg(
        long,
        global = true,
        num_args = 0,
        default_missing_value = "false",
        help_heading = "Settings"
    )]
    no_record: Option<String>,
    /// Ignore frames that are not signed with the key of their vehicle (`signing setup`).
    #[arg(
        long,
        global = true,
        num_args = 0,
        default_missing_value = "true",
        help_heading = "Settings"
    )]
    require_signing: Option<String>,
    /// Show the documentation of parameters from FILE: apm.pdef.xml or apm.pdef.json of ArduPilot, parameters.json of
    /// PX4.
    #[arg(long, global = true, value_name = "FILE", help_heading = "Settings")]
    parameter_docs: Option<String>,
    /// Show the texts of events from FILE, PX4's list of all events.
    #[arg(long, global = true, value_name = "FILE", help_heading = "Settings")]
    event_docs: Option<String>,
    /// Use this MAVLink system id, 1 to 255, instead of 255: two consoles on the same vehicles need two ids.
    #[arg(long, global = true, value_name = "ID", help_heading = "Settings")]
    station: Option<String>,
    /// Write a log to FILE.
    #[arg(long, global = true, value_name = "FILE", help_heading = "Settings")]
    log: Option<String>,
    /// Set the log level: error, warn, info, debug or trace, also for single modules: `warn,sortie::link=debug`.
    #[arg(long, global = true, value_name = "LEVELS", help_heading = "Settings")]
    log_level: Option<String>,
}

impl Common {
    /// The flags that were given: setting, flag, value.
    pub fn flags(&self) -> impl Iterator<Item = (&'static str, &'static str, &str)> {
        let flags = [
            ("profile", "--profile", &self.profile),
            ("lang", "--lang", &self.lang),
            ("theme", "--theme", &self.theme),
            ("fps", "--fps", &self.fps),
            ("symbols", "--symbols", &self.symbols),
            ("mouse", "--mouse", &self.mouse),
            ("records.enabled", "--no-record", &self.no_record),
            (
                "connect.require_signing",
                "--require-signing",
                &self.require_signing,
            ),
            (
                "parameters.documentation",
                "--parameter-docs",
                &self.parameter_docs,
            ),
            ("events.documentation", "--event-docs", &self.event_docs),
            ("connect.station", "--station", &self.station),
            ("log.file", "--log", &self.log),
            ("log.level", "--log-level", &self.log_level),
        ];
        let given = flags.into_iter();
        given.filter_map(|(setting, flag, value)| Some((setting, flag, value.as_deref()?)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Setting;
    use crate::ui::Theme;

    #[test]
    fn the_texts_about_themes_name_all_that_come_with_the_program() {
        let names: Vec<&str> = Theme::names().collect();
        let command = Common::augment_args(clap::Command::new("sortie"));
        let mut arguments = command.get_arguments();
        let flag = arguments.find(|it| it.get_id() == "theme");
        let help = flag.and_then(|it| it.get_help()).map(ToString::to_string);
        let setting = Setting::named("theme").map(|it| it.about.to_owned());
        for text in [help, setting] {
            let text = text.expect("there is a text");
            assert!(text.contains(&names.join(", ")), "{text}");
        }
    }
}
