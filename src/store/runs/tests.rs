use std::os::unix::fs::PermissionsExt as _;
use std::time::Duration;

use std::fs::OpenOptions;

use super::*;

const HEAD: &str = "{\"sortie_run\":1,\"mission\":\"01-a\",\"revision\":2,\"seed\":5,\"attempt\":1,\
    \"backend\":\"embedded\",\"when\":\"2026-11-20T14:03:22Z\",\"program\":\"0\",\"source\":\"\"}\n";
const END: &str = "{\"end\":{\"t\":100,\"end\":{\"score\":812,\"medal\":\"silver\",\"passed\":true,\
    \"sim_time_s\":0.1}}}\n";

#[test]
fn a_run_that_is_still_flown_is_no_try_yet() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let runs = Runs::within(&folder.path().join("data"));
    let mut run = runs.begin("01-a", "2026-11-20T14:03:22Z").expect("created");
    run.append(HEAD).expect("written");
    assert_eq!(runs.all_tries(None).get("01-a"), None);
    run.append(END).expect("written");
    assert_eq!(runs.all_tries(None)["01-a"].len(), 1, "it has ended");
    let mut left = runs.begin("01-a", "2026-11-20T14:04:22Z").expect("created");
    left.append(HEAD).expect("written");
    drop(left);
    assert_eq!(runs.all_tries(None)["01-a"].len(), 2, "its console is gone");
}

#[test]
fn a_flight_in_which_a_situation_was_recalled_is_practice() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let runs = Runs::within(&folder.path().join("data"));
    let mut run = runs.begin("01-a", "2026-11-20T14:03:22Z").expect("created");
    let graded = HEAD.replace("\"source\"", "\"stake\":\"graded\",\"source\"");
    run.append(&graded).expect("written");
    let stake = |path: &Path| outline(path).expect("readable").0.stake;
    assert_ne!(stake(run.path()), Stake::Practice);
    run.append("\"recall\"\n").expect("written");
    assert_eq!(stake(run.path()), Stake::Practice);
}

#[test]
fn the_tries_at_a_mission_are_told_by_first_and_last_lines() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let runs = Runs::within(&folder.path().join("data"));
    assert!(runs.tries_at(None, "01-a", 1).is_empty() && runs.newest().is_none());
    for end in [END, "{\"tick\":{\"t\":"] {
        let mut run = runs.begin("01-a", "2026-11-20T14:03:22Z").expect("created");
        run.append(HEAD).expect("written");
        run.append(end).expect("written");
    }
    let all = runs.all_tries(None);
    assert_eq!(all.keys().collect::<Vec<_>>(), ["01-a"]);
    assert_eq!(all["01-a"], runs.tries_at(None, "01-a", 2));
    assert!(
        runs.tries_at(None, "01-a", 1).is_empty(),
        "another revision"
    );
    assert!(
        runs.tries_at(Some("Anna"), "01-a", 2).is_empty(),
        "nobody's"
    );
    let run = runs.begin("01-b", "2026-11-20T14:03:23Z").expect("created");
    let mode = fs::metadata(run.path())
        .expect("there")
        .permissions()
        .mode();
    assert_eq!(mode & 0o777, 0o600);
    assert_eq!(runs.newest().as_deref(), Some(run.path()));
    let tries = runs.tries_at(None, "01-a", 2);
    let scores: Vec<Option<u16>> = tries.iter().map(|one| one.score).collect();
    assert_eq!(scores, [Some(812), None]);
    assert_eq!(
        (tries[0].seed, tries[0].revision, tries[0].passed),
        (5, 2, true)
    );
}

/// The program's folder, with foreign files in it.
fn shared() -> (tempfile::TempDir, Runs) {
    let data = tempfile::tempdir().expect("a temporary folder");
    let runs = Runs::within(data.path());
    fs::create_dir(runs.folder()).expect("created");
    for name in FOREIGN {
        fs::write(runs.folder().join(name), "mine").expect("written");
    }
    (data, runs)
}

/// Files that do not have the name of a run.
const FOREIGN: [&str; 4] = [
    "0000.run.jsonl",
    "2026-11-20T14-03-22Z.run.jsonl",
    "2026-11-2xT14-03-22Z_01-a_1-00.run.jsonl",
    "2026-11-20T14-03-22Z_01-a_1-00.run.jsonl.gz",
];

fn begin(runs: &Runs, number: usize) -> RunFile {
    let when = format!("2026-11-20T14:{:02}:{:02}Z", number / 60, number % 60);
    runs.begin("01-a", &when).expect("created")
}

#[test]
fn the_oldest_runs_make_room_and_nothing_foreign_does() {
    let (_data, runs) = shared();
    for number in 0..RUNS_KEPT + 5 {
        drop(begin(&runs, number));
    }
    assert_eq!(runs.files().len(), RUNS_KEPT);
    assert!(runs.files()[0].to_string_lossy().contains("14-00-05Z"));
    assert!(
        FOREIGN
            .iter()
            .all(|name| runs.folder().join(name).is_file())
    );
}

#[test]
fn large_runs_make_room_by_their_age_but_the_newest_stays_whatever_its_size() {
    let (_data, runs) = shared();
    let half = BYTES_KEPT / 2;
    // Each row: the length of a run, and the number of runs left when the next one begins.
    for (number, (len, left)) in [(half, 1), (half, 2), (1, 2), (2 * BYTES_KEPT, 1), (1, 1)]
        .into_iter()
        .enumerate()
    {
        let run = begin(&runs, number);
        let file = OpenOptions::new().append(true).open(run.path());
        file.and_then(|it| it.set_len(len))
            .expect("a file with a hole");
        runs.make_room();
        assert_eq!(runs.files().len(), left, "{number}");
        assert_eq!(runs.newest().as_deref(), Some(run.path()), "{number}");
    }
}

#[test]
fn in_a_folder_of_somebodys_own_nothing_makes_room() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let runs = Runs::at(folder.path());
    for number in 0..RUNS_KEPT + 5 {
        drop(begin(&runs, number));
    }
    assert_eq!(runs.files().len(), RUNS_KEPT + 5);
}

#[test]
fn a_run_of_which_nothing_could_be_written_leaves_no_file() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut run = begin(&Runs::at(folder.path()), 0);
    run.file.make_read_only();
    let error = run.append(HEAD).expect_err("it takes nothing").to_string();
    assert!(error.contains(&run.path().display().to_string()), "{error}");
    assert!(!run.path().exists());
}

#[test]
fn a_time_of_day_is_written_in_utc() {
    for (seconds, expected) in [
        (0, "1970-01-01T00:00:00Z"),
        (951_782_400, "2000-02-29T00:00:00Z"),
        (1_795_183_402, "2026-11-20T14:03:22Z"),
        (4_107_542_399, "2100-02-28T23:59:59Z"),
        (4_107_542_400, "2100-03-01T00:00:00Z"),
    ] {
        let time = UNIX_EPOCH + Duration::from_secs(seconds);
        assert_eq!(utc(time), expected);
    }
}

#[test]
fn a_folder_that_cannot_be_made_is_an_error_and_nothing_worse() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("file");
    fs::write(&file, "x").expect("written");
    assert!(Runs::at(file.join("runs")).begin("01-a", "x").is_err());
    assert!(Runs::at(&file).tries_at(None, "01-a", 1).is_empty());
}
