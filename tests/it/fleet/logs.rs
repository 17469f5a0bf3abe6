//! Logs of simulated vehicles, over TCP.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use sortie::fleet::Keeping;
use sortie::ledger::{EntryId, RowState};
use sortie::session::{LogKeeper, RadioFault, Want};
use sortie::store::LogFolder;

use super::{Console, serve, world};

impl Console {
    /// A console that keeps the logs of vehicles in a data folder.
    pub(crate) fn keeping_logs(data: &Path) -> Self {
        let folder: Arc<dyn LogKeeper> = Arc::new(LogFolder::within(data));
        Self::start_kept(Keeping {
            logs: Some(folder),
            ..Keeping::default()
        })
    }

    pub(crate) async fn until_known(&mut self, ids: &[u16]) {
        self.until("all have said what they can", |console| {
            ids.iter().all(|&id| {
                let vehicle = console.vehicle(id);
                vehicle.is_some_and(|vehicle| vehicle.version.is_some())
            })
        })
        .await;
    }

    /// The last explanation in the row of a vehicle.
    pub(crate) fn explanation(&self, entry: EntryId, vehicle: u16) -> String {
        let mut rows = self.rows.iter().rev();
        let row = rows.find(|row| row.entry == entry && row.vehicle == vehicle);
        let words = row.and_then(|row| row.explanation.as_ref());
        words.map(ToString::to_string).unwrap_or_default()
    }

    /// Lets vehicles fly briefly, so that they have a log.
    async fn hop(&mut self, ids: &[u16]) {
        self.until_ready(ids).await;
        self.give("guided", ids);
        self.give("arm", ids);
        let takeoff = self.give("takeoff 5", ids);
        for &id in ids {
            self.until_done(takeoff, id).await;
        }
        self.give("land", ids);
        self.until("all are down again", |console| {
            ids.iter()
                .all(|&id| console.vehicle(id).is_some_and(|vehicle| !vehicle.armed()))
        })
        .await;
    }
}

fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let paths: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    let named = |path: PathBuf| {
        let name = path.file_name().expect("a name").to_string_lossy();
        (name.into_owned(), std::fs::read(&path).expect("readable"))
    };
    paths.into_iter().map(named).collect()
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn logs_of_several_vehicles_come_whole_over_links_that_lose_frames_and_go_on_after_a_restart()
{
    let (addresses, cancel) = serve(world(3), 20.0).await;
    let data = tempfile::tempdir().expect("a folder");
    let all = [1, 2, 3];
    let mut console = Console::keeping_logs(data.path());
    for address in &addresses {
        console.connect(address);
    }
    console.hop(&all).await;
    // Otherwise the log continues for 15 s after disarming.
    let off = console.give("param set LOG_BACKEND_TYPE 0", &all);
    for id in all {
        console.until_done(off, id).await;
    }
    console.until_known(&all).await;
    let clean = data.path().join("clean");
    let order = console.give(&format!("logs download to {}", clean.display()), &all);
    for id in all {
        console.until_done(order, id).await;
    }
    let by_files = "by log messages, checksum verified";
    for id in all {
        let words = console.explanation(order, id);
        assert!(words.contains(by_files), "{words}");
    }
    let truth = files(&clean);
    assert_eq!(truth.len(), 3, "{:?}", truth.keys());
    for id in all {
        let loss = RadioFault {
            loss: 0.3,
            delay: Duration::from_millis(20),
            seed: 7,
        };
        let radio = Want::Radio(loss);
        console.fleet.carry_out(id, radio).expect("the fleet runs");
    }
    let order = console.give("logs download all", &all);
    console
        .until("all have begun", |console| {
            all.iter().all(|id| {
                let begun = |state| matches!(state, RowState::InProgress(2..) | RowState::Done);
                console.state(order, *id).is_some_and(begun)
            })
        })
        .await;
    drop(console);
    let mut console = Console::keeping_logs(data.path());
    for address in &addresses {
        console.connect(address);
    }
    console.until_known(&all).await;
    let order = console.give("logs download all", &all);
    for id in all {
        console.until_done(order, id).await;
    }
    for id in all {
        // A log that was complete before the restart was not transferred again.
        let words = console.explanation(order, id);
        let was_whole = !words.contains("saved by ");
        assert!(was_whole || words.contains(by_files), "{words}");
    }
    let kept = files(&data.path().join("logs"));
    assert_eq!(
        kept.keys().collect::<Vec<_>>(),
        truth.keys().collect::<Vec<_>>()
    );
    for (name, bytes) in &kept {
        let differs = |(ours, theirs): (&u8, &u8)| ours != theirs;
        let at = bytes.iter().zip(&truth[name]).position(differs);
        let lengths = [bytes.len(), truth[name].len()];
        assert!(at.is_none(), "{name} differs at {at:?} of {lengths:?}");
        assert_eq!(lengths[0], lengths[1], "{name}");
    }
    cancel.cancel();
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_vehicle_that_hands_out_no_files_sends_its_log_in_messages() {
    let (addresses, cancel) = serve(world(1), 20.0).await;
    let data = tempfile::tempdir().expect("a folder");
    let mut console = Console::keeping_logs(data.path());
    console.connect(&addresses[0]);
    console.hop(&[1]).await;
    console.until_known(&[1]).await;
    let off = console.give("param set LOG_BACKEND_TYPE 0", &[1]);
    console.until_done(off, 1).await;
    let mut all = Vec::new();
    // The console learns of the option only after the next connection; until then, requests for
    // files are not answered.
    for (way, parameter) in [
        (
            "by log messages, checksum verified",
            "param set BRD_OPTIONS 2",
        ),
        ("by log messages, no checksum: no answer", ""),
        ("by log messages", ""),
    ] {
        let folder = data.path().join(all.len().to_string());
        let order = console.give(&format!("logs download to {}", folder.display()), &[1]);
        console.until_done(order, 1).await;
        let words = console.explanation(order, 1);
        assert!(words.contains(&format!("saved {way}: ")), "{words}");
        all.push(files(&folder));
        if parameter.is_empty() {
            console = Console::keeping_logs(data.path());
            console.connect(&addresses[0]);
            console.until_known(&[1]).await;
        } else {
            let set = console.give(parameter, &[1]);
            console.until_done(set, 1).await;
        }
    }
    assert!(all[0].len() == 1 && all[0] == all[1] && all[1] == all[2]);
    cancel.cancel();
}
