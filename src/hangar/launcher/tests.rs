use std::ffi::OsString;
use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::os::unix::process::ExitStatusExt as _;
use std::path::Path;

use tokio::io::{AsyncBufReadExt as _, AsyncReadExt as _, BufReader};

use super::*;

const STUB: &str = "hangar::launcher::tests::this_program_becomes_another_when_it_is_told_to";

/// Not a real test: the tests below use it to start this program again, as a hangar starts `sortie`.
#[test]
fn this_program_becomes_another_when_it_is_told_to() {
    let mut words = std::env::args_os().skip_while(|word| word != "--");
    if words.next().is_some() {
        let words: Vec<OsString> = words.collect();
        std::process::exit(stub::run(&words).into());
    }
}

pub(in crate::hangar) fn launcher(limits: HangarLimits) -> Launcher {
    let me = std::env::current_exe().expect("this program has a path");
    let words = ["--exact", "--nocapture", STUB, "--"].map(OsString::from);
    let stub = [vec![me.into_os_string()], words.to_vec()].concat();
    Launcher::with_stub(stub, limits).expect("a thread")
}

fn order(program: impl AsRef<Path>, arguments: &[&str]) -> LaunchOrder {
    LaunchOrder {
        program: program.as_ref().to_owned(),
        arguments: arguments.iter().map(|&word| word.to_owned()).collect(),
        folder: std::env::temp_dir(),
    }
}

pub(in crate::hangar) fn shell(script: &str) -> LaunchOrder {
    order("/bin/sh", &["-c", script])
}

/// Starts a process. Also returns the launcher, because the process ends with it.
pub(in crate::hangar) async fn start(order: LaunchOrder) -> (Launcher, RunningProcess) {
    let launcher = launcher(HangarLimits::default());
    let running = launcher.launch(order).await.expect("it starts");
    (launcher, running)
}

async fn fault(order: LaunchOrder) -> LaunchError {
    let launcher = launcher(HangarLimits::default());
    loop {
        let fault = launcher.launch(order.clone()).await;
        let fault = fault.expect_err("it does not start");
        // A child of another test briefly holds the file that this one has just written.
        if !fault.may_pass() {
            return fault;
        }
    }
}

/// Waits for a line of the program that begins with a word, and returns the rest of the line.
async fn hear(running: &mut RunningProcess, word: &str) -> String {
    let (out, _) = running.take_output();
    let mut lines = BufReader::new(out.expect("a pipe")).lines();
    loop {
        let line = lines
            .next_line()
            .await
            .expect("readable")
            .expect("it says it");
        if let Some(rest) = line.strip_prefix(word) {
            return rest.trim().to_owned();
        }
    }
}

/// The ids of two processes, from lines that each begin with a word.
pub(in crate::hangar) async fn hear_two(
    running: &mut RunningProcess,
    one: &str,
    other: &str,
) -> (u32, u32) {
    let (out, _) = running.take_output();
    let mut lines = BufReader::new(out.expect("a pipe")).lines();
    let mut found = [None; 2];
    while found.contains(&None) {
        let line = lines
            .next_line()
            .await
            .expect("readable")
            .expect("it says it");
        for (found, word) in found.iter_mut().zip([one, other]) {
            let number = line
                .strip_prefix(word)
                .and_then(|rest| rest.trim().parse().ok());
            *found = found.or(number);
        }
    }
    let [Some(one), Some(other)] = found else {
        panic!("both were found")
    };
    (one, other)
}

fn is_alive(pid: &str) -> bool {
    let stat = fs::read_to_string(format!("/proc/{pid}/stat")).unwrap_or_default();
    let state = stat
        .rsplit(')')
        .next()
        .and_then(|rest| rest.trim().chars().next());
    state.is_some_and(|state| state != 'Z')
}

#[tokio::test]
async fn a_program_runs_in_its_folder_with_its_arguments_and_leads_a_group() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut order = shell("echo said $(pwd -P) $0 $(ulimit -v) $PPID; ps -o pgid= -p $$ 2>&1");
    order.arguments.push("word".to_owned());
    order.folder = folder.path().canonicalize().expect("it is there");
    let place = order.folder.display().to_string();
    let (_launcher, mut running) = start(order).await;
    let said = hear(&mut running, "said").await;
    let me = std::process::id();
    assert_eq!(said, format!("{place} word {} {me}", 1024 * 1024));
    assert!(running.wait().await.expect("it ends").success());
}

#[tokio::test]
async fn what_cannot_be_started_is_told_apart() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str, text: &str, mode: u32| {
        let path = folder.path().join(name);
        fs::write(&path, text).expect("writable");
        fs::set_permissions(&path, fs::Permissions::from_mode(mode)).expect("ours");
        path
    };
    let junk = file("junk", "this is no program\n", 0o755);
    let locked = file("locked", "#!/bin/sh\n", 0o644);
    let orphan = file("orphan", "#!/no/such/interpreter\n", 0o755);
    let missing = folder.path().join("missing");
    assert!(
        matches!(fault(order(&missing, &[])).await, LaunchError::NoProgram(path) if path == missing)
    );
    assert!(matches!(
        fault(order(&junk, &[])).await,
        LaunchError::NotAProgram(_)
    ));
    assert!(matches!(
        fault(order(&locked, &[])).await,
        LaunchError::NotAllowed(_)
    ));
    assert!(matches!(
        fault(order(&orphan, &[])).await,
        LaunchError::NoInterpreter(_)
    ));
    assert!(matches!(
        fault(order(folder.path(), &[])).await,
        LaunchError::Folder(_)
    ));
    let mut homeless = shell("true");
    homeless.folder = missing.clone();
    assert!(
        matches!(fault(homeless).await, LaunchError::NoFolder { folder, .. } if folder == missing)
    );
    let text = fault(order(&locked, &[])).await.to_string();
    assert!(
        text.contains("chmod +x") && text.contains("locked"),
        "{text}"
    );
}

#[tokio::test]
async fn a_missing_sortie_is_not_taken_for_a_missing_program() {
    let launcher =
        Launcher::start("/no/such/sortie".into(), HangarLimits::default()).expect("a thread");
    let fault = launcher
        .launch(shell("true"))
        .await
        .expect_err("it is not there");
    assert!(matches!(fault, LaunchError::Stub { .. }), "{fault}");
}

#[tokio::test]
async fn only_the_owner_s_own_children_become_programs() {
    let owner = (std::process::id() + 1).to_string();
    let words = [owner.as_str(), "1000000000", "/", "/bin/true"].map(OsString::from);
    assert_eq!(become_status(&words).await, Some(127));
    assert_eq!(become_status(&words[..2]).await, Some(127));
}

async fn become_status(words: &[OsString]) -> Option<i32> {
    let me = std::env::current_exe().expect("this program has a path");
    let output = Command::new(me)
        .args(["--exact", "--nocapture", STUB, "--"])
        .args(words)
        .stdin(Stdio::null())
        .output();
    output.await.expect("it runs").status.code()
}

#[tokio::test]
async fn a_program_that_ends_takes_its_group_with_it() {
    let (_launcher, mut running) = start(shell("sleep 1000 & echo child $!; exit 3")).await;
    let child = hear(&mut running, "child").await;
    assert_eq!(running.wait().await.expect("it ends").code(), Some(3));
    gone(&child).await;
}

#[tokio::test]
async fn one_that_ends_when_told_has_time_to_do_so() {
    let script = "trap 'exit 7' TERM; echo ready; while :; do sleep 0.01; done";
    let (_launcher, mut running) = start(shell(script)).await;
    hear(&mut running, "ready").await;
    assert_eq!(running.end().await.expect("it ends").code(), Some(7));
    // The second time, the status is already known.
    assert_eq!(running.end().await.expect("it has ended").code(), Some(7));
}

#[tokio::test]
async fn one_that_does_not_listen_is_killed_with_its_children() {
    let script = "trap '' TERM; sleep 1000 & echo child $!; while :; do wait; done";
    let (_launcher, mut running) = start(shell(script)).await;
    let child = hear(&mut running, "child").await;
    assert!(is_alive(&child));
    assert_eq!(running.end().await.expect("it ends").signal(), Some(9));
    gone(&child).await;
}

#[tokio::test]
async fn one_that_is_stopped_is_ended_as_well() {
    let (_launcher, mut running) = start(shell("echo ready; kill -STOP $$; sleep 1000")).await;
    hear(&mut running, "ready").await;
    let status = running.end().await.expect("it ends");
    assert!(matches!(status.signal(), Some(9 | 15)), "{status}");
}

#[tokio::test]
async fn one_whose_launcher_is_gone_is_killed() {
    let (launcher, mut running) = start(shell("trap '' TERM; exec sleep 1000")).await;
    drop(launcher);
    let status = running.wait().await.expect("it ends");
    assert_eq!(status.signal(), Some(9));
}

#[tokio::test]
async fn one_that_nobody_holds_any_more_is_killed() {
    let (_launcher, mut running) = start(shell("sleep 1000 & echo child $!; wait")).await;
    let child = hear(&mut running, "child").await;
    let pid = running.pid().to_string();
    drop(running);
    gone(&child).await;
    gone(&pid).await;
}

/// Waits until a killed process is gone, which depends on its new parent.
async fn gone(pid: &str) {
    while is_alive(pid) {
        tokio::task::yield_now().await;
    }
}

#[tokio::test]
async fn keys_in_the_environment_are_kept_from_the_program() {
    assert!(is_passed_on("PATH".as_ref()) && is_passed_on("LC_ALL".as_ref()));
    let (_launcher, mut running) = start(order("/usr/bin/env", &[])).await;
    let (out, _) = running.take_output();
    let mut text = String::new();
    out.expect("a pipe")
        .read_to_string(&mut text)
        .await
        .expect("readable");
    assert!(text.contains("PATH="), "{text}");
    // Cargo sets this for tests.
    assert!(
        std::env::var_os("CARGO_MANIFEST_DIR").is_some() && !text.contains("CARGO"),
        "{text}"
    );
}

#[tokio::test]
async fn nothing_of_the_hangar_is_open_in_the_program() {
    let all = |text: &str| -> Vec<String> {
        let lines = text.lines().skip_while(|line| *line != "0");
        lines.map(str::to_owned).collect()
    };
    // The inherited descriptors, and the one that `ls` opens.
    let usual = Command::new("/bin/ls").arg("/proc/self/fd").output();
    let usual = String::from_utf8(usual.await.expect("it runs").stdout).expect("numbers");
    let (_launcher, mut running) = start(order("/bin/ls", &["/proc/self/fd"])).await;
    let (out, _) = running.take_output();
    let mut text = String::new();
    out.expect("a pipe")
        .read_to_string(&mut text)
        .await
        .expect("readable");
    assert!(all(&usual).len() > 2);
    assert_eq!(all(&text), all(&usual));
    let (_launcher, mut running) = start(shell("echo in $(readlink /proc/$$/fd/0)")).await;
    assert_eq!(hear(&mut running, "in").await, "/dev/null");
}

#[tokio::test]
async fn a_launch_that_nobody_waits_for_leaves_nothing_behind() {
    let folder = tempfile::tempdir().expect("a folder");
    let launcher = launcher(HangarLimits::default());
    let mut order = shell("touch begun; sleep 1000");
    order.folder = folder.path().to_owned();
    let asked = launcher.launch(order);
    assert!(tokio::time::timeout(Duration::ZERO, asked).await.is_err());
    // The thread works in order, so when the next one runs, the first one has been skipped, or started and killed.
    let mut next = launcher.launch(shell("true")).await.expect("it starts");
    next.wait().await.expect("it ends");
}

#[tokio::test(start_paused = true)]
async fn the_queued_start_in_order_and_no_faster_than_allowed() {
    let pace = std::sync::Arc::new(LaunchPace::new(8));
    let begun = Instant::now();
    let (went, mut order) = tokio::sync::mpsc::unbounded_channel();
    for number in 0..32_u32 {
        let (pace, went) = (std::sync::Arc::clone(&pace), went.clone());
        tokio::spawn(async move {
            drop(pace.turn().await);
            went.send((number, begun.elapsed())).expect("it is read");
        });
        tokio::task::yield_now().await;
    }
    for number in 0..32 {
        let (who, at) = order.recv().await.expect("all go");
        assert_eq!(who, number);
        let due = Duration::from_millis(125) * number;
        assert!(
            at >= due && at < due + Duration::from_millis(40),
            "{number} went at {at:?}"
        );
    }
}

#[tokio::test(start_paused = true)]
async fn who_leaves_the_queue_costs_the_others_nothing() {
    let pace = LaunchPace::new(1);
    drop(pace.turn().await);
    let begun = Instant::now();
    assert!(
        tokio::time::timeout(Duration::from_millis(500), pace.turn())
            .await
            .is_err()
    );
    drop(pace.turn().await);
    assert!(begun.elapsed() < Duration::from_millis(1010));
}
