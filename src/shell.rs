//! The running console: terminal, keys, time and the session, brought together.
//!
//! One loop feeds [`App::update`] with events, carries its effects out, and draws when something visible has
//! changed and the terminal can take a frame. Time, telemetry and missions go on at their own pace.

use std::collections::VecDeque;
use std::io;
use std::sync::Arc;
use std::time::Duration;

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use crate::app::event::{Event, TerminalEvent, VehicleEvent};
use crate::app::room::{hangar, messages};
use crate::app::{App, Setup};
use crate::campaign::{Attempt, Stake};
use crate::config::Config;
use crate::fleet::FleetClock;
use crate::replay::Replay;
use crate::store::History;
use crate::terminal::input::Input;
use crate::terminal::{self, Keyboard, Screen};
use crate::text;
use crate::text::Text;

mod begin;
mod career;
mod drive;
mod effects;
mod files;
mod ghost;
mod missions;
mod options;
mod orders;
mod pace;
mod pause;
pub mod plain;
mod replaying;
mod session;
mod sight;
mod signals;

use career::Careers;
pub use drive::drive;
use missions::{Tries, listings};
pub use options::{ConsoleOptions, Opening, Preferences};
use pace::Pace;
use session::{RunningSession, SessionEnding, SessionPlan};
use sight::Sight;
use signals::{Happened, Signals};

/// How often what other consoles and commands have stored is looked for.
const LOOK_EVERY: Duration = Duration::from_secs(2);

/// Keys that are taken before a frame is drawn, so that a flood of them cannot hold up the screen.
const KEYS_PER_FRAME: usize = 64;
/// How long the end of the program waits for what the terminal has yet to answer.
const LAST_ANSWER_PATIENCE: Duration = Duration::from_millis(500);

/// Runs the console until the user leaves it or the terminal goes away.
///
/// # Errors
/// There is no terminal, or it has gone away.
pub async fn run(options: ConsoleOptions) -> anyhow::Result<()> {
    let mut signals = Signals::new()?;
    let mut screen = Screen::open(
        options.preferences.config.fps,
        options.preferences.config.mouse,
    )?;
    let mut console = Console::new(options, true);
    let mut pace = Pace::of(console.speedup());
    console.measure().await;
    console.draw(&mut screen).await?;
    console.begin().await;
    let mut keyboard = Keyboard::open()?;
    while !console.over {
        let frame = console
            .sight
            .next_frame_in(console.app.state(), &mut screen);
        pace.keep(console.speedup());
        tokio::select! {
            biased;
            happened = signals.next() => match happened {
                Happened::End => {
                    console.is_cut_off = true;
                    break;
                }
                Happened::Resized => console.measure().await,
                Happened::Stopped => {
                    hear_last_answer(&mut screen, &mut keyboard).await;
                    screen.leave();
                    terminal::stop();
                }
                Happened::Continued => {
                    screen.take_again()?;
                    console.measure().await;
                    console.sight.forget();
                }
            },
            () = pace.tick() => console.tick().await,
            input = keyboard.next() => {
                let Some(input) = input else {
                    console.is_cut_off = true;
                    break;
                };
                console.hear(input, &mut screen).await;
                // What was typed meanwhile is one frame with it.
                for _ in 0..KEYS_PER_FRAME {
                    let Some(input) = keyboard.ready() else {
                        break;
                    };
                    console.hear(input, &mut screen).await;
                }
            },
            () = tokio::time::sleep(frame.unwrap_or_default()), if frame.is_some() => {}
        }
        console.draw(&mut screen).await?;
    }
    console.close().await;
    hear_last_answer(&mut screen, &mut keyboard).await;
    Ok(())
}

/// An answer of the terminal that comes after us would be typed into the shell.
async fn hear_last_answer(screen: &mut Screen, keyboard: &mut Keyboard) {
    let answer = async {
        while screen.expects_answer() {
            match keyboard.next().await {
                None => break,
                Some(Input::Answer) => screen.answered(),
                Some(_) => {}
            }
        }
    };
    // Past that it is no use: the terminal has stalled.
    drop(tokio::time::timeout(LAST_ANSWER_PATIENCE, answer).await);
}

/// The lines that were entered before, oldest first. A history that cannot be read is one warning more.
fn earlier_lines(history: Option<&History>, warnings: &mut Vec<Text>) -> Vec<String> {
    let Some(history) = history else {
        return Vec::new();
    };
    history.read().unwrap_or_else(|error| {
        let (path, error) = (history.path().display(), error.to_string());
        warnings.push(text!(
            "history-unreadable",
            path = path.to_string(),
            error = error
        ));
        Vec::new()
    })
}

fn is_suspend(key: KeyEvent) -> bool {
    key.code == KeyCode::Char('z') && key.modifiers == KeyModifiers::CONTROL
}

fn key(code: KeyCode) -> TerminalEvent {
    TerminalEvent::Key(KeyEvent::new(code, KeyModifiers::NONE))
}

struct Console {
    options: ConsoleOptions,
    clock: FleetClock,
    app: App,
    sight: Sight,
    running: Option<RunningSession>,
    /// The recording that is replayed instead.
    replaying: Option<Replay>,
    /// When the messages of the recording are looked at again.
    next_traffic: Duration,
    /// The try at what runs.
    attempt: Attempt,
    /// Who trains here; `None` where profiles are not kept or cannot be had.
    careers: Option<Careers>,
    /// When to look again at what others have changed.
    next_look: Duration,
    /// Whether everything stands still until the brief is left.
    awaits_reader: bool,
    /// Events that are to be taken in, oldest first.
    inbox: VecDeque<Event>,
    /// What is left of the session before.
    ending: SessionEnding,
    /// What has to be said at the start.
    warnings: Vec<Text>,
    /// The last line of the history that its file has.
    kept: Option<String>,
    over: bool,
    /// Whether the terminal has gone away, or the program is told to end: the trainee has not left the flight.
    is_cut_off: bool,
    /// Another flight of the mission that is being read or flown.
    ghost: Option<ghost::GhostWork>,
}

impl Console {
    fn new(options: ConsoleOptions, has_rooms: bool) -> Self {
        let preferences = &options.preferences;
        let (missions, course, doubles) = listings();
        let mut warnings = preferences.warnings.clone();
        warnings.extend(doubles);
        let tries = match &preferences.runs {
            Some(runs) => missions::current(runs.all_tries(None), &missions),
            None => Tries::new(),
        };
        let history = earlier_lines(preferences.history.as_ref(), &mut warnings);
        let kept = history.last().cloned();
        let setup = Setup {
            config: Config {
                symbols: Some(options.look.symbols),
                ..preferences.config.clone()
            },
            keymap: preferences.keymap.clone(),
            locale: Arc::clone(&options.look.locale),
            theme: options.look.theme.name().to_owned(),
            themes: preferences.themes.names().map(str::to_owned).collect(),
            missions,
            tries,
            stock: missions::stock(),
            history,
            has_ardupilot: options.ardupilot.is_some() && options.backend.ardupilot.is_none(),
            has_rooms,
        };
        let mut console = Self {
            warnings,
            kept,
            sight: Sight::new(options.look.clone()),
            options,
            clock: FleetClock::start(),
            app: App::new(setup),
            running: None,
            replaying: None,
            next_traffic: Duration::ZERO,
            attempt: Attempt::practice(None),
            careers: None,
            next_look: LOOK_EVERY,
            awaits_reader: false,
            ending: SessionEnding::default(),
            inbox: VecDeque::new(),
            over: false,
            is_cut_off: false,
            ghost: None,
        };
        console.open_careers(course);
        console
    }

    async fn begin(&mut self) {
        // A mission that is flown at once is checked against the career that was opened.
        self.show_reviews();
        self.take_in().await;
        self.open().await;
        // The first one last, because it is the one that stays on the last line of the screen.
        for warning in std::mem::take(&mut self.warnings).into_iter().rev() {
            self.post(Event::Failed(warning));
        }
        self.take_in().await;
    }

    async fn open(&mut self) {
        let outcome = match self.options.opening.clone() {
            Opening::Home => return,
            Opening::Mission(mission) => self.launch(mission, Stake::Graded, None).await,
            Opening::Free => self.start_afresh(SessionPlan::Free(None)).await,
            Opening::Replay(path) => self.open_replay(&path, false),
            Opening::Connect(addresses) => self.start_afresh(SessionPlan::Connect(addresses)).await,
        };
        self.tell_failure(outcome);
    }

    /// Draws if something changed and the terminal can take a frame.
    async fn draw(&mut self, screen: &mut Screen) -> io::Result<()> {
        if self.sight.next_frame_in(self.app.state(), screen) != Some(Duration::ZERO) {
            return Ok(());
        }
        self.sight.prepare(screen)?;
        let slow = screen.slow_bytes_per_s().map(|rate| rate as u32);
        if slow != self.app.state().slow_line() {
            self.feed(TerminalEvent::SlowLine(slow)).await;
        }
        self.sight.draw(self.app.state(), screen)
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

    /// The size of the terminal may have changed.
    async fn measure(&mut self) {
        if let Ok((columns, rows)) = crossterm::terminal::size() {
            self.feed(TerminalEvent::Resize { columns, rows }).await;
        }
    }

    fn suspend(&mut self) {
        if terminal::can_be_suspended() {
            terminal::suspend_group();
        } else {
            self.post(Event::Answer(text!("terminal-no-shell")));
        }
    }

    async fn tick(&mut self) {
        self.wait_for_reader();
        let now = self.clock.now();
        if self.next_look <= now {
            self.next_look = now + LOOK_EVERY;
            self.look_for_changes();
        }
        let wall = self.clock.wall();
        self.feed(Event::Tick { now, wall }).await;
        self.go_on_replaying(wall).await;
        self.take_ghost();
        let Some(running) = &mut self.running else {
            return;
        };
        for event in running.collect(now) {
            self.log(&event);
            self.feed(event).await;
        }
        self.conduct(now).await;
        self.look_at_messages(now).await;
        let wanted = hangar::wanted(self.app.state());
        if let Some(running) = &mut self.running {
            running.look_at_output(wanted, now);
        }
        // The mission sees what has just been collected.
        let flown = match &mut self.running {
            Some(running) => running.fly(now, self.app.state().session()),
            None => Vec::new(),
        };
        for event in flown {
            self.feed(event).await;
        }
        if let Some(finished) = self
            .running
            .as_mut()
            .and_then(RunningSession::take_finished)
        {
            self.settle(&finished);
        }
        self.take_in().await;
    }

    async fn conduct(&mut self, now: Duration) {
        let events = match &mut self.running {
            Some(running) => running.conduct(now, self.app.state().session().vehicles()),
            None => Vec::new(),
        };
        for event in events {
            self.log(&event);
            self.feed(event).await;
        }
    }

    /// Keeps what became of commands in the log.
    fn log(&self, event: &Event) {
        let Event::Vehicle(VehicleEvent::Row(row)) = event else {
            return;
        };
        if row.state.is_final()
            && let Some(entry) = self.app.state().session().ledger().entry(row.entry)
        {
            let (vehicle, line, state) = (row.vehicle, &entry.line, row.state);
            tracing::info!("vehicle {vehicle}: {line}: {state}");
        }
    }

    async fn look_at_messages(&mut self, now: Duration) {
        let wanted = messages::wanted(self.app.state());
        if let Some(running) = &mut self.running
            && let Some(event) = running.inspect(wanted.as_ref(), now)
        {
            self.feed(event).await;
        }
    }
}
