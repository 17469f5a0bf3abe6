//! The verdict of each try, which does not depend on when the exam ends.

use super::*;

/// What the seat of the try does.
#[derive(Debug, Clone, Copy)]
enum Deeds {
    /// It says that the mission is over, and whether it was passed.
    Over(bool),
    /// It flies nothing any more.
    Leave,
    /// It flies until its time is up.
    FlyOn,
    /// Its connection breaks, and it does not come back.
    Break,
}

/// The verdict of the first try, whose seat does this. If the exam is stopped meanwhile, it is before or after that.
fn verdict(deeds: Deeds, stopped: Option<bool>) -> TryVerdict {
    let mut hall = Hall::flying();
    let stop = |hall: &mut Hall, is_before| {
        if stopped == Some(is_before) {
            assert!(hall.desk.stop_exam(seconds(hall.at)).is_some());
        }
    };
    stop(&mut hall, true);
    match deeds {
        Deeds::Over(is_passed) => {
            hall.report(Some((name("00", 1), Stage::Over, is_passed)));
        }
        Deeds::Leave => hall.report(None),
        Deeds::FlyOn => {
            hall.until(11 + 60);
            hall.report(Some((name("00", 1), Stage::Over, false)));
        }
        Deeds::Break => hall.desk.leave(ConnectionId(1), seconds(hall.at)),
    }
    hall.until(hall.at + 1);
    stop(&mut hall, false);
    hall.until(hall.at + 120);
    // A desk that is opened again knows the same.
    let found = Exam::of(plan(ExamLayout::Own), &hall.notes, EPOCH).expect("it began");
    let at = EPOCH + hall.at;
    let verdict = hall.candidate().tries()[0].verdict(at);
    assert_eq!(found.candidates()["anna"].tries()[0].verdict(at), verdict);
    verdict
}

#[test]
fn the_verdict_of_a_try_does_not_depend_on_when_the_exam_is_stopped() {
    for (deeds, expected) in [
        (Deeds::Over(true), TryVerdict::Passed),
        (Deeds::Over(false), TryVerdict::Failed),
        (Deeds::Leave, TryVerdict::Left),
        (Deeds::FlyOn, TryVerdict::TimeUp),
        (Deeds::Break, TryVerdict::Unseen),
    ] {
        for stopped in [None, Some(true), Some(false)] {
            assert_eq!(verdict(deeds, stopped), expected, "{deeds:?} {stopped:?}");
        }
    }
}

#[test]
fn a_try_is_open_until_its_end_or_its_time() {
    let hall = Hall::flying();
    let at = |at: u64| hall.candidate().tries()[0].verdict(EPOCH + at);
    assert_eq!(at(hall.at), TryVerdict::Open);
    assert_eq!(at(11 + 60 + 60), TryVerdict::Unseen, "the desk was away");
}

#[test]
fn an_exam_that_is_stopped_opens_no_more_tries_and_is_watched_while_one_is_flown() {
    let mut hall = Hall::flying();
    hall.desk.stop_exam(seconds(hall.at));
    assert!(matches!(
        hall.candidate().stage(),
        CandidateStage::Flying { .. }
    ));
    let is_watched = |hall: &Hall| {
        let exam = Exam::of(plan(ExamLayout::Own), &hall.notes, EPOCH).expect("it began");
        exam.is_watched(EPOCH + hall.at)
    };
    hall.until(hall.at + 1);
    assert!(is_watched(&hall), "a desk that is opened again watches it");
    let newest = hall.asked();
    hall.report(None);
    hall.until(hall.at + 60);
    assert_eq!(hall.candidate().stage(), CandidateStage::Closed);
    assert_eq!(hall.asked(), newest);
    assert!(!is_watched(&hall));
}

/// It was once worth nothing: no head of its record was noted any more, and its end was not seen.
#[test]
fn a_try_is_witnessed_to_its_end_while_another_exam_is_held() {
    let mut hall = Hall::flying();
    hall.desk.stop_exam(seconds(hall.at));
    hall.keep_notes();
    // Also by a desk that is opened again meanwhile.
    let found = Exam::of(plan(ExamLayout::Own), &hall.notes, EPOCH).expect("it began");
    let mut again = desk();
    joined(&mut again, 1, "anna", 10);
    again.see_out(found);
    assert!(again.exam().is_some_and(Exam::is_stopped));
    hall.desk = again;
    hall.report(Some((name("00", 1), Stage::Flying, false)));

    let late = ExamNote {
        at: EPOCH + 13,
        ..first_note(2)
    };
    let other = Exam::of(plan(ExamLayout::Own), &[late], EPOCH).expect("it began");
    assert!(hall.desk.hold(other));
    assert!(hall.desk.seat_candidates(&[0], seconds(hall.at)));
    hall.until(hall.at + 30);
    assert_eq!(hall.asked(), None, "she still flies the other one");
    let head = head_of("flight", b"1 one\n");
    let noted = hall.head(name("00", 1), head);
    assert!(matches!(noted, DeskHeard::Witnessed(_)), "{noted:?}");
    hall.report(Some((name("00", 1), Stage::Over, true)));
    hall.until(hall.at + 1);
    let end = TryHead {
        name: name("00", 1),
        is_over: true,
        head: head_of("flight", b"1 one\n2 two\n"),
    };
    let noted = hall.try_head(end);
    assert!(matches!(noted, DeskHeard::Witnessed(_)), "{noted:?}");
    let known = Exam::of(plan(ExamLayout::Own), &hall.notes, EPOCH).expect("it began");
    let flown = &known.candidates()["anna"].tries()[0];
    assert_eq!(flown.verdict(EPOCH + hall.at), TryVerdict::Passed);
    assert!(flown.has_end_seen(12) && !flown.was_desk_away);

    hall.until(hall.at + 10);
    assert_eq!(hall.asked(), None, "she sees how it has ended");
    hall.until(hall.at + 15);
    let asked = hall.asked().expect("the other one opens its first try");
    assert_eq!(asked.name.begun, EPOCH + 13);
}

#[test]
fn a_try_that_was_being_opened_when_the_exam_was_stopped_is_watched() {
    let mut hall = Hall::new();
    hall.until(12);
    hall.desk.stop_exam(seconds(hall.at));
    hall.report(Some((name("00", 1), Stage::Reading, false)));
    hall.until(hall.at + 1);
    assert!(matches!(
        hall.candidate().stage(),
        CandidateStage::Flying { .. }
    ));
    let mut hall = Hall::new();
    hall.until(12);
    hall.desk.stop_exam(seconds(hall.at));
    hall.answer(Outcome::Refused(Refusal::Flying));
    hall.until(hall.at + 1);
    assert_eq!(hall.candidate().stage(), CandidateStage::Closed);
}
