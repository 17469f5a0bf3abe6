//! Seals beside records, and what is wrong with them.

use std::fs;

use super::*;
use crate::campaign::CareerFlight;
use crate::class::{
    ExamDeed, ExamLayout, ExamMission, ExamNote, ExamPlan, ExamSecret, RecordHead, SubmittedPart,
    TimedHead, TryName, TryOpening,
};
use crate::exam_seal::FlownAgain;
use crate::mission::fake::Pilot;
use crate::mission::record::Occasion;
use crate::record::InstructorPart;
use crate::scoring::{FlightBackend, FlownBy};
use crate::store::hashes::sha256_of_nothing;
use crate::text;

const STEM: &str = "2026-11-20T14-03-22Z_00-first-flight_4711-00";

/// A data folder in which anna of the class 9-A has handed in a record that the desk has sealed.
struct Shelf {
    data: tempfile::TempDir,
    key: DeskKey,
}

impl Shelf {
    fn new() -> Self {
        let data = tempfile::tempdir().expect("a folder");
        let own = data.path().join("classes/9-A/anna");
        fs::create_dir_all(&own).expect("created");
        fs::write(own.join(format!("{STEM}.run.jsonl")), "{}\n").expect("written");
        let key = DeskKey::open(data.path()).expect("a key");
        Self { data, key }
    }

    fn own(&self) -> PathBuf {
        self.data.path().join("classes/9-A/anna")
    }

    fn seal(&self) -> Seal {
        let run = self.own().join(format!("{STEM}.run.jsonl"));
        let moment = "2026-11-20T14:03:22Z".to_owned();
        Seal {
            sortie_seal: SEAL,
            class: "9-A".to_owned(),
            exam: "final".to_owned(),
            exam_sha256: sha256_of_nothing(),
            begun: moment.clone(),
            user: "anna".to_owned(),
            mission: "00-first-flight".to_owned(),
            number: 1,
            tries: 1,
            openings: 1,
            seed: 1,
            record: STEM.to_owned(),
            files: vec![SubmittedPart {
                part: RecordPart::Run,
                bytes: 3,
                sha256: sha256_of(&run).expect("readable"),
            }],
            score: 500,
            passed: true,
            opened: None,
            until: moment.clone(),
            ended: None,
            handed_in: moment,
            witness: Witness::Whole { heads: 1 },
            reasons: Vec::new(),
            public_key: self.key.public().to_owned(),
        }
    }

    /// Signs a seal; what is wrong with it.
    fn fault(&self, seal: &Seal) -> Option<SealFault> {
        let path = self.own().join(format!("{STEM}{SEAL_ENDING}"));
        let text = serde_json::to_string(seal).expect("plain data");
        fs::write(&path, text).expect("written");
        signature::sign(&path, &self.key.key, "exam:final").expect("signed");
        check(&self.own(), None).fault
    }
}

fn check(folder: &Path, key: Option<&str>) -> SealCheck {
    let files = RecordFiles::beside(&folder.join(format!("{STEM}.run.jsonl")));
    check_seal(&files, key).expect("a seal")
}

#[test]
fn a_file_that_is_not_in_the_seal_is_named() {
    let shelf = Shelf::new();
    assert_eq!(shelf.fault(&shelf.seal()), None);
    let name = format!("{STEM}.inputs.jsonl");
    fs::write(shelf.own().join(&name), "{}\n").expect("written");
    let fault = check(&shelf.own(), None).fault;
    assert_eq!(fault, Some(SealFault::NotSealed(name)));
}

#[test]
fn the_key_in_a_seal_is_never_a_path() {
    let shelf = Shelf::new();
    let path = signature::public_key_in(&shelf.data.path().join(DESK_KEY));
    let seal = Seal {
        public_key: path.display().to_string(),
        ..shelf.seal()
    };
    assert_eq!(shelf.fault(&seal), Some(SealFault::Damaged));
}

#[test]
fn a_seal_of_another_class_or_user_is_told_apart_however_its_path_is_written() {
    let shelf = Shelf::new();
    let class = "9-B".to_owned();
    let other = Seal {
        class: class.clone(),
        ..shelf.seal()
    };
    assert_eq!(shelf.fault(&other), Some(SealFault::OtherClass(class)));
    let user = "bohdan".to_owned();
    let other = Seal {
        user: user.clone(),
        ..shelf.seal()
    };
    let fault = Some(SealFault::OtherUser(user));
    assert_eq!(shelf.fault(&other), fault);
    // The folders above are not named in this path.
    let around = shelf.own().join("../../9-A/../9-A/anna/.");
    assert_eq!(check(&around, None).fault, fault);
}

#[test]
fn a_try_counts_for_certain_only_with_a_known_key() {
    let shelf = Shelf::new();
    assert_eq!(shelf.fault(&shelf.seal()), None);
    let unknown = check(&shelf.own(), None);
    assert_eq!(unknown.standing(), text!("seal-key-not-compared"));
    let known = check(&shelf.own(), Some(shelf.key.public()));
    assert_eq!(known.standing(), text!("seal-counts"));
}

#[test]
fn a_changed_seal_or_record_and_another_key_are_told_apart() {
    let shelf = Shelf::new();
    assert_eq!(shelf.fault(&shelf.seal()), None);
    let stranger = check(&shelf.own(), Some("another key")).fault;
    assert_eq!(stranger, Some(SealFault::OtherKey));
    let path = shelf.own().join(format!("{STEM}{SEAL_ENDING}"));
    let text = fs::read_to_string(&path).expect("there");
    fs::write(&path, text.replace("\"score\":500", "\"score\":999")).expect("written");
    let forged = check(&shelf.own(), None).fault;
    assert_eq!(forged, Some(SealFault::Signature));
    fs::write(&path, text).expect("written");
    let name = format!("{STEM}.run.jsonl");
    fs::write(shelf.own().join(&name), "{}\n\n").expect("written");
    let changed = check(&shelf.own(), None).fault;
    assert_eq!(changed, Some(SealFault::Changed(name)));
}

#[test]
fn a_seal_has_the_result_of_the_flight_that_was_flown_again() {
    let shelf = Shelf::new();
    assert_eq!(shelf.fault(&shelf.seal()), None);
    let fault = |score, seed| {
        let mut check = check(&shelf.own(), None);
        check.compare(&FlownAgain {
            mission: "00-first-flight",
            seed,
            score,
        });
        check.fault
    };
    assert_eq!((fault(Some(500), 1), fault(None, 1)), (None, None));
    let other = Some(SealFault::OtherResult);
    assert_eq!(fault(Some(499), 1), other);
    assert_eq!(fault(Some(500), 2), other);
}

#[test]
fn a_key_that_others_can_read_is_refused_and_the_public_one_follows_from_it() {
    let shelf = Shelf::new();
    let folder = shelf.data.path().join(DESK_KEY);
    let secret = signature::secret_key_in(&folder);
    let mode = fs::metadata(&secret).expect("there").permissions().mode();
    assert_eq!(mode & 0o777, 0o600);
    let again = DeskKey::open(shelf.data.path()).expect("a key");
    assert_eq!(again.public(), shelf.key.public());
    // A desk that was killed while it made the key has left only the secret one.
    fs::remove_file(signature::public_key_in(&folder)).expect("removed");
    let again = DeskKey::open(shelf.data.path()).expect("a key");
    assert_eq!(again.public(), shelf.key.public());
    let public = DeskKey::public_in(shelf.data.path());
    assert_eq!(public.as_deref(), Some(shelf.key.public()));
    fs::set_permissions(&secret, fs::Permissions::from_mode(0o644)).expect("ours");
    assert!(DeskKey::open(shelf.data.path()).is_err());
}

/// A try of an exam that was flown without a fault, and its record.
struct Flown {
    exam: Exam,
    opened: CandidateTry,
    kept: KeptRecord,
    flight: ClassFlight,
    seen: SeenRecord,
}

fn exam() -> Exam {
    let plan = ExamPlan {
        name: "final".into(),
        title: "Final exam".into(),
        title_uk: None,
        layout: ExamLayout::Own,
        opens: None,
        closes: None,
        missions: vec![ExamMission {
            mission: "00-first-flight".into(),
            tries: 1,
            limit: Duration::from_secs(600),
        }],
    };
    let first = ExamNote {
        at: 0,
        what: ExamDeed::Begun {
            exam: "final".to_owned(),
            source: String::new(),
            secret: ExamSecret::from([1; 32]),
        },
    };
    Exam::of(plan.into(), &[first], 0).expect("it began")
}

/// The entry of a flight by hand.
fn entry() -> CareerFlight {
    CareerFlight {
        mission: "00-first-flight".to_owned(),
        drill_of: None,
        tier: 0,
        reward: 0,
        vehicles: 1,
        stake: Stake::Exam,
        flown_by: Some(FlownBy::Hand),
        day: 20_000,
        score: 500,
        passed: true,
        medal: None,
        evidence: Vec::new(),
        wear: 0,
        imported: false,
    }
}

/// A try of which the desk has seen the end.
fn opened() -> CandidateTry {
    let opening = TryOpening {
        asked: 10,
        until: 610,
    };
    let head = RecordHead {
        record: RecordName::try_from(STEM.to_owned()).expect("a name"),
        bytes: 3,
        sha256: [0; 32].into(),
    };
    CandidateTry {
        name: TryName {
            exam: "final".into(),
            begun: 0,
            mission: "00-first-flight".into(),
            number: 1,
            opening: 1,
        },
        openings: [(1, opening)].into(),
        opened: Some(11),
        heads: vec![TimedHead { at: 110, head }],
        ended: None,
        was_desk_away: false,
    }
}

impl Flown {
    fn new() -> Self {
        let part = |part| SubmittedPart {
            part,
            bytes: 3,
            sha256: String::new(),
        };
        Self {
            exam: exam(),
            opened: opened(),
            kept: KeptRecord {
                user: "anna".to_owned(),
                files: RecordFiles::beside(Path::new("none.run.jsonl")),
            },
            flight: ClassFlight {
                record: STEM.to_owned(),
                when: String::new(),
                profile: None,
                title: "First flight".into(),
                revision: 1,
                mission_file: Some(MissionFile::Course),
                seed: 1,
                sim_time_s: 100.0,
                has_own_fleet: false,
                has_pause: false,
                has_end: true,
                objectives: Vec::new(),
                flight: entry(),
                instructor: InstructorPart::default(),
                seal: None,
            },
            seen: SeenRecord {
                witness: Witness::Whole { heads: 9 },
                has_checksum: true,
                was_left: false,
                parts: vec![part(RecordPart::Run), part(RecordPart::Inputs)],
            },
        }
    }

    fn reasons(&self) -> Vec<TryReason> {
        let sealed = SealedTry {
            class: "9-A",
            exam: &self.exam,
            flown: &self.opened,
            kept: &self.kept,
            flight: &self.flight,
            handed_in: 700,
        };
        reasons(&sealed, &self.seen)
    }
}

#[test]
fn each_reason_why_a_try_does_not_count_is_found() {
    assert_eq!(Flown::new().reasons(), []);
    let with = |change: fn(&mut Flown)| {
        let mut flown = Flown::new();
        change(&mut flown);
        flown.reasons()
    };
    let practice = with(|it| it.flight.flight.stake = Stake::Practice);
    assert_eq!(practice, [TryReason::NoExam]);
    let script = with(|it| it.flight.flight.flown_by = Some(FlownBy::Script));
    assert_eq!(script, [TryReason::Script]);
    let altered = with(|it| it.flight.mission_file = Some(MissionFile::Altered));
    assert_eq!(altered, [TryReason::Mission]);
    let other = with(|it| it.flight.flight.mission = "01-air-sample".to_owned());
    assert_eq!(other, [TryReason::Mission]);
    assert_eq!(
        with(|it| it.flight.has_own_fleet = true),
        [TryReason::Fleet]
    );
    assert_eq!(with(|it| it.flight.has_pause = true), [TryReason::Paused]);
    let without = with(|it| it.seen.parts.truncate(1));
    assert_eq!(without, [TryReason::NoInputs]);
    assert_eq!(with(|it| it.flight.sim_time_s = 700.0), [TryReason::Late]);
    let unseen = with(|it| it.seen.witness = Witness::Unseen);
    assert_eq!(unseen, [TryReason::Unseen]);
    let rewritten = with(|it| it.seen.witness = Witness::Rewritten { at: 1, bytes: 1 });
    assert_eq!(rewritten, [TryReason::Rewritten]);
    let unchecked = with(|it| it.seen.has_checksum = false);
    assert_eq!(unchecked, [TryReason::NoChecksum]);
}

#[test]
fn a_record_whose_end_nobody_has_seen_counts_only_if_the_desk_was_away() {
    let mut flown = Flown::new();
    // A killed console leaves a record that can be edited after its last head.
    flown.opened.heads[0].head.bytes = 2;
    assert_eq!(flown.reasons(), [TryReason::EndUnseen]);
    flown.opened.was_desk_away = true;
    assert_eq!(flown.reasons(), []);
}

#[test]
fn a_try_that_was_left_does_not_count_whether_or_not_the_desk_was_there() {
    let mut flown = Flown::new();
    flown.seen.was_left = true;
    assert_eq!(flown.reasons(), [TryReason::Left]);
    flown.opened.heads[0].head.bytes = 2;
    assert_eq!(flown.reasons(), [TryReason::Left]);
    flown.opened.was_desk_away = true;
    assert_eq!(flown.reasons(), [TryReason::Left]);
}

#[test]
fn an_end_without_a_checksum_is_noticed() {
    let mut pilot = Pilot::new(7);
    pilot.flight.start_record(&Occasion {
        flown_by: FlownBy::Hand,
        when: "2026-11-20T14:03:22Z".to_owned(),
        backend: FlightBackend::Embedded,
        profile: None,
        stake: Stake::Exam,
    });
    pilot.wait(2.0);
    let open = pilot.flight.take_record();
    assert!(
        has_checksum(stored_in(open.as_bytes()).as_ref()),
        "it has no end yet"
    );
    pilot.flight.abandon();
    drop(pilot.flight.close(&pilot.ledger));
    let end = pilot.flight.take_record();
    let whole = format!("{open}{end}");
    assert!(has_checksum(stored_in(whole.as_bytes()).as_ref()));
    let cut = whole.split(",\"checksum\"").next().expect("an end");
    assert_ne!(cut, whole);
    assert!(!has_checksum(
        stored_in(format!("{cut}}}}}\n").as_bytes()).as_ref()
    ));
    assert!(!has_checksum(stored_in(b"\xff").as_ref()));
}
