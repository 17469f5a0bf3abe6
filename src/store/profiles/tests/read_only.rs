//! Profiles in files and folders that are read-only or unreadable.

use super::*;

#[test]
fn profiles_that_may_not_be_written_are_read() {
    let data = tempfile::tempdir().expect("a folder");
    let profiles = open(data.path());
    profiles.create("anna", WHEN).expect("made");
    let path = profiles.path().to_owned();
    let names = |profiles: &Profiles| {
        let all = profiles.list().expect("readable").into_iter();
        all.map(|profile| profile.name).collect::<Vec<_>>()
    };
    // While a console has it open, and afterwards.
    let beside = Profiles::read_only(path.clone()).expect("readable");
    assert_eq!(names(&beside), ["anna"]);
    drop((beside, profiles));
    let alone = Profiles::read_only(path.clone()).expect("readable");
    assert_eq!(names(&alone), ["anna"]);
    assert!(alone.is_read_only());
    alone.create("bob", WHEN).expect_err("it is only read");
    let odd = data.path().join("a?b#c%20d");
    fs::copy(&path, &odd).expect("copied");
    assert_eq!(
        names(&Profiles::read_only(odd).expect("readable")),
        ["anna"]
    );
    let older = rusqlite::Connection::open(&path).expect("it opens");
    older.pragma_update(None, "user_version", 0).expect("set");
    drop(older);
    let refused = Profiles::read_only(path).expect_err("it cannot be brought up to date");
    assert!(matches!(refused, ProfileError::Older { .. }), "{refused}");
}

#[test]
fn a_missing_folder_is_read_as_empty_and_not_created() {
    let home = tempfile::tempdir().expect("a folder");
    let data = home.path().join("data");
    let (profiles, rescue) = Profiles::open_to_read(&data).expect("empty");
    assert!(profiles.is_read_only() && rescue.is_none());
    assert_eq!(profiles.list().expect("readable"), []);
    profiles.create("anna", WHEN).expect_err("it is only read");
    assert!(!data.exists());
}

#[test]
fn a_missing_file_is_read_as_empty_and_not_created() {
    let data = tempfile::tempdir().expect("a folder");
    let (profiles, rescue) = Profiles::open_to_read(data.path()).expect("empty");
    assert!(profiles.is_read_only() && rescue.is_none());
    assert_eq!(profiles.list().expect("readable"), []);
    assert_eq!(fs::read_dir(data.path()).expect("readable").count(), 0);
}

#[test]
fn a_folder_that_cannot_be_read_is_named_as_such() {
    let folder = tempfile::tempdir().expect("a folder");
    let data = folder.path().join("file");
    fs::write(&data, "no folder").expect("writable");
    let refused = Profiles::open_to_read(&data).expect_err("no folder");
    assert!(
        matches!(refused, ProfileError::Unreadable { .. }),
        "{refused}"
    );
    assert!(
        refused.to_string().contains("cannot read the profiles"),
        "{refused}"
    );
}

/// `SQLite` must write its log to the folder, although the file itself is writable.
#[test]
fn a_file_in_a_folder_that_cannot_be_written_is_read() {
    use std::os::unix::fs::PermissionsExt as _;

    // Permissions do not restrict the superuser.
    if nix::unistd::geteuid().is_root() {
        return;
    }
    let data = tempfile::tempdir().expect("a folder");
    open(data.path()).create("anna", WHEN).expect("made");
    let mode = |mode| fs::set_permissions(data.path(), fs::Permissions::from_mode(mode));
    mode(0o550).expect("ours");
    let opened = Profiles::open(data.path());
    mode(0o700).expect("ours");
    let (profiles, _) = opened.expect("readable");
    profiles.require_writable().expect_err("it is only read");
    assert_eq!(profiles.list().expect("readable").len(), 1);
}
