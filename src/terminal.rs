//! The terminal that the console draws on: taken over at the start, given back whatever happens.
//!
//! Frames are written by a thread of their own. A terminal that reads slowly, or not at all, therefore
//! holds up nothing: the console skips frames until the last one has gone out.

use std::fs::File;
use std::io::{self, Write};
use std::os::fd::AsFd as _;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;

use crossterm::terminal::{
    BeginSynchronizedUpdate, EndSynchronizedUpdate, EnterAlternateScreen, LeaveAlternateScreen,
    disable_raw_mode, enable_raw_mode,
};
use crossterm::{cursor, event, execute, queue};
use ratatui::Terminal;
use ratatui::backend::CrosstermBackend;

use crate::ui::ColourDepth;

/// Whether the terminal is ours, so that it is given back exactly once.
static TAKEN: AtomicBool = AtomicBool::new(false);

/// The screen of the console.
pub struct Screen {
    terminal: Terminal<CrosstermBackend<FrameWriter>>,
    frames_waiting: Arc<AtomicUsize>,
}

impl Screen {
    /// Takes the terminal over: raw mode, alternate screen, no cursor. A panic anywhere from now on gives it
    /// back, prints its message and ends the program.
    ///
    /// # Errors
    /// Standard output is not a terminal or cannot be written.
    pub fn open() -> io::Result<Self> {
        // crossterm answers NO_COLOR by resetting bold and reverse too, which alarms depend on. The theme
        // takes the colours away instead.
        crossterm::style::force_color_output(true);
        enable_raw_mode()?;
        TAKEN.store(true, Ordering::SeqCst);
        give_back_on_panic();
        execute!(
            io::stdout(),
            EnterAlternateScreen,
            event::EnableBracketedPaste,
            cursor::Hide
        )?;
        let frames_waiting = Arc::new(AtomicUsize::new(0));
        let writer = FrameWriter::start(Arc::clone(&frames_waiting))?;
        Ok(Self {
            terminal: Terminal::new(CrosstermBackend::new(writer))?,
            frames_waiting,
        })
    }

    /// Whether the last frame has gone out, so that another can be drawn.
    pub fn is_ready(&self) -> bool {
        self.frames_waiting.load(Ordering::Acquire) == 0
    }

    /// Draws one frame; only what changed is written.
    ///
    /// # Errors
    /// The terminal is gone.
    pub fn draw(&mut self, render: impl FnOnce(&mut ratatui::Frame)) -> io::Result<()> {
        queue!(self.terminal.backend_mut(), BeginSynchronizedUpdate)?;
        self.terminal.draw(render)?;
        execute!(self.terminal.backend_mut(), EndSynchronizedUpdate)
    }

    /// Forgets what is on the terminal, so that the next frame is drawn whole.
    ///
    /// # Errors
    /// The terminal is gone.
    pub fn redraw(&mut self) -> io::Result<()> {
        self.terminal.clear()
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        give_back();
    }
}

/// Gives the terminal back, once; errors are ignored because nobody is left to hear of them.
fn give_back() {
    if TAKEN.swap(false, Ordering::SeqCst) {
        drop(execute!(
            io::stdout(),
            EndSynchronizedUpdate,
            event::DisableBracketedPaste,
            LeaveAlternateScreen,
            cursor::Show
        ));
        drop(disable_raw_mode());
    }
}

/// A panic in a background task would otherwise leave the screen to a program that goes on half dead.
fn give_back_on_panic() {
    let default = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        give_back();
        default(panic);
        std::process::exit(101);
    }));
}

/// Collects what is written and hands it to the writing thread in large pieces.
pub struct FrameWriter {
    frame: Vec<u8>,
    frames: mpsc::Sender<Vec<u8>>,
    frames_waiting: Arc<AtomicUsize>,
}

impl FrameWriter {
    fn start(frames_waiting: Arc<AtomicUsize>) -> io::Result<Self> {
        // Not `io::stdout()`: its lock would be held during a write to a terminal that does not read.
        let mut terminal = File::from(io::stdout().as_fd().try_clone_to_owned()?);
        let (frames, frames_out) = mpsc::channel::<Vec<u8>>();
        let done = Arc::clone(&frames_waiting);
        std::thread::spawn(move || {
            for frame in frames_out {
                // A write error means that the terminal is gone; the signal or the end of input that comes
                // with it ends the console.
                drop(terminal.write_all(&frame));
                done.fetch_sub(1, Ordering::Release);
            }
        });
        Ok(Self {
            frame: Vec::new(),
            frames,
            frames_waiting,
        })
    }
}

impl Write for FrameWriter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.frame.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        if self.frame.is_empty() {
            return Ok(());
        }
        self.frames_waiting.fetch_add(1, Ordering::AcqRel);
        self.frames
            .send(std::mem::take(&mut self.frame))
            .map_err(|_| io::Error::from(io::ErrorKind::BrokenPipe))
    }
}

/// Rings the terminal's bell.
///
/// # Errors
/// The terminal is gone.
pub fn ring() -> io::Result<()> {
    let mut stdout = io::stdout();
    stdout.write_all(b"\x07")?;
    stdout.flush()
}

/// How many colours the terminal can show, by `NO_COLOR`, `COLORTERM` and `TERM`.
pub fn colour_depth() -> ColourDepth {
    let variable = |name: &str| std::env::var(name).unwrap_or_default();
    if !variable("NO_COLOR").is_empty() {
        return ColourDepth::None;
    }
    let term = variable("TERM");
    match variable("COLORTERM").as_str() {
        "truecolor" | "24bit" => ColourDepth::True,
        _ if term.contains("256color") => ColourDepth::Indexed,
        _ if term == "dumb" => ColourDepth::None,
        _ => ColourDepth::Sixteen,
    }
}
