//! Real SITL programs, each named by an environment variable, as child processes of a test.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use sortie::sitl::{Recipe, SerialEndpoint};
use tempfile::TempDir;

/// The program named by `SORTIE_ARDUCOPTER`. Tests that use it are `#[ignore]`d and have `real_arducopter` in their
/// names: `SORTIE_ARDUCOPTER=FILE cargo test -- --ignored real_arducopter` runs them.
pub(crate) fn arducopter() -> PathBuf {
    named_by("SORTIE_ARDUCOPTER")
}

/// The program named by `SORTIE_ARDUROVER`, for tests with `real_ardurover` in their names.
pub(crate) fn ardurover() -> PathBuf {
    named_by("SORTIE_ARDUROVER")
}

fn named_by(variable: &str) -> PathBuf {
    let named = std::env::var_os(variable);
    named
        .unwrap_or_else(|| panic!("{variable} does not name a program"))
        .into()
}

/// A running SITL; it ends with the test.
pub(crate) struct Sitl {
    process: Child,
    /// The folder that it runs in, if that ends with it.
    folder: Option<TempDir>,
}

impl Drop for Sitl {
    fn drop(&mut self) {
        // An error means that it has ended already.
        drop(self.process.kill());
        drop(self.process.wait());
        drop(self.folder.take());
    }
}

impl Sitl {
    /// Starts a program in a folder.
    pub(crate) fn start(program: &Path, folder: &Path, arguments: &[impl AsRef<OsStr>]) -> Self {
        let process = Command::new(program)
            .args(arguments)
            .current_dir(folder)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn();
        Self {
            process: process.expect("the program can be started"),
            folder: None,
        }
    }

    /// Starts a vehicle as the hangar does, in a folder of its own. It listens on TCP port 5760 plus ten per instance.
    pub(crate) fn of(program: &Path, recipe: &Recipe, instance: u16) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let line = recipe.command_line(SerialEndpoint::Listening(instance));
        let line = line.expect("SITL has the model");
        for (name, content) in line.files {
            fs::write(folder.path().join(name), content).expect("written");
        }
        Self::start(program, folder.path(), &line.arguments).with(folder)
    }

    /// Keeps the folder as long as the program.
    fn with(mut self, folder: TempDir) -> Self {
        self.folder.replace(folder);
        self
    }
}
