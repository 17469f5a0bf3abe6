//! `rehearsed`, `mended`, `kept`: conditions on plans before vehicles first fly them.

use std::collections::BTreeSet;

use super::{ObjectiveDetails, ObjectiveKind, ObjectiveScene, ObjectiveStanding, Tracker};
use crate::mission::board::PlanFault;
use crate::mission::craft::Craft;
use crate::mission::format::{FileTable, KindOf};
use crate::mission::skill::Skill;
use crate::mission::world::World;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::vehicle_id::ranges;

/// A condition for the first flight of each vehicle's plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum PlanRule {
    Rehearsed,
    /// A plan with a fault was replaced.
    Mended,
    /// A sound plan was left as it was.
    Kept,
}

#[derive(Debug, Clone)]
struct PlanStarts {
    rule: PlanRule,
    /// The fault of each vehicle's plan at the start, by seat; empty without such plans.
    faults: Vec<Option<PlanFault>>,
    /// The vehicles that have flown a plan, and whether the rule was kept then.
    flown: Vec<(VehicleId, bool)>,
}

pub(super) const REHEARSED: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "rehearsed",
    about: "met when every vehicle has flown a plan, and the first one had been rehearsed without a fault (`plan rehearse`) since it was put on board",
    read: |_| Some(Box::new(PlanRule::Rehearsed)),
};

pub(super) const MENDED: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "mended",
    about: "met when every vehicle whose plan in `[board]` has a fault has flown another plan, and never the faulty one",
    read: |table| read(table, PlanRule::Mended),
};

pub(super) const KEPT: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "kept",
    about: "met when every vehicle whose plan in `[board]` is sound has flown it unchanged",
    read: |table| read(table, PlanRule::Kept),
};

fn read(table: &mut FileTable<'_>, rule: PlanRule) -> Option<Box<dyn ObjectiveKind>> {
    if !table.draft().has_plans {
        table.fault_of("kind", text!("fault-needs-plans"));
        return None;
    }
    Some(Box::new(rule))
}

impl ObjectiveKind for PlanRule {
    fn skill(&self, _: usize) -> Option<Skill> {
        Some(Skill::K13)
    }

    fn start(&self, world: &World) -> Box<dyn Tracker> {
        Box::new(PlanStarts {
            rule: *self,
            faults: world.plan_faults.clone(),
            flown: Vec::new(),
        })
    }
}

impl PlanStarts {
    fn concerned<'a>(&'a self, crafts: &'a [Craft]) -> impl Iterator<Item = &'a Craft> {
        let faults = self.faults.iter().copied().chain(std::iter::repeat(None));
        let seats = crafts.iter().zip(faults);
        let concerned = seats.filter(|(_, fault)| match self.rule {
            PlanRule::Rehearsed => true,
            PlanRule::Mended => fault.is_some(),
            PlanRule::Kept => fault.is_none(),
        });
        concerned.map(|(craft, _)| craft)
    }

    fn has_flown(&self, craft: &Craft, as_asked: bool) -> bool {
        self.flown.contains(&(craft.id, as_asked))
    }

    /// After the flight: each vehicle whose plan had a fault, with the fault.
    fn truth(&self, crafts: &[Craft]) -> Vec<Text> {
        let faulty = crafts.iter().zip(&self.faults);
        faulty
            .filter_map(|(craft, fault)| {
                let fault = (*fault)?.title();
                Some(text!("plan-fault-of", vehicle = craft.id, fault = fault))
            })
            .collect()
    }

    fn target(&self, count: usize) -> Text {
        match self.rule {
            PlanRule::Rehearsed => text!("plan-rehearsed-target", count = count),
            PlanRule::Mended => text!("plan-mended-target"),
            PlanRule::Kept => text!("plan-kept-target"),
        }
    }

    /// The vehicles that have flown without meeting the rule, as in `1-2`.
    fn against(&self, crafts: &[Craft]) -> String {
        let against = self.concerned(crafts);
        let against = against.filter(|craft| self.has_flown(craft, false));
        ranges(
            against
                .map(|craft| craft.id)
                .collect::<BTreeSet<VehicleId>>(),
        )
    }

    fn result(&self, good: usize, scene: &ObjectiveScene<'_>) -> Text {
        let against = self.against(scene.vehicles);
        let mut parts = vec![match (self.rule, against.is_empty()) {
            (PlanRule::Rehearsed, true) => text!("plan-rehearsed-of", good = good),
            (PlanRule::Rehearsed, false) => text!("plan-unrehearsed", vehicles = against),
            (PlanRule::Mended, true) => text!("plan-mended-of", good = good),
            (PlanRule::Mended, false) => text!("plan-unmended", vehicles = against),
            (PlanRule::Kept, true) => text!("plan-kept-of", good = good),
            (PlanRule::Kept, false) => text!("plan-unkept", vehicles = against),
        }];
        if scene.over && self.rule == PlanRule::Mended {
            parts.extend(self.truth(scene.vehicles));
        }
        Text::joined("; ", parts)
    }

    fn advice(&self) -> Text {
        match self.rule {
            PlanRule::Rehearsed => text!("plan-rehearsed-advice"),
            PlanRule::Mended => text!("plan-mended-advice"),
            PlanRule::Kept => text!("plan-kept-advice"),
        }
    }
}

impl Tracker for PlanStarts {
    fn step(&mut self, scene: &ObjectiveScene<'_>) {
        for craft in scene.vehicles.iter().filter(|craft| craft.flies_plan()) {
            if self.flown.iter().all(|(id, _)| *id != craft.id) {
                let as_asked = match self.rule {
                    PlanRule::Rehearsed => scene.plans.is_rehearsed(craft.id),
                    PlanRule::Mended => scene.plans.is_changed(craft.id),
                    PlanRule::Kept => !scene.plans.is_changed(craft.id),
                };
                self.flown.push((craft.id, as_asked));
            }
        }
    }

    fn standing(&self, scene: &ObjectiveScene<'_>) -> ObjectiveStanding {
        let count = self.concerned(scene.vehicles).count();
        let good = self.good(scene.vehicles);
        let mut all = self.concerned(scene.vehicles);
        let met = !scene.vehicles.is_empty() && good == count;
        ObjectiveStanding {
            fraction: good as f64 / count.max(1) as f64,
            measure: good as f64,
            met,
            settled: met || all.any(|craft| self.has_flown(craft, false)),
            landing: false,
        }
    }

    fn is_out_of_reach(&self, scene: &ObjectiveScene<'_>) -> bool {
        let standing = self.standing(scene);
        standing.settled && !standing.met
    }

    fn details(&self, scene: &ObjectiveScene<'_>) -> ObjectiveDetails {
        let good = self.good(scene.vehicles);
        ObjectiveDetails {
            product: None,
            result: self.result(good, scene),
            outlook: Some(self.outlook(good, scene)),
            target: self.target(self.concerned(scene.vehicles).count()),
            advice: self.advice(),
        }
    }
}

impl PlanStarts {
    fn good(&self, vehicles: &[Craft]) -> usize {
        let concerned = self.concerned(vehicles);
        concerned
            .filter(|craft| self.has_flown(craft, true))
            .count()
    }

    /// The result so far in two words, since it is shown beside the title. It does not reveal the number of faulty
    /// plans, which the trainee has to find out.
    fn outlook(&self, good: usize, scene: &ObjectiveScene<'_>) -> Text {
        let against = self.against(scene.vehicles);
        let count = self.concerned(scene.vehicles).count();
        match (self.rule, against.is_empty()) {
            // Until a plan is flown, only the rehearsals show progress.
            (PlanRule::Rehearsed, true) if good == 0 => {
                let concerned = self.concerned(scene.vehicles);
                let ready = concerned.filter(|craft| scene.plans.is_rehearsed(craft.id));
                let ready = ready.count();
                text!("plan-outlook-rehearsed", ready = ready, count = count)
            }
            (_, true) => text!("plan-flown-of", good = good),
            (PlanRule::Rehearsed, false) => text!("plan-outlook-unrehearsed", vehicles = against),
            (PlanRule::Mended, false) => text!("plan-outlook-unmended", vehicles = against),
            (PlanRule::Kept, false) => text!("plan-outlook-unkept", vehicles = against),
        }
    }
}
