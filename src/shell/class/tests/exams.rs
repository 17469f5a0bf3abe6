//! A try of an exam, over a real socket and by the system's clock: it is opened, witnessed, handed in and sealed.

use super::records::{keeping, until};
use super::*;
use crate::class::Witness;
use crate::store::{ClassRecords, DeskKey, KeptRecord, check_seal, is_sealed};

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

/// A desk and a seat, each with a folder of its own.
struct Hall {
    folder: tempfile::TempDir,
    desk: Option<Member>,
    anna: Member,
}

impl Hall {
    /// A hall in which anna flies a try.
    async fn flying() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let of_seat = seat_options(folder.path());
        let anna = keeping(Opening::Home, of_seat, &folder.path().join("anna")).await;
        let mut hall = Self {
            folder,
            desk: None,
            anna,
        };
        hall.open_desk().await;
        let file = hall.folder.path().join("final.toml");
        std::fs::write(&file, EXAM).expect("written");
        let desk = hall.desk.as_mut().expect("it is open");
        desk.say(&format!("class exam @all {}", file.display()))
            .await;
        desk.console.feed(key(KeyCode::Char('y'))).await;
        hall.until(|_, anna| anna.place().flown_try().is_some())
            .await;
        // The brief waits until the vehicle is heard.
        run(
            &mut [hall.desk.as_mut().expect("it is open"), &mut hall.anna],
            1,
        )
        .await;
        hall.anna.console.feed(key(KeyCode::Enter)).await;
        hall.until(|desk, anna| desk.has_witnessed() && anna.is_flying())
            .await;
        hall
    }

    /// Opens the desk, also after it was killed.
    async fn open_desk(&mut self) {
        let of_desk = desk_options(self.folder.path());
        self.desk = Some(keeping(Opening::Home, of_desk, &self.of_petro()).await);
        let is_back = |seat: &SeatRecord| seat.report.is_some();
        self.until(|desk, _| desk.seats().iter().any(is_back)).await;
    }

    async fn kill_desk(&mut self) {
        self.desk = None;
        run(&mut [&mut self.anna], 1).await;
    }

    /// Ends the flight from the desk.
    async fn end_flight(&mut self) {
        let desk = self.desk.as_mut().expect("it is open");
        desk.say("class end @all").await;
        desk.console.feed(key(KeyCode::Char('y'))).await;
    }

    async fn until(&mut self, is_so: impl Fn(&Member, &Member) -> bool) {
        let desk = self.desk.as_mut().expect("it is open");
        let mut members = [desk, &mut self.anna];
        until(&mut members, |members| is_so(members[0], members[1])).await;
    }

    /// The data folder of the instructor.
    fn of_petro(&self) -> std::path::PathBuf {
        self.folder.path().join("petro")
    }

    fn records(&self) -> ClassRecords {
        ClassRecords::within(&self.of_petro(), "9-A")
    }
}

fn newest(records: &ClassRecords) -> Option<KeptRecord> {
    records.all().pop()
}

fn has_seal(records: &ClassRecords) -> bool {
    newest(records).is_some_and(|kept| is_sealed(&kept.files))
}

#[tokio::test]
async fn a_try_is_witnessed_and_sealed_also_by_a_desk_that_was_killed_meanwhile() {
    let mut hall = Box::pin(Hall::flying()).await;
    // A try cannot be restarted, and the class not be left.
    let flown = hall.anna.place().flown_try().cloned();
    for line in ["restart", "class leave"] {
        hall.anna.say(line).await;
        hall.until(|_, anna| anna.is_flying()).await;
        assert_eq!(hall.anna.place().flown_try(), flown.as_ref(), "{line}");
        assert_eq!(hall.anna.place().seat().consent(), Consent::Given);
    }
    Box::pin(hall.kill_desk()).await;
    Box::pin(hall.open_desk()).await;
    hall.until(|desk, _| desk.has_witnessed()).await;
    hall.end_flight().await;
    let records = hall.records();
    hall.until(|_, _| has_seal(&records)).await;

    let files = newest(&records).expect("it is kept").files;
    let public = DeskKey::public_in(&hall.of_petro()).expect("it was made");
    let check = check_seal(&files, Some(&public)).expect("a seal");
    assert!(check.counts(), "{check:?}");
    let witness = check.seal.expect("it can be read").witness;
    assert!(matches!(witness, Witness::Whole { .. }), "{witness:?}");
}

#[tokio::test]
async fn a_try_that_could_not_be_sealed_is_sealed_when_the_desk_is_opened_again() {
    let mut hall = Box::pin(Hall::flying()).await;
    // A file is where the folder of the key should be.
    let key = hall.of_petro().join("desk-key");
    std::fs::write(&key, "").expect("written");
    hall.end_flight().await;
    let records = hall.records();
    hall.until(|_, anna| newest(&records).is_some() && anna.place().seat().hand_in().is_empty())
        .await;
    Box::pin(hall.kill_desk()).await;
    assert!(!has_seal(&records));
    std::fs::remove_file(&key).expect("removed");
    Box::pin(hall.open_desk()).await;
    hall.until(|_, _| has_seal(&records)).await;
}

#[tokio::test(start_paused = true)]
async fn an_exam_is_refused_without_a_folder_for_its_notes() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut desk = Box::pin(desk(folder.path())).await;
    let mut anna = Box::pin(seat(folder.path())).await;
    run(&mut [&mut desk, &mut anna], 4).await;
    desk.say("class exam @all two-missions").await;
    run(&mut [&mut desk, &mut anna], 1).await;
    let role = desk.console.app.state().class_role();
    assert!(role.desk().expect("a desk").exam().is_none());
    let message = desk.console.app.state().message().expect("a message");
    assert!(format!("{:?}", message.text).contains("class-exam-no-folder"));
}
