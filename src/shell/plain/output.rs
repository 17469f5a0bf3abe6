//! Lines for standard output, whose reader may be slow or absent.

use std::io::{self, Write as _};
use std::sync::mpsc::{Receiver, SyncSender, channel, sync_channel};
use std::time::Duration;

use crate::config::Symbols;
use crate::notice::sanitised;
use crate::text::Text;
use crate::ui::{Look, ascii};

/// The maximum number of waiting lines; further ones are dropped and counted.
const LINES_WAITING: usize = 2000;
/// How long a program ended by a signal waits for the reader of its output.
const LAST_PATIENCE: Duration = Duration::from_millis(500);

pub struct PlainOutput {
    pieces: SyncSender<String>,
    outcome: Receiver<io::Result<()>>,
    /// Whether lines come from a person, who needs a prompt.
    is_person: bool,
    /// Whether the current line begins with the prompt.
    prompted: bool,
    left_out: u64,
}

impl PlainOutput {
    pub fn start(is_person: bool) -> Self {
        let (pieces, to_write) = sync_channel::<String>(LINES_WAITING);
        let (result, outcome) = channel();
        std::thread::spawn(move || {
            let write = || {
                for piece in &to_write {
                    let mut output = io::stdout().lock();
                    output.write_all(piece.as_bytes())?;
                    output.flush()?;
                }
                Ok(())
            };
            drop(result.send(write()));
        });
        Self {
            pieces,
            outcome,
            is_person,
            prompted: false,
            left_out: 0,
        }
    }

    /// Prints a text on a separate line.
    pub fn say(&mut self, look: &Look, text: &Text) {
        let translated = sanitised(&look.locale.text(text));
        let words = match look.symbols {
            Symbols::Ascii => ascii::line(&translated),
            Symbols::Braille | Symbols::Block => translated,
        };
        let gap = if std::mem::take(&mut self.prompted) {
            "\n"
        } else {
            ""
        };
        let left_out = match self.left_out {
            0 => String::new(),
            count => format!("... {count} ...\n"),
        };
        let line = format!("{gap}{left_out}{words}\n");
        match self.pieces.try_send(line) {
            Ok(()) => self.left_out = 0,
            Err(_) => self.left_out += 1,
        }
    }

    /// Shows a person the prompt, unless it is shown already.
    pub fn prompt(&mut self) {
        if self.is_person && !self.prompted {
            self.prompted = self.pieces.try_send("> ".to_owned()).is_ok();
        }
    }

    /// Notes that the person has ended the prompt's line.
    pub fn line_ended(&mut self) {
        self.prompted = false;
    }

    /// Checks that the output is still open.
    ///
    /// # Errors
    /// The output is closed.
    pub fn check(&self) -> anyhow::Result<()> {
        match self.outcome.try_recv() {
            Ok(outcome) => Ok(outcome?),
            Err(_) => Ok(()),
        }
    }

    /// Writes the remaining lines, with a short time limit if a signal ends the program.
    ///
    /// # Errors
    /// The output is closed.
    pub fn finish(self, told_to_end: bool) -> anyhow::Result<()> {
        if self.prompted {
            // The shell's prompt must start on a new line.
            drop(self.pieces.try_send("\n".to_owned()));
        }
        drop(self.pieces);
        let outcome = if told_to_end {
            self.outcome.recv_timeout(LAST_PATIENCE).ok()
        } else {
            self.outcome.recv().ok()
        };
        Ok(outcome.unwrap_or(Ok(()))?)
    }
}
