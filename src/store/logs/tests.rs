use super::*;
use crate::session::ListedLog;
use crate::wire::FtpChecksum;

fn log(size: u32) -> VehicleLog {
    let log = ListedLog {
        number: 2,
        size,
        time_utc_s: 1_767_225_645,
    };
    VehicleLog {
        vehicle: 3,
        log,
        folder: None,
    }
}

fn bytes(at: u32, len: usize) -> FileBytes {
    let bytes = (0..len).map(|it| (it + at as usize) as u8).collect();
    FileBytes { at, bytes }
}

#[test]
fn a_part_is_gone_on_with_and_becomes_the_file() {
    let data = tempfile::tempdir().expect("a folder");
    let folder = LogFolder::within(data.path());
    let log = log(2000);
    let kept = folder.find(&log).expect("it can be kept");
    assert_eq!(
        (kept.gaps.missing_bytes(), kept.samples, kept.file),
        (2000, Vec::new(), None)
    );
    let mut gaps = kept.gaps;
    for stretch in [bytes(0, 900), bytes(1000, 500)] {
        gaps.fill(stretch.range());
        folder.keep(&log, &[stretch], &gaps).expect("written");
    }
    let again = folder.find(&log).expect("it can be kept");
    assert_eq!(again.gaps.missing(), [900..1000, 1500..2000]);
    // The end of each stored range, the last one first.
    assert_eq!(again.samples, [bytes(1000, 500), bytes(180, 720)]);
    let rest = [bytes(900, 100), bytes(1500, 500)];
    for stretch in &rest {
        gaps.fill(stretch.range());
    }
    folder.keep(&log, &rest, &gaps).expect("written");
    let mut sum = FtpChecksum::default();
    sum.add(&bytes(0, 2000).bytes);
    assert_eq!(folder.checksum(&log), Ok(sum.value()));
    let path = folder.finish(&log).expect("it is whole");
    assert!(
        path.ends_with("logs/v3-log2-2026-01-01T00-00-45Z.bin"),
        "{path}"
    );
    assert_eq!(fs::read(&path).expect("there"), bytes(0, 2000).bytes);
    let known = folder.find(&log).expect("it can be kept");
    assert!(known.gaps.is_complete());
    assert_eq!(
        (known.file, known.samples),
        (Some(path), vec![bytes(1280, 720)])
    );
    assert_eq!(
        fs::read_dir(data.path().join("logs"))
            .expect("there")
            .count(),
        1
    );
}

#[test]
fn a_file_that_is_too_short_gets_no_name_and_another_log_no_ones_place() {
    let data = tempfile::tempdir().expect("a folder");
    let folder = LogFolder::within(data.path());
    let log = log(100);
    folder.find(&log).expect("it can be kept");
    let mut gaps = GapMap::new(100);
    gaps.fill(0..50);
    folder.keep(&log, &[bytes(0, 50)], &gaps).expect("written");
    folder.finish(&log).expect_err("half is missing");
    for expected in ["45Z.bin", "45Z-2.bin"] {
        gaps.fill(0..100);
        folder.keep(&log, &[bytes(0, 100)], &gaps).expect("written");
        let path = folder.finish(&log).expect("it is whole");
        assert!(path.ends_with(expected), "{path}");
    }
}

#[test]
fn a_part_with_a_gap_in_the_common_header_is_compared_behind_it() {
    let data = tempfile::tempdir().expect("a folder");
    let folder = LogFolder::within(data.path());
    let log = log(50_000);
    folder.find(&log).expect("it can be kept");
    let mut gaps = GapMap::new(50_000);
    for stretch in [bytes(0, 90), bytes(180, 39_820)] {
        gaps.fill(stretch.range());
        folder.keep(&log, &[stretch], &gaps).expect("written");
    }
    let known = folder.find(&log).expect("it can be kept");
    assert_eq!(known.gaps.missing(), [90..180, 40_000..50_000]);
    assert_eq!(known.samples, [bytes(39_280, 720), bytes(0, 90)]);
}

#[test]
fn links_and_fifos_in_place_of_a_part_are_refused() {
    let data = tempfile::tempdir().expect("a folder");
    let folder = LogFolder::within(data.path());
    let logs = data.path().join("logs");
    fs::create_dir(&logs).expect("made");
    for name in ["v3-log2.bin.part", "v3-log2.bin.gaps"] {
        let path = logs.join(name);
        nix::unistd::mkfifo(&path, nix::sys::stat::Mode::S_IRWXU).expect("made");
        let fault = folder.find(&log(100)).expect_err("a FIFO");
        assert!(fault.to_string().contains("regular file"), "{fault}");
        fs::remove_file(&path).expect("removed");
        std::os::unix::fs::symlink("elsewhere", &path).expect("made");
        folder.find(&log(100)).expect_err("a link");
        fs::remove_file(&path).expect("removed");
    }
    folder.find(&log(100)).expect("it can be kept");
}

#[test]
fn a_folder_that_the_user_names_keeps_its_mode() {
    use std::os::unix::fs::PermissionsExt as _;

    let data = tempfile::tempdir().expect("a folder");
    let shared = fs::Permissions::from_mode(0o2750);
    fs::set_permissions(data.path(), shared).expect("ours");
    let named = data.path().join("named");
    fs::create_dir(&named).expect("made");
    fs::set_permissions(&named, fs::Permissions::from_mode(0o700)).expect("ours");
    let folder = LogFolder::within(data.path());
    let log = VehicleLog {
        folder: Some(named.display().to_string()),
        ..log(100)
    };
    folder.find(&log).expect("it can be kept");
    let mode = fs::metadata(&named).expect("there").permissions().mode();
    assert_eq!(mode & 0o7777, 0o700);
}

#[test]
fn gaps_that_make_no_sense_are_left_alone() {
    let data = tempfile::tempdir().expect("a folder");
    let folder = LogFolder::within(data.path());
    let log = log(100);
    folder.find(&log).expect("it can be kept");
    let mut gaps = GapMap::new(100);
    gaps.fill(0..50);
    folder.keep(&log, &[bytes(0, 50)], &gaps).expect("written");
    let path = data.path().join("logs/v3-log2.bin.gaps");
    for text in [
        "",
        "bytes 100\n50",
        "bytes 100\n70-60\n",
        "bytes 200\n50-200\n",
        "\u{fffd}",
    ] {
        fs::write(&path, text).expect("written");
        let kept = folder.find(&log).expect("it can be kept");
        assert_eq!(kept.gaps, GapMap::new(100), "{text:?}");
    }
}
