//! Begins and ends sessions.

use std::sync::Arc;
use std::time::Duration;

use rand::TryRng as _;
use rand::rngs::SysRng;

use super::Console;
use super::career::today;
use super::session::{Backend, Plan, Running};
use crate::app::effect::Launch;
use crate::app::event::{Event, SessionEvent};
use crate::campaign::{Stake, daily_seed, exam_seed};
use crate::link::{Address, AddressError};
use crate::mission::Mission;
use crate::mission::record::Occasion;
use crate::store;
use crate::text;
use crate::text::Text;

/// How long the end of the program waits for the processes of its vehicles to end.
const LAST_PROCESS_PATIENCE: Duration = Duration::from_secs(2);

/// A seed for the first try where none is given and nobody's flights are kept.
const FIRST_SEED: u64 = 1;
/// Fresh seeds are below this: small enough to be typed.
const SEEDS: u64 = 1_000_000;

/// One of the tries at what is flown.
#[derive(Debug, Clone, Copy)]
pub(super) struct Attempt {
    /// What varies it.
    pub seed: u64,
    /// How it counts for a career.
    pub stake: Stake,
    /// How it was to count, and counts as soon as it can.
    pub wanted: Stake,
}

impl Default for Attempt {
    fn default() -> Self {
        Self {
            seed: FIRST_SEED,
            stake: Stake::Practice,
            wanted: Stake::Practice,
        }
    }
}

impl Console {
    /// Starts a mission that the trainee has chosen.
    pub(super) async fn start_mission(&mut self, launch: &Launch) -> Result<(), Text> {
        let mission = store::mission(&launch.mission).map_err(|error| Text::from(&error))?;
        let mission = mission
            .with_fleet(launch.fleet.clone())
            .map_err(|reasons| Text::joined("; ", reasons))?;
        let mission = match launch.stake {
            Stake::Exam => mission.for_exam(),
            _ => mission,
        };
        self.launch(Arc::new(mission), launch.stake, launch.seed)
            .await
    }

    /// Starts a mission, which knows already whether it is an exam. What cannot count is flown for practice, and told.
    pub(super) async fn launch(
        &mut self,
        mission: Arc<Mission>,
        wanted: Stake,
        seed: Option<u64>,
    ) -> Result<(), Text> {
        let chosen = seed.or(self.options.seed);
        self.attempt = self.attempt_at(&mission, wanted, chosen);
        self.start(Plan::Mission(mission)).await?;
        self.tell_practice();
        Ok(())
    }

    /// How a mission is flown next, with a seed that was chosen or one that its stake asks for.
    fn attempt_at(&self, mission: &Mission, wanted: Stake, chosen: Option<u64>) -> Attempt {
        let stake = match wanted {
            Stake::Graded if chosen.is_some() => Stake::Practice,
            wanted if self.may_count(mission) => wanted,
            _ => Stake::Practice,
        };
        let seed = match stake {
            Stake::Practice => chosen.unwrap_or(FIRST_SEED),
            Stake::Daily => daily_seed(today()),
            Stake::Exam => exam_seed(&mission.id, mission.rev),
            Stake::Graded => self.fresh_seed(),
        };
        Attempt {
            seed,
            stake,
            wanted,
        }
    }

    /// Whether a mission can count for the career of whoever trains: not one that is locked, nor one flown with parts that
    /// are not theirs, nor a file, an airframe or a slow motion that others do not have.
    fn may_count(&self, mission: &Mission) -> bool {
        let Some(career) = &self.app.state().career else {
            return true;
        };
        let mut fleet = mission.fleet().iter();
        career.lock(&mission.id).is_none()
            && fleet.all(|design| career.may_fly(design))
            && store::is_of_course(mission)
            && self.options.backend.airframes.is_empty()
            && self.options.speedup >= 1.0
    }

    fn tell_practice(&mut self) {
        let is_kept = self.trainee().is_some();
        if is_kept && self.attempt.stake != self.attempt.wanted {
            self.post(Event::Answer(text!("launch-practice")));
        }
    }

    /// A layout that a trainee has not flown yet; always the same where nothing is kept.
    fn fresh_seed(&self) -> u64 {
        let random = self
            .trainee()
            .is_some()
            .then(|| SysRng.try_next_u64().ok())
            .flatten();
        random.map_or(FIRST_SEED, |random| random % SEEDS)
    }

    /// The attempt after the one before: on another layout, where the layout is free.
    fn another_attempt_at(&self, mission: &Mission) -> Attempt {
        let chosen = self.options.seed;
        let attempt = self.attempt_at(mission, self.attempt.wanted, chosen);
        let is_free = matches!(attempt.stake, Stake::Graded | Stake::Practice);
        if is_free && chosen.is_none() && attempt.seed == FIRST_SEED {
            let seed = self.attempt.seed.wrapping_add(1);
            return Attempt { seed, ..attempt };
        }
        attempt
    }

    /// Starts something else than a mission.
    pub(super) async fn start_afresh(&mut self, plan: Plan) -> Result<(), Text> {
        self.attempt = Attempt {
            seed: self.options.seed.unwrap_or(FIRST_SEED),
            ..Attempt::default()
        };
        self.start(plan).await
    }

    /// Starts what runs once more: with another seed, unless the user has chosen one or wants the same. What was said
    /// before a launch that did not come holds for the next one.
    pub(super) async fn start_again(&mut self, alike: bool) -> Result<(), Text> {
        let Some(plan) = self.running.as_ref().map(Running::plan) else {
            return Ok(());
        };
        self.attempt = match &plan {
            // What was seen before is flown for practice, unless everybody sees it.
            _ if alike => match self.attempt.stake {
                Stake::Exam | Stake::Daily => self.attempt,
                Stake::Graded | Stake::Practice => Attempt {
                    stake: Stake::Practice,
                    ..self.attempt
                },
            },
            Plan::Mission(mission) => self.another_attempt_at(mission),
            Plan::Free(_) | Plan::Connect(_) => self.attempt,
        };
        let pledge = self.running.as_ref().and_then(Running::open_pledge);
        let outcome = self.start(plan).await;
        if let (Some(running), Some(pledge)) = (&mut self.running, pledge) {
            running.renew(pledge);
        }
        outcome
    }

    /// Ends the session. What takes a while to end is waited for by who has to.
    pub(super) fn end_session(&mut self) {
        self.go_on();
        if let Some(running) = self.running.take() {
            self.ending = running.ending();
            // Another console may have stored flights meanwhile.
            self.show_career();
        }
    }

    /// Ends everything, and waits for it a little: what then still runs ends with this program.
    pub(super) async fn close(&mut self) {
        self.end_session();
        self.store_flights();
        let ending = std::mem::take(&mut self.ending);
        ending.over(LAST_PROCESS_PATIENCE).await;
    }

    async fn start(&mut self, plan: Plan) -> Result<(), Text> {
        // The old session ends first: the new one may need its ports.
        self.end_session();
        self.store_flights();
        let backend = Backend {
            clock: self.clock.clone(),
            vehicles: self.options.vehicles,
            seed: self.attempt.seed,
            speedup: self.options.speedup,
            simulation: self.options.backend.clone(),
            runs: self.options.preferences.runs.clone(),
            occasion: Occasion {
                stake: self.attempt.stake,
                profile: self.trainee().map(str::to_owned),
                ..Occasion::default()
            },
            earlier: self.tries_before(&plan),
        };
        let before = std::mem::take(&mut self.ending);
        let (running, started) = Running::start(plan, &backend, before).await?;
        self.running = Some(running);
        self.post(SessionEvent::Started(Box::new(started)));
        Ok(())
    }
}

/// Addresses as they were written.
pub(super) fn parse(addresses: &[String]) -> Result<Vec<Address>, Text> {
    let parsed = addresses.iter().map(|address| address.parse());
    let parsed: Result<_, AddressError> = parsed.collect();
    parsed.map_err(|error| Text::from(&error))
}
