//! Plans that failed in a rehearsal, on board or as drafts, and the danger of starting them.

use std::collections::{BTreeMap, BTreeSet};

use crate::commands::Order;
use crate::draft::PlanVerdict;
use crate::operator::{FailedRehearsal, Meeting, RehearsalFindings};
use crate::plan::ContentHash;
use crate::text;
use crate::text::Text;
use crate::vehicle::{VehicleId, Vehicles};
use crate::vehicle_id::ranges;

/// The failures of the newest rehearsals.
#[derive(Debug, Clone, Default)]
pub struct PlanFailures {
    meetings: Vec<Meeting>,
    /// The plans that failed in the newest rehearsal of each vehicle.
    on_board: BTreeMap<VehicleId, FailedRehearsal>,
    /// Why plans failed in the newest rehearsal as drafts, by the plan's hash.
    trials: BTreeMap<ContentHash, Text>,
}

impl PlanFailures {
    /// The places where two vehicles came too close in the newest rehearsal of either.
    pub fn meetings(&self) -> &[Meeting] {
        &self.meetings
    }

    /// Takes over the failures of drafts from the previous session, because drafts outlast a
    /// session.
    pub(in crate::app) fn keep_trials(&mut self, before: Self) {
        self.trials = before.trials;
    }

    /// Stores the result of a rehearsal.
    pub(in crate::app) fn note(&mut self, findings: RehearsalFindings, vehicles: &Vehicles) {
        let failed = findings.failed.iter().map(|failed| failed.vehicle);
        let flown: BTreeSet<VehicleId> = failed.chain(findings.passed.iter().copied()).collect();
        let is_flown = |meeting: &Meeting| meeting.vehicles.iter().any(|id| flown.contains(id));
        self.meetings.retain(|meeting| !is_flown(meeting));
        self.meetings.extend(findings.meetings);
        for vehicle in findings.passed {
            self.on_board.remove(&vehicle);
            if let Some(plan) = carried(vehicle, vehicles) {
                self.trials.remove(&plan);
            }
        }
        let failed = findings.failed.into_iter();
        self.on_board
            .extend(failed.map(|failed| (failed.vehicle, failed)));
    }

    /// Stores the verdicts on the plans of rehearsed drafts.
    pub(in crate::app) fn note_trial(&mut self, verdicts: &[PlanVerdict]) {
        for PlanVerdict { plan, .. } in verdicts {
            self.trials.remove(plan);
        }
        // Several vehicles may fly the same plan, which has failed if one of the flights has.
        let failed = verdicts.iter().filter_map(|it| {
            let reason = it.failure.clone()?;
            Some((it.plan, reason))
        });
        self.trials.extend(failed);
    }

    /// Why it is dangerous to start the plans of an order's targets: they failed in a rehearsal, or
    /// are identical. `None` if it is not dangerous.
    pub fn hazard(&self, order: &Order, vehicles: &Vehicles) -> Option<Text> {
        let failed = self.failed_plans(order, vehicles);
        failed.or_else(|| same_plan(order, vehicles))
    }

    /// The targets whose plans have failed, grouped by reason, and the pairs that came too close to
    /// each other.
    fn failed_plans(&self, order: &Order, vehicles: &Vehicles) -> Option<Text> {
        let mut failed: Vec<(&Text, Vec<VehicleId>)> = Vec::new();
        for id in &order.targets {
            let Some(reason) = self.reason(*id, vehicles) else {
                continue;
            };
            match failed.iter_mut().find(|(known, _)| *known == reason) {
                Some((_, ids)) => ids.push(*id),
                None => failed.push((reason, vec![*id])),
            }
        }
        let has_failed = |id: &VehicleId| failed.iter().any(|(_, ids)| ids.contains(id));
        let pairs = self.meetings.iter().map(|meeting| meeting.vehicles);
        let met: Vec<[VehicleId; 2]> = pairs.filter(|pair| pair.iter().any(has_failed)).collect();
        let mut parts: Vec<Text> = failed
            .into_iter()
            .map(|(reason, ids)| {
                let vehicles = ranges(ids);
                text!(
                    "hazard-plan-rehearsal",
                    vehicles = vehicles,
                    reason = reason
                )
            })
            .collect();
        parts.first()?;
        parts.extend(too_close(&met, order));
        Some(Text::joined("; ", parts))
    }

    /// Why the plan that a vehicle carries failed in its last rehearsal, on board or as a draft.
    fn reason(&self, id: VehicleId, vehicles: &Vehicles) -> Option<&Text> {
        let plan = carried(id, vehicles)?;
        let on_board = self.on_board.get(&id);
        let on_board = on_board.filter(|failed| failed.plan == plan);
        let reason = on_board.map(|failed| &failed.reason);
        reason.or_else(|| self.trials.get(&plan))
    }
}

/// The hash of the plan on board a vehicle, if it has been read.
fn carried(vehicle: VehicleId, vehicles: &Vehicles) -> Option<ContentHash> {
    let plan = vehicles.get(&vehicle)?.plans.plan.content.as_ref()?;
    Some(ContentHash::of(plan.flown()))
}

/// Names the pairs, and suggests a rehearsal of the targets alone if a pair includes another
/// vehicle.
fn too_close(met: &[[VehicleId; 2]], order: &Order) -> Vec<Text> {
    if met.is_empty() {
        return Vec::new();
    }
    let pairs: Vec<String> = met.iter().map(|[a, b]| format!("{a}/{b}")).collect();
    let is_other = met.iter().flatten().any(|id| !order.targets.contains(id));
    let again = is_other.then(|| {
        let targets = ranges(order.targets.iter().copied());
        text!("hazard-plan-rehearse-these", targets = targets)
    });
    let named = text!("hazard-plan-met", pairs = pairs.join(", "));
    std::iter::once(named).chain(again).collect()
}

/// The warning that two targets carry the same plan and would meet.
fn same_plan(order: &Order, vehicles: &Vehicles) -> Option<Text> {
    let mut known = BTreeMap::new();
    order.targets.iter().find_map(|id| {
        let plan = vehicles.get(id)?.plans.plan.content.as_ref()?;
        let mark = ContentHash::of(plan.flown()).0;
        let first = known
            .insert(mark, *id)
            .filter(|_| !plan.flown().is_empty())?;
        Some(text!("hazard-plan-same", first = first, second = *id))
    })
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::app::state::FlightView;
    use crate::geo::LatLon;
    use crate::language::{Context, Meaning, parse};
    use crate::plan::Item;
    use crate::vehicle::{Plan, Stored, Transfer, Vehicle};

    fn carrying(height_m: f32) -> Vehicle {
        let mut vehicle = Vehicle::new(1, 1);
        let item = Item {
            command: 22,
            frame: 3,
            z: height_m,
            ..Item::default()
        };
        vehicle.plans.plan = Stored {
            content: Some(Arc::new(Plan {
                items: vec![item],
                home_first: false,
            })),
            transfer: Transfer::Done,
        };
        vehicle
    }

    fn order(line: &str) -> Order {
        let statement = parse(line, &Context::default()).expect("a line");
        let Meaning::Act(act) = statement.meaning else {
            panic!("{line}");
        };
        Order {
            line: line.to_owned(),
            verb: statement.verb,
            targets: vec![1],
            act,
            by: None,
        }
    }

    /// A plan that failed in a rehearsal is started only after a confirmation, until another plan
    /// is on board or the same plan passes.
    #[test]
    fn a_failed_rehearsal_makes_the_start_of_its_plan_dangerous() {
        let mut view = FlightView::default();
        view.insert(Arc::new(carrying(20.0)));
        let plan = carrying(20.0).plans.plan.content.expect("a plan");
        let failed = FailedRehearsal {
            vehicle: 1,
            plan: ContentHash::of(plan.flown()),
            reason: Text::verbatim("does not take off"),
        };
        let start = order("plan start");
        assert_eq!(view.hazard(&start), None);
        let findings = RehearsalFindings {
            failed: vec![failed],
            ..RehearsalFindings::default()
        };
        view.note_rehearsal(findings.clone());
        let reason = view.hazard(&start).expect("it asks").to_string();
        assert!(reason.contains("does not take off"), "{reason}");
        assert_eq!(view.hazard(&order("plan skip")), None);
        view.insert(Arc::new(carrying(25.0)));
        assert_eq!(view.hazard(&start), None, "another plan");
        view.insert(Arc::new(carrying(20.0)));
        view.note_rehearsal(RehearsalFindings {
            passed: vec![1],
            ..RehearsalFindings::default()
        });
        assert_eq!(view.hazard(&start), None, "it passes now");
    }

    /// The question names the other vehicle and the command that rehearses without it.
    #[test]
    fn a_plan_that_met_another_names_it() {
        let mut view = FlightView::default();
        view.insert(Arc::new(carrying(20.0)));
        let plan = carrying(20.0).plans.plan.content.expect("a plan");
        view.note_rehearsal(RehearsalFindings {
            failed: vec![FailedRehearsal {
                vehicle: 1,
                plan: ContentHash::of(plan.flown()),
                reason: Text::verbatim("comes too close"),
            }],
            meetings: vec![Meeting {
                vehicles: [1, 3],
                at_point: LatLon::new(50.45, 30.52),
            }],
            ..RehearsalFindings::default()
        });
        let reason = view.hazard(&order("plan start")).expect("it asks");
        let reason = reason.to_string();
        assert!(
            reason.contains("too close: 1/3; to rehearse only these plans: `1 plan rehearse`"),
            "{reason}"
        );
    }

    /// A later rehearsal of other vehicles keeps the pair; a rehearsal of either of its vehicles
    /// replaces it.
    #[test]
    fn a_pair_stays_known_until_one_of_it_is_rehearsed_again() {
        let mut view = FlightView::default();
        view.insert(Arc::new(carrying(20.0)));
        let plan = carrying(20.0).plans.plan.content.expect("a plan");
        view.note_rehearsal(RehearsalFindings {
            failed: vec![FailedRehearsal {
                vehicle: 1,
                plan: ContentHash::of(plan.flown()),
                reason: Text::verbatim("comes too close"),
            }],
            meetings: vec![Meeting {
                vehicles: [1, 3],
                at_point: LatLon::new(50.45, 30.52),
            }],
            passed: vec![2, 4],
        });
        let others = |passed: Vec<VehicleId>| RehearsalFindings {
            passed,
            ..RehearsalFindings::default()
        };
        view.note_rehearsal(others(vec![5, 6]));
        let start = order("plan start");
        let reason = view.hazard(&start).expect("it asks").to_string();
        assert!(reason.contains("too close: 1/3"), "{reason}");
        view.note_rehearsal(others(vec![3]));
        assert!(view.rehearsed.meetings().is_empty());
    }

    #[test]
    fn all_plans_that_failed_are_named_by_their_reasons() {
        let mut view = FlightView::default();
        let plan = carrying(20.0).plans.plan.content.expect("a plan");
        let mut failed = Vec::new();
        for (id, reason) in [(1, "collides"), (2, "collides"), (3, "hits the ground")] {
            let mut vehicle = carrying(20.0);
            vehicle.id = id;
            view.insert(Arc::new(vehicle));
            failed.push(FailedRehearsal {
                vehicle: id,
                plan: ContentHash::of(plan.flown()),
                reason: Text::verbatim(reason),
            });
        }
        view.note_rehearsal(RehearsalFindings {
            failed,
            meetings: vec![Meeting {
                vehicles: [1, 2],
                at_point: LatLon::new(50.45, 30.52),
            }],
            ..RehearsalFindings::default()
        });
        let mut start = order("plan start");
        start.targets = vec![1, 2, 3];
        let reason = view.hazard(&start).expect("it asks").to_string();
        for part in ["1-2: collides", "3: hits the ground", "too close: 1/2"] {
            assert!(reason.contains(part), "{part}: {reason}");
        }
        assert!(!reason.contains("plan rehearse"), "{reason}");
    }

    /// A draft that fails before its upload makes the start of its plan dangerous, as a plan on
    /// board does.
    #[test]
    fn a_failed_rehearsal_of_a_draft_makes_the_start_of_its_plan_dangerous() {
        let mut view = FlightView::default();
        view.insert(Arc::new(carrying(20.0)));
        let plan = carrying(20.0).plans.plan.content.expect("a plan");
        let verdict = |failure: Option<&str>| PlanVerdict {
            plan: ContentHash::of(plan.flown()),
            failure: failure.map(Text::verbatim),
        };
        let start = order("plan start");
        view.rehearsed.note_trial(&[verdict(None)]);
        assert_eq!(view.hazard(&start), None);
        view.rehearsed
            .note_trial(&[verdict(Some("meets 2 at 0:20")), verdict(None)]);
        let reason = view.hazard(&start).expect("it asks").to_string();
        assert!(reason.contains("meets 2 at 0:20"), "{reason}");
        view.insert(Arc::new(carrying(25.0)));
        assert_eq!(view.hazard(&start), None, "another plan");
        view.insert(Arc::new(carrying(20.0)));
        view.note_rehearsal(RehearsalFindings {
            passed: vec![1],
            ..RehearsalFindings::default()
        });
        assert_eq!(view.hazard(&start), None, "it passes on board");
    }

    #[test]
    fn vehicles_with_the_same_plan_start_together_only_after_a_confirmation() {
        let mut view = FlightView::default();
        let second = |height_m| {
            let mut vehicle = carrying(height_m);
            vehicle.id = 2;
            Arc::new(vehicle)
        };
        view.insert(Arc::new(carrying(20.0)));
        view.insert(second(20.0));
        let mut start = order("plan start");
        assert_eq!(view.hazard(&start), None, "one vehicle");
        start.targets = vec![1, 2];
        let reason = view.hazard(&start).expect("it asks").to_string();
        assert!(reason.contains("1 and 2 carry the same plan"), "{reason}");
        view.insert(second(25.0));
        assert_eq!(view.hazard(&start), None);
    }
}
