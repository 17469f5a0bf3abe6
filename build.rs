//! Lists the missions, pilot scripts, designs, lesson plans, exams and rubrics to embed, and adds the current commit to
//! version for `--version`.
//!
//! Without git, or outside a checkout (a source archive, a registry package), the version has no
//! commit.

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
    // A package inside another project's checkout is not part of that project's commits; the path
    // to the root of the checkout is then not empty.
    let is_checkout = git(&["rev-parse", "--show-cdup"]).as_deref() == Some("");
    // A fixed length, because the length that git would choose depends on the clone.
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

/// One kind of file: the name of its list, its description, its folders and its file-name
/// extension.
type Kind = (
    &'static str,
    &'static str,
    &'static [&'static str],
    &'static str,
);

const KINDS: [Kind; 6] = [
    (
        "MISSIONS",
        "Missions",
        &["missions", "missions/drills"],
        "toml",
    ),
    ("PILOTS", "Pilot scripts", &["missions/pilots"], "pilot"),
    ("DESIGNS", "Designs of drones", &["designs"], "toml"),
    ("LESSONS", "Lesson plans", &["lessons"], "toml"),
    ("EXAMS", "Exams", &["exams"], "toml"),
    ("RUBRICS", "Rubrics", &["rubrics"], "toml"),
];

/// Writes a list for each kind of file, keyed by file name without the extension.
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

/// Makes Cargo rerun this script after a commit.
fn watch() {
    // Every commit, checkout and reset adds a line to the log of HEAD, and nothing else does. A missing file would
    // cause a build each time.
    for name in ["logs/HEAD", "HEAD"] {
        if let Some(path) = git(&["rev-parse", "--git-path", name])
            && Path::new(&path).exists()
        {
            println!("cargo::rerun-if-changed={path}");
            return;
        }
    }
}

/// The output of git; `None` without git or after an error.
fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok()?;
    let answer = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| answer.trim().to_owned())
}
