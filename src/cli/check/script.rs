//! Finds the mission of a pilot's script, from which the check takes places and vehicles.

use std::path::{Path, PathBuf};

use crate::diagnostic::Diagnostic;
use crate::language::{Context, Script};
use crate::mission::Mission;
use crate::store;

/// The faults of a script, given the other files; `None` if it has none.
pub(super) fn faults(script: &Path, text: &str, named: &[PathBuf]) -> Option<Vec<Diagnostic>> {
    if let Some(mission) = mission_of(script, named) {
        return crate::exercise::read_script(text, &mission).err();
    }
    // Without a known mission, places may have any name.
    let context = Context {
        places: None,
        areas: None,
        ..Context::default()
    };
    Script::parse(text, &context).err()
}

/// The mission with the script's id or number in the same folder, its parent folder or `../drills`;
/// otherwise the only mission named on the command line.
fn mission_of(script: &Path, named: &[PathBuf]) -> Option<Mission> {
    let stem = script.file_stem()?.to_str()?;
    let number = stem.split('-').next()?;
    let folder = script.parent().unwrap_or(Path::new(""));
    let folders = [".", "..", "../drills"].map(|within| folder.join(within));
    let files = folders
        .iter()
        .flat_map(|folder| store::files(folder, "file-mission", "toml"));
    let beside: Vec<(String, String)> = files
        .filter_map(|source| Some((Mission::id_of(&source.text)?, source.text)))
        .collect();
    let has_number = |id: &str| id.split('-').next() == Some(number);
    let exact = beside.iter().find(|(id, _)| id == stem);
    let mut numbered = beside.iter().filter(|(id, _)| has_number(id));
    let only = numbered.next().filter(|_| numbered.next().is_none());
    let text = exact.or(only).map(|(_, text)| text.clone());
    Mission::parse(&text.or_else(|| only_mission(named))?).ok()
}

/// The text of the only mission among the files, if all others are scripts.
fn only_mission(named: &[PathBuf]) -> Option<String> {
    let is_script = |path: &&PathBuf| path.extension().is_some_and(|ending| ending == "pilot");
    let mut others = named.iter().filter(|path| !is_script(path));
    let mission = others.next().filter(|_| others.next().is_none())?;
    let source = store::read(mission, "file-any").ok()?;
    Mission::id_of(&source.text).map(|_| source.text)
}
