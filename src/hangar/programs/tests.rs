use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::time::Duration;

use super::identity::identify_by;
use super::*;
use crate::hangar::HangarLimits;
use crate::hangar::launcher::tests::launcher;

struct Home(tempfile::TempDir);

impl Home {
    fn new() -> Self {
        Self(tempfile::tempdir().expect("a temporary folder"))
    }

    fn file(&self, path: &str, text: &str, mode: u32) -> PathBuf {
        let path = self.0.path().join(path);
        fs::create_dir_all(path.parent().expect("a folder")).expect("it is made");
        fs::write(&path, text).expect("it is written");
        fs::set_permissions(&path, fs::Permissions::from_mode(mode)).expect("it is ours");
        path
    }

    fn places(&self) -> Places {
        let folder = |name: &str| self.0.path().join(name);
        Places {
            path: Some(env::join_paths([folder("bin"), folder("sbin")]).expect("no colons")),
            home: Some(folder("home")),
            here: folder("here"),
        }
    }
}

fn named(file: &Path) -> BTreeMap<SitlKind, Named> {
    let file = file.to_owned();
    let by = "SORTIE_ARDUCOPTER".to_owned();
    BTreeMap::from([(SitlKind::Copter, Named { file, by })])
}

#[test]
fn a_program_that_is_named_comes_before_the_path_and_that_before_builds() {
    let home = Home::new();
    let at_home = home.file("home/src/ardupilot/build/sitl/bin/arducopter", "", 0o755);
    let find = || Programs::find(&BTreeMap::new(), &home.places());
    assert_eq!(find().of(SitlKind::Copter).expect("found").file, at_home);
    let beside = home.file("here/../ardupilot/build/sitl/bin/arducopter", "", 0o755);
    assert_eq!(find().of(SitlKind::Copter).expect("found").file, beside);
    home.file("bin/arducopter", "", 0o644);
    let on_path = home.file("sbin/arducopter", "", 0o755);
    let programs = find();
    let found = programs.of(SitlKind::Copter).expect("found");
    assert_eq!((&found.file, found.by.as_str()), (&on_path, "PATH"));
    let other = home.file("other", "", 0o755);
    let programs = Programs::find(&named(&other), &home.places());
    let found = programs.of(SitlKind::Copter).expect("found");
    assert_eq!(
        (&found.file, found.by.as_str()),
        (&other, "SORTIE_ARDUCOPTER")
    );
    assert_eq!(
        programs.paths(),
        BTreeMap::from([(SitlKind::Copter, other)])
    );
}

#[test]
fn one_that_is_named_and_wrong_is_told_and_not_replaced() {
    let home = Home::new();
    home.file("bin/arducopter", "", 0o755);
    let cases = [
        (home.0.path().join("nowhere"), "No such file"),
        (
            home.file("plain", "", 0o644),
            "it is not executable: chmod +x",
        ),
        (home.0.path().join("bin"), "it is a folder"),
    ];
    for (file, expected) in cases {
        let programs = Programs::find(&named(&file), &home.places());
        let missing = programs
            .of(SitlKind::Copter)
            .expect_err(expected)
            .to_string();
        assert!(missing.contains(expected), "{missing}");
        assert!(missing.starts_with("SORTIE_ARDUCOPTER names "), "{missing}");
    }
}

#[test]
fn one_that_is_nowhere_tells_where_it_was_looked_for() {
    let home = Home::new();
    let programs = Programs::find(&BTreeMap::new(), &home.places());
    let missing = programs.of(SitlKind::Sub).expect_err("there is none");
    let text = missing.to_string();
    assert!(text.starts_with("no ardusub on the PATH nor in "), "{text}");
    assert!(text.contains("/home/ardupilot/build/sitl/bin"), "{text}");
}

/// Identifies a program with this test program in place of `sortie`.
async fn identify(program: &Path, patience: Duration) -> Result<ProgramIdentity, Unknown> {
    identify_by(&launcher(HangarLimits::default()), program, patience).await
}

/// Why a script is not identified as SITL.
async fn refused(home: &Home, script: &str, patience: Duration) -> String {
    let file = home.file("program", script, 0o755);
    let unknown = identify(&file, patience).await.expect_err(script);
    unknown.to_string()
}

/// A time limit long enough for a loaded machine, since the programs end on their own.
const LONG: Duration = Duration::from_secs(120);

#[tokio::test]
async fn what_is_no_sitl_is_told_with_what_it_printed() {
    let home = Home::new();
    let cases = [
        (
            "#!/bin/sh\necho one; echo two >&2; exit 3\n",
            "it has ended (exit status: 3); it printed: ",
        ),
        (
            "#!/bin/sh\nexec yes\n",
            "it never stops printing; it printed: y",
        ),
        ("#!/bin/sh\nexec cat /dev/zero\n", "it never stops printing"),
        ("no program\n", "is not a program that this machine can run"),
        ("#!/nowhere/at/all\n", "its interpreter"),
    ];
    for (script, expected) in cases {
        let text = refused(&home, script, LONG).await;
        assert!(text.contains(expected), "{script}: {text}");
    }
    let ls = identify(Path::new("/bin/ls"), LONG)
        .await
        .expect_err("it lists");
    assert!(
        ls.to_string()
            .contains("/bin/ls is not a SITL program: it has ended"),
        "{ls}"
    );
    let folder = identify(home.0.path(), LONG).await.expect_err("a folder");
    assert!(folder.to_string().contains("it is a folder"), "{folder}");
}

#[tokio::test]
async fn one_that_hangs_is_ended_with_all_that_it_has_started() {
    let home = Home::new();
    let children = home.0.path().join("children");
    let script = format!(
        "#!/bin/sh\nsleep 600 &\necho $! > {0}.new && mv {0}.new {0}\nwait\n",
        children.display()
    );
    let patience = Duration::from_millis(300);
    // A loaded machine may need several attempts before the script gets that far.
    let child: i32 = loop {
        let text = refused(&home, &script, patience).await;
        assert!(
            text.contains("has not identified itself within 300ms"),
            "{text}"
        );
        if let Ok(text) = fs::read_to_string(&children) {
            break text.trim().parse().expect("a process id");
        }
    };
    // Its new parent will fetch the status at some point.
    let state = |pid| fs::read_to_string(format!("/proc/{pid}/stat")).unwrap_or_default();
    while !state(child).is_empty() && !state(child).contains(") Z ") {
        tokio::task::yield_now().await;
    }
}

#[tokio::test]
async fn one_that_greets_like_sitl_is_known() {
    let home = Home::new();
    // A stand-in for SITL: bash can open a TCP connection.
    let script = "#!/bin/bash\nfor word; do case $word in tcpclient:*) address=${word#tcpclient:};; esac; done\n\
                  exec 3<>/dev/tcp/${address/://}\n\
                  printf '\\n\\nInit Ardu' >&3; printf 'Rover V4.7.0 (0123abcd)\\n' >&3; sleep 600\n";
    let file = home.file("arduplane", script, 0o755);
    let identity = identify(&file, LONG).await.expect("it greets");
    assert_eq!(
        (identity.kind, identity.version.as_str()),
        (SitlKind::Rover, "4.7.0")
    );
    assert_eq!(identity.sockets, []);
}

#[tokio::test]
#[ignore = "needs SORTIE_ARDUCOPTER"]
async fn a_real_arducopter_says_so() {
    let program = env::var_os("SORTIE_ARDUCOPTER").expect("SORTIE_ARDUCOPTER names an arducopter");
    let identity = identify(Path::new(&program), LONG)
        .await
        .expect("it is one");
    assert_eq!(identity.kind, SitlKind::Copter);
}
