//! The console's terminal: taken over at the start, and always restored.
//!
//! A separate thread writes the frames, and no more of them than the line can carry (`pace`). A terminal that reads
//! slowly, or not at all, therefore blocks nothing, and shows the newest state when it reads again.
//!
//! # How the parts fit
//! - In: `keyboard` reads bytes in a thread, `input` makes keys, pastes and answers of them. Out: `backend` draws
//!   frames, `escape_codes` writes colours that every terminal understands, `writer` writes in a thread.
//! - What the terminal can show: `capability`. When the next frame may be drawn: `pace`. Ctrl-Z: `suspend`.

use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;
use std::time::{Duration, Instant};

use crossterm::terminal::{
    EndSynchronizedUpdate, EnterAlternateScreen, LeaveAlternateScreen, disable_raw_mode,
    enable_raw_mode,
};
use crossterm::{cursor, event, execute, queue};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::{Terminal, TerminalOptions, Viewport};

mod backend;
mod capability;
mod escape_codes;
pub mod input;
mod keyboard;
mod pace;
mod suspend;
mod writer;

use backend::FrameBackend;
pub use capability::Environment;
pub use keyboard::Keyboard;
use pace::Pace;
pub use suspend::{can_be_suspended, stop, suspend_group};
use writer::{FrameWriter, Traffic};

/// How long the program waits at its end for a terminal that does not read.
const LAST_PATIENCE: Duration = Duration::from_millis(500);
/// DSR: the terminal answers as soon as it has read everything before it.
const QUESTION: &[u8] = b"\x1b[5n";
/// Switches on reports of button presses, with coordinates beyond 223.
const MOUSE_ON: &[u8] = b"\x1b[?1000h\x1b[?1006h";
const MOUSE_OFF: &[u8] = b"\x1b[?1006l\x1b[?1000l";
/// XTWINOPS: the terminal saves the title of its window; the second sequence restores it.
const KEEP_TITLE: &[u8] = b"\x1b[22;2t";
const TAKE_TITLE_BACK: &[u8] = b"\x1b[23;2t";

/// Whether the terminal has been taken over; ensures that it is restored exactly once.
static TAKEN: AtomicBool = AtomicBool::new(false);
/// Whether the title of the window has been saved, and is to be restored with the terminal.
static KEPT_TITLE: AtomicBool = AtomicBool::new(false);

/// The screen of the console.
pub struct Screen {
    terminal: Terminal<FrameBackend>,
    traffic: Arc<Traffic>,
    pace: Pace,
    clock: Instant,
    mouse: bool,
    /// Whether the terminal's window has a title that may be set, and the last title that was set.
    has_title: bool,
    title: String,
    /// A copy of the last frame, for others; `None` unless somebody wants it.
    kept: Option<Buffer>,
}

impl Screen {
    /// Takes the terminal over: raw mode, alternate screen, no cursor. A later panic restores it, prints its message
    /// and ends the program.
    ///
    /// # Errors
    /// Standard output is not a terminal or cannot be written.
    pub fn open(frames_per_s: u8, mouse: bool) -> io::Result<Self> {
        // crossterm handles NO_COLOR by resetting bold and reverse, too, which alerts need. The theme removes the
        // colours instead.
        crossterm::style::force_color_output(true);
        enable_raw_mode()?;
        TAKEN.store(true, Ordering::SeqCst);
        give_back_on_panic();
        Self::set_up(frames_per_s, mouse).inspect_err(|_| give_back())
    }

    fn set_up(frames_per_s: u8, mouse: bool) -> io::Result<Self> {
        let traffic = Arc::new(Traffic::default());
        let writer = FrameWriter::to_terminal(Arc::clone(&traffic))?;
        let mut screen = Self {
            terminal: Terminal::new(FrameBackend::new(writer))?,
            traffic,
            pace: Pace::new(frames_per_s),
            clock: Instant::now(),
            mouse,
            has_title: Environment::of_process().has_window_title(),
            title: String::new(),
            kept: None,
        };
        screen.enter()?;
        Ok(screen)
    }

    /// Limits the frames per second.
    pub fn limit(&mut self, frames_per_s: u8) {
        self.pace.limit(frames_per_s);
    }

    fn enter(&mut self) -> io::Result<()> {
        let writer = self.terminal.backend_mut();
        queue!(writer, EnterAlternateScreen, event::EnableBracketedPaste)?;
        if self.mouse {
            writer.write_all(MOUSE_ON)?;
        }
        if self.has_title {
            writer.write_all(KEEP_TITLE)?;
            KEPT_TITLE.store(true, Ordering::SeqCst);
            self.title.clear();
        }
        writer.forget_cursor();
        // The first query is answered at once, even over a slow line, and shows that the terminal answers.
        self.send()
    }

    /// A screen of a given size without a terminal, for measurements: frames are drawn and counted, but not shown.
    ///
    /// # Errors
    /// The terminal library refuses the size.
    pub fn nowhere(columns: u16, rows: u16) -> io::Result<Self> {
        crossterm::style::force_color_output(true);
        let traffic = Arc::new(Traffic::default());
        let writer = FrameWriter::nowhere(Arc::clone(&traffic));
        let viewport = Viewport::Fixed(Rect::new(0, 0, columns, rows));
        let options = TerminalOptions { viewport };
        Ok(Self {
            terminal: Terminal::with_options(FrameBackend::new(writer), options)?,
            traffic,
            pace: Pace::unread(),
            clock: Instant::now(),
            mouse: false,
            has_title: false,
            title: String::new(),
            kept: None,
        })
    }

    /// How long to wait before the next frame; `None` until the operating system has accepted the
    /// last one.
    pub fn next_frame_in(&mut self) -> Option<Duration> {
        let now = self.clock.elapsed();
        for written in self.traffic.take_written() {
            self.pace.written(now, written.took, written.bytes);
        }
        self.traffic.is_idle().then(|| self.pace.wait(now))
    }

    /// Notes a key press: its result is drawn at once.
    pub fn pressed(&mut self) {
        self.pace.pressed();
    }

    /// Notes an answer from the terminal: everything drawn before it has been read.
    pub fn answered(&mut self) {
        self.pace.answered(self.clock.elapsed());
    }

    /// The bytes per second of a slow line; `None` while the line keeps up.
    pub fn slow_bytes_per_s(&self) -> Option<f64> {
        self.pace.slow_bytes_per_s()
    }

    /// Whether an answer of the terminal is pending; the next program would read it as key presses.
    pub fn expects_answer(&self) -> bool {
        self.pace.expects_answer()
    }

    /// The number of bytes written for the terminal so far.
    pub fn bytes(&self) -> u64 {
        self.traffic.bytes()
    }

    /// Keeps a copy of each frame from now on, or no longer.
    pub fn keep_frames(&mut self, keeps: bool) {
        if keeps != self.kept.is_some() {
            self.kept = keeps.then(Buffer::default);
        }
    }

    /// The copy of the last frame; `None` if none has been drawn since the copies are kept.
    pub fn frame(&self) -> Option<&Buffer> {
        self.kept.as_ref().filter(|frame| !frame.area.is_empty())
    }

    /// Draws one frame; only the changes are written.
    ///
    /// # Errors
    /// The terminal is gone.
    pub fn draw(&mut self, render: impl FnOnce(&mut ratatui::Frame)) -> io::Result<()> {
        let frame = self.terminal.draw(render)?;
        if let Some(kept) = &mut self.kept {
            kept.clone_from(frame.buffer);
        }
        if self.terminal.backend_mut().end_frame()? {
            self.send()?;
        }
        Ok(())
    }

    /// Sends the written bytes, with a query at the end if due.
    fn send(&mut self) -> io::Result<()> {
        let now = self.clock.elapsed();
        let asks = self.pace.asks(now);
        let before = self.traffic.bytes();
        let writer = self.terminal.backend_mut();
        if asks {
            writer.write_all(QUESTION)?;
        }
        Write::flush(writer)?;
        self.pace.drawn(now, self.traffic.bytes() - before, asks);
        Ok(())
    }

    /// Sets the title of the window (OSC 2), unless it has that title already.
    ///
    /// # Errors
    /// The terminal is gone.
    pub fn entitle(&mut self, title: &str) -> io::Result<()> {
        if !self.has_title || self.title == title {
            return Ok(());
        }
        title.clone_into(&mut self.title);
        let writer = self.terminal.backend_mut();
        write!(writer, "\x1b]2;{title}\x1b\\")?;
        Write::flush(writer)
    }

    /// Rings the terminal's bell, after the output drawn so far.
    ///
    /// # Errors
    /// The terminal is gone.
    pub fn ring(&mut self) -> io::Result<()> {
        let writer = self.terminal.backend_mut();
        writer.write_all(b"\x07")?;
        Write::flush(writer)
    }

    /// Shows a desktop notification through the terminal: by OSC 9 (iTerm2, kitty, `WezTerm`, Windows Terminal), or by
    /// OSC 777 where the terminal is known to need that. The Linux console would show either as garbage.
    ///
    /// # Errors
    /// The terminal is gone.
    pub fn notify(&mut self, note: &str) -> io::Result<()> {
        let term = std::env::var("TERM").unwrap_or_default();
        let writer = self.terminal.backend_mut();
        match term.as_str() {
            "linux" | "dumb" | "" => return Ok(()),
            term if term.starts_with("rxvt") || term.starts_with("foot") => {
                // A semicolon would end the title or the text, so it becomes a comma.
                let note = note.replace(';', ",");
                write!(writer, "\x1b]777;notify;sortie;{note}\x1b\\")?;
            }
            _ => write!(writer, "\x1b]9;sortie: {note}\x1b\\")?,
        }
        Write::flush(writer)
    }

    /// Restores the terminal, until [`take_again`](Self::take_again).
    pub fn leave(&mut self) {
        self.let_go();
    }

    /// Takes the terminal over again, after [`leave`](Self::leave) or after a stop by a signal; the next frame is
    /// drawn completely.
    ///
    /// # Errors
    /// The terminal is gone.
    pub fn take_again(&mut self) -> io::Result<()> {
        // The shell may have changed the mode meanwhile, without the terminal library.
        disable_raw_mode()?;
        enable_raw_mode()?;
        TAKEN.store(true, Ordering::SeqCst);
        self.enter()?;
        self.terminal.clear()
    }

    fn let_go(&self) {
        // The last frame must not follow the sequences that restore the terminal. A terminal that does not read must
        // not delay the end: its unread output is discarded.
        if !self.traffic.wait_until_written(LAST_PATIENCE) {
            suspend::discard_output();
        }
        give_back();
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        self.let_go();
    }
}

/// Restores the terminal, once; errors are ignored because they cannot be reported.
fn give_back() {
    if TAKEN.swap(false, Ordering::SeqCst) {
        // A write to a terminal that does not read may never end.
        let (done, written) = mpsc::channel();
        std::thread::spawn(move || {
            let mut terminal = io::stdout();
            drop(terminal.write_all(MOUSE_OFF));
            if KEPT_TITLE.swap(false, Ordering::SeqCst) {
                // For terminals that cannot restore a title, an empty title is set first.
                drop(terminal.write_all(b"\x1b]2;\x1b\\"));
                drop(terminal.write_all(TAKE_TITLE_BACK));
            }
            drop(execute!(
                terminal,
                EndSynchronizedUpdate,
                event::DisableBracketedPaste,
                LeaveAlternateScreen,
                cursor::Show
            ));
            let _ = done.send(());
        });
        let _ = written.recv_timeout(LAST_PATIENCE);
        drop(disable_raw_mode());
    }
}

/// Restores the terminal on any panic: a panic in a background task would otherwise leave it
/// unusable.
fn give_back_on_panic() {
    let default = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        give_back();
        default(panic);
        std::process::exit(101);
    }));
}
