//! The records that the desk takes in, and the results of the class.

use std::collections::VecDeque;
use std::io;
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
    class_flight, class_trainees, day_of, is_sealed, seal_record,
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
        unwritten: VecDeque::new(),
        reception: Reception::new(records),
        course: store::course(),
        trainees: Vec::new(),
    };
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
    /// The notes that could not be written yet, oldest first. While there are any, no seat is told that its head is
    /// noted.
    unwritten: VecDeque<UnwrittenNotes>,
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
                let mut answers = self.seal_rest();
                answers.push(self.results());
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
                let was_whole = self.unwritten.is_empty();
                self.unwritten.push_back(UnwrittenNotes { begun, notes });
                let fault = self.write_notes().err().filter(|_| was_whole);
                let failed = fault.map(|error| ClassEvent::ExamFailed(Text::from(&error)));
                failed.map(event).into_iter().collect()
            }
            DeskTask::Leave(connection) => {
                self.reception.leave(connection);
                Vec::new()
            }
        }
    }

    /// Writes the notes in their order, beginning with those that could not be written before.
    fn write_notes(&mut self) -> io::Result<()> {
        while let Some(next) = self.unwritten.front() {
            self.notes.append(next.begun, &next.notes)?;
            self.unwritten.pop_front();
        }
        Ok(())
    }

    /// Seals the records that were complete before, but whose sealing was missed: the desk ended, or the disk was full.
    fn seal_rest(&mut self) -> Vec<DeskAnswer> {
        let mut trainees = std::mem::take(&mut self.trainees);
        let mut failed = None;
        for kept in self.reception.shelf().all() {
            if is_sealed(&kept.files) {
                continue;
            }
            let of_user = trainees.iter_mut().find(|it| it.user == kept.user);
            let mut flights = of_user.into_iter().flat_map(|it| &mut it.flights);
            if let Some(flight) = flights.find(|it| it.record == kept.files.stem) {
                failed = self.seal(&kept, flight).err().or(failed);
            }
        }
        self.trainees = trainees;
        let failed = failed.map(|error| ClassEvent::ExamFailed(Text::from(&error)));
        failed.map(event).into_iter().collect()
    }

    fn take(&mut self, connection: ConnectionId, user: &str, heard: DeskHeard) -> Vec<DeskAnswer> {
        let receipt = match heard {
            DeskHeard::Witnessed(seen) if self.write_notes().is_ok() => {
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
            handed_in: records.handed_in(kept).unwrap_or_else(since_1970),
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
