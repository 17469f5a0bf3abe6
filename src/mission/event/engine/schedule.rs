//! The times of events.

use std::time::Duration;

use rand::RngExt as _;
use rand_chacha::ChaCha8Rng;

use crate::mission::event::scope::Scope;
use crate::mission::event::{Event, Trigger};
use crate::mission::{Mission, TICK};

/// The schedule of one flight's events, by their indices in the file.
#[derive(Debug, Clone)]
pub(super) struct Schedule {
    watches: Vec<EventWatch>,
    fired: Vec<bool>,
}

#[derive(Debug, Clone, Copy, Default)]
struct EventWatch {
    due: Option<Duration>,
    /// Whether its condition held at the last evaluation.
    held: bool,
    over: bool,
    /// Whether an instructor triggered it, so its probability does not matter.
    wanted: bool,
}

impl Schedule {
    pub fn new(mission: &Mission, random: &mut ChaCha8Rng) -> Self {
        let watch = |event: &Event| EventWatch {
            due: match event.trigger {
                Trigger::At(at) => Some(jittered(at, event.jitter, random)),
                Trigger::When(_) | Trigger::After(..) | Trigger::Instructor => None,
            },
            ..EventWatch::default()
        };
        let watches: Vec<EventWatch> = mission.events.iter().map(watch).collect();
        Self {
            fired: vec![false; watches.len()],
            watches,
        }
    }

    /// Which events have happened.
    pub fn fired(&self) -> &[bool] {
        &self.fired
    }

    /// Which conditions hold. The events use the random streams from `stream` on.
    pub fn holding(&self, mission: &Mission, scope: &Scope<'_>, stream: u64) -> Vec<bool> {
        let events = mission.events.iter().zip(&self.watches).zip(stream..);
        let holds = events.map(|((event, watch), stream)| {
            let Trigger::When(condition) = &event.trigger else {
                return false;
            };
            let (seed, _) = scope.chance;
            !watch.over
                && condition.holds(&Scope {
                    chance: (seed, stream),
                    ..scope.clone()
                })
        });
        holds.collect()
    }

    /// Makes an event due when its condition begins to hold.
    pub fn note(&mut self, holding: &[bool], now: Duration) {
        for (watch, &holds) in self.watches.iter_mut().zip(holding) {
            if holds && !watch.held {
                watch.due = Some(now);
            }
            watch.held = holds;
        }
    }

    /// Whether an instructor has triggered an event that has not happened yet.
    pub fn is_wanted(&self, index: usize) -> bool {
        self.watches.get(index).is_some_and(|watch| watch.wanted)
    }

    /// Whether an event happens now: it is due, and the random draw allows it.
    pub fn happens(
        &mut self,
        index: usize,
        mission: &Mission,
        now: Duration,
        random: &mut ChaCha8Rng,
    ) -> bool {
        let event = &mission.events[index];
        let watch = &mut self.watches[index];
        if watch.due.is_none_or(|due| due > now) {
            return false;
        }
        watch.due = None;
        let wanted = std::mem::take(&mut watch.wanted);
        if watch.over {
            return false;
        }
        watch.over = event.once;
        let by_chance = random.random::<f64>() < event.chance;
        if !by_chance && !wanted {
            return false;
        }
        self.fired[index] = true;
        for (watch, follower) in self.watches.iter_mut().zip(&mission.events) {
            if let Trigger::After(first, delay) = follower.trigger
                && first == index
            {
                let delay = jittered(delay, follower.jitter, random);
                watch.due = Some(now + delay.max(TICK));
            }
        }
        true
    }

    /// Sets the time at which another event is due.
    pub fn put(&mut self, index: usize, at: Duration) {
        self.watches[index].due = Some(at);
    }

    /// Triggers an event for an instructor.
    pub fn want(&mut self, index: usize, now: Duration) {
        if let Some(watch) = self.watches.get_mut(index) {
            watch.due = Some(now);
            watch.over = false;
            watch.wanted = true;
        }
    }
}

/// A time with a random offset, either way.
fn jittered(at: Duration, jitter: Duration, random: &mut ChaCha8Rng) -> Duration {
    let by_s = random.random_range(-1.0..=1.0) * jitter.as_secs_f64();
    let at_s = (at.as_secs_f64() + by_s).max(0.0);
    Duration::try_from_secs_f64(at_s).unwrap_or(at)
}
