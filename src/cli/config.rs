//! `sortie config`: every setting and its source.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::{fs, io};

use clap::Args;

use super::Failure;
use super::settings::CliSettings;
use crate::config::setting_reference;
use crate::store::{Folders, History};
use crate::text::Locale;

/// Options of `sortie config`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie config                                   the settings and their sources\n  \
    sortie config > new-config.toml                 a file to start from\n  \
    sortie config --theme light --fps 5             what these flags would change\n  \
    sortie config --keys                            the keys, and every action that a key could have\n  \
    sortie config --paths                           the files and folders\n  \
    sortie config --reference                       the table of settings in the documentation")]
pub(super) struct ConfigArguments {
    /// Print the files and folders instead of the values.
    #[arg(long, conflicts_with = "keys")]
    paths: bool,
    /// Print the keys and their actions as a keymap file, instead of the values.
    #[arg(long)]
    keys: bool,
    /// Print a Markdown table of all settings: default, environment variable, meaning.
    #[arg(long, conflicts_with_all = ["paths", "keys"])]
    reference: bool,
}

/// Prints the settings as a configuration file; exit code 2 if a file is faulty.
pub(super) fn config(
    options: &ConfigArguments,
    settings: &CliSettings,
) -> Result<ExitCode, Failure> {
    if options.reference {
        say!("{}", setting_reference().trim_end())?;
        return Ok(ExitCode::SUCCESS);
    }
    if options.paths {
        // Printed as TOML, too, so that scripts can read both in the same way.
        for (name, path) in paths(settings) {
            say!("{name} = {}", toml_string(&path))?;
        }
        for (name, paths) in system_paths(settings) {
            let list: Vec<toml::Value> = paths.iter().map(|path| toml_string(path)).collect();
            say!("{name} = {}", toml::Value::Array(list))?;
        }
    } else if options.keys {
        let locale = Locale::new(settings.language());
        say!("{}", settings.keymap.show(&locale).trim_end())?;
    } else {
        say!("# Precedence: flag, environment, file, the administrator's file, default.")?;
        let own = paths(settings).into_iter();
        let system = system_paths(settings)
            .into_iter()
            .flat_map(|(name, paths)| {
                let paths = paths.into_iter();
                paths.map(move |path| (name, path))
            });
        for (name, path) in own.chain(system) {
            say!("# {name:<13} {}{}", path.display(), state(&path))?;
        }
        say!("")?;
        say!("{}", settings.sources.layers.show().trim_end())?;
    }
    settings.complain();
    let is_faulty = !settings.faults.is_empty();
    Ok(ExitCode::from(if is_faulty { 2 } else { 0 }))
}

/// A remark on a file or folder that is not read.
fn state(path: &Path) -> &'static str {
    let is_refused = |error: &io::Error| error.kind() == io::ErrorKind::PermissionDenied;
    let listed = fs::read_dir(path).err();
    match path.try_exists() {
        Ok(false) => " (not there)",
        Ok(true) if !path.is_dir() || !listed.as_ref().is_some_and(is_refused) => "",
        Ok(true) | Err(_) => " (no permission to read it)",
    }
}

fn paths(settings: &CliSettings) -> Vec<(&'static str, PathBuf)> {
    let mut paths = Vec::new();
    paths.extend(
        settings
            .sources
            .file
            .clone()
            .map(|file| ("config_file", file)),
    );
    paths.extend(settings.keymap_file().map(|file| ("keymap_file", file)));
    if let Some(folders) = &settings.folders {
        let Folders {
            config,
            data,
            state,
            system_config: _,
            system_data: _,
        } = folders;
        let within = |folder: &Path, name: &str| folder.join(name);
        paths.extend([
            ("config", config.clone()),
            ("themes", folders.themes()),
            ("missions", within(config, "missions")),
            ("pilots", within(config, "missions/pilots")),
            ("data", data.clone()),
            ("state", state.clone()),
            ("history", History::within(state).path().to_owned()),
        ]);
    }
    if let Some(log) = &settings.config.log.file {
        paths.push(("log", PathBuf::from(log)));
    }
    paths
}

/// Files and folders of the administrator's settings, by name; the highest precedence comes first.
fn system_paths(settings: &CliSettings) -> Vec<(&'static str, Vec<PathBuf>)> {
    let folders = settings.folders.iter();
    let lists = folders.flat_map(|folders| {
        [
            ("system_config", folders.system_config.clone()),
            ("system_data", folders.system_data.clone()),
        ]
    });
    lists.collect()
}

fn toml_string(path: &Path) -> toml::Value {
    toml::Value::String(path.display().to_string())
}
