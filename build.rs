//! Puts the commit that the program is made from beside its version, for `--version`.
//!
//! Without git, or outside a checkout (a source archive, a package of a registry), the version stands alone.

use std::env;
use std::path::Path;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let version = env::var("CARGO_PKG_VERSION").unwrap_or_default();
    // A package inside somebody else's checkout is not of its commits: there the way up is not empty.
    let is_checkout = git(&["rev-parse", "--show-cdup"]).as_deref() == Some("");
    let commit = git(&["show", "--no-patch", "--format=%h %cs", "HEAD"]).filter(|_| is_checkout);
    let commit = commit.map_or(String::new(), |commit| format!(" ({commit})"));
    println!("cargo::rustc-env=SORTIE_VERSION={version}{commit}");
    if is_checkout {
        watch();
    }
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
