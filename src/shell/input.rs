//! What the terminal and the operating system send: keys, answers, sizes, signals.

use std::time::Duration;

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::Console;
use super::signals::Happened;
use crate::app::event::{Event, TerminalEvent};
use crate::terminal::input::Input;
use crate::terminal::{self, Keyboard, Screen};
use crate::text;

/// The maximum number of keys handled before a frame, so that a flood of them cannot block the screen.
const KEYS_PER_FRAME: usize = 64;
/// How long the program waits for answers from the terminal when it ends.
const LAST_ANSWER_PATIENCE: Duration = Duration::from_millis(500);

impl Console {
    /// Reacts to a signal.
    pub(super) async fn obey(
        &mut self,
        happened: Happened,
        screen: &mut Screen,
        keyboard: &mut Keyboard,
    ) -> anyhow::Result<()> {
        match happened {
            Happened::End => self.is_cut_off = true,
            Happened::Resized => self.measure().await,
            Happened::Stopped => {
                hear_last_answer(screen, keyboard).await;
                screen.leave();
                terminal::stop();
            }
            Happened::Continued => {
                screen.take_again()?;
                self.measure().await;
                self.sight.forget();
            }
        }
        Ok(())
    }

    /// Handles an input and those that have arrived in the meantime, which share one frame.
    pub(super) async fn hear_all(
        &mut self,
        input: Input,
        screen: &mut Screen,
        keyboard: &mut Keyboard,
    ) {
        self.hear(input, screen).await;
        for _ in 0..KEYS_PER_FRAME {
            let Some(input) = keyboard.ready() else {
                break;
            };
            self.hear(input, screen).await;
        }
    }

    async fn hear(&mut self, input: Input, screen: &mut Screen) {
        if !matches!(input, Input::Answer) {
            screen.pressed();
        }
        match input {
            Input::Answer => screen.answered(),
            Input::Key(key) if is_suspend(key) => {
                self.suspend();
                self.take_in().await;
            }
            Input::Key(key) => self.feed(TerminalEvent::Key(key)).await,
            Input::Paste(text) => self.feed(TerminalEvent::Paste(text)).await,
            Input::Click { column, row } => {
                let chosen = self.sight.look.hits.at(column, row);
                let event =
                    chosen.map_or(TerminalEvent::Click { column, row }, TerminalEvent::Choose);
                self.feed(event).await;
            }
        }
    }

    /// Checks the size of the terminal.
    pub(super) async fn measure(&mut self) {
        if let Ok((columns, rows)) = crossterm::terminal::size() {
            self.feed(TerminalEvent::Resize { columns, rows }).await;
        }
    }

    fn suspend(&mut self) {
        if !self.app.state().session().may_be_stopped() {
            self.post(Event::Answer(text!("terminal-no-pause")));
        } else if terminal::can_be_suspended() {
            terminal::suspend_group();
        } else {
            self.post(Event::Answer(text!("terminal-no-shell")));
        }
    }
}

/// Reads the terminal's last answer, which would otherwise be typed into the shell.
pub(super) async fn hear_last_answer(screen: &mut Screen, keyboard: &mut Keyboard) {
    let answer = async {
        while screen.expects_answer() {
            match keyboard.next().await {
                None => break,
                Some(Input::Answer) => screen.answered(),
                Some(_) => {}
            }
        }
    };
    // After this time, the terminal counts as stalled.
    drop(tokio::time::timeout(LAST_ANSWER_PATIENCE, answer).await);
}

fn is_suspend(key: KeyEvent) -> bool {
    key.code == KeyCode::Char('z') && key.modifiers == KeyModifiers::CONTROL
}
