//! The console without a terminal and without a user.

use std::ops::ControlFlow;
use std::time::Duration;

use crossterm::event::KeyCode;
use ratatui::layout::Size;

use super::pace::TICK;
use super::{Console, ConsoleOptions, key};
use crate::app::event::TerminalEvent;
use crate::terminal::Screen;

/// Runs the console without a terminal and without a user, for measurements. At each of the given
/// times, a line is entered on the command line. After every tick, `look` receives the bytes drawn
/// so far.
///
/// # Errors
/// Drawing failed.
pub async fn drive(
    options: ConsoleOptions,
    size: Size,
    lines: &[(Duration, &str)],
    mut look: impl FnMut(Duration, u64) -> ControlFlow<()>,
) -> anyhow::Result<()> {
    let mut console = Console::new(options, true);
    let mut screen = Screen::nowhere(size.width, size.height)?;
    let resize = TerminalEvent::Resize {
        columns: size.width,
        rows: size.height,
    };
    console.feed(resize).await;
    console.begin().await;
    let mut ticks = tokio::time::interval(TICK);
    let mut lines = lines.iter().peekable();
    loop {
        ticks.tick().await;
        console.tick().await;
        console.draw(&mut screen).await?;
        let now = console.clock.now();
        while let Some((_, line)) = lines.next_if(|(at, _)| *at <= now) {
            console.feed(key(KeyCode::Char(':'))).await;
            console.feed(TerminalEvent::Paste((*line).to_owned())).await;
            console.feed(key(KeyCode::Enter)).await;
        }
        if look(now, screen.bytes()).is_break() {
            return Ok(());
        }
    }
}
