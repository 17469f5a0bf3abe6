//! The tap of a link.

use super::*;
use crate::inspector::{Direction, FrameSource};
use tokio::net::UdpSocket;

fn sources(rig: &Rig) -> Vec<(Direction, u32, u8)> {
    let of = |source: FrameSource| (source.direction, source.peer, source.system);
    rig.link
        .tap()
        .look(|census, _| census.sources().map(of).collect())
}

#[tokio::test(start_paused = true)]
async fn frames_of_both_directions_are_counted_with_their_bytes() {
    let (mut rig, mut far) = Rig::pipe();
    let beat = heartbeat(7);
    for _ in 0..3 {
        far.write_all(&beat).await.expect("the link reads");
        rig.next().await;
    }
    assert!(rig.link.send(To::Everyone, attitude()));
    let mut decoder = Decoder::new();
    let ours = read_frame(&mut far, &mut decoder, |frame| !is_heartbeat(frame)).await;
    let sent = decoder.bytes_of(&ours).to_vec();
    let found: Vec<(Direction, u8, u32, u64, Vec<u8>)> = rig.link.tap().look(|census, _| {
        let of = |(key, tally): (crate::inspector::TallyKey, &crate::inspector::MessageTally)| {
            let source = key.source;
            let last = tally.last.clone();
            (
                source.direction,
                source.system,
                key.message,
                tally.count,
                last,
            )
        };
        census.tallies().map(of).collect()
    });
    assert_eq!(found.len(), 3, "{found:?}");
    assert_eq!(found[0], (Direction::In, 7, 0, 3, beat));
    assert_eq!(
        (found[1].0, found[1].1, found[1].2),
        (Direction::Out, 255, 0)
    );
    assert_eq!(found[2], (Direction::Out, 255, 30, 1, sent));
}

#[tokio::test]
async fn two_senders_of_one_system_id_on_one_port_are_two_sources() {
    let mut rig = Rig::open("udpin:127.0.0.1:0");
    let local = rig.until(|status| status.local.is_some()).await.local;
    let local = local.expect("bound");
    let mut addresses = Vec::new();
    for _ in 0..2 {
        let socket = UdpSocket::bind("127.0.0.1:0").await.expect("a port");
        socket.send_to(&heartbeat(3), local).await.expect("sent");
        rig.next().await;
        addresses.push(socket.local_addr().expect("bound").to_string());
    }
    let received: Vec<_> = sources(&rig)
        .into_iter()
        .filter(|source| source.0 == Direction::In)
        .collect();
    assert_eq!(received, [(Direction::In, 0, 3), (Direction::In, 1, 3)]);
    let names: Vec<String> = rig.link.tap().look(|census, _| {
        let name = |peer| census.peer_name(peer).expect("a name").to_owned();
        [0, 1].map(name).into()
    });
    assert_eq!(names, addresses);
}

#[tokio::test(start_paused = true)]
async fn noise_makes_nobody_known_and_its_last_bytes_can_be_seen() {
    let (mut rig, mut far) = Rig::pipe();
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(5);
    let mut noise = vec![0; 200_000];
    random.fill_bytes(&mut noise);
    far.write_all(&noise).await.expect("the link reads");
    far.write_all(b"hello hello").await.expect("the link reads");
    sleep(Duration::from_secs(1)).await;
    rig.until(|status| status.decoder.bytes == 200_011).await;
    let received = sources(&rig);
    assert!(
        received.iter().all(|source| source.0 == Direction::Out),
        "{received:?}"
    );
    let (kinds, credible) = rig.link.tap().look(|census, _| {
        let credible = census
            .tallies()
            .filter(|(key, tally)| census.is_credible(*key, tally))
            .count();
        (census.tallies().count(), credible)
    });
    assert!(kinds < 300, "{kinds}");
    assert_eq!(credible, 1, "our own heartbeat");
}
