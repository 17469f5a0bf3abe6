//! Tries of exams on the command line: reports, exports, and what `verify` says of a seal.

use std::time::Duration;

use sha2::{Digest as _, Sha256};
use sortie::class::protocol::{Hello, SeatMessage, VERSION};
use sortie::class::{
    ConnectionId, ContentHash, Deed, Desk, Exam, ExamDeed, ExamNote, ExamSecret, RecordName,
    RecordPart, SeatReport, Submission, SubmittedPart,
};
use sortie::exam_plan::ExamFile;
use sortie::store::{
    ClassRecords, DeskKey, ExamNotes, SealedTry, class_flight, course, seal_record,
};

use super::*;

const EXAM: &str = "schema = 1\ntitle = \"T\"\nabout = \"A\"\n\
    [[missions]]\nmission = \"00\"\ntries = 2\nminutes = 5\n";

/// An instructor's data folder after an exam of anna, who has handed in the record of her first try.
struct Held {
    folder: tempfile::TempDir,
    records: ClassRecords,
}

impl Held {
    fn new() -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let records = ClassRecords::within(&folder.path().join("sortie"), "9-A");
        let (mut notes, seed) = asked();
        let Some(ExamDeed::Asked { name, .. }) = notes.last().map(|it| it.what.clone()) else {
            panic!("{notes:?}");
        };
        let user = "anna".to_owned();
        notes.push(ExamNote {
            at: 2,
            what: ExamDeed::Opened { user, name },
        });
        let written = ExamNotes::of(&records).append(1, &notes);
        written.expect("a disk");
        let held = Self { folder, records };
        held.hand_in(seed);
        held
    }

    /// Hands in a flight with a seed. The pilot of the test is said to be a hand.
    fn hand_in(&self, seed: u64) {
        let seed = seed.to_string();
        let run = [
            "run", "00", "--pilot", "00", "--record", "rec", "--seed", &seed,
        ];
        let output = sortie_in(self.folder.path(), &run);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        let own = self.records.folder().join("anna");
        fs::create_dir_all(&own).expect("created");
        let rec = self.folder.path().join("rec");
        let names = fs::read_dir(&rec).expect("recorded").flatten();
        let mut stems = names.filter_map(|entry| {
            let name = entry.file_name().into_string().ok()?;
            Some(name.strip_suffix(".run.jsonl")?.to_owned())
        });
        let stem = stems.next().expect("the run");
        let mut parts = Vec::new();
        for (part, ending) in [
            (RecordPart::Run, ".run.jsonl"),
            (RecordPart::Inputs, ".inputs.jsonl"),
        ] {
            let name = format!("{stem}{ending}");
            let mut content = fs::read_to_string(rec.join(&name)).expect("recorded");
            if part == RecordPart::Run {
                content = by_hand(&content);
            }
            parts.push(SubmittedPart {
                part,
                bytes: content.len() as u64,
                sha256: hash_of(&content),
            });
            fs::write(own.join(name), content).expect("written");
        }
        let record = RecordName::try_from(stem.clone()).expect("a name");
        let submission = serde_json::to_string(&Submission { record, parts }).expect("plain data");
        fs::write(own.join(format!("{stem}.submission.json")), submission).expect("written");
    }

    /// The record that was handed in is that of a flight which was left: it has no end.
    fn leave(&self) {
        let files = self.records.all().pop().expect("it was handed in").files;
        let run = files.run.expect("a run");
        let content = fs::read_to_string(&run).expect("recorded");
        let flown = content.lines().filter(|line| !line.contains("\"end\""));
        let flown = flown.collect::<Vec<_>>().join("\n") + "\n";
        let list = run.with_file_name(format!("{}.submission.json", files.stem));
        let listed = fs::read_to_string(&list).expect("written");
        let mut listed: Submission = serde_json::from_str(&listed).expect("plain data");
        let parts = listed.parts.iter_mut();
        for part in parts.filter(|it| it.part == RecordPart::Run) {
            (part.bytes, part.sha256) = (flown.len() as u64, hash_of(&flown));
        }
        fs::write(&run, flown).expect("written");
        let listed = serde_json::to_string(&listed).expect("plain data");
        fs::write(list, listed).expect("written");
    }

    fn sortie(&self, arguments: &[&str]) -> Output {
        sortie_in(self.folder.path(), arguments)
    }

    /// Seals the record.
    fn seal(&self) {
        let (exams, _) = ExamNotes::of(&self.records).all(&course(), 0);
        let kept = self.records.all().pop().expect("it was handed in");
        let flight = class_flight(&kept, None, &exams).expect("it can be scored");
        let sealed = SealedTry {
            class: "9-A",
            exam: &exams[0],
            flown: exams[0].try_of("anna", flight.seed).expect("it is a try"),
            kept: &kept,
            flight: &flight,
            handed_in: 100,
        };
        let key = DeskKey::open(self.records.data()).expect("a key");
        seal_record(&self.records, &sealed, &key).expect("a disk");
    }
}

fn hash_of(content: &str) -> String {
    let digest: [u8; 32] = Sha256::digest(content).into();
    ContentHash::from(digest).as_str().to_owned()
}

/// A record as if it had been flown by hand, for a grade. Its checksum is left out, as in older records.
fn by_hand(record: &str) -> String {
    let mut head: serde_json::Value =
        serde_json::from_str(record.lines().next().expect("a head")).expect("JSON");
    head["flown_by"] = "hand".into();
    head["stake"] = "graded".into();
    let mut lines = vec![head.to_string()];
    for line in record.lines().skip(1) {
        let mut value: serde_json::Value = serde_json::from_str(line).expect("JSON");
        if let Some(end) = value.get_mut("end").and_then(|it| it.as_object_mut()) {
            end.remove("checksum");
        }
        lines.push(value.to_string());
    }
    lines.join("\n") + "\n"
}

/// The notes of an exam until anna's seat is asked to open a try, and its seed.
fn asked() -> (Vec<ExamNote>, u64) {
    let plan = ExamFile::parse("final", EXAM, &course())
        .expect("no faults")
        .plan;
    let first = ExamNote {
        at: 1,
        what: ExamDeed::Begun {
            exam: "final".to_owned(),
            source: EXAM.to_owned(),
            secret: ExamSecret::from([1; 32]),
        },
    };
    let mut desk = Desk::new(1, "9-A".into(), "petro".into());
    assert!(desk.hold(Exam::begin(plan, first, 1).expect("a first note")));
    let hello = SeatMessage::Hello(Hello {
        protocol: VERSION,
        sitting: 1,
        name: None,
    });
    let report = SeatMessage::Report {
        last: 0,
        report: Box::new(SeatReport::default()),
    };
    for message in [hello, report] {
        let heard = desk.hear(ConnectionId(1), "anna", message, Duration::ZERO);
        heard.expect("she is known");
    }
    assert!(desk.seat_candidates(&[0], Duration::ZERO));
    let mut notes = Vec::new();
    for _ in 0..2 {
        desk.examine(Duration::ZERO);
        for (begun, new) in desk.take_exam_notes() {
            desk.exam_notes_kept(begun, new.len());
            notes.extend(new);
        }
    }
    let order = desk.seats()[0].orders().next_back().expect("an order");
    let Deed::Examine(opened) = &order.order.deed else {
        panic!("{order:?}");
    };
    (notes, opened.seed)
}

#[test]
fn a_try_counts_in_exports_only_once_it_is_sealed_so() {
    let held = Held::new();
    let grades = [
        "class", "export", "9-A", "--output", "-", "--format", "moodle",
    ];
    let unsealed = text(&held.sortie(&grades).stdout);
    assert_eq!(unsealed, "username\r\nanna\r\n", "no grade");
    let report = text(&held.sortie(&["class", "report", "9-A"]).stdout);
    assert!(report.contains("there is no seal yet"), "{report}");
    held.seal();
    // The desk has seen nothing of it, so it still does not count.
    assert_eq!(text(&held.sortie(&grades).stdout), unsealed);
    let report = text(&held.sortie(&["class", "report", "9-A"]).stdout);
    assert!(report.contains("1/2"), "{report}");
    assert!(report.contains("the desk saw nothing of it"), "{report}");
    // Without its notes, the desk does not know that it is a try.
    fs::remove_dir_all(held.records.folder().join(".exams")).expect("removed");
    let kept = held.records.all().pop().expect("it is there");
    let run = kept.files.run.expect("a run");
    let seal = run.with_file_name(format!("{}.seal.json", kept.files.stem));
    fs::remove_file(seal).expect("removed");
    let graded = text(&held.sortie(&grades).stdout);
    assert!(graded.contains("anna,100.0"), "{graded}");
}

/// It was once reported with a score of 0.
#[test]
fn a_try_that_was_left_has_no_result_in_the_report() {
    let held = Held::new();
    let score = |held: &Held| {
        let report = text(&held.sortie(&["class", "report", "9-A"]).stdout);
        let row = report.lines().find(|line| line.contains(" 1/2 "));
        let row = row.expect("the try").to_owned();
        let after = row.split(" 1/2 ").nth(1).expect("columns");
        (
            after.split_whitespace().next().expect("a score").to_owned(),
            report,
        )
    };
    held.leave();
    held.seal();
    let (shown, report) = score(&held);
    assert_eq!(shown, "-", "{report}");
    assert!(report.contains("the flight was left"), "{report}");
}

#[test]
fn a_try_without_a_record_is_reported() {
    let held = Held::new();
    fs::remove_dir_all(held.records.folder().join("anna")).expect("removed");
    let report = text(&held.sortie(&["class", "report", "9-A"]).stdout);
    assert!(report.contains("no record was handed in"), "{report}");
}

#[test]
fn verify_says_what_the_seal_of_a_record_is() {
    let held = Held::new();
    held.seal();
    let kept = held.records.all().pop().expect("it is there");
    let run = kept.files.run.expect("a run").display().to_string();
    let own = held.sortie(&["verify", &run]);
    let own = text(&own.stdout);
    assert!(own.contains("Seal of class 9-A, exam final: anna"), "{own}");
    assert!(own.contains("Key of this desk"), "{own}");
    assert!(own.contains("The try does not count"), "{own}");

    let mut record = fs::read_to_string(&run).expect("there");
    record.push('\n');
    fs::write(&run, record).expect("written");
    let changed = held.sortie(&["verify", &run]);
    assert_eq!(changed.status.code(), Some(1));
    let changed = text(&changed.stdout);
    assert!(
        changed.contains("is not the file that was sealed"),
        "{changed}"
    );
}
