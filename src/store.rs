//! Files of the user and of the program: missions, pilots, designs, themes, settings, profiles, runs. The hangar itself
//! keeps the folders of its processes, and a link itself reads the recordings that it plays.
//!
//! Missions, pilot scripts, designs and themes are embedded in the program. A file of the same name in an
//! administrator's folder replaces the embedded one, one in the user's configuration folder replaces both, and a path
//! on the command line is read as it is.
//!
//! # How the parts fit
//! - Where files are: `folders`; `layered` finds those that ship or replace what ships; `names` expands, lists and
//!   suggests names; `source` reads texts, `regular` refuses devices and endless files, `links` refuses links of other
//!   users.
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

use crate::campaign::{MissionCourse, Offer};
use crate::grading::Rubric;
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
mod layered;
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
use layered::LayeredFiles;
pub use layered::{files, paths_below};
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

const MISSION_FILES: LayeredFiles = LayeredFiles {
    kind: "file-mission",
    folder: "missions",
    ending: "toml",
    shipped: MISSIONS,
};
const PILOT_FILES: LayeredFiles = LayeredFiles {
    kind: "file-pilot",
    folder: "missions/pilots",
    ending: "pilot",
    shipped: PILOTS,
};
const LESSON_FILES: LayeredFiles = LayeredFiles {
    kind: "file-lesson",
    folder: "lessons",
    ending: "toml",
    shipped: LESSONS,
};
const EXAM_FILES: LayeredFiles = LayeredFiles {
    kind: "file-exam",
    folder: "exams",
    ending: "toml",
    shipped: EXAMS,
};
const RUBRIC_FILES: LayeredFiles = LayeredFiles {
    kind: "file-rubric",
    folder: "rubrics",
    ending: "toml",
    shipped: RUBRICS,
};
const DESIGN_FILES: LayeredFiles = LayeredFiles {
    kind: "file-design",
    folder: "designs",
    ending: "toml",
    shipped: DESIGNS,
};
const THEME_FILES: LayeredFiles = LayeredFiles {
    kind: "file-theme",
    folder: folders::THEMES,
    ending: "toml",
    shipped: &[],
};

/// A mission by path, by the id in its file, by name or by number, tried in this order: `missions/01-air-sample.toml`,
/// `01-air-sample` and `01` are all valid.
///
/// # Errors
/// No such mission exists, or its file cannot be read or has faults.
pub fn mission(path_or_name: &str) -> Result<Mission, StoreError> {
    let source = MISSION_FILES.at_path(path_or_name).unwrap_or_else(|| {
        let all = missions();
        let has_id = |source: &&Source| {
            Mission::parse(&source.text).is_ok_and(|mission| mission.id == path_or_name)
        };
        match all.iter().find(has_id) {
            Some(source) => Ok(source.clone()),
            None => MISSION_FILES.named(path_or_name),
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
    PILOT_FILES.find(path_or_name)
}

/// A design by path or by name.
///
/// # Errors
/// No such design exists, or its file cannot be read or has faults.
pub fn design(path_or_name: &str) -> Result<Design, StoreError> {
    let source = DESIGN_FILES.find(path_or_name)?;
    Design::from_toml(&source.text).map_err(|faults| StoreError::Faulty {
        file: source,
        faults,
    })
}

/// All designs by name: the embedded designs, and those in the folders, which may replace embedded
/// ones.
pub fn designs() -> Vec<Source> {
    DESIGN_FILES.all()
}

/// All lesson plans by name: the embedded ones, and those in the folders, which may replace embedded ones.
pub fn lessons() -> Vec<Source> {
    LESSON_FILES.all()
}

/// The file of a lesson plan, by its path or its name.
///
/// # Errors
/// No such plan exists, or it cannot be read.
pub fn lesson(path_or_name: &str) -> Result<Source, StoreError> {
    LESSON_FILES.find(path_or_name)
}

/// All exams by name: the embedded ones, and those in the folders, which may replace embedded ones.
pub fn exams() -> Vec<Source> {
    EXAM_FILES.all()
}

/// The file of an exam, by its path or its name.
///
/// # Errors
/// No such exam exists, or it cannot be read.
pub fn exam(path_or_name: &str) -> Result<Source, StoreError> {
    EXAM_FILES.find(path_or_name)
}

/// All rubrics by name: the embedded ones, and those in the folders, which may replace embedded ones.
pub fn rubrics() -> Vec<Source> {
    RUBRIC_FILES.all()
}

/// The rubric with this name.
///
/// # Errors
/// No such rubric exists, or it has faults.
pub fn rubric(name: &str) -> Result<Rubric, StoreError> {
    let source = RUBRIC_FILES.named(name)?;
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
    MISSION_FILES.all()
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
    let embedded = MISSION_FILES.embedded();
    let is_embedded = |id: &str| embedded.contains_key(id);
    let mut sources = embedded.clone();
    let added = folders.into_iter();
    for source in added.flat_map(|folders| MISSION_FILES.of_administrator(folders)) {
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
    THEME_FILES.all()
}

/// The errors of the unreadable theme files in the folders.
pub fn unreadable_themes() -> Vec<StoreError> {
    THEME_FILES.unreadable()
}
