//! Threats to a flight, and an instructor's injects.

use super::Flight;
use super::journal::{FlightJournal, JournalEntry, JournalSubject};
use crate::mission::Mission;
use crate::mission::event::Trigger;
use crate::mission::event::demand::Demand;
use crate::mission::event::engine::{Engine, EngineNews};
use crate::mission::event::scope::Sight;
use crate::mission::event::standard::Standard;
use crate::mission::weather::Weather;
use crate::scoring::{AlertLevel, EventKind};
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// A threat that an instructor may trigger.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Inject {
    /// Its name in commands.
    pub name: String,
    /// Its title on the screen.
    pub title: Text,
}

/// The threats of one flight.
#[derive(Debug)]
pub(super) struct Threats {
    engine: Engine,
    failed: bool,
}

impl Threats {
    pub fn new(mission: &Mission, seed: u64) -> Self {
        Self {
            engine: Engine::new(mission, seed),
            failed: false,
        }
    }

    /// Advances events and movers; the weather changes with them.
    pub fn step(
        &mut self,
        mission: &Mission,
        weather: &mut Weather,
        sight: &Sight<'_>,
        journal: &mut FlightJournal,
    ) {
        for news in self.engine.step(mission, weather, sight) {
            self.hear(news, journal);
        }
    }

    fn hear(&mut self, news: EngineNews, journal: &mut FlightJournal) {
        match news {
            EngineNews::Said(text) => {
                let kind = EventKind::MissionEvent;
                journal.say(JournalEntry::new(kind, Severity::Notice, text));
            }
            EngineNews::Alert {
                level,
                text,
                vehicle,
                fact,
            } => {
                let severity = match level {
                    AlertLevel::Caution => Severity::Notice,
                    AlertLevel::Warning => Severity::Warning,
                    AlertLevel::Critical => Severity::Critical,
                };
                let entry = JournalEntry::new(EventKind::Alert, severity, text);
                journal.say(JournalEntry {
                    about: fact.map(JournalSubject::Alert),
                    vehicle,
                    ..entry
                });
            }
            EngineNews::Answered(place) => {
                let Some(fact) = self.engine.alert_facts().get(place) else {
                    return;
                };
                let after_s = fact.answered_after.unwrap_or_default().as_secs_f64();
                let seconds = format!("{after_s:.0}");
                let text = text!("threat-answered", alert = &fact.text, seconds = seconds);
                let entry = JournalEntry::new(EventKind::Answer, Severity::Info, text);
                journal.say(JournalEntry {
                    about: Some(JournalSubject::Alert(place)),
                    ..entry
                });
            }
            EngineNews::Broken(vehicle, (kind, text)) => journal.break_rule(kind, vehicle, &text),
            EngineNews::Failed(text) => {
                let kind = EventKind::Alert;
                journal.say(JournalEntry::new(kind, Severity::Critical, text));
                self.failed = true;
            }
        }
    }

    /// The engine that runs the threats.
    pub fn engine(&self) -> &Engine {
        &self.engine
    }

    /// Whether an event has ended the mission as failed.
    pub fn have_failed_it(&self) -> bool {
        self.failed
    }

    /// Takes the changes to simulators and links that the threats have demanded since the last
    /// call.
    pub fn take_demands(&mut self) -> Vec<Demand> {
        self.engine.take_demands()
    }
}

impl Flight {
    /// The injects that an instructor may trigger.
    pub fn injects(&self) -> Vec<Inject> {
        let events = self.mission.events.iter();
        let own = events
            .filter(|event| event.trigger == Trigger::Instructor)
            .map(|event| Inject {
                name: event.id.clone(),
                title: event.title.clone(),
            });
        let may_inject = self.mission.may_inject.iter();
        let standard = may_inject.map(|standard| Inject {
            name: standard.name().to_owned(),
            title: standard.title(),
        });
        own.chain(standard).collect()
    }

    /// Triggers an inject for an instructor; returns its title.
    ///
    /// # Errors
    /// No inject has that name, or the flight is over.
    pub fn inject(&mut self, name: &str) -> Result<Text, Text> {
        if self.is_over() {
            return Err(text!("deed-over"));
        }
        if let Some(recorder) = &mut self.recorder {
            recorder.inject(name);
        }
        let allowed = self
            .injects()
            .into_iter()
            .find(|inject| inject.name == name);
        let inject = allowed.ok_or_else(|| text!("threat-not-allowed", name = name))?;
        let mut events = self.mission.events.iter();
        let own = |event: &crate::mission::event::Event| {
            event.id == name && event.trigger == Trigger::Instructor
        };
        if let Some(index) = events.position(own) {
            self.threats.engine.inject_event(index, self.elapsed);
        } else if let Some(standard) = Standard::named(name) {
            self.threats.engine.inject_standard(standard);
        }
        let title = inject.title.clone();
        let kind = EventKind::Inject;
        self.journal
            .record(JournalEntry::new(kind, Severity::Info, title));
        Ok(inject.title)
    }
}
