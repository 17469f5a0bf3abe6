//! The running console: terminal, keys, time and the session, brought together.
//!
//! One loop feeds [`update`] with events, carries its effects out, and draws when something visible has
//! changed: at most once per tick, so that any amount of telemetry costs one frame.

use std::io;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::Duration;

use crossterm::event::{
    Event as TerminalEvent, EventStream, KeyCode, KeyEvent, KeyEventKind, KeyModifiers,
};
use futures_util::{FutureExt as _, StreamExt as _};
use tokio::signal::unix::{SignalKind, signal};
use tokio::time::MissedTickBehavior;

use crate::app::effect::Effect;
use crate::app::event::Event;
use crate::app::state::{MissionListing, State};
use crate::app::update;
use crate::fleet::{Clock, Unreachable};
use crate::ledger::RowState;
use crate::link::{Address, AddressError};
use crate::mission::Mission;
use crate::session::Order;
use crate::store;
use crate::terminal::Screen;
use crate::ui::{self, Look, Theme};
use crate::vehicle::VehicleId;

mod session;

use session::{Backend, Plan, Running};

/// The time between two ticks: ten frames a second.
const TICK: Duration = Duration::from_millis(100);

/// Keys that are taken before a frame is drawn, so that a flood of them cannot hold up the screen.
const KEYS_PER_FRAME: usize = 64;

/// What the console begins with.
#[derive(Debug, Clone)]
pub enum Opening {
    /// The home screen.
    Home,
    /// A mission.
    Mission(Arc<Mission>),
    /// Free flight.
    Free,
    /// Vehicles that are already there.
    Connect(Vec<Address>),
}

/// How the console is set up.
#[derive(Debug, Clone)]
pub struct Options {
    /// What it begins with.
    pub opening: Opening,
    /// Simulated vehicles in free flight.
    pub vehicles: u8,
    /// What varies missions and simulation.
    pub seed: u64,
    /// Simulated seconds per second.
    pub speedup: f64,
    /// What it looks like.
    pub look: Look,
}

/// Runs the console until the user leaves it or the terminal goes away.
///
/// # Errors
/// There is no terminal, or it has gone away.
pub async fn run(options: Options) -> anyhow::Result<()> {
    let mut console = Console::new(options);
    let mut screen = Screen::open()?;
    if let Ok((columns, rows)) = crossterm::terminal::size() {
        console.feed(Event::Resize { columns, rows }).await;
    }
    console.draw(&mut screen)?;
    console.begin().await;
    let mut keys = EventStream::new();
    let mut ticks = tokio::time::interval(TICK);
    ticks.set_missed_tick_behavior(MissedTickBehavior::Skip);
    let mut terminated = signal(SignalKind::terminate())?;
    let mut hung_up = signal(SignalKind::hangup())?;
    // Ctrl-C is a key in raw mode; these come from elsewhere.
    let mut interrupted = signal(SignalKind::interrupt())?;
    let mut quit = signal(SignalKind::quit())?;
    while !console.over {
        tokio::select! {
            biased;
            _ = terminated.recv() => break,
            _ = hung_up.recv() => break,
            _ = interrupted.recv() => break,
            _ = quit.recv() => break,
            _ = ticks.tick() => {
                console.tick().await;
                console.draw(&mut screen)?;
            }
            event = keys.next() => match event {
                Some(Ok(event)) => {
                    console.hear(event).await;
                    // What was typed meanwhile is one frame with it.
                    for _ in 0..KEYS_PER_FRAME {
                        let Some(Some(Ok(event))) = keys.next().now_or_never() else {
                            break;
                        };
                        console.hear(event).await;
                    }
                    // A key is answered at once, not at the next tick.
                    console.draw(&mut screen)?;
                }
                Some(Err(_)) | None => break,
            },
        }
    }
    Ok(())
}

/// Runs the console without a terminal and without a user, for measurements: at each of the given times a line
/// goes through the command line, and `look` sees the bytes drawn so far after every tick.
///
/// # Errors
/// Drawing failed.
pub async fn drive(
    options: Options,
    size: (u16, u16),
    lines: &[(Duration, &str)],
    mut look: impl FnMut(Duration, u64) -> ControlFlow<()>,
) -> anyhow::Result<()> {
    let mut console = Console::new(options);
    let mut screen = Screen::nowhere(size.0, size.1)?;
    let (columns, rows) = size;
    console.feed(Event::Resize { columns, rows }).await;
    console.begin().await;
    let mut ticks = tokio::time::interval(TICK);
    let mut lines = lines.iter().peekable();
    loop {
        ticks.tick().await;
        console.tick().await;
        console.draw(&mut screen)?;
        let now = console.clock.now();
        while let Some((_, line)) = lines.next_if(|(at, _)| *at <= now) {
            console.feed(key(KeyCode::Char(':'))).await;
            console.feed(Event::Paste((*line).to_owned())).await;
            console.feed(key(KeyCode::Enter)).await;
        }
        if look(now, screen.bytes()).is_break() {
            return Ok(());
        }
    }
}

fn key(code: KeyCode) -> Event {
    Event::Key(KeyEvent::new(code, KeyModifiers::NONE))
}

struct Console {
    options: Options,
    clock: Clock,
    state: State,
    look: Look,
    running: Option<Running>,
    drawn: Option<u64>,
    bell: bool,
    over: bool,
}

impl Console {
    fn new(options: Options) -> Self {
        let themes = Theme::names().map(str::to_owned).collect();
        let state = State::new(listings(), themes, options.look.theme.name().to_owned());
        Self {
            look: options.look.clone(),
            options,
            clock: Clock::start(),
            state,
            running: None,
            drawn: None,
            bell: false,
            over: false,
        }
    }

    async fn begin(&mut self) {
        let plan = match &self.options.opening {
            Opening::Home => return,
            Opening::Mission(mission) => Plan::Mission(Arc::clone(mission)),
            Opening::Free => Plan::Free,
            Opening::Connect(addresses) => Plan::Connect(addresses.clone()),
        };
        if let Err(error) = self.start(plan).await {
            self.feed(Event::Failed(format!("{error:#}").into())).await;
        }
    }

    /// Draws if something changed and the terminal has taken the last frame.
    fn draw(&mut self, screen: &mut Screen) -> io::Result<()> {
        if std::mem::take(&mut self.bell) {
            screen.ring()?;
        }
        let revision = self.state.revision();
        if self.drawn == Some(revision) || !screen.is_ready() {
            return Ok(());
        }
        self.drawn = Some(revision);
        screen.draw(|frame| ui::draw(&self.state, &self.look, frame))
    }

    async fn hear(&mut self, event: TerminalEvent) {
        let event = match event {
            TerminalEvent::Key(key) if key.kind != KeyEventKind::Release => Event::Key(key),
            TerminalEvent::Paste(text) => Event::Paste(text),
            TerminalEvent::Resize(columns, rows) => Event::Resize { columns, rows },
            _ => return,
        };
        self.feed(event).await;
    }

    async fn tick(&mut self) {
        let now = self.clock.now();
        self.feed(Event::Tick { now }).await;
        let Some(running) = &mut self.running else {
            return;
        };
        for event in running.collect(now) {
            self.feed(event).await;
        }
        // The mission sees what has just been collected.
        let flown = match &mut self.running {
            Some(running) => running.fly(now, &self.state.session),
            None => Vec::new(),
        };
        for event in flown {
            self.feed(event).await;
        }
    }

    async fn feed(&mut self, event: Event) {
        for effect in update(&mut self.state, event) {
            self.carry_out(effect).await;
        }
    }

    async fn carry_out(&mut self, effect: Effect) {
        let plan = match effect {
            Effect::Quit => return self.over = true,
            Effect::Bell => return self.bell = true,
            Effect::LeaveSession => return self.running = None,
            Effect::SetTheme(name) => return self.set_theme(&name),
            Effect::AbandonMission => return self.running.iter_mut().for_each(Running::abandon),
            Effect::Command {
                entry,
                targets,
                verb,
                command,
            } => return self.command(&targets, &Order::new(entry, verb, command)),
            Effect::StartMission(id) => store::mission(&id)
                .map(|mission| Plan::Mission(Arc::new(mission)))
                .map_err(Into::into),
            Effect::StartFree => Ok(Plan::Free),
            Effect::Connect(addresses) => parse(&addresses).map(Plan::Connect).map_err(Into::into),
            Effect::RestartMission => match &self.running {
                Some(running) => Ok(running.plan()),
                None => return,
            },
        };
        let outcome = match plan {
            Ok(plan) => self.start(plan).await,
            Err(error) => Err(error),
        };
        if let Err(error) = outcome {
            // Nothing that a failure causes is an effect.
            update(&mut self.state, Event::Failed(format!("{error:#}").into()));
        }
    }

    fn set_theme(&mut self, name: &str) {
        if let Some(theme) = Theme::named(name) {
            self.look.theme = theme.for_colours(crate::terminal::colour_depth());
        }
    }

    /// Gives an order to each target. One that cannot be given ends its row and holds up no other.
    fn command(&mut self, targets: &[VehicleId], order: &Order) {
        for &vehicle in targets {
            let given = match &self.running {
                Some(running) => running.order(vehicle, order.clone()),
                None => Err(Unreachable),
            };
            if let Err(error) = given {
                let now = self.clock.now();
                let row = order.unsent(
                    vehicle,
                    RowState::Refused,
                    format!("not sent: {error}"),
                    now,
                );
                update(&mut self.state, Event::Row(row));
            }
        }
    }

    async fn start(&mut self, plan: Plan) -> anyhow::Result<()> {
        // The old session ends first: the new one may need its ports.
        self.running = None;
        let backend = Backend {
            clock: self.clock,
            vehicles: self.options.vehicles,
            seed: self.options.seed,
            speedup: self.options.speedup,
        };
        let (running, started) = Running::start(plan, &backend).await?;
        self.running = Some(running);
        // Nothing that `Started` causes is an effect.
        update(&mut self.state, Event::Started(Box::new(started)));
        Ok(())
    }
}

fn parse(addresses: &[String]) -> Result<Vec<Address>, AddressError> {
    addresses.iter().map(|address| address.parse()).collect()
}

/// The missions that can be flown; one that is faulty is left out and logged.
fn listings() -> Vec<MissionListing> {
    store::missions()
        .into_iter()
        .filter_map(|source| match Mission::parse(&source.text) {
            Ok(mission) => Some(mission.listing()),
            Err(faults) => {
                for fault in faults {
                    tracing::warn!("{}", fault.one_line(&source.name, &source.text));
                }
                None
            }
        })
        .collect()
}
