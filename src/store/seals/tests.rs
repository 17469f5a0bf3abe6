//! Seals beside records, and what is wrong with them.

use std::fs;

use super::*;
use crate::class::SubmittedPart;
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
            begun: moment.clone(),
            user: "anna".to_owned(),
            mission: "00-first-flight".to_owned(),
            number: 1,
            tries: 1,
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
            until: None,
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
        self.check(&self.own(), None).fault
    }

    fn check(&self, folder: &Path, key: Option<&str>) -> SealCheck {
        let files = RecordFiles::beside(&folder.join(format!("{STEM}.run.jsonl")));
        check_seal(&files, key).expect("a seal")
    }
}

#[test]
fn a_file_that_is_not_in_the_seal_is_named() {
    let shelf = Shelf::new();
    assert_eq!(shelf.fault(&shelf.seal()), None);
    let name = format!("{STEM}.inputs.jsonl");
    fs::write(shelf.own().join(&name), "{}\n").expect("written");
    let fault = shelf.check(&shelf.own(), None).fault;
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
    assert_eq!(shelf.check(&around, None).fault, fault);
}

#[test]
fn a_try_counts_for_certain_only_with_a_known_key() {
    let shelf = Shelf::new();
    assert_eq!(shelf.fault(&shelf.seal()), None);
    let unknown = shelf.check(&shelf.own(), None);
    assert_eq!(unknown.standing(), text!("seal-key-not-compared"));
    let known = shelf.check(&shelf.own(), Some(shelf.key.public()));
    assert_eq!(known.standing(), text!("seal-counts"));
}
