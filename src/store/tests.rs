use std::fs;
use std::path::Path;

use super::source::LARGEST_FILE;
use super::*;

#[test]
fn a_mission_is_found_by_its_number() {
    let found = mission("01").expect("it is embedded");
    assert_eq!(found.id, "01-air-sample");
}

#[test]
fn an_unknown_mission_lists_the_known_ones() {
    let error = mission("99-nowhere").expect_err("there is none");
    assert!(error.to_string().contains("01-air-sample"), "{error}");
}

#[test]
fn a_file_that_is_too_large_is_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("large.toml");
    fs::write(&path, vec![b'#'; LARGEST_FILE as usize + 1]).expect("written");
    assert!(matches!(
        read(&path, "file-mission"),
        Err(StoreError::TooLarge { .. })
    ));
}

#[test]
fn a_file_is_written_whole_and_replaced_only_when_asked() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("quad.parm");
    write(&path, "A,1\n", false).expect("there is none yet");
    let again = write(&path, "A,2\n", false).expect_err("there is one");
    assert!(matches!(again, StoreError::Exists { .. }), "{again}");
    let text = |path: &Path| read(path, "file-parameters").expect("it is there").text;
    assert_eq!(text(&path), "A,1\n");
    write(&path, "A,3\n", true).expect("it may be replaced");
    assert_eq!(text(&path), "A,3\n");
    let left = fs::read_dir(folder.path()).expect("a folder").count();
    assert_eq!(left, 1, "nothing half-written stays");
}

#[test]
fn what_cannot_be_written_says_so_and_leaves_nothing() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for path in [folder.path().to_owned(), folder.path().join("no/such.parm")] {
        for replace in [false, true] {
            let error = write(&path, "A,1\n", replace).expect_err("it cannot");
            assert!(matches!(error, StoreError::Unwritable { .. }), "{error}");
        }
    }
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0);
}

#[test]
fn a_device_without_an_end_is_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("endless.toml");
    std::os::unix::fs::symlink("/dev/zero", &path).expect("linked");
    assert!(matches!(
        read(&path, "file-mission"),
        Err(StoreError::TooLarge { .. })
    ));
}

#[test]
fn a_name_goes_before_a_number() {
    let source = |name: &str| Source {
        name: format!("folder/{name}.toml"),
        text: String::new(),
    };
    let all = [source("01-b-c"), source("01-b"), source("02")];
    for (asked, found) in [("01-b", "01-b"), ("01", "01-b-c"), ("02", "02")] {
        let source = MISSION_FILES.named_among(&all, asked).expect("it is there");
        assert_eq!(source.stem(), found, "{asked}");
    }
    assert!(MISSION_FILES.named_among(&all, "0").is_err());
}

#[test]
fn a_faulty_mission_says_where() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("wrong.toml");
    fs::write(&path, "schema = 1\nid = 3\n").expect("written");
    let error = mission(path.to_str().expect("plain")).expect_err("it is faulty");
    assert!(error.to_string().contains("wrong.toml:2:"), "{error}");
}

/// The folders of a user and an administrator within `home`; the user's configuration folder is
/// also a system folder.
fn folders_in(home: &Path) -> Folders {
    Folders {
        config: home.join("config"),
        data: home.join("data"),
        state: home.join("state"),
        system_config: vec![home.join("etc"), home.join("config")],
        system_data: vec![home.join("share"), home.join("data")],
    }
}

#[test]
fn only_the_administrator_adds_missions_to_the_course() {
    let home = tempfile::tempdir().expect("a folder");
    let folders = folders_in(home.path());
    let (_, shipped) = MISSIONS
        .iter()
        .find(|(name, _)| *name == "01-air-sample")
        .expect("there");
    let written = |folder: &str, id: &str, title: &str| {
        let text = shipped
            .replacen("id = \"01-air-sample\"", &format!("id = \"{id}\""), 1)
            .replacen("Air sample", title, 1);
        let folder = home.path().join(folder).join(MISSION_FILES.folder);
        fs::create_dir_all(&folder).expect("created");
        fs::write(folder.join(format!("{id}.toml")), &text).expect("written");
        Mission::parse(&text).expect("no faults")
    };
    let cases = [
        (written("share", "60-lab", "Lab"), MissionFile::Course),
        (written("etc", "61-lab", "Lab"), MissionFile::Course),
        (written("config", "70-easy", "Easy"), MissionFile::Own),
        (written("data", "71-easy", "Easy"), MissionFile::Own),
        (written("config", "60-lab", "Easier"), MissionFile::Altered),
    ];
    let course = course_missions_with(Some(&folders));
    for (mission, expected) in cases {
        assert_eq!(compared(&mission, &course), expected, "{}", mission.id);
    }
}

#[test]
fn a_fifo_in_a_folder_is_left_out_with_the_reason() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("wait.toml");
    nix::unistd::mkfifo(&path, nix::sys::stat::Mode::S_IRWXU).expect("made");
    fs::write(folder.path().join("good.toml"), "schema = 1").expect("written");
    let all = files(folder.path(), "file-mission", "toml");
    let names: Vec<&str> = all.iter().map(Source::stem).collect();
    assert_eq!(names, ["good"]);
    let error = read_found(&path, "file-mission").expect_err("it would wait for a writer");
    assert!(error.to_string().contains("not a regular file"), "{error}");
}
