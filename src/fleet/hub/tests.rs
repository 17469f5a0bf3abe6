//! A vehicle whose task does not keep up.

use super::*;

fn parameter(value: f64) -> Want {
    Want::Parameter {
        name: "SIM_WIND_SPD",
        value,
    }
}

#[test]
fn what_finds_no_room_in_an_inbox_waits_and_comes_in_its_order() {
    let (inbox, mut read) = mpsc::channel(2);
    let sender = FrameSender {
        link: LinkId(0),
        peer: LinkPeer(0),
    };
    let (_state, watched) = watch::channel(Arc::new(Vehicle::new(1, 1)));
    let mut route = PeerRoute::new(sender, 1, Duration::ZERO, inbox, watched);
    route.wants.extend([1.0, 2.0, 3.0].map(parameter));
    route.hand_over_wants();
    assert_eq!(route.wants, [parameter(3.0)]);
    // A newer change does not overtake an older one.
    route.wants.push_back(parameter(4.0));
    let mut heard = Vec::new();
    for _ in 0..4 {
        if let Ok(ToVehicle::Want(want)) = read.try_recv() {
            heard.push(want);
        }
        route.hand_over_wants();
    }
    assert_eq!(heard, [1.0, 2.0, 3.0, 4.0].map(parameter));
    assert!(route.wants.is_empty());
}
