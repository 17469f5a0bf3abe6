//! What threatens a flight, and what an instructor may have happen.

use super::{Flight, Standing};
use crate::mission::event::Trigger;
use crate::mission::event::demand::Demand;
use crate::mission::event::engine::News;
use crate::mission::event::scope::Sight;
use crate::mission::event::standard::Standard;
use crate::notice::Notice;
use crate::scoring::{AlertLevel, EventKind};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, Vehicles};

/// Something that an instructor may have happen.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Inject {
    /// What it is called by.
    pub name: String,
    /// What it is, for people.
    pub title: Text,
}

impl Flight {
    /// Lets events and what they have brought go on.
    pub(super) fn step_threats(
        &mut self,
        vehicles: &Vehicles,
        standings: &[Standing],
        notices: &mut Vec<Notice>,
    ) {
        let mission = std::sync::Arc::clone(&self.mission);
        let sight = Sight {
            now: self.elapsed,
            crafts: &self.crafts,
            vehicles,
            standings,
            contacts: self.contacts.all(),
            marks: self.marks.all(),
            last_command: self.commands.last_given(),
        };
        let news = self.engine.step(&mission, &mut self.world.weather, &sight);
        for news in news {
            self.hear_news(news, notices);
        }
    }

    fn hear_news(&mut self, news: News, notices: &mut Vec<Notice>) {
        match news {
            News::Said(text) => self.say(
                EventKind::MissionEvent,
                None,
                Severity::Notice,
                text,
                notices,
            ),
            News::Alert(level, text) => {
                let severity = match level {
                    AlertLevel::Caution => Severity::Notice,
                    AlertLevel::Warning => Severity::Warning,
                    AlertLevel::Critical => Severity::Critical,
                };
                self.say(EventKind::Alert, None, severity, text, notices);
            }
            News::Answered(fact) => {
                let after_s = fact.answered_after.unwrap_or_default().as_secs_f64();
                let seconds = format!("{after_s:.0}");
                let text = text!("threat-answered", alert = fact.text, seconds = seconds);
                self.say(EventKind::Answer, None, Severity::Info, text, notices);
            }
            News::Broken(vehicle, (kind, text)) => {
                self.break_rule(kind, vehicle, &text, notices);
            }
            News::Failed(text) => {
                self.say(EventKind::Alert, None, Severity::Critical, text, notices);
                self.failed = true;
            }
        }
    }

    /// What has to be done to simulators and links since this was asked last.
    pub fn take_demands(&mut self) -> Vec<Demand> {
        self.engine.take_demands()
    }

    /// What an instructor may have happen.
    pub fn injects(&self) -> Vec<Inject> {
        let events = self.mission.events.iter();
        let own = events.filter(|event| event.trigger == Trigger::Instructor);
        let own = own.map(|event| Inject {
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

    /// An instructor has something happen; returns what.
    ///
    /// # Errors
    /// Nothing of that name may happen, or the flight is over.
    pub fn inject(&mut self, name: &str) -> Result<Text, Text> {
        if self.ended.is_some() {
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
            self.engine.inject_event(index, self.elapsed);
        } else if let Some(standard) = Standard::named(name) {
            self.engine.inject_standard(standard);
        }
        self.record(EventKind::Inject, None, inject.title.clone());
        Ok(inject.title)
    }
}
