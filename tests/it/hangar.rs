//! The hangar against a stand-in for `arducopter`, and against a real one, named by `SORTIE_ARDUCOPTER`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

use mavlink::dialects::ardupilotmega::{COMMAND_LONG_DATA, MavCmd, MavMessage};
use nix::errno::Errno;
use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use sortie::hangar::{
    Hangar, HangarLimits, HangarRefusal, HangarSetup, Instance, InstanceId, Instances, Launch,
    Restart, SitlStage,
};
use sortie::sitl::SitlKind;
use sortie::wire::{
    AUTOPILOT_COMPONENT, Decoder, Encoder, GROUND_STATION_COMPONENT, GROUND_STATION_SYSTEM,
};
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _, DuplexStream};
use tokio::time::{Instant, sleep, timeout};

use crate::fleet::Console;
use crate::stand_in::{Behaviour, StandIn};

mod disk;
mod faults;
mod owner;
mod real;
mod restarts;

const PATIENCE: Duration = Duration::from_secs(120);
const HEARTBEAT: u32 = 0;

fn config(folder: &Path, program: PathBuf) -> HangarSetup {
    HangarSetup {
        programs: BTreeMap::from([(SitlKind::Copter, program)]),
        folder: folder.to_owned(),
        limits: HangarLimits::default(),
        restart: Restart::Never,
        sortie: PathBuf::from(env!("CARGO_BIN_EXE_sortie")),
    }
}

/// A hangar for a test, with the program that its instances run.
struct Stand {
    hangar: Hangar,
    _folder: tempfile::TempDir,
    _stand_in: Option<StandIn>,
}

impl Stand {
    fn of(behaviour: Behaviour) -> Self {
        Self::with(behaviour, |config| config)
    }

    fn with(behaviour: Behaviour, change: impl FnOnce(HangarSetup) -> HangarSetup) -> Self {
        let stand_in = StandIn::new(behaviour);
        Self::open(stand_in.program(), Some(stand_in), change)
    }

    fn running(program: PathBuf, change: impl FnOnce(HangarSetup) -> HangarSetup) -> Self {
        Self::open(program, None, change)
    }

    fn open(
        program: PathBuf,
        stand_in: Option<StandIn>,
        change: impl FnOnce(HangarSetup) -> HangarSetup,
    ) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let config = change(config(folder.path(), program));
        Self {
            hangar: Hangar::open(config).expect("it opens"),
            _folder: folder,
            _stand_in: stand_in,
        }
    }

    /// Launches the default vehicle.
    async fn launch(&self) -> InstanceId {
        let launched = self.hangar.launch(Launch::default()).await;
        launched.expect("it can be launched")
    }

    /// Waits until a condition is true of all instances together.
    async fn until(&self, what: &str, is_true: impl FnMut(&Instances) -> bool) -> Instances {
        let mut instances = self.hangar.instances();
        let waited = timeout(PATIENCE, instances.wait_for(is_true)).await;
        let Ok(all) = waited else {
            panic!(
                "waited in vain until {what}: {:#?}",
                self.hangar.instances().borrow()
            )
        };
        all.expect("it is open").clone()
    }

    /// Waits until a condition is true of one instance, and returns it.
    async fn until_one(
        &self,
        id: InstanceId,
        what: &str,
        mut is_true: impl FnMut(&Instance) -> bool,
    ) -> Instance {
        let all = self.until(what, |all| all.get(&id).is_some_and(&mut is_true));
        all.await[&id].clone()
    }

    async fn until_ready(&self, id: InstanceId) -> Instance {
        self.until_one(id, "it is ready", |one| one.stage == SitlStage::Ready)
            .await
    }

    async fn until_ended(&self, id: InstanceId) -> Instance {
        self.until_one(id, "it has ended", |one| one.stage == SitlStage::Ended)
            .await
    }

    async fn attach(&self, id: InstanceId) -> Attached {
        Attached {
            pipe: self.hangar.attach(id).await.expect("nobody is attached"),
            decoder: Decoder::new(),
            encoder: Encoder::new(GROUND_STATION_SYSTEM, GROUND_STATION_COMPONENT),
        }
    }
}

struct Attached {
    pipe: DuplexStream,
    decoder: Decoder,
    encoder: Encoder,
}

impl Attached {
    /// Waits for the next heartbeat, and returns its system id.
    async fn heartbeat(&mut self) -> u8 {
        let heard = async {
            loop {
                while let Some(frame) = self.decoder.next_frame() {
                    if frame.content.id() == HEARTBEAT {
                        return frame.system;
                    }
                }
                let mut bytes = [0; 4096];
                let len = self.pipe.read(&mut bytes).await.expect("it is open");
                assert!(len > 0, "the pipe lasts");
                self.decoder.push(&bytes[..len]);
            }
        };
        timeout(PATIENCE, heard).await.expect("a heartbeat comes")
    }

    /// Drops all bytes received so far.
    async fn forget(&mut self) {
        let mut bytes = vec![0; 65536];
        let read = timeout(Duration::from_millis(1), self.pipe.read(&mut bytes));
        drop(read.await);
        self.decoder = Decoder::new();
    }

    async fn reboot(&mut self, system: u8) {
        let reboot = MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
            target_system: system,
            target_component: AUTOPILOT_COMPONENT,
            command: MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN,
            param1: 1.0,
            ..COMMAND_LONG_DATA::default()
        });
        let mut bytes = Vec::new();
        self.encoder.encode_message(&reboot, &mut bytes);
        self.pipe.write_all(&bytes).await.expect("it is taken");
    }
}

impl Attached {
    /// Checks that an instance runs in real time: it sends a heartbeat once a simulated second, so
    /// three intervals take about three seconds. It runs ten times as fast until it is ready.
    async fn assert_real_time(&mut self) {
        self.forget().await;
        self.heartbeat().await;
        let begun = Instant::now();
        for _ in 0..3 {
            self.heartbeat().await;
        }
        assert!(begun.elapsed() > Duration::from_millis(1500));
    }
}

/// Checks that a console loses a vehicle whose process is killed, finds it again after the restart,
/// and can command it.
async fn assert_a_console_has_it_back(stand: &Stand) {
    let id = stand.launch().await;
    let mut console = Console::start();
    console.connect_to(stand.hangar.attach(id).await.expect("nobody is attached"));
    let first = stand.until_ready(id).await;
    let is_ready = |console: &Console| console.vehicle(1).is_some_and(|one| one.ready_to_arm());
    console.until("it can be armed", is_ready).await;
    signal(first.pid.expect("it runs"), Signal::SIGKILL);
    let is_lost = |console: &Console| console.vehicle(1).is_some_and(|one| one.link.lost);
    console.until("it is lost", is_lost).await;
    stand.hangar.restart(id).await.expect("it is there");
    console
        .until("it is back", |console| {
            console
                .vehicle(1)
                .is_some_and(|one| !one.link.lost && one.ready_to_arm())
        })
        .await;
    let again = stand.until_ready(id).await;
    assert_eq!((again.restarts, again.attached), (1, true));
    for line in ["guided", "arm", "takeoff 5"] {
        let entry = console.give(line, &[1]);
        console.until_done(entry, 1).await;
    }
}

fn signal(pid: u32, signal: Signal) {
    kill(Pid::from_raw(pid as i32), signal).expect("it is ours");
}

/// Whether a process has ended, including one whose exit status has not been read.
fn is_gone(pid: u32) -> bool {
    let is_zombie = || {
        let status = std::fs::read_to_string(format!("/proc/{pid}/status")).unwrap_or_default();
        status.contains("State:\tZ")
    };
    kill(Pid::from_raw(pid as i32), None) == Err(Errno::ESRCH) || is_zombie()
}

async fn until_gone(pid: u32) {
    let gone = async {
        while !is_gone(pid) {
            sleep(Duration::from_millis(20)).await;
        }
    };
    let waited = timeout(PATIENCE, gone).await;
    assert!(waited.is_ok(), "process {pid} is still there");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn thirty_two_are_started_at_once_and_no_more_where_that_is_the_limit() {
    let stand = Stand::with(Behaviour::Normal, |config| HangarSetup {
        limits: HangarLimits {
            instances: 32,
            starts_per_s: 1000,
            ..HangarLimits::default()
        },
        ..config
    });
    for id in 1..=32 {
        assert_eq!(stand.launch().await, id);
    }
    let one_more = stand.hangar.launch(Launch::default()).await;
    assert!(matches!(one_more, Err(HangarRefusal::Full(32))));
    assert_eq!(stand.hangar.capacity().free, 0);
    let all = stand
        .until("all are ready", |all| {
            all.values().all(|one| one.stage == SitlStage::Ready)
        })
        .await;
    for (id, one) in all.iter() {
        assert_eq!(u16::from(one.system), *id);
        let [received, count] = one.parameters;
        assert!(received == count && count > 1000, "{:?}", one.parameters);
        assert_eq!((one.fault.as_ref(), one.hint.as_ref()), (None, None));
    }
    stand.hangar.close().await;
    for one in all.values() {
        assert!(is_gone(one.pid.expect("it runs")));
    }
    let late = stand.hangar.launch(Launch::default()).await;
    assert!(matches!(late, Err(HangarRefusal::Closing)));
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn an_instance_is_what_was_asked_for_and_shows_what_it_uses() {
    let stand = Stand::of(Behaviour::Normal);
    let launch = Launch {
        id: Some(300),
        system: Some(42),
        speedup: 3.0,
        parameters: BTreeMap::from([("WPNAV_SPEED".to_owned(), 777.0)]),
        ..Launch::default()
    };
    let id = stand.hangar.launch(launch).await.expect("it starts");
    assert_eq!(id, 300);
    let mut attached = stand.attach(id).await;
    assert_eq!(attached.heartbeat().await, 42);
    stand.until_ready(id).await;
    let one = stand
        .until_one(id, "its use is known", |one| {
            one.memory_bytes > 0 && one.cpu_ms > 0 && one.attached
        })
        .await;
    let written = std::fs::read_to_string(Path::new(&one.folder).join("vehicle.parm"));
    assert!(written.expect("it is there").contains("WPNAV_SPEED 777"));
    assert!(matches!(
        stand.hangar.attach(id).await,
        Err(HangarRefusal::Attached(300))
    ));
    assert!(matches!(
        stand.hangar.attach(1).await,
        Err(HangarRefusal::Unknown(1))
    ));
    drop(attached);
    stand
        .until_one(id, "nobody is attached", |one| !one.attached)
        .await;
    stand.hangar.stop(id).await.expect("it is there");
    assert!(stand.hangar.instances().borrow().is_empty());
    assert!(is_gone(one.pid.expect("it ran")));
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn one_to_whom_nobody_is_attached_is_ended_where_that_was_asked_for() {
    let stand = Stand::of(Behaviour::Normal);
    let launch = Launch {
        idle_s: Some(1),
        ..Launch::default()
    };
    let id = stand.hangar.launch(launch).await.expect("it starts");
    let attached = stand.attach(id).await;
    let one = stand.until_ready(id).await;
    drop(attached);
    stand.until("it is gone", |all| all.is_empty()).await;
    assert!(is_gone(one.pid.expect("it ran")));
}

/// Instances listen on no port: each connects to a port that the system has chosen.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn ports_that_others_have_taken_do_not_matter() {
    // The ports are taken by this test or by another program.
    let _taken: Vec<_> = [5760, 5762, 5763, 5770, 5501]
        .into_iter()
        .map(|port| std::net::TcpListener::bind(("127.0.0.1", port)))
        .collect();
    let stands = [Behaviour::Normal, Behaviour::Normal].map(Stand::of);
    for stand in &stands {
        let id = stand.launch().await;
        assert_eq!(id, 1);
        stand.until_ready(id).await;
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_stranger_who_connects_to_an_instances_listener_is_shown_out() {
    let stand = Stand::of(Behaviour::Normal);
    let id = stand.launch().await;
    let one = stand.until_ready(id).await;
    let environment = std::fs::read(format!("/proc/{}/environ", one.pid.expect("it runs")));
    let environment = String::from_utf8_lossy(&environment.expect("it is ours")).into_owned();
    let (_, door) = environment.split_once("tcpclient:").expect("it has one");
    let door = door.split(['\n', '\0']).next().expect("an address");
    let mut stranger = tokio::net::TcpStream::connect(door)
        .await
        .expect("it listens");
    let mut said = [0; 16];
    let heard = timeout(PATIENCE, stranger.read(&mut said)).await;
    assert!(
        matches!(heard.expect("it is closed"), Ok(0) | Err(_)),
        "nothing is said to a stranger"
    );
    stand
        .until_one(id, "it is counted", |one| one.refused == 1)
        .await;
    assert_eq!(stand.attach(id).await.heartbeat().await, 1);
}
