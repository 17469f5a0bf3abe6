//! `sortie check`: faults in files, as `FILE:LINE:COLUMN`.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use toml::Spanned;
use toml::de::DeTable;

use clap::Args;

use super::{Failure, plan, settings};
use crate::app::keymap::{Keymap, Place};
use crate::config::SETTINGS;
use crate::diagnostic::{Diagnostic, nearest};
use crate::exam_plan::{EXAM_KEYS, ExamFile};
use crate::grading::{RUBRIC_KEYS, Rubric};
use crate::lesson_plan::{LESSON_KEYS, Lesson, LessonMissions, LessonSetting};
use crate::mission::Mission;
use crate::store::{self, Source, StoreError};
use crate::text;
use crate::text::{Locale, Text};
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
    Lesson,
    Exam,
    Rubric,
    Theme,
    Keymap,
    Configuration,
    Design,
    Script,
}

/// Keys that every mission file has, and other files may have.
const MISSION_KEYS: &[&str] = &["schema", "id", "title", "brief"];
/// Sections that every mission file has, and no other kind of file.
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
    let locale = Locale::new(settings.language());
    let mut faulty = report_closed(&options.files, &locale);
    // A wrong file name is a usage error, so no file is checked before all names are understood.
    files.iter().try_for_each(|path| has_known_ending(path))?;
    for path in files {
        if plan::is_plan_file(path) {
            faulty |= plan::report(path, &plan::Checking::default(), &locale)?;
            continue;
        }
        let others = OtherFiles {
            missions: &known,
            files,
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
            tell!("sortie: {}", locale.text(&Text::from(&error)));
            return Ok(true);
        }
    };
    let kind = kind(path, &source.text);
    let (faults, notes) = examined(kind, path, &source, others);
    let syntax = syntax_error(&source.text).filter(|_| kind != Some(FileKind::Script));
    for fault in &faults {
        let line = fault.text(&source.name, &source.text);
        say!("{}", locale.text(&line))?;
        // Only the place shows what is wrong with the syntax.
        if Some(fault.span.start) == syntax {
            say!("{}", fault.excerpt(&source.text))?;
        }
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

/// Prints the named folders, and those below them, that cannot be read; returns whether there are any.
fn report_closed(paths: &[PathBuf], locale: &Locale) -> bool {
    let folders = paths.iter().filter(|path| path.is_dir());
    let closed: Vec<StoreError> = folders
        .flat_map(|path| store::unreadable_below(path))
        .collect();
    for error in &closed {
        tell!("sortie: {}", locale.text(&Text::from(error)));
    }
    !closed.is_empty()
}

/// Where the syntax of a TOML file is wrong, in bytes; `None` if it is right.
fn syntax_error(text: &str) -> Option<usize> {
    DeTable::parse(text).err()?.span().map(|span| span.start)
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

struct MissionFile {
    /// The path, or the name of an embedded file.
    name: String,
    /// Whether the file is one of those to check.
    is_checked: bool,
}

/// The files with each id of a mission that other files may name.
type KnownMissions = BTreeMap<String, Vec<MissionFile>>;

/// The missions among the checked files, in their order, then the shipped ones, the user's, and those in the checked
/// files' folders and parent folders.
fn known_missions(files: &[PathBuf]) -> KnownMissions {
    let is_toml = |path: &&PathBuf| path.extension().is_some_and(|ending| ending == "toml");
    let checked = files.iter().filter(is_toml);
    let checked = checked.filter_map(|path| store::read_found(path, "file-mission").ok());
    let known = store::missions().into_iter().chain(missions_beside(files));
    let all = checked
        .map(|source| (source, true))
        .chain(known.map(|source| (source, false)));
    let mut seen = BTreeSet::new();
    let mut missions = KnownMissions::new();
    for (source, is_checked) in all {
        let Some(id) = Mission::id_of(&source.text) else {
            continue;
        };
        let name = source.name;
        // A file can be checked, the user's, and beside another one.
        let is_new = fs::canonicalize(&name).map_or(true, |path| seen.insert(path));
        if is_new {
            let same = missions.entry(id).or_default();
            same.push(MissionFile { name, is_checked });
        }
    }
    missions
}

/// The missions in the files' folders and parent folders.
fn missions_beside(files: &[PathBuf]) -> impl Iterator<Item = Source> {
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
    folders
        .into_iter()
        .flat_map(|folder| store::files(folder, "file-mission", "toml"))
}

/// Another file with a mission's id: a checked one listed before `path`, otherwise one that is not
/// checked. Files with the same name do not count, because one replaces the other.
fn same_id<'a>(path: &Path, id: &str, missions: &'a KnownMissions) -> Option<&'a MissionFile> {
    let same = missions.get(id)?;
    let at = same
        .iter()
        .position(|it| Path::new(&it.name) == path)
        .unwrap_or(same.len());
    let is_other = |it: &&MissionFile| Path::new(&it.name).file_name() != path.file_name();
    let mut before = same.iter().take(at).filter(|it| it.is_checked);
    let first = before.find(is_other);
    first.or_else(|| same.iter().filter(|it| !it.is_checked).find(is_other))
}

fn has_known_ending(path: &Path) -> Result<(), Failure> {
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("toml" | "pilot") => Ok(()),
        _ if plan::is_plan_file(path) => Ok(()),
        _ => {
            let file = path.display().to_string();
            Err(Failure::Wrong(vec![text!("check-ending", file = file)]))
        }
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
    let mission = [MISSION_KEYS, MISSION_SECTIONS].concat();
    let kinds: [(FileKind, &str, &[&str]); 8] = [
        (FileKind::Mission, "missions", &mission),
        (FileKind::Lesson, "lessons", &LESSON_KEYS),
        (FileKind::Exam, "exams", &EXAM_KEYS),
        (FileKind::Rubric, "rubrics", &RUBRIC_KEYS),
        (FileKind::Design, "designs", &design),
        (FileKind::Theme, "themes", &["inherits", "roles"]),
        (FileKind::Keymap, "keymap", &contexts),
        (FileKind::Configuration, "config", &settings),
    ];
    let likeness = |&(kind, place, known): &(FileKind, &str, &[&str])| {
        let is_folder = folder.is_some_and(|folder| folder == place);
        let hint = is_folder || path.file_stem().is_some_and(|stem| stem == place);
        // A room and a table of settings can have the same name, such as `class`.
        let is_settings = kind == FileKind::Configuration && has_setting(table.get_ref());
        (matches(&keys, known), hint, is_settings)
    };
    let best = kinds.iter().rev().max_by_key(|kind| likeness(kind))?;
    let is_shown = match (best.0, likeness(best)) {
        (_, (0, false, _)) => false,
        // Other files have ids and titles, too.
        (FileKind::Mission, (_, false, _)) => matches(&keys, MISSION_SECTIONS) > 0,
        _ => true,
    };
    is_shown.then_some(best.0)
}

/// Whether a file has a setting in one of its tables.
fn has_setting(file: &DeTable<'_>) -> bool {
    let is_there = |name: &str| {
        let (table, key) = name.split_once('.')?;
        file.get(table)?.get_ref().as_table()?.get(key)
    };
    SETTINGS.iter().any(|it| is_there(it.name).is_some())
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
    missions: &'a KnownMissions,
    /// The files to check, with the content of folders.
    files: &'a [PathBuf],
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
        FileKind::Theme => theme_faults(path, source),
        FileKind::Keymap => {
            let themes = settings::theme_names(&settings::themes());
            Keymap::default().overlay(text, &themes).err()
        }
        FileKind::Configuration => settings::faults_in(source, &settings::themes()),
        FileKind::Mission => match Mission::parse(text) {
            Ok(mission) => return examined_mission(path, mission, others.missions),
            Err(faults) => Some(faults),
        },
        FileKind::Lesson => match lesson(path, text, others.files) {
            Ok(lesson) => return (Vec::new(), lesson.untranslated),
            Err(faults) => Some(faults),
        },
        FileKind::Exam => match ExamFile::parse(&name_of(path), text, &store::course()) {
            Ok(exam) => return (Vec::new(), exam.untranslated),
            Err(faults) => Some(faults),
        },
        FileKind::Rubric => match Rubric::parse(&name_of(path), text) {
            Ok(rubric) => return (Vec::new(), rubric.untranslated),
            Err(faults) => Some(faults),
        },
        FileKind::Design => Design::from_toml(text).err(),
        FileKind::Script => script::faults(path, text, others.named),
    };
    (faults.unwrap_or_default(), Vec::new())
}

/// Reads a lesson plan. Its missions may be among the checked files, or beside them.
fn lesson(path: &Path, text: &str, files: &[PathBuf]) -> Result<Lesson, Vec<Diagnostic>> {
    let checked = files
        .iter()
        .filter_map(|path| store::read_found(path, "file-mission").ok());
    let known = checked
        .chain(store::missions())
        .chain(missions_beside(files));
    let known: Vec<String> = known.map(|source| source.text).collect();
    let missions = LessonMissions::of(known.iter().map(String::as_str));
    let setting = LessonSetting {
        missions: &missions,
        locale: &Locale::default(),
    };
    Lesson::parse(&name_of(path), text, &setting)
}

/// The name by which the desk knows a file.
fn name_of(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default();
    stem.to_string_lossy().into_owned()
}

fn theme_faults(path: &Path, source: &Source) -> Option<Vec<Diagnostic>> {
    let mut themes = settings::themes();
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    // A theme may inherit from the themes beside it.
    settings::add_themes(
        &mut themes,
        store::files(folder.unwrap_or(Path::new(".")), "file-theme", "toml"),
    );
    themes.read(source.stem(), &source.text).err()
}

/// The faults and the notes of a mission that can be read. An id that another checked file already
/// has is a fault; an id of a mission that is not checked is only a note, because the checked file
/// may replace that mission for practice.
fn examined_mission(
    path: &Path,
    mission: Mission,
    missions: &KnownMissions,
) -> (Vec<Diagnostic>, Vec<Diagnostic>) {
    let known: BTreeSet<String> = missions.keys().cloned().collect();
    let mut faults = mission.check();
    faults.extend(mission.unknown_missions(&known));
    let (table, _) = DeTable::parse_recoverable(&mission.file.text);
    let place = table.get_ref().get("id").map_or(0..0, Spanned::span);
    let mut notes = mission.file.untranslated;
    if let Some(other) = same_id(path, &mission.id, missions) {
        let (id, file) = (mission.id.as_str(), other.name.as_str());
        if other.is_checked {
            let fault = Diagnostic::new(place, text!("check-same-id", id = id, file = file));
            faults.push(fault.with_help(text!("check-same-id-help")));
        } else {
            let note = Diagnostic::new(place, text!("check-known-id", id = id, file = file));
            notes.push(note.with_help(text!("check-known-id-help")));
        }
    }
    faults.sort_by_key(|fault| fault.span.start);
    notes.sort_by_key(|note| note.span.start);
    (faults, notes)
}
