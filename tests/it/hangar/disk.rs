//! Folders that cannot be used, disks that are full, and the limits of logs.

use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;

use sortie::hangar::{Hangar, Instance, Launch};

use super::{Stand, config};
use crate::stand_in::Behaviour;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_hangar_whose_folder_cannot_be_made_says_so() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("file");
    fs::write(&file, "in the way").expect("written");
    let opened = Hangar::open(config(&file.join("hangar"), "/bin/true".into()));
    let error = opened.err().expect("a file is in the way").to_string();
    assert!(error.contains("a file is in the way"), "{error}");
    assert!(error.contains(&file.display().to_string()), "{error}");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn an_instance_whose_folder_cannot_be_made_is_refused_and_takes_no_place() {
    let stand = Stand::of(Behaviour::Normal);
    let folder = stand.hangar.folder().join("vehicle-001");
    fs::write(&folder, "in the way").expect("written");
    let refused = stand.hangar.launch(Launch::default()).await;
    let refusal = refused.expect_err("a file is in the way").to_string();
    assert!(refusal.contains("vehicle-001"), "{refusal}");
    assert_eq!(stand.hangar.capacity().running, 0);
    fs::remove_file(folder).expect("it is there");
    let id = stand.launch().await;
    stand.until_ready(id).await;
}

/// A full disk, simulated by a file.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_full_disk_refuses_an_instance_with_the_reason() {
    let stand = Stand::of(Behaviour::Normal);
    let folder = stand.hangar.folder().join("vehicle-001");
    fs::create_dir(&folder).expect("it is ours");
    symlink("/dev/full", folder.join("vehicle.parm")).expect("it is ours");
    let refused = stand.hangar.launch(Launch::default()).await;
    let refusal = refused.expect_err("the disk is full").to_string();
    assert!(refusal.contains("vehicle.parm"), "{refusal}");
    assert!(refusal.contains("No space left"), "{refusal}");
    assert_eq!(stand.hangar.capacity().running, 0);
}

/// The values of a parameter in the file that an instance reads.
fn values(one: &Instance, name: &str) -> Vec<f64> {
    let file = Path::new(&one.folder).join("vehicle.parm");
    let text = fs::read_to_string(file).expect("it is there");
    let own = text.lines().filter_map(|line| line.split_once(' '));
    let own = own.filter(|(written, _)| *written == name);
    own.map(|(_, value)| value.parse().expect("a number"))
        .collect()
}

/// Without limits, ArduPilot keeps 500 logs, and writes until 500 MB are left.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn logs_are_limited_more_than_by_ardupilot_unless_the_user_sets_other_limits() {
    let stand = Stand::of(Behaviour::Normal);
    let id = stand.launch().await;
    let one = stand.until_one(id, "it is there", |_| true).await;
    let (files, free) = (
        values(&one, "LOG_MAX_FILES"),
        values(&one, "LOG_FILE_MB_FREE"),
    );
    // ArduPilot replaces fewer than 2 files and more than 1000 MB.
    assert!(
        matches!(files[..], [count] if (2.0..100.0).contains(&count)),
        "{files:?}"
    );
    assert!(
        matches!(free[..], [mb] if mb > 500.0 && mb <= 1000.0),
        "{free:?}"
    );
    let own = Launch {
        parameters: BTreeMap::from([("LOG_MAX_FILES".to_owned(), files[0] + 7.0)]),
        ..Launch::default()
    };
    let id = stand.hangar.launch(own).await.expect("it starts");
    let one = stand.until_one(id, "it is there", |_| true).await;
    assert_eq!(values(&one, "LOG_MAX_FILES"), [files[0] + 7.0]);
    assert_eq!(values(&one, "LOG_FILE_MB_FREE"), free);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn an_instance_flies_on_when_its_output_can_no_longer_be_kept() {
    let stand = Stand::of(Behaviour::FloodsItsOutput);
    let folder = stand.hangar.folder().join("vehicle-001");
    fs::create_dir(&folder).expect("it is ours");
    symlink("/dev/full", folder.join("output.log")).expect("it is ours");
    let id = stand.launch().await;
    stand.until_ready(id).await;
    assert!(!stand.hangar.output(id, 0).expect("it is there").is_empty());
    stand.hangar.stop(id).await.expect("it is there");
}
