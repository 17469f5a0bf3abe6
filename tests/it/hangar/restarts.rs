//! Instances that boot again, and the clients attached to them.

use std::fs;
use std::path::Path;

use nix::sys::signal::Signal;
use sortie::hangar::{HangarSetup, Restart, SitlStage};

use super::{Stand, assert_a_console_has_it_back, is_gone, signal};
use crate::stand_in::{Behaviour, MEMORY_FILE};

fn restarting(behaviour: Behaviour) -> Stand {
    Stand::with(behaviour, |config| HangarSetup {
        restart: Restart::Always,
        ..config
    })
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn one_that_is_killed_comes_back_by_policy_and_whoever_is_attached_hears_it_again() {
    let stand = restarting(Behaviour::Normal);
    let id = stand.launch().await;
    let mut attached = stand.attach(id).await;
    let first = stand.until_ready(id).await;
    attached.heartbeat().await;
    let pid = first.pid.expect("it runs");
    signal(pid, Signal::SIGKILL);
    let down = stand.until_ended(id).await;
    assert_eq!(
        down.fault.as_deref(),
        Some("it was ended from outside (SIGKILL)")
    );
    assert_eq!(down.hint.as_deref(), Some("is started again in 1 s"));
    assert!(is_gone(pid));
    attached.forget().await;
    let again = stand.until_ready(id).await;
    assert_ne!(again.pid, first.pid);
    assert_eq!(
        (again.restarts, again.attached, again.fault),
        (1, true, None)
    );
    assert_eq!(attached.heartbeat().await, 1);
    // Its parameters stay in the same folder.
    assert_eq!(again.folder, first.folder);
    let starts = fs::read(Path::new(&again.folder).join(MEMORY_FILE)).expect("it is there");
    assert_eq!(starts.len(), 2);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn one_that_fails_at_first_is_tried_again() {
    let stand = restarting(Behaviour::FailsAtFirst(2));
    let id = stand.launch().await;
    assert_eq!(stand.until_ready(id).await.restarts, 2);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_program_that_cannot_be_run_is_not_tried_again() {
    let stand = Stand::running("/no/such/arducopter".into(), |config| HangarSetup {
        restart: Restart::Always,
        ..config
    });
    let id = stand.launch().await;
    let one = stand.until_ended(id).await;
    assert_eq!((one.restarts, one.hint), (0, None));
    assert_eq!(stand.hangar.capacity().running, 0);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn one_that_has_ended_or_runs_is_started_again_on_request() {
    let stand = Stand::of(Behaviour::Normal);
    let id = stand.launch().await;
    let mut attached = stand.attach(id).await;
    let mut before = stand.until_ready(id).await;
    for restarts in 1..=2 {
        if restarts == 1 {
            signal(before.pid.expect("it runs"), Signal::SIGKILL);
            stand.until_ended(id).await;
        }
        stand.hangar.restart(id).await.expect("it is there");
        let again = stand
            .until_one(id, "it is ready again", |one| {
                one.stage == SitlStage::Ready && one.restarts == restarts
            })
            .await;
        assert_ne!(again.pid, before.pid);
        attached.forget().await;
        attached.heartbeat().await;
        before = again;
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn one_that_reboots_by_mavlink_goes_through_its_stages_again() {
    assert_a_reboot_goes_through_the_stages(&Stand::of(Behaviour::Normal)).await;
}

/// Checks that a reboot by MAVLink goes through the stages again.
pub(super) async fn assert_a_reboot_goes_through_the_stages(stand: &Stand) {
    let id = stand.launch().await;
    let mut attached = stand.attach(id).await;
    let first = stand.until_ready(id).await;
    attached.reboot(1).await;
    stand
        .until_one(id, "it boots", |one| one.stage < SitlStage::Ready)
        .await;
    let again = stand.until_ready(id).await;
    assert_eq!((again.pid, again.restarts), (first.pid, 0));
    attached.assert_real_time().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn one_that_is_killed_comes_back_to_its_console() {
    assert_a_console_has_it_back(&Stand::of(Behaviour::Normal)).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_new_instance_remembers_nothing_of_one_with_its_number() {
    let stand = Stand::of(Behaviour::Normal);
    for _ in 0..2 {
        let id = stand.launch().await;
        let one = stand.until_ready(id).await;
        let starts = fs::read(Path::new(&one.folder).join(MEMORY_FILE)).expect("it is there");
        assert_eq!(starts.len(), 1);
        stand.hangar.stop(id).await.expect("it is there");
    }
}

/// An attached client that does not read must not block the instance or its hangar.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn one_who_is_attached_and_does_not_read_disturbs_nobody() {
    let stand = Stand::of(Behaviour::Normal);
    let id = stand.launch().await;
    let attached = stand.attach(id).await;
    let one = stand.until_ready(id).await;
    let later = one.cpu_ms;
    stand
        .until_one(id, "it goes on", |one| one.cpu_ms > later)
        .await;
    drop(attached);
    stand.until_one(id, "it is free", |one| !one.attached).await;
    stand.attach(id).await.heartbeat().await;
}
