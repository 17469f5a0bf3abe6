//! The running console: terminal, keys, time and the session, brought together.
//!
//! One loop feeds events to [`App::update`], carries out its effects, and draws when something visible has changed and
//! the terminal is ready for a frame. Time, telemetry and missions run independently of drawing.
//!
//! # How the parts fit
//! - A flight's life: `options` (how the console starts), `begin` (a session starts, and whether it counts for a
//!   career), `session`, `pause` (pauses, Ctrl-Z, the speed-up), `pace` (how often the console ticks), `replaying`.
//! - In: `input` (keys, answers and sizes of the terminal), `signals`, `api` (programs), `class` (the other side of a
//!   class), `crew` (the other side of a crew). Out: `sight` holds what the
//!   terminal must show next, `plain` prints lines without a screen.
//! - How effects are carried out: `effects`, with `orders` (to vehicles), `files`, `missions` (the missions on offer)
//!   and `career` (profile, purchases).
//! - Simulation in the background: `trials` (drafts), `ghost` (another flight of the mission), `last_rehearsal` (the
//!   recording that `replay rehearsal` plays).
//! - `drive` runs the console without terminal and user, for measurements.

use std::collections::{BTreeMap, VecDeque};
use std::io;
use std::sync::Arc;
use std::time::Duration;

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use crate::app::effect::{ClassEffect, CrewEffect, ProgramAnswer, ProgramFault, SituationEffect};
use crate::app::event::{Event, TerminalEvent, VehicleEvent};
use crate::app::room::{hangar, messages};
use crate::app::state::{ClassRole, CrewPart};
use crate::app::{App, Setup};
use crate::campaign::{Attempt, Stake};
use crate::config::Config;
use crate::fleet::FleetClock;
use crate::replay::Replay;
use crate::store::{History, UnsavedDrafts};
use crate::terminal::{Keyboard, Screen};
use crate::text;
use crate::text::Text;
use crate::ui;

mod api;
mod begin;
mod career;
mod class;
mod crew;
mod drive;
mod effects;
mod files;
mod ghost;
mod input;
mod last_rehearsal;
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
mod situations;
mod trials;

pub use api::ApiOptions;
use api::Programs;
use begin::SeedSources;
use career::Careers;
use class::ClassEnd;
pub use class::ClassOptions;
use crew::CrewEnd;
pub use crew::CrewOptions;
pub use drive::drive;
use input::hear_last_answer;
pub use missions::mission_faults;
use missions::{Tries, listings};
pub use options::{ConsoleOptions, Opening, Preferences};
use pace::Pace;
use session::{RecordPoint, RunningSession, SessionEnding, SessionPlan};
use sight::Sight;
use signals::Signals;
use situations::Situation;

/// The time between checks for changes by other consoles and commands.
const LOOK_EVERY: Duration = Duration::from_secs(2);

/// Runs the console until the user quits or the terminal disappears.
///
/// # Errors
/// There is no terminal, it has disappeared, or flights could not be stored.
pub async fn run(options: ConsoleOptions) -> anyhow::Result<()> {
    let mut signals = Signals::new()?;
    let mut programs = Programs::open(options.api.as_ref())?;
    let mut class = open_class(&options).await?;
    let mut crew = open_crew(&options)?;
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
            happened = signals.next() => console.obey(happened, &mut screen, &mut keyboard).await?,
            () = pace.tick() => console.tick().await,
            arrival = programs.next() => console.serve(&mut programs, arrival).await,
            arrival = class.next() => console.attend(&mut class, arrival).await,
            arrival = crew.next() => console.attend_crew(&mut crew, arrival).await,
            input = keyboard.next() => match input {
                Some(input) => console.hear_all(input, &mut screen, &mut keyboard).await,
                None => console.is_cut_off = true,
            },
            () = tokio::time::sleep(frame.unwrap_or_default()), if frame.is_some() => {}
        }
        if console.is_cut_off {
            break;
        }
        programs.tell(console.app.state());
        screen.keep_frames(console.app.state().class_role().is_screen_watched());
        console.draw(&mut screen).await?;
        let picture = || screen.frame().map(ui::picture);
        class.carry_out(std::mem::take(&mut console.class_work));
        console.tell_class(&mut class, &picture);
        console.tell_crew(&mut crew);
    }
    console.close().await;
    console.tell_crew(&mut crew);
    console.hand_in_rest(&mut class).await;
    class.close().await;
    crew.close().await;
    programs.close(console.app.state()).await;
    hear_last_answer(&mut screen, &mut keyboard).await;
    console.require_joined()?;
    console.require_stored()
}

/// Opens the console's end of a class, if it has a part in one.
///
/// # Errors
/// The desk cannot be opened.
async fn open_class(options: &ConsoleOptions) -> anyhow::Result<ClassEnd> {
    let opened = ClassEnd::open(options).await;
    opened.map_err(|fault| anyhow::anyhow!(options.look.text(&Text::from(&fault))))
}

/// Opens the console's end of a crew, if it has a part in one.
///
/// # Errors
/// The crew cannot be opened, or flights are not recorded.
fn open_crew(options: &ConsoleOptions) -> anyhow::Result<CrewEnd> {
    let opened = CrewEnd::open(options);
    opened.map_err(|fault| anyhow::anyhow!(options.look.text(&fault)))
}

/// The command history, oldest first. A history that cannot be read adds a warning.
fn earlier_lines(history: Option<&History>, warnings: &mut Vec<Text>) -> Vec<String> {
    let Some(history) = history else {
        return Vec::new();
    };
    history.read().unwrap_or_else(|error| {
        let (path, error) = (history.path().display(), Text::from(&error));
        warnings.push(text!(
            "history-unreadable",
            path = path.to_string(),
            error = error
        ));
        Vec::new()
    })
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
    replaying: Option<Replay>,
    /// When to count the replay's messages again.
    next_traffic: Duration,
    /// The stake and the seed of the current session.
    attempt: Attempt,
    /// The profiles; `None` if they are not used or not available.
    careers: Option<Careers>,
    /// When to check for changes by other consoles and commands.
    next_look: Duration,
    /// The situations of this session, by their places.
    situations: BTreeMap<usize, Situation>,
    /// A situation that is being captured or recalled.
    situation_work: VecDeque<SituationEffect>,
    /// Whether time is stopped until the trainee leaves the brief.
    awaits_reader: bool,
    /// The outcome of a program's line, until the program is answered.
    program_answer: Option<Result<ProgramAnswer, ProgramFault>>,
    /// Events to handle, oldest first.
    inbox: VecDeque<Event>,
    /// The previous session, while it ends.
    ending: SessionEnding,
    warnings: Vec<Text>,
    /// The last history line written to its file.
    kept: Option<String>,
    over: bool,
    /// Whether the terminal has disappeared or a signal ends the program: the trainee did not
    /// abandon the flight.
    is_cut_off: bool,
    /// The work on another flight of the mission, to show beside this one.
    ghost: Option<ghost::GhostWork>,
    /// The drafts that are being flown in simulation.
    trial: Option<trials::TrialWork>,
    /// Work for the console's end of a class.
    class_work: Vec<ClassEffect>,
    /// Work for the console's end of a crew.
    crew_work: Vec<CrewEffect>,
    /// Why the crew could not be joined, which ends the program.
    crew_refusal: Option<Text>,
    /// The record of the flight before, with its end, for the members of a crew.
    record_before: Option<RecordPoint>,
    /// The unsaved drafts; `None` without a folder for data.
    drafts: Option<UnsavedDrafts>,
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
            documents: Arc::clone(&preferences.documents),
            locale: Arc::clone(&options.look.locale),
            theme: options.look.theme.name().to_owned(),
            themes: preferences.themes.names().map(str::to_owned).collect(),
            missions,
            tries,
            stock: missions::stock(),
            history,
            has_ardupilot: options.ardupilot.is_some() && options.backend.ardupilot.is_none(),
            has_rooms,
            class: options
                .class
                .as_ref()
                .map_or(ClassRole::None, ClassOptions::role),
            crew: options
                .crew
                .as_ref()
                .map_or(CrewPart::None, CrewOptions::part),
        };
        let drafts = preferences.data.as_deref().map(UnsavedDrafts::new);
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
            situations: BTreeMap::new(),
            situation_work: VecDeque::new(),
            awaits_reader: false,
            ending: SessionEnding::default(),
            program_answer: None,
            inbox: VecDeque::new(),
            over: false,
            is_cut_off: false,
            ghost: None,
            trial: None,
            class_work: Vec::new(),
            crew_work: Vec::new(),
            crew_refusal: None,
            record_before: None,
            drafts,
        };
        console.open_careers(course, false);
        console
    }

    async fn begin(&mut self) {
        // A mission that starts at once is checked against the opened career.
        self.show_reviews();
        self.take_in().await;
        self.open().await;
        self.restore_drafts();
        self.list_exams();
        // In reverse order, because the last warning stays on the last line of the screen.
        for warning in std::mem::take(&mut self.warnings).into_iter().rev() {
            self.post(Event::Failed(warning));
        }
        self.take_in().await;
    }

    async fn open(&mut self) {
        let outcome = match self.options.opening.clone() {
            Opening::Home => return,
            Opening::Mission(mission) => {
                let seeds = SeedSources::default();
                self.launch(mission, Stake::Graded, seeds).await
            }
            Opening::Free => self.start_afresh(SessionPlan::Free(None)).await,
            Opening::Replay(path) => self.open_replay(&path, false),
            Opening::Connect(addresses) => self.start_afresh(SessionPlan::Connect(addresses)).await,
        };
        self.tell_failure(outcome);
    }

    /// Draws a frame if something has changed and the terminal is ready for it.
    async fn draw(&mut self, screen: &mut Screen) -> io::Result<()> {
        if self.sight.next_frame_in(self.app.state(), screen) != Some(Duration::ZERO) {
            return Ok(());
        }
        self.sight.prepare(screen)?;
        let slow = screen.slow_bytes_per_s().map(|rate| rate as u32);
        if slow != self.app.state().display().slow_line() {
            self.feed(TerminalEvent::SlowLine(slow)).await;
        }
        self.sight.draw(self.app.state(), screen)
    }

    async fn tick(&mut self) {
        self.note_stop();
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
        self.take_trial();
        let Some(running) = &mut self.running else {
            return;
        };
        let expected = self.app.state().session().expected();
        for event in running.collect(expected, now) {
            self.log(&event);
            self.feed(event).await;
        }
        self.conduct(now).await;
        self.look_at_messages(now).await;
        let wanted = hangar::wanted(self.app.state());
        if let Some(running) = &mut self.running {
            running.look_at_output(wanted, now);
        }
        // The mission sees the telemetry just collected.
        let flown = match &mut self.running {
            Some(running) => running.fly(now, self.app.state().session()),
            None => Vec::new(),
        };
        for event in flown {
            self.feed(event).await;
        }
        let running = self.running.as_mut();
        if let Some(record) = running.and_then(|running| running.take_complete_record(now)) {
            self.note_record(record);
        }
        if let Some(finished) = self
            .running
            .as_mut()
            .and_then(RunningSession::take_finished)
        {
            self.settle(finished);
        }
        self.take_in().await;
        self.finish_situations().await;
        self.take_in().await;
    }

    async fn conduct(&mut self, now: Duration) {
        let events = match &mut self.running {
            Some(running) => running.conduct(now, self.app.state().session()),
            None => Vec::new(),
        };
        for event in events {
            self.log(&event);
            self.feed(event).await;
        }
    }

    /// Writes the outcome of commands to the log.
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
        let request = messages::traffic_request(self.app.state());
        if let Some(running) = &mut self.running
            && let Some(event) = running.inspect(request.as_ref(), now)
        {
            self.feed(event).await;
        }
    }
}
