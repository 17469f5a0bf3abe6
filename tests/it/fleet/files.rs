//! Files of simulated vehicles, over TCP.

use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use sortie::fleet::Keeping;
use sortie::ledger::RowState;
use sortie::session::{FileDesk, RadioFault, Want};
use sortie::store::TransferredFiles;

use super::{Console, serve, world};

impl Console {
    /// A console that copies files to and from vehicles.
    pub(crate) fn with_files() -> Self {
        let desk: Arc<dyn FileDesk> = Arc::new(TransferredFiles::default());
        Self::start_kept(Keeping {
            files: Some(desk),
            ..Keeping::default()
        })
    }

    /// Gives a line to a vehicle, waits for its end, and returns its state and explanation.
    pub(crate) async fn carried_out(&mut self, line: &str, vehicle: u16) -> (RowState, String) {
        let entry = self.give(line, &[vehicle]);
        self.until(line, |console| {
            let state = console.state(entry, vehicle);
            state.is_some_and(RowState::is_final)
        })
        .await;
        let state = self.state(entry, vehicle).expect("it is over");
        (state, self.explanation(entry, vehicle))
    }

    /// Gives a line to a vehicle that has to carry it out.
    pub(crate) async fn succeeds(&mut self, line: &str, vehicle: u16) -> String {
        let (state, words) = self.carried_out(line, vehicle).await;
        assert_eq!(state, RowState::Done, "{line}: {words}");
        words
    }
}

/// Copies a file to a vehicle and back, in a folder that is made and removed again.
pub(crate) async fn to_and_fro(console: &mut Console, vehicle: u16, folder: &Path) {
    let sent = folder.join("sent.bin");
    let bytes: Vec<u8> = (0..20_000u32).map(|at| ((at * at) >> 5) as u8).collect();
    fs::write(&sent, &bytes).expect("written");
    let words = console.succeeds("ftp mkdir /tried", vehicle).await;
    assert_eq!(words, "folder /tried made");
    let put = format!("ftp put {} to /tried/", sent.display());
    let words = console.succeeds(&put, vehicle).await;
    assert_eq!(words, "copied to the vehicle: 20000 B, checksum verified");
    let words = console.succeeds("ftp list /tried", vehicle).await;
    assert_eq!(words, "1 entry: sent.bin (20000 B)");
    let back = folder.join("back {id}.bin");
    let get = format!("ftp get /tried/sent.bin to {}", back.display());
    let words = console.succeeds(&get, vehicle).await;
    let named = folder.join(format!("back {vehicle}.bin"));
    let expected = format!("copied to {}: 20000 B, checksum verified", named.display());
    assert_eq!(words, expected);
    assert!(fs::read(&named).expect("it is there") == bytes);
    let (state, words) = console.carried_out(&get, vehicle).await;
    assert_eq!(state, RowState::Refused);
    assert!(words.contains("already exists"), "{words}");
    let words = console
        .succeeds("ftp checksum /tried/sent.bin", vehicle)
        .await;
    assert!(words.starts_with("checksum (CRC-32) "), "{words}");
    console
        .succeeds("ftp remove /tried/sent.bin", vehicle)
        .await;
    let words = console.succeeds("ftp list /tried", vehicle).await;
    assert_eq!(words, "the folder is empty");
    console.succeeds("ftp remove /tried/", vehicle).await;
    let (state, words) = console.carried_out("ftp list /tried", vehicle).await;
    assert_eq!(state, RowState::Refused, "{words}");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn files_are_copied_to_and_fro_over_a_link_that_loses_frames() {
    let (addresses, cancel) = serve(world(1), 20.0).await;
    let folder = tempfile::tempdir().expect("a folder");
    let mut console = Console::with_files();
    console.connect(&addresses[0]);
    console.until_known(&[1]).await;
    let words = console.succeeds("ftp list", 1).await;
    assert!(words.contains("@SYS/"), "{words}");
    let loss = RadioFault {
        loss: 0.1,
        delay: Duration::from_millis(5),
        seed: 3,
    };
    let radio = Want::Radio(loss);
    console.fleet.carry_out(1, radio).expect("the fleet runs");
    to_and_fro(&mut console, 1, folder.path()).await;
    let tasks = folder.path().join("tasks.txt");
    let get = format!("ftp get @SYS/tasks.txt to {}", tasks.display());
    let words = console.succeeds(&get, 1).await;
    assert!(words.contains("checksum not verified"), "{words}");
    assert!(
        fs::read_to_string(&tasks)
            .expect("text")
            .starts_with("TasksV2")
    );
    let (state, words) = console.carried_out("ftp get /none.txt", 1).await;
    assert_eq!((state, words.is_empty()), (RowState::Refused, false));
    let (state, _) = console.carried_out("ftp stop", 1).await;
    assert_eq!(state, RowState::Refused);
    cancel.cancel();
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_copy_can_be_stopped_and_shows_its_progress() {
    let (addresses, cancel) = serve(world(1), 5.0).await;
    let folder = tempfile::tempdir().expect("a folder");
    let large = folder.path().join("large.bin");
    fs::write(&large, vec![7; 400_000]).expect("written");
    let mut console = Console::with_files();
    console.connect(&addresses[0]);
    console.until_known(&[1]).await;
    let copy = console.give(&format!("ftp put {} to /large.bin", large.display()), &[1]);
    let waiting = console.give("ftp list", &[1]);
    console
        .until("some of it is written", |console| {
            let state = console.state(copy, 1);
            matches!(state, Some(RowState::InProgress(1..)))
        })
        .await;
    let words = console.succeeds("ftp stop", 1).await;
    assert_eq!(words, "stopped");
    assert_eq!(console.state(copy, 1), Some(RowState::Superseded));
    assert_eq!(console.state(waiting, 1), Some(RowState::Superseded));
    // The server is free again.
    console.succeeds("ftp list", 1).await;
    cancel.cancel();
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn the_defaults_of_parameters_come_after_their_list() {
    let (addresses, cancel) = serve(world(1), 20.0).await;
    let mut console = Console::with_files();
    console.connect(&addresses[0]);
    console.until_known(&[1]).await;
    console.succeeds("param set RTL_ALT 2345", 1).await;
    console.fleet.fetch_parameters(1).expect("the fleet runs");
    console
        .until("the defaults are known", |console| {
            let known = console
                .parameters
                .get(&1)
                .map(|it| it.borrow().list.has_defaults());
            known.unwrap_or_default()
        })
        .await;
    let list = console.parameters[&1].borrow().list.clone();
    let default = list.default_of("RTL_ALT").expect("it has one");
    assert_eq!(list.other_default("RTL_ALT"), Some(default));
    assert!((default - 2345.0).abs() > 1.0, "{default}");
    assert_eq!(list.other_default("RTL_LOIT_TIME"), None);
    assert!(list.default_of("RTL_LOIT_TIME").is_some());
    cancel.cancel();
}
