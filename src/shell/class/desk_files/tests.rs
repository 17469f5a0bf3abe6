//! A disk that cannot be written for some time.

use super::*;
use crate::class::{ExamDeed, ExamSecret, RecordName, TryHead, TryName};

fn seated(user: &str) -> DeskTask {
    let user = user.to_owned();
    let what = ExamDeed::Seated { user };
    DeskTask::Keep {
        begun: 7,
        notes: vec![ExamNote { at: 8, what }],
    }
}

fn begun() -> DeskTask {
    let what = ExamDeed::Begun {
        exam: "final".to_owned(),
        source: "schema = 1\ntitle = \"T\"\nabout = \"A\"\n\
            [[missions]]\nmission = \"00\"\ntries = 1\nminutes = 5\n"
            .to_owned(),
        secret: ExamSecret::from([1; 32]),
    };
    DeskTask::Keep {
        begun: 7,
        notes: vec![ExamNote { at: 7, what }],
    }
}

fn witnessed() -> DeskTask {
    let head = RecordHead {
        record: RecordName::try_from("flight".to_owned()).expect("a name"),
        bytes: 1,
        sha256: [0; 32].into(),
    };
    let name = TryName {
        exam: "final".into(),
        begun: 7,
        mission: "00-first-flight".into(),
        number: 1,
        opening: 1,
    };
    DeskTask::Take {
        connection: ConnectionId(1),
        user: "anna".to_owned(),
        heard: DeskHeard::Witnessed(TryHead {
            name,
            is_over: true,
            head,
        }),
    }
}

/// The numbers of notes that are on disk now, and the faults.
fn told(answers: &[DeskAnswer]) -> (Vec<usize>, usize) {
    let mut kept = Vec::new();
    let mut faults = 0;
    for answer in answers {
        if let DeskAnswer::Event(event) = answer {
            match **event {
                ClassEvent::Exam(ExamEvent::NotesKept { count, .. }) => kept.push(count),
                ClassEvent::Exam(ExamEvent::Failed(_)) => faults += 1,
                _ => {}
            }
        }
    }
    (kept, faults)
}

#[test]
fn notes_that_cannot_be_written_are_kept_and_written_later_in_their_order() {
    let data = tempfile::tempdir().expect("a folder");
    let records = ClassRecords::within(data.path(), "9-A");
    std::fs::create_dir_all(records.folder()).expect("created");
    // A file is where the folder of the notes should be.
    let folder = records.folder().join(".exams");
    std::fs::write(&folder, "").expect("written");
    let mut files = DeskFiles::new(records, "9-A", "petro");
    assert_eq!(told(&files.answer(begun())), (vec![], 1));
    assert_eq!(told(&files.answer(seated("anna"))), (vec![], 0), "known");
    assert!(files.answer(witnessed()).is_empty(), "its note is missing");
    assert_eq!(told(&files.answer(DeskTask::WriteAgain)), (vec![], 1));

    std::fs::remove_file(&folder).expect("removed");
    assert_eq!(told(&files.answer(DeskTask::WriteAgain)), (vec![1, 1], 0));
    assert!(files.answer(DeskTask::WriteAgain).is_empty(), "all is done");
    assert!(matches!(
        files.answer(witnessed())[..],
        [DeskAnswer::Say(..)]
    ));
    assert_eq!(told(&files.answer(seated("bohdan"))), (vec![1], 0));
    let (on_disk, faults) = files.notes.all(&files.course, files.epoch);
    assert!(faults.is_empty(), "{faults:?}");
    assert_eq!(on_disk, files.exams);
    let users: Vec<&String> = on_disk[0].candidates().keys().collect();
    assert_eq!(users, ["anna", "bohdan"]);
}
