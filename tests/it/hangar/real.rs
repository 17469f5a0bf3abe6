//! A real `ArduCopter`, where `SORTIE_ARDUCOPTER` names one.

use sortie::hangar::Stage;

use super::restarts::assert_a_reboot_goes_through_the_stages;
use super::{Stand, assert_a_console_has_it_back, is_gone};

fn stand() -> Option<Stand> {
    let program = std::env::var_os("SORTIE_ARDUCOPTER");
    if program.is_none() {
        eprintln!("skipped: SORTIE_ARDUCOPTER names no arducopter");
    }
    Some(Stand::running(program?.into(), |config| config))
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
    stand.attach(second).await.assert_real_time().await;
    let pid = stand.until_ready(first).await.pid.expect("it runs");
    stand.hangar.stop(first).await.expect("it is there");
    assert!(is_gone(pid));
    assert_eq!(stand.hangar.instances().borrow().len(), 1);
    stand.hangar.close().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_real_arducopter_that_reboots_by_mavlink_becomes_ready_again() {
    if let Some(stand) = stand() {
        assert_a_reboot_goes_through_the_stages(&stand).await;
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_real_arducopter_that_is_killed_comes_back_to_its_console() {
    if let Some(stand) = stand() {
        assert_a_console_has_it_back(&stand).await;
    }
}
