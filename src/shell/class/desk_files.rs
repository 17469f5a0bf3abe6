//! The records that the desk takes in, and the results of the class.

use std::sync::Arc;
use std::time::SystemTime;

use super::exams::since_1970;
use super::worker::Worker;
use crate::app::event::ClassEvent;
use crate::campaign::MissionCourse;
use crate::class::protocol::DeskMessage;
use crate::class::{
    ConnectionId, DeskHeard, ExamNote, Receipt, ReceiptNews, Reception, RecordHead,
};
use crate::class_results::{ClassFlight, ClassResults, ClassTrainee, add_flight};
use crate::store::{
    self, ClassRecords, DeskKey, ExamNotes, KeptRecord, SealedTry, SignatureError, check_seal,
    class_flight, class_trainees, day_of, seal_record,
};
use crate::text::Text;

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
    /// A connection has ended.
    Leave(ConnectionId),
}

/// What has become of a task.
pub(in crate::shell) enum DeskAnswer {
    /// Tell a seat something.
    Say(ConnectionId, Box<DeskMessage>),
    Event(Box<ClassEvent>),
}

/// Starts the thread for the records of a class.
pub(super) fn start(
    records: ClassRecords,
    class: &str,
    epoch: u64,
) -> Option<Worker<DeskTask, DeskAnswer>> {
    let mut files = DeskFiles {
        class: class.to_owned(),
        epoch,
        notes: ExamNotes::of(&records),
        are_notes_kept: true,
        reception: Reception::new(records),
        course: store::course(),
        trainees: Vec::new(),
    };
    Worker::start("class-records", move |task| files.answer(task))
}

struct DeskFiles {
    class: String,
    /// The time since 1970 at which the desk's own clock was 0.
    epoch: u64,
    notes: ExamNotes,
    /// Whether the newest notes are written; otherwise no seat is told that its head is noted.
    are_notes_kept: bool,
    reception: Reception<ClassRecords>,
    course: MissionCourse,
    trainees: Vec<ClassTrainee>,
}

impl DeskFiles {
    fn answer(&mut self, task: DeskTask) -> Vec<DeskAnswer> {
        match task {
            DeskTask::Look => {
                let (trainees, faults) = class_trainees(self.reception.shelf());
                self.trainees = trainees;
                for fault in faults {
                    tracing::warn!("a record of the class: {fault}");
                }
                let mut answers = vec![self.results()];
                let kept = self.notes.all(&self.course, self.epoch);
                let open = kept.into_iter().rev().find(|it| !it.exam.is_stopped());
                answers.extend(open.map(|it| event(ClassEvent::ExamFound(Box::new(it.exam)))));
                answers
            }
            DeskTask::Take {
                connection,
                user,
                heard,
            } => self.take(connection, &user, heard),
            DeskTask::Keep { begun, notes } => {
                let kept = self.notes.append(begun, &notes);
                self.are_notes_kept = kept.is_ok();
                let fault = kept.err().map(|error| Text::from(&error));
                let failed = fault.map(|fault| event(ClassEvent::ExamFailed(fault)));
                failed.into_iter().collect()
            }
            DeskTask::Leave(connection) => {
                self.reception.leave(connection);
                Vec::new()
            }
        }
    }

    fn take(&mut self, connection: ConnectionId, user: &str, heard: DeskHeard) -> Vec<DeskAnswer> {
        let receipt = match heard {
            DeskHeard::Witnessed(seen) if self.are_notes_kept => {
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
            .map(|kept| class_flight(kept, own_key.as_deref()));
        let mut flight = match scored {
            Some(Ok(flight)) => flight,
            Some(Err(fault)) => return vec![event(ClassEvent::Unscored(fault))],
            None => return vec![event(ClassEvent::Unscored(Text::from(record.as_str())))],
        };
        let failed = kept.and_then(|kept| self.seal(&kept, &mut flight).err());
        let failed = failed.map(|error| event(ClassEvent::ExamFailed(Text::from(&error))));
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
        let mut exams = self.notes.all(&self.course, self.epoch).into_iter().rev();
        let found = exams.find_map(|it| {
            let flown = it.exam.try_of(&kept.user, flight.seed)?;
            Some((it.exam, flown))
        });
        let Some((exam, flown)) = found else {
            return Ok(());
        };
        let records = self.reception.shelf();
        let key = DeskKey::open(records.data())?;
        let sealed = SealedTry {
            class: &self.class,
            exam: &exam,
            flown: &flown,
            kept,
            flight,
            handed_in: since_1970(),
        };
        seal_record(records, &sealed, &key)?;
        flight.seal = check_seal(&kept.files, Some(key.public()));
        Ok(())
    }

    fn results(&self) -> DeskAnswer {
        let day = day_of(SystemTime::now());
        let results = ClassResults::of(&self.course, &self.trainees, day);
        event(ClassEvent::Results(Arc::new(results)))
    }
}

fn event(event: ClassEvent) -> DeskAnswer {
    DeskAnswer::Event(Box::new(event))
}
