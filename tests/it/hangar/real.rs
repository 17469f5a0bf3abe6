//! A real `ArduCopter`, where `SORTIE_ARDUCOPTER` names one.

use nix::sys::signal::Signal;
use sortie::hangar::{Config, Restart, Stage};

use super::{Stand, is_gone, signal};

fn stand() -> Option<Stand> {
    let program = std::env::var_os("SORTIE_ARDUCOPTER");
    if program.is_none() {
        eprintln!("skipped: SORTIE_ARDUCOPTER names no arducopter");
    }
    let restarting = |config| Config {
        restart: Restart::Always,
        ..config
    };
    Some(Stand::running(program?.into(), restarting))
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_real_arducopter_becomes_ready() {
    let Some(stand) = stand() else { return };
    let (first, second) = (stand.launch().await, stand.launch().await);
    assert_eq!((first, second), (1, 2));
    stand
        .until("both are ready", |all| {
            all.values().all(|one| one.stage == Stage::Ready)
        })
        .await;
    let pid = stand.until_ready(first).await.pid.expect("it runs");
    stand.hangar.stop(first).await.expect("it is there");
    assert!(is_gone(pid));
    assert_eq!(stand.hangar.instances().borrow().len(), 1);
    stand.hangar.close().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_real_arducopter_that_reboots_by_mavlink_becomes_ready_again() {
    let Some(stand) = stand() else { return };
    let id = stand.launch().await;
    let mut attached = stand.attach(id).await;
    let first = stand.until_ready(id).await;
    attached.reboot(1).await;
    stand
        .until_one(id, "it boots", |one| one.stage < Stage::Ready)
        .await;
    let again = stand.until_ready(id).await;
    assert_eq!((again.pid, again.restarts), (first.pid, 0));
    attached.forget().await;
    attached.heartbeat().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_real_arducopter_that_is_killed_comes_back_to_whoever_is_attached() {
    let Some(stand) = stand() else { return };
    let id = stand.launch().await;
    let mut attached = stand.attach(id).await;
    let first = stand.until_ready(id).await;
    signal(first.pid.expect("it runs"), Signal::SIGKILL);
    stand.until_ended(id).await;
    attached.forget().await;
    let again = stand.until_ready(id).await;
    assert_eq!((again.restarts, again.attached), (1, true));
    attached.heartbeat().await;
}
