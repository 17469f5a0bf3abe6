//! An instructor's injects: at once, or armed with a condition.

use super::Flight;
use super::journal::JournalEntry;
use crate::diagnostic::Diagnostic;
use crate::mission::event::expression::{EVERY, Expression, ExpressionNames, LONGEST};
use crate::mission::event::scope::Scope;
use crate::mission::event::standard::{ALWAYS_MOVING, Standard};
use crate::mission::event::{Action, Event, Trigger};
use crate::mission::{Mission, is_due};
use crate::scoring::EventKind;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

/// A threat that an instructor may trigger.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Inject {
    /// Its name in commands.
    pub name: String,
    /// Its title on the screen.
    pub title: Text,
}

/// Why an inject cannot be triggered.
#[derive(Debug, Clone, PartialEq)]
pub enum InjectFault {
    /// The flight is over.
    Over,
    /// The mission permits no inject with this name.
    NotAllowed(String),
    /// The condition cannot be read.
    Condition(Diagnostic),
}

impl From<&InjectFault> for Text {
    fn from(fault: &InjectFault) -> Self {
        match fault {
            InjectFault::Over => text!("deed-over"),
            InjectFault::NotAllowed(name) => text!("threat-not-allowed", name = name),
            InjectFault::Condition(fault) => fault.message.clone(),
        }
    }
}

/// Checks a condition for an inject, whatever the mission: the names of zones and the like may be any.
///
/// # Errors
/// The first fault, with its position in the text.
pub fn check_condition(source: &str) -> Result<(), Diagnostic> {
    let any = ExpressionNames {
        are_open: true,
        ..ExpressionNames::default()
    };
    read(source, &any).map(drop)
}

fn read(source: &str, names: &ExpressionNames<'_>) -> Result<Expression, Diagnostic> {
    if source.len() > LONGEST {
        let fault = text!("fault-condition-long", most = LONGEST);
        return Err(Diagnostic::new(0..source.len(), fault));
    }
    Expression::parse(source, names)
}

impl Mission {
    /// Checks a condition of an instructor with everything that this mission defines.
    ///
    /// # Errors
    /// The first fault, with its position in the text.
    pub fn check_condition(&self, source: &str) -> Result<(), Diagnostic> {
        self.condition(source).map(drop)
    }

    /// The injects that an instructor may trigger.
    pub fn injects(&self) -> Vec<Inject> {
        let own = self
            .events
            .iter()
            .filter(|event| event.trigger == Trigger::Instructor)
            .map(|event| Inject {
                name: event.id.clone(),
                title: event.title.clone(),
            });
        let standard = self.may_inject.iter().map(|standard| Inject {
            name: standard.name().to_owned(),
            title: standard.title(),
        });
        own.chain(standard).collect()
    }

    /// Reads a condition over everything that this mission defines.
    pub(super) fn condition(&self, source: &str) -> Result<Expression, Diagnostic> {
        let objectives = self.objectives.iter().map(|it| it.id.clone());
        let events = self.events.iter().map(|it| it.id.clone());
        let actions = self.events.iter().flat_map(|event| &event.actions);
        let spawned = actions.filter_map(|action| match action {
            Action::Spawn(spawn) => Some(spawn.id.clone()),
            _ => None,
        });
        let always = ALWAYS_MOVING.iter().map(|id| (*id).to_owned());
        let names = ExpressionNames {
            zones: &self.site.zones,
            objectives: &objectives.collect::<Vec<_>>(),
            hazards: &self.site.hazard_ids,
            events: &events.collect::<Vec<_>>(),
            movers: &spawned.chain(always).collect::<Vec<_>>(),
            sensors: &self.seats.sensors,
            vehicles: self.seats.count,
            are_open: false,
        };
        read(source, &names)
    }

    fn own_inject(&self, name: &str) -> Option<usize> {
        let is_own = |event: &Event| event.id == name && event.trigger == Trigger::Instructor;
        self.events.iter().position(is_own)
    }
}

/// An inject that the mission has carried out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Injected {
    /// Its name in commands.
    pub name: String,
    /// The condition with which it was armed; `None` for one at once.
    pub when: Option<String>,
    /// The vehicles that its faults have hit, in the order in which that happened.
    pub vehicles: Vec<VehicleId>,
}

/// How far the injects of one flight are.
#[derive(Debug, Clone, Default)]
pub(super) struct Injects {
    armed: Vec<ArmedInject>,
    /// Those whose conditions hold, and that are triggered at the end of the step.
    due: Vec<Injected>,
    /// Those that are triggered, and that the next step carries out.
    triggered: Vec<Injected>,
    done: Vec<Injected>,
}

#[derive(Debug, Clone)]
struct ArmedInject {
    inject: Injected,
    condition: Expression,
}

impl Injects {
    /// Looks which conditions hold; those injects no longer wait.
    pub fn look(&mut self, scope: &Scope<'_>) {
        if !is_due(scope.sight.now, EVERY) {
            return;
        }
        let armed = std::mem::take(&mut self.armed).into_iter();
        let (due, armed): (Vec<_>, Vec<_>) = armed.partition(|it| it.condition.holds(scope));
        self.armed = armed;
        self.due.extend(due.into_iter().map(|it| it.inject));
    }

    /// The mission has carried out an inject with this name, whose faults have hit these vehicles.
    pub fn note(&mut self, name: &str, hit: &[VehicleId]) {
        let triggered = std::mem::take(&mut self.triggered).into_iter();
        let (done, triggered): (Vec<_>, Vec<_>) = triggered.partition(|it| it.name == name);
        let done = done.into_iter();
        self.triggered = triggered;
        self.done.extend(done.map(|it| Injected {
            vehicles: hit.to_vec(),
            ..it
        }));
    }

    /// Those that the mission has carried out, in their order.
    pub fn done(&self) -> &[Injected] {
        &self.done
    }
}

impl Flight {
    /// The injects that an instructor may trigger.
    pub fn injects(&self) -> Vec<Inject> {
        self.mission.injects()
    }

    /// The inject with this name, if it can be triggered.
    fn permitted(&self, name: &str) -> Result<Inject, InjectFault> {
        if self.is_over() {
            return Err(InjectFault::Over);
        }
        let mut all = self.injects().into_iter();
        all.find(|inject| inject.name == name)
            .ok_or_else(|| InjectFault::NotAllowed(name.to_owned()))
    }

    /// Triggers an inject for an instructor; returns its title. The next step carries it out.
    ///
    /// # Errors
    /// No inject has that name, or the flight is over.
    pub fn inject(&mut self, name: &str) -> Result<Text, InjectFault> {
        self.trigger(Injected {
            name: name.to_owned(),
            when: None,
            vehicles: Vec::new(),
        })
    }

    fn trigger(&mut self, inject: Injected) -> Result<Text, InjectFault> {
        let name = inject.name.as_str();
        let title = self.permitted(name)?.title;
        if let Some(recorder) = &mut self.recorder {
            recorder.inject(name);
        }
        if let Some(index) = self.mission.own_inject(name) {
            self.threats.engine.inject_event(index, self.elapsed);
        } else if let Some(standard) = Standard::named(name) {
            self.threats.engine.inject_standard(standard);
        }
        let kind = EventKind::Inject;
        self.journal
            .record(JournalEntry::new(kind, Severity::Info, title.clone()));
        self.threats.injects.triggered.push(inject);
        Ok(title)
    }

    /// Arms an inject: it is triggered once, as soon as the condition holds.
    ///
    /// # Errors
    /// No inject has that name, the condition cannot be read, or the flight is over.
    pub fn arm(&mut self, name: &str, when: &str) -> Result<(), InjectFault> {
        let name = self.permitted(name)?.name;
        let condition = self.mission.condition(when);
        let condition = condition.map_err(InjectFault::Condition)?;
        let when = Some(when.to_owned());
        let inject = Injected {
            name,
            when,
            vehicles: Vec::new(),
        };
        let armed = &mut self.threats.injects.armed;
        armed.push(ArmedInject { inject, condition });
        Ok(())
    }

    /// Disarms the injects with this name, or all without one.
    pub fn disarm(&mut self, name: Option<&str>) {
        let stays = |it: &ArmedInject| name.is_some_and(|name| it.inject.name != name);
        self.threats.injects.armed.retain(stays);
    }

    /// Triggers the injects whose conditions have begun to hold in this step. In the record they follow the step, like
    /// all injects, so that a record needs no conditions.
    pub(super) fn inject_due(&mut self) {
        for inject in std::mem::take(&mut self.threats.injects.due) {
            // The flight may have ended in the same step.
            drop(self.trigger(inject));
        }
    }
}
