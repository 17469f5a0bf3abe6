//! A program in a pseudo-terminal of 120x40.

use std::fs::File;
use std::io::{self, Read as _, Write as _};
use std::os::fd::OwnedFd;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{self, Receiver};
use std::time::{Duration, Instant};

use nix::pty::{Winsize, openpty};
use nix::sys::termios::{SetArg, cfmakeraw, tcgetattr, tcsetattr};

/// The console's query to a terminal.
const QUESTION: &[u8] = b"\x1b[5n";
/// A terminal's answer to the query: it is ready.
const ANSWER: &[u8] = b"\x1b[0n";

/// A program in a terminal. It ends with this value.
pub(super) struct Terminal {
    child: Child,
    file: File,
    output: Receiver<Shown>,
}

/// What a program has written to its terminal, and when.
pub(super) struct Shown {
    pub at: Instant,
    pub bytes: Vec<u8>,
}

/// This program, in English, with a home of its own and without the settings of its user.
pub(super) fn own_program(home: &Path) -> io::Result<Command> {
    let mut command = Command::new(std::env::current_exe()?);
    command.env_clear();
    command.envs(std::env::var_os("PATH").map(|path| ("PATH", path)));
    command.env("HOME", home).env("TERM", "xterm-256color");
    command.env("LC_ALL", "C.UTF-8");
    Ok(command)
}

impl Terminal {
    pub fn begin(mut command: Command) -> io::Result<Self> {
        let size = Winsize {
            ws_row: 40,
            ws_col: 120,
            ws_xpixel: 0,
            ws_ypixel: 0,
        };
        let pty = openpty(&size, None)?;
        // The terminal is raw from the beginning: otherwise the kernel's own echo would be measured.
        let mut mode = tcgetattr(&pty.slave)?;
        cfmakeraw(&mut mode);
        tcsetattr(&pty.slave, SetArg::TCSANOW, &mode)?;
        let slave = || -> io::Result<Stdio> { Ok(OwnedFd::try_clone(&pty.slave)?.into()) };
        let child = command
            .stdin(slave()?)
            .stdout(slave()?)
            .stderr(slave()?)
            .spawn()?;
        let file = File::from(pty.master);
        let mut read = file.try_clone()?;
        let (sender, output) = mpsc::channel();
        std::thread::spawn(move || {
            let mut buffer = vec![0; 65536];
            while let Ok(count @ 1..) = read.read(&mut buffer) {
                let shown = Shown {
                    at: Instant::now(),
                    bytes: buffer[..count].to_vec(),
                };
                if sender.send(shown).is_err() {
                    break;
                }
            }
        });
        Ok(Self {
            child,
            file,
            output,
        })
    }

    /// The id of the program's process.
    pub fn process(&self) -> u32 {
        self.child.id()
    }

    pub fn press(&mut self, keys: &[u8]) -> io::Result<()> {
        self.file.write_all(keys)
    }

    /// The next output, if any arrives in time. The program's queries to its terminal are answered: without answers the
    /// console draws with delays.
    pub fn next(&mut self, patience: Duration) -> Option<Shown> {
        let shown = self.output.recv_timeout(patience).ok()?;
        let mut parts = shown.bytes.windows(QUESTION.len());
        if parts.any(|part| part == QUESTION) {
            drop(self.press(ANSWER));
        }
        Some(shown)
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        drop(self.child.kill());
        drop(self.child.wait());
    }
}
