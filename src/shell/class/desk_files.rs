//! The records that the desk takes in, and the results of the class.

use std::sync::Arc;
use std::time::SystemTime;

use super::worker::Worker;
use crate::app::event::ClassEvent;
use crate::campaign::MissionCourse;
use crate::class::protocol::DeskMessage;
use crate::class::{ConnectionId, DeskHeard, Receipt, ReceiptNews, Reception};
use crate::class_results::{ClassResults, ClassTrainee, add_flight};
use crate::grading::{GradeSheet, GradedFlight, GradedRequest};
use crate::shell::ConsoleOptions;
use crate::store::{self, ClassRecords, class_flight, class_trainees, day_of};
use crate::text::Text;

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
    /// A connection has ended.
    Leave(ConnectionId),
    /// Read a flight to grade it.
    ReadGraded(GradedRequest),
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
    let mut files = DeskFiles {
        reception: Reception::new(ClassRecords::within(data, class)),
        course: store::course(),
        trainees: Vec::new(),
        grader: grader.to_owned(),
    };
    Worker::start("class-records", move |task| files.answer(task))
}

struct DeskFiles {
    reception: Reception<ClassRecords>,
    course: MissionCourse,
    trainees: Vec<ClassTrainee>,
    /// The name under which the instructor's grades are kept.
    grader: String,
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
                vec![self.results()]
            }
            DeskTask::Take {
                connection,
                user,
                heard,
            } => self.take(connection, &user, heard),
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
                let shelf = self.reception.shelf();
                let kept = shelf.keep_sheet(&user, &record, &sheet);
                let lost = kept.err().map(|error| Text::from(&error));
                lost.map(|fault| event(ClassEvent::GradesLost(fault)))
                    .into_iter()
                    .collect()
            }
        }
    }

    fn take(&mut self, connection: ConnectionId, user: &str, heard: DeskHeard) -> Vec<DeskAnswer> {
        let receipt = match heard {
            DeskHeard::Known => None,
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
        let flight = match kept.as_ref().map(class_flight) {
            Some(Ok(flight)) => flight,
            Some(Err(fault)) => return vec![event(ClassEvent::Unscored(fault))],
            None => return vec![event(ClassEvent::Unscored(Text::from(record.as_str())))],
        };
        let kept = ClassEvent::Kept {
            user: user.clone(),
            mission: flight.flight.mission.clone(),
            score: flight.flight.score,
        };
        add_flight(&mut self.trainees, &user, flight);
        vec![event(kept), self.results()]
    }

    /// The flight that is asked for, with the grades that it has.
    fn graded(&self, asked: &GradedRequest) -> Result<GradedFlight, Text> {
        let name = asked.rubric.as_deref().unwrap_or(STANDARD_RUBRIC);
        let rubric = store::rubric(name).map_err(|error| Text::from(&error))?;
        let shelf = self.reception.shelf();
        shelf.graded(&asked.user, &asked.choice, &Arc::new(rubric), &self.grader)
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
