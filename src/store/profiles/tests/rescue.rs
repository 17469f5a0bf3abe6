//! Damage, and its repair.

use std::fs;
use std::path::{Path, PathBuf};

use rusqlite::Connection;

use super::super::rescue::back_up;
use super::{Profiles, anna, open, run};
use crate::store::MendedRows;
use crate::workshop::{Design, part};

/// A folder with Anna's flights and a backup, and the path of its closed database.
fn folder_with_copy(flights: u32) -> (tempfile::TempDir, PathBuf) {
    let data = tempfile::tempdir().expect("a folder");
    let mut profiles = open(data.path());
    let anna = anna(&profiles);
    for number in 0..flights {
        profiles
            .store(&anna, &run(&format!("{number}"), "one", 800))
            .expect("stored");
    }
    profiles.back_up().expect("copied");
    let file = profiles.path().to_owned();
    (data, file)
}

fn flights(profiles: &Profiles) -> usize {
    let anna = profiles.find("Anna").expect("restored");
    profiles.history(&anna).expect("readable").len()
}

/// The number of files in the folder whose names contain `part`.
fn files(data: &Path, part: &str) -> usize {
    let files = fs::read_dir(data).expect("there").flatten();
    files
        .filter(|file| file.file_name().to_string_lossy().contains(part))
        .count()
}

fn spoil_the_middle(file: &Path) {
    let mut bytes = fs::read(file).expect("readable");
    let middle = bytes.len() / 2;
    bytes[middle..middle + 8192].fill(0x55);
    fs::write(file, bytes).expect("writable");
}

#[test]
fn a_damaged_file_is_set_aside_and_the_last_copy_takes_its_place() {
    let data = tempfile::tempdir().expect("a folder");
    let file = data.path().join("profiles.sqlite");
    {
        let mut profiles = open(data.path());
        let anna = anna(&profiles);
        profiles
            .store(&anna, &run("a", "one", 800))
            .expect("stored");
        profiles.back_up().expect("copied");
    }
    fs::write(&file, "this was a database").expect("writable");
    let (profiles, rescue) = Profiles::open(data.path()).expect("restored");
    let rescue = rescue.expect("it was damaged");
    assert_eq!(
        fs::read(&rescue.damaged).expect("kept"),
        b"this was a database"
    );
    assert!(rescue.copy.is_some());
    let anna = profiles.find("Anna").expect("restored");
    assert_eq!(profiles.history(&anna).expect("readable").len(), 1);
}

#[test]
fn damage_in_the_middle_is_found_and_without_a_copy_it_begins_anew() {
    let data = tempfile::tempdir().expect("a folder");
    let file = data.path().join("profiles.sqlite");
    {
        let mut profiles = open(data.path());
        let anna = anna(&profiles);
        for number in 0..40 {
            profiles
                .store(&anna, &run(&format!("{number}"), "one", 800))
                .expect("stored");
        }
    }
    spoil_the_middle(&file);
    let (profiles, rescue) = Profiles::open(data.path()).expect("anew");
    let rescue = rescue.expect("it was damaged");
    assert_eq!(rescue.copy, None);
    assert!(rescue.text().to_string().contains("damaged-"));
    assert_eq!(profiles.list().expect("readable"), []);
}

/// Replaces one byte in the document of a flight with invalid UTF-8.
fn rot(file: &Path) {
    let mut bytes = fs::read(file).expect("readable");
    let document = b"\"mission\":\"one\"";
    let mut places = bytes.windows(document.len());
    let at = places.position(|it| it == document).expect("it is there");
    bytes[at + document.len() - 2] = 0xFF;
    fs::write(file, bytes).expect("writable");
}

#[test]
fn a_rotten_byte_in_a_flight_is_healed_from_the_copy_and_nothing_newer_is_lost() {
    let (data, file) = folder_with_copy(3);
    let mut profiles = open(data.path());
    let anna = profiles.find("Anna").expect("she is there");
    let newer = run("newer", "two", 700);
    profiles.store(&anna, &newer).expect("stored");
    drop(profiles);
    rot(&file);
    let (mut profiles, rescue) = Profiles::open(data.path()).expect("it opens");
    assert_eq!(rescue, None, "the file stays");
    let mended = profiles.mend().expect("writable");
    let (restored, lost) = (1, 0);
    assert_eq!(mended, MendedRows::Damaged { restored, lost });
    let said = mended.text().expect("a row was damaged").to_string();
    assert!(said.contains("1 damaged"), "{said}");
    assert_eq!(flights(&profiles), 4);
    assert_eq!(profiles.mend().expect("readable"), MendedRows::Sound);
}

#[test]
fn flights_and_designs_that_are_sound_are_left_alone() {
    let (data, _) = folder_with_copy(2);
    let profiles = open(data.path());
    let anna = profiles.find("Anna").expect("she is there");
    let design = Design::new("Scout").with(part("fr_5q_226").expect("known"));
    profiles.keep_design(&anna, &design).expect("kept");
    profiles.back_up().expect("copied");
    drop(profiles);
    let (mut profiles, rescue) = Profiles::open(data.path()).expect("it opens");
    assert_eq!(rescue, None);
    assert_eq!(profiles.mend().expect("readable"), MendedRows::Sound);
    assert_eq!(profiles.designs(&anna).expect("readable"), [design]);
}

#[test]
fn without_a_copy_a_rotten_byte_costs_no_profile() {
    let (data, file) = folder_with_copy(3);
    fs::remove_file(data.path().join("profiles.sqlite.backup")).expect("there");
    rot(&file);
    let (mut profiles, rescue) = Profiles::open(data.path()).expect("it opens");
    assert_eq!(rescue, None);
    let mended = profiles.mend().expect("readable");
    let (restored, lost) = (0, 1);
    assert_eq!(mended, MendedRows::Damaged { restored, lost });
    let said = mended.text().expect("a row is damaged").to_string();
    assert!(said.contains("no backup has it"), "{said}");
    let anna = profiles.find("Anna").expect("she is still there");
    let error = profiles.history(&anna).expect_err("a flight is damaged");
    let said = error.text().to_string();
    assert!(said.contains("profiles.sqlite"), "{said}");
    assert!(said.contains("utf-8"), "{said}");
}

#[test]
fn an_empty_file_or_none_is_damage_where_there_is_a_copy() {
    for is_empty in [true, false] {
        let (data, file) = folder_with_copy(1);
        if is_empty {
            fs::write(&file, "").expect("writable");
        } else {
            fs::remove_file(&file).expect("removable");
        }
        let (profiles, rescue) = Profiles::open(data.path()).expect("restored");
        assert!(rescue.expect("told").copy.is_some());
        assert_eq!(flights(&profiles), 1);
    }
}

#[test]
fn an_empty_copy_is_none() {
    let (data, file) = folder_with_copy(1);
    let copy = data.path().join("profiles.sqlite.backup");
    for empty in [&copy, &file] {
        fs::write(empty, "").expect("writable");
    }
    let (_, rescue) = Profiles::open(data.path()).expect("anew");
    assert_eq!(rescue, None);
}

#[test]
fn a_rescue_goes_on_after_one_that_was_killed() {
    let (data, file) = folder_with_copy(1);
    // The killed console had set the file aside, and its copy was not complete yet.
    fs::rename(&file, data.path().join("profiles.sqlite.damaged-then")).expect("renamed");
    let rest = vec![0x55; 1024 * 1024];
    fs::write(data.path().join("profiles.sqlite.restored"), rest).expect("writable");
    let (profiles, rescue) = Profiles::open(data.path()).expect("restored");
    assert!(rescue.is_some());
    assert_eq!(flights(&profiles), 1);
    assert_eq!(files(data.path(), "restored"), 0);
}

#[test]
fn of_several_consoles_that_see_damage_one_restores() {
    let (data, file) = folder_with_copy(1);
    fs::write(&file, "this was a database").expect("writable");
    let start = std::sync::Barrier::new(6);
    let told = std::thread::scope(|scope| {
        let consoles: Vec<_> = (0..6)
            .map(|_| {
                scope.spawn(|| {
                    start.wait();
                    let (profiles, rescue) = Profiles::open(data.path()).expect("restored");
                    assert_eq!(flights(&profiles), 1);
                    rescue
                })
            })
            .collect();
        let rescues = consoles.into_iter().map(|it| it.join().expect("opened"));
        rescues.flatten().count()
    });
    assert_eq!(told, 1);
    assert_eq!(files(data.path(), "damaged-"), 1);
}

#[test]
fn a_copy_of_damage_displaces_no_good_one() {
    let (data, file) = folder_with_copy(40);
    let copy = data.path().join("profiles.sqlite.backup");
    let good = fs::read(&copy).expect("readable");
    spoil_the_middle(&file);
    let spoilt = Connection::open(&file).expect("it begins well");
    back_up(&spoilt, &file).expect_err("it is damaged");
    assert_eq!(fs::read(&copy).expect("still there"), good);
    assert_eq!(files(data.path(), "backup-before"), 0);
}

#[test]
fn while_one_console_is_at_the_copies_another_leaves_them_alone() {
    let (data, file) = folder_with_copy(1);
    let profiles = open(data.path());
    let lock = fs::File::open(file.with_extension("sqlite.lock")).expect("there");
    lock.lock().expect("free");
    profiles.back_up().expect("left to the other");
    assert_eq!(files(data.path(), "backup-before"), 0);
    lock.unlock().expect("ours");
    profiles.back_up().expect("copied");
    assert_eq!(files(data.path(), "backup-before"), 1);
}

/// Another user of a shared folder may have planted the link.
#[cfg(unix)]
#[test]
fn a_link_in_the_place_of_the_new_copy_is_not_followed() {
    let (data, file) = folder_with_copy(1);
    let other = data.path().join("other");
    fs::write(&other, "untouched").expect("written");
    let planted = PathBuf::from(format!("{}.backup-new", file.display()));
    std::os::unix::fs::symlink(&other, &planted).expect("made");
    open(data.path()).back_up().expect("copied");
    assert_eq!(fs::read_to_string(&other).expect("there"), "untouched");
    assert!(!planted.exists());
    let copy = PathBuf::from(format!("{}.backup", file.display()));
    assert!(copy.is_file() && !copy.is_symlink());
}
