//! Lists the missions, pilot scripts and designs that the program embeds, and puts the commit that it is made from beside its
//! version, for `--version`.
//!
//! Without git, or outside a checkout (a source archive, a package of a registry), the version stands alone.

use std::error::Error;
use std::ffi::OsStr;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=build.rs");
    list_missions()?;
    let version = env::var("CARGO_PKG_VERSION").unwrap_or_default();
    // A package inside somebody else's checkout is not of its commits: there the way up is not empty.
    let is_checkout = git(&["rev-parse", "--show-cdup"]).as_deref() == Some("");
    // The length that git would choose depends on the clone.
    let format = [
        "show",
        "--no-patch",
        "--abbrev=12",
        "--format=%h %cs",
        "HEAD",
    ];
    let commit = git(&format).filter(|_| is_checkout);
    let commit = commit.map_or(String::new(), |commit| format!(" ({commit})"));
    println!("cargo::rustc-env=SORTIE_VERSION={version}{commit}");
    if is_checkout {
        watch();
    }
    Ok(())
}

/// The files of one kind: the name of their list, its description, their folders and their ending.
type Kind = (
    &'static str,
    &'static str,
    &'static [&'static str],
    &'static str,
);

const KINDS: [Kind; 3] = [
    (
        "MISSIONS",
        "Missions",
        &["missions", "missions/drills"],
        "toml",
    ),
    ("PILOTS", "Pilot scripts", &["missions/pilots"], "pilot"),
    ("DESIGNS", "Designs of drones", &["designs"], "toml"),
];

/// Writes a list per kind of file, by file name without its ending.
fn list_missions() -> Result<(), Box<dyn Error>> {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR")?);
    let mut code = String::new();
    for (list, description, folders, ending) in KINDS {
        let mut paths = Vec::new();
        for folder in folders.iter().map(|folder| root.join(folder)) {
            println!("cargo::rerun-if-changed={}", folder.display());
            for entry in fs::read_dir(&folder)? {
                paths.push(entry?.path());
            }
        }
        paths.retain(|path| path.extension() == Some(OsStr::new(ending)));
        paths.sort();
        writeln!(code, "/// {description}, by file name without its ending.")?;
        writeln!(code, "pub(super) const {list}: &[(&str, &str)] = &[")?;
        for path in &paths {
            let stem = path.file_stem().and_then(OsStr::to_str);
            let (Some(stem), Some(path)) = (stem, path.to_str()) else {
                return Err(format!("{} is not in UTF-8", path.display()).into());
            };
            writeln!(code, "    ({stem:?}, include_str!({path:?})),")?;
        }
        writeln!(code, "];")?;
    }
    fs::write(PathBuf::from(env::var("OUT_DIR")?).join("shipped.rs"), code)?;
    Ok(())
}

/// Asks for this to be done again after a commit.
fn watch() {
    // Every commit, checkout and reset adds a line to the log of HEAD, and nothing else does. A file that is not
    // there would cause a build each time.
    for name in ["logs/HEAD", "HEAD"] {
        if let Some(path) = git(&["rev-parse", "--git-path", name])
            && Path::new(&path).exists()
        {
            println!("cargo::rerun-if-changed={path}");
            return;
        }
    }
}

/// What git answers, if there is git and it has an answer.
fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok()?;
    let answer = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| answer.trim().to_owned())
}
