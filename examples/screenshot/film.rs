//! Flies a mission with its reference pilot, and shows the flight on a console.
//!
//! The flight uses no clock, no socket and no terminal: identical sources give identical pictures.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use anyhow::anyhow;
use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use sortie::app::event::{Event, LinkEvent, SessionEvent, Started, TerminalEvent, VehicleEvent};
use sortie::app::state::{Activity, LinkSummary};
use sortie::app::{App, Setup};
use sortie::campaign::Stake;
use sortie::diagnostic::Diagnostic;
use sortie::exercise::{Exercise, read_script};
use sortie::ledger::{EntryId, LedgerEntry, LedgerRow, RowUpdate};
use sortie::mission::Mission;
use sortie::ui::{self, Look, Role};

use super::svg;

/// The file name, without its extension, of both the mission and its reference pilot.
const MISSION: &str = "05-night-search";
const SEED: u64 = 1;
/// The mission time of the pictures in flight: some people have been found, and kits are on their way.
const IN_FLIGHT: Duration = Duration::from_secs(172);
/// How long the debrief ignores keys after it opens, with a margin.
const CALM: Duration = Duration::from_secs(10);
/// The interval at which the console receives news of the flight.
const TICK: Duration = Duration::from_millis(500);
const COLUMNS: u16 = 120;
const ROWS: u16 = 40;

/// A picture, and its path relative to the root of the repository.
pub struct Picture {
    pub path: &'static str,
    pub svg: String,
}

/// Draws all pictures.
///
/// # Errors
///
/// The mission or its pilot cannot be read.
pub fn pictures(root: &Path) -> anyhow::Result<Vec<Picture>> {
    let mut film = Film::begin(root)?;
    film.fly_until(IN_FLIGHT);
    let fly = film.picture("docs/images/fly.svg", 'F');
    let map = film.picture("docs/images/map.svg", 'M');
    film.fly_until(Duration::MAX);
    film.calm_down();
    let debrief = film.picture("docs/images/debrief.svg", 'D');
    let truth = film.picture("docs/images/truth.svg", 'm');
    Ok(vec![fly, map, debrief, truth])
}

struct Film {
    exercise: Exercise,
    app: App,
    told: BTreeMap<EntryId, Vec<LedgerRow>>,
    next: Duration,
}

impl Film {
    fn begin(root: &Path) -> anyhow::Result<Self> {
        let source = fs::read_to_string(root.join(format!("missions/{MISSION}.toml")))?;
        let mission = Arc::new(Mission::parse(&source).map_err(first_fault)?);
        let pilot = fs::read_to_string(root.join(format!("missions/pilots/{MISSION}.pilot")))?;
        let script = read_script(&pilot, &mission).map_err(first_fault)?;
        let mut film = Self {
            exercise: Exercise::new(Arc::clone(&mission), SEED, script, Vec::new()),
            app: App::new(Setup::default()),
            told: BTreeMap::new(),
            next: Duration::ZERO,
        };
        film.tell(TerminalEvent::Resize {
            columns: COLUMNS,
            rows: ROWS,
        });
        film.tell(SessionEvent::Started(Box::new(Started {
            activity: Activity::Mission {
                id: mission.id.clone(),
                title: mission.title.clone(),
                stake: Stake::Graded,
            },
            mission: Some(Box::new(mission.listing())),
            places: mission.places(),
            areas: mission.areas(),
            processes: None,
            speedup: 1.0,
            is_again: false,
        })));
        film.tell(LinkEvent::Summaries(vec![LinkSummary {
            name: "simulator".into(),
            state: "up".into(),
            up: true,
            ..LinkSummary::default()
        }]));
        film.press('F');
        Ok(film)
    }

    fn tell(&mut self, event: impl Into<Event>) {
        // The exercise carries out the effects; its pilot has given the same lines.
        drop(self.app.update(event));
    }

    fn press(&mut self, key: char) {
        let key = KeyEvent::new(KeyCode::Char(key), KeyModifiers::NONE);
        self.tell(TerminalEvent::Key(key));
    }

    /// Flies until a mission time or the end of the mission, and passes the events to the console.
    fn fly_until(&mut self, time: Duration) {
        while self.exercise.now() < time && !self.exercise.is_over() {
            self.exercise.step();
            if self.exercise.now() >= self.next {
                self.next += TICK;
                self.tell_all();
            }
        }
        self.tell_all();
        if self.exercise.is_over() {
            let report = self.exercise.report();
            self.tell(SessionEvent::MissionEnded(Box::new(report)));
        }
    }

    /// Advances time until the debrief accepts keys.
    fn calm_down(&mut self) {
        let now = self.exercise.now() + CALM;
        self.tell(Event::Tick { now, wall: now });
    }

    fn tell_all(&mut self) {
        let now = self.exercise.now();
        self.tell(Event::Tick { now, wall: now });
        for vehicle in self.exercise.vehicles().clone().into_values() {
            self.tell(VehicleEvent::Telemetry(vehicle));
        }
        self.tell_orders();
        for notice in self.exercise.take_notices() {
            self.tell(notice);
        }
        let progress = self.exercise.flight().progress();
        self.tell(SessionEvent::Mission(Box::new(progress)));
    }

    /// Passes the pilot's lines and their outcomes to the console.
    fn tell_orders(&mut self) {
        let entries: Vec<LedgerEntry> = self.exercise.ledger().entries().cloned().collect();
        for entry in entries {
            if !self.told.contains_key(&entry.id) {
                self.tell(TerminalEvent::Line(entry.line.clone()));
            }
            let before = self.told.insert(entry.id, entry.rows.clone());
            let before = before.unwrap_or_default();
            for row in entry.rows.into_iter().filter(|row| !before.contains(row)) {
                self.tell(VehicleEvent::Row(update(entry.id, row)));
            }
        }
    }

    /// The picture of the screen that a key opens.
    fn picture(&mut self, path: &'static str, key: char) -> Picture {
        self.press(key);
        let mut terminal =
            Terminal::new(TestBackend::new(COLUMNS, ROWS)).unwrap_or_else(|error| match error {});
        let look = Look::default();
        let drawn = terminal.draw(|frame| ui::draw(self.app.state(), &look, frame));
        drawn.unwrap_or_else(|error| match error {});
        let ground = look.style(Role::Text).bg.unwrap_or_default();
        Picture {
            path,
            svg: svg::of(terminal.backend().buffer(), ground),
        }
    }
}

fn update(entry: EntryId, row: LedgerRow) -> RowUpdate {
    RowUpdate {
        entry,
        vehicle: row.vehicle,
        state: row.state,
        tries: row.tries,
        at: row.changed_at,
        explanation: row.explanation,
    }
}

fn first_fault(faults: Vec<Diagnostic>) -> anyhow::Error {
    let fault = faults.into_iter().next();
    anyhow!(fault.map_or_else(String::new, |fault| fault.message.to_string()))
}
