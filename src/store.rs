//! Files of the user and of the program: missions, pilots, designs, themes, settings, profiles, runs. The hangar itself
//! keeps the folders of its processes, and a link itself reads the recordings that it plays.
//!
//! Missions, pilot scripts, designs and themes are embedded in the program. A file of the same name in an
//! administrator's folder replaces the embedded one, one in the user's configuration folder replaces both, and a path
//! on the command line is read as it is.
//!
//! # How the parts fit
//! - Where files are: `folders`; `names` expands, lists and suggests names; `source` reads texts, `regular` refuses
//!   devices and endless files, `links` refuses links of other users.
//! - How a file is written so that no crash, full disk or other program damages it: `output` (all or nothing),
//!   `append` (always valid), `new_name` (replaces nothing).
//! - A flight: `records` writes frames and journal while it is flown, `runs` the mission's own record; `settlement`
//!   turns a finished or abandoned flight into an entry of a career, which `profiles` stores; `signature` signs
//!   records, `sharing` lets a group read results.
//! - A class: `waiting_records` are the records that a seat has to hand in, `class_records` those that the desk keeps;
//!   `class_results` reads the results from them. `exam_notes` are what the desk keeps of exams, `seals` their results.
//! - A crew: `record_tail` reads the record of the host while it grows, `record_copy` keeps it at a member.
//! - What else the user keeps: `plans`, `unsaved` (drafts), `history` (typed lines), `logs` and `transferred` (files
//!   from vehicles), `terrain`, `keys` (of MAVLink signing).

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::campaign::{MissionCourse, Offer};
use crate::grading::Rubric;
use crate::language::mission_meant;
use crate::lesson_plan::LessonMissions;
use crate::mission::Mission;
use crate::scoring::{FlownBy, MissionFile, Report};
use crate::workshop::Design;

mod append;
mod class_records;
mod class_results;
mod closed;
mod exam_notes;
mod folders;
mod hashes;
mod history;
mod keys;
mod links;
mod logs;
mod names;
mod new_name;
mod output;
mod plans;
mod profiles;
mod record_copy;
mod record_tail;
mod records;
mod regular;
mod runs;
mod seals;
mod settlement;
mod sharing;
mod signature;
mod source;
mod terrain;
#[cfg(test)]
mod tests;
mod transferred;
mod unsaved;
mod waiting_records;

pub use class_records::{ClassRecords, KeptRecord, KeptSheet};
pub use class_results::{class_flight, class_trainees};
pub use closed::{closed_folders, unreadable_below};
pub use exam_notes::ExamNotes;
pub use folders::Folders;
pub use history::History;
pub use keys::{KeyFile, KeyFileFault};
pub use links::open_own;
pub use logs::LogFolder;
pub use names::{names_in, unread, user_path};
pub use new_name::give_new_name;
pub use output::{end_of_links, is_stream, open_stream, write, write_new_output, write_output};
pub use plans::{PlanFiles, read_plan_text};
pub use profiles::{
    MendedRows, PastRun, Profile, ProfileError, ProfileFile, ProfileSettings, Profiles, Rescue,
    RunEntry,
};
pub use record_copy::RecordCopy;
pub use record_tail::RecordTail;
pub use records::{
    RecordFiles, RecordLimits, RecordPiece, RecordSignature, RecordWriter, Recording,
    RecordingFault, Records, read_log,
};
pub use runs::{RunFile, Runs, read_run, utc};
pub use seals::{DeskKey, SealedTry, check_seal, is_sealed, seal_record};
pub use settlement::{Landing, Recovery, day_of, open_profiles, open_profiles_to_read, recover};
pub use sharing::{
    PROFILES_FILE, RUNS, SharingFault, Unshared, other_owner, share_with_group, sharing_fault,
};
pub use signature::{RecordKey, RecordPublicKey, SignatureError, SignatureFault};
pub use source::{
    Source, StoreError, read, read_bytes, read_documentation, read_found, read_start,
};
pub use terrain::add_square;
pub use transferred::TransferredFiles;
pub use unsaved::UnsavedDrafts;
pub use waiting_records::WaitingRecords;

mod shipped {
    //! The embedded files: `build.rs` lists the content of `missions/` and the like, so a new file needs no
    //! further entry.

    include!(concat!(env!("OUT_DIR"), "/shipped.rs"));
}

use shipped::{DESIGNS, EXAMS, LESSONS, MISSIONS, PILOTS, RUBRICS};

const MISSION_FOLDER: &str = "missions";

/// A mission by path, by the id in its file, by name or by number, tried in this order: `missions/01-air-sample.toml`,
/// `01-air-sample` and `01` are all valid.
///
/// # Errors
/// No such mission exists, or its file cannot be read or has faults.
pub fn mission(path_or_name: &str) -> Result<Mission, StoreError> {
    let source = at_path("file-mission", path_or_name).unwrap_or_else(|| {
        let all = missions();
        let has_id = |source: &&Source| {
            Mission::parse(&source.text).is_ok_and(|mission| mission.id == path_or_name)
        };
        match all.iter().find(has_id) {
            Some(source) => Ok(source.clone()),
            None => MISSION_FILES.named(path_or_name, &all),
        }
    })?;
    Mission::parse(&source.text).map_err(|faults| StoreError::Faulty {
        file: source,
        faults,
    })
}

/// The names of the missions whose file has this id. Looking up the id finds only the first.
pub fn missions_with_id(id: &str) -> Vec<String> {
    let all = missions().into_iter();
    let same = all.filter(|it| Mission::parse(&it.text).is_ok_and(|mission| mission.id == id));
    same.map(|source| source.name).collect()
}

/// The name of the drill for a mission, without folder and ending; `None` if there is none.
pub fn drill_of(mission: &str) -> Option<String> {
    let all = missions().into_iter();
    let mut drills = all.filter(|source| {
        source.text.contains("drill_of")
            && Mission::parse(&source.text)
                .is_ok_and(|drill| drill.summary.drill_of.as_deref() == Some(mission))
    });
    drills.next().map(|source| source.stem().to_owned())
}

/// A pilot script by path, by name or by number.
///
/// # Errors
/// No such script exists, or its file cannot be read.
pub fn pilot(path_or_name: &str) -> Result<Source, StoreError> {
    at_path("file-pilot", path_or_name)
        .unwrap_or_else(|| PILOT_FILES.named(path_or_name, &PILOT_FILES.merged(PILOTS)))
}

/// A design by path or by name.
///
/// # Errors
/// No such design exists, or its file cannot be read or has faults.
pub fn design(path_or_name: &str) -> Result<Design, StoreError> {
    let source = at_path("file-design", path_or_name)
        .unwrap_or_else(|| DESIGN_FILES.named(path_or_name, &designs()))?;
    Design::from_toml(&source.text).map_err(|faults| StoreError::Faulty {
        file: source,
        faults,
    })
}

/// All designs by name: the embedded designs, and those in the folders, which may replace embedded
/// ones.
pub fn designs() -> Vec<Source> {
    DESIGN_FILES.merged(DESIGNS)
}

/// All lesson plans by name: the embedded ones, and those in the folders, which may replace embedded ones.
pub fn lessons() -> Vec<Source> {
    LESSON_FILES.merged(LESSONS)
}

/// The file of a lesson plan, by its path or its name.
///
/// # Errors
/// No such plan exists, or it cannot be read.
pub fn lesson(path_or_name: &str) -> Result<Source, StoreError> {
    at_path("file-lesson", path_or_name)
        .unwrap_or_else(|| LESSON_FILES.named(path_or_name, &lessons()))
}

/// All exams by name: the embedded ones, and those in the folders, which may replace embedded ones.
pub fn exams() -> Vec<Source> {
    EXAM_FILES.merged(EXAMS)
}

/// The file of an exam, by its path or its name.
///
/// # Errors
/// No such exam exists, or it cannot be read.
pub fn exam(path_or_name: &str) -> Result<Source, StoreError> {
    at_path("file-exam", path_or_name).unwrap_or_else(|| EXAM_FILES.named(path_or_name, &exams()))
}

/// All rubrics by name: the embedded ones, and those in the folders, which may replace embedded ones.
pub fn rubrics() -> Vec<Source> {
    RUBRIC_FILES.merged(RUBRICS)
}

/// The rubric with this name.
///
/// # Errors
/// No such rubric exists, or it has faults.
pub fn rubric(name: &str) -> Result<Rubric, StoreError> {
    let source = RUBRIC_FILES.named(name, &rubrics())?;
    Rubric::parse(source.stem(), &source.text).map_err(|faults| StoreError::Faulty {
        file: source,
        faults,
    })
}

/// The missions that lessons may fly.
pub fn lesson_missions() -> LessonMissions {
    LessonMissions::of(missions().iter().map(|source| source.text.as_str()))
}

/// All missions by name: the embedded missions, and those in the folders, which may replace
/// embedded ones.
pub fn missions() -> Vec<Source> {
    MISSION_FILES.merged(MISSIONS)
}

/// The errors of the unreadable mission files in the folders.
pub fn unreadable_missions() -> Vec<StoreError> {
    MISSION_FILES.unreadable()
}

/// The missions of the course, by name: the embedded ones, and those that the administrator's
/// folders add. A file with the id of an embedded mission adds nothing, nor does a file in the
/// user's own folders: such files are flown for practice. Files that cannot be read are left out.
fn course_missions() -> Vec<Mission> {
    course_missions_with(Folders::find().as_ref())
}

fn course_missions_with(folders: Option<&Folders>) -> Vec<Mission> {
    let is_embedded = |id: &str| MISSIONS.iter().any(|(name, _)| *name == id);
    let mut sources: BTreeMap<String, Source> = MISSIONS
        .iter()
        .map(|&(name, text)| (name.to_owned(), embedded(name, "toml", text)))
        .collect();
    let layers = folders.into_iter().flat_map(Folders::system_layers);
    let added = layers.flat_map(|layer| files(&layer.join(MISSION_FOLDER), "file-mission", "toml"));
    for source in added {
        if !is_embedded(source.stem()) {
            sources.insert(source.stem().to_owned(), source);
        }
    }
    let mut known: Vec<Mission> = Vec::new();
    for (name, source) in sources {
        let Ok(mission) = Mission::parse(&source.text) else {
            continue;
        };
        // Among files with the same id, a look-up by id finds the first one.
        let stands_in = is_embedded(&mission.id) && mission.id != name;
        if !stands_in && known.iter().all(|other| other.id != mission.id) {
            known.push(mission);
        }
    }
    known
}

/// How the text of a mission compares with that of the course's mission with the same id.
pub fn mission_file(mission: &Mission) -> MissionFile {
    compared(mission, &course_missions())
}

/// The results of [`mission_file`] for several missions, in their order.
pub fn mission_files<'a>(missions: impl IntoIterator<Item = &'a Mission>) -> Vec<MissionFile> {
    let known = course_missions();
    let missions = missions.into_iter();
    missions.map(|mission| compared(mission, &known)).collect()
}

fn compared(mission: &Mission, known: &[Mission]) -> MissionFile {
    match known.iter().find(|of_course| of_course.id == mission.id) {
        None => MissionFile::Own,
        Some(of_course) if of_course.file.text == mission.file.text => MissionFile::Course,
        Some(of_course) if of_course.rev != mission.rev => MissionFile::OtherRevision,
        Some(_) => MissionFile::Altered,
    }
}

/// Completes a report with two facts from outside the flight: the drill for its mission, and how the mission compares
/// with that of the course.
pub fn complete(report: &mut Report, mission: &Mission) {
    report.drill = drill_of(&report.mission);
    report.mission_file = Some(mission_file(mission));
}

/// The kind of a pilot script: the reference pilot if the script is bundled, otherwise a script.
pub fn script_kind(pilot: &Source) -> FlownBy {
    if PILOTS.iter().any(|(_, text)| *text == pilot.text) {
        FlownBy::BundledPilot
    } else {
        FlownBy::Script
    }
}

/// The missions of the course, by name; those that cannot be read are left out.
pub fn course() -> MissionCourse {
    MissionCourse::new(course_missions().iter().map(Offer::of).collect::<Vec<_>>())
}

/// The themes in the administrator's and the user's folders.
pub fn themes() -> Vec<Source> {
    THEME_FILES.merged(&[])
}

/// The errors of the unreadable theme files in the folders.
pub fn unreadable_themes() -> Vec<StoreError> {
    THEME_FILES.unreadable()
}

/// The files with that ending in a folder, by name; those that cannot be read are left out and
/// logged.
pub fn files(folder: &Path, kind: &'static str, ending: &str) -> Vec<Source> {
    let mut sources = Vec::new();
    for file in found(folder, kind, ending) {
        match file {
            Ok(source) => sources.push(source),
            Err(error) => tracing::warn!(%error, "a file that cannot be read is left out"),
        }
    }
    sources
}

/// The files with that ending in a folder, by name, or why each cannot be read.
fn found(folder: &Path, kind: &'static str, ending: &str) -> Vec<Result<Source, StoreError>> {
    let mut paths: Vec<PathBuf> = fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|found| found == ending))
        .collect();
    paths.sort();
    paths.iter().map(|path| read_found(path, kind)).collect()
}

/// The paths with these endings in a folder and its subfolders, by name. Links to folders are not
/// followed.
pub fn paths_below(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let found = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut entries: Vec<fs::DirEntry> = found.collect();
    entries.sort_by_key(fs::DirEntry::path);
    let mut paths = Vec::new();
    for entry in entries {
        let path = entry.path();
        if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            paths.extend(paths_below(&path, endings));
        } else if path
            .extension()
            .is_some_and(|found| endings.iter().any(|ending| found == *ending))
        {
            paths.push(path);
        }
    }
    paths
}

/// The file at that path, if there is one. A folder does not count, since it may have the name of a mission; a link
/// whose file is missing counts.
fn at_path(kind: &'static str, path: &str) -> Option<Result<Source, StoreError>> {
    let path = Path::new(path);
    let is_there = path.exists() || path.is_symlink();
    (is_there && !path.is_dir()).then(|| read(path, kind))
}

/// Files of a kind in the folders of the user and of the administrator.
struct FolderFiles {
    /// The id of the message that names the kind.
    kind: &'static str,
    folder: &'static str,
    ending: &'static str,
}

const MISSION_FILES: FolderFiles = FolderFiles {
    kind: "file-mission",
    folder: MISSION_FOLDER,
    ending: "toml",
};
const PILOT_FILES: FolderFiles = FolderFiles {
    kind: "file-pilot",
    folder: "missions/pilots",
    ending: "pilot",
};
const LESSON_FILES: FolderFiles = FolderFiles {
    kind: "file-lesson",
    folder: "lessons",
    ending: "toml",
};
const EXAM_FILES: FolderFiles = FolderFiles {
    kind: "file-exam",
    folder: "exams",
    ending: "toml",
};
const RUBRIC_FILES: FolderFiles = FolderFiles {
    kind: "file-rubric",
    folder: "rubrics",
    ending: "toml",
};
const DESIGN_FILES: FolderFiles = FolderFiles {
    kind: "file-design",
    folder: "designs",
    ending: "toml",
};

const THEME_FILES: FolderFiles = FolderFiles {
    kind: "file-theme",
    folder: folders::THEMES,
    ending: "toml",
};

impl FolderFiles {
    /// All files by name: the user's own files replace the administrator's, which replace the embedded ones.
    fn merged(&self, known: &[(&str, &str)]) -> Vec<Source> {
        let mut all: BTreeMap<String, Source> = known
            .iter()
            .map(|&(name, text)| (name.to_owned(), embedded(name, self.ending, text)))
            .collect();
        if let Some(folders) = Folders::find() {
            let layers = folders.layers();
            let found =
                layers.flat_map(|layer| files(&layer.join(self.folder), self.kind, self.ending));
            all.extend(found.map(|source| (source.stem().to_owned(), source)));
        }
        all.into_values().collect()
    }

    fn unreadable(&self) -> Vec<StoreError> {
        let folders = Folders::find();
        let layers = folders.iter().flat_map(Folders::layers);
        let all = layers.flat_map(|layer| found(&layer.join(self.folder), self.kind, self.ending));
        all.filter_map(Result::err).collect()
    }

    /// The file with a name, a number, or a unique prefix.
    fn named(&self, name: &str, all: &[Source]) -> Result<Source, StoreError> {
        let names: Vec<&str> = all.iter().map(Source::stem).collect();
        let meant = mission_meant(name, &names);
        if let Some(source) = all.iter().find(|it| Some(it.stem()) == meant) {
            return Ok(source.clone());
        }
        let unreadable = self.unreadable();
        let stems: Vec<&str> = unreadable.iter().filter_map(StoreError::stem).collect();
        let meant = mission_meant(name, &stems).map(str::to_owned);
        let mut errors = unreadable.into_iter();
        let unread = errors.find(|it| meant.is_some() && it.stem() == meant.as_deref());
        Err(unread.unwrap_or_else(|| StoreError::Unknown {
            kind: self.kind,
            name: name.to_owned(),
            known: names.join(", "),
        }))
    }
}

fn embedded(name: &str, ending: &str, text: &str) -> Source {
    Source {
        name: format!("{name}.{ending}"),
        text: text.to_owned(),
    }
}
