//! Where the program keeps its files: the folders of the XDG Base Directory Specification.

use std::path::PathBuf;

use etcetera::BaseStrategy as _;

/// The program's folders. None of them needs to exist.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Folders {
    /// What the user writes: configuration, keymap, themes, missions.
    pub config: PathBuf,
    /// What the program makes and the user keeps.
    pub data: PathBuf,
    /// What may be lost: the history of the command line, logs.
    pub state: PathBuf,
}

impl Folders {
    /// By `XDG_CONFIG_HOME`, `XDG_DATA_HOME`, `XDG_STATE_HOME` or their defaults; `None` without a home folder.
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
        })
    }

    /// The configuration file that is read unless another is named.
    pub fn config_file(&self) -> PathBuf {
        self.config.join("config.toml")
    }

    /// The keymap file that is read unless another is named.
    pub fn keymap_file(&self) -> PathBuf {
        self.config.join("keymap.toml")
    }

    pub fn themes(&self) -> PathBuf {
        self.config.join("themes")
    }
}
