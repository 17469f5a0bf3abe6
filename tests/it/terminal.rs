//! The real program in a real pseudo-terminal, read back as a user would see it.

use std::io::{Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Arc, Condvar, Mutex};
use std::time::{Duration, Instant};

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use portable_pty::{Child, CommandBuilder, MasterPty, PtySize, native_pty_system};

/// The time limit for expected content of a screen. Generous, because a loaded machine is slow and a test waits in full
/// only if it fails.
const PATIENCE: Duration = Duration::from_secs(90);

/// The program under test with its first arguments; `SORTIE_BIN` names another command for it.
pub fn program() -> Vec<String> {
    let command = std::env::var("SORTIE_BIN");
    let command = command.unwrap_or_else(|_| env!("CARGO_BIN_EXE_sortie").to_owned());
    command.split_whitespace().map(str::to_owned).collect()
}

/// The variables that make a folder the home of the program's user, with English as the language.
pub fn home_variables(home: &Path) -> [(&'static str, PathBuf); 7] {
    [
        ("XDG_CONFIG_HOME", home.join("config")),
        ("XDG_DATA_HOME", home.join("data")),
        ("XDG_STATE_HOME", home.join("state")),
        ("XDG_CONFIG_DIRS", home.join("etc")),
        ("XDG_DATA_DIRS", home.join("share")),
        ("LC_ALL", PathBuf::new()),
        ("LANG", PathBuf::from("C.UTF-8")),
    ]
}

/// A terminal with the program in it.
pub struct Terminal {
    /// The terminal; `None` once it has gone away.
    master: Option<Box<dyn MasterPty + Send>>,
    keyboard: Box<dyn std::io::Write + Send>,
    child: Box<dyn Child + Send + Sync>,
    output: Receiver<Vec<u8>>,
    screen: vt100::Parser,
    raw: Vec<u8>,
    /// The folder for the user's files, unless variables name others.
    _home: tempfile::TempDir,
    pace: Arc<Pace>,
}

/// The speed at which the terminal reads.
#[derive(Default)]
struct Pace {
    bytes_per_s: Mutex<Option<usize>>,
    changed: Condvar,
    /// Whether the terminal closes after its next read.
    gone: AtomicBool,
}

impl Pace {
    fn set(&self, bytes_per_s: Option<usize>) {
        *self.bytes_per_s.lock().expect("no reader panics") = bytes_per_s;
        self.changed.notify_all();
    }

    /// The part of the buffer for the next bytes; waits until they may be read.
    fn room<'a>(&self, buffer: &'a mut [u8]) -> &'a mut [u8] {
        let stalled = |pace: &mut Option<usize>| *pace == Some(0);
        let pace = self.bytes_per_s.lock().expect("no test panics here");
        let pace = *self.changed.wait_while(pace, stalled).expect("no panic");
        match pace {
            None => buffer,
            Some(bytes_per_s) => {
                std::thread::sleep(Duration::from_millis(100));
                &mut buffer[..bytes_per_s / 10]
            }
        }
    }
}

impl Terminal {
    /// Starts the program in a terminal of `columns` by `rows`.
    pub fn start(arguments: &[&str], columns: u16, rows: u16) -> Self {
        Self::start_with(arguments, columns, rows, &[])
    }

    /// Starts the program in a terminal, with environment variables.
    pub fn start_with(
        arguments: &[&str],
        columns: u16,
        rows: u16,
        variables: &[(&str, &str)],
    ) -> Self {
        let program = program();
        let argv: Vec<&str> = program
            .iter()
            .map(String::as_str)
            .chain(arguments.iter().copied())
            .collect();
        Self::run(&argv, columns, rows, variables)
    }

    /// Starts any program.
    pub fn run(argv: &[&str], columns: u16, rows: u16, variables: &[(&str, &str)]) -> Self {
        let size = PtySize {
            rows,
            cols: columns,
            pixel_width: 0,
            pixel_height: 0,
        };
        let pair = native_pty_system()
            .openpty(size)
            .expect("a pseudo-terminal");
        let mut command = CommandBuilder::from_argv(argv.iter().map(Into::into).collect());
        command.cwd(env!("CARGO_MANIFEST_DIR"));
        command.env("TERM", "xterm-256color");
        command.env("LC_ALL", "C.UTF-8");
        command.env_remove("NO_COLOR");
        let home = tempfile::tempdir().expect("a temporary folder");
        for (name, value) in home_variables(home.path()) {
            command.env(name, value);
        }
        for (name, value) in variables {
            command.env(name, value);
        }
        let child = pair
            .slave
            .spawn_command(command)
            .expect("the program starts");
        drop(pair.slave);
        let mut reader = pair.master.try_clone_reader().expect("a reader");
        let (bytes, output) = channel();
        let pace = Arc::new(Pace::default());
        let shared = Arc::clone(&pace);
        std::thread::spawn(move || {
            let mut buffer = [0; 4096];
            while !shared.gone.load(Ordering::SeqCst)
                && let Ok(count) = reader.read(shared.room(&mut buffer))
            {
                if count == 0 || bytes.send(buffer[..count].to_vec()).is_err() {
                    break;
                }
            }
        });
        Self {
            keyboard: pair.master.take_writer().expect("a writer"),
            master: Some(pair.master),
            child,
            output,
            screen: vt100::Parser::new(
                rows.try_into().expect("rows"),
                columns.try_into().expect("columns"),
                0,
            ),
            raw: Vec::new(),
            _home: home,
            pace,
        }
    }

    /// Stops reading, like a terminal whose line is dead.
    pub fn stop_reading(&mut self) -> &mut Self {
        self.pace.set(Some(0));
        self
    }

    /// Reads slowly, as over a line of this rate.
    pub fn read_slowly(&mut self, bytes_per_s: usize) -> &mut Self {
        self.pace.set(Some(bytes_per_s));
        self
    }

    /// Reads at full speed again.
    pub fn go_on_reading(&mut self) -> &mut Self {
        self.pace.set(None);
        self
    }

    /// Waits until the program's log meets a condition, without reading the screen.
    pub fn wait_for_log(log: &Path, what: &str, wanted: impl Fn(&str) -> bool) {
        let deadline = Instant::now() + PATIENCE;
        loop {
            let written = std::fs::read_to_string(log).unwrap_or_default();
            if wanted(&written) {
                return;
            }
            assert!(
                Instant::now() < deadline,
                "waited in vain for {what} in:\n{written}"
            );
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Waits for the end of the program without reading any output; returns its exit code.
    pub fn end_unread(&mut self) -> u32 {
        let deadline = Instant::now() + PATIENCE;
        loop {
            if let Some(status) = self.child.try_wait().expect("it was started") {
                return status.exit_code();
            }
            assert!(Instant::now() < deadline, "waited in vain for the end");
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Types keys without any conversion.
    pub fn press(&mut self, keys: &str) -> &mut Self {
        self.keyboard
            .write_all(keys.as_bytes())
            .expect("the program reads");
        self.keyboard.flush().expect("the program reads");
        self
    }

    /// Enters a line in the palette.
    pub fn command(&mut self, line: &str) -> &mut Self {
        self.press(":").see("command");
        self.press(line).see(line);
        self.press("\r")
    }

    /// Waits until the screen shows `text`.
    pub fn see(&mut self, text: &str) -> &mut Self {
        self.wait(&format!("{text:?}"), |screen| screen.contains(text))
    }

    /// Waits until `text` has been written, even if it has scrolled off the screen.
    pub fn see_in_scrollback(&mut self, text: &str) -> &mut Self {
        self.until(&format!("{text:?}"), |terminal| {
            terminal.raw().contains(text)
        })
    }

    /// Waits until the screen no longer shows `text`.
    pub fn see_no_more(&mut self, text: &str) -> &mut Self {
        self.wait(&format!("the end of {text:?}"), |screen| {
            !screen.contains(text)
        })
    }

    /// Waits until the screen meets a condition.
    pub fn wait(&mut self, what: &str, wanted: impl Fn(&str) -> bool) -> &mut Self {
        self.until(what, |terminal| wanted(&terminal.contents()))
    }

    /// Waits until the terminal meets a condition.
    pub fn until(&mut self, what: &str, wanted: impl Fn(&Self) -> bool) -> &mut Self {
        let deadline = Instant::now() + PATIENCE;
        while !wanted(self) {
            let left = deadline.saturating_duration_since(Instant::now());
            match self.output.recv_timeout(left) {
                Ok(bytes) => self.take(&bytes),
                Err(RecvTimeoutError::Timeout) => {
                    panic!("waited in vain for {what} on:\n{}", self.contents())
                }
                Err(RecvTimeoutError::Disconnected) => {
                    panic!("the program ended before {what} on:\n{}", self.contents())
                }
            }
        }
        self
    }

    /// The text on the screen.
    pub fn contents(&self) -> String {
        self.screen.screen().contents()
    }

    /// Everything written to the terminal so far.
    pub fn raw(&self) -> String {
        String::from_utf8_lossy(&self.raw).into_owned()
    }

    /// Whether the alternate screen is shown.
    pub fn in_alternate_screen(&self) -> bool {
        self.screen.screen().alternate_screen()
    }

    /// Whether the cursor is hidden.
    pub fn cursor_is_hidden(&self) -> bool {
        self.screen.screen().hide_cursor()
    }

    /// Changes the size of the terminal.
    pub fn resize(&mut self, columns: u16, rows: u16) -> &mut Self {
        let size = PtySize {
            rows,
            cols: columns,
            pixel_width: 0,
            pixel_height: 0,
        };
        let master = self.master.as_ref().expect("the terminal is there");
        master.resize(size).expect("it takes a size");
        self.screen.screen_mut().set_size(
            rows.try_into().expect("rows"),
            columns.try_into().expect("columns"),
        );
        self
    }

    /// Kills the program without a chance to clean up.
    pub fn kill(&mut self) {
        // The terminal's own way begins with a signal that the program handles.
        let process = Pid::from_raw(self.process_id().cast_signed());
        kill(process, Signal::SIGKILL).expect("it runs");
        self.child.wait().expect("it was started");
    }

    /// The process id of the program.
    pub fn process_id(&self) -> u32 {
        self.child.process_id().expect("it runs")
    }

    /// Closes the terminal, as when an SSH connection breaks, and waits for the end of the program.
    pub fn go_away(&mut self) {
        // The reader ends at the next bytes of the program, which come from its running clock.
        self.pace.gone.store(true, Ordering::SeqCst);
        self.keyboard = Box::new(std::io::sink());
        self.master = None;
        let deadline = Instant::now() + PATIENCE;
        while self.child.try_wait().expect("it was started").is_none() {
            assert!(Instant::now() < deadline, "waited in vain for the end");
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Waits for the end of the program and returns its exit code.
    pub fn end(&mut self) -> u32 {
        let deadline = Instant::now() + PATIENCE;
        loop {
            let left = deadline.saturating_duration_since(Instant::now());
            match self.output.recv_timeout(left) {
                Ok(bytes) => self.take(&bytes),
                Err(RecvTimeoutError::Disconnected) => break,
                Err(RecvTimeoutError::Timeout) => {
                    panic!("waited in vain for the end on:\n{}", self.contents())
                }
            }
        }
        self.child.wait().expect("it was started").exit_code()
    }

    /// Handles output of the program, and answers its queries to the terminal.
    fn take(&mut self, bytes: &[u8]) {
        let question = b"\x1b[5n";
        let read_before = self.raw.len().saturating_sub(question.len() - 1);
        self.raw.extend_from_slice(bytes);
        let asked = self.raw[read_before..]
            .windows(question.len())
            .filter(|part| *part == question);
        for _ in 0..asked.count() {
            // A program that has ended reads nothing more.
            drop(self.keyboard.write_all(b"\x1b[0n"));
        }
        self.screen.process(bytes);
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        // A failed test must not leave a process behind; an error means that it has ended already.
        self.pace.set(None);
        drop(self.child.kill());
    }
}
