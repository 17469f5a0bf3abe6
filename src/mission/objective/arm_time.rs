//! `arm_time`: every vehicle is armed soon after it is ready.

use std::time::Duration;

use super::{
    DemandedTime, Demands, ObjectiveDetails, ObjectiveKind, ObjectiveScene, ObjectiveStanding,
    Tracker, Trying,
};
use crate::mission::format::{FileTable, KindOf, number};
use crate::mission::skill::Skill;
use crate::mission::world::World;
use crate::text;

#[derive(Debug, Clone)]
struct ArmTime {
    within_s: f64,
}

#[derive(Debug, Clone)]
struct ArmTracker {
    within_s: f64,
    vehicles: Vec<Arming>,
}

#[derive(Debug, Clone, Copy, Default)]
struct Arming {
    ready: Option<Duration>,
    armed: Option<Duration>,
}

impl Arming {
    /// Seconds from ready to armed; until now, if it is not armed.
    fn taken_s(&self, now: Duration) -> f64 {
        let until = self.armed.unwrap_or(now);
        self.ready
            .map_or(0.0, |ready| until.saturating_sub(ready).as_secs_f64())
    }
}

pub(super) const KIND: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "arm_time",
    about: "met when every vehicle was armed soon after it became ready",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn ObjectiveKind>> {
    let within_s = table.need(
        "within",
        number(1.0, 3600.0, "s"),
        "maximum time after the vehicle became ready",
    );
    Some(Box::new(ArmTime {
        within_s: within_s?,
    }))
}

impl ObjectiveKind for ArmTime {
    fn measure_unit(&self) -> &'static str {
        "s"
    }

    fn skill(&self, _: usize) -> Option<Skill> {
        Some(Skill::K1)
    }

    fn trying(&self) -> Trying {
        Trying::Always
    }

    fn demands(&self) -> Demands<'_> {
        Demands {
            times: vec![DemandedTime::seconds("within", self.within_s)],
            ..Demands::default()
        }
    }

    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(ArmTracker {
            within_s: self.within_s,
            vehicles: Vec::new(),
        })
    }
}

impl ArmTracker {
    /// The seconds that the slowest vehicle has taken so far.
    fn longest_s(&self, now: Duration) -> f64 {
        let taken = self.vehicles.iter().map(|arming| arming.taken_s(now));
        taken.max_by(f64::total_cmp).unwrap_or(0.0)
    }

    fn all_armed(&self) -> bool {
        !self.vehicles.is_empty() && self.vehicles.iter().all(|arming| arming.armed.is_some())
    }
}

impl Tracker for ArmTracker {
    fn step(&mut self, scene: &ObjectiveScene<'_>) {
        self.vehicles
            .resize(scene.vehicles.len(), Arming::default());
        for (arming, craft) in self.vehicles.iter_mut().zip(scene.vehicles) {
            if craft.ready || craft.armed {
                arming.ready.get_or_insert(scene.now);
            }
            if craft.armed {
                arming.armed.get_or_insert(scene.now);
            }
        }
    }

    fn standing(&self, scene: &ObjectiveScene<'_>) -> ObjectiveStanding {
        let longest_s = self.longest_s(scene.now);
        let armed = self.all_armed();
        // Twice the time earns no points, so that a late start is not rewarded.
        let share = |arming: &Arming| {
            let late = arming.taken_s(scene.now) / self.within_s;
            let share = (2.0 - late).clamp(0.0, 1.0);
            arming.armed.map_or(0.0, |_| share)
        };
        let sum: f64 = self.vehicles.iter().map(share).sum();
        ObjectiveStanding {
            fraction: sum / self.vehicles.len().max(1) as f64,
            measure: longest_s,
            met: armed && longest_s <= self.within_s,
            settled: armed || longest_s > self.within_s,
            landing: false,
        }
    }

    fn is_out_of_reach(&self, scene: &ObjectiveScene<'_>) -> bool {
        let standing = self.standing(scene);
        standing.settled && !standing.met
    }

    fn details(&self, scene: &ObjectiveScene<'_>) -> ObjectiveDetails {
        let within = format!("{:.0}", self.within_s);
        ObjectiveDetails {
            product: None,
            result: if self.all_armed() {
                let taken = format!("{:.0}", self.longest_s(scene.now));
                text!("mission-armed-after", time = taken)
            } else {
                text!("mission-not-armed")
            },
            outlook: None,
            target: text!("mission-arm-within", time = within.as_str()),
            advice: text!("mission-arm-advice", time = within),
        }
    }
}
