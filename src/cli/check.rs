//! `sortie check`: faults in files, as `FILE:LINE:COLUMN`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::Failure;
use crate::diagnostic::Diagnostic;
use crate::language::{Context, Script};
use crate::mission::Mission;
use crate::store;
use crate::ui::Theme;
use crate::vehicle::VehicleClass;

/// Prints what is wrong with each file; exit code 1 when anything is.
pub(super) fn check(files: &[PathBuf]) -> Result<ExitCode, Failure> {
    let mut faulty = false;
    for path in files {
        let source = store::read(path, "mission, theme or script")?;
        let faults = faults(path, &source.text)?;
        for fault in &faults {
            println!("{}", fault.one_line(&source.name, &source.text));
        }
        if faults.is_empty() {
            println!("{}: good", source.name);
        }
        faulty |= !faults.is_empty();
    }
    Ok(ExitCode::from(u8::from(faulty)))
}

fn faults(path: &Path, text: &str) -> Result<Vec<Diagnostic>, Failure> {
    let is_theme = path
        .parent()
        .and_then(Path::file_name)
        .is_some_and(|folder| folder == "themes");
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("toml") if is_theme => Ok(Theme::parse(text).err().unwrap_or_default()),
        Some("toml") => Ok(Mission::parse(text).err().unwrap_or_default()),
        Some("pilot") => {
            let (groups, places) = (BTreeMap::new(), BTreeMap::new());
            let context = Context {
                groups: &groups,
                places: &places,
                vehicles: &[],
                class: VehicleClass::Copter,
            };
            Ok(Script::parse(text, &context).err().unwrap_or_default())
        }
        _ => Err(Failure::Invalid(format!(
            "sortie: cannot tell what {} is: expected a name ending in .toml or .pilot",
            path.display()
        ))),
    }
}
