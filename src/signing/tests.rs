//! Keys and timestamps through crashes, replays and changes of the clock.

use mavlink::dialects::ardupilotmega::{HEARTBEAT_DATA, MavMessage};
use proptest::prelude::*;

use super::*;
use crate::wire::{Decoder, Encoder};

const LINK: &str = "udp:10.0.0.3:14550";
const OTHER: &str = "serial:/dev/ttyACM0:115200";
const OLD: SecretKey = SecretKey::new([1; 32]);
const NEW: SecretKey = SecretKey::new([2; 32]);
const STRANGE: SecretKey = SecretKey::new([9; 32]);
const VEHICLE: MavAddress = MavAddress {
    system: 3,
    component: 1,
};

/// A frame from vehicle 3.
struct Sent {
    frame: Frame,
    bytes: Vec<u8>,
}

fn sent(key: Option<SecretKey>, link: u8, timestamp: u64) -> Sent {
    let mut encoder = Encoder::new(VEHICLE.system, VEHICLE.component);
    if let Some(SecretKey(key)) = key {
        encoder.sign_next(&key, Stamp { link, timestamp });
    }
    let mut bytes = Vec::new();
    let beat = MavMessage::HEARTBEAT(HEARTBEAT_DATA::default());
    encoder.encode(&beat.into(), &mut bytes);
    let mut decoder = Decoder::new();
    decoder.push(&bytes);
    let frame = decoder.next_frame().expect("intact");
    Sent { frame, bytes }
}

impl Keyring {
    fn hear(&mut self, link: &str, sent: &Sent) -> Seal {
        self.check(link, &sent.frame, &sent.bytes)
    }

    /// The key and the timestamp of a message to vehicle 3.
    fn say(&mut self, link: &str, wall: u64) -> Option<(SecretKey, u64)> {
        let stamp = Stamp {
            link: 0,
            timestamp: wall,
        };
        let seals = self.seal(link, [VEHICLE.system], stamp);
        seals
            .first()
            .map(|(key, stamp)| (SecretKey(*key), stamp.timestamp))
    }

    /// The keyring after the program was killed, read from its file.
    fn reborn(&mut self, wall: u64) -> Self {
        let (text, _) = self.write(wall);
        Self::read(&text).expect("it reads its own file")
    }

    fn key_of(&mut self, which: SentKey) -> Option<SigningKey> {
        match self.message(LINK, VEHICLE, which, 0)? {
            Outgoing::Message(MavMessage::SETUP_SIGNING(data)) => Some(data.secret_key),
            other => panic!("{other:?}"),
        }
    }
}

/// A keyring whose vehicle has proved a key.
fn with_key() -> Keyring {
    let mut ring = Keyring::default();
    ring.begin(LINK, 3, SigningChange::SetUp, OLD);
    assert_eq!(
        ring.hear(LINK, &sent(Some(OLD), 0, 1000)),
        Seal::RightWithNext
    );
    ring.proved(LINK, 3, SigningChange::SetUp);
    ring
}

#[test]
fn frames_are_told_apart_by_their_signatures() {
    let mut ring = with_key();
    assert_eq!(ring.hear(LINK, &sent(None, 0, 0)), Seal::Unsigned);
    assert_eq!(
        ring.hear(LINK, &sent(Some(STRANGE), 0, 2000)),
        Seal::Foreign
    );
    let good = sent(Some(OLD), 0, 2000);
    assert_eq!(ring.hear(LINK, &good), Seal::Right);
    assert_eq!(ring.hear(LINK, &good), Seal::Old(1), "replayed");
    assert_eq!(ring.hear(LINK, &sent(Some(OLD), 0, 1500)), Seal::Old(501));
    // Another link of the vehicle may be a minute behind, not more.
    let late = 100 * SECOND;
    assert_eq!(ring.hear(LINK, &sent(Some(OLD), 0, late)), Seal::Right);
    assert_eq!(
        ring.hear(LINK, &sent(Some(OLD), 1, late - MARGIN - 1)),
        Seal::Old(1)
    );
    assert_eq!(
        ring.hear(LINK, &sent(Some(OLD), 1, late - MARGIN)),
        Seal::Right
    );
    let keyless = Keyring::default().hear(LINK, &good);
    assert_eq!(keyless, Seal::Foreign, "without a key");
}

#[test]
fn a_replayed_frame_is_recognised_after_a_restart() {
    let mut ring = with_key();
    let good = sent(Some(OLD), 0, 2000);
    ring.hear(LINK, &good);
    assert_eq!(ring.reborn(0).hear(LINK, &good), Seal::Old(1));
}

#[test]
fn only_a_proved_removal_stops_the_signing() {
    let mut ring = with_key();
    ring.hear(LINK, &sent(None, 0, 0));
    ring.hear(LINK, &sent(Some(STRANGE), 0, 9000));
    assert_eq!(ring.say(LINK, 0).map(|(key, _)| key), Some(OLD));
    ring.begin(LINK, 3, SigningChange::Remove, NEW);
    assert_eq!(ring.key_of(SentKey::Off), Some([0; 32]));
    ring.proved(LINK, 3, SigningChange::Remove);
    assert_eq!(ring.say(LINK, 0), None);
    assert_eq!(ring.keyed(LINK).count(), 0);
    // The unsigned answer was forged: the vehicle still signs.
    assert_eq!(ring.hear(LINK, &sent(Some(OLD), 0, 9999)), Seal::Right);
    assert_eq!(ring.say(LINK, 0).map(|(key, _)| key), Some(OLD));
}

#[test]
fn whenever_the_program_is_killed_it_has_the_key_of_the_vehicle() {
    for change in [SigningChange::SetUp, SigningChange::Rotate] {
        let mut ring = match change {
            SigningChange::SetUp => Keyring::default(),
            SigningChange::Rotate | SigningChange::Remove => with_key(),
        };
        let before = ring.say(LINK, 0).map(|(key, _)| key);
        ring.begin(LINK, 3, change, NEW);
        // Killed before the vehicle took the key, and after: its next frame shows which key it has.
        for has in [before, Some(NEW)] {
            let mut again = ring.reborn(0);
            let beat = sent(has, 0, 50_000);
            let seal = again.hear(LINK, &beat);
            assert_eq!(seal.is_right(), has.is_some(), "{change:?} {has:?}");
            let signs = again.say(LINK, 0).map(|(key, _)| key);
            assert_eq!(signs, has, "{change:?}");
            // A further change sends the same key again, so that the vehicle never has a key that
            // the console lacks.
            again.begin(LINK, 3, change, STRANGE);
            let next = again.key_of(SentKey::Next);
            let is_settled = has == Some(NEW);
            let expected = if is_settled { STRANGE } else { NEW };
            assert_eq!(next, Some(expected.0), "{change:?} {has:?}");
        }
        ring.hear(LINK, &sent(Some(NEW), 0, 60_000));
        ring.proved(LINK, 3, change);
        let mut again = ring.reborn(0);
        assert_eq!(again.say(LINK, 0).map(|(key, _)| key), Some(NEW));
        assert_eq!(
            again.hear(LINK, &sent(Some(OLD), 0, 70_000)),
            Seal::Foreign,
            "the old key is gone"
        );
    }
}

#[test]
fn a_vehicle_that_goes_back_to_its_old_key_is_understood() {
    let mut ring = with_key();
    ring.begin(LINK, 3, SigningChange::Rotate, NEW);
    ring.hear(LINK, &sent(Some(NEW), 0, 60_000));
    assert_eq!(
        ring.hear(LINK, &sent(Some(OLD), 0, 59_999)),
        Seal::Old(2),
        "late, not proof"
    );
    assert_eq!(ring.say(LINK, 0).map(|(key, _)| key), Some(NEW));
    assert_eq!(ring.hear(LINK, &sent(Some(OLD), 0, 60_001)), Seal::Right);
    assert_eq!(ring.say(LINK, 0).map(|(key, _)| key), Some(OLD));
}

#[test]
fn a_vehicle_has_one_key_on_all_its_links() {
    let mut ring = with_key();
    assert_eq!(
        ring.hear(OTHER, &sent(Some(STRANGE), 1, 5000)),
        Seal::Foreign
    );
    assert_eq!(ring.say(OTHER, 0), None);
    assert_eq!(ring.hear(OTHER, &sent(Some(OLD), 1, 5000)), Seal::Right);
    assert_eq!(ring.say(OTHER, 0).map(|(key, _)| key), Some(OLD));
    // A rotation on one link is followed on the other.
    ring.begin(OTHER, 3, SigningChange::Rotate, NEW);
    ring.hear(OTHER, &sent(Some(NEW), 1, 6000));
    ring.proved(OTHER, 3, SigningChange::Rotate);
    assert_eq!(ring.hear(LINK, &sent(Some(NEW), 0, 6000)), Seal::Right);
    assert_eq!(ring.say(LINK, 0).map(|(key, _)| key), Some(NEW));
}

#[test]
fn a_message_for_everyone_is_signed_once_with_each_key() {
    let mut ring = with_key();
    for (system, key) in [(4, OLD), (5, NEW), (6, STRANGE)] {
        ring.begin(LINK, system, SigningChange::SetUp, key);
        let keys = ring
            .links
            .get_mut(LINK)
            .and_then(|all| all.get_mut(&system));
        keys.expect("begun").uses = KeyInUse::Next;
    }
    let stamp = Stamp {
        link: 7,
        timestamp: 500,
    };
    let seals = ring.seal(LINK, [3, 4, 5, 200], stamp);
    let keys: Vec<SigningKey> = seals.iter().map(|(key, _)| *key).collect();
    assert_eq!(keys, [OLD.0, NEW.0]);
    assert!(seals.iter().all(|(_, stamp)| stamp.link == 7));
    assert!(seals[0].1.timestamp < seals[1].1.timestamp);
}

#[test]
fn time_stamps_follow_a_vehicle_that_is_ahead() {
    let mut ring = with_key();
    ring.hear(LINK, &sent(Some(OLD), 0, 80 * SECOND));
    let (_, stamp) = ring.say(LINK, 5).expect("signed");
    assert_eq!(stamp, 80 * SECOND + 1);
}

#[test]
fn keys_are_never_shown() {
    let ring = with_key();
    let shown = format!("{ring:?}");
    assert!(
        shown.contains("SecretKey(..)") && !shown.contains("1, 1"),
        "{shown}"
    );
    let row = "[[vehicle]]\nsystem = 3\nlink = \"a\"\nkey = \"0101\"\n";
    let fault = Keyring::read(row).expect_err("too short");
    assert_eq!(fault.line, 3);
}

#[test]
fn a_row_by_hand_needs_system_link_and_key() {
    let key = "02".repeat(32);
    let row = format!("[[vehicle]]\nsystem = 3\nlink = \"{LINK}\"\nkey = \"{key}\"\n");
    let mut ring = Keyring::read(&row).expect("sound");
    assert_eq!(ring.say(LINK, 77), Some((NEW, 77)));
    assert_eq!(ring.hear(LINK, &sent(Some(NEW), 0, 1)), Seal::Right);
    for wrong in [
        row.replace("system = 3", "system = 300"),
        row.replace("0202", "zz02"),
        row.replace("key", "password"),
        format!("{row}heard = {{ \"1\" = 5 }}\n"),
    ] {
        assert!(Keyring::read(&wrong).is_err(), "{wrong}");
    }
    assert_eq!(Keyring::read(""), Ok(Keyring::default()));
}

/// An event that affects the timestamps of a console.
#[derive(Debug, Clone)]
enum Turn {
    /// A message sent at this time of the machine's clock, which may jump.
    Say(u64),
    /// A frame from the vehicle with this timestamp.
    Hear(u64),
    Save(u64),
    /// The program is killed, and starts again with the file.
    Kill,
}

fn turn() -> impl Strategy<Value = Turn> {
    let time = 0..400 * SECOND;
    prop_oneof![
        8 => time.clone().prop_map(Turn::Say),
        1 => time.clone().prop_map(Turn::Hear),
        1 => time.prop_map(Turn::Save),
        2 => Just(Turn::Kill),
    ]
}

proptest! {
    #[test]
    fn no_time_stamp_is_sent_twice_or_goes_back(turns in prop::collection::vec(turn(), 1..120)) {
        let mut ring = with_key();
        let save = |ring: &mut Keyring, wall| {
            let (text, reserved) = ring.write(wall);
            ring.written(reserved);
            text
        };
        let mut file = save(&mut ring, 0);
        let mut last = 0;
        for turn in turns {
            match turn {
                Turn::Say(wall) => {
                    let (_, stamp) = ring.say(LINK, wall).expect("signed");
                    if ring.is_spent() {
                        file = save(&mut ring, wall);
                    }
                    prop_assert!(stamp > last, "{} after {}", stamp, last);
                    prop_assert!(!ring.is_spent());
                    last = stamp;
                }
                Turn::Hear(stamp) => drop(ring.hear(LINK, &sent(Some(OLD), 0, stamp))),
                Turn::Save(wall) => file = save(&mut ring, wall),
                Turn::Kill => ring = Keyring::read(&file).expect("sound"),
            }
        }
    }

    #[test]
    fn each_frame_counts_once_and_in_its_order(
        stamps in prop::collection::vec((0u8..3, 1u64..200), 1..60)
    ) {
        let mut ring = with_key();
        let mut newest = BTreeMap::from([(0, 1000)]);
        for (link, at) in stamps {
            let stamp = 900 + at;
            let seal = ring.hear(LINK, &sent(Some(OLD), link, stamp));
            let is_new = newest.get(&link).is_none_or(|last| stamp > *last);
            prop_assert_eq!(seal == Seal::Right, is_new);
            if is_new {
                newest.insert(link, stamp);
            }
        }
    }

    #[test]
    fn the_file_gives_back_the_keyring(
        systems in prop::collection::btree_map(1u8..=255, (any::<[u8; 32]>(), any::<bool>()), 0..6),
        clock in 0u64..1 << 48,
    ) {
        let mut ring = Keyring { clock, ..Keyring::default() };
        for (system, (key, is_proved)) in systems {
            ring.begin(LINK, system, SigningChange::SetUp, SecretKey::new(key));
            if is_proved {
                let keys = ring.links.get_mut(LINK).and_then(|all| all.get_mut(&system));
                keys.expect("begun").uses = KeyInUse::Next;
                ring.proved(LINK, system, SigningChange::SetUp);
            }
        }
        let (text, reserved) = ring.write(0);
        let read = Keyring::read(&text).expect("sound");
        prop_assert_eq!(read.links, ring.links);
        prop_assert_eq!((read.clock, read.reserved), (reserved, reserved));
    }
}
