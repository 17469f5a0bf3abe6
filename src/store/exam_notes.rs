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

/// The folder of the notes in that of a class. No trainee's folder begins with a dot.
const EXAMS: &str = ".exams";
const ENDING: &str = ".jsonl";

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

    /// The exam that began at a time. `epoch` is the time since 1970 at which the desk's own clock was 0.
    pub fn exam(&self, begun: u64, course: &MissionCourse, epoch: u64) -> Option<Exam> {
        read(&self.path(begun), course, epoch)
    }

    /// All exams of the class, oldest first. `epoch` is the time since 1970 at which the desk's own clock was 0.
    pub fn all(&self, course: &MissionCourse, epoch: u64) -> Vec<Exam> {
        let entries = fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let mut paths: Vec<PathBuf> = entries
            .map(|entry| entry.path())
            .filter(|path| path.to_string_lossy().ends_with(ENDING))
            .collect();
        paths.sort();
        let exams = paths.iter().filter_map(|path| read(path, course, epoch));
        exams.collect()
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

fn read(path: &Path, course: &MissionCourse, epoch: u64) -> Option<Exam> {
    let text = fs::read_to_string(path).ok()?;
    let notes: Vec<ExamNote> = text
        .lines()
        .map_while(|line| serde_json::from_str(line).ok())
        .collect();
    let ExamDeed::Begun { exam, source, .. } = &notes.first()?.what else {
        return None;
    };
    let file = ExamFile::parse(exam, source, course);
    let file = file.inspect_err(|_| {
        tracing::warn!("the exam in {} cannot be read", path.display());
    });
    Exam::of(file.ok()?.plan, &notes, epoch)
}

#[cfg(test)]
mod tests;
