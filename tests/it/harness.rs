//! A console without terminal, clock or vehicles: tests press keys and read the screen.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use sortie::alert::AlertKind;
use sortie::app::State;
use sortie::app::effect::Effect;
use sortie::app::event::{Event, ReplayEvent, SessionEvent, Started, TerminalEvent, VehicleEvent};
use sortie::app::state::{Activity, ReplayView};
use sortie::app::{App, Setup};
use sortie::ledger::{EntryId, RowState, RowUpdate};
use sortie::notice::{Notice, NoticeSource};
use sortie::text::{Language, Locale, Text};
use sortie::ui::{self, Hits, Look, Theme};
use sortie::vehicle::{Severity, Vehicle};

use crate::fixtures;

/// The console, and its last requests to the shell.
#[derive(Clone)]
pub struct Console {
    app: App,
    pub effects: Vec<Effect>,
}

impl Console {
    /// A console on the home screen, with one mission.
    pub fn new() -> Self {
        Self::set_up(|_| {})
    }

    /// A console on the home screen, with another setup.
    pub fn set_up(change: impl FnOnce(&mut Setup)) -> Self {
        let mut setup = Setup {
            missions: vec![fixtures::listing()],
            themes: Theme::names().map(str::to_owned).collect(),
            ..Setup::default()
        };
        change(&mut setup);
        let mut console = Self {
            app: App::new(setup),
            effects: Vec::new(),
        };
        console.at(0);
        console
    }

    /// A console on the home screen, with the texts in a language.
    pub fn in_language(language: Language) -> Self {
        Self::set_up(|setup| setup.locale = Arc::new(Locale::new(language)))
    }

    /// A console in free flight with `count` vehicles on the ground.
    pub fn flying(count: u16) -> Self {
        Self::new().in_flight(count)
    }

    /// Begins free flight with `count` vehicles on the ground.
    pub fn in_flight(mut self, count: u16) -> Self {
        self.start(Activity::Free);
        for id in 1..=count {
            self.vehicle(fixtures::parked(id));
        }
        self
    }

    /// The state of the console, for reading.
    pub fn state(&self) -> &State {
        self.app.state()
    }

    pub fn start(&mut self, activity: Activity) {
        self.hear(SessionEvent::Started(Box::new(Self::started(activity))));
    }

    /// Starts the session again, as the key `r` does.
    pub fn start_again(&mut self, activity: Activity) {
        self.hear(SessionEvent::Started(Box::new(Started {
            is_again: true,
            ..Self::started(activity)
        })));
    }

    /// Opens a recording of a session.
    pub fn replay(&mut self, view: ReplayView, activity: Activity) -> &mut Self {
        self.hear(ReplayEvent::Opened {
            view: Box::new(view),
            started: Box::new(Self::started(activity)),
        })
    }

    fn started(activity: Activity) -> Started {
        Started {
            mission: matches!(activity, Activity::Mission { .. })
                .then(|| Box::new(fixtures::listing())),
            activity,
            places: BTreeMap::new(),
            areas: Vec::new(),
            processes: None,
            speedup: 1.0,
            is_again: false,
        }
    }

    pub fn hear(&mut self, event: impl Into<Event>) -> &mut Self {
        self.effects = self.app.update(event);
        self
    }

    /// Sets the console's clock, in seconds.
    pub fn at(&mut self, seconds: u64) -> &mut Self {
        let now = Duration::from_secs(seconds);
        self.hear(Event::Tick { now, wall: now })
    }

    pub fn vehicle(&mut self, vehicle: Vehicle) -> &mut Self {
        self.hear(VehicleEvent::Telemetry(Arc::new(vehicle)))
    }

    /// Presses a key: a character, or a name such as `enter` or `ctrl-c`.
    pub fn press(&mut self, name: &str) -> &mut Self {
        let plain = |code| KeyEvent::new(code, KeyModifiers::NONE);
        let key = match name {
            "enter" => plain(KeyCode::Enter),
            "esc" => plain(KeyCode::Esc),
            "tab" => plain(KeyCode::Tab),
            "shift-tab" => plain(KeyCode::BackTab),
            "up" => plain(KeyCode::Up),
            "down" => plain(KeyCode::Down),
            "left" => plain(KeyCode::Left),
            "right" => plain(KeyCode::Right),
            "end" => plain(KeyCode::End),
            "home" => plain(KeyCode::Home),
            "page-up" => plain(KeyCode::PageUp),
            "page-down" => plain(KeyCode::PageDown),
            "backspace" => plain(KeyCode::Backspace),
            "space" => plain(KeyCode::Char(' ')),
            _ => {
                let last = name.chars().last().expect("a key has a name");
                let control = name.strip_prefix("ctrl-").is_some();
                let modifiers = if control {
                    KeyModifiers::CONTROL
                } else {
                    KeyModifiers::NONE
                };
                KeyEvent::new(KeyCode::Char(last), modifiers)
            }
        };
        self.hear(TerminalEvent::Key(key))
    }

    /// Types characters.
    pub fn write(&mut self, text: &str) -> &mut Self {
        for c in text.chars() {
            self.press(&c.to_string());
        }
        self
    }

    /// Gives a line on the command line.
    pub fn give(&mut self, line: &str) -> &mut Self {
        self.press(":").write(line).press("enter")
    }

    /// Changes a vehicle's row of the newest command.
    pub fn row(&mut self, vehicle: u16, state: RowState, explanation: Option<&str>) -> &mut Self {
        self.explained_row(vehicle, state, explanation.map(Text::from))
    }

    /// Changes a vehicle's row of the newest command, with a translated explanation.
    pub fn explained_row(
        &mut self,
        vehicle: u16,
        state: RowState,
        explanation: Option<Text>,
    ) -> &mut Self {
        let newest = self.state().session().ledger().entries().len() as u32 - 1;
        self.hear(VehicleEvent::Row(RowUpdate {
            entry: EntryId(newest),
            vehicle,
            state,
            tries: 1,
            at: self.state().now(),
            explanation,
        }))
    }

    pub fn notice(&mut self, severity: Severity, vehicle: Option<u16>, text: &str) -> &mut Self {
        self.hear(Event::Notice(Notice {
            at: self.state().now(),
            vehicle,
            severity,
            kind: vehicle.map(|_| AlertKind::of_status_text(text)),
            source: match vehicle {
                Some(_) => NoticeSource::Vehicle,
                None => NoticeSource::Program,
            },
            text: text.into(),
        }))
    }

    /// The targets of the only command that the last event has sent.
    pub fn sent_to(&self) -> Vec<u16> {
        match self.effects.as_slice() {
            [Effect::Order { order, .. }] => order.targets.clone(),
            other => panic!("no single command went out: {other:?}"),
        }
    }

    /// The screen as text, with blanks at the ends of lines cut.
    pub fn screen(&self, width: u16, height: u16) -> String {
        self.drawn(width, height).0
    }

    /// Clicks on the first place that shows a text; returns whether the click has an effect.
    pub fn click(&mut self, text: &str) -> bool {
        let (screen, hits) = self.drawn(120, 40);
        let lines = screen.lines().enumerate();
        let mut found = lines.filter_map(|(row, line)| {
            let column = line.split_once(text)?.0.chars().count();
            Some((column as u16, row as u16))
        });
        let (column, row) = found.next().expect("the text is on the screen");
        let action = hits.at(column, row);
        if let Some(action) = action {
            self.hear(TerminalEvent::Choose(action));
        }
        action.is_some()
    }

    fn drawn(&self, width: u16, height: u16) -> (String, Hits) {
        let backend = TestBackend::new(width, height);
        let mut terminal = Terminal::new(backend).expect("a test terminal");
        let look = Look {
            locale: Arc::clone(self.state().locale()),
            ..Look::default()
        };
        terminal
            .draw(|frame| ui::draw(self.state(), &look, frame))
            .expect("a test terminal");
        let buffer = terminal.backend().buffer();
        let rows = buffer.content.chunks(usize::from(width.max(1)));
        let lines = rows.map(|row| {
            let line: String = row.iter().map(ratatui::buffer::Cell::symbol).collect();
            line.trim_end().to_owned()
        });
        (lines.collect::<Vec<_>>().join("\n"), look.hits)
    }
}
