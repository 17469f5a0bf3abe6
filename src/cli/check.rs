//! `sortie check`: faults in files, as `FILE:LINE:COLUMN`.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use toml::de::DeTable;

use clap::Args;

use super::{Failure, plan, settings};
use crate::app::keymap::{Keymap, Place};
use crate::config::SETTINGS;
use crate::diagnostic::{Diagnostic, nearest};
use crate::mission::Mission;
use crate::store::{self, Source};
use crate::text;
use crate::text::Locale;
use crate::workshop::{Design, PartSlot};

mod fly;
mod script;

/// Options of `sortie check`.
#[derive(Debug, Args)]
pub(super) struct CheckArguments {
    /// Files that end in .pilot or .toml, or folders of such files; the content of a .toml file shows which kind it is.
    /// Plans: .plan, .waypoints, .fence, .rally, .kml, .kmz, .geojson; `sortie plan check` has more options for them.
    #[arg(required_unless_present_any = ["fly", "schema", "reference"], value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Fly missions with their reference pilot, a naive pilot and no pilot: the first must earn silver, the second
    /// must not earn a medal, and the third must neither pass nor score. The scripts are MISSION.pilot and
    /// NN-naive.pilot, next to the mission's file, in the folder `pilots` there, or among the shipped scripts.
    #[arg(long, value_name = "MISSION", num_args = 1.., conflicts_with = "files")]
    fly: Vec<String>,
    /// Fly this many seeds, starting with 1.
    #[arg(long, default_value_t = 5, requires = "fly", value_parser = clap::value_parser!(u64).range(1..=1000))]
    seeds: u64,
    /// Print the JSON schema of mission files, for editors.
    #[arg(long, conflicts_with_all = ["files", "fly"])]
    schema: bool,
    /// Print the reference of mission files, as the mission guide contains it.
    #[arg(long, conflicts_with_all = ["files", "fly", "schema"])]
    reference: bool,
    /// Print one JSON document instead of the table.
    #[arg(long, requires = "fly")]
    json: bool,
}

/// The intended kind of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum FileKind {
    Mission,
    Theme,
    Keymap,
    Configuration,
    Design,
    Script,
}

/// Keys that every mission file has; the last ones are sections that no other kind of file has.
const MISSION_KEYS: &[&str] = &[
    "schema",
    "id",
    "title",
    "brief",
    "sim",
    "fleet",
    "objectives",
    "scoring",
];
const MISSION_SECTIONS: &[&str] = &["sim", "fleet", "objectives", "scoring"];

/// Prints the faults of each file, or the results of flown missions; exit code 1 if there is any fault.
pub(super) fn check(
    options: &CheckArguments,
    settings: &settings::CliSettings,
) -> Result<ExitCode, Failure> {
    if options.schema {
        say!("{}", crate::mission::schema())?;
        return Ok(ExitCode::SUCCESS);
    }
    if options.reference {
        say!("{}", crate::mission::reference())?;
        return Ok(ExitCode::SUCCESS);
    }
    if !options.fly.is_empty() {
        return fly::fly(&options.fly, options.seeds, options.json);
    }
    let files = &unfolded(&options.files);
    let known = known_missions(files);
    let ids = first_with_ids(files);
    let locale = Locale::new(settings.language());
    let mut faulty = false;
    // A wrong file name is a usage error, so no file is checked before all names are understood.
    files.iter().try_for_each(|path| has_known_ending(path))?;
    for path in files {
        if plan::is_plan_file(path) {
            faulty |= plan::report(path, &plan::Checking::default(), &locale)?;
            continue;
        }
        let others = OtherFiles {
            missions: &known,
            ids: &ids,
            named: &options.files,
        };
        faulty |= report(path, &others, &locale)?;
    }
    Ok(ExitCode::from(u8::from(faulty)))
}

/// Prints the faults and notes of a file; returns whether it has a fault.
fn report(path: &Path, others: &OtherFiles<'_>, locale: &Locale) -> Result<bool, Failure> {
    let source = match store::read_found(path, "file-any") {
        Ok(source) => source,
        Err(error) => {
            tell!("sortie: {error}");
            return Ok(true);
        }
    };
    let kind = kind(path, &source.text);
    let (faults, notes) = examined(kind, path, &source, others);
    for fault in &faults {
        let line = fault.text(&source.name, &source.text);
        say!("{}", locale.text(&line))?;
    }
    for note in &notes {
        let line = note.text(&source.name, &source.text);
        say!("{}", locale.text(&text!("check-note", line = line)))?;
    }
    if faults.is_empty() {
        let good = text!("check-good", file = source.name.as_str());
        say!("{}", locale.text(&good))?;
    }
    Ok(!faults.is_empty())
}

/// The files, with folders replaced by their content.
fn unfolded(paths: &[PathBuf]) -> Vec<PathBuf> {
    let inside = |path: &PathBuf| {
        if path.is_dir() {
            store::paths_below(path, &["toml", "pilot"])
        } else {
            vec![path.clone()]
        }
    };
    paths.iter().flat_map(inside).collect()
}

/// The ids of missions that other files may name: the shipped ones, the user's, the checked ones, and those in the
/// checked files' folders and parent folders.
fn known_missions(files: &[PathBuf]) -> BTreeSet<String> {
    let own = files.iter().filter_map(|path| path.parent());
    let folders: BTreeSet<&Path> = own
        .flat_map(|folder| [Some(folder), folder.parent()])
        .flatten()
        .map(|folder| {
            if folder.as_os_str().is_empty() {
                Path::new(".")
            } else {
                folder
            }
        })
        .collect();
    let beside = folders
        .into_iter()
        .flat_map(|folder| store::files(folder, "file-mission", "toml"));
    let all = store::missions().into_iter().chain(beside);
    all.filter_map(|source| Mission::id_of(&source.text))
        .collect()
}

/// The first of these files with each mission's id.
fn first_with_ids(files: &[PathBuf]) -> BTreeMap<String, PathBuf> {
    let mut first = BTreeMap::new();
    for path in files {
        let source = store::read_found(path, "file-mission").ok();
        if let Some(id) = source.and_then(|source| Mission::id_of(&source.text)) {
            first.entry(id).or_insert_with(|| path.clone());
        }
    }
    first
}

/// The fault of a mission whose id another file has already. A file of the same name replaces the other one.
fn same_id(path: &Path, source: &Source, others: &OtherFiles<'_>) -> Option<Diagnostic> {
    let id = Mission::id_of(&source.text)?;
    let first = others.ids.get(&id)?;
    if first.file_name() == path.file_name() {
        return None;
    }
    let (table, _) = DeTable::parse_recoverable(&source.text);
    let span = table.get_ref().get("id")?.span();
    let first = first.display().to_string();
    let fault = Diagnostic::new(span, text!("check-same-id", id = id, file = first));
    Some(fault.with_help(text!("check-same-id-help")))
}

fn has_known_ending(path: &Path) -> Result<(), Failure> {
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("toml" | "pilot") => Ok(()),
        _ if plan::is_plan_file(path) => Ok(()),
        _ => Err(Failure::Invalid(format!(
            "sortie: cannot tell the kind of {}: expected a name ending in .toml, .pilot or that of a plan (.plan, .waypoints, .kml ..)",
            path.display()
        ))),
    }
}

/// The kind of a file. A TOML file is of the kind to which most of its first-level keys belong; if
/// the keys do not decide, its name and its folder do. `None` if nothing shows its kind.
fn kind(path: &Path, text: &str) -> Option<FileKind> {
    if path.extension().is_some_and(|ending| ending == "pilot") {
        return Some(FileKind::Script);
    }
    // The keys of a faulty file still show its kind.
    let (table, _) = DeTable::parse_recoverable(text);
    let keys: Vec<&str> = table
        .get_ref()
        .keys()
        .map(|key| key.get_ref().as_ref())
        .collect();
    let folder = path.parent().and_then(Path::file_name);
    let settings: Vec<&str> = SETTINGS
        .iter()
        .map(|it| it.name.split('.').next().unwrap_or_default())
        .collect();
    let contexts: Vec<&str> = Place::all().map(Place::name).collect();
    let slots = PartSlot::ALL.map(PartSlot::key);
    let design: Vec<&str> = ["schema", "name"].into_iter().chain(slots).collect();
    let kinds: [(FileKind, &str, &[&str]); 5] = [
        (FileKind::Mission, "missions", MISSION_KEYS),
        (FileKind::Design, "designs", &design),
        (FileKind::Theme, "themes", &["inherits", "roles"]),
        (FileKind::Keymap, "keymap", &contexts),
        (FileKind::Configuration, "config", &settings),
    ];
    let likeness = |&(_, place, known): &(FileKind, &str, &[&str])| {
        let is_folder = folder.is_some_and(|folder| folder == place);
        let hint = is_folder || path.file_stem().is_some_and(|stem| stem == place);
        (matches(&keys, known), hint)
    };
    let best = kinds.iter().rev().max_by_key(|kind| likeness(kind))?;
    let is_shown = match (best.0, likeness(best)) {
        (_, (0, false)) => false,
        // Other files have ids and titles, too.
        (FileKind::Mission, (_, false)) => matches(&keys, MISSION_SECTIONS) > 0,
        _ => true,
    };
    is_shown.then_some(best.0)
}

/// The number of keys that are among the known ones. A misspelt key counts, with half the weight.
fn matches(keys: &[&str], known: &[&str]) -> usize {
    let weight = |key: &&str| match nearest(key, known.iter().copied()) {
        Some(name) if name == *key => 2,
        Some(_) => 1,
        None => 0,
    };
    keys.iter().map(weight).sum()
}

/// The other files that a file may refer to.
struct OtherFiles<'a> {
    missions: &'a BTreeSet<String>,
    /// The first of the checked files with each mission's id.
    ids: &'a BTreeMap<String, PathBuf>,
    /// All files that the command line names.
    named: &'a [PathBuf],
}

/// The faults of a file, and remarks that are not faults.
fn examined(
    kind: Option<FileKind>,
    path: &Path,
    source: &Source,
    others: &OtherFiles<'_>,
) -> (Vec<Diagnostic>, Vec<Diagnostic>) {
    let text = &source.text;
    let Some(kind) = kind else {
        let fault = Diagnostic::new(0..0, text!("check-kind"));
        return (vec![fault.with_help(text!("check-kind-help"))], Vec::new());
    };
    let faults = match kind {
        FileKind::Theme => {
            let mut themes = settings::themes();
            let folder = path
                .parent()
                .filter(|folder| !folder.as_os_str().is_empty());
            // A theme may inherit from the themes beside it.
            settings::add_themes(
                &mut themes,
                store::files(folder.unwrap_or(Path::new(".")), "file-theme", "toml"),
            );
            themes.read(source.stem(), text).err()
        }
        FileKind::Keymap => {
            let themes = settings::theme_names(&settings::themes());
            Keymap::default().overlay(text, &themes).err()
        }
        FileKind::Configuration => settings::faults_in(source, &settings::themes()),
        FileKind::Mission => match Mission::parse(text) {
            Ok(mission) => {
                let mut faults = mission.check();
                faults.extend(mission.unknown_missions(others.missions));
                faults.extend(same_id(path, source, others));
                faults.sort_by_key(|fault| fault.span.start);
                return (faults, mission.file.untranslated);
            }
            Err(faults) => Some(faults),
        },
        FileKind::Design => Design::from_toml(text).err(),
        FileKind::Script => script::faults(path, text, others.named),
    };
    (faults.unwrap_or_default(), Vec::new())
}
