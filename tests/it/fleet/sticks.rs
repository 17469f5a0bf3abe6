//! Channels of the transmitter that the console holds, over real sockets.

use super::{Console, serve, world};

impl Console {
    fn channel_us(&self, channel: usize) -> Option<u16> {
        let rc = self.vehicle(1)?.rc?;
        rc.channels_us.get(channel).copied()
    }

    async fn until_channel(&mut self, channel: usize, pulse_us: u16) {
        let what = format!("channel {channel} is at {pulse_us}");
        self.until(&what, |console| {
            console.channel_us(channel) == Some(pulse_us)
        })
        .await;
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_held_channel_stays_until_it_is_released() {
    // At this speed-up, the override of ArduPilot ends within a third of a second.
    let (addresses, cancel) = serve(world(1), 4.0).await;
    let mut console = Console::start();
    console.connect(&addresses[0]);
    console.until_ready(&[1]).await;
    console.until_channel(2, 1000).await;
    let explained = console.carry_out("rc 3 1500", 1).await;
    assert!(explained.contains("3: 1500"), "{explained}");
    console.until_channel(2, 1500).await;
    console.carry_out("rc 1 1600", 1).await;
    console.until_channel(0, 1600).await;
    assert_eq!(console.channel_us(2), Some(1500));
    console.carry_out("rc release", 1).await;
    console.until_channel(2, 1000).await;
    assert!(console.vehicle(1).is_some_and(|it| it.held.is_none()));
    cancel.cancel();
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn sticks_that_are_no_longer_steered_are_released() {
    let (addresses, cancel) = serve(world(1), 1.0).await;
    let mut console = Console::start();
    console.connect(&addresses[0]);
    console.until_ready(&[1]).await;
    let mut held = sortie::vehicle::HeldChannels::default();
    held.hold(2, 1650);
    console
        .fleet
        .steer_by_hand(1, Some(held))
        .expect("the fleet runs");
    console.until_channel(2, 1650).await;
    console.until_channel(2, 1000).await;
    cancel.cancel();
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_console_that_ends_leaves_no_channel_held() {
    let (addresses, cancel) = serve(world(1), 1.0).await;
    let mut watching = Console::start();
    watching.connect(&addresses[0]);
    watching.until_ready(&[1]).await;
    let mut holding = Console::start();
    holding.connect(&addresses[0]);
    holding.until_ready(&[1]).await;
    holding.carry_out("rc 3 1500", 1).await;
    watching.until_channel(2, 1500).await;
    drop(holding);
    watching.until_channel(2, 1000).await;
    cancel.cancel();
}
