//! Records that arrive in pieces, in a folder.

use std::fs;

use super::*;
use crate::class::protocol::DeskMessage;
use crate::class::{
    ConnectionId, PIECE, Piece, PieceBytes, PieceRequest, Receipt, Reception, SubmissionEnd,
    SubmissionRefusal, SubmittedPart,
};
use crate::store::{Records, WaitingRecords};

const CONNECTION: ConnectionId = ConnectionId(1);

fn name() -> RecordName {
    let name = "2026-11-20T14-03-22Z_00-first-flight_4711-00";
    RecordName::try_from(name.to_owned()).expect("a name")
}

/// The records of a seat: that of a mission with 100 kB, and some frames.
fn seat(folder: &Path) -> WaitingRecords {
    let records = Records::at(folder.join("runs"));
    fs::create_dir_all(records.folder()).expect("created");
    let file = |ending| {
        records
            .folder()
            .join(format!("{}{ending}", name().as_str()))
    };
    let run: Vec<u8> = (0..100_000u32).map(|it| it as u8).collect();
    fs::write(file(".run.jsonl"), run).expect("written");
    fs::write(file(".tlog"), "frames").expect("written");
    fs::write(file(".inputs.jsonl"), "").expect("written");
    WaitingRecords::new(&records, "/tmp/class/desk".to_owned())
}

fn desk(folder: &Path) -> Reception<ClassRecords> {
    Reception::new(ClassRecords::within(&folder.join("data"), "9-A"))
}

fn end(receipt: &Receipt) -> Option<SubmissionEnd> {
    match &receipt.answer {
        DeskMessage::Settled { end, .. } => Some(*end),
        _ => None,
    }
}

/// Hands in a record until this many pieces were taken; returns the last answer.
fn hand_in(desk: &mut Reception<ClassRecords>, seat: &WaitingRecords, pieces: usize) -> Receipt {
    let submission = seat.submission(&name()).expect("readable");
    let mut receipt = desk.begin(CONNECTION, "anna", &submission);
    for _ in 0..pieces {
        let DeskMessage::Fetch(request) = &receipt.answer else {
            break;
        };
        let piece = seat.piece(request).expect("readable");
        receipt = desk.take(CONNECTION, "anna", &piece).expect("an answer");
    }
    receipt
}

fn kept(folder: &Path) -> Vec<KeptRecord> {
    ClassRecords::within(&folder.join("data"), "9-A").all()
}

#[test]
fn a_record_arrives_in_pieces_and_is_the_same() {
    let folder = tempfile::tempdir().expect("a folder");
    let (seat, mut desk) = (seat(folder.path()), desk(folder.path()));
    let receipt = hand_in(&mut desk, &seat, 100);
    assert_eq!(end(&receipt), Some(SubmissionEnd::Kept));
    let kept = kept(folder.path());
    assert_eq!(kept.len(), 1);
    assert_eq!(
        (kept[0].user.as_str(), kept[0].files.stem.as_str()),
        ("anna", name().as_str())
    );
    let run = kept[0].files.run.as_deref().expect("the run");
    let own = folder
        .path()
        .join("runs")
        .join(run.file_name().expect("a name"));
    assert_eq!(
        fs::read(run).expect("readable"),
        fs::read(own).expect("readable")
    );
    assert!(kept[0].files.frames.is_some() && kept[0].files.inputs.is_some());
    // Offered again, it is there.
    let again = hand_in(&mut desk, &seat, 0);
    assert_eq!((end(&again), again.news), (Some(SubmissionEnd::Kept), None));
}

#[test]
fn a_broken_hand_in_goes_on_where_it_ended_also_at_a_new_desk() {
    let folder = tempfile::tempdir().expect("a folder");
    let (seat, mut first) = (seat(folder.path()), desk(folder.path()));
    let receipt = hand_in(&mut first, &seat, 2);
    assert!(end(&receipt).is_none() && kept(folder.path()).is_empty());
    drop(first);
    let mut second = desk(folder.path());
    let receipt = hand_in(&mut second, &seat, 0);
    let expected = PieceRequest {
        record: name(),
        part: RecordPart::Run,
        from: 2 * PIECE as u64,
    };
    assert_eq!(receipt.answer, DeskMessage::Fetch(expected));
    assert_eq!(
        end(&hand_in(&mut second, &seat, 100)),
        Some(SubmissionEnd::Kept)
    );
}

#[test]
fn a_wrong_hash_is_refused_and_the_next_attempt_begins_anew() {
    let folder = tempfile::tempdir().expect("a folder");
    let (seat, mut desk) = (seat(folder.path()), desk(folder.path()));
    let mut submission = seat.submission(&name()).expect("readable");
    submission.parts[0].sha256 = "0".repeat(64);
    let mut receipt = desk.begin(CONNECTION, "anna", &submission);
    while let DeskMessage::Fetch(request) = &receipt.answer {
        let piece = seat.piece(request).expect("readable");
        receipt = desk.take(CONNECTION, "anna", &piece).expect("an answer");
    }
    let damaged = SubmissionEnd::Refused(SubmissionRefusal::Damaged);
    assert_eq!(end(&receipt), Some(damaged));
    assert!(kept(folder.path()).is_empty());
    assert_eq!(
        end(&hand_in(&mut desk, &seat, 100)),
        Some(SubmissionEnd::Kept)
    );
}

#[test]
fn a_piece_that_was_not_asked_for_changes_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let (seat, mut desk) = (seat(folder.path()), desk(folder.path()));
    hand_in(&mut desk, &seat, 1);
    let foreign = Piece {
        of: PieceRequest {
            record: name(),
            part: RecordPart::Run,
            from: 7,
        },
        data: PieceBytes(vec![1; 10]),
    };
    assert_eq!(desk.take(CONNECTION, "anna", &foreign), None);
    // Another connection has offered nothing.
    assert_eq!(desk.take(ConnectionId(2), "eve", &foreign), None);
    assert_eq!(
        end(&hand_in(&mut desk, &seat, 100)),
        Some(SubmissionEnd::Kept)
    );
}

#[test]
fn each_user_has_a_folder_and_no_name_leads_out_of_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let (seat, mut desk) = (seat(folder.path()), desk(folder.path()));
    let submission = seat.submission(&name()).expect("readable");
    for user in ["../../etc", "."] {
        let receipt = desk.begin(CONNECTION, user, &submission);
        let DeskMessage::Fetch(request) = &receipt.answer else {
            panic!("{receipt:?}");
        };
        let piece = seat.piece(request).expect("readable");
        desk.take(CONNECTION, user, &piece).expect("an answer");
    }
    let class = folder.path().join("data/classes/9-A");
    assert_eq!(folders_in(&class), ["_", "_._.._etc"].map(str::to_owned));
    for wrong in ["", "../x", ".x", "a/b", "a b", &"x".repeat(200)] {
        assert!(RecordName::try_from(wrong.to_owned()).is_err(), "{wrong}");
    }
}

#[test]
fn another_record_under_a_known_name_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let (seat, mut desk) = (seat(folder.path()), desk(folder.path()));
    hand_in(&mut desk, &seat, 100);
    let mut other = seat.submission(&name()).expect("readable");
    other.parts[0].sha256 = "1".repeat(64);
    let refused = SubmissionEnd::Refused(SubmissionRefusal::Different);
    assert_eq!(end(&desk.begin(CONNECTION, "anna", &other)), Some(refused));
    let part = SubmittedPart {
        bytes: u64::MAX,
        ..other.parts[0].clone()
    };
    let parts = vec![part];
    let impossible = Submission { parts, ..other };
    let refused = SubmissionEnd::Refused(SubmissionRefusal::Impossible);
    assert_eq!(
        end(&desk.begin(CONNECTION, "bohdan", &impossible)),
        Some(refused)
    );
}

#[test]
fn marks_name_the_class_to_which_a_record_belongs() {
    let folder = tempfile::tempdir().expect("a folder");
    let seat = seat(folder.path());
    assert!(seat.marked().is_empty());
    seat.mark(&name()).expect("written");
    assert_eq!(seat.marked(), [name()]);
    let records = Records::at(folder.path().join("runs"));
    let other = WaitingRecords::new(&records, "/tmp/other/desk".to_owned());
    assert!(other.marked().is_empty(), "it was flown in another class");
    seat.unmark(&name());
    assert!(seat.marked().is_empty());
}
