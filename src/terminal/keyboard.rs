//! Input from the terminal, read by a separate thread.

use std::fs::File;
use std::io::{self, Read as _};
use std::os::fd::AsFd as _;
use std::time::Duration;

use tokio::sync::mpsc;
use tokio::time::Instant;

use super::input::{Input, Parser};

/// How long the rest of a sequence may take; after that, its first byte counts as the Esc key.
const SEQUENCE_PATIENCE: Duration = Duration::from_millis(50);
/// The maximum number of pieces of input in the queue; faster input is held back.
const PIECES: usize = 16;

/// The input of the terminal. Dropping it does not end its thread, which stays in its last read
/// until the program ends.
pub struct Keyboard {
    pieces: mpsc::Receiver<Vec<u8>>,
    parser: Parser,
    /// When the parser began to wait for the end of an incomplete sequence; `None` if none is
    /// incomplete.
    waiting_since: Option<Instant>,
}

impl Keyboard {
    /// Starts reading standard input.
    ///
    /// # Errors
    /// Standard input is closed.
    pub fn open() -> io::Result<Self> {
        let mut terminal = File::from(io::stdin().as_fd().try_clone_to_owned()?);
        let (sender, pieces) = mpsc::channel(PIECES);
        std::thread::spawn(move || {
            let mut buffer = [0; 1024];
            loop {
                match terminal.read(&mut buffer) {
                    Ok(0) => break,
                    Err(error) if error.kind() != io::ErrorKind::Interrupted => break,
                    Err(_) => {}
                    Ok(count) => {
                        if sender.blocking_send(buffer[..count].to_vec()).is_err() {
                            break;
                        }
                    }
                }
            }
        });
        Ok(Self {
            pieces,
            parser: Parser::default(),
            waiting_since: None,
        })
    }

    /// The next input; `None` when the terminal is gone. A cancelled wait loses no input.
    pub async fn next(&mut self) -> Option<Input> {
        loop {
            if let Some(input) = self.ready() {
                return Some(input);
            }
            if !self.parser.is_waiting() {
                let piece = self.pieces.recv().await?;
                self.parser.push(&piece);
                continue;
            }
            let since = *self.waiting_since.get_or_insert_with(Instant::now);
            let piece = tokio::time::timeout_at(since + SEQUENCE_PATIENCE, self.pieces.recv());
            if let Ok(piece) = piece.await {
                self.parser.push(&piece?);
                continue;
            }
            self.waiting_since = None;
            if let Some(input) = self.parser.give_up() {
                return Some(input);
            }
        }
    }

    /// The next input, if one is available already.
    pub fn ready(&mut self) -> Option<Input> {
        loop {
            if let Some(input) = self.parser.next_input() {
                self.waiting_since = None;
                return Some(input);
            }
            let piece = self.pieces.try_recv().ok()?;
            self.parser.push(&piece);
        }
    }
}
