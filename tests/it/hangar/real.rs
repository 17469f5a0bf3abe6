//! A real `ArduCopter`, named by `SORTIE_ARDUCOPTER`.

use sortie::hangar::SitlStage;

use super::restarts::assert_a_reboot_goes_through_the_stages;
use super::{Stand, assert_a_console_has_it_back, is_gone};
use crate::sitl;

fn stand() -> Stand {
    Stand::running(sitl::arducopter(), |config| config)
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs SORTIE_ARDUCOPTER"]
async fn a_real_arducopter_becomes_ready() {
    let stand = stand();
    let (first, second) = (stand.launch().await, stand.launch().await);
    assert_eq!((first, second), (1, 2));
    stand
        .until("both are ready", |all| {
            all.values().all(|one| one.stage == SitlStage::Ready)
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
#[ignore = "needs SORTIE_ARDUCOPTER"]
async fn a_real_arducopter_that_reboots_by_mavlink_becomes_ready_again() {
    assert_a_reboot_goes_through_the_stages(&stand()).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs SORTIE_ARDUCOPTER"]
async fn a_real_arducopter_that_is_killed_comes_back_to_its_console() {
    assert_a_console_has_it_back(&stand()).await;
}
