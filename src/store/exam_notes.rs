//! What a desk keeps of the exams of its class: a file of notes for each, which only its owner may read, because it has
//! the secret of the seeds.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read as _, Seek as _, SeekFrom, Write as _};
use std::os::unix::fs::OpenOptionsExt as _;
use std::path::{Path, PathBuf};

use super::{ClassRecords, sharing};
use crate::campaign::MissionCourse;
use crate::class::{Exam, ExamDeed, ExamNote};
use crate::exam_plan::ExamFile;
use crate::text;
use crate::text::Text;

/// The folder of the notes in that of a class. No trainee's folder begins with a dot.
const EXAMS: &str = ".exams";
const ENDING: &str = ".jsonl";
/// The last second of the year 9999, in seconds since 1970.
const LAST_TIME: u64 = 253_402_300_799;

/// The notes of a class's exams.
#[derive(Debug)]
pub struct ExamNotes {
    folder: PathBuf,
    /// The file to which notes were added last.
    open: Option<OpenNotes>,
}

/// An open file of notes, which ends with a whole line.
#[derive(Debug)]
struct OpenNotes {
    begun: u64,
    file: File,
    len: u64,
}

impl ExamNotes {
    /// The notes of a class.
    pub fn of(records: &ClassRecords) -> Self {
        Self {
            folder: records.folder().join(EXAMS),
            open: None,
        }
    }

    /// Adds notes to those of the exam that began at a time.
    ///
    /// # Errors
    /// The file cannot be written; what was there stays.
    pub fn append(&mut self, begun: u64, notes: &[ExamNote]) -> io::Result<()> {
        let mut lines = String::new();
        for note in notes {
            lines.push_str(&serde_json::to_string(note)?);
            lines.push('\n');
        }
        let known = self.open.take().filter(|it| it.begun == begun);
        let mut open = known.map_or_else(|| self.open(begun), Ok)?;
        let written = open.file.write_all(lines.as_bytes());
        if let Err(error) = written.and_then(|()| open.file.sync_data()) {
            // On an unavailable disk, this may fail too; then it is removed when the file is opened again.
            drop(open.file.set_len(open.len));
            return Err(error);
        }
        open.len += lines.len() as u64;
        self.open = Some(open);
        Ok(())
    }

    /// Opens the notes of the exam that began at a time, and removes a line that a crash has cut off.
    fn open(&self, begun: u64) -> io::Result<OpenNotes> {
        sharing::private_folder(&self.folder)?;
        let path = self.path(begun);
        let mut options = OpenOptions::new();
        options.create(true).read(true).append(true).mode(0o600);
        let mut file = options.open(path)?;
        let len = whole_lines(&mut file)?;
        file.set_len(len)?;
        Ok(OpenNotes { begun, file, len })
    }

    fn path(&self, begun: u64) -> PathBuf {
        self.folder.join(format!("{begun}{ENDING}"))
    }

    /// The exam that began at a time; `None` if nothing of it was written. `epoch` is the time since 1970 at which the
    /// desk's own clock was 0.
    ///
    /// # Errors
    /// Its notes are damaged: what follows from them is not known.
    pub fn exam(
        &self,
        begun: u64,
        course: &MissionCourse,
        epoch: u64,
    ) -> Result<Option<Exam>, Text> {
        read(&self.path(begun), course, epoch)
    }

    /// All exams of the class, oldest first, and what is wrong with the notes of others. `epoch` is the time since 1970
    /// at which the desk's own clock was 0.
    pub fn all(&self, course: &MissionCourse, epoch: u64) -> (Vec<Exam>, Vec<Text>) {
        let entries = fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let mut paths: Vec<PathBuf> = entries
            .map(|entry| entry.path())
            .filter(|path| path.to_string_lossy().ends_with(ENDING))
            .collect();
        paths.sort();
        let mut faults = Vec::new();
        let exams = paths.iter().filter_map(|path| {
            let read = read(path, course, epoch);
            read.unwrap_or_else(|fault| {
                faults.push(fault);
                None
            })
        });
        (exams.collect(), faults)
    }
}

/// The length of a file's whole lines: a crash may have cut off the last one.
fn whole_lines(file: &mut File) -> io::Result<u64> {
    let mut text = Vec::new();
    file.seek(SeekFrom::Start(0))?;
    file.read_to_end(&mut text)?;
    let end = text.iter().rposition(|byte| *byte == b'\n');
    Ok(end.map_or(0, |at| at as u64 + 1))
}

fn read(path: &Path, course: &MissionCourse, epoch: u64) -> Result<Option<Exam>, Text> {
    let notes = read_notes(path)?;
    let Some(first) = notes.first() else {
        return Ok(None);
    };
    let damaged = |why| damaged(path, 1, why);
    let ExamDeed::Begun { exam, source, .. } = &first.what else {
        return Err(damaged(text!("exam-notes-no-begin")));
    };
    let file = ExamFile::parse(exam, source, course);
    let file = file.map_err(|_| damaged(text!("exam-notes-plan")))?;
    Ok(Exam::of(file.plan, &notes, epoch))
}

/// The notes in a file. A line that a crash has cut off is left out.
fn read_notes(path: &Path) -> Result<Vec<ExamNote>, Text> {
    let text = match fs::read_to_string(path) {
        Ok(text) => text,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => {
            let (file, why) = (path.display().to_string(), error.to_string());
            return Err(text!("exam-notes-unreadable", file = file, why = why));
        }
    };
    let lines = text.split_inclusive('\n').enumerate();
    let whole = lines.filter(|(_, line)| line.ends_with('\n'));
    let notes = whole.map(|(index, line)| {
        let damaged = |why| damaged(path, index + 1, why);
        let note = serde_json::from_str::<ExamNote>(line)
            .map_err(|error| damaged(Text::verbatim(error.to_string())))?;
        if has_good_times(&note) {
            Ok(note)
        } else {
            Err(damaged(text!("exam-notes-time")))
        }
    });
    notes.collect()
}

fn damaged(path: &Path, line: usize, why: Text) -> Text {
    let file = path.display().to_string();
    text!("exam-notes-damaged", file = file, line = line, why = why)
}

/// Whether the times of a note are some that a clock can have shown.
fn has_good_times(note: &ExamNote) -> bool {
    let until = match &note.what {
        ExamDeed::Asked { until, .. } => *until,
        _ => note.at,
    };
    note.at <= LAST_TIME && until <= LAST_TIME
}

#[cfg(test)]
mod tests;
