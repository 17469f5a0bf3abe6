//! The user's settings, collected from flags, environment and files before a command begins.
//!
//! A wrong value on the command line or in the environment ends the command with exit code 2. A fault in a file of the
//! configuration folder does not prevent flying: the wrong part is left out, and the fault is reported.

use std::env;
use std::path::{Path, PathBuf};

use tracing_subscriber::EnvFilter;

use super::Failure;
use super::fault::FileFault;
use crate::app::keymap::Keymap;
use crate::app::lines;
use crate::config::{Config, Layers};
use crate::diagnostic::{Diagnostic, nearest};
use crate::store::{self, Folders, Source, StoreError};
use crate::text;
use crate::text::{Language, Locale, Text};
use crate::ui::{Theme, ThemeError, ThemeFile, Themes};

pub(super) mod class;
mod data;
mod documents;
mod flags;
mod shown;
mod sources;
mod told;

pub(super) use data::DataFolder;
pub(super) use flags::Common;
use sources::{SettingPlace, SettingSources};

const CONFIG_VARIABLE: &str = "SORTIE_CONFIG";

const DATA_VARIABLE: &str = "SORTIE_DATA";

/// All settings and the files that they come from.
#[derive(Debug)]
pub(super) struct CliSettings {
    /// The source of each setting.
    pub sources: SettingSources,
    /// The typed values of the settings.
    pub config: Config,
    /// The actions of the keys.
    pub keymap: Keymap,
    /// The embedded themes and the user's.
    pub themes: Themes,
    /// The theme in use.
    pub theme: Theme,
    /// The program's folders; `None` without a home folder.
    pub folders: Option<Folders>,
    /// The folder of profiles and recorded runs.
    pub data: DataFolder,
    /// The faults of the files.
    pub faults: Vec<FileFault>,
}

/// Collects all settings.
///
/// # Errors
/// A value or file named on the command line or in the environment is wrong or missing.
pub(super) fn gather(common: &Common) -> Result<CliSettings, Failure> {
    let mut folders = Folders::find();
    let named = variable(DATA_VARIABLE).map(PathBuf::from);
    let data = DataFolder::new(common.data.clone().or(named), folders.as_ref());
    if let (Some(folders), Some(data)) = (&mut folders, data.path()) {
        data.clone_into(&mut folders.data);
    }
    let named = common
        .config
        .clone()
        .or_else(|| variable(CONFIG_VARIABLE).map(PathBuf::from));
    let is_named = named.is_some();
    let file = named.or_else(|| folders.as_ref().map(Folders::config_file));
    let mut settings = CliSettings {
        sources: SettingSources::new(file, is_named),
        config: Config::default(),
        keymap: Keymap::default(),
        themes: themes(),
        theme: Theme::default(),
        folders,
        data,
        faults: Vec::new(),
    };
    match settings.read_all(common) {
        Ok(()) => Ok(settings),
        Err(failure) => {
            settings.config = settings.sources.layers.config();
            Err(failure.said_in(&Locale::new(settings.language())))
        }
    }
}

/// The available themes: the embedded ones and the user's.
pub(super) fn themes() -> Themes {
    let mut themes = Themes::default();
    add_themes(&mut themes, store::themes());
    themes
}

/// Adds files to the available themes.
pub(super) fn add_themes(themes: &mut Themes, files: Vec<Source>) {
    for file in files {
        let name = file.stem().to_owned();
        let path = file.name;
        let text = file.text;
        themes.add(name, ThemeFile { path, text });
    }
}

/// The names of the available themes.
pub(super) fn theme_names(themes: &Themes) -> Vec<String> {
    themes.names().map(str::to_owned).collect()
}

impl CliSettings {
    fn read_all(&mut self, common: &Common) -> Result<(), Failure> {
        self.report_closed_folders();
        self.read_system_files();
        self.read_file()?;
        self.read_words(common)?;
        self.config = self.sources.layers.config();
        self.report_unreadable_themes();
        self.choose_theme()?;
        self.check_log()?;
        self.place_hangar_files();
        self.read_keymap()
    }

    /// Reports the folders of files that this user has no permission to read: their files are left out.
    fn report_closed_folders(&mut self) {
        let folders = self.folders.iter();
        let closed = folders.flat_map(store::closed_folders);
        self.faults.extend(closed.map(FileFault::closed));
    }

    /// Reads the administrator's settings. A fault there is reported, but does not prevent flying.
    fn read_system_files(&mut self) {
        let files: Vec<PathBuf> = self
            .folders
            .iter()
            .flat_map(Folders::system_files)
            .filter(|path| path.exists())
            .collect();
        for path in files {
            match store::read_found(&path, "file-configuration") {
                Ok(source) => {
                    let faults = self.lay_on(&source);
                    if !faults.is_empty() {
                        self.faults.push(FileFault::Inside(source, faults));
                    }
                }
                Err(error) => self.faults.push(FileFault::from(&error)),
            }
        }
    }

    fn lay_on(&mut self, source: &Source) -> Vec<Diagnostic> {
        self.sources.lay_on(source, &theme_names(&self.themes))
    }

    fn read_file(&mut self) -> Result<(), Failure> {
        let Some(path) = self.sources.file.clone() else {
            return Ok(());
        };
        let is_named = self.sources.is_file_named;
        if !is_named && !path.exists() {
            return Ok(());
        }
        let source = match read(&path, "file-configuration", is_named) {
            Ok(source) => source,
            Err(error) => return self.told(FileFault::from(&error), is_named),
        };
        let faults = self.lay_on(&source);
        if faults.is_empty() {
            return Ok(());
        }
        self.told(FileFault::Inside(source, faults), is_named)
    }

    fn read_words(&mut self, common: &Common) -> Result<(), Failure> {
        let environment = self.sources.layers.environment(variable);
        let mut faults = environment.err().unwrap_or_default();
        for (setting, flag, value) in common.flags() {
            faults.extend(self.sources.layers.flag(setting, flag, value).err());
        }
        // POSIX: the first of these variables that is set decides, even if it names an unsupported language.
        let locale = ["LC_ALL", "LC_MESSAGES", "LANG"]
            .into_iter()
            .find_map(|name| Some((name, variable(name)?)));
        if let Some((name, value)) = locale
            && let Some(language) = Language::of(&value)
        {
            self.sources.layers.follow("lang", name, language.code());
        }
        if faults.is_empty() {
            return Ok(());
        }
        Err(Failure::Wrong(faults))
    }

    /// Reports theme files that cannot be read, such as links to missing files: these themes are unknown.
    fn report_unreadable_themes(&mut self) {
        let unreadable = store::unreadable_themes();
        let texts = unreadable.iter().map(|error| {
            let name = error.stem().unwrap_or_default();
            text!("theme-left-out", name = name, fault = Text::from(error))
        });
        self.faults.extend(texts.map(FileFault::Whole));
    }

    fn choose_theme(&mut self) -> Result<(), Failure> {
        match self.themes.named(&self.config.theme) {
            Ok(theme) => self.theme = theme,
            Err(ThemeError::Faulty { file, faults }) => {
                let source = Source {
                    name: file.path,
                    text: file.text,
                };
                self.told(
                    FileFault::Inside(source, faults),
                    self.sources.has_to_be_right("theme"),
                )?;
            }
            Err(ThemeError::Unknown { name, known, .. }) => {
                let mut unreadable = store::unreadable_themes().into_iter();
                let fault = unreadable.find(|it| it.stem() == Some(&name));
                let guess = nearest(&name, self.themes.names());
                let text = match (fault, guess) {
                    (Some(fault), _) => Text::from(&fault),
                    (None, Some(guess)) => {
                        text!("theme-none-near", name = name, known = known, guess = guess)
                    }
                    (None, None) => text!("theme-none", name = name, known = known),
                };
                return Err(Failure::Wrong(vec![text]));
            }
        }
        self.theme.name().clone_into(&mut self.config.theme);
        Ok(())
    }

    fn check_log(&mut self) -> Result<(), Failure> {
        let written = &self.config.log.level;
        if EnvFilter::try_new(written).is_err() {
            let text = text!("config-log-level", written = written);
            return Err(Failure::Wrong(vec![text]));
        }
        // A log that a file enables for every session belongs in the state folder, not in the current folder.
        if self.sources.is_of_file("log.file")
            && let (Some(folders), Some(file)) = (&self.folders, &mut self.config.log.file)
        {
            *file = folders.state.join(&file).display().to_string();
        }
        Ok(())
    }

    /// Resolves relative paths in the section `hangar` against the folder of the configuration file
    /// that contains them.
    fn place_hangar_files(&mut self) {
        let folders = [
            "arducopter",
            "arduplane",
            "ardurover",
            "ardusub",
            "folder",
            "token_file",
        ]
        .map(|key| self.sources.folder_of(&format!("hangar.{key}")));
        let set = &mut self.config.hangar;
        let paths = [
            &mut set.arducopter,
            &mut set.arduplane,
            &mut set.ardurover,
            &mut set.ardusub,
            &mut set.folder,
            &mut set.token_file,
        ]
        .into_iter()
        .zip(folders);
        for (path, folder) in paths.filter_map(|(path, folder)| path.as_mut().zip(folder)) {
            *path = folder.join(store::user_path(path)).display().to_string();
        }
    }

    fn read_keymap(&mut self) -> Result<(), Failure> {
        let Some(path) = self.keymap_file() else {
            return Ok(());
        };
        let is_named = self.config.keymap.is_some();
        if !is_named && !path.exists() {
            return Ok(());
        }
        let source = match read(&path, "file-keymap", is_named) {
            Ok(source) => source,
            Err(error) if is_named => return self.wrong("keymap", Text::from(&error)),
            Err(error) => return self.told(FileFault::from(&error), false),
        };
        let themes = theme_names(&self.themes);
        match self.keymap.overlay(&source.text, &themes) {
            Ok(()) => Ok(()),
            Err(faults) => {
                let is_usage = is_named && self.sources.has_to_be_right("keymap");
                self.told(FileFault::Inside(source, faults), is_usage)
            }
        }
    }

    /// The keymap file, which need not exist; `None` without one. A relative path in a
    /// configuration file is relative to the folder of that file.
    pub fn keymap_file(&self) -> Option<PathBuf> {
        match &self.config.keymap {
            Some(name) => Some(match self.sources.folder_of("keymap") {
                Some(folder) => folder.join(name),
                None => PathBuf::from(name),
            }),
            None => self.folders.as_ref().map(Folders::keymap_file),
        }
    }

    /// Reports a wrong value of a setting: at its place in the file, otherwise as a usage error.
    fn wrong(&mut self, setting: &str, text: Text) -> Result<(), Failure> {
        match self.sources.place_of(setting) {
            Some(SettingPlace { source, span }) => {
                let fault = FileFault::Inside(source, vec![Diagnostic::new(span, text)]);
                self.told(fault, self.sources.has_to_be_right(setting))
            }
            None => Err(Failure::Wrong(vec![text])),
        }
    }

    /// Returns a usage error, which ends the command; stores any other fault for a later report.
    fn told(&mut self, fault: FileFault, is_usage: bool) -> Result<(), Failure> {
        if is_usage {
            return Err(fault.failure());
        }
        self.faults.push(fault);
        Ok(())
    }
}

/// The faults of a configuration file; `None` if it has none.
pub(super) fn faults_in(source: &Source, themes: &Themes) -> Option<Vec<Diagnostic>> {
    let themes = theme_names(themes);
    // Not whenever settings are read: a class that is missing keeps no console from starting.
    let check = |setting: &str, word: &str| {
        check(setting, word, &themes).and_then(|()| class::check(setting, word))
    };
    let mut layers = Layers::default();
    layers.file(&source.name, &source.text, &check).err()
}

/// Reads a file that the user named, which may be a pipe, or one that was found in a folder.
fn read(path: &Path, kind: &'static str, is_named: bool) -> Result<Source, StoreError> {
    if is_named {
        store::read(path, kind)
    } else {
        store::read_found(path, kind)
    }
}

/// Checks a word of a setting whose valid values depend on more than its type: a macro, a theme,
/// the log level.
fn check(setting: &str, word: &str, themes: &[String]) -> Result<(), Diagnostic> {
    let fault = |text| Err(Diagnostic::new(0..word.len(), text));
    match setting {
        "macros" => lines::check(word, themes),
        "theme" if !themes.iter().any(|name| name == word) => {
            let text = text!("theme-unknown", name = word);
            let known = themes.iter().map(String::as_str);
            fault(text).map_err(|fault| fault.with_nearest(word, known))
        }
        "log.level" => match EnvFilter::try_new(word) {
            Ok(_) => Ok(()),
            Err(_) => fault(text!("config-log-level", written = word)),
        },
        _ => Ok(()),
    }
}

/// The value of an environment variable, unless it is empty.
fn variable(name: &str) -> Option<String> {
    env::var(name).ok().filter(|value| !value.is_empty())
}
