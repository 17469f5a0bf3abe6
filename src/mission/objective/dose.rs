//! `dose`: no vehicle may collect more radiation than its electronics tolerate.

use std::collections::BTreeMap;

use super::{
    ObjectiveDetails, ObjectiveKind, ObjectiveScene, ObjectiveStanding, Tracker, partial_credit,
};
use crate::mission::TICK;
use crate::mission::format::{FileTable, KindOf, number};
use crate::mission::ground_truth::Quantity;
use crate::mission::skill::Skill;
use crate::mission::world::World;
use crate::text;
use crate::vehicle::VehicleId;

/// The multiple of the limit at which the objective earns nothing.
const WORTHLESS: f64 = 2.0;

#[derive(Debug, Clone)]
struct Dose {
    limit_usv: f64,
}

#[derive(Debug, Clone)]
struct DoseTracker {
    limit_usv: f64,
    gathered_usv: BTreeMap<VehicleId, f64>,
}

pub(super) const KIND: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "dose",
    about: "met when no vehicle has received more than this dose; twice the dose earns nothing",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn ObjectiveKind>> {
    let limit_usv = table.need(
        "limit_usv",
        number(1e-3, 1e6, "uSv"),
        "maximum dose of a vehicle",
    );
    Some(Box::new(Dose {
        limit_usv: limit_usv?,
    }))
}

impl ObjectiveKind for Dose {
    fn measure_unit(&self) -> &'static str {
        "µSv"
    }

    fn skill(&self, _: usize) -> Option<Skill> {
        Some(Skill::K7)
    }

    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(DoseTracker {
            limit_usv: self.limit_usv,
            gathered_usv: BTreeMap::new(),
        })
    }
}

impl DoseTracker {
    /// The dose of the vehicle that has gathered the most.
    fn most_usv(&self) -> f64 {
        self.gathered_usv.values().copied().fold(0.0, f64::max)
    }
}

impl Tracker for DoseTracker {
    fn step(&mut self, scene: &ObjectiveScene<'_>) {
        for craft in scene.vehicles {
            let Some(at) = craft.at else { continue };
            let rate = scene.world.amount(Quantity::DoseRate, at, craft.height_m);
            let hours = TICK.as_secs_f64() / 3600.0;
            *self.gathered_usv.entry(craft.id).or_insert(0.0) += rate * hours;
        }
    }

    fn standing(&self, scene: &ObjectiveScene<'_>) -> ObjectiveStanding {
        let most = self.most_usv();
        // A vehicle that stays home collects nothing, but has not earned the points.
        let begun = scene.vehicles.iter().any(|craft| craft.flown);
        let within = most <= self.limit_usv;
        ObjectiveStanding {
            fraction: if begun {
                partial_credit(most, WORTHLESS * self.limit_usv, self.limit_usv)
            } else {
                0.0
            },
            measure: most,
            met: begun && within,
            settled: true,
            landing: false,
        }
    }

    fn is_out_of_reach(&self, _: &ObjectiveScene<'_>) -> bool {
        self.most_usv() > self.limit_usv
    }

    fn details(&self, _: &ObjectiveScene<'_>) -> ObjectiveDetails {
        ObjectiveDetails {
            product: None,
            result: text!("dose-most", dose = format!("{:.2}", self.most_usv())),
            outlook: None,
            target: text!("dose-target", limit = format!("{:.1}", self.limit_usv)),
            advice: text!("dose-advice"),
        }
    }
}
