use std::fs::{FileTimes, Permissions};
use std::os::unix::fs::symlink;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, SystemTime};

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use tempfile::TempDir;

use super::*;
use crate::hangar::launcher::tests as launcher;

/// A process that ends with the test.
struct Sleeper(Child);

impl Sleeper {
    fn start(script: &str) -> Self {
        let mut shell = Command::new("/bin/sh");
        shell
            .args(["-c", script])
            .stdin(Stdio::null())
            .stdout(Stdio::null());
        let child = shell.spawn().expect("it starts");
        // Until the child becomes a shell, it is a copy of this program.
        while process::executable(child.id()) == process::executable(std::process::id()) {
            std::thread::yield_now();
        }
        Self(child)
    }

    fn pid(&self) -> u32 {
        self.0.id()
    }

    fn is_running(&mut self) -> bool {
        self.0.try_wait().expect("ours").is_none()
    }
}

impl Drop for Sleeper {
    fn drop(&mut self) {
        self.0.kill().ok();
        self.0.wait().ok();
    }
}

fn root() -> TempDir {
    tempfile::tempdir().expect("a folder")
}

fn open(root: &TempDir) -> OpenedFolder {
    Run::open(root.path()).expect("it opens")
}

fn names(root: &TempDir) -> Vec<String> {
    let entries = fs::read_dir(root.path()).expect("readable").flatten();
    let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
    let mut names: Vec<String> = names.filter(|name| name.starts_with(RUN)).collect();
    names.sort();
    names
}

fn mode(path: &Path) -> u32 {
    fs::metadata(path).expect("there").permissions().mode() & 0o777
}

#[test]
fn folders_are_for_this_user_alone() {
    let parent = root();
    let root = parent.path().join("a/b");
    let run = Run::open(&root).expect("it opens").run;
    let vehicle = run.vehicle(3).expect("it is made");
    assert_eq!(vehicle, run.path().join("vehicle-003"));
    assert_eq!(vehicle, run.vehicle(3).expect("it is there"));
    for folder in [&root, run.path(), &vehicle] {
        assert_eq!(mode(folder), 0o700, "{}", folder.display());
    }
    assert_eq!(mode(&run.path().join(OWNER)), 0o600);
    let owner = fs::read(run.path().join(OWNER)).expect("readable");
    let owner: serde_json::Value = serde_json::from_slice(&owner).expect("JSON");
    assert_eq!(owner["pid"], std::process::id());
}

#[tokio::test]
async fn what_a_hangar_that_is_gone_has_left_is_found_and_ended() {
    let root = root();
    let mut ends = Sleeper::start("while :; do sleep 0.01; done");
    let mut stopped = Sleeper::start("trap '' TERM; kill -STOP $$; while :; do sleep 0.01; done");
    let run = open(&root).run;
    run.note(1, ends.pid(), Path::new("/opt/arducopter"))
        .expect("written");
    run.note(2, stopped.pid(), Path::new("/opt/arducopter"))
        .expect("written");
    let at = run.path().to_owned();
    drop(run);
    let mut opened = open(&root);
    assert_eq!(opened.skipped, Vec::<String>::new());
    let found: Vec<_> = opened
        .leftovers
        .iter()
        .map(|left| (left.pid, left.ended))
        .collect();
    assert_eq!(found, [(ends.pid(), false), (stopped.pid(), false)]);
    assert_eq!(opened.leftovers[0].program, "/opt/arducopter");
    assert_eq!(
        opened.leftovers[0].folder,
        at.join("vehicle-001").display().to_string()
    );
    end(&mut opened.leftovers).await;
    assert!(opened.leftovers.iter().all(|left| left.ended));
    assert!(!ends.is_running() && !stopped.is_running());
    drop(opened);
    assert_eq!(open(&root).leftovers, []);
}

#[test]
fn what_a_living_hangar_runs_is_left_alone() {
    let root = root();
    let mut sleeper = Sleeper::start("while :; do sleep 0.1; done");
    let first = open(&root).run;
    first
        .note(1, sleeper.pid(), Path::new("/opt/arducopter"))
        .expect("written");
    let second = open(&root);
    assert_eq!(second.leftovers, []);
    assert!(sleeper.is_running());
    assert_ne!(first.path(), second.run.path());
    first.forget(1);
    drop(first);
    assert_eq!(open(&root).leftovers, []);
}

#[test]
fn a_clean_end_leaves_nothing_but_the_files_of_instances() {
    let root = root();
    let run = open(&root).run;
    drop(run);
    assert_eq!(names(&root), [""; 0]);
    let run = open(&root).run;
    let (path, vehicle) = (run.path().to_owned(), run.vehicle(1).expect("made"));
    fs::write(vehicle.join("00000001.BIN"), "log").expect("writable");
    drop(run);
    assert!(vehicle.join("00000001.BIN").is_file() && !path.join(OWNER).exists());
    // A process that is still recorded belongs to a hangar that the next one has to know.
    let mut sleeper = Sleeper::start("while :; do sleep 0.1; done");
    let run = open(&root).run;
    let path = run.path().to_owned();
    run.note(1, sleeper.pid(), Path::new("/opt/arducopter"))
        .expect("written");
    drop(run);
    assert!(path.join(OWNER).is_file() && sleeper.is_running());
    assert_eq!(open(&root).leftovers.len(), 1);
}

#[test]
fn another_process_with_the_same_number_is_no_leftover() {
    let root = root();
    let mut sleeper = Sleeper::start("while :; do sleep 0.1; done");
    let run = open(&root).run;
    let change = |id: InstanceId, change: &dyn Fn(&mut serde_json::Value)| {
        run.note(id, sleeper.pid(), Path::new("/opt/arducopter"))
            .expect("written");
        let path = run.vehicle(id).expect("there").join(INSTANCE);
        let text = fs::read(&path).expect("readable");
        let mut record = serde_json::from_slice(&text).expect("JSON");
        change(&mut record);
        fs::write(path, record.to_string()).expect("writable");
    };
    change(1, &|record| record["process"]["started"] = 1.into());
    change(2, &|record| record["process"]["boot"] = "another".into());
    change(3, &|record| {
        record["process"]["namespace"] = "pid:[1]".into();
    });
    change(4, &|record| record["executable"] = "/opt/arducopter".into());
    change(5, &|record| record["process"]["pid"] = 0.into());
    drop(run);
    assert_eq!(open(&root).leftovers, []);
    assert!(sleeper.is_running());
}

#[test]
fn files_that_make_no_sense_are_named_and_harm_nothing() {
    let root = root();
    let run = open(&root).run;
    let file = |id: InstanceId| run.vehicle(id).expect("made").join(INSTANCE);
    fs::write(file(1), "{\"process\": 7").expect("writable");
    fs::write(file(2), [0xff; 9]).expect("writable");
    symlink("/dev/zero", file(3)).expect("a link");
    fs::create_dir(file(4)).expect("made");
    fs::write(file(5), vec![b' '; 100_000]).expect("writable");
    drop(run);
    let opened = open(&root);
    assert_eq!(
        (opened.leftovers.len(), opened.skipped.len()),
        (0, 5),
        "{:?}",
        opened.skipped
    );
    assert!(opened.skipped[0].contains("vehicle-001/instance.json"));
}

#[test]
fn only_the_last_five_runs_are_kept() {
    let root = root();
    for age in 1..=8_u64 {
        let run = root.path().join(format!("run-{}-0", 1000 + age));
        fs::create_dir_all(run.join("vehicle-001")).expect("made");
        let owner = File::create(run.join(OWNER)).expect("made");
        let began = SystemTime::now() - Duration::from_secs(3600 * age);
        owner
            .set_times(FileTimes::new().set_modified(began))
            .expect("ours");
    }
    let living = open(&root);
    let me = std::process::id();
    let mine = format!("run-{me}-0");
    let kept = [
        "run-1001-0",
        "run-1002-0",
        "run-1003-0",
        "run-1004-0",
        "run-1005-0",
    ];
    let mut expected: Vec<String> = kept.iter().map(|&name| name.to_owned()).collect();
    expected.push(mine.clone());
    expected.sort();
    assert_eq!(names(&root), expected);
    // All owners live, so no run is removed.
    let more: Vec<OpenedFolder> = (0..7).map(|_| open(&root)).collect();
    assert_eq!(names(&root).len(), 13);
    assert!(names(&root).contains(&mine));
    drop((living, more));
}

#[test]
fn what_is_no_run_is_never_removed() {
    let root = root();
    let elsewhere = self::root();
    for number in 0..9 {
        fs::create_dir(root.path().join(format!("run-{number}"))).expect("made");
        symlink(
            elsewhere.path(),
            root.path().join(format!("run-{number}-0")),
        )
        .expect("a link");
    }
    drop(open(&root));
    drop(open(&root));
    assert_eq!(names(&root).len(), 18);
    assert!(elsewhere.path().is_dir());
}

#[test]
fn a_folder_that_cannot_be_used_is_named_with_a_way_out() {
    let root = root();
    let file = root.path().join("file");
    fs::write(&file, "").expect("writable");
    let error = Run::open(&file).expect_err("it is a file").to_string();
    assert!(
        error.contains(&file.display().to_string()) && error.contains("in the way"),
        "{error}"
    );
    let error = Run::open(Path::new("/proc/none"))
        .expect_err("nobody can")
        .to_string();
    assert!(
        error.contains("/proc/none") && error.contains("choose a folder"),
        "{error}"
    );
    let open_to_all = root.path().join("shared");
    fs::create_dir(&open_to_all).expect("made");
    fs::set_permissions(&open_to_all, Permissions::from_mode(0o777)).expect("ours");
    let error = Run::open(&open_to_all)
        .expect_err("others may write")
        .to_string();
    assert!(error.contains("chmod go-w"), "{error}");
    let full = io::Error::from_raw_os_error(nix::libc::ENOSPC);
    assert!(
        cannot("write the file", &file)(full)
            .to_string()
            .contains("make room")
    );
}

#[tokio::test]
async fn what_a_leftover_has_started_is_found_when_the_leftover_itself_is_gone() {
    let root = root();
    let run = open(&root).run;
    let folder = run.vehicle(1).expect("made");
    let mut order = launcher::shell("sleep 1000 & echo child $!; read line < never");
    order.folder.clone_from(&folder);
    // A process of the session that has left the folder does not count as one of the instance. It prints its number
    // once it has left.
    order.arguments[1].insert_str(
        0,
        "(cd / && exec sh -c 'echo other $$; exec sleep 1000') & ",
    );
    nix::unistd::mkfifo(&folder.join("never"), nix::sys::stat::Mode::S_IRWXU).expect("made");
    let (_launcher, mut running) = launcher::start(order).await;
    run.note(1, running.pid(), Path::new("/bin/sh"))
        .expect("written");
    let (other, child) = launcher::hear_two(&mut running, "other", "child").await;
    let pid = Pid::from_raw(running.pid() as i32);
    kill(pid, Signal::SIGKILL).expect("ours");
    let leader = running.pid();
    while process::identity(leader).is_some() {
        tokio::task::yield_now().await;
    }
    drop(run);
    let mut opened = open(&root);
    let found: Vec<u32> = opened.leftovers.iter().map(|left| left.pid).collect();
    assert_eq!(found, [child]);
    end(&mut opened.leftovers).await;
    assert!(opened.leftovers[0].ended && process::identity(other).is_some());
    running.end().await.expect("it has ended");
}

#[test]
fn a_fault_is_told_once_also_with_all_its_causes() {
    let file = tempfile::NamedTempFile::new().expect("a temporary file");
    let fault = Run::open(file.path()).expect_err("a file is in the way");
    assert!(
        fault.to_string().contains("a file is in the way"),
        "{fault}"
    );
    assert!(std::error::Error::source(&fault).is_none());
}
