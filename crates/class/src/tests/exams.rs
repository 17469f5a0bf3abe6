//! Exams at a desk: tries, times, heads of records, and what a desk finds when it is opened again.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Duration;

use proptest::prelude::*;
use sha2::{Digest as _, Sha256};

use super::rig::end_order;
use super::{desk, joined, report, seconds};
use crate::protocol::SeatMessage;
use crate::*;

mod openings;
mod verdicts;
mod witness;

/// The time since 1970 at which the clock of the desk is 0.
const EPOCH: u64 = 1_800_000_000;

fn mission(id: &str, tries: u32) -> ExamMission {
    ExamMission {
        mission: id.into(),
        tries,
        limit: seconds(60),
    }
}

fn plan(layout: ExamLayout) -> Arc<ExamPlan> {
    Arc::new(ExamPlan {
        name: "final".into(),
        title: "Final exam".into(),
        title_uk: None,
        layout,
        opens: Some(EPOCH + 10),
        closes: Some(EPOCH + 1000),
        missions: vec![mission("00", 2), mission("01", 1)],
    })
}

fn first_note(secret: u8) -> ExamNote {
    ExamNote {
        at: EPOCH,
        what: ExamDeed::Begun {
            exam: "final".to_owned(),
            source: String::new(),
            secret: ExamSecret::from([secret; 32]),
        },
    }
}

fn exam(layout: ExamLayout, secret: u8) -> Exam {
    Exam::of(plan(layout), &[first_note(secret)], EPOCH).expect("it begins with its first note")
}

fn name(mission: &str, number: u32) -> TryName {
    TryName {
        exam: "final".into(),
        begun: EPOCH,
        mission: mission.into(),
        number,
        opening: 1,
    }
}

/// A desk with an exam, and a seat of anna.
struct Hall {
    desk: Desk,
    at: u64,
    notes: Vec<ExamNote>,
    journal: Journal,
    /// Whether the disk of the desk is full.
    is_full: bool,
}

impl Hall {
    fn new() -> Self {
        let mut desk = desk();
        joined(&mut desk, 1, "anna", 10);
        assert!(desk.hold(exam(ExamLayout::Own, 1)));
        assert!(desk.seat_candidates(&[0], Duration::ZERO));
        let mut hall = Self {
            desk,
            at: 0,
            notes: vec![first_note(1)],
            journal: Journal::default(),
            is_full: false,
        };
        hall.report(None);
        hall.keep_notes();
        hall
    }

    /// The notes come to the disk, if there is room.
    fn keep_notes(&mut self) {
        if !self.is_full {
            for (begun, notes) in self.desk.take_exam_notes() {
                self.desk.exam_notes_kept(begun, notes.len());
                if begun == EPOCH {
                    self.notes.extend(notes);
                }
            }
        }
    }

    fn hear(&mut self, message: SeatMessage) -> DeskHeard {
        let heard = self
            .desk
            .hear(ConnectionId(1), "anna", message, seconds(self.at));
        heard.expect("the seat is known")
    }

    /// The seat says what it flies.
    fn report(&mut self, flight: Option<(TryName, Stage, bool)>) {
        let flight = flight.map(|(name, stage, is_passed)| FlightReport {
            exam_try: Some(FlownTry { name, is_passed }),
            stage,
            ..FlightReport::default()
        });
        self.hear(report(flight));
    }

    /// Time passes until a time of the desk's clock.
    fn until(&mut self, at: u64) {
        while self.at < at {
            self.at += 1;
            self.desk.expire(seconds(self.at));
            self.desk.examine(seconds(self.at));
            self.keep_notes();
        }
    }

    /// The newest try that the desk has asked the seat to open.
    fn asked(&self) -> Option<ExamTry> {
        let mut orders = self.desk.seats()[0].orders().rev();
        orders.find_map(|it| match &it.order.deed {
            Deed::Examine(opened) => Some(opened.clone()),
            _ => None,
        })
    }

    /// The seat answers the newest order.
    fn answer(&mut self, outcome: Outcome) {
        let order = self.desk.seats()[0].orders().next_back().expect("an order");
        end_order(&mut self.journal, order.order.clone(), outcome);
        let batch = self.journal.from(self.journal.last()).expect("an entry");
        self.hear(SeatMessage::Entries(batch));
        self.until(self.at + 1);
    }

    fn candidate(&self) -> &Candidate {
        let seat = &self.desk.seats()[0];
        let found = self.desk.candidacy(seat, seconds(self.at));
        found.expect("she takes part").1
    }

    fn head(&mut self, name: TryName, head: RecordHead) -> DeskHeard {
        let is_over = false;
        self.try_head(TryHead {
            name,
            is_over,
            head,
        })
    }

    fn try_head(&mut self, head: TryHead) -> DeskHeard {
        let heard = self.hear(SeatMessage::Head(head));
        self.keep_notes();
        heard
    }

    /// A hall in which the first try is open.
    fn flying() -> Self {
        let mut hall = Self::new();
        hall.until(12);
        hall.report(Some((name("00", 1), Stage::Flying, false)));
        hall.answer(Outcome::Done);
        hall
    }
}

fn record(name: &str) -> RecordName {
    RecordName::try_from(name.to_owned()).expect("a name")
}

fn head_of(record_name: &str, content: &[u8]) -> RecordHead {
    RecordHead {
        record: record(record_name),
        bytes: content.len() as u64,
        sha256: <[u8; 32]>::from(Sha256::digest(content)).into(),
    }
}

#[test]
fn a_hash_has_64_digits_so_that_a_head_cannot_fill_the_notes() {
    let head = head_of("flight", b"one\n");
    let mut value = serde_json::to_value(&head).expect("plain data");
    let read = |value: &serde_json::Value| serde_json::from_value::<RecordHead>(value.clone());
    assert_eq!(read(&value).expect("it was written so"), head);
    for wrong in ["", "0", &"0".repeat(65), &"g".repeat(64), &"A".repeat(64)] {
        value["sha256"] = wrong.into();
        assert!(read(&value).is_err(), "{wrong}");
    }
}

#[test]
fn seeds_follow_from_the_secret_and_differ_for_users_missions_tries_and_openings() {
    let seeds = |layout, secret| {
        let mut found = Vec::new();
        for user in ["anna", "bohdan"] {
            let mut desk = desk();
            joined(&mut desk, 1, user, 10);
            assert!(desk.hold(exam(layout, secret)));
            assert!(desk.seat_candidates(&[0], Duration::ZERO));
            let heard = desk.hear(ConnectionId(1), user, report(None), Duration::ZERO);
            assert_eq!(heard, Ok(DeskHeard::Known));
            for at in [11, 12] {
                desk.examine(seconds(at));
                for (begun, notes) in desk.take_exam_notes() {
                    desk.exam_notes_kept(begun, notes.len());
                }
            }
            let order = desk.seats()[0].orders().next_back().expect("an order");
            let Deed::Examine(opened) = &order.order.deed else {
                panic!("{:?}", order.order);
            };
            let exam = desk.exam().expect("an exam");
            let flown = exam.try_of(user, opened.seed).expect("its seed names it");
            assert_eq!(flown.name, opened.name);
            assert_eq!(exam.try_of("mallory", opened.seed), None);
            assert_eq!(exam.try_of(user, opened.seed ^ 1), None);
            found.push(opened.seed);
        }
        found
    };
    let own: BTreeSet<u64> = [seeds(ExamLayout::Own, 1), seeds(ExamLayout::Own, 2)]
        .concat()
        .into_iter()
        .collect();
    assert_eq!(own.len(), 4);
    let same = seeds(ExamLayout::Same, 1);
    assert_eq!(same[0], same[1]);
}

#[test]
fn tries_are_opened_one_after_the_other_until_one_is_passed() {
    let mut hall = Hall::new();
    hall.until(9);
    assert_eq!(hall.asked(), None, "the exam is not open yet");
    hall.until(12);
    let first = hall.asked().expect("it is open");
    assert_eq!((&first.name, first.within_s), (&name("00", 1), 59));
    hall.report(Some((name("00", 1), Stage::Reading, false)));
    hall.answer(Outcome::Done);
    assert!(matches!(
        hall.candidate().stage(),
        CandidateStage::Flying { .. }
    ));
    hall.report(Some((name("00", 1), Stage::Over, false)));
    hall.until(hall.at + 2);
    assert_eq!(
        hall.candidate().tries()[0].ended.map(|it| it.1),
        Some(TryEnd::Over)
    );
    hall.until(hall.at + 25);
    let second = hall.asked().expect("she has not passed");
    assert_eq!(second.name, name("00", 2));
    assert_ne!(second.seed, first.seed);
    hall.report(Some((name("00", 2), Stage::Over, true)));
    hall.until(hall.at + 25);
    assert_eq!(hall.asked().expect("the next mission").name, name("01", 1));
    hall.report(Some((name("01", 1), Stage::Over, false)));
    hall.until(hall.at + 25);
    assert_eq!(hall.candidate().stage(), CandidateStage::Done);
}

#[test]
fn a_pass_leaves_the_other_tries_out() {
    let mut hall = Hall::flying();
    hall.report(Some((name("00", 1), Stage::Over, true)));
    hall.until(hall.at + 25);
    assert_eq!(hall.asked().expect("the next mission").name, name("01", 1));
}

#[test]
fn a_try_that_is_left_is_used_up_and_a_seat_that_is_away_keeps_its_own() {
    let mut hall = Hall::flying();
    hall.desk.leave(ConnectionId(1), seconds(hall.at));
    hall.until(hall.at + 20);
    assert!(matches!(
        hall.candidate().stage(),
        CandidateStage::Flying { .. }
    ));
    joined(&mut hall.desk, 1, "anna", 10);
    hall.report(Some((name("00", 1), Stage::Flying, false)));
    hall.until(hall.at + 10);
    assert!(matches!(
        hall.candidate().stage(),
        CandidateStage::Flying { .. }
    ));
    hall.report(None);
    hall.until(hall.at + 6);
    assert_eq!(
        hall.candidate().tries()[0].ended.map(|it| it.1),
        Some(TryEnd::Left)
    );
    assert_eq!(hall.candidate().number(), 2);
}

#[test]
fn a_seat_that_flies_on_after_its_time_is_asked_to_end_and_nothing_is_opened_after_the_end() {
    let mut hall = Hall::flying();
    hall.until(11 + 60 + 17);
    let newest = hall.desk.seats()[0].orders().next_back().expect("an order");
    assert_eq!(newest.order.deed, Deed::End);
    hall.report(None);
    hall.until(1015);
    assert_eq!(hall.candidate().stage(), CandidateStage::Closed);
}

#[test]
fn an_exam_ends_by_itself_after_its_end_time_once_nobody_flies() {
    let mut hall = Hall::flying();
    hall.until(1015);
    let is_stopped = |hall: &Hall| hall.desk.exam().expect("an exam").is_stopped();
    assert!(!is_stopped(&hall), "anna still flies");
    hall.report(None);
    hall.until(1030);
    assert!(is_stopped(&hall));
}

#[test]
fn a_seat_that_cannot_open_a_try_is_asked_again_and_one_that_flew_it_is_not() {
    let mut hall = Hall::new();
    hall.until(12);
    hall.answer(Outcome::Refused(Refusal::Flying));
    assert_eq!(hall.candidate().stage(), CandidateStage::Blocked);
    hall.until(hall.at + 12);
    assert!(matches!(
        hall.candidate().stage(),
        CandidateStage::Ordered(_)
    ));
    hall.answer(Outcome::Refused(Refusal::Flown));
    assert_eq!(hall.candidate().number(), 2);
}

#[test]
fn heads_are_noted_for_the_users_own_open_try_only() {
    let mut hall = Hall::flying();
    joined(&mut hall.desk, 2, "bohdan", 11);
    let head = head_of("flight", b"one\n");
    let seen = TryHead {
        name: name("00", 1),
        is_over: false,
        head: head.clone(),
    };
    let other = hall.desk.hear(
        ConnectionId(2),
        "bohdan",
        SeatMessage::Head(seen.clone()),
        seconds(hall.at),
    );
    assert_eq!(other, Ok(DeskHeard::Known), "bohdan takes no part");
    assert!(hall.desk.seat_candidates(&[1], seconds(hall.at)));
    let other = hall.desk.hear(
        ConnectionId(2),
        "bohdan",
        SeatMessage::Head(seen),
        seconds(hall.at),
    );
    assert_eq!(other, Ok(DeskHeard::Known), "it is not his try");
    let unknown = hall.head(name("01", 1), head.clone());
    assert_eq!(unknown, DeskHeard::Known, "it is not open");
    let noted = hall.head(name("00", 1), head.clone());
    assert!(matches!(noted, DeskHeard::Witnessed(_)));
    // The same again is confirmed, but not noted twice.
    let again = hall.head(name("00", 1), head);
    assert!(matches!(again, DeskHeard::Witnessed(_)));
    assert_eq!(hall.candidate().tries()[0].heads.len(), 1);
}

#[test]
fn a_desk_holds_one_exam_at_a_time() {
    let mut hall = Hall::flying();
    assert!(!hall.desk.hold(exam(ExamLayout::Own, 2)));
    let stopped = hall.desk.stop_exam(seconds(hall.at));
    assert_eq!(
        stopped.map(|plan| plan.name.to_string()),
        Some("final".to_owned())
    );
    assert_eq!(hall.desk.stop_exam(seconds(hall.at)), None);
    assert!(hall.desk.hold(exam(ExamLayout::Own, 2)));
}

/// A stage as far as a desk that is opened again knows it: whether the seat is asked to open a try, it finds out.
fn noted(stage: CandidateStage) -> CandidateStage {
    match stage {
        CandidateStage::Asked { .. } | CandidateStage::Ordered(_) | CandidateStage::Blocked => {
            CandidateStage::Waits
        }
        noted => noted,
    }
}

proptest! {
    /// Whatever a seat does, a desk that is opened again with the notes knows the same tries and heads.
    #[test]
    fn the_state_follows_from_the_notes(acts in prop::collection::vec((0_u8..8, 0_u32..3, 1_u64..40), 0..60)) {
        let mut hall = Hall::new();
        let mut content = Vec::new();
        for (act, number, pause) in acts {
            let meant = name(if act % 2 == 0 { "00" } else { "01" }, number);
            match act {
                0 | 1 => hall.report(Some((meant, Stage::Flying, false))),
                2 | 3 => hall.report(Some((meant, Stage::Over, number == 1))),
                4 => hall.report(None),
                5 if hall.asked().is_some() => hall.answer(Outcome::Done),
                6 => {
                    content.extend(b"line\n");
                    let current = hall.asked().map_or(meant, |it| it.name);
                    hall.head(current, head_of("flight", &content));
                }
                _ => {}
            }
            hall.until(hall.at + pause);
        }
        let found = Exam::of(plan(ExamLayout::Own), &hall.notes, EPOCH).expect("it began");
        let known = hall.desk.exam().expect("it is held");
        for (user, candidate) in known.candidates() {
            prop_assert_eq!(found.candidates()[user].tries(), candidate.tries());
            prop_assert_eq!(found.candidates()[user].mission(), candidate.mission());
            prop_assert_eq!(found.candidates()[user].number(), candidate.number());
            let stage = found.candidates()[user].stage();
            // That the time is over is no note: the clock says it.
            if candidate.stage() != CandidateStage::Closed {
                prop_assert_eq!(stage, noted(candidate.stage()));
            }
        }
        let text: Vec<String> = hall.notes.iter().map(|it| serde_json::to_string(it).expect("plain data")).collect();
        let read: Vec<ExamNote> = text.iter().map(|it| serde_json::from_str(it).expect("it was written so")).collect();
        prop_assert_eq!(read, hall.notes);
    }
}
