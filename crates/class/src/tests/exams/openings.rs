//! When a seat is asked to open a try, and with which seed.

use super::*;

#[test]
fn a_seat_is_asked_to_open_a_try_only_once_that_is_on_disk() {
    let mut hall = Hall::new();
    hall.is_full = true;
    hall.until(20);
    assert_eq!(hall.asked(), None, "it is not noted yet");
    hall.is_full = false;
    hall.until(22);
    let first = hall.asked().expect("it is noted");
    let noted = hall.notes.iter().filter_map(|note| match &note.what {
        ExamDeed::Asked { name, until, .. } => Some((name.clone(), *until)),
        _ => None,
    });
    assert_eq!(noted.collect::<Vec<_>>(), [(first.name, EPOCH + 70)]);
}

#[test]
fn an_exam_begins_once_its_first_note_is_on_disk() {
    let first = first_note(1);
    let new = Exam::begin(plan(ExamLayout::Own), first.clone(), EPOCH).expect("a first note");
    let mut desk = desk();
    assert!(desk.hold(new));
    assert!(!desk.exam().is_some_and(Exam::has_begun));
    assert_eq!(desk.take_exam_notes(), [(EPOCH, vec![first])]);
    assert!(!desk.exam_notes_kept(EPOCH + 1, 1), "of another exam");
    assert!(desk.exam_notes_kept(EPOCH, 1));
    assert!(desk.exam().is_some_and(Exam::has_begun));
    assert!(!desk.exam_notes_kept(EPOCH, 1), "it has begun before");
}

#[test]
fn the_seed_of_an_opening_that_was_refused_is_not_used_again() {
    let mut hall = Hall::new();
    hall.until(12);
    let first = hall.asked().expect("it is open");
    hall.answer(Outcome::Refused(Refusal::Flying));
    hall.until(hall.at + 12);
    let second = hall.asked().expect("it is asked again");
    assert!(second.name.is_same_try(&first.name));
    assert_ne!(second.seed, first.seed);
    let exam = hall.desk.exam().expect("an exam");
    assert_eq!(exam.try_of("anna", first.seed), None);
    let meant = exam.try_of("anna", second.seed);
    assert_eq!(meant.map(|it| it.name.opening), Some(2));
}

#[test]
fn a_desk_that_is_opened_again_asks_anew_unless_the_try_is_flown() {
    let mut hall = Hall::new();
    hall.until(12);
    let first = hall.asked().expect("it is open");
    let found = || Exam::of(plan(ExamLayout::Own), &hall.notes, EPOCH).expect("it began");
    let mut again = desk();
    joined(&mut again, 1, "anna", 10);
    assert!(again.hold(found()));
    let flight = FlightReport {
        exam_try: Some(FlownTry {
            name: first.name.clone(),
            is_passed: false,
        }),
        ..FlightReport::default()
    };
    let heard = again.hear(ConnectionId(1), "anna", report(Some(flight)), seconds(40));
    assert_eq!(heard, Ok(DeskHeard::Known));
    again.examine(seconds(40));
    let seen = again.candidacy(&again.seats()[0], seconds(40));
    let (_, candidate) = seen.expect("she takes part");
    let until = EPOCH + 70;
    assert_eq!(candidate.stage(), CandidateStage::Flying { until });
    assert_eq!(candidate.tries()[0].name.opening, 1);

    let mut again = desk();
    joined(&mut again, 1, "anna", 10);
    assert!(again.hold(found()));
    let heard = again.hear(ConnectionId(1), "anna", report(None), seconds(40));
    assert_eq!(heard, Ok(DeskHeard::Known));
    again.examine(seconds(40));
    let seen = again.candidacy(&again.seats()[0], seconds(40));
    let (_, candidate) = seen.expect("she takes part");
    assert_eq!(candidate.tries()[0].name.opening, 2);
}

#[test]
fn only_the_seat_that_opened_a_try_can_have_left_it() {
    let mut hall = Hall::flying();
    joined(&mut hall.desk, 2, "anna", 11);
    hall.desk.leave(ConnectionId(1), seconds(hall.at));
    let other = hall
        .desk
        .hear(ConnectionId(2), "anna", report(None), seconds(hall.at));
    assert_eq!(other, Ok(DeskHeard::Known));
    hall.until(hall.at + 20);
    let is_flying = matches!(hall.candidate().stage(), CandidateStage::Flying { .. });
    assert!(is_flying, "her other console does not fly it");
    joined(&mut hall.desk, 1, "anna", 10);
    hall.report(None);
    hall.until(hall.at + 6);
    let ended = hall.candidate().tries()[0].ended.map(|it| it.1);
    assert_eq!(ended, Some(TryEnd::Left));
}

#[test]
fn a_seat_that_answers_after_the_next_opening_keeps_the_one_that_it_flies() {
    let mut hall = Hall::new();
    hall.until(12);
    let first = hall.asked().expect("it is open");
    // No answer: the order is given up, and the seat asked anew.
    hall.until(60);
    let newest = hall.asked().expect("it is asked again");
    assert!(newest.name.opening > 1, "{newest:?}");
    hall.report(Some((first.name.clone(), Stage::Flying, false)));
    hall.answer(Outcome::Refused(Refusal::Flying));
    hall.until(hall.at + 2);
    let until = EPOCH + 70;
    assert_eq!(hall.candidate().stage(), CandidateStage::Flying { until });
    let head = head_of("flight", b"1 one\n");
    let noted = hall.head(first.name.clone(), head);
    assert!(matches!(noted, DeskHeard::Witnessed(_)), "{noted:?}");
    let exam = hall.desk.exam().expect("an exam");
    let flown = exam
        .try_of("anna", first.seed)
        .expect("its record is known");
    assert_eq!((&flown.name, flown.heads.len()), (&first.name, 1));
    assert!(flown.openings.len() > 1);
    assert_eq!(exam.try_of("anna", newest.seed), None);
}

#[test]
fn a_seat_cannot_fly_an_opening_that_it_was_not_asked_for() {
    let mut hall = Hall::new();
    hall.until(12);
    let mut name = hall.asked().expect("it is open").name;
    name.opening = 7;
    hall.report(Some((name, Stage::Flying, false)));
    hall.until(hall.at + 2);
    assert!(matches!(
        hall.candidate().stage(),
        CandidateStage::Ordered(_)
    ));
}

#[test]
fn a_try_that_a_desk_sees_late_because_it_was_away_is_not_late() {
    let mut hall = Hall::new();
    hall.until(12);
    let flight = FlightReport {
        exam_try: Some(FlownTry {
            name: name("00", 1),
            is_passed: false,
        }),
        ..FlightReport::default()
    };
    // The desk is killed before it has noted that the try is open, and opened again near its end.
    let found = Exam::of(plan(ExamLayout::Own), &hall.notes, EPOCH).expect("it began");
    let mut again = desk();
    joined(&mut again, 1, "anna", 10);
    assert!(again.hold(found));
    let heard = again.hear(ConnectionId(1), "anna", report(Some(flight)), seconds(65));
    assert_eq!(heard, Ok(DeskHeard::Known));
    again.examine(seconds(65));
    let seen = again.candidacy(&again.seats()[0], seconds(65));
    let (_, candidate) = seen.expect("she takes part");
    let flown = &candidate.tries()[0];
    assert_eq!(flown.opened, Some(EPOCH + 65));
    assert!(!Exam::is_late(flown, 100, seconds(50)));
    assert!(Exam::is_late(flown, 100, seconds(90)));
}
