//! The console on the terminal: its look, and pending output for the next frame.

use std::io;
use std::sync::Arc;
use std::time::Duration;

use crate::app::State;
use crate::terminal::Screen;
use crate::ui::{self, Look};

/// The look, the last frame, and pending output for the next one.
pub(super) struct Sight {
    pub look: Look,
    /// The revision of the state in the last frame.
    drawn: Option<u64>,
    /// A new frame limit to pass on to the screen, in frames per second.
    pub fps: Option<u8>,
    /// Whether the bell must ring.
    pub bell: bool,
    pub notes: Vec<String>,
}

impl Sight {
    pub fn new(look: Look) -> Self {
        Self {
            look,
            drawn: None,
            fps: None,
            bell: false,
            notes: Vec::new(),
        }
    }

    /// Notes that the terminal no longer shows the last frame.
    pub fn forget(&mut self) {
        self.drawn = None;
    }

    /// How long to wait before the next frame; `None` if no frame is needed, or if it must wait for
    /// the terminal.
    pub fn next_frame_in(&self, state: &State, screen: &mut Screen) -> Option<Duration> {
        let wanted = self.bell || !self.notes.is_empty() || self.drawn != Some(state.revision());
        wanted.then(|| screen.next_frame_in()).flatten()
    }

    /// Passes on the output that precedes the next frame.
    ///
    /// # Errors
    /// The terminal has disappeared.
    pub fn prepare(&mut self, screen: &mut Screen) -> io::Result<()> {
        if let Some(fps) = self.fps.take() {
            screen.limit(fps);
        }
        // Pending rings are merged into one.
        if std::mem::take(&mut self.bell) {
            screen.ring()?;
        }
        for note in std::mem::take(&mut self.notes) {
            screen.notify(&note)?;
        }
        Ok(())
    }

    /// Draws a frame.
    ///
    /// # Errors
    /// The terminal has disappeared.
    pub fn draw(&mut self, state: &State, screen: &mut Screen) -> io::Result<()> {
        self.drawn = Some(state.revision());
        self.look.locale = Arc::clone(state.locale());
        self.look.symbols = state.config().symbols.unwrap_or_default();
        screen.entitle(&ui::window_title(state, &self.look))?;
        screen.draw(|frame| ui::draw(state, &self.look, frame))
    }
}
