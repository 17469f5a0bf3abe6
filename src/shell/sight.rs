//! The console on the terminal: its look, and what waits for the next frame.

use std::io;
use std::sync::Arc;
use std::time::Duration;

use crate::app::State;
use crate::terminal::Screen;
use crate::ui::{self, Look};

/// The look, what was drawn with it, and what waits for the next frame.
pub(super) struct Sight {
    pub look: Look,
    /// The revision of the state that was drawn last.
    drawn: Option<u64>,
    /// A new limit for frames, until the screen has heard of it.
    pub fps: Option<u8>,
    /// Whether the bell is to ring.
    pub bell: bool,
    /// Desktop notifications that are to be shown.
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

    /// The terminal no longer shows what was drawn.
    pub fn forget(&mut self) {
        self.drawn = None;
    }

    /// How long the frame that is wanted has to wait; `None` if none is wanted or only the terminal can tell.
    pub fn next_frame_in(&self, state: &State, screen: &mut Screen) -> Option<Duration> {
        let wanted = self.bell || !self.notes.is_empty() || self.drawn != Some(state.revision());
        wanted.then(|| screen.next_frame_in()).flatten()
    }

    /// Tells the screen what goes before the next frame.
    ///
    /// # Errors
    /// The terminal has gone away.
    pub fn prepare(&mut self, screen: &mut Screen) -> io::Result<()> {
        if let Some(fps) = self.fps.take() {
            screen.limit(fps);
        }
        // A bell that waits is one bell, however often it was to ring.
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
    /// The terminal has gone away.
    pub fn draw(&mut self, state: &State, screen: &mut Screen) -> io::Result<()> {
        self.drawn = Some(state.revision());
        self.look.locale = Arc::clone(state.locale());
        self.look.symbols = state.config().symbols.unwrap_or_default();
        screen.entitle(&ui::window_title(state, &self.look))?;
        screen.draw(|frame| ui::draw(state, &self.look, frame))
    }
}
