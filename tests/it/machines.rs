//! A class on several machines, each of which is a network namespace of this host.
//!
//! `cargo test --features zenoh --test it -- --ignored --nocapture machines::` runs them.

use std::fs;
use std::io::{BufRead as _, BufReader, Read as _};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};

use tempfile::TempDir;

use crate::terminal::Terminal;

const PROGRAM: &str = env!("CARGO_BIN_EXE_sortie");
/// The port of the desk, as in `/proc/net/tcp`.
const DESK_PORT: &str = ":1D17";
/// The state of a socket that listens, as there.
const LISTENING: &str = "0A";

/// A network namespace. It ends with the test.
struct Namespace {
    process: Child,
    /// As long as it is open, the process waits.
    _held: Option<ChildStdin>,
}

impl Namespace {
    /// Makes one with a command that runs another one in it; says why there is none.
    fn make(command: &[&str]) -> Result<Self, String> {
        let (program, arguments) = command.split_first().expect("a command");
        let mut command = Command::new(program);
        command.args(arguments).args(["sh", "-c", "echo; exec cat"]);
        command.stdin(Stdio::piped());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let spawned = command.spawn();
        let mut process = spawned.map_err(|error| format!("{program}: {error}"))?;
        let mut line = String::new();
        let output = process.stdout.take().expect("it is piped");
        BufReader::new(output)
            .read_line(&mut line)
            .expect("readable");
        if line.is_empty() {
            let mut said = String::new();
            let mut errors = process.stderr.take().expect("it is piped");
            errors.read_to_string(&mut said).expect("readable");
            return Err(said);
        }
        Ok(Self {
            _held: process.stdin.take(),
            process,
        })
    }

    /// The first words of a command that runs in it.
    fn entry(&self) -> Vec<String> {
        let target = self.process.id().to_string();
        let words = ["nsenter", "--preserve-credentials", "--user", "--net"];
        let words = words.into_iter().chain(["--target", &target]);
        words.map(str::to_owned).collect()
    }

    /// Runs `ip` in it; says why it fails.
    fn ip(&self, arguments: &str) -> Result<(), String> {
        let entry = self.entry();
        let mut command = Command::new(&entry[0]);
        command.args(&entry[1..]).arg("ip");
        let output = command.args(arguments.split(' ')).output();
        let output = output.map_err(|error| error.to_string())?;
        if output.status.success() {
            return Ok(());
        }
        let said = String::from_utf8_lossy(&output.stderr);
        Err(format!("ip {arguments}: {}", said.trim()))
    }

    /// The sockets in it: UDP as `udp`, TCP with its two addresses and its state.
    fn sockets(&self) -> Vec<String> {
        let mut sockets = Vec::new();
        for kind in ["tcp", "tcp6", "udp", "udp6"] {
            let file = format!("/proc/{}/net/{kind}", self.process.id());
            let text = fs::read_to_string(file).expect("it is there");
            sockets.extend(text.lines().skip(1).map(|line| {
                let words: Vec<&str> = line.split_whitespace().collect();
                format!("{kind} {} {} {}", words[1], words[2], words[3])
            }));
        }
        sockets
    }
}

impl Drop for Namespace {
    fn drop(&mut self) {
        // An error means that it has ended already.
        drop(self.process.kill());
        drop(self.process.wait());
    }
}

/// The machine of the desk and those of seats, at a switch.
struct Lab {
    switch: Namespace,
    /// 0 is the desk's, the others have the numbers of their seats.
    machines: Vec<Namespace>,
    folder: TempDir,
}

impl Lab {
    /// Makes the machines and the class; `None` if this host makes no namespaces, which it says.
    fn new(seats: usize) -> Option<Self> {
        match Self::connected(seats) {
            Ok(lab) => {
                lab.make_class();
                Some(lab)
            }
            Err(reason) => {
                eprintln!("not run: no network namespaces can be made here: {reason}");
                None
            }
        }
    }

    fn connected(seats: usize) -> Result<Self, String> {
        let switch = Namespace::make(&["unshare", "--user", "--map-root-user", "--net"])?;
        switch.ip("link add bridge type bridge")?;
        switch.ip("link set bridge up")?;
        let mut machines = Vec::new();
        for number in 0..=seats {
            let mut command = switch.entry();
            command.extend(["unshare".to_owned(), "--net".to_owned()]);
            let command: Vec<&str> = command.iter().map(String::as_str).collect();
            let machine = Namespace::make(&command)?;
            let (port, process) = (port(number), machine.process.id());
            switch.ip(&format!(
                "link add {port} type veth peer name eth0 netns {process}"
            ))?;
            switch.ip(&format!("link set {port} master bridge up"))?;
            machine.ip(&format!("address add 10.0.0.{}/24 dev eth0", number + 1))?;
            machine.ip("link set eth0 up")?;
            machine.ip("link set lo up")?;
            machines.push(machine);
        }
        Ok(Self {
            switch,
            machines,
            folder: tempfile::tempdir().expect("a folder"),
        })
    }

    fn make_class(&self) {
        let mut command = Command::new(PROGRAM);
        let seats = (self.machines.len() - 1).to_string();
        command.args(["class", "new", "9-A", "--seats", &seats]);
        command.args(["--address", "10.0.0.1:7447", "--output"]);
        let made = command.arg(self.class()).output().expect("it starts");
        assert!(made.status.success(), "{made:?}");
    }

    fn class(&self) -> String {
        self.folder.path().join("9-A").display().to_string()
    }

    /// Starts the program on a machine.
    fn start(&self, machine: usize, arguments: &[&str]) -> Terminal {
        let mut command = self.machines[machine].entry();
        command.push(PROGRAM.to_owned());
        let words = command.iter().map(String::as_str);
        let words: Vec<&str> = words.chain(arguments.iter().copied()).collect();
        Terminal::run(&words, 140, 40, &[ONE_READER])
    }

    fn open_desk(&self) -> Terminal {
        self.start(0, &["class", "open", &self.class(), "--listen"])
    }

    /// A trainee in flight at a seat.
    fn fly(&self, number: usize) -> Terminal {
        let line = Path::new(&self.class()).join(format!("seats/seat-{number:02}.join"));
        let line = line.display().to_string();
        let mut seat = self.start(number, &["fly", "00", "--class", &line]);
        seat.see("desk: ").press("F").see("FLY");
        seat
    }

    /// Pulls the plug of a machine at the switch, or puts it in again.
    fn plug(&self, machine: usize, state: &str) {
        let changed = self
            .switch
            .ip(&format!("link set {} {state}", port(machine)));
        changed.expect("the switch is there");
    }

    /// The network has nothing but connections from seats to the desk's one port: no discovery, no MAVLink.
    fn check_sockets(&self) {
        for (number, machine) in self.machines.iter().enumerate() {
            for socket in machine.sockets() {
                let words: Vec<&str> = socket.split(' ').collect();
                let [kind, own, other, state] = words[..] else {
                    panic!("{socket}");
                };
                let is_seats = kind == "tcp" && other.ends_with(DESK_PORT);
                let is_desks = kind == "tcp" && own.ends_with(DESK_PORT);
                let is_known = if number == 0 { is_desks } else { is_seats };
                assert!(is_known, "machine {number}: {socket}");
                assert!(number == 0 || state != LISTENING, "{socket}");
            }
        }
    }
}

/// Zenoh reads all connections with one thread, so that a connection that holds it up is noticed.
const ONE_READER: (&str, &str) = ("ZENOH_RUNTIME", "(rx: (worker_threads: 1))");
/// What a seat says when it has lost its desk.
const GONE: &str = "the desk is gone; your flight continues";

/// The clock in the header of a screen, in s.
fn clock(screen: &str) -> Option<u32> {
    let (minutes, seconds) = screen
        .lines()
        .next()?
        .split_whitespace()
        .last()?
        .split_once(':')?;
    Some(minutes.parse::<u32>().ok()? * 60 + seconds.parse::<u32>().ok()?)
}

/// The port of the switch to which a machine is plugged.
fn port(machine: usize) -> String {
    format!("port{machine}")
}

#[test]
#[ignore = "makes network namespaces"]
fn flights_on_several_machines_go_on_without_network_and_without_desk() {
    let Some(lab) = Lab::new(2) else {
        return;
    };
    let mut desk = lab.open_desk();
    desk.see("No trainee has joined yet");
    let [mut first, mut second] = [1, 2].map(|number| lab.fly(number));
    desk.wait("two flights", |screen| {
        screen.matches("00-first  ").count() == 2
    });
    lab.check_sockets();

    lab.plug(1, "down");
    first.see(GONE).command("1 guided");
    desk.command("class message @seat-02 look at the battery");
    second.see("look at the battery");
    lab.plug(1, "up");
    desk.see("1 guided").see("2 of 2 seats connected");

    desk.kill();
    second.see(GONE).command("1 land");
    let mut desk = lab.open_desk();
    desk.see("2 of 2 seats connected")
        .see("1 guided")
        .see("1 land")
        .command("class freeze @all");
    first.see("FROZEN");
    second.see("FROZEN");
    lab.check_sockets();
    // It asks, once it knows that flights are frozen.
    desk.wait("two frozen flights", |screen| {
        screen.matches(" frozen").count() == 2
    });
    desk.press("q").see("QUIT").press("y");
    assert_eq!(desk.end(), 0);
}

#[test]
#[ignore = "makes network namespaces"]
fn machines_that_are_gone_end_no_connection_of_another() {
    let Some(lab) = Lab::new(3) else {
        return;
    };
    let mut desk = lab.open_desk();
    desk.see("No trainee has joined yet");
    let [mut first, _second, mut third] = [1, 2, 3].map(|number| lab.fly(number));
    desk.see("3 of 3 seats connected");
    for machine in [1, 2] {
        lab.plug(machine, "down");
    }
    desk.see("1 of 3 seats connected");
    first.see(GONE).command("1 guided");
    // Longer than both sides wait for a word.
    let start = clock(&third.contents()).expect("a clock");
    third.wait("half a minute", |screen| {
        assert!(!screen.contains(GONE), "{screen}");
        clock(screen).is_some_and(|now| now >= start + 30)
    });
    desk.command("class message @seat-03 look at the battery");
    third.see("look at the battery");
    for machine in [1, 2] {
        lab.plug(machine, "up");
    }
    // Nothing of the journal was lost in half a minute.
    desk.see("3 of 3 seats connected").see("1 guided");

    third.kill();
    desk.see("2 of 3 seats connected");
    let mut third = lab.fly(3);
    desk.see("3 of 3 seats connected")
        .command("class message @seat-03 once more");
    third.see("once more");
}
