//! A try of an exam, over a real socket and by the system's clock: it is opened, witnessed, handed in and sealed.

use std::os::unix::fs::PermissionsExt as _;

use super::records::{keeping, until};
use super::*;
use crate::class::Witness;
use crate::exam_seal::SealFault;
use crate::store::{ClassRecords, DeskKey, RecordFiles, check_seal};

const EXAM: &str = "schema = 1\ntitle = \"T\"\nabout = \"A\"\n\
    [[missions]]\nmission = \"00\"\ntries = 1\nminutes = 5\n";

impl Member {
    /// Whether the desk has noted a head of the only trainee's record.
    fn has_witnessed(&self) -> bool {
        let desk = self.console.app.state().class_role().desk();
        let exam = desk.and_then(|desk| desk.exam());
        let mut tries = exam.into_iter().flat_map(|it| it.candidates().values());
        tries.any(|it| it.tries().iter().any(|flown| !flown.heads.is_empty()))
    }
}

#[tokio::test]
async fn a_try_is_witnessed_and_sealed_and_a_change_afterwards_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let (own, theirs) = (folder.path().join("anna"), folder.path().join("petro"));
    let file = folder.path().join("final.toml");
    std::fs::write(&file, EXAM).expect("written");
    let name = "9-A".to_owned();
    let of_desk = class(folder.path(), ClassPart::Desk { name });
    let mut desk = keeping(Opening::Home, of_desk.clone(), &theirs).await;
    let of_seat = class(folder.path(), ClassPart::Seat { asks: false });
    let mut anna = keeping(Opening::Home, of_seat, &own).await;
    until(&mut [&mut desk, &mut anna], |members| {
        members[0].seats().iter().any(|seat| seat.report.is_some())
    })
    .await;
    desk.say(&format!("class exam @all {}", file.display()))
        .await;
    until(&mut [&mut desk, &mut anna], |members| {
        members[1].place().flown_try().is_some()
    })
    .await;
    // The brief waits until the vehicle is heard.
    run(&mut [&mut desk, &mut anna], 1).await;
    anna.console.feed(key(KeyCode::Enter)).await;
    until(&mut [&mut desk, &mut anna], |members| {
        members[0].has_witnessed() && members[1].is_flying()
    })
    .await;

    // A try cannot be restarted.
    let flown = anna.place().flown_try().cloned();
    anna.say("restart").await;
    run(&mut [&mut desk, &mut anna], 1).await;
    assert_eq!(anna.place().flown_try(), flown.as_ref());
    assert!(anna.is_flying());

    // The desk is killed and opened again: it goes on with the exam.
    drop(desk);
    run(&mut [&mut anna], 1).await;
    let mut desk = keeping(Opening::Home, of_desk, &theirs).await;
    until(&mut [&mut desk, &mut anna], |members| {
        let is_back = |seat: &SeatRecord| seat.report.is_some();
        members[0].has_witnessed() && members[0].seats().iter().any(is_back)
    })
    .await;
    desk.say("class end @all").await;
    desk.console.feed(key(KeyCode::Char('y'))).await;
    let records = ClassRecords::within(&theirs, "9-A");
    let seal = |records: &ClassRecords| -> Option<RecordFiles> {
        let kept = records.all().into_iter().next()?;
        let check = check_seal(&kept.files, None)?;
        // Its signature is written after it.
        (check.fault != Some(SealFault::Unsigned)).then_some(kept.files)
    };
    until(&mut [&mut desk, &mut anna], |_| seal(&records).is_some()).await;

    let files = seal(&records).expect("it is sealed");
    let public = DeskKey::public_in(&theirs).expect("it was made");
    let check = check_seal(&files, Some(&public)).expect("a seal");
    assert_eq!(check.fault, None);
    assert!(check.counts(), "{:?}", check.seal);
    let sealed = check.seal.clone().expect("it can be read");
    assert!(
        matches!(sealed.witness, Witness::Whole { .. }),
        "{sealed:?}"
    );
    let secret = theirs.join("desk-key/minisign.key");
    let mode = std::fs::metadata(&secret)
        .expect("there")
        .permissions()
        .mode();
    assert_eq!(mode & 0o777, 0o600);

    let stranger = check_seal(&files, Some("another key")).expect("a seal");
    assert_eq!(stranger.fault, Some(SealFault::OtherKey));
    let run = files.run.clone().expect("a run");
    let path = run.with_file_name(format!("{}.seal.json", files.stem));
    let text = std::fs::read_to_string(&path).expect("there");
    let score = format!("\"score\": {}", sealed.score);
    std::fs::write(&path, text.replace(&score, "\"score\": 999")).expect("written");
    let forged = check_seal(&files, Some(&public)).expect("a seal");
    assert_eq!(forged.fault, Some(SealFault::Signature));
    std::fs::write(&path, text).expect("written");
    let mut content = std::fs::read(&run).expect("there");
    content.push(b'\n');
    std::fs::write(&run, content).expect("written");
    let changed = check_seal(&files, Some(&public)).expect("a seal");
    let name = format!("{}.run.jsonl", files.stem);
    assert_eq!(changed.fault, Some(SealFault::Changed(name)));
    std::fs::set_permissions(&secret, std::fs::Permissions::from_mode(0o644)).expect("ours");
    assert!(DeskKey::open(&theirs).is_err(), "others can read it");
}
