//! `sortie hangar` as a program: signals, ports, and the examples of the manual.

use std::io::{BufRead as _, BufReader, Read as _};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Instant;

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;

use super::PATIENCE;
use crate::stand_in::{Behaviour, StandIn};

/// The program, serving; killed with the test.
struct Running {
    child: Child,
    address: String,
    folder: tempfile::TempDir,
    _stand_in: StandIn,
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn command(folder: &Path, stand_in: &StandIn) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_sortie"));
    command
        .env("HOME", folder)
        .env("XDG_STATE_HOME", folder.join("state"))
        .env("XDG_CONFIG_HOME", folder.join("config"))
        .arg("hangar")
        .args(["--memory", "4096", "--arducopter"])
        .arg(stand_in.program())
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

impl Running {
    fn start(options: &[&str]) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let stand_in = StandIn::new(Behaviour::Normal);
        let mut child = command(folder.path(), &stand_in)
            .args(options)
            .spawn()
            .expect("it starts");
        let mut line = String::new();
        let out = child.stdout.take().expect("it is piped");
        BufReader::new(out)
            .read_line(&mut line)
            .expect("it is piped");
        let address = line.trim().strip_prefix("listening on ");
        let Some(address) = address.map(str::to_owned) else {
            let mut words = String::new();
            if let Some(mut err) = child.stderr.take() {
                let _ = err.read_to_string(&mut words);
            }
            panic!("{line}{words}");
        };
        Self {
            child,
            address,
            folder,
            _stand_in: stand_in,
        }
    }

    fn token(&self) -> PathBuf {
        self.folder.path().join("state/sortie/hangar-token")
    }

    /// Sends a GET with the token; returns head and body of the answer.
    fn get(&self, path: &str) -> String {
        use std::io::Write as _;
        let token = std::fs::read_to_string(self.token()).expect("it is made");
        let place = self.address.trim_start_matches("http://");
        let mut stream = std::net::TcpStream::connect(place).expect("it listens");
        write!(
            stream,
            "GET {path} HTTP/1.1\r\nHost: {place}\r\nAuthorization: Bearer {}\r\nConnection: close\r\n\r\n",
            token.trim()
        )
        .expect("it is open");
        let mut answer = String::new();
        stream.read_to_string(&mut answer).expect("it answers");
        answer
    }

    fn pid_of(&self, id: u16) -> u64 {
        let begun = Instant::now();
        loop {
            let answer = self.get(&format!("/vehicles/{id}"));
            let (_, body) = answer.split_once("\r\n\r\n").expect("a body");
            let json: serde_json::Value = serde_json::from_str(body).expect("JSON");
            if let Some(pid) = json["pid"].as_u64() {
                return pid;
            }
            assert!(begun.elapsed() < PATIENCE, "{answer}");
        }
    }
}

fn is_there(pid: u64) -> bool {
    let status = std::fs::read_to_string(format!("/proc/{pid}/status"));
    status.is_ok_and(|status| !status.contains("State:\tZ"))
}

fn until_gone(pid: u64) {
    let begun = Instant::now();
    while is_there(pid) {
        assert!(begun.elapsed() < PATIENCE, "{pid} is still there");
        std::thread::yield_now();
    }
}

#[test]
fn every_usual_signal_ends_all_vehicles_and_the_service() {
    for signal in [Signal::SIGTERM, Signal::SIGINT, Signal::SIGHUP] {
        let mut running = Running::start(&["--listen", "127.0.0.1:0"]);
        assert!(running.get("/start/1").starts_with("HTTP/1.1 201"));
        assert!(running.get("/start/2").starts_with("HTTP/1.1 201"));
        let pids = [running.pid_of(1), running.pid_of(2)];
        kill(Pid::from_raw(running.child.id() as i32), signal).expect("it is ours");
        let status = running.child.wait().expect("it is ours");
        assert_eq!(status.code(), Some(0), "{signal}");
        assert!(pids.into_iter().all(|pid| !is_there(pid)), "{signal}");
        let mut log = String::new();
        let mut err = running.child.stderr.take().expect("it is piped");
        err.read_to_string(&mut log).expect("it is text");
        for words in [
            "vehicle 1: started arducopter (system 1, pid ",
            "vehicle 2: ended",
            signal.as_str(),
        ] {
            assert!(log.contains(words), "{words}: {log}");
        }
    }
}

#[test]
fn a_service_that_is_killed_leaves_no_vehicle_behind() {
    let mut running = Running::start(&["--listen", "127.0.0.1:0"]);
    assert!(running.get("/start/1").starts_with("HTTP/1.1 201"));
    let pid = running.pid_of(1);
    running.child.kill().expect("it is ours");
    running.child.wait().expect("it is ours");
    until_gone(pid);
}

#[test]
fn a_port_that_is_taken_is_told_with_what_to_do() {
    let listener = std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
    let address = listener.local_addr().expect("it is bound").to_string();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let stand_in = StandIn::new(Behaviour::Normal);
    let said = command(folder.path(), &stand_in)
        .args(["--listen", &address])
        .output()
        .expect("it runs");
    assert_eq!(said.status.code(), Some(1));
    let words = String::from_utf8_lossy(&said.stderr);
    assert!(
        words.contains(&format!("cannot listen on {address}")),
        "{words}"
    );
    assert!(
        words.contains("choose another port with --listen"),
        "{words}"
    );
}

#[test]
fn the_status_of_several_services_is_one_json_document() {
    let running = Running::start(&["--listen", "127.0.0.1:0"]);
    // A port on which only root could listen.
    let nobody = "http://127.0.0.1:1";
    let said = Command::new(env!("CARGO_BIN_EXE_sortie"))
        .env("XDG_STATE_HOME", running.folder.path().join("state"))
        .env("XDG_CONFIG_HOME", running.folder.path().join("config"))
        .args(["hangar", "status", "--json", "--hangar"])
        .args([running.address.as_str(), "--hangar", nobody])
        .output()
        .expect("it runs");
    assert_eq!(said.status.code(), Some(1), "{said:?}");
    let all: serde_json::Value = serde_json::from_slice(&said.stdout).expect("a document");
    assert_eq!(all[0]["hangar"], running.address);
    assert_eq!(all[0]["status"]["capacity"]["running"], 0);
    assert!(all[0]["fault"].is_null());
    assert!(all[1]["status"].is_null());
    let fault = all[1]["fault"].as_str().expect("a reason");
    assert!(fault.contains("cannot be reached"), "{fault}");
}

#[test]
fn a_token_that_others_can_read_is_refused() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let stand_in = StandIn::new(Behaviour::Normal);
    let token = folder.path().join("token");
    std::fs::write(&token, "a".repeat(64)).expect("it is ours");
    std::fs::set_permissions(&token, std::fs::Permissions::from_mode(0o644)).expect("it is ours");
    let said = command(folder.path(), &stand_in)
        .args(["--listen", "127.0.0.1:0", "--token-file"])
        .arg(&token)
        .output()
        .expect("it runs");
    assert_eq!(said.status.code(), Some(2));
    let words = String::from_utf8_lossy(&said.stderr);
    assert!(
        words.contains("can be read by others (mode 0644)"),
        "{words}"
    );
}

#[test]
fn listening_for_other_machines_asks_everybody_for_the_token_and_warns() {
    let mut running = Running::start(&["--listen", "0.0.0.0:0", "--expose"]);
    let port = running
        .address
        .rsplit(':')
        .next()
        .expect("a port")
        .to_owned();
    running.address = format!("http://127.0.0.1:{port}");
    assert!(running.get("/list").starts_with("HTTP/1.1 200"));
    let mut stream = std::net::TcpStream::connect(format!("127.0.0.1:{port}")).expect("it listens");
    std::io::Write::write_all(
        &mut stream,
        b"GET /list HTTP/1.1\r\nHost: lab1\r\nConnection: close\r\n\r\n",
    )
    .expect("it is open");
    let mut answer = String::new();
    stream.read_to_string(&mut answer).expect("it answers");
    assert!(answer.starts_with("HTTP/1.1 401"), "{answer}");
    running.child.kill().expect("it is ours");
    let mut log = String::new();
    let mut err = running.child.stderr.take().expect("it is piped");
    err.read_to_string(&mut log).expect("it is text");
    assert!(log.contains("HTTP is not encrypted"), "{log}");
    assert!(log.contains("every user of this machine"), "{log}");
}

/// The examples of docs/hangar.md, if curl is installed: `$HANGAR` is the service's address. They send no token: the
/// system shows that curl is run by the same user.
#[test]
fn the_examples_with_curl_work_as_written() {
    if Command::new("curl").arg("--version").output().is_err() {
        eprintln!("skipped: there is no curl");
        return;
    }
    let running = Running::start(&["--listen", "127.0.0.1:0"]);
    for (line, expected) in [
        ("curl -s $HANGAR/start/1", "1 started\n"),
        (
            "curl -s \"$HANGAR/vehicles/1/ready?timeout_s=90\"",
            "\"stage\":\"ready\"",
        ),
        ("curl -s $HANGAR/list", "1 ready\n"),
        (
            "curl -s $HANGAR/vehicles -H 'Content-Type: application/json' -d '{\"system\": 2}'",
            "\"system\":2",
        ),
        ("curl -s $HANGAR/stop/1", "1 stopped\n"),
        (
            "curl -s -X DELETE $HANGAR/vehicles/2 -w '%{http_code}'",
            "204",
        ),
        ("curl -s -m 2 -N $HANGAR/events", "event: snapshot\ndata: {"),
    ] {
        let said = Command::new("sh")
            .env("HANGAR", &running.address)
            .args(["-c", line])
            .output()
            .expect("sh runs");
        let words = String::from_utf8_lossy(&said.stdout);
        assert!(words.contains(expected), "{line}: {words}");
    }
}
