//! Notes that were cut off, and a file that cannot be written.

use super::*;
use crate::class::ExamSecret;
use crate::store;

const EXAM: &str = "schema = 1\ntitle = \"T\"\nabout = \"A\"\n\
    [[missions]]\nmission = \"00\"\ntries = 1\nminutes = 5\n";

fn first() -> ExamNote {
    ExamNote {
        at: 7,
        what: ExamDeed::Begun {
            exam: "final".to_owned(),
            source: EXAM.to_owned(),
            secret: ExamSecret::from([1; 32]),
        },
    }
}

fn seated(user: &str) -> ExamNote {
    let user = user.to_owned();
    ExamNote {
        at: 8,
        what: ExamDeed::Seated { user },
    }
}

#[test]
fn a_line_that_a_crash_has_cut_off_is_removed_before_the_next_note() {
    let data = tempfile::tempdir().expect("a folder");
    let records = ClassRecords::within(data.path(), "9-A");
    let written = ExamNotes::of(&records).append(7, &[first(), seated("anna")]);
    written.expect("a disk");
    let path = records.folder().join(".exams/7.jsonl");
    let text = fs::read_to_string(&path).expect("there");
    fs::write(&path, format!("{text}{{\"at\":9,\"sea")).expect("written");
    let mut notes = ExamNotes::of(&records);
    notes.append(7, &[seated("bohdan")]).expect("a disk");
    notes.append(7, &[seated("daria")]).expect("a disk");
    let (exams, faults) = notes.all(&store::course(), 0);
    assert!(faults.is_empty(), "{faults:?}");
    let users: Vec<&String> = exams[0].candidates().keys().collect();
    assert_eq!(users, ["anna", "bohdan", "daria"]);
    let again = notes.exam(7, &store::course(), 0);
    assert_eq!(again, Ok(exams.into_iter().next()));
    assert_eq!(notes.exam(8, &store::course(), 0), Ok(None));
}

#[test]
fn others_cannot_read_the_notes() {
    use std::os::unix::fs::PermissionsExt as _;

    let data = tempfile::tempdir().expect("a folder");
    let records = ClassRecords::within(data.path(), "9-A");
    let written = ExamNotes::of(&records).append(7, &[first()]);
    written.expect("a disk");
    let file = fs::metadata(records.folder().join(".exams/7.jsonl")).expect("there");
    assert_eq!(file.permissions().mode() & 0o777, 0o600);
}

#[test]
fn an_exam_whose_notes_are_damaged_is_not_continued() {
    let data = tempfile::tempdir().expect("a folder");
    let records = ClassRecords::within(data.path(), "9-A");
    let mut notes = ExamNotes::of(&records);
    notes.append(7, &[first(), seated("anna")]).expect("a disk");
    notes.append(8, &[first()]).expect("a disk");
    let path = records.folder().join(".exams/7.jsonl");
    let good = fs::read_to_string(&path).expect("there");
    let (begun, rest) = good.split_once('\n').expect("two lines");
    let late = rest.replace("\"at\":8", &format!("\"at\":{}", u64::MAX));
    assert_ne!(late, rest);
    for (damaged, line) in [
        (format!("{begun}\n{{\"at\":8,\n{rest}"), 2),
        (format!("{begun}\n{late}"), 2),
        (rest.to_owned(), 1),
    ] {
        fs::write(&path, &damaged).expect("written");
        let (exams, faults) = notes.all(&store::course(), 0);
        assert_eq!(exams.len(), 1, "the other exam is whole");
        let said: Vec<String> = faults.iter().map(ToString::to_string).collect();
        let place = format!("{}, line {line}: ", path.display());
        assert!(
            matches!(&said[..], [it] if it.starts_with(&place)),
            "{said:?}"
        );
        assert!(notes.exam(7, &store::course(), 0).is_err());
    }
}
