use super::*;

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder")
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("readable").flatten();
    let mut names: Vec<String> = entries
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

#[cfg(unix)]
mod unix {
    use std::os::unix::fs::{PermissionsExt as _, symlink};
    use std::process::Command;
    use std::thread;

    use super::*;

    #[test]
    fn a_link_stays_and_its_target_keeps_its_mode() {
        let folder = folder();
        let (target, link) = (folder.path().join("target"), folder.path().join("link"));
        fs::write(&target, "old").expect("written");
        fs::set_permissions(&target, fs::Permissions::from_mode(0o640)).expect("ours");
        symlink("target", &link).expect("made");
        write(&link, "new", true).expect("written");
        assert!(link.is_symlink());
        assert_eq!(fs::read_to_string(&target).expect("readable"), "new");
        let mode = fs::metadata(&target).expect("there").permissions().mode();
        assert_eq!(mode & 0o777, 0o640);
        assert_eq!(names(folder.path()), ["link", "target"]);
    }

    #[test]
    fn results_are_for_their_trainee_alone_unless_a_group_may_read_them() {
        let folder = folder();
        for (readers, expected) in [(Readers::Owner, 0o600), (Readers::Group, 0o640)] {
            let path = folder.path().join(format!("{readers:?}"));
            write_output(&path, "text", readers).expect("written");
            let mode = fs::metadata(&path).expect("there").permissions().mode();
            assert_eq!(mode & 0o777, expected);
        }
    }

    /// Only the superuser can give a file away.
    #[test]
    fn a_file_that_is_replaced_keeps_its_owner() {
        use std::os::unix::fs::{MetadataExt as _, chown};

        let folder = folder();
        let path = folder.path().join("report");
        write(&path, "old", true).expect("written");
        if chown(&path, Some(12_345), Some(12_346)).is_err() {
            return;
        }
        write_output(&path, "new", Readers::Owner).expect("written");
        let found = fs::metadata(&path).expect("there");
        assert_eq!((found.uid(), found.gid()), (12_345, 12_346));
        assert_eq!(fs::read_to_string(&path).expect("readable"), "new");
    }

    #[test]
    fn a_link_to_a_file_that_is_not_there_yet_makes_it() {
        let folder = folder();
        let link = folder.path().join("link");
        symlink("target", &link).expect("made");
        write(&link, "new", false).expect("written");
        assert!(link.is_symlink());
        assert_eq!(fs::read_to_string(&link).expect("readable"), "new");
    }

    #[test]
    fn a_device_is_written_into() {
        let folder = folder();
        let link = folder.path().join("null");
        symlink("/dev/null", &link).expect("made");
        write(&link, "text", true).expect("it takes everything");
        assert!(link.is_symlink());
        assert_eq!(names(folder.path()), ["null"]);
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_device_that_is_full_is_an_error() {
        let folder = folder();
        let full = folder.path().join("full");
        symlink("/dev/full", &full).expect("made");
        let error = write(&full, "text", true).expect_err("it takes nothing");
        assert!(matches!(error, StoreError::Unwritable { .. }));
        assert_eq!(names(folder.path()), ["full"]);
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_file_in_memory_is_a_file() {
        let Ok(folder) = tempfile::tempdir_in("/dev/shm") else {
            return;
        };
        let path = folder.path().join("report");
        write(&path, "first", true).expect("written");
        write(&path, "again", true).expect("written");
        assert_eq!(fs::read_to_string(&path).expect("readable"), "again");
        write(&path, "not", false).expect_err("it is there");
    }

    #[test]
    fn a_link_to_a_link_leads_to_the_new_file() {
        let folder = folder();
        let (one, two) = (folder.path().join("one"), folder.path().join("two"));
        symlink("two", &one).expect("made");
        symlink("three", &two).expect("made");
        write(&one, "text", false).expect("written");
        assert_eq!(names(folder.path()), ["one", "three", "two"]);
    }

    #[test]
    fn a_fifo_without_a_reader_holds_up_nothing() {
        let folder = folder();
        let fifo = folder.path().join("fifo");
        let made = Command::new("mkfifo").arg(&fifo).status().expect("it runs");
        assert!(made.success());
        write(&fifo, "text", true).expect_err("nothing reads it");
    }

    #[test]
    fn the_reader_of_a_fifo_gets_the_text() {
        let folder = folder();
        let fifo = folder.path().join("fifo");
        let made = Command::new("mkfifo").arg(&fifo).status().expect("it runs");
        assert!(made.success());
        let reader = {
            let fifo = fifo.clone();
            thread::spawn(move || fs::read_to_string(fifo).expect("readable"))
        };
        // Without a reader, writing fails.
        while write(&fifo, "text", true).is_err() {
            thread::yield_now();
        }
        assert_eq!(reader.join().expect("it ends"), "text");
    }
}
