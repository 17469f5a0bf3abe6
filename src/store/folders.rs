//! The folders of the program's files: those of the XDG Base Directory Specification.

use std::path::PathBuf;
use std::{env, iter};

use etcetera::BaseStrategy as _;

/// The name of the folder for themes.
pub(super) const THEMES: &str = "themes";
const CONFIG_FILE: &str = "config.toml";

/// The program's folders. None of them needs to exist.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Folders {
    /// Files that the user writes: configuration, keymap, themes, missions.
    pub config: PathBuf,
    /// Files that the program writes and the user keeps.
    pub data: PathBuf,
    /// Expendable files: the history of the command line, logs.
    pub state: PathBuf,
    /// The administrator's settings for all users, in descending precedence.
    pub system_config: Vec<PathBuf>,
    /// Files that the administrator installed for all users, in descending precedence.
    pub system_data: Vec<PathBuf>,
}

impl Folders {
    /// The folders from `XDG_CONFIG_HOME`, `XDG_DATA_HOME`, `XDG_STATE_HOME`, `XDG_CONFIG_DIRS`, `XDG_DATA_DIRS` or
    /// their defaults; `None` without a home folder.
    pub fn find() -> Option<Self> {
        let base = etcetera::choose_base_strategy().ok()?;
        let data = base.data_dir();
        Some(Self {
            config: base.config_dir().join("sortie"),
            state: base
                .state_dir()
                .unwrap_or_else(|| data.clone())
                .join("sortie"),
            data: data.join("sortie"),
            system_config: system("XDG_CONFIG_DIRS", "/etc/xdg"),
            system_data: system("XDG_DATA_DIRS", "/usr/local/share:/usr/share"),
        })
    }

    /// The folders that hold missions, designs or themes. If several have a file of the same name, that of the last
    /// folder counts; the user's folder is the last.
    pub fn layers(&self) -> impl Iterator<Item = &PathBuf> {
        self.system().chain(iter::once(&self.config))
    }

    /// The folders of [`Self::layers`] that belong to the administrator: the user's own folders are
    /// left out, even if a variable also names them as system folders.
    pub fn system_layers(&self) -> impl Iterator<Item = &PathBuf> {
        let system = self.system();
        system.filter(|folder| **folder != self.config && **folder != self.data)
    }

    /// The system folders, in ascending precedence.
    fn system(&self) -> impl Iterator<Item = &PathBuf> {
        let data = self.system_data.iter().rev();
        data.chain(self.system_config.iter().rev())
    }

    /// The configuration files of the administrator. Later ones take precedence.
    pub fn system_files(&self) -> impl Iterator<Item = PathBuf> {
        let folders = self.system_config.iter().rev();
        folders.map(|folder| folder.join(CONFIG_FILE))
    }

    /// The default configuration file.
    pub fn config_file(&self) -> PathBuf {
        self.config.join(CONFIG_FILE)
    }

    /// The default keymap file.
    pub fn keymap_file(&self) -> PathBuf {
        self.config.join("keymap.toml")
    }

    pub fn themes(&self) -> PathBuf {
        self.config.join(THEMES)
    }
}

/// The program's folders within those that a variable or its default lists. Relative paths are
/// ignored, as the specification requires.
fn system(variable: &str, usual: &str) -> Vec<PathBuf> {
    let set = env::var_os(variable).filter(|value| !value.is_empty());
    let list = set.unwrap_or_else(|| usual.into());
    env::split_paths(&list)
        .filter(|folder| folder.is_absolute())
        .map(|folder| folder.join("sortie"))
        .collect()
}
