//! Operator control over real sockets: two consoles on one vehicle.

use sortie::fleet::Keeping;
use sortie::ledger::RowState;

use super::{Console, serve, world};

fn station(system: u8) -> Console {
    Console::start_kept(Keeping {
        station: Some(system),
        ..Keeping::default()
    })
}

impl Console {
    /// Whether the vehicle announces this owner.
    fn is_owned_by(&self, owner: Option<u8>) -> bool {
        let control = self.vehicle(1).and_then(|vehicle| vehicle.control);
        control.is_some_and(|control| control.owner == owner)
    }

    async fn until_owner(&mut self, owner: Option<u8>) {
        let what = format!("{owner:?} is in control");
        self.until(&what, |console| console.is_owned_by(owner))
            .await;
    }

    async fn refusal(&mut self, line: &str) -> String {
        let entry = self.give(line, &[1]);
        self.until("the line has ended", |console| {
            console.state(entry, 1).is_some_and(RowState::is_final)
        })
        .await;
        assert_eq!(self.state(entry, 1), Some(RowState::Refused), "{line}");
        self.explanation(entry, 1)
    }

    async fn until_told(&mut self, part: &str) {
        self.until(part, |console| {
            console.notices.iter().any(|notice| notice.contains(part))
        })
        .await;
    }
}

#[tokio::test]
async fn two_consoles_hand_a_vehicle_over() {
    let mut world = world(1);
    world.announce_control();
    let (addresses, cancel) = serve(world, 1.0).await;
    let (mut first, mut second) = (station(255), station(250));
    for console in [&mut first, &mut second] {
        console.connect(&addresses[0]);
        console.until_ready(&[1]).await;
        console.until_owner(None).await;
    }
    first.carry_out("control request", 1).await;
    second.until_owner(Some(255)).await;
    for line in ["arm", "mode loiter", "param set RTL_ALT 2000"] {
        let reason = second.refusal(line).await;
        assert!(reason.contains("station 255 is in control"), "{reason}");
        assert!(reason.contains("1 control request"), "{reason}");
    }
    let asked = second.refusal("control request").await;
    assert!(asked.contains("was asked"), "{asked}");
    first
        .until_told("station 250 asks for control: `1 control allow 10`")
        .await;
    first.carry_out("control allow 10", 1).await;
    second
        .until("takeover is allowed", |console| {
            let control = console.vehicle(1).and_then(|vehicle| vehicle.control);
            control.is_some_and(|control| control.takeover)
        })
        .await;
    second.carry_out("control request", 1).await;
    first.until_told("station 250 has taken control").await;
    let reason = first.refusal("arm").await;
    assert!(reason.contains("station 250 is in control"), "{reason}");
    second.carry_out("guided", 1).await;
    second.carry_out("control release", 1).await;
    first.until_owner(None).await;
    first.carry_out("arm", 1).await;
    cancel.cancel();
}

#[tokio::test]
async fn a_vehicle_without_operator_control_says_so() {
    let (addresses, cancel) = serve(world(1), 1.0).await;
    let mut console = Console::start();
    console.connect(&addresses[0]);
    console.until_ready(&[1]).await;
    let reason = console.refusal("control request").await;
    assert!(reason.contains("announces no station"), "{reason}");
    cancel.cancel();
}
