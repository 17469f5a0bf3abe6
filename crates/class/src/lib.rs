//! A class: the consoles of trainees, which are its *seats*, and the console of the instructor, which is its *desk*.
//!
//! A seat says twice a second how its flight goes ([`SeatReport`]), and writes what happens into a numbered
//! [`Journal`]. The desk shows the seats in the order in which they need help ([`Need`]), and gives [`Order`]s. Each
//! order ends with an [`Outcome`] in the journal of the seat.
//!
//! A seat never waits for the desk, and neither loses anything when a connection breaks: reports are replaced by newer
//! ones, entries of the journal are numbered and asked for again, and an order that arrives twice is carried out once.
//!
//! # How the parts fit
//! - What is said: `report`, `journal`, `order`; `words` is text from the other side, cleaned.
//! - What is seen: `watch`, a screen as pictures; `insight`, what is behind it; `watching`, which seats a desk watches.
//! - What is shown to seats: a replay at the desk, as pictures in the other direction.
//! - What remains: `submission`, the record of a flight in pieces; `hand_in`, the records that wait at a seat;
//!   `reception`, how the desk takes them in.
//! - What is planned: `lesson`, the steps of a lesson and where a seat is in them; `conduct`, what the desk does for
//!   all seats.
//! - What counts: `exam`, tries that the desk opens, and whose records it sees growing.
//! - How it is said: [`protocol`], as lines of JSON.
//! - Who knows what: [`Seat`] is the state of a seat's side, [`Desk`] that of the desk, with a [`SeatRecord`] for each
//!   seat; `need` orders them.
//! - What a connection has said already: [`SeatLine`] and [`DeskLine`]. They compare that with the state of their
//!   side, so a new connection continues where the last one broke.
//!
//! Nothing here reads a clock, a file or a socket: times are arguments, and whoever carries the lines passes them in.

#![warn(missing_docs)]

mod call;
mod conduct;
mod desk;
mod desk_line;
mod exam;
mod hand_in;
mod insight;
mod journal;
mod lesson;
mod need;
mod order;
pub mod protocol;
mod reception;
mod report;
mod seat;
mod seat_line;
mod seat_record;
mod submission;
mod watch;
mod watching;
mod words;

#[cfg(test)]
mod tests;

pub use call::{CallEnd, SeatEnd};
pub use conduct::{LessonDirection, LessonFault};
pub use desk::{ConnectionId, Desk, DeskHeard, SEATS, natural};
pub use desk_line::DeskLine;
pub use exam::{
    Candidate, CandidateStage, CandidateTry, ContentHash, Exam, ExamDeed, ExamLayout, ExamMission,
    ExamNote, ExamPlan, ExamSecret, ExamTry, FlownTry, RecordHead, TimedHead, TryEnd, TryHead,
    TryName, TryOpening, TryVerdict, Witness, WrittenRecord,
};
pub use hand_in::{HandIn, HandInOutcome};
pub use insight::{
    Insight, InsightPlace, ObjectiveInsight, ObjectiveStanding, TargetInsight, VehicleInsight,
    VehiclePlace,
};
pub use journal::{BATCH, Entry, Happening, Journal, JournalBatch, JournalCopy, KEPT};
pub use lesson::{
    FlightMoment, HoldReason, LessonPlan, LessonPosition, LessonStep, LessonWait, StepLimit,
    StepStart, StepTarget,
};
pub use need::{Attention, Need};
pub use order::{Deed, NotedStep, Order, OrderId, Outcome, Refusal};
pub use reception::{
    Held, Receipt, ReceiptNews, Reception, RecordShelf, ShelfFault, TRAINEE_SHARE,
};
pub use report::{
    ArmedInject, CapturedSituation, Danger, DangerKind, FlightReport, LastCommand, OfferedInject,
    SeatReport, Stage,
};
pub use seat::{Consent, Seat};
pub use seat_line::{HEAD_EVERY, REPORT_EVERY, SeatLine, SeatSource};
pub use seat_record::{GivenOrder, OrderState, Presence, SeatRecord};
pub use submission::{
    LARGEST_PART, PIECE, Piece, PieceBytes, PieceRequest, RecordName, RecordPart, Submission,
    SubmissionEnd, SubmissionRefusal, SubmittedPart,
};
pub use watch::{
    CellStyle, Picture, PictureCell, PicturePart, PictureReceiver, PictureSender, STALE_AFTER,
};
pub use watching::{WATCHED, Watching};
pub use words::Words;
