//! Several senders on one link.

use super::*;

#[tokio::test(start_paused = true)]
async fn one_system_id_from_two_places_and_twice_behind_one_radio() {
    let (mut patient, first) = Patient::listening().await;
    let second = UdpSocket::bind("127.0.0.1:0").await.expect("a port");
    second
        .connect(first.peer_addr().expect("connected"))
        .await
        .expect("connected");
    let (mut one, mut other) = (Voice::new(4, 1), Voice::new(4, 1));
    for _ in 0..9 {
        for (socket, voice) in [(&first, &mut one), (&second, &mut other)] {
            let bytes = [voice.second(), voice.answer()].concat();
            socket.send(&bytes).await.expect("sent");
            patient.given += bytes.len() as u64;
        }
        patient.second().await;
    }
    assert_eq!(patient.causes(), [Cause::DuplicateSystem(4)]);

    let (mut patient, mut far) = Patient::piped(Way::Serial);
    let (mut one, mut other) = (Voice::new(4, 1), Voice::new(4, 1));
    for _ in 0..90 {
        other.answer();
    }
    for _ in 0..9 {
        let bytes = [one.second(), other.second(), one.answer()].concat();
        patient.feed(&mut far, &bytes, 1).await;
    }
    assert_eq!(patient.causes()[0], Cause::DuplicateSystem(4));
}

/// On a link with many vehicles, only the sequence numbers of the shared id jump.
#[tokio::test(start_paused = true)]
async fn a_duplicate_among_many_vehicles_behind_one_radio_is_found() {
    let (mut patient, mut far) = Patient::piped(Way::Serial);
    let (mut one, mut other) = (Voice::new(4, 1), Voice::new(4, 1));
    let mut others: Vec<Voice> = (10..30).map(|system| Voice::new(system, 1)).collect();
    for _ in 0..90 {
        other.answer();
    }
    for _ in 0..9 {
        let mut bytes = [one.second(), other.second(), one.answer()].concat();
        for voice in &mut others {
            bytes.extend([voice.second(), voice.answer()].concat());
        }
        patient.feed(&mut far, &bytes, 1).await;
    }
    assert_eq!(patient.causes()[0], Cause::DuplicateSystem(4));
}

/// A vehicle with a second ground station; it forwards only some of that station's frames.
#[tokio::test(start_paused = true)]
async fn another_ground_station_is_named_and_its_gaps_are_no_loss() {
    let (mut patient, mut far) = Patient::piped(Way::Tcp);
    let (mut vehicle, mut station) = (Voice::new(4, 1), Voice::new(252, 230));
    for _ in 0..9 {
        for _ in 0..20 {
            station.say(ground_station_heartbeat());
        }
        let forwarded = station.say(ground_station_heartbeat());
        let bytes = [vehicle.second(), vehicle.answer(), forwarded].concat();
        patient.feed(&mut far, &bytes, 1).await;
    }
    assert_eq!(patient.causes(), [Cause::OtherStation(252, 230)]);
}

/// A companion computer that calls itself a ground station, with the system id of its vehicle.
#[tokio::test(start_paused = true)]
async fn a_component_of_a_vehicle_is_no_other_ground_station() {
    let (mut patient, mut far) = Patient::piped(Way::Tcp);
    let (mut vehicle, mut part) = (Voice::new(4, 1), Voice::new(4, 6));
    for _ in 0..9 {
        let said = part.say(ground_station_heartbeat());
        let bytes = [vehicle.second(), vehicle.answer(), said].concat();
        patient.feed(&mut far, &bytes, 1).await;
    }
    assert_eq!(patient.causes(), [Cause::Well(1)]);
}

#[tokio::test(start_paused = true)]
async fn one_udp_peer_with_an_odd_numbering_is_no_duplicate() {
    let (mut patient, remote) = Patient::listening().await;
    let (mut one, mut other) = (Voice::new(4, 1), Voice::new(4, 1));
    for _ in 0..90 {
        other.answer();
    }
    for _ in 0..9 {
        let bytes = [one.second(), other.second(), one.answer()].concat();
        remote.send(&bytes).await.expect("sent");
        patient.given += bytes.len() as u64;
        patient.second().await;
    }
    let causes = patient.causes();
    assert!(!causes.contains(&Cause::DuplicateSystem(4)), "{causes:?}");
}

#[tokio::test(start_paused = true)]
async fn a_vehicle_that_comes_back_from_another_port_is_no_duplicate() {
    let (mut patient, first) = Patient::listening().await;
    let second = UdpSocket::bind("127.0.0.1:0").await.expect("a port");
    second
        .connect(first.peer_addr().expect("connected"))
        .await
        .expect("connected");
    let mut voice = Voice::new(4, 1);
    for at in 0..30 {
        let socket = if at < 12 { &first } else { &second };
        let bytes = [voice.second(), voice.answer()].concat();
        socket.send(&bytes).await.expect("sent");
        patient.given += bytes.len() as u64;
        patient.second().await;
        let duplicate = patient.causes().contains(&Cause::DuplicateSystem(4));
        assert!(!duplicate, "second {at}");
    }
}
