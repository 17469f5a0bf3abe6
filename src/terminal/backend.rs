//! The backend that frames are drawn with.

use std::io::{self, Write};

use crossterm::queue;
use crossterm::terminal::{BeginSynchronizedUpdate, EndSynchronizedUpdate};
use ratatui::backend::{Backend, ClearType, CrosstermBackend, WindowSize};
use ratatui::buffer::Cell;
use ratatui::layout::{Position, Size};

use super::writer::FrameWriter;

/// Crossterm's backend, which writes only changes and sends no queries.
///
/// The terminal library hides the cursor and resets all styles with every frame, even if nothing has changed. It
/// queries the cursor's position whenever it clears the screen, as after a resize, and would wait for an answer that
/// the console's own input thread reads. The console does not need the position.
pub(super) struct FrameBackend {
    inner: CrosstermBackend<FrameWriter>,
    /// Whether any part of the current frame has been written.
    begun: bool,
    /// The last cursor sent to the terminal.
    cursor: Cursor,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Cursor {
    Unknown,
    Hidden,
    At(Position),
}

impl FrameBackend {
    /// A backend with this writer.
    pub fn new(writer: FrameWriter) -> Self {
        Self {
            inner: CrosstermBackend::new(writer),
            begun: false,
            cursor: Cursor::Unknown,
        }
    }

    /// Ends the frame; returns `false` if there was nothing to write.
    pub fn end_frame(&mut self) -> io::Result<bool> {
        if std::mem::take(&mut self.begun) {
            queue!(self.inner, EndSynchronizedUpdate)?;
            return Ok(true);
        }
        Ok(false)
    }

    /// Marks the cursor's position as unknown.
    pub fn forget_cursor(&mut self) {
        self.cursor = Cursor::Unknown;
    }

    fn begin(&mut self) -> io::Result<()> {
        if !std::mem::replace(&mut self.begun, true) {
            queue!(self.inner, BeginSynchronizedUpdate)?;
        }
        Ok(())
    }
}

impl Write for FrameBackend {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.inner.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Write::flush(&mut self.inner)
    }
}

impl Backend for FrameBackend {
    type Error = io::Error;

    fn draw<'a, I>(&mut self, content: I) -> io::Result<()>
    where
        I: Iterator<Item = (u16, u16, &'a Cell)>,
    {
        let mut content = content.peekable();
        if content.peek().is_none() {
            return Ok(());
        }
        self.begin()?;
        // Drawing moves the cursor, but a hidden one stays hidden.
        if self.cursor != Cursor::Hidden {
            self.cursor = Cursor::Unknown;
        }
        self.inner.draw(content)
    }

    fn hide_cursor(&mut self) -> io::Result<()> {
        if self.cursor == Cursor::Hidden {
            return Ok(());
        }
        self.cursor = Cursor::Hidden;
        self.begin()?;
        self.inner.hide_cursor()
    }

    fn show_cursor(&mut self) -> io::Result<()> {
        // The position is set later, and the cursor is shown with it.
        Ok(())
    }

    fn get_cursor_position(&mut self) -> io::Result<Position> {
        Ok(Position::ORIGIN)
    }

    fn set_cursor_position<P: Into<Position>>(&mut self, position: P) -> io::Result<()> {
        let position = position.into();
        if self.cursor == Cursor::At(position) {
            return Ok(());
        }
        self.cursor = Cursor::At(position);
        self.begin()?;
        self.inner.show_cursor()?;
        self.inner.set_cursor_position(position)
    }

    fn clear(&mut self) -> io::Result<()> {
        self.begin()?;
        self.inner.clear()
    }

    fn clear_region(&mut self, region: ClearType) -> io::Result<()> {
        self.begin()?;
        self.inner.clear_region(region)
    }

    fn size(&self) -> io::Result<Size> {
        self.inner.size()
    }

    fn window_size(&mut self) -> io::Result<WindowSize> {
        self.inner.window_size()
    }

    fn flush(&mut self) -> io::Result<()> {
        // A frame is sent as a whole, at its end.
        Ok(())
    }
}
