//! The facts and the report of a flight.

use std::collections::BTreeSet;

use super::{Flight, ObjectiveScene};
use crate::ledger::{Ledger, LedgerEntry};
use crate::mission::Clue;
use crate::pilot_in_command::Person;
use crate::record::InstructorPart;
use crate::scoring::{
    AlertReport, CommandTally, ComponentReport, Facts, FlightBackend, FlightOutcome, HintReport,
    LedgerReport, ObjectiveFact, ObjectiveReport, Report, RowReport, Score, ScoreGrade, UseReport,
    improvements, rounded_below, score,
};

use crate::text::rounded;
use crate::verb::CountsAs;

/// The facts that the score depends on.
pub(super) fn facts(flight: &Flight, scene: &ObjectiveScene<'_>) -> Facts {
    let states = flight
        .goals
        .standings(scene)
        .into_iter()
        .zip(flight.goals.details(scene));
    let objectives = flight.mission.objectives.iter().zip(states);
    let used: Vec<f64> = flight
        .crafts
        .iter()
        .filter_map(super::Craft::used_wh)
        .collect();
    Facts {
        objectives: objectives
            .map(|(objective, (standing, details))| ObjectiveFact {
                id: objective.id.clone(),
                title: objective.title.clone(),
                value: objective.value,
                fraction: standing.fraction,
                measure: standing.measure,
                measure_unit: objective.kind.measure_unit(),
                met: standing.met,
                mandatory: objective.mandatory,
                result: details.result,
                target: details.target,
                advice: details.advice,
                product: details.product,
            })
            .collect(),
        elapsed: flight.elapsed,
        energy_wh: (!used.is_empty()).then(|| used.iter().sum()),
        safety: flight.journal.broken_rules().to_vec(),
        commands: judged(flight, flight.orders.tally()),
        alerts: flight.threats.engine().alert_facts().to_vec(),
        vehicles: flight.mission.seats.count,
        usage: flight.vehicle_uses(),
        hints: flight.clues.used(&flight.mission),
        given_up: flight.outcome == FlightOutcome::Abandoned,
    }
}

/// The tally without the refusals that the mission's lesson intends.
fn judged(flight: &Flight, tally: CommandTally) -> CommandTally {
    tally.forgiving(flight.mission.scoring.free_refusals)
}

/// The members of the crew who gave commands, by name.
fn crew(ledger: &Ledger) -> Vec<String> {
    let members = ledger.judged_entries();
    let others = members.filter_map(|entry| entry.by.as_ref());
    let names: BTreeSet<&str> = others.map(Person::name).collect();
    names.into_iter().map(str::to_owned).collect()
}

pub(super) fn report(flight: &Flight, ledger: &Ledger) -> Report {
    let mut facts = facts(flight, &flight.final_scene());
    // Rows may have ended after the last step.
    facts.commands = judged(flight, flight.orders.tally_of(ledger));
    let mission = &flight.mission;
    let score = score(&mission.scoring, &facts);
    let entries = flight.orders.entries(ledger);
    let commands: Vec<_> = entries
        .filter(|(_, entry)| entry.verb.counts_as != CountsAs::SelfReport)
        .collect();
    let place_of = |command| commands.iter().position(|(_, entry)| entry.id == command);
    Report {
        mission: mission.id.clone(),
        revision: mission.rev,
        seed: flight.seed,
        backend: FlightBackend::Embedded,
        flown_by: flight.flown_by,
        crew: crew(ledger),
        mission_file: None,
        passed: flight.outcome == FlightOutcome::Passed,
        given_up: facts.given_up,
        score: score.points,
        medal: score
            .medal
            .filter(|_| flight.outcome == FlightOutcome::Passed),
        sim_time_s: rounded(flight.elapsed.as_secs_f64(), 1),
        objectives: objectives(&facts),
        components: components(&score),
        subtotal: rounded(f64::from(score.subtotal_tenths) / 10.0, 1),
        hint_factor: rounded(score.hint_factor, 2),
        ledger: commands
            .iter()
            .map(|(at, entry)| command(at.as_secs_f64(), entry))
            .collect(),
        events: flight.journal.events(place_of),
        title: mission.title.clone(),
        outcome: flight.outcome,
        grade: ScoreGrade::of(score.points),
        vehicles: flight.crafts.len(),
        time_limit_s: rounded(mission.rules.time_limit.as_secs_f64(), 1),
        par_time_s: rounded(mission.scoring.par_time.as_secs_f64(), 1),
        energy_wh: facts.energy_wh.map(|energy| rounded(energy, 2)),
        par_energy_wh: rounded(mission.scoring.par_energy_wh, 2),
        improvements: improvements(&mission.scoring, &facts),
        attempt: flight.clues.attempt(),
        hints: hints(flight),
        prediction: flight.prediction_report(&score),
        goal: flight.goal_report(&facts, &score),
        alerts: facts.alerts.iter().map(AlertReport::from).collect(),
        usage: uses(&facts),
        swarm: flight.swarm.figures(&flight.crafts, flight.elapsed),
        workload: flight.swarm.workload(),
        truth: flight.truth_report(),
        instructor: InstructorPart::default(),
        drill: None,
        tries: Vec::new(),
        gold_missing: score.gold_missing,
        wall_time_s: None,
    }
}

fn uses(facts: &Facts) -> Vec<UseReport> {
    let has_crashed = |vehicle| {
        let mut safety = facts.safety.iter();
        safety.any(|event| event.vehicle == vehicle && event.kind.is_loss())
    };
    let uses = facts.usage.iter();
    uses.map(|one| UseReport {
        crashed: has_crashed(one.vehicle),
        ..UseReport::from(one)
    })
    .collect()
}

fn hints(flight: &Flight) -> Vec<HintReport> {
    let report = |(at_s, clue): (f64, &Clue)| HintReport {
        at_s: rounded(at_s, 1),
        level: clue.level,
        text: flight.filled(&clue.text),
    };
    flight
        .clues
        .all(&flight.mission.advice.clues)
        .map(report)
        .collect()
}

fn objectives(facts: &Facts) -> Vec<ObjectiveReport> {
    let report = |objective: &ObjectiveFact| ObjectiveReport {
        id: objective.id.clone(),
        title: objective.title.clone(),
        mandatory: objective.mandatory,
        met: objective.met,
        result: objective.result.clone(),
        target: objective.target.clone(),
        // A part never looks like the whole.
        points: rounded(
            rounded_below(
                objective.value * objective.fraction * 10.0,
                objective.value * 10.0,
            ) / 10.0,
            1,
        ),
        points_max: rounded(objective.value, 1),
    };
    facts.objectives.iter().map(report).collect()
}

fn components(score: &Score) -> Vec<ComponentReport> {
    let report = |component: &crate::scoring::ComponentScore| ComponentReport {
        component: component.component,
        weight: rounded(component.weight, 3),
        value: rounded(component.value, 3),
        points: rounded(f64::from(component.points_tenths) / 10.0, 1),
        moved_by: component.moved_by.clone(),
    };
    score.components.iter().map(report).collect()
}

fn command(at_s: f64, entry: &LedgerEntry) -> LedgerReport {
    let row = |row: &crate::ledger::LedgerRow| RowReport {
        vehicle: row.vehicle,
        state: row.state,
        tries: row.tries,
        explanation: row.explanation.clone(),
    };
    LedgerReport {
        at_s: rounded(at_s, 1),
        line: entry.line.clone(),
        by: entry.by.clone(),
        rows: entry.rows.iter().map(row).collect(),
    }
}
