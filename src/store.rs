//! Files: the only place that reads and writes them.
//!
//! Missions and themes are embedded in the program. A file of the same name in the user's configuration
//! folder takes the place of the embedded one, and a path on the command line is read as it is.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::{fs, io};

use etcetera::BaseStrategy as _;

/// Missions, by file name without its ending.
const MISSIONS: &[(&str, &str)] = &[(
    "01-air-sample",
    include_str!("../missions/01-air-sample.toml"),
)];

/// Reference pilot scripts, by file name without its ending.
const PILOTS: &[(&str, &str)] = &[(
    "01-air-sample",
    include_str!("../missions/pilots/01-air-sample.pilot"),
)];

/// Files larger than this are refused: no mission, script or theme comes near it.
const LARGEST_FILE: u64 = 1024 * 1024;

/// A text with the name under which faults in it are reported.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// The path, or the name of an embedded file.
    pub name: String,
    /// What it says.
    pub text: String,
}

/// A file that could not be had.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// It could not be read.
    #[error("cannot read {path}: {error}")]
    Unreadable {
        /// The path.
        path: PathBuf,
        /// Why not.
        error: io::Error,
    },
    /// It is too large to be what was asked for.
    #[error("{path} has {bytes} bytes; a {kind} is at most {LARGEST_FILE} bytes long")]
    TooLarge {
        /// The path.
        path: PathBuf,
        /// Its size.
        bytes: u64,
        /// What was expected.
        kind: &'static str,
    },
    /// Neither a file nor an embedded name.
    #[error("there is no {kind} `{name}`: give a path, or one of {known}")]
    Unknown {
        /// What was expected.
        kind: &'static str,
        /// What was asked for.
        name: String,
        /// The embedded names.
        known: String,
    },
}

/// Reads a text file of at most 1 MiB.
///
/// # Errors
/// It does not exist, cannot be read, is not UTF-8 or is too large.
pub fn read(path: &Path, kind: &'static str) -> Result<Source, StoreError> {
    let unreadable = |error| StoreError::Unreadable {
        path: path.to_owned(),
        error,
    };
    let bytes = fs::metadata(path).map_err(unreadable)?.len();
    if bytes > LARGEST_FILE {
        return Err(StoreError::TooLarge {
            path: path.to_owned(),
            bytes,
            kind,
        });
    }
    Ok(Source {
        name: path.display().to_string(),
        text: fs::read_to_string(path).map_err(unreadable)?,
    })
}

/// The mission of a path or name. `missions/01-air-sample.toml`, `01-air-sample` and `01` all do.
///
/// # Errors
/// There is no such file or name, or the file cannot be read.
pub fn mission(path_or_name: &str) -> Result<Source, StoreError> {
    find("mission", path_or_name, ".toml", MISSIONS)
}

/// The pilot script of a path or name.
///
/// # Errors
/// There is no such file or name, or the file cannot be read.
pub fn pilot(path_or_name: &str) -> Result<Source, StoreError> {
    find("pilot script", path_or_name, ".pilot", PILOTS)
}

/// All missions: the embedded ones, with those of the user's folder added or in their place, by name.
pub fn missions() -> Vec<Source> {
    let mut all: BTreeMap<String, Source> = MISSIONS
        .iter()
        .map(|&(name, text)| (name.to_owned(), embedded(name, ".toml", text)))
        .collect();
    let folder = user_folder().map(|folder| folder.join("missions"));
    for entry in folder.iter().flat_map(fs::read_dir).flatten().flatten() {
        let path = entry.path();
        let name = path.file_stem().and_then(|stem| stem.to_str());
        if let Some(name) = name
            && path.extension().is_some_and(|ending| ending == "toml")
        {
            match read(&path, "mission") {
                Ok(source) => drop(all.insert(name.to_owned(), source)),
                Err(error) => tracing::warn!(%error, "a mission of the user's folder is left out"),
            }
        }
    }
    all.into_values().collect()
}

fn find(
    kind: &'static str,
    path_or_name: &str,
    ending: &str,
    known: &[(&str, &str)],
) -> Result<Source, StoreError> {
    let path = Path::new(path_or_name);
    if path.exists() {
        return read(path, kind);
    }
    let looks_like_a_path = path_or_name.contains('/') || path_or_name.ends_with(ending);
    let user = user_folder().map(|folder| {
        folder
            .join("missions")
            .join(format!("{path_or_name}{ending}"))
    });
    if let Some(user) = user.filter(|path| !looks_like_a_path && path.exists()) {
        return read(&user, kind);
    }
    let by_number = format!("{path_or_name}-");
    known
        .iter()
        .filter(|_| !looks_like_a_path)
        .find(|(name, _)| *name == path_or_name || name.starts_with(&by_number))
        .map(|&(name, text)| embedded(name, ending, text))
        .ok_or_else(|| StoreError::Unknown {
            kind,
            name: path_or_name.to_owned(),
            known: known
                .iter()
                .map(|(name, _)| *name)
                .collect::<Vec<_>>()
                .join(", "),
        })
}

fn embedded(name: &str, ending: &str, text: &str) -> Source {
    Source {
        name: format!("{name}{ending}"),
        text: text.to_owned(),
    }
}

/// The user's configuration folder (XDG on Unix), if there is a home folder at all.
fn user_folder() -> Option<PathBuf> {
    let folders = etcetera::choose_base_strategy().ok()?;
    Some(folders.config_dir().join("sortie"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mission_is_found_by_its_number() {
        let source = mission("01").expect("it is embedded");
        assert_eq!(source.name, "01-air-sample.toml");
    }

    #[test]
    fn an_unknown_mission_lists_the_known_ones() {
        let error = mission("99-nowhere").expect_err("there is none");
        assert!(error.to_string().contains("01-air-sample"), "{error}");
    }

    #[test]
    fn a_file_that_is_too_large_is_refused() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("large.toml");
        fs::write(&path, vec![b'#'; LARGEST_FILE as usize + 1]).expect("written");
        assert!(matches!(
            read(&path, "mission"),
            Err(StoreError::TooLarge { .. })
        ));
    }
}
