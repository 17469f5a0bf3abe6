//! Settings of the administrator.

use super::*;

#[test]
fn the_administrator_sets_for_everybody_what_a_user_may_change() {
    let home = home(&[("config.toml", "fps = 20\n")]);
    let write = |name: &str, content: &str| {
        let path = home.path().join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("created");
        fs::write(path, content).expect("written");
    };
    write(
        "etc/sortie/config.toml",
        "lang = \"uk\"\nfps = 5\n[hangar]\narducopter = \"bin/arducopter\"\n",
    );
    write("share/sortie/themes/lab.toml", "inherits = \"dark\"\n");
    let mission = fs::read_to_string("missions/00-first-flight.toml").expect("it ships");
    let own = mission.replace("00-first-flight", "lab-one");
    write("share/sortie/missions/lab-one.toml", &own);

    let config = sortie(home.path(), &[], &["config"]);
    let printed = text(&config.stdout);
    assert!(
        printed.starts_with(
            "# Precedence: flag, environment, file, the administrator's file, default."
        ),
        "{printed}"
    );
    assert_eq!(config.status.code(), Some(0), "{}", text(&config.stderr));
    let base = home.path().to_str().expect("plain");
    assert_eq!(
        line_of(&printed, "lang"),
        format!("lang = \"uk\" # {base}/etc/sortie/config.toml:1")
    );
    assert_eq!(
        line_of(&printed, "fps"),
        format!("fps = 20 # {base}/config/sortie/config.toml:1"),
        "the user's counts"
    );
    let copter = line_of(&printed, "arducopter");
    assert!(
        copter.starts_with("arducopter = \"bin/arducopter\" # ")
            && copter.ends_with("etc/sortie/config.toml:4"),
        "{printed}"
    );
    let paths = text(&sortie(home.path(), &[], &["config", "--paths"]).stdout);
    let paths: toml::Table = toml::from_str(&paths).expect("it is TOML");
    let system = toml::Value::from(vec![format!("{base}/etc/sortie")]);
    assert_eq!(paths["system_config"], system);
    let shared = toml::Value::from(vec![format!("{base}/share/sortie")]);
    assert_eq!(paths["system_data"], shared);

    let themed = sortie(home.path(), &[("SORTIE_THEME", "lab")], &["config"]);
    assert_eq!(themed.status.code(), Some(0), "{}", text(&themed.stderr));
    let printed = text(&themed.stdout);
    assert_eq!(
        line_of(&printed, "theme"),
        "theme = \"lab\" # environment SORTIE_THEME"
    );
    let arguments = ["run", "lab-one", "--pilot", "00-first-flight", "--json"];
    let flown = sortie(home.path(), &[], &arguments);
    assert_eq!(flown.status.code(), Some(0), "{}", text(&flown.stderr));
    let report: serde_json::Value = serde_json::from_slice(&flown.stdout).expect("it is JSON");
    assert_eq!(report["mission"], "lab-one");
    assert_eq!(report["mission_file"], "course");
}

#[test]
fn a_mission_of_the_users_own_is_not_part_of_the_course() {
    let mission = fs::read_to_string("missions/00-first-flight.toml").expect("it ships");
    let own = mission.replace("00-first-flight", "70-easy");
    let home = home(&[("missions/70-easy.toml", &own)]);
    let arguments = ["run", "70-easy", "--pilot", "00-first-flight"];
    let flown = sortie(home.path(), &[], &[&arguments[..], &["--json"]].concat());
    assert_eq!(flown.status.code(), Some(0), "{}", text(&flown.stderr));
    let report: serde_json::Value = serde_json::from_slice(&flown.stdout).expect("it is JSON");
    assert_eq!(report["mission_file"], "own");
    let debrief = text(&sortie(home.path(), &[], &arguments).stdout);
    assert!(
        debrief.contains("70-easy is not part of the course"),
        "{debrief}"
    );
}

#[test]
fn fifos_in_the_users_folder_are_reported_and_do_not_hang_the_program() {
    let home = home(&[("missions/good.toml", "")]);
    let config = home.path().join("config/sortie");
    for name in [
        "missions/a",
        "missions/pilots/a",
        "designs/a",
        "themes/a",
        "config",
        "keymap",
    ] {
        let ending = if name.contains("pilots") {
            "pilot"
        } else {
            "toml"
        };
        let path = config.join(format!("{name}.{ending}"));
        fs::create_dir_all(path.parent().expect("a folder")).expect("created");
        nix::unistd::mkfifo(&path, nix::sys::stat::Mode::S_IRWXU).expect("made");
    }
    let arguments = ["run", "00-first-flight", "--pilot", "00-first-flight"];
    let flown = sortie(home.path(), &[], &arguments);
    assert_eq!(flown.status.code(), Some(0), "{}", text(&flown.stderr));
    let told = text(&sortie(home.path(), &[], &["config"]).stderr);
    for name in ["config.toml", "keymap.toml"] {
        let line = told.lines().find(|line| line.contains(name));
        let line = line.unwrap_or_else(|| panic!("{name}: {told}"));
        assert!(line.contains("not a regular file"), "{line}");
    }
    let folder = config.join("missions");
    let checked = sortie(home.path(), &[], &["check", &folder.to_string_lossy()]);
    let told = text(&checked.stderr);
    assert!(
        told.contains("a.toml") && told.contains("not a regular file"),
        "{told}"
    );
}

#[test]
fn a_fault_of_the_administrators_file_is_told_and_keeps_nobody_from_flying() {
    let home = home(&[]);
    let path = home.path().join("etc/sortie/config.toml");
    fs::create_dir_all(path.parent().expect("a folder")).expect("created");
    fs::write(path, "fps = \"many\"\ntheme = \"light\"\n").expect("written");
    let output = sortie(home.path(), &[], &["config"]);
    assert_eq!(output.status.code(), Some(2));
    let told = text(&output.stderr);
    assert!(told.contains("etc/sortie/config.toml:1:7"), "{told}");
    let printed = text(&output.stdout);
    assert!(line_of(&printed, "theme").starts_with("theme = \"light\" # "));
    assert_eq!(line_of(&printed, "fps"), "fps = 10 # default");
    let paths = ["config", "--theme", "dark", "--paths"];
    let printed = text(&sortie(home.path(), &[], &paths).stdout);
    assert!(printed.contains("system_config = ["), "{printed}");
}

#[test]
fn what_the_administrator_names_may_be_missing_or_wrong() {
    let home = home(&[
        ("mine.toml", "fps = 20\n"),
        ("named.toml", "keymap = \"nowhere.toml\"\n"),
    ]);
    let system = home.path().join("etc/sortie");
    fs::create_dir_all(system.join("themes")).expect("created");
    let theme = "inherits = \"dark\"\n[roles]\nwarnin = { fg = \"red\" }\n";
    fs::write(system.join("themes/lab.toml"), theme).expect("written");
    let mine = file(home.path(), "mine.toml");
    let arguments = ["run", "01", "--pilot", "01-naive", "--config"];
    let arguments = [&arguments[..], &[mine.to_str().expect("plain")]].concat();
    for (setting, expected) in [
        ("keymap = \"nowhere.toml\"\n", "nowhere.toml"),
        ("theme = \"lab\"\n", "unknown role `warnin`"),
    ] {
        fs::write(system.join("config.toml"), setting).expect("written");
        let output = sortie(home.path(), &[], &arguments);
        let said = text(&output.stderr);
        assert!(said.contains(expected), "{said}");
        assert_eq!(output.status.code(), Some(1), "flown, not passed: {said}");
    }
    let named = file(home.path(), "named.toml");
    let arguments = ["config", "--config", named.to_str().expect("plain")];
    let refused = sortie(home.path(), &[], &arguments);
    assert!(text(&refused.stderr).contains("nowhere.toml"));
    assert!(refused.stdout.is_empty(), "what is named has to be right");
}

#[test]
fn results_are_for_their_trainee_unless_the_administrator_lets_a_group_read_them() {
    for (setting, expected) in [("", [0o700, 0o600]), ("group", [0o2750, 0o640])] {
        let home = home(&[]);
        let system = home.path().join("etc/sortie");
        fs::create_dir_all(&system).expect("created");
        if !setting.is_empty() {
            let text = format!("[results]\nreaders = \"{setting}\"\n");
            fs::write(system.join("config.toml"), text).expect("written");
        }
        let data = home.path().join("class/anna");
        let variables = [("SORTIE_DATA", data.to_str().expect("plain"))];
        let run = |arguments: &[&str]| {
            let output = sortie(home.path(), &variables, arguments);
            assert_ne!(output.status.code(), Some(2), "{}", text(&output.stderr));
        };
        run(&["profile", "create", "anna"]);
        run(&[
            "run",
            "00",
            "--pilot",
            "00-first-flight",
            "--profile",
            "anna",
        ]);
        let report = home.path().join("report.md");
        let output = report.to_str().expect("plain");
        run(&["report", "--profile", "anna", "--output", output]);
        let mode = |path: &Path| {
            let facts = fs::metadata(path).expect("it is there");
            facts.permissions().mode() & 0o7777
        };
        let runs = fs::read_dir(data.join("runs")).expect("recorded");
        let record = runs.flatten().next().expect("one").path();
        for folder in [&data, &data.join("runs")] {
            assert_eq!(mode(folder), expected[0], "{setting}");
        }
        for file in [&data.join("profiles.sqlite"), &record, &report] {
            assert_eq!(mode(file), expected[1], "{setting}: {}", file.display());
        }
    }
}

#[test]
fn a_wrong_setting_is_a_finding_of_the_doctor() {
    let home = home(&[("config.toml", "lang = \"xx\"\nfps = 12\n")]);
    let doctor = sortie(home.path(), &[], &["doctor"]);
    let found = text(&doctor.stdout);
    assert_eq!(doctor.status.code(), Some(1), "{found}");
    let line = found.lines().find(|line| line.contains("config.toml:1:8"));
    let line = line.unwrap_or_else(|| panic!("{found}"));
    assert!(
        line.starts_with("FAULT settings") && line.ends_with("`lang` must be one of en, uk"),
        "{line}"
    );
    assert_eq!(text(&doctor.stderr), "", "it is said once");
}

#[test]
fn a_class_that_no_console_could_join_is_found_by_doctor_and_check() {
    let place = tempfile::tempdir().expect("a folder");
    let bad = place.path().join("seat-07.join");
    fs::write(&bad, "no join line").expect("written");
    fs::set_permissions(&bad, fs::Permissions::from_mode(0o600)).expect("set");
    let missing = place.path().join("seat-08.join");
    let folder = place.path().join("9-A");
    let user = "no-such-user-of-sortie";
    for (line, said) in [
        (
            format!("join = \"{}\"", bad.display()),
            "is not a join line",
        ),
        (format!("join = \"{}\"", missing.display()), "cannot use"),
        (
            format!("join = \"{}\"", folder.display()),
            "there is no folder",
        ),
        (
            format!("instructor = \"{user}\""),
            "this machine has no user",
        ),
    ] {
        let written = format!("[class]\n{line}\n");
        let home = home(&[("config.toml", written.as_str())]);
        let doctor = sortie(home.path(), &[], &["doctor"]);
        let found = text(&doctor.stdout);
        assert_eq!(doctor.status.code(), Some(1), "{found}");
        let finding = found.lines().find(|it| it.starts_with("FAULT class"));
        assert!(finding.is_some_and(|it| it.contains(said)), "{found}");
        let file = home.path().join("config/sortie/config.toml");
        let check = sortie(home.path(), &[], &["check", file.to_str().expect("plain")]);
        let found = text(&check.stdout);
        assert_eq!(check.status.code(), Some(1), "{found}");
        assert!(
            found.contains("config.toml:2:") && found.contains(said),
            "{found}"
        );
        // The console starts nevertheless.
        let config = sortie(home.path(), &[], &["config"]);
        assert_eq!(config.status.code(), Some(0), "{}", text(&config.stderr));
    }
    let good = home(&[("config.toml", "[class]\njoin = \"9-A\"\n")]);
    let doctor = text(&sortie(good.path(), &[], &["doctor"]).stdout);
    assert!(
        doctor.contains("class.join: /tmp/sortie-class-9-A/desk"),
        "{doctor}"
    );
}

#[test]
fn a_theme_that_is_a_link_to_nothing_is_named_and_the_default_is_used() {
    let home = home(&[("config.toml", "theme = \"harbour\"\n")]);
    let themes = home.path().join("config/sortie/themes");
    fs::create_dir_all(&themes).expect("created");
    std::os::unix::fs::symlink("/nowhere/harbour.toml", themes.join("harbour.toml")).expect("made");
    let said = format!(
        "{}/harbour.toml is a link to /nowhere/harbour.toml, which does not exist",
        themes.display()
    );
    let list = sortie(home.path(), &[], &["profile", "list"]);
    assert_eq!(list.status.code(), Some(0), "{}", text(&list.stderr));
    let config = sortie(home.path(), &[], &["config"]);
    let told = text(&config.stderr);
    assert!(
        told.contains(&format!("no theme `harbour`: {said}")),
        "{told}"
    );
    let printed = text(&config.stdout);
    assert!(
        line_of(&printed, "theme").contains("theme = \"dark\""),
        "{printed}"
    );
    let doctor = text(&sortie(home.path(), &[], &["doctor"]).stdout);
    assert!(doctor.contains(&said), "{doctor}");
    let named = sortie(home.path(), &[], &["--theme", "harbour", "config"]);
    assert_eq!(named.status.code(), Some(2), "a wrong flag");
    assert!(
        text(&named.stderr).contains(&said),
        "{}",
        text(&named.stderr)
    );
}
