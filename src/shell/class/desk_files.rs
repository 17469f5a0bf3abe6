//! The records that the desk takes in, and the results of the class.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::{Duration, SystemTime};

use super::exams::epoch;
use super::exams::since_1970;
use super::worker::Worker;
use crate::app::event::{ClassEvent, ExamEvent};
use crate::campaign::MissionCourse;
use crate::class::protocol::DeskMessage;
use crate::class::{
    ConnectionId, DeskHeard, Exam, ExamNote, Receipt, ReceiptNews, Reception, RecordHead,
    RecordName,
};
use crate::class_results::{
    BesideFlight, ClassFlight, ClassResults, ClassTrainee, FoundFlights, add_flight,
};
use crate::grading::{GradeSheet, GradedFlight, GradedRequest};
use crate::shell::ConsoleOptions;
use crate::store::{
    self, ClassRecords, DeskKey, ExamNotes, KeptRecord, RecordFiles, SealedTry, SignatureError,
    check_seal, class_flight, class_trainees, day_of, is_sealed, seal_record,
};
use crate::text;
use crate::text::Text;
use grades::{GradesOutcome, UnwrittenGrades};

mod grades;

/// The name of the rubric with which flights are graded unless another one is named.
const STANDARD_RUBRIC: &str = "notechs";

/// What is to be done with the records of a class.
pub(in crate::shell) enum DeskTask {
    /// Read what was handed in before.
    Look,
    /// A seat of this user hands in a record, or a piece of one.
    Take {
        connection: ConnectionId,
        user: String,
        heard: DeskHeard,
    },
    /// Keep notes of the exam that began at a time.
    Keep { begun: u64, notes: Vec<ExamNote> },
    /// Write what could not be written before.
    WriteAgain,
    /// A connection has ended.
    Leave(ConnectionId),
    /// Read a flight to grade it.
    ReadGraded(GradedRequest),
    /// Find flights to be replayed.
    FindFlights {
        user: String,
        record: Option<String>,
        beside: Option<String>,
    },
    /// Keep the grades of a flight.
    KeepGrades {
        user: String,
        record: String,
        sheet: GradeSheet,
    },
}

/// What has become of a task.
pub(in crate::shell) enum DeskAnswer {
    /// Tell a seat something.
    Say(ConnectionId, Box<DeskMessage>),
    Event(Box<ClassEvent>),
}

/// Starts the thread for the records of a class; `None` without a data folder.
pub(super) fn start(
    options: &ConsoleOptions,
    class: &str,
    grader: &str,
) -> Option<Worker<DeskTask, DeskAnswer>> {
    let data = options.preferences.data.as_deref()?;
    let mut files = DeskFiles::new(ClassRecords::within(data, class), class, grader);
    Worker::start("class-records", move |task| files.answer(task))
}

/// Notes of the exam that began at a time.
struct UnwrittenNotes {
    begun: u64,
    notes: Vec<ExamNote>,
}

struct DeskFiles {
    class: String,
    /// The time since 1970 at which the desk's own clock was 0.
    epoch: u64,
    notes: ExamNotes,
    /// Notes that still have to be written, oldest first. Until they are, reports of seats are not confirmed.
    unwritten: VecDeque<UnwrittenNotes>,
    grades: UnwrittenGrades,
    /// Whether something could not be written.
    has_failed: bool,
    /// The exams of the class as their notes on disk say, oldest first.
    exams: Vec<Exam>,
    reception: Reception<ClassRecords>,
    course: MissionCourse,
    trainees: Vec<ClassTrainee>,
    /// The name under which the instructor's grades are kept.
    grader: String,
}

impl DeskFiles {
    fn new(records: ClassRecords, class: &str, grader: &str) -> Self {
        Self {
            class: class.to_owned(),
            epoch: epoch(Duration::ZERO),
            notes: ExamNotes::of(&records),
            unwritten: VecDeque::new(),
            grades: UnwrittenGrades::default(),
            has_failed: false,
            exams: Vec::new(),
            reception: Reception::new(records),
            course: store::course(),
            trainees: Vec::new(),
            grader: grader.to_owned(),
        }
    }

    fn answer(&mut self, task: DeskTask) -> Vec<DeskAnswer> {
        match task {
            DeskTask::Look => self.look(),
            DeskTask::Take {
                connection,
                user,
                heard,
            } => self.take(connection, &user, heard),
            DeskTask::Keep { begun, notes } => {
                let was_whole = self.unwritten.is_empty();
                self.unwritten.push_back(UnwrittenNotes { begun, notes });
                self.write_notes(was_whole)
            }
            DeskTask::WriteAgain if !std::mem::take(&mut self.has_failed) => Vec::new(),
            DeskTask::WriteAgain => {
                let mut answers = self.write_notes(true);
                answers.extend(self.write_grades());
                answers.extend(self.seal_rest());
                answers.push(self.results());
                answers
            }
            DeskTask::Leave(connection) => {
                self.reception.leave(connection);
                Vec::new()
            }
            DeskTask::ReadGraded(asked) => {
                let flight = self.graded(&asked).map(Box::new);
                vec![event(ClassEvent::Graded { asked, flight })]
            }
            DeskTask::KeepGrades {
                user,
                record,
                sheet,
            } => {
                self.grades.put(user, record, sheet);
                self.write_grades().into_iter().collect()
            }
            DeskTask::FindFlights {
                user,
                record,
                beside,
            } => {
                let found = self.find_flights(&user, record.as_deref(), beside.as_deref());
                vec![event(ClassEvent::FlightsFound(found))]
            }
        }
    }

    /// Reads what an earlier desk has kept.
    fn look(&mut self) -> Vec<DeskAnswer> {
        let (exams, damaged) = self.notes.all(&self.course, self.epoch);
        self.exams = exams;
        let (trainees, faults) = class_trainees(self.reception.shelf(), &self.exams);
        self.trainees = trainees;
        for fault in faults {
            tracing::warn!("a record of the class: {fault}");
        }
        let damaged = damaged.into_iter().map(ExamEvent::Damaged);
        let mut answers: Vec<_> = damaged.map(|it| event(ClassEvent::Exam(it))).collect();
        answers.extend(self.seal_rest());
        answers.push(self.results());
        let now = since_1970();
        // The newest one first: of several that have not ended, that one continues.
        let open = self.exams.iter().rev().filter(|it| it.is_watched(now));
        let found =
            open.map(|exam| event(ClassEvent::Exam(ExamEvent::Found(Box::new(exam.clone())))));
        answers.extend(found);
        answers
    }

    /// Writes the notes in their order, beginning with those that could not be written before.
    fn write_notes(&mut self, tells_failure: bool) -> Vec<DeskAnswer> {
        let mut answers = Vec::new();
        while let Some(next) = self.unwritten.pop_front() {
            if let Err(error) = self.notes.append(next.begun, &next.notes) {
                self.has_failed = true;
                answers.extend(tells_failure.then(|| failed(Text::from(&error))));
                self.unwritten.push_front(next);
                break;
            }
            self.know(&next);
            answers.push(event(ClassEvent::Exam(ExamEvent::NotesKept {
                begun: next.begun,
                count: next.notes.len(),
            })));
        }
        answers
    }

    /// Takes in notes that are on disk.
    fn know(&mut self, kept: &UnwrittenNotes) {
        let known = self.exams.iter_mut().find(|it| it.begun() == kept.begun);
        if let Some(exam) = known {
            kept.notes.iter().for_each(|note| exam.take_in(note));
        } else {
            let begun = self.notes.exam(kept.begun, &self.course, self.epoch);
            match begun {
                Ok(exam) => self.exams.extend(exam),
                Err(fault) => tracing::warn!("an exam of the class: {fault}"),
            }
        }
    }

    /// Seals the records that were complete before, but whose sealing was missed: the desk ended, or the disk was full.
    fn seal_rest(&mut self) -> Vec<DeskAnswer> {
        let mut trainees = std::mem::take(&mut self.trainees);
        let mut fault = None;
        for kept in self.reception.shelf().all() {
            if is_sealed(&kept.files) {
                continue;
            }
            let of_user = trainees.iter_mut().find(|it| it.user == kept.user);
            let mut flights = of_user.into_iter().flat_map(|it| &mut it.flights);
            if let Some(flight) = flights.find(|it| it.record == kept.files.stem) {
                fault = self.seal(&kept, flight).err().or(fault);
            }
        }
        self.trainees = trainees;
        self.has_failed |= fault.is_some();
        fault
            .map(|error| failed(Text::from(&error)))
            .into_iter()
            .collect()
    }

    fn take(&mut self, connection: ConnectionId, user: &str, heard: DeskHeard) -> Vec<DeskAnswer> {
        let receipt = match heard {
            // Its note came before it.
            DeskHeard::Witnessed(seen) if self.unwritten.is_empty() => {
                let RecordHead { record, bytes, .. } = seen.head;
                let told = DeskMessage::Witnessed { record, bytes };
                return vec![DeskAnswer::Say(connection, Box::new(told))];
            }
            DeskHeard::Known | DeskHeard::Witnessed(_) => None,
            DeskHeard::Submission(submission) => {
                Some(self.reception.begin(connection, user, &submission))
            }
            DeskHeard::Piece(piece) => self.reception.take(connection, user, &piece),
        };
        let Some(Receipt { answer, news }) = receipt else {
            return Vec::new();
        };
        let mut answers = vec![DeskAnswer::Say(connection, Box::new(answer))];
        if let Some(news) = news {
            answers.extend(self.tell(user, news));
        }
        answers
    }

    /// What the desk shows of a record.
    fn tell(&mut self, user: &str, news: ReceiptNews) -> Vec<DeskAnswer> {
        let user = user.to_owned();
        let record = match news {
            ReceiptNews::Refused(record, refusal, words) => {
                return vec![event(ClassEvent::NotKept {
                    user,
                    record,
                    refusal,
                    words,
                })];
            }
            ReceiptNews::Kept(record) => record,
        };
        let kept = self.reception.shelf().kept_record(&user, &record);
        let own_key = DeskKey::public_in(self.reception.shelf().data());
        let scored = kept
            .as_ref()
            .map(|kept| class_flight(kept, own_key.as_deref(), &self.exams));
        let mut flight = match scored {
            Some(Ok(flight)) => flight,
            Some(Err(fault)) => return vec![event(ClassEvent::Unscored(fault))],
            None => return vec![event(ClassEvent::Unscored(Text::from(record.as_str())))],
        };
        let fault = kept.and_then(|kept| self.seal(&kept, &mut flight).err());
        self.has_failed |= fault.is_some();
        let failed = fault.map(|error| failed(Text::from(&error)));
        let kept = ClassEvent::Kept {
            user: user.clone(),
            mission: flight.flight.mission.clone(),
            score: flight.flight.score,
        };
        add_flight(&mut self.trainees, &user, flight);
        let mut answers = vec![event(kept), self.results()];
        answers.extend(failed);
        answers
    }

    /// Seals a flight that is a try of an exam.
    fn seal(&self, kept: &KeptRecord, flight: &mut ClassFlight) -> Result<(), SignatureError> {
        let mut exams = self.exams.iter().rev();
        let found = exams.find_map(|exam| Some((exam, exam.try_of(&kept.user, flight.seed)?)));
        let Some((exam, flown)) = found else {
            return Ok(());
        };
        let records = self.reception.shelf();
        let key = DeskKey::open(records.data())?;
        let sealed = SealedTry {
            class: &self.class,
            exam,
            flown,
            kept,
            flight,
            handed_in: records.handed_in(kept).unwrap_or_else(since_1970),
        };
        seal_record(records, &sealed, &key)?;
        flight.seal = check_seal(&kept.files, Some(key.public()));
        Ok(())
    }

    /// The flights that are asked for, to be replayed.
    fn find_flights(
        &self,
        user: &str,
        record: Option<&str>,
        beside: Option<&str>,
    ) -> Result<FoundFlights, Text> {
        let own = newest(&self.trainees, user, |flight| {
            record.is_none_or(|record| flight.record == record)
        });
        let own = own.ok_or_else(|| text!("grading-no-record", user = user))?;
        let files = self.files_of(user, own)?;
        let frames = files.frames()?.display().to_string();
        let beside = beside.map(|other| self.beside(own, other)).transpose()?;
        Ok(FoundFlights {
            trainee: names_of(user, own),
            record: files.stem,
            frames,
            beside,
        })
    }

    /// The newest flight of another trainee in the same mission; of the same trainee, the one before.
    fn beside(&self, own: &ClassFlight, user: &str) -> Result<BesideFlight, Text> {
        let mission = &own.flight.mission;
        let is_meant =
            |flight: &ClassFlight| flight.flight.mission == *mission && flight.record != own.record;
        let other = newest(&self.trainees, user, is_meant);
        let other = other.ok_or_else(|| {
            text!(
                "class-replay-none-beside",
                user = user,
                mission = mission.as_str()
            )
        })?;
        let run = self.files_of(user, other)?.run;
        let run = run.ok_or_else(|| text!("grading-no-record", user = user))?;
        Ok(BesideFlight {
            trainee: names_of(user, other),
            run: run.display().to_string(),
        })
    }

    fn files_of(&self, user: &str, flight: &ClassFlight) -> Result<RecordFiles, Text> {
        let record = RecordName::try_from(flight.record.clone()).ok();
        let shelf = self.reception.shelf();
        let kept = record.and_then(|record| shelf.kept_record(user, &record));
        let kept = kept.ok_or_else(|| text!("grading-no-record", user = user))?;
        Ok(kept.files)
    }

    /// The flight that is asked for, with the grades that it has.
    fn graded(&self, asked: &GradedRequest) -> Result<GradedFlight, Text> {
        let name = asked.rubric.as_deref().unwrap_or(STANDARD_RUBRIC);
        let rubric = store::rubric(name).map_err(|error| Text::from(&error))?;
        let shelf = self.reception.shelf();
        let mut flight =
            shelf.graded(&asked.user, &asked.choice, &Arc::new(rubric), &self.grader)?;
        // What is not written yet is newer than the file.
        if let Some(sheet) = self.grades.of(&flight) {
            flight.sheet = sheet.clone();
        }
        Ok(flight)
    }

    /// Writes the grades that wait, and says so if something has changed.
    fn write_grades(&mut self) -> Option<DeskAnswer> {
        let outcome = self.grades.write(self.reception.shelf())?;
        self.has_failed |= outcome.fault.is_some();
        let GradesOutcome { count, fault } = outcome;
        Some(event(ClassEvent::GradesWait { count, fault }))
    }

    fn results(&self) -> DeskAnswer {
        let day = day_of(SystemTime::now());
        let results = ClassResults::of(&self.course, &self.trainees, day);
        event(ClassEvent::Results(Arc::new(results)))
    }
}

/// The newest flight of a trainee that is meant.
fn newest<'a>(
    trainees: &'a [ClassTrainee],
    user: &str,
    is_meant: impl Fn(&ClassFlight) -> bool,
) -> Option<&'a ClassFlight> {
    let trainee = trainees.iter().find(|it| it.user == user)?;
    trainee.flights.iter().rev().find(|flight| is_meant(flight))
}

/// The names of the trainee of a flight, and when it began: two flights may be of one trainee.
fn names_of(user: &str, flight: &ClassFlight) -> String {
    let when = flight.when.get(..16).unwrap_or_default().replace('T', " ");
    match flight.profile.as_deref().filter(|it| *it != user) {
        Some(profile) => format!("{user} ({profile}) {when}"),
        None => format!("{user} {when}"),
    }
}

fn failed(fault: Text) -> DeskAnswer {
    event(ClassEvent::Exam(ExamEvent::Failed(fault)))
}

fn event(event: ClassEvent) -> DeskAnswer {
    DeskAnswer::Event(Box::new(event))
}

#[cfg(test)]
mod tests;
