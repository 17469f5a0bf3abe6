//! The records that a seat hands in: read, marked, and offered.

use super::worker::Worker;
use crate::app::event::ClassEvent;
use crate::class::{Piece, PieceRequest, RecordName};
use crate::store::WaitingRecords;

/// What is to be done with the records of a seat.
pub(in crate::shell) enum SeatTask {
    /// Look for records that an earlier console could not hand in.
    Look,
    /// Offer a record that is complete now.
    Offer(RecordName),
    /// Read a piece of a record for the desk.
    Read(PieceRequest),
    /// The desk has a record, or does not take it.
    Settle(RecordName),
}

/// What has become of a task.
pub(in crate::shell) enum SeatAnswer {
    Event(Box<ClassEvent>),
    Piece(Piece),
}

/// Starts the thread for the records of a seat.
pub(super) fn start(waiting: WaitingRecords) -> Option<Worker<SeatTask, SeatAnswer>> {
    Worker::start("hand-in", move |task| match task {
        SeatTask::Look => {
            let marked = waiting.marked().into_iter();
            marked.map(|record| offer(&waiting, record)).collect()
        }
        SeatTask::Offer(record) => {
            if let Err(error) = waiting.mark(&record) {
                tracing::warn!("the record {} is not marked: {error}", record.as_str());
            }
            vec![offer(&waiting, record)]
        }
        SeatTask::Read(request) => match waiting.piece(&request) {
            Ok(piece) => vec![SeatAnswer::Piece(piece)],
            Err(error) => vec![unreadable(request.record, &error)],
        },
        SeatTask::Settle(record) => {
            waiting.unmark(&record);
            Vec::new()
        }
    })
}

fn offer(waiting: &WaitingRecords, record: RecordName) -> SeatAnswer {
    match waiting.submission(&record) {
        Ok(submission) => SeatAnswer::Event(Box::new(ClassEvent::Offered(submission))),
        Err(error) => unreadable(record, &error),
    }
}

fn unreadable(record: RecordName, error: &std::io::Error) -> SeatAnswer {
    let error = error.to_string();
    SeatAnswer::Event(Box::new(ClassEvent::Unreadable { record, error }))
}
