//! Data folders that are missing or closed, and exports to streams.

use std::fs;
use std::io::Read as _;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::sync::mpsc;
use std::thread;

use nix::unistd::Uid;

use super::{run, said};

const TLOG: &str = "tests/data/recordings/flight.tlog";

fn out(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn a_data_folder_that_is_missing_is_named_and_not_created() {
    let home = tempfile::tempdir().expect("a temporary folder");
    let data = home.path().join("nowhere");
    let named = data.to_string_lossy().into_owned();
    // Also with shared results, which would need the folder.
    let shared = home.path().join("shared.toml");
    fs::write(&shared, "[results]\nreaders = \"group\"\n").expect("written");
    let shared = shared.to_string_lossy().into_owned();
    for line in [
        &["records", "list"][..],
        &["records", "show", "1"],
        &["records", "delete", "1"],
        &["debrief"],
        &["replay", "1"],
        &["report"],
        &["profile", "list"],
        &["profile", "show"],
    ] {
        for more in [&[][..], &["--config", &shared]] {
            let line = [line, &["--data", &named], more].concat();
            let refused = run(home.path(), "", &line);
            assert_eq!(
                refused.status.code(),
                Some(1),
                "{line:?}: {}",
                out(&refused)
            );
            let fault = format!("no data folder {named}:");
            assert!(said(&refused).contains(&fault), "{}", said(&refused));
            assert!(!data.exists(), "{line:?}");
        }
    }
    for line in [&["config", "--paths"][..], &["doctor"]] {
        let line = [line, &["--data", &named, "--config", &shared]].concat();
        run(home.path(), "", &line);
        assert!(!data.exists(), "{line:?}");
    }
}

#[test]
fn the_default_data_folder_need_not_exist_to_be_read() {
    let home = tempfile::tempdir().expect("a temporary folder");
    let none = run(home.path(), "", &["records", "list"]);
    assert_eq!(none.status.code(), Some(0), "{}", said(&none));
    assert!(out(&none).contains("0 records"), "{}", out(&none));
    let none = run(home.path(), "", &["profile", "list"]);
    assert_eq!(none.status.code(), Some(0), "{}", said(&none));
    assert!(
        out(&none).contains("sortie profile create"),
        "{}",
        out(&none)
    );
    assert!(!home.path().join("sortie").exists());
    // A folder without records is no fault either.
    let named = home.path().to_string_lossy().into_owned();
    let none = run(home.path(), "", &["records", "list", "--data", &named]);
    assert!(out(&none).contains("0 records"), "{}", said(&none));
}

#[test]
fn records_that_cannot_be_read_are_a_fault() {
    let home = tempfile::tempdir().expect("a temporary folder");
    let file = home.path().join("file");
    fs::write(&file, "no folder").expect("written");
    let mut closed = vec![file];
    // Permissions do not restrict the superuser.
    if !Uid::effective().is_root() {
        use std::os::unix::fs::PermissionsExt as _;

        let folder = home.path().join("closed");
        fs::create_dir(&folder).expect("made");
        fs::set_permissions(&folder, fs::Permissions::from_mode(0o000)).expect("ours");
        closed.push(folder);
    }
    for folder in closed {
        let named = folder.to_string_lossy().into_owned();
        for line in [
            &["records", "list"][..],
            &["records", "show"],
            &["profile", "list"],
        ] {
            let refused = run(home.path(), "", &[line, &["--data", &named]].concat());
            assert_eq!(
                refused.status.code(),
                Some(1),
                "{line:?}: {}",
                out(&refused)
            );
            let fault = said(&refused);
            assert!(
                fault.contains(&named) && !fault.contains("store"),
                "{fault}"
            );
        }
    }
}

#[test]
fn an_export_to_a_stream_is_written_into_it_alone() {
    let home = tempfile::tempdir().expect("a temporary folder");
    for (format, expected) in [
        ("md", "# "),
        ("kml", "<?xml"),
        ("gpx", "<?xml"),
        ("geojson", "{"),
        ("mcap", "\u{fffd}MCAP0"),
    ] {
        let export = |to: &str| {
            let line = [
                "records", "export", TLOG, "--format", format, "--output", to,
            ];
            run(home.path(), "", &line)
        };
        let printed = export("-");
        assert_eq!(
            printed.status.code(),
            Some(0),
            "{format}: {}",
            said(&printed)
        );
        assert!(out(&printed).starts_with(expected), "{format}");
        assert!(!out(&printed).contains("written:"), "{format}");
        assert!(!Path::new("-").exists(), "{format}");
        let swallowed = export("/dev/null");
        assert_eq!(swallowed.status.code(), Some(0), "{}", said(&swallowed));
        let link = home.path().join(format!("link.{format}"));
        let target = home.path().join(format!("target.{format}"));
        std::os::unix::fs::symlink(&target, &link).expect("made");
        let linked = export(&link.to_string_lossy());
        assert_eq!(linked.status.code(), Some(0), "{}", said(&linked));
        assert!(link.is_symlink() && target.is_file(), "{format}");
        let again = export(&target.to_string_lossy());
        assert_eq!(
            again.status.code(),
            Some(1),
            "{format}: files are not replaced"
        );
        if format == "mcap" {
            let messages = mcap::MessageStream::new(&printed.stdout).expect("it is one");
            let file = fs::read(&target).expect("readable");
            let in_file = mcap::MessageStream::new(&file).expect("it is one");
            assert_eq!(messages.count(), in_file.count());
        } else {
            assert_eq!(
                printed.stdout,
                fs::read(&target).expect("readable"),
                "{format}"
            );
        }
    }
}

#[test]
fn the_reader_of_a_fifo_gets_an_export() {
    let home = tempfile::tempdir().expect("a temporary folder");
    let fifo = home.path().join("fifo");
    let made = Command::new("mkfifo").arg(&fifo).status().expect("it runs");
    assert!(made.success());
    // The FIFO is opened for reading and writing, so that the reader does not wait for a writer.
    let mut reader = Command::new("bash")
        .args(["-c", "exec 3<>\"$1\"; echo; exec cat <&3", "bash"])
        .arg(&fifo)
        .stdout(Stdio::piped())
        .spawn()
        .expect("it runs");
    let mut from = reader.stdout.take().expect("piped");
    let mut ready = [0];
    from.read_exact(&mut ready).expect("it is open");
    let (sender, begun) = mpsc::channel();
    let drain = thread::spawn(move || {
        let mut start = [0; 5];
        from.read_exact(&mut start).expect("written");
        sender.send(start).expect("awaited");
        // The remaining output must not hold up the program.
        drop(std::io::copy(&mut from, &mut std::io::sink()));
    });
    let to = fifo.to_string_lossy().into_owned();
    let line = [
        "records", "export", TLOG, "--format", "kml", "--output", &to,
    ];
    let written = run(home.path(), "", &line);
    assert_eq!(written.status.code(), Some(0), "{}", said(&written));
    // The reader may be slower than the program, which fills the pipe and ends.
    assert_eq!(&begun.recv().expect("it begins"), b"<?xml");
    reader.kill().expect("ours");
    reader.wait().expect("it ends");
    drain.join().expect("it ends");
}

#[test]
fn tables_need_a_folder() {
    let home = tempfile::tempdir().expect("a temporary folder");
    for to in ["-", "/dev/null"] {
        let line = ["records", "export", TLOG, "--format", "csv", "--output", to];
        let refused = run(home.path(), "", &line);
        assert_eq!(refused.status.code(), Some(1), "{}", out(&refused));
        assert!(
            said(&refused).contains("name a new folder"),
            "{}",
            said(&refused)
        );
        assert!(!Path::new("-").exists());
    }
}
