//! Finds the SITL programs: those that the user has named, otherwise those on the PATH and in the usual build folders.

use std::collections::BTreeMap;
use std::env;
use std::ffi::OsString;
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::sitl::SitlKind;

mod identity;
mod scratch;

#[cfg(all(test, target_os = "linux"))]
mod tests;

pub use identity::{PATIENCE, ProgramIdentity, Unknown, identify};

/// The build folders of `ArduPilot`, below the home folder and below the current one.
const BUILDS_AT_HOME: [&str; 4] = [
    "ardupilot",
    "src/ardupilot",
    "git/ardupilot",
    "dev/ardupilot",
];
const BUILDS_HERE: [&str; 3] = ["", "ardupilot", "../ardupilot"];
/// The name of a build folder in messages.
const BUILD: &str = "usual build folder";
const BUILD_FOLDER: &str = "build/sitl/bin";

/// A program that the user has named.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Named {
    pub file: PathBuf,
    /// Where it was named: a flag, a variable, a line of a file.
    pub by: String,
}

/// The places to search for programs that the user has not named.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Places {
    pub path: Option<OsString>,
    pub home: Option<PathBuf>,
    pub here: PathBuf,
}

impl Places {
    /// The places that environment variables name.
    pub fn of_environment() -> Self {
        Self {
            path: env::var_os("PATH"),
            home: env::home_dir(),
            here: env::current_dir().unwrap_or_default(),
        }
    }

    /// The folders in order, each with its description.
    fn folders(&self) -> Vec<(PathBuf, &'static str)> {
        // An empty entry means the current folder, which is unsafe for programs on a shared machine.
        let path = self
            .path
            .iter()
            .flat_map(env::split_paths)
            .filter(|folder| folder.is_absolute());
        let mut folders: Vec<_> = path.map(|folder| (folder, "PATH")).collect();
        for build in BUILDS_HERE {
            let folder = self.here.join(build).join(BUILD_FOLDER);
            folders.push((folder, BUILD));
        }
        for build in self
            .home
            .iter()
            .flat_map(|home| BUILDS_AT_HOME.map(|build| home.join(build)))
        {
            folders.push((build.join(BUILD_FOLDER), BUILD));
        }
        folders
    }
}

/// A program that was found.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct FoundProgram {
    /// The file, by its absolute path.
    pub file: PathBuf,
    /// The option, setting or search that led to the program.
    pub by: String,
}

/// A program that was not found.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, thiserror::Error)]
pub enum Missing {
    /// The named file does not exist or cannot be started.
    #[error("{by} names {}: {reason}", file.display())]
    Named {
        file: PathBuf,
        /// The option, variable or setting that names the file.
        by: String,
        reason: String,
    },
    /// The program is neither on the PATH nor in these folders.
    #[error("no {program} on the PATH nor in {}", list(.tried))]
    Nowhere {
        program: &'static str,
        /// The usual build folders.
        tried: Vec<PathBuf>,
    },
}

fn list(folders: &[PathBuf]) -> String {
    let names: Vec<_> = folders
        .iter()
        .map(|folder| folder.display().to_string())
        .collect();
    names.join(", ")
}

/// The program of each kind of vehicle, or why it is missing.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Programs(BTreeMap<SitlKind, Result<FoundProgram, Missing>>);

impl Programs {
    /// Finds the program of each kind: the named one, or the first one in `places`.
    pub fn find(named: &BTreeMap<SitlKind, Named>, places: &Places) -> Self {
        let folders = places.folders();
        let look = |kind: SitlKind| match named.get(&kind) {
            Some(named) => named.checked(&places.here),
            None => first_in(&folders, kind),
        };
        Self(
            SitlKind::ALL
                .iter()
                .map(|&kind| (kind, look(kind)))
                .collect(),
        )
    }

    /// The program of a kind.
    ///
    /// # Errors
    /// It was not found.
    pub fn of(&self, kind: SitlKind) -> Result<&FoundProgram, Missing> {
        match self.0.get(&kind) {
            Some(result) => result.as_ref().map_err(Clone::clone),
            None => Err(Missing::Nowhere {
                program: kind.program(),
                tried: Vec::new(),
            }),
        }
    }

    /// The programs found, in a hangar's format.
    pub fn paths(&self) -> BTreeMap<SitlKind, PathBuf> {
        let found = self.0.iter();
        found
            .filter_map(|(&kind, result)| Some((kind, result.as_ref().ok()?.file.clone())))
            .collect()
    }
}

impl Named {
    fn checked(&self, here: &Path) -> Result<FoundProgram, Missing> {
        let file = here.join(&self.file);
        match check(&file) {
            Ok(()) => Ok(FoundProgram {
                file,
                by: self.by.clone(),
            }),
            Err(reason) => Err(Missing::Named {
                file,
                by: self.by.clone(),
                reason,
            }),
        }
    }
}

fn first_in(folders: &[(PathBuf, &str)], kind: SitlKind) -> Result<FoundProgram, Missing> {
    for (folder, what) in folders {
        let file = folder.join(kind.program());
        if check(&file).is_ok() {
            return Ok(FoundProgram {
                file,
                by: (*what).to_owned(),
            });
        }
    }
    let builds = folders.iter().filter(|(_, what)| *what == BUILD);
    let tried = builds.map(|(folder, _)| folder.clone()).collect();
    Err(Missing::Nowhere {
        program: kind.program(),
        tried,
    })
}

/// Checks whether a file can be started; otherwise returns why not.
fn check(file: &Path) -> Result<(), String> {
    let about = file.metadata().map_err(|error| error.to_string())?;
    if about.is_dir() {
        return Err("it is a folder: name the program in it".to_owned());
    }
    if !about.is_file() {
        return Err("it is not a file".to_owned());
    }
    if about.permissions().mode() & 0o111 == 0 {
        return Err(format!("it is not executable: chmod +x {}", file.display()));
    }
    Ok(())
}
