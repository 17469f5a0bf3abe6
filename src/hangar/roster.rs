//! The instances of a hangar: their states, numbers and system ids.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::sync::{mpsc, watch};

use super::{
    Capacity, HangarRefusal, Instance, InstanceId, InstanceRequest, Instances, Launch,
    ProcessOutput,
};
use crate::sim::SYSTEMS;

/// An instance, from the time when it has a number.
struct RosterEntry {
    requests: mpsc::Sender<InstanceRequest>,
    system: u8,
    output: Option<ProcessOutput>,
    /// Whether the instance has ended and is not restarted, and therefore takes up no place.
    is_down: bool,
}

/// The number and the system id given to an instance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Taken {
    pub id: InstanceId,
    pub system: u8,
}

pub(super) struct Roster {
    limit: u16,
    entries: Mutex<BTreeMap<InstanceId, RosterEntry>>,
    seen: watch::Sender<Instances>,
}

impl Roster {
    /// The roster of a hangar with this many places.
    pub fn new(limit: u16) -> Self {
        Self {
            limit,
            entries: Mutex::default(),
            seen: watch::Sender::default(),
        }
    }

    /// Takes a number and a system id for an instance: the requested ones, otherwise the lowest free ones.
    ///
    /// # Errors
    /// The number is taken, no system id is free, or the hangar is full.
    pub fn take(
        &self,
        launch: &Launch,
        requests: mpsc::Sender<InstanceRequest>,
    ) -> Result<Taken, HangarRefusal> {
        let mut entries = self.entries();
        if running(&entries) >= self.limit {
            return Err(HangarRefusal::Full(self.limit));
        }
        let is_free = |id: &InstanceId| !entries.contains_key(id);
        let id = match launch.id {
            Some(id) if !is_free(&id) => return Err(HangarRefusal::Taken(id)),
            Some(id) => id,
            None => (1..=InstanceId::MAX)
                .find(is_free)
                .ok_or(HangarRefusal::Full(self.limit))?,
        };
        let system = free_system(&entries, launch.system, id)?;
        let entry = RosterEntry {
            requests,
            system,
            output: None,
            is_down: false,
        };
        entries.insert(id, entry);
        Ok(Taken { id, system })
    }

    /// Counts an ended instance as running again.
    ///
    /// # Errors
    /// It does not exist, or it has ended and the hangar is full.
    pub fn revive(&self, id: InstanceId) -> Result<(), HangarRefusal> {
        let mut entries = self.entries();
        let is_full = running(&entries) >= self.limit;
        let entry = entries.get_mut(&id).ok_or(HangarRefusal::Unknown(id))?;
        if entry.is_down && is_full {
            return Err(HangarRefusal::Full(self.limit));
        }
        entry.is_down = false;
        Ok(())
    }

    /// Notes that an instance has ended and is not restarted.
    pub fn lay_down(&self, id: InstanceId) {
        if let Some(entry) = self.entries().get_mut(&id) {
            entry.is_down = true;
        }
    }

    /// Stores an instance's output.
    pub fn keep_output(&self, id: InstanceId, output: ProcessOutput) {
        if let Some(entry) = self.entries().get_mut(&id) {
            entry.output = Some(output);
        }
    }

    pub fn output(&self, id: InstanceId) -> Option<ProcessOutput> {
        self.entries().get(&id)?.output.clone()
    }

    /// The channel for requests to an instance; `None` if no instance has that number.
    pub fn task(&self, id: InstanceId) -> Option<mpsc::Sender<InstanceRequest>> {
        Some(self.entries().get(&id)?.requests.clone())
    }

    /// A receiver of the instances and their changes.
    pub fn watch(&self) -> watch::Receiver<Instances> {
        self.seen.subscribe()
    }

    pub fn capacity(&self) -> Capacity {
        let running = running(&self.entries());
        Capacity {
            running,
            free: self.limit.saturating_sub(running),
        }
    }

    /// Publishes a change to an instance.
    pub fn show(&self, instance: &Instance) {
        self.seen.send_if_modified(|all| {
            let changed = all.get(&instance.id) != Some(instance);
            if changed {
                Arc::make_mut(all).insert(instance.id, instance.clone());
            }
            changed
        });
    }

    pub fn forget(&self, id: InstanceId) {
        self.entries().remove(&id);
        self.seen
            .send_if_modified(|all| Arc::make_mut(all).remove(&id).is_some());
    }

    /// Locks the entries, even if poisoned: a panic cannot interrupt a change.
    fn entries(&self) -> MutexGuard<'_, BTreeMap<InstanceId, RosterEntry>> {
        self.entries.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn running(entries: &BTreeMap<InstanceId, RosterEntry>) -> u16 {
    entries.values().filter(|entry| !entry.is_down).count() as u16
}

/// The requested system id, even if another instance has it: each has its own connection, and two consoles on one
/// hangar both number their vehicles from 1. Otherwise the instance's number, or else the lowest free one.
fn free_system(
    entries: &BTreeMap<InstanceId, RosterEntry>,
    asked: Option<u8>,
    id: InstanceId,
) -> Result<u8, HangarRefusal> {
    if let Some(system) = asked {
        return Ok(system);
    }
    let is_free = |system: &u8| entries.values().all(|entry| entry.system != *system);
    let all = 1..=SYSTEMS as u8;
    let own = u8::try_from(id).ok().filter(|own| all.contains(own));
    own.into_iter()
        .chain(all)
        .find(is_free)
        .ok_or_else(|| HangarRefusal::Invalid(format!("all {SYSTEMS} system ids are taken")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn take(roster: &Roster, id: Option<InstanceId>, system: Option<u8>) -> Result<Taken, String> {
        let launch = Launch {
            id,
            system,
            ..Launch::default()
        };
        let (requests, _) = mpsc::channel(1);
        roster
            .take(&launch, requests)
            .map_err(|refusal| refusal.to_string())
    }

    #[test]
    fn numbers_and_system_ids_are_the_lowest_free_ones_unless_they_are_asked_for() {
        let roster = Roster::new(10);
        for (id, system, expected) in [
            (None, None, (1, 1)),
            (None, Some(3), (2, 3)),
            // The instance's own number is already used as a system id.
            (None, None, (3, 2)),
            (Some(300), None, (300, 4)),
            (None, None, (4, 5)),
        ] {
            let taken = take(&roster, id, system).expect("it is free");
            assert_eq!((taken.id, taken.system), expected);
        }
        let taken = take(&roster, Some(300), None).expect_err("it is taken");
        assert!(taken.contains("instance 300 exists already"), "{taken}");
        let twin = take(&roster, None, Some(3)).expect("two consoles may number alike");
        assert_eq!((twin.id, twin.system), (5, 3));
    }

    #[test]
    fn those_that_have_ended_take_no_place_until_they_are_started_again() {
        let roster = Roster::new(1);
        take(&roster, None, None).expect("it is empty");
        assert!(take(&roster, None, None).is_err());
        roster.lay_down(1);
        assert_eq!(roster.capacity().free, 1);
        take(&roster, None, None).expect("there is room");
        assert!(matches!(roster.revive(1), Err(HangarRefusal::Full(1))));
        assert!(matches!(roster.revive(7), Err(HangarRefusal::Unknown(7))));
        roster.forget(2);
        assert!(roster.revive(1).is_ok());
        assert_eq!(
            roster.capacity(),
            Capacity {
                running: 1,
                free: 0
            }
        );
    }
}
