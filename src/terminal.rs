//! The terminal that the console draws on: taken over at the start, given back whatever happens.
//!
//! Frames are written by a thread of their own. A terminal that reads slowly, or not at all, therefore
//! holds up nothing: the console skips frames until the last one has gone out.

use std::fs::File;
use std::io::{self, Write};
use std::os::fd::AsFd as _;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError, mpsc};
use std::time::Duration;

use crossterm::terminal::{
    BeginSynchronizedUpdate, EndSynchronizedUpdate, EnterAlternateScreen, LeaveAlternateScreen,
    disable_raw_mode, enable_raw_mode,
};
use crossterm::{cursor, event, execute, queue};
use ratatui::layout::Rect;
use ratatui::{Terminal, TerminalOptions, Viewport};

use crate::ui::ColourDepth;

/// How long the end of the program waits for the last frame to be written.
const LAST_FRAME_PATIENCE: Duration = Duration::from_millis(500);

mod backend;

use backend::FrameBackend;

/// Whether the terminal is ours, so that it is given back exactly once.
static TAKEN: AtomicBool = AtomicBool::new(false);

/// The screen of the console.
pub struct Screen {
    terminal: Terminal<FrameBackend>,
    traffic: Arc<Traffic>,
}

/// What goes to the terminal.
#[derive(Debug, Default)]
struct Traffic {
    /// Pieces of frames that the writing thread has yet to write.
    waiting: Mutex<usize>,
    /// Signalled when the last of them has been written.
    written: Condvar,
    /// Bytes made so far.
    bytes: AtomicU64,
}

impl Traffic {
    fn waiting(&self) -> MutexGuard<'_, usize> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until everything has been written, or for the given time.
    fn wait_until_written(&self, patience: Duration) {
        drop(
            self.written
                .wait_timeout_while(self.waiting(), patience, |waiting| *waiting > 0),
        );
    }
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
        Self::set_up().inspect_err(|_| give_back())
    }

    fn set_up() -> io::Result<Self> {
        execute!(
            io::stdout(),
            EnterAlternateScreen,
            event::EnableBracketedPaste,
            cursor::Hide
        )?;
        let traffic = Arc::new(Traffic::default());
        let writer = FrameWriter::to_terminal(Arc::clone(&traffic))?;
        Ok(Self {
            terminal: Terminal::new(FrameBackend::new(writer))?,
            traffic,
        })
    }

    /// A screen of that size that leads nowhere, for measurements: frames are made and counted, not shown.
    ///
    /// # Errors
    /// The terminal library refuses the size.
    pub fn nowhere(columns: u16, rows: u16) -> io::Result<Self> {
        crossterm::style::force_color_output(true);
        let traffic = Arc::new(Traffic::default());
        let writer = FrameWriter {
            frame: Vec::new(),
            frames: None,
            traffic: Arc::clone(&traffic),
        };
        let viewport = Viewport::Fixed(Rect::new(0, 0, columns, rows));
        let terminal =
            Terminal::with_options(FrameBackend::new(writer), TerminalOptions { viewport })?;
        Ok(Self { terminal, traffic })
    }

    /// Whether the last frame has gone out, so that another can be drawn.
    pub fn is_ready(&self) -> bool {
        *self.traffic.waiting() == 0
    }

    /// Bytes made for the terminal so far.
    pub fn bytes(&self) -> u64 {
        self.traffic.bytes.load(Ordering::Relaxed)
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

    /// Rings the terminal's bell, after what has been drawn.
    ///
    /// # Errors
    /// The terminal is gone.
    pub fn ring(&mut self) -> io::Result<()> {
        let writer = self.terminal.backend_mut();
        writer.write_all(b"\x07")?;
        Write::flush(writer)
    }

    /// Asks the terminal for a note on the desktop: by OSC 9 (iTerm2, kitty, `WezTerm`, Windows Terminal), or by
    /// OSC 777 where the terminal is known to want that. The Linux console would show either as garbage.
    ///
    /// # Errors
    /// The terminal is gone.
    pub fn notify(&mut self, note: &str) -> io::Result<()> {
        let term = std::env::var("TERM").unwrap_or_default();
        let writer = self.terminal.backend_mut();
        match term.as_str() {
            "linux" | "dumb" | "" => return Ok(()),
            term if term.starts_with("rxvt") || term.starts_with("foot") => {
                // A semicolon would end the title or the text.
                let note = note.replace(';', ",");
                write!(writer, "\x1b]777;notify;sortie;{note}\x1b\\")?;
            }
            _ => write!(writer, "\x1b]9;sortie: {note}\x1b\\")?,
        }
        Write::flush(writer)
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        // The last frame must not follow what gives the terminal back; a terminal that does not read must
        // not hold up the end either.
        self.traffic.wait_until_written(LAST_FRAME_PATIENCE);
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
struct FrameWriter {
    frame: Vec<u8>,
    /// The writing thread; none where the frames lead nowhere.
    frames: Option<mpsc::Sender<Vec<u8>>>,
    traffic: Arc<Traffic>,
}

impl FrameWriter {
    fn to_terminal(traffic: Arc<Traffic>) -> io::Result<Self> {
        // Not `io::stdout()`: its lock would be held during a write to a terminal that does not read.
        let mut terminal = File::from(io::stdout().as_fd().try_clone_to_owned()?);
        let (frames, frames_out) = mpsc::channel::<Vec<u8>>();
        let shared = Arc::clone(&traffic);
        std::thread::spawn(move || {
            for frame in frames_out {
                // A write error means that the terminal is gone; the signal or the end of input that comes
                // with it ends the console.
                drop(terminal.write_all(&frame));
                *shared.waiting() -= 1;
                shared.written.notify_all();
            }
        });
        Ok(Self {
            frame: Vec::new(),
            frames: Some(frames),
            traffic,
        })
    }
}

impl Write for FrameWriter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.frame.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        let frame = std::mem::take(&mut self.frame);
        self.traffic
            .bytes
            .fetch_add(frame.len() as u64, Ordering::Relaxed);
        match &self.frames {
            Some(frames) if !frame.is_empty() => {
                *self.traffic.waiting() += 1;
                frames
                    .send(frame)
                    .map_err(|_| io::Error::from(io::ErrorKind::BrokenPipe))
            }
            _ => Ok(()),
        }
    }
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
