//! The competencies of a swarm operator, and a flight's evidence on them.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::CareerFlight;
use crate::mission::{Mission, Skill, Trying};
use crate::scoring::{Component, ENERGY_NEEDS_OBJECTIVES, Report};
use crate::text;
use crate::text::Text;

fn shown_by(component: Component) -> Option<Skill> {
    match component {
        Component::Command => Some(Skill::K2),
        Component::Energy => Some(Skill::K4),
        Component::Attention => Some(Skill::K8),
        Component::Safety => Some(Skill::K9),
        Component::Utilisation => Some(Skill::K10),
        Component::Objective | Component::Quality | Component::Time => None,
    }
}

/// The part of a flight that shows a skill.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum EvidenceBasis {
    /// An objective, by its id.
    Objective(String),
    Component(Component),
    /// The prediction of the score.
    Prediction,
}

/// One opportunity to show a skill, and its outcome.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Evidence {
    pub skill: Skill,
    /// The outcome, 0 to 1.
    pub outcome: f64,
    /// The basis; `None` in profiles from before this field existed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub basis: Option<EvidenceBasis>,
    /// The name of the basis; in a profile, the English one.
    pub what: Text,
}

/// The error of a prediction at which the outcome is zero, in points.
const BLIND_POINTS: f64 = 250.0;
/// Outcomes are rounded to thousandths, so storage does not change a career.
const STEPS: f64 = 1000.0;
/// An outcome below this counts against a skill in any flight (see `docs/career.md`).
const FAULT: f64 = 0.1;

/// A flight's evidence on one skill. It counts once: showing a skill three times in one flight is not stronger
/// evidence.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SkillShown {
    pub skill: Skill,
    /// The mean of the outcomes, 0 to 1.
    pub outcome: f64,
    /// The names of the evidence's bases.
    pub what: Text,
}

impl CareerFlight {
    /// The flight's evidence on each skill, in order.
    pub(super) fn shown_skills(&self) -> Vec<SkillShown> {
        let mut by_skill: BTreeMap<Skill, Vec<&Evidence>> = BTreeMap::new();
        for evidence in &self.evidence {
            by_skill.entry(evidence.skill).or_default().push(evidence);
        }
        let shown = by_skill.into_iter().map(|(skill, seen)| SkillShown {
            skill,
            outcome: seen.iter().map(|it| it.outcome).sum::<f64>() / seen.len() as f64,
            what: Text::joined(", ", seen.iter().map(|it| it.what.clone()).collect()),
        });
        shown.collect()
    }
}

impl Evidence {
    fn new(skill: Skill, outcome: f64, basis: EvidenceBasis, what: Text) -> Self {
        Self {
            skill,
            outcome: (outcome.clamp(0.0, 1.0) * STEPS).round() / STEPS,
            basis: Some(basis),
            what,
        }
    }

    /// A flight's evidence: every attempted objective for the skill of its kind, the components of
    /// the score that show a skill, and the prediction. A flight abandoned before any command gives
    /// none. A failed flight gives only evidence of faults; otherwise a hover with a few blind
    /// reports would count as keeping all rules.
    pub fn of(report: &Report, mission: &Mission) -> Vec<Self> {
        if report.ledger.is_empty() {
            return Vec::new();
        }
        let has_flown = report.usage.iter().any(|used| used.airborne_s > 0.0);
        let mut found = Self::of_objectives(report, mission, has_flown);
        found.extend(Self::of_components(report, has_flown));
        found.extend(Self::of_prediction(report));
        found.retain(|shown| report.passed || shown.outcome < FAULT);
        found
    }

    fn of_objectives(report: &Report, mission: &Mission, has_flown: bool) -> Vec<Self> {
        let skills: BTreeMap<&str, Option<Skill>> = mission.objective_skills().collect();
        let objectives = report.objectives.iter().filter_map(|objective| {
            let skill = skills.get(objective.id.as_str()).copied().flatten()?;
            let share = objective.points / objective.points_max.max(f64::EPSILON);
            let is_tried = share > 0.0
                || match mission.trying(&objective.id) {
                    Some(Trying::Always) => true,
                    Some(Trying::Report) => !report.truth.marks.is_empty(),
                    Some(Trying::Progress) | None => false,
                };
            // Arming alone is not evidence yet.
            (is_tried && (has_flown || share <= 0.0)).then_some(())?;
            let basis = EvidenceBasis::Objective(objective.id.clone());
            Some(Self::new(skill, share, basis, objective.title.clone()))
        });
        objectives.collect()
    }

    fn of_components(report: &Report, has_flown: bool) -> Vec<Self> {
        let mut parts = report.components.iter();
        let objective = parts.find(|it| it.component == Component::Objective);
        let reached = objective.map_or(0.0, |it| it.value);
        let components = report.components.iter().filter_map(|shown| {
            let component = shown.component;
            let skill = shown_by(component)?;
            // A component without weight, or of a flight that never began, is not evidence; energy is not judged
            // if too little was reached.
            let is_shown = match component {
                Component::Command => true,
                Component::Energy => has_flown && reached >= ENERGY_NEEDS_OBJECTIVES,
                Component::Objective
                | Component::Quality
                | Component::Time
                | Component::Safety
                | Component::Attention
                | Component::Utilisation => has_flown,
            };
            let basis = EvidenceBasis::Component(component);
            (is_shown && shown.weight > 0.0)
                .then(|| Self::new(skill, shown.value, basis, component.title()))
        });
        components.collect()
    }

    fn of_prediction(report: &Report) -> Option<Self> {
        let prediction = report.prediction.as_ref()?;
        let off = f64::from(prediction.error.unsigned_abs()) / BLIND_POINTS;
        let basis = EvidenceBasis::Prediction;
        Some(Self::new(
            Skill::K12,
            1.0 - off,
            basis,
            text!("skill-prediction"),
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mission::fake::Pilot;
    use crate::text::said::without_words;

    fn shown(report: &Report, mission: &Mission) -> Vec<(Skill, f64)> {
        let evidence = Evidence::of(report, mission).into_iter();
        evidence.map(|it| (it.skill, it.outcome)).collect()
    }

    #[test]
    fn evidence_and_faults_do_not_depend_on_the_words() {
        let shown = || {
            let source = include_str!("../../missions/00-first-flight.toml");
            let mission = Mission::parse(source).expect("it is good");
            let mut pilot = Pilot::flying(mission, 1);
            pilot.take_off(20.0);
            pilot.wait(12.0);
            pilot.land();
            pilot.flight.abandon();
            let report = pilot.report();
            let fault = report.fault();
            let report = Report {
                passed: true,
                ..report
            };
            let evidence = Evidence::of(&report, pilot.flight.mission()).into_iter();
            let bases: Vec<_> = evidence
                .map(|it| (it.skill, it.outcome, it.basis))
                .collect();
            (fault, bases)
        };
        let (fault, bases) = shown();
        assert!(fault.is_none() && !bases.is_empty(), "{fault:?}");
        assert_eq!(without_words(shown), (fault, bases));
    }

    #[test]
    fn what_was_not_tried_is_not_shown_badly() {
        let source = include_str!("../../missions/00-first-flight.toml");
        let mission = Mission::parse(source).expect("it is good");
        let mut pilot = Pilot::flying(mission, 1);
        pilot.take_off(20.0);
        pilot.wait(12.0);
        pilot.land();
        pilot.flight.abandon();
        let report = Report {
            passed: true,
            ..pilot.report()
        };
        let evidence = Evidence::of(&report, pilot.flight.mission());
        let is_of = |id: &str| {
            let mut objectives = report.objectives.iter();
            let title = objectives.find(|it| it.id == id).map(|it| it.title.clone());
            evidence.iter().any(|it| Some(&it.what) == title.as_ref())
        };
        assert!(is_of("hover") && !is_of("gates"), "{evidence:?}");
    }

    #[test]
    fn energy_is_not_judged_where_too_little_was_reached() {
        let mut pilot = Pilot::new(1);
        pilot.take_off(20.0);
        pilot.land();
        pilot.flight.abandon();
        let shown = shown(&pilot.report(), pilot.flight.mission());
        assert!(
            shown.iter().all(|(skill, _)| *skill != Skill::K4),
            "{shown:?}"
        );
    }

    #[test]
    fn a_flight_that_failed_shows_nothing_that_went_well() {
        let mut pilot = Pilot::new(1);
        pilot.take_off(20.0);
        pilot.land();
        pilot.flight.abandon();
        let (mission, mut report) = (pilot.flight.mission(), pilot.report());
        // The result does not depend on the objective's share.
        for objective in &mut report.objectives {
            objective.points = objective.points_max * 0.9;
        }
        let well = |shown: &[(Skill, f64)]| shown.iter().any(|(_, outcome)| *outcome >= FAULT);
        assert!(!report.passed);
        assert!(!well(&shown(&report, mission)));
        report.passed = true;
        assert!(well(&shown(&report, mission)));
    }

    /// The good outcomes of a failed flight do not count, even if they are many.
    #[test]
    fn the_career_guide_names_the_outcomes_that_count_in_a_failed_flight() {
        let guide = include_str!("../../docs/career.md");
        let rule = format!(
            "If the mission is not passed, only outcomes below {:.0} % count.",
            FAULT * 100.0
        );
        assert!(guide.contains(&rule), "{rule}");
        let mut pilot = Pilot::new(1);
        pilot.take_off(20.0);
        pilot.land();
        pilot.flight.abandon();
        let mut report = pilot.report();
        for (index, objective) in report.objectives.iter_mut().enumerate() {
            let share = if index == 0 { 0.5 * FAULT } else { 0.9 };
            objective.points = objective.points_max * share;
        }
        let evidence = Evidence::of(&report, pilot.flight.mission());
        let is_low = |it: &Evidence| it.outcome < FAULT;
        let objective = EvidenceBasis::Objective(report.objectives[0].id.clone());
        assert!(evidence.iter().all(is_low), "{evidence:?}");
        assert!(
            evidence
                .iter()
                .any(|it| it.basis.as_ref() == Some(&objective)),
            "{evidence:?}"
        );
    }
}
