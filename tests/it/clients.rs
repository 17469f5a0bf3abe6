//! Other programs as clients of `sortie sim`: scripts in the style of their users (tests/clients/README.md).
//!
//! `SORTIE_PYTHON` names the Python that has the clients' modules:
//! `SORTIE_PYTHON=FILE cargo test --test it -- --ignored clients::` runs them.

use std::io::{BufRead as _, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// The longest time that a script may take.
const LIMIT: Duration = Duration::from_secs(180);

/// A process that ends with the test.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        // An error means that it has ended already.
        drop(self.0.kill());
        drop(self.0.wait());
    }
}

fn has_modules(python: &Path, modules: &[&str]) -> bool {
    let probe = "import sys, importlib.util as u; sys.exit(any(u.find_spec(m) is None for m in sys.argv[1:]))";
    Command::new(python)
        .args(["-c", probe])
        .args(modules)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .expect("SORTIE_PYTHON can be started")
        .success()
}

/// The path of the interpreter. A relative path is relative to the current folder, not to that of
/// the scripts; a bare name is searched for on PATH. Links are not followed, because an interpreter
/// finds its virtual environment by its link.
fn interpreter() -> PathBuf {
    let named = std::env::var_os("SORTIE_PYTHON").expect("SORTIE_PYTHON names a Python");
    let path = PathBuf::from(named);
    if path.components().count() > 1 {
        std::path::absolute(&path).unwrap_or(path)
    } else {
        path
    }
}

/// One vehicle on a free port, and its address.
fn simulator(speedup: u8) -> (Running, String) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_sortie"))
        .args(["sim", "--tcp", "127.0.0.1:0", "--speedup"])
        .arg(speedup.to_string())
        .stdout(Stdio::piped())
        .spawn()
        .expect("sortie starts");
    let mut line = String::new();
    let output = child.stdout.as_mut().expect("it is piped");
    BufReader::new(output)
        .read_line(&mut line)
        .expect("it says where it serves");
    let mut words = line.split_whitespace();
    assert_eq!(words.next(), Some("serving"), "`serving HOST:PORT (...)`");
    let address = words.next().expect("`serving HOST:PORT (...)`").to_owned();
    (Running(child), address)
}

/// The exit status of a process, if it ends in time.
fn end_of(process: &mut Child) -> Option<ExitStatus> {
    let started = Instant::now();
    while started.elapsed() < LIMIT {
        if let Some(status) = process.try_wait().expect("waited for") {
            return Some(status);
        }
        std::thread::sleep(Duration::from_millis(100));
    }
    None
}

/// Runs a script against its own vehicle. `prefix` comes before HOST:PORT in the address that the
/// client expects.
fn run(script: &str, modules: &[&str], prefix: &str, speedup: u8) {
    let python = interpreter();
    assert!(
        has_modules(&python, modules),
        "{} lacks one of: {}",
        python.display(),
        modules.join(", ")
    );
    let (_simulator, address) = simulator(speedup);
    let folder = tempfile::tempdir().expect("a temporary folder");
    let log = folder.path().join("output");
    let output = std::fs::File::create(&log).expect("created");
    let errors = output.try_clone().expect("cloned");
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/clients")
        .join(script);
    let mut client = Running(
        Command::new(python)
            .arg("-u")
            .arg(path)
            .arg(format!("{prefix}{address}"))
            .env("PYTHONDONTWRITEBYTECODE", "1")
            .current_dir(folder.path())
            .stdin(Stdio::null())
            .stdout(output)
            .stderr(errors)
            .spawn()
            .expect("the interpreter was found before"),
    );
    let started = Instant::now();
    let status = end_of(&mut client.0);
    let said = String::from_utf8_lossy(&std::fs::read(&log).expect("read")).into_owned();
    assert!(
        status.is_some_and(|status| status.success()),
        "{script} ended with {status:?}, having said:\n{said}"
    );
    println!(
        "{script} passed in {:.0} s",
        started.elapsed().as_secs_f64()
    );
}

#[test]
#[ignore = "needs SORTIE_PYTHON"]
fn pymavlink_flies() {
    run("pymavlink_flight.py", &["pymavlink"], "tcp:", 5);
}

#[test]
#[ignore = "needs SORTIE_PYTHON"]
fn pymavlink_reads_and_sets_parameters() {
    run("pymavlink_parameters.py", &["pymavlink"], "tcp:", 5);
}

#[test]
#[ignore = "needs SORTIE_PYTHON"]
fn pymavlink_flies_a_mission() {
    run("pymavlink_mission.py", &["pymavlink"], "tcp:", 5);
}

#[test]
#[ignore = "needs SORTIE_PYTHON"]
fn pymavlink_is_held_by_a_fence() {
    run("pymavlink_fence.py", &["pymavlink"], "tcp:", 5);
}

#[test]
#[ignore = "needs SORTIE_PYTHON"]
fn pymavlink_lists_logs() {
    run("pymavlink_logs.py", &["pymavlink"], "tcp:", 5);
}

#[test]
#[ignore = "needs SORTIE_PYTHON"]
fn pymavlink_signs_its_link() {
    run("pymavlink_signing.py", &["pymavlink"], "tcp:", 1);
}

#[test]
#[ignore = "needs SORTIE_PYTHON"]
fn mavproxy_flies_from_its_command_line() {
    run("mavproxy_flight.py", &["MAVProxy"], "tcp:", 3);
}

#[test]
#[ignore = "needs SORTIE_PYTHON"]
fn dronekit_flies() {
    // DroneKit needs `past`, of the package future, without declaring it.
    run("dronekit_flight.py", &["dronekit", "past"], "tcp:", 5);
}

/// Runs a script for MAVSDK. Until version 3, the package now called `mavsdk_grpc` was called
/// `mavsdk`.
fn run_mavsdk(script: &str) {
    let modules: &[&str] = if has_modules(&interpreter(), &["mavsdk_grpc"]) {
        &["mavsdk_grpc"]
    } else {
        &["mavsdk", "mavsdk.action_pb2"]
    };
    run(script, modules, "tcpout://", 3);
}

#[test]
#[ignore = "needs SORTIE_PYTHON"]
fn mavsdk_flies() {
    run_mavsdk("mavsdk_flight.py");
}

#[test]
#[ignore = "needs SORTIE_PYTHON"]
fn mavsdk_flies_a_mission() {
    run_mavsdk("mavsdk_mission.py");
}
