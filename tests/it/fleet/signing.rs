//! Signing over real sockets: keys, restarts on both sides, clocks that are set back, and attackers.

use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use mavlink::dialects::ardupilotmega::{
    COMMAND_LONG_DATA, HEARTBEAT_DATA, MavAutopilot, MavCmd, MavMessage, MavModeFlag, MavType,
};
use sortie::doctor::SealCounts;
use sortie::fleet::Keeping;
use sortie::inspector::Direction;
use sortie::ledger::RowState;
use sortie::link::Signer;
use sortie::sim::World;
use sortie::store::KeyFile;
use sortie::wire::{Encoder, SigningKey, Stamp, is_secret};
use tokio::io::AsyncWriteExt as _;
use tokio::net::{TcpStream, UdpSocket};
use tokio_util::sync::CancellationToken;

use super::{Console, serve, world};

/// A time in 2026, and a day, in units of a timestamp.
const NOW: u64 = 36_300_000_000_000;
const DAY: u64 = 86_400 * 100_000;

/// A console whose keys are in a folder, and the clock of its machine.
pub(crate) struct Signed {
    pub console: Console,
    clock: Arc<AtomicU64>,
}

/// Starts a console, once the previous one has released the keys.
pub(crate) async fn start(data: &Path, is_required: bool) -> Signed {
    let clock = Arc::new(AtomicU64::new(NOW));
    let read = Arc::clone(&clock);
    let opening = async {
        loop {
            match KeyFile::open(data) {
                Ok(opened) => return opened,
                Err(_) => tokio::task::yield_now().await,
            }
        }
    };
    let opened = tokio::time::timeout(Duration::from_secs(20), opening).await;
    let opened = opened.expect("the previous console has ended");
    let signer = Signer::new(Ok(opened), is_required, move || {
        read.load(Ordering::Relaxed)
    });
    let console = Console::start_kept(Keeping {
        signer: Some(signer),
        ..Keeping::default()
    });
    Signed { console, clock }
}

impl Signed {
    pub(crate) fn set_clock(&self, ago: u64) {
        self.clock.store(NOW - ago, Ordering::Relaxed);
    }
}

impl Console {
    pub(crate) async fn carry_out(&mut self, line: &str, vehicle: u16) -> String {
        let entry = self.give(line, &[vehicle]);
        self.until_done(entry, vehicle).await;
        self.explanation(entry, vehicle)
    }

    /// Gives a line; returns the final state of the vehicle's row.
    async fn failure(&mut self, line: &str, vehicle: u16) -> RowState {
        let entry = self.give(line, &[vehicle]);
        self.until("the line has ended", |console| {
            console
                .state(entry, vehicle)
                .is_some_and(RowState::is_final)
        })
        .await;
        self.state(entry, vehicle).expect("it has ended")
    }

    pub(crate) fn seals(&self, link: usize) -> SealCounts {
        let status = self.links[link].borrow();
        let counts = status.numbered.values().map(|frames| frames.seals);
        counts.fold(SealCounts::default(), SealCounts::plus)
    }

    async fn until_seals(&mut self, what: &str, is_so: impl Fn(SealCounts) -> bool) {
        self.until(what, |console| {
            !console.links.is_empty() && is_so(console.seals(0))
        })
        .await;
    }

    /// The last frame with this message that the console sent.
    fn last_sent(&self, message: u32) -> Option<Vec<u8>> {
        self.taps[0].look(|census, _| {
            let mut sent = census.tallies().filter(|(key, _)| {
                key.source.direction == Direction::Out && key.message == message
            });
            sent.next().map(|(_, tally)| tally.last.clone())
        })
    }
}

/// A vehicle that ignores unsigned frames on every port once it has a key.
async fn strict() -> (String, CancellationToken) {
    let mut world: World = world(1);
    world.require_signatures();
    let (addresses, cancel) = serve(world, 10.0).await;
    (addresses[0].clone(), cancel)
}

fn keys_in(data: &Path) -> Vec<String> {
    let text = fs::read_to_string(KeyFile::path_within(data)).expect("there are keys");
    let is_key = |line: &&str| line.starts_with("key =") || line.starts_with("next =");
    let keys = text.lines().filter(is_key);
    keys.filter_map(|line| Some(line.split('"').nth(1)?.to_owned()))
        .collect()
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_key_is_set_up_rotated_and_removed_with_proof() {
    let folder = tempfile::tempdir().expect("a folder");
    let (address, _vehicle) = strict().await;
    let mut console = start(folder.path(), false).await.console;
    console.connect(&address);
    console.until_known(&[1]).await;
    assert!(!KeyFile::path_within(folder.path()).exists(), "no key yet");
    let words = console.carry_out("signing setup", 1).await;
    assert!(words.contains("proved"), "{words}");
    console.carry_out("guided", 1).await;
    let first = keys_in(folder.path());
    assert_eq!(first.len(), 1);
    let again = console.failure("signing setup", 1).await;
    assert_eq!(again, RowState::Refused);
    console.carry_out("signing rotate", 1).await;
    console.carry_out("loiter", 1).await;
    let second = keys_in(folder.path());
    assert!(second.len() == 1 && second != first);
    console
        .until_seals("signed frames are counted", |seals| seals.right > 0)
        .await;
    let before = console.seals(0);
    assert!(before.foreign == 0 && before.old == 0, "{before:?}");
    console.carry_out("signing remove", 1).await;
    console.carry_out("guided", 1).await;
    console.carry_out("signing setup", 1).await;
    console.carry_out("loiter", 1).await;
    // No key is among the console's own messages.
    let shown = console.taps[0].look(|census, _| {
        let tallies = census
            .tallies()
            .map(|(key, tally)| (key.message, tally.last.clone()));
        tallies.collect::<Vec<_>>()
    });
    let (_, setup) = shown
        .iter()
        .find(|(message, _)| is_secret(*message))
        .expect("a key was sent");
    let payload = &setup[10..setup.len() - 15];
    assert!(payload.iter().all(|byte| *byte == 0), "{payload:?}");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn both_sides_restart_and_the_clock_is_set_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let (address, _vehicle) = strict().await;
    let mut signed = start(folder.path(), true).await;
    signed.console.connect(&address);
    signed
        .console
        .until_seals("unsigned frames are counted", |seals| seals.unsigned > 20)
        .await;
    assert!(
        signed.console.vehicle(1).is_none(),
        "unsigned frames change nothing"
    );
    drop(signed);
    let mut console = start(folder.path(), false).await.console;
    console.connect(&address);
    console.until_known(&[1]).await;
    console.carry_out("signing setup", 1).await;
    console.carry_out("reboot", 1).await;
    console
        .until("it is back", |console| {
            console.vehicle(1).is_some_and(|it| it.link.reboots > 0)
        })
        .await;
    console.carry_out("guided", 1).await;
    drop(console);
    for ago in [DAY, 0, 400 * DAY] {
        // With signing required, the vehicle appears only if its signatures are valid.
        let mut signed = start(folder.path(), true).await;
        signed.set_clock(ago);
        signed.console.connect(&address);
        signed.console.until_known(&[1]).await;
        let mode = if ago == 0 { "guided" } else { "loiter" };
        signed.console.carry_out(mode, 1).await;
        assert_eq!(signed.console.seals(0).old, 0);
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_console_that_is_killed_during_a_change_talks_to_the_vehicle_afterwards() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = KeyFile::path_within(folder.path());
    let (address, _vehicle) = strict().await;
    let mut console = start(folder.path(), false).await.console;
    console.connect(&address);
    console.until_known(&[1]).await;
    for (line, mode) in [("signing setup", "loiter"), ("signing rotate", "guided")] {
        let entry = console.give(line, &[1]);
        console
            .until("the key is on its way", |console| {
                console.state(entry, 1).is_some()
            })
            .await;
        // A killed console leaves no more than is on the disk now.
        let left = fs::read(&file).expect("written before it was sent");
        console.until_done(entry, 1).await;
        drop(console);
        drop(start(folder.path(), false).await);
        fs::write(&file, left).expect("as it was");
        console = start(folder.path(), true).await.console;
        console.connect(&address);
        console.until_known(&[1]).await;
        console.carry_out(mode, 1).await;
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_wrong_key_is_counted_and_commands_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = KeyFile::path_within(folder.path());
    let (address, _vehicle) = strict().await;
    let mut console = start(folder.path(), false).await.console;
    console.connect(&address);
    console.until_known(&[1]).await;
    console.carry_out("signing setup", 1).await;
    drop(console);
    drop(start(folder.path(), false).await);
    let key = keys_in(folder.path()).remove(0);
    let text = fs::read_to_string(&file).expect("readable");
    fs::write(&file, text.replace(&key, &"5".repeat(64))).expect("written");
    let mut console = start(folder.path(), true).await.console;
    console.connect(&address);
    console
        .until_seals("wrong keys are counted", |seals| seals.foreign > 20)
        .await;
    assert!(console.vehicle(1).is_none());
    drop(console);
    let mut console = start(folder.path(), false).await.console;
    console.connect(&address);
    console
        .until("it is heard", |console| console.vehicle(1).is_some())
        .await;
    assert_eq!(console.failure("guided", 1).await, RowState::TimedOut);
    assert_eq!(
        console.failure("signing rotate", 1).await,
        RowState::Refused
    );
}

fn encoded(
    encoder: &mut Encoder,
    message: &MavMessage,
    seal: Option<(SigningKey, u64)>,
) -> Vec<u8> {
    if let Some((key, timestamp)) = seal {
        encoder.sign_next(&key, Stamp { link: 0, timestamp });
    }
    let mut bytes = Vec::new();
    encoder.encode_message(message, &mut bytes);
    bytes
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn forged_and_replayed_commands_change_nothing_on_the_vehicle() {
    let folder = tempfile::tempdir().expect("a folder");
    let (address, _vehicle) = strict().await;
    let mut console = start(folder.path(), true).await.console;
    // Set up without the requirement, since the vehicle has no key yet.
    drop(console);
    console = start(folder.path(), false).await.console;
    console.connect(&address);
    console.until_known(&[1]).await;
    console.carry_out("signing setup", 1).await;
    console.carry_out("loiter", 1).await;
    console.carry_out("guided", 1).await;
    let replayed = console.last_sent(76).expect("a COMMAND_LONG");
    assert_eq!(replayed[2] & 1, 1, "it was signed");
    console.carry_out("loiter", 1).await;
    let target = address.strip_prefix("tcp:").expect("TCP");
    let mut attacker = TcpStream::connect(target).await.expect("it listens");
    let guided = MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
        command: MavCmd::MAV_CMD_DO_SET_MODE,
        param1: 1.0,
        param2: 4.0,
        target_system: 1,
        target_component: 1,
        ..COMMAND_LONG_DATA::default()
    });
    let mut encoder = Encoder::new(255, 190);
    let forged = [
        encoded(&mut encoder, &guided, None),
        encoded(&mut encoder, &guided, Some(([7; 32], NOW + DAY))),
        replayed,
    ];
    for _ in 0..20 {
        for frame in &forged {
            attacker.write_all(frame).await.expect("it reads");
        }
    }
    // The vehicle has handled all of it once it has answered the console twice.
    for _ in 0..2 {
        console.carry_out("request AUTOPILOT_VERSION", 1).await;
    }
    let mode = console.vehicle(1).and_then(|vehicle| vehicle.mode());
    assert!(mode.is_some_and(|mode| mode.is("LOITER")), "{mode:?}");
}

/// The heartbeat of a copter in STABILIZE.
fn beat(is_armed: bool) -> MavMessage {
    let armed = if is_armed {
        MavModeFlag::MAV_MODE_FLAG_SAFETY_ARMED
    } else {
        MavModeFlag::empty()
    };
    MavMessage::HEARTBEAT(HEARTBEAT_DATA {
        mavtype: MavType::MAV_TYPE_QUADROTOR,
        autopilot: MavAutopilot::MAV_AUTOPILOT_ARDUPILOTMEGA,
        base_mode: MavModeFlag::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED | armed,
        ..HEARTBEAT_DATA::default()
    })
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn forged_and_replayed_telemetry_changes_only_counters() {
    const KEY: SigningKey = [0x33; 32];
    let folder = tempfile::tempdir().expect("a folder");
    let row = format!(
        "[[vehicle]]\nsystem = 7\nlink = \"udpin:127.0.0.1:0\"\nkey = \"{}\"\n",
        "33".repeat(32)
    );
    let file = KeyFile::path_within(folder.path());
    fs::write(&file, row).expect("written");
    let private = std::os::unix::fs::PermissionsExt::from_mode(0o600);
    fs::set_permissions(&file, private).expect("ours");
    let mut console = start(folder.path(), true).await.console;
    console.connect("udpin:127.0.0.1:0");
    console
        .until("it listens", |console| {
            console
                .links
                .first()
                .is_some_and(|it| it.borrow().local.is_some())
        })
        .await;
    let local = console.links[0].borrow().local.expect("bound");
    let friend = UdpSocket::bind("127.0.0.1:0").await.expect("a port");
    let attacker = UdpSocket::bind("127.0.0.1:0").await.expect("a port");
    let mut vehicle = Encoder::new(7, 1);
    let first = encoded(&mut vehicle, &beat(false), Some((KEY, NOW)));
    friend.send_to(&first, local).await.expect("sent");
    console
        .until("it appears", |console| {
            console
                .vehicle(7)
                .is_some_and(|it| it.link.last_heard.is_some())
        })
        .await;
    let heard_at = console.vehicle(7).and_then(|it| it.link.last_heard);
    let mut stranger = Encoder::new(9, 1);
    for forged in [
        encoded(&mut vehicle, &beat(true), None),
        encoded(&mut vehicle, &beat(true), Some(([7; 32], NOW + DAY))),
        first.clone(),
        encoded(&mut stranger, &beat(true), None),
    ] {
        for from in [&attacker, &friend] {
            from.send_to(&forged, local).await.expect("sent");
        }
    }
    console
        .until_seals("all are counted", |seals| {
            seals.unsigned >= 4 && seals.foreign >= 2 && seals.old >= 2
        })
        .await;
    let after = console.vehicle(7).expect("still there");
    assert!(!after.armed());
    assert_eq!(after.link.last_heard, heard_at);
    assert!(console.vehicle(9).is_none());
    assert_eq!(console.notices, Vec::<String>::new());
    let armed = encoded(&mut vehicle, &beat(true), Some((KEY, NOW + 1)));
    friend.send_to(&armed, local).await.expect("sent");
    console
        .until("its own frame counts", |console| {
            console.vehicle(7).is_some_and(|it| it.armed())
        })
        .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_lost_key_is_replaced_on_a_port_that_takes_unsigned_frames() {
    let (addresses, _vehicle) = serve(world(1), 10.0).await;
    for _ in 0..2 {
        // Without the previous console's file.
        let folder = tempfile::tempdir().expect("a folder");
        let mut console = start(folder.path(), false).await.console;
        console.connect(&addresses[0]);
        console.until_known(&[1]).await;
        console.carry_out("signing setup", 1).await;
    }
}
