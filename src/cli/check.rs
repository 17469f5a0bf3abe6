//! `sortie check`: faults in files, as `FILE:LINE:COLUMN`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::Failure;
use crate::diagnostic::Diagnostic;
use crate::language::{Context, Script};
use crate::mission::Mission;
use crate::store;
use crate::ui::Theme;

/// What a file is meant to be, by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Mission,
    Theme,
    Script,
}

/// Prints what is wrong with each file; exit code 1 when anything is.
pub(super) fn check(files: &[PathBuf]) -> Result<ExitCode, Failure> {
    let mut faulty = false;
    // Names are the caller's to put right, so nothing is checked before all are understood.
    let kinds: Vec<Kind> = files
        .iter()
        .map(|path| kind(path))
        .collect::<Result<_, _>>()?;
    for (path, kind) in files.iter().zip(kinds) {
        match store::read(path, "mission, theme or script") {
            Ok(source) => {
                let (faults, notes) = examined(kind, &source.text);
                for fault in &faults {
                    say!("{}", fault.one_line(&source.name, &source.text))?;
                }
                for note in &notes {
                    let line = note.one_line(&source.name, &source.text);
                    say!("{line} (a note, no fault)")?;
                }
                if faults.is_empty() {
                    say!("{}: good", source.name)?;
                }
                faulty |= !faults.is_empty();
            }
            Err(error) => {
                eprintln!("sortie: {error}");
                faulty = true;
            }
        }
    }
    Ok(ExitCode::from(u8::from(faulty)))
}

fn kind(path: &Path) -> Result<Kind, Failure> {
    let is_theme = path
        .parent()
        .and_then(Path::file_name)
        .is_some_and(|folder| folder == "themes");
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("toml") if is_theme => Ok(Kind::Theme),
        Some("toml") => Ok(Kind::Mission),
        Some("pilot") => Ok(Kind::Script),
        _ => Err(Failure::Invalid(format!(
            "sortie: cannot tell what {} is: expected a name ending in .toml or .pilot",
            path.display()
        ))),
    }
}

/// Faults, and what is only worth a word.
fn examined(kind: Kind, text: &str) -> (Vec<Diagnostic>, Vec<Diagnostic>) {
    let faults = match kind {
        Kind::Theme => Theme::parse(text).err(),
        Kind::Mission => match Mission::parse(text) {
            Ok(mission) => return (Vec::new(), mission.untranslated),
            Err(faults) => Some(faults),
        },
        Kind::Script => {
            // Which mission it will fly, nobody has said: its places may have any name.
            let context = Context {
                places: None,
                ..Context::default()
            };
            Script::parse(text, &context).err()
        }
    };
    (faults.unwrap_or_default(), Vec::new())
}
