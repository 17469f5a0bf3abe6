//! Owners of hangars that end in different ways, and the processes that they leave.

use std::io::{BufRead as _, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use sortie::hangar::{Hangar, Launch, SitlStage};

use super::{config, is_gone, until_gone};
use crate::stand_in::{Behaviour, StandIn};

const PROGRAM: &str = "SORTIE_OWNER_PROGRAM";
const FOLDER: &str = "SORTIE_OWNER_FOLDER";
const INSTANCES: u16 = 3;

/// Not a test itself: a program with a hangar, for tests that kill it. Without a program it does nothing.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn owner_of_a_hangar() {
    let Some(program) = std::env::var_os(PROGRAM) else {
        return;
    };
    let folder = PathBuf::from(std::env::var_os(FOLDER).expect("it is set"));
    let hangar = Hangar::open(config(&folder, program.into())).expect("it opens");
    for _ in 0..INSTANCES {
        hangar.launch(Launch::default()).await.expect("it starts");
    }
    let mut seen = hangar.instances();
    let all = seen
        .wait_for(|all| all.values().all(|one| one.stage == SitlStage::Ready))
        .await
        .expect("it is open")
        .clone();
    for one in all.values() {
        println!("\npid {}", one.pid.expect("it runs"));
    }
    tokio::time::sleep(Duration::from_secs(300)).await;
}

/// Starts an owner, waits until its instances are ready, and returns their processes.
fn start_owner(program: &Path, folder: &Path) -> (Child, Vec<u32>) {
    let mut owner = Command::new(std::env::current_exe().expect("a path"))
        .args(["--exact", "hangar::owner::owner_of_a_hangar", "--nocapture"])
        .env(PROGRAM, program)
        .env(FOLDER, folder)
        .stdout(Stdio::piped())
        .spawn()
        .expect("it starts");
    let out = BufReader::new(owner.stdout.take().expect("it is piped"));
    let pids: Vec<u32> = out
        .lines()
        .map_while(Result::ok)
        .filter_map(|line| line.strip_prefix("pid ")?.parse().ok())
        .take(INSTANCES.into())
        .collect();
    assert_eq!(pids.len(), usize::from(INSTANCES));
    (owner, pids)
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn nothing_outlives_an_owner_that_is_killed() {
    let stand_in = StandIn::new(Behaviour::Normal);
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (mut owner, pids) = start_owner(&stand_in.program(), folder.path());
    assert!(pids.iter().all(|pid| !is_gone(*pid)));
    // On Unix this is signal 9.
    owner.kill().expect("it is ours");
    owner.wait().expect("it is ours");
    for pid in pids {
        until_gone(pid).await;
    }
    let next = Hangar::open(config(folder.path(), stand_in.program())).expect("it opens");
    assert_eq!(next.leftovers().await, []);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_an_earlier_hangar_has_left_running_is_ended_and_named() {
    let stand_in = StandIn::new(Behaviour::OutlivesItsOwner);
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (mut owner, mut pids) = start_owner(&stand_in.program(), folder.path());
    owner.kill().expect("it is ours");
    owner.wait().expect("it is ours");
    assert!(pids.iter().all(|pid| !is_gone(*pid)));
    let next = Hangar::open(config(folder.path(), stand_in.program())).expect("it opens");
    let leftovers = next.leftovers().await;
    let mut named: Vec<u32> = leftovers.iter().map(|leftover| leftover.pid).collect();
    named.sort_unstable();
    pids.sort_unstable();
    assert_eq!(named, pids);
    for leftover in &leftovers {
        assert!(leftover.ended, "{leftover:?}");
        assert_eq!(Path::new(&leftover.program), stand_in.program());
        assert!(Path::new(&leftover.folder).starts_with(folder.path()));
        assert!(is_gone(leftover.pid));
    }
}

/// Instances of a living hangar are not leftovers.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn two_hangars_in_one_folder_leave_each_other_alone() {
    let stand_in = StandIn::new(Behaviour::Normal);
    let folder = tempfile::tempdir().expect("a temporary folder");
    let open = || Hangar::open(config(folder.path(), stand_in.program())).expect("it opens");
    let first = open();
    let id = first.launch(Launch::default()).await.expect("it starts");
    let mut seen = first.instances();
    let ready = seen.wait_for(|all| all[&id].stage == SitlStage::Ready);
    let pid = ready.await.expect("it is open")[&id].pid.expect("it runs");
    let second = open();
    assert_eq!(second.leftovers().await, []);
    assert_ne!(first.folder(), second.folder());
    assert!(!is_gone(pid));
    first.close().await;
    assert!(is_gone(pid));
}
