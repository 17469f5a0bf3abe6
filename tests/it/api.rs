//! The interface for programs, over the socket of the real program.

use std::io::{BufRead as _, BufReader, Write as _};
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

use serde_json::{Value, json};

use crate::terminal::{home_variables, program};

mod mcp;

/// The plain console with a socket; its input stays open.
struct Served {
    child: Child,
    folder: tempfile::TempDir,
}

impl Served {
    fn start(arguments: &[&str], option: &str) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let program = program();
        let mut child = Command::new(&program[0])
            .args(&program[1..])
            .arg("fly")
            .args(arguments)
            .args(["--plain", option])
            .arg(folder.path().join("api"))
            .envs(home_variables(folder.path()))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the program runs");
        // The socket is open before the console prints anything.
        let mut output = BufReader::new(child.stdout.take().expect("it is piped"));
        let mut greeting = String::new();
        output.read_line(&mut greeting).expect("a line");
        std::thread::spawn(move || output.lines().for_each(drop));
        Self { child, folder }
    }

    fn socket(&self) -> PathBuf {
        self.folder.path().join("api")
    }

    fn connect(&self) -> Caller {
        let write = UnixStream::connect(self.socket()).expect("the socket answers");
        let read = BufReader::new(write.try_clone().expect("cloned"));
        let mut caller = Caller { read, write };
        let welcome = caller.next();
        assert_eq!(welcome["welcome"]["interface"], 1, "{welcome}");
        caller
    }

    fn sortie(&self, arguments: &[&str]) -> Output {
        let program = program();
        Command::new(&program[0])
            .args(&program[1..])
            .args(arguments)
            .envs(home_variables(self.folder.path()))
            .output()
            .expect("the program runs")
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        // An error means that it has ended already.
        drop(self.child.kill());
        drop(self.child.wait());
    }
}

struct Caller {
    read: BufReader<UnixStream>,
    write: UnixStream,
}

impl Caller {
    fn send(&mut self, request: &Value) {
        writeln!(self.write, "{request}").expect("written");
    }

    fn next(&mut self) -> Value {
        let mut line = String::new();
        self.read.read_line(&mut line).expect("a line");
        serde_json::from_str(&line).expect("a message")
    }

    fn next_of(&mut self, kind: &str) -> Value {
        loop {
            let mut message = self.next();
            if let Some(content) = message.get_mut(kind) {
                return content.take();
            }
        }
    }

    fn wait_until_ready(&mut self, count: usize) {
        self.send(&json!({"do": "watch", "what": ["vehicles"], "every_s": 0.05}));
        let mut ready = std::collections::BTreeSet::new();
        while ready.len() < count {
            let list = self.next_of("vehicles")["list"].take();
            for vehicle in list.as_array().expect("a list") {
                if vehicle["ready_to_arm"] == true {
                    ready.insert(vehicle["vehicle"].as_u64());
                }
            }
        }
    }
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn lines_of_a_shell_fly_the_vehicles_and_say_what_became_of_them() {
    let served = Served::start(&["--vehicles", "2", "--speedup", "8"], "--api");
    served.connect().wait_until_ready(2);
    let socket = served.socket();
    let socket = socket.to_str().expect("UTF-8");
    let flown = served.sortie(&["say", socket, "all mode guided", "all arm", "1 takeoff 10"]);
    assert_eq!(
        flown.status.code(),
        Some(0),
        "{}{}",
        text(&flown.stdout),
        text(&flown.stderr)
    );
    assert!(
        text(&flown.stdout).contains("vehicle 1: done"),
        "{}",
        text(&flown.stdout)
    );
    let refused = served.sortie(&["say", socket, "3 arm"]);
    assert_eq!(refused.status.code(), Some(1));
    let wrong = served.sortie(&["say", socket, "1 takeof 10"]);
    assert_eq!(wrong.status.code(), Some(1));
    assert!(
        text(&wrong.stderr).contains("  1 takeof 10\n    ^^^^^^"),
        "{}",
        text(&wrong.stderr)
    );
    let asked = served.sortie(&["say", socket, "1 kill"]);
    assert_eq!(asked.status.code(), Some(1));
    assert!(
        text(&asked.stderr).contains("--confirm"),
        "{}",
        text(&asked.stderr)
    );
}

#[test]
fn a_socket_for_reading_takes_no_lines() {
    let served = Served::start(&["--vehicles", "1"], "--api-read-only");
    let mut caller = served.connect();
    caller.send(&json!({"id": 1, "do": "say", "line": "1 mode guided"}));
    let fault = caller.next_of("fault");
    assert_eq!(fault["id"], 1);
    caller.send(&json!({"id": 2, "do": "get", "what": "links"}));
    assert_eq!(caller.next_of("links")["id"], 2);
}

#[test]
fn the_flight_that_is_recorded_and_the_plan_on_board_can_be_asked_for() {
    let served = Served::start(&["--vehicles", "1"], "--api-read-only");
    let mut caller = served.connect();
    caller.wait_until_ready(1);
    caller.send(&json!({"id": 1, "do": "get", "what": "records"}));
    let records = caller.next_of("records");
    let frames = records["list"][0]["frames"].as_str().expect("a file");
    assert!(Path::new(frames).exists(), "{records}");
    caller.send(&json!({"id": 2, "do": "get", "what": "plan", "vehicle": 1}));
    assert_eq!(caller.next_of("plan")["vehicle"], 1);
    caller.send(&json!({"id": 3, "do": "get", "what": "parameters", "vehicle": 9}));
    assert_eq!(caller.next_of("fault")["id"], 3);
}

#[test]
fn ten_thousand_requests_are_answered_in_order_beside_fifty_clients_that_never_read() {
    let served = Served::start(&["--vehicles", "1"], "--api");
    let mut deaf = Vec::new();
    for _ in 0..50 {
        let mut one = served.connect();
        one.send(
            &json!({"do": "watch", "what": ["vehicles", "ledger", "notices"], "every_s": 0.05}),
        );
        one.write.set_nonblocking(true).expect("a socket");
        // The console stops reading requests once there is no room for its answers.
        let request = "{\"do\": \"get\", \"what\": \"vehicles\"}\n".repeat(2000);
        drop(one.write.write(request.as_bytes()));
        deaf.push(one);
    }
    let mut caller = served.connect();
    let mut asking = caller.write.try_clone().expect("cloned");
    let asked = std::thread::spawn(move || {
        for id in 0..10_000 {
            writeln!(
                asking,
                "{}",
                json!({"id": id, "do": "get", "what": "links"})
            )
            .expect("written");
        }
    });
    for id in 0..10_000 {
        assert_eq!(caller.next_of("links")["id"], id);
    }
    asked.join().expect("all are sent");
}

#[test]
fn hostile_lines_end_nothing_but_their_own_connection() {
    let served = Served::start(&["--vehicles", "1"], "--api");
    let mut hostile = served.connect();
    for line in [
        "",
        "{}",
        "[[[[",
        "{\"do\":null}",
        "\u{1b}[2J",
        "{\"id\":1e99,\"do\":\"say\"}",
    ] {
        writeln!(hostile.write, "{line}").expect("written");
        if !line.is_empty() {
            hostile.next_of("fault");
        }
    }
    // The rest of a line that is too long is not read, so writing it fails.
    drop(hostile.write.write_all(&vec![b'{'; 10 << 20]));
    let mut other = served.connect();
    other.send(&json!({"id": 9, "do": "get", "what": "vehicles"}));
    assert_eq!(other.next_of("vehicles")["id"], 9);
}

#[test]
fn the_socket_goes_with_a_console_that_is_told_to_end() {
    let mut served = Served::start(&["--vehicles", "1"], "--api");
    assert!(served.socket().exists());
    // The end of the input ends the plain console.
    drop(served.child.stdin.take());
    served.child.wait().expect("it ends");
    assert!(!served.socket().exists());
}

/// Runs an example against a mission; returns its output.
fn example(name: &str, mission: &str) -> String {
    let python = std::env::var_os("SORTIE_PYTHON").expect("SORTIE_PYTHON names a Python");
    let served = Served::start(&[mission, "--seed", "1", "--speedup", "8"], "--api");
    let script = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("examples/api")
        .join(name);
    let flown = Command::new(python)
        .arg(script)
        .arg(served.socket())
        .output()
        .expect("SORTIE_PYTHON can be started");
    assert!(flown.status.success(), "{}", text(&flown.stderr));
    text(&flown.stdout)
}

fn score(printed: &str) -> u32 {
    let word = printed.split_whitespace().last().expect("a score");
    word.parse().expect("a number")
}

#[test]
#[ignore = "needs SORTIE_PYTHON"]
fn the_example_flies_the_first_mission() {
    assert!(score(&example("first_flight.py", "00")) >= 700);
}

#[test]
#[ignore = "needs SORTIE_PYTHON"]
fn the_bot_finds_the_source_of_the_plume() {
    assert!(score(&example("plume_bot.py", "03")) >= 700);
}
