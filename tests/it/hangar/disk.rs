//! Folders that cannot be used, and disks that are full.

use std::fs;
use std::os::unix::fs::symlink;

use sortie::hangar::{Hangar, Launch};

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
