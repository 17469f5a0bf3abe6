//! A stand-in for `arducopter`: NOT ArduPilot, but a program that starts, becomes ready, crashes, hangs and prints
//! like it, so that the hangar can be tested without ArduPilot.
//!
//! It is this test binary, run again by a small script ([`StandIn::program`]). It understands the options that the
//! hangar passes to SITL, and then speaks `MAVLink` for the embedded simulator. It never outlives [`LIFE`].

use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::path::PathBuf;
use std::process::{Command, Stdio, exit};
use std::thread;
use std::time::Duration;

mod program;

use program::Program;

/// The maximum life of a stand-in, in case its test does not end it.
const LIFE: Duration = Duration::from_secs(300);
/// A file of this name in a stand-in's folder makes it crash once, while it runs.
pub const CRASH_FILE: &str = "crash-now";
/// A file in a stand-in's folder that grows by one byte at each start; SITL stores its parameters
/// in a file of this name.
pub const MEMORY_FILE: &str = "eeprom.bin";

const BEHAVIOUR: &str = "SORTIE_STAND_IN";
const ARGUMENTS: &str = "SORTIE_STAND_IN_ARGUMENTS";

/// The behaviour of a stand-in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Behaviour {
    /// Like SITL: it is ready soon and lives until it is ended.
    Normal,
    /// Like SITL, but it boots as slowly as the real one: 42 simulated seconds until it is ready.
    BootsSlowly,
    /// Prints two lines and exits with code 3.
    ExitsBeforeConnecting,
    /// Aborts this many simulated seconds after it has connected.
    CrashesAfter(u32),
    /// Starts and never connects.
    NeverConnects,
    /// Connects and then sends nothing, using its processor.
    StaysSilent,
    /// Works and prints a megabyte a second.
    FloodsItsOutput,
    /// Works and ignores requests to end.
    IgnoresTermination,
    /// Works and never gets a position.
    NeverReady,
    /// Works and has started a child, whose pid it prints as `child PID`.
    HasChildren,
    /// Works and does not end with its parent process; needs `setpriv` (Linux).
    OutlivesItsOwner,
    /// Ends at once on its first starts in a folder, this many times, and then works.
    FailsAtFirst(u32),
}

impl Behaviour {
    fn words(self) -> String {
        match self {
            Self::Normal => "normal".to_owned(),
            Self::BootsSlowly => "boots-slowly".to_owned(),
            Self::ExitsBeforeConnecting => "exits".to_owned(),
            Self::CrashesAfter(seconds) => format!("crashes {seconds}"),
            Self::NeverConnects => "never-connects".to_owned(),
            Self::StaysSilent => "silent".to_owned(),
            Self::FloodsItsOutput => "floods".to_owned(),
            Self::IgnoresTermination => "ignores-termination".to_owned(),
            Self::NeverReady => "never-ready".to_owned(),
            Self::HasChildren => "has-children".to_owned(),
            Self::OutlivesItsOwner => "outlives".to_owned(),
            Self::FailsAtFirst(times) => format!("fails {times}"),
        }
    }

    fn parse(words: &str) -> Self {
        let (name, number) = words.split_once(' ').unwrap_or((words, "0"));
        let number = number.parse().expect("a number");
        match name {
            "normal" => Self::Normal,
            "boots-slowly" => Self::BootsSlowly,
            "exits" => Self::ExitsBeforeConnecting,
            "crashes" => Self::CrashesAfter(number),
            "never-connects" => Self::NeverConnects,
            "silent" => Self::StaysSilent,
            "floods" => Self::FloodsItsOutput,
            "ignores-termination" => Self::IgnoresTermination,
            "never-ready" => Self::NeverReady,
            "has-children" => Self::HasChildren,
            "outlives" => Self::OutlivesItsOwner,
            "fails" => Self::FailsAtFirst(number),
            other => panic!("no behaviour {other}"),
        }
    }
}

/// The program of a stand-in, in a temporary folder.
pub struct StandIn(tempfile::TempDir);

impl StandIn {
    pub fn new(behaviour: Behaviour) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let this = std::env::current_exe().expect("a path");
        let trap = match behaviour {
            Behaviour::IgnoresTermination => "trap '' TERM\n",
            _ => "",
        };
        let wrapper = match behaviour {
            // The signal by which the kernel ends a process with its parent.
            Behaviour::OutlivesItsOwner => "setpriv --pdeathsig clear ",
            _ => "",
        };
        let words = behaviour.words();
        let script = format!(
            "#!/bin/sh\n# NOT ArduPilot: a stand-in for it, of the tests of sortie.\n{trap}IFS='\n'\n\
             {ARGUMENTS}=\"$*\"\n{BEHAVIOUR}='{words}'\nexport {ARGUMENTS} {BEHAVIOUR}\n\
             exec {wrapper}'{}' --exact stand_in::stand_in_for_arducopter --nocapture --test-threads 1\n",
            this.display()
        );
        let draft = folder.path().join("draft");
        fs::write(&draft, script).expect("written");
        fs::set_permissions(&draft, fs::Permissions::from_mode(0o755)).expect("it is ours");
        // A file that this process has open for writing while another thread forks cannot be executed.
        let copied = Command::new("cp")
            .arg("-p")
            .args([&draft, &folder.path().join("arducopter")])
            .status();
        assert!(copied.expect("cp is there").success());
        Self(folder)
    }

    /// The path of the program, in place of an `arducopter`.
    pub fn program(&self) -> PathBuf {
        self.0.path().join("arducopter")
    }
}

/// Not a test itself: the body of the stand-in. Without a behaviour it does nothing.
#[test]
fn stand_in_for_arducopter() {
    let Ok(behaviour) = std::env::var(BEHAVIOUR) else {
        return;
    };
    let arguments = std::env::var(ARGUMENTS).expect("the script sets it");
    thread::spawn(|| {
        thread::sleep(LIFE);
        exit(98);
    });
    Program::new(Behaviour::parse(&behaviour), &arguments).run();
}

#[test]
fn a_stand_in_connects_out_and_greets() {
    let listener = std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let stand_in = StandIn::new(Behaviour::Normal);
    let mut child = Command::new(stand_in.program())
        .args(["--model", "quad", "--sysid", "7", "--serial0"])
        .arg(format!("tcpclient:{}", listener.local_addr().expect("it")))
        .current_dir(folder.path())
        .stdout(Stdio::null())
        .spawn()
        .expect("it starts");
    let (mut stream, _) = listener.accept().expect("it connects");
    let mut heard = Vec::new();
    let mut decoder = sortie::wire::Decoder::new();
    let frame = loop {
        let mut bytes = [0; 256];
        let len = std::io::Read::read(&mut stream, &mut bytes).expect("it speaks");
        assert!(len > 0, "it lives on");
        heard.extend_from_slice(&bytes[..len]);
        decoder.push(&bytes[..len]);
        if let Some(frame) = decoder.next_frame() {
            break frame;
        }
    };
    assert!(String::from_utf8_lossy(&heard).contains("Init ArduCopter V4.6.0-stand-in"));
    assert_eq!((frame.system, frame.content.id()), (7, 0));
    child.kill().expect("it is ours");
    child.wait().expect("it is ours");
}

#[test]
fn a_stand_in_without_a_model_says_so_as_the_real_one_does() {
    let stand_in = StandIn::new(Behaviour::Normal);
    let said = Command::new(stand_in.program()).output().expect("it runs");
    assert_eq!(said.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&said.stdout).contains("You must specify a vehicle model"));
}
