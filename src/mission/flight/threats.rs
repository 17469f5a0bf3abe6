//! Threats to a flight.

use super::expectation::Expectation;
use super::injects::Injects;
use super::journal::{FlightJournal, JournalEntry, JournalSubject};
use crate::mission::Mission;
use crate::mission::event::demand::Demand;
use crate::mission::event::engine::{Engine, EngineNews};
use crate::mission::event::scope::Sight;
use crate::mission::weather::Weather;
use crate::scoring::{AlertLevel, EventKind};
use crate::text;
use crate::vehicle::Severity;

/// The threats of one flight.
#[derive(Debug, Clone)]
pub(super) struct Threats {
    pub engine: Engine,
    pub injects: Injects,
    pub expectation: Option<Expectation>,
    failed: bool,
}

impl Threats {
    pub fn new(mission: &Mission, seed: u64) -> Self {
        Self {
            engine: Engine::new(mission, seed),
            injects: Injects::default(),
            expectation: None,
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
            EngineNews::Injected(name, hit) => self.injects.note(&name, &hit),
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
