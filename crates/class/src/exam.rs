//! Exams: missions that seats fly under the desk's eyes.
//!
//! An [`ExamPlan`] says which missions are flown, how often, and for how long. The desk draws a secret when it begins
//! an [`Exam`]; the seed of each try follows from it, so that a layout is unknown until the desk opens the try.
//!
//! # What survives
//! Everything that the desk decides or sees is an [`ExamNote`], stamped with the desk's own clock. The state of an exam
//! follows from its notes alone, so a desk that is opened again goes on where the last one ended.
//!
//! # The witness
//! While a try is flown, its record only grows. The seat reports the length of the record and the hash of that much of
//! it ([`RecordHead`]), and the desk notes it. Each head must be that of the record that is handed in: what was written
//! before a head cannot be changed after it. [`Witness::of`] compares them, and the desk's clock with the mission's time.
//!
//! # How the parts fit
//! `plan` is the plan, `secret` the seeds, `attempt` what desk and seat say about a try, `note` what the desk keeps,
//! `candidate` where one trainee is, `conduct` what follows for each, `desk` what the desk does, and `witness` the comparison at the end.

mod attempt;
mod candidate;
mod conduct;
mod desk;
mod note;
mod plan;
mod secret;
mod witness;

pub use attempt::{ContentHash, ExamTry, FlownTry, RecordHead, TryHead, TryName};
pub use candidate::{
    Candidate, CandidateStage, CandidateTry, TimedHead, TryEnd, TryOpening, TryVerdict,
};
pub use conduct::Exam;
pub use note::{ExamDeed, ExamNote};
pub use plan::{ExamLayout, ExamMission, ExamPlan};
pub use secret::ExamSecret;
pub use witness::{Witness, WrittenRecord};
