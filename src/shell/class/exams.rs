//! The files of exams, and the clock of the desk.

use std::time::{Duration, SystemTime, UNIX_EPOCH};

use rand::TryRng as _;
use rand::rngs::SysRng;

use crate::app::event::{ClassEvent, ExamEvent};
use crate::class::{Exam, ExamDeed, ExamNote, ExamSecret, RecordHead};
use crate::diagnostic::first_shown;
use crate::exam_plan::ExamFile;
use crate::language::Named;
use crate::shell::{Console, RunningSession};
use crate::store::{self, Source};
use crate::text;
use crate::text::Text;

/// The time since 1970, in seconds.
pub(super) fn since_1970() -> u64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    since.unwrap_or_default().as_secs()
}

/// The time since 1970 at which the console's clock was 0, in seconds.
pub(super) fn epoch(wall: Duration) -> u64 {
    since_1970().saturating_sub(wall.as_secs())
}

impl Console {
    /// Reads an exam, and draws the secret of its seeds.
    pub(super) fn read_exam(&mut self, name: String, seats: Vec<usize>) {
        let exam = match &self.options.preferences.data {
            Some(_) => begun(&name, self.clock.wall()).map(Box::new),
            None => Err(text!("class-exam-no-folder")),
        };
        self.post(ClassEvent::Exam(ExamEvent::Read { name, exam, seats }));
    }

    /// At a desk: lists the exams that can be held.
    pub(in crate::shell) fn list_exams(&mut self) {
        if self.app.state().class_role().desk().is_none() {
            return;
        }
        let course = store::course();
        let named = |source: &Source| {
            // The desk that begins one shows its faults.
            let read = ExamFile::parse(source.stem(), &source.text, &course);
            let meaning = read.map_or_else(|_| text!("class-lesson-has-faults"), |it| it.title);
            let name = source.stem().to_owned();
            Named { name, meaning }
        };
        let exams = store::exams().iter().map(named).collect();
        self.post(ClassEvent::Exam(ExamEvent::Listed(exams)));
    }

    /// How far the record of the mission in flight has grown.
    pub(in crate::shell) fn record_head(&self) -> Option<RecordHead> {
        self.running.as_ref().and_then(RunningSession::record_head)
    }
}

/// An exam that begins now.
fn begun(name: &str, wall: Duration) -> Result<Exam, Text> {
    let source = store::exam(name).map_err(|error| Text::from(&error))?;
    let file = ExamFile::parse(source.stem(), &source.text, &store::course());
    let file = file.map_err(|faults| {
        let (shown, rest) = first_shown(&faults);
        let lines = shown.iter().map(|it| it.text(&source.name, &source.text));
        Text::joined("\n", lines.chain(rest).collect())
    })?;
    let mut secret = [0; 32];
    let drawn = SysRng.try_fill_bytes(&mut secret);
    drawn.map_err(|_| text!("class-exam-no-random"))?;
    let first = ExamNote {
        at: since_1970(),
        what: ExamDeed::Begun {
            exam: source.stem().to_owned(),
            source: source.text.clone(),
            secret: ExamSecret::from(secret),
        },
    };
    Exam::begin(file.plan, first, epoch(wall)).ok_or_else(|| text!("class-exam-none"))
}
