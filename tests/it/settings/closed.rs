//! Folders and files of the administrator that cannot be used.

use std::os::unix::process::CommandExt as _;

use super::*;

/// The user `nobody`, whom permissions restrict; the superuser, as whom tests may run, they do not.
const NOBODY: u32 = 65_534;

/// The program as a user whom permissions restrict.
fn restricted(home: &Path, arguments: &[&str]) -> Output {
    let program = program();
    let mut command = Command::new(&program[0]);
    command
        .args(&program[1..])
        .args(arguments)
        .envs(home_variables(home))
        .env("NO_COLOR", "1");
    if nix::unistd::Uid::effective().is_root() {
        command.uid(NOBODY).gid(NOBODY);
    }
    command.output().expect("the program runs")
}

fn mode(path: &Path, bits: u32) {
    fs::set_permissions(path, fs::Permissions::from_mode(bits)).expect("ours");
}

fn write(home: &Path, name: &str, content: &str) {
    let path = home.join(name);
    fs::create_dir_all(path.parent().expect("a folder")).expect("created");
    fs::write(path, content).expect("written");
}

#[test]
fn a_closed_folder_of_the_administrator_is_named_everywhere() {
    let home = home(&[]);
    mode(home.path(), 0o755);
    write(home.path(), "etc/sortie/config.toml", "fps = 5\n");
    write(home.path(), "share/sortie/missions/lab.toml", "");
    write(home.path(), "share/sortie/themes/lab.toml", "");
    let closed = [
        "etc/sortie",
        "share/sortie",
        "share/sortie/missions",
        "share/sortie/themes",
    ];
    for name in closed {
        let folder = home.path().join(name);
        mode(&folder, 0o000);
        let fault = format!("no permission to read {}", folder.display());
        let paths = restricted(home.path(), &["config", "--paths"]);
        assert!(
            text(&paths.stderr).contains(&fault),
            "{name}: {}",
            text(&paths.stderr)
        );
        let config = restricted(home.path(), &["config"]);
        assert_eq!(config.status.code(), Some(2), "{name}");
        let shown = text(&config.stdout);
        let is_layer = name.ends_with("/sortie");
        assert_eq!(
            shown.contains("(no permission to read it)"),
            is_layer,
            "{shown}"
        );
        let listed = restricted(home.path(), &["records", "list"]);
        assert!(text(&listed.stderr).contains(&fault), "{name}");
        let doctor = text(&restricted(home.path(), &["doctor"]).stdout);
        assert!(
            doctor.contains(&fault) && doctor.contains("chmod -R a+rX"),
            "{doctor}"
        );
        let check = restricted(home.path(), &["check", &folder.to_string_lossy()]);
        assert_eq!(
            check.status.code(),
            Some(1),
            "{name}: {}",
            text(&check.stdout)
        );
        assert!(text(&check.stderr).contains(&fault), "{name}");
        mode(&folder, 0o755);
    }
    let open = restricted(home.path(), &["config"]);
    assert_eq!(open.status.code(), Some(0), "{}", text(&open.stderr));
}

#[test]
fn the_doctor_names_faulty_missions_and_themes_of_the_administrator() {
    let home = home(&[]);
    write(
        home.path(),
        "share/sortie/missions/51-fault.toml",
        "id = \"51-fault\"\n",
    );
    write(
        home.path(),
        "share/sortie/themes/slip.toml",
        "inherits = \"drak\"\n",
    );
    let doctor = sortie(home.path(), &[], &["doctor"]);
    assert_eq!(doctor.status.code(), Some(1));
    let printed = text(&doctor.stdout);
    for (about, file) in [("missions", "51-fault.toml:"), ("themes", "slip.toml:1:")] {
        let is_named =
            |line: &str| line.starts_with(&format!("FAULT {about}")) && line.contains(file);
        assert!(printed.lines().any(is_named), "{file}: {printed}");
    }
}

#[test]
fn a_faulty_setting_of_the_readers_gives_no_advice_to_close_the_results() {
    let home = home(&[]);
    let data = home.path().join("data/sortie");
    write(home.path(), "data/sortie/profiles.sqlite", "");
    mode(&data.join("profiles.sqlite"), 0o640);
    mode(&data, 0o2750);
    let doctor = |content: &str| {
        write(home.path(), "etc/sortie/config.toml", content);
        text(&sortie(home.path(), &[], &["doctor"]).stdout)
    };
    let advice = "chmod -R g-rwxs";
    let right = doctor("[results]\nreaders = \"owner\"\n");
    assert!(right.contains(advice), "{right}");
    let wrong = doctor("[results]\nreaders = \"gruop\"\n");
    assert!(
        wrong.contains("config.toml:2") && !wrong.contains(advice),
        "{wrong}"
    );
}
