//! What the record of a flight says about an element of a rubric.

use crate::scoring::{Component, LedgerReport, Report, UseReport};
use crate::text;
use crate::text::{Text, figure};

/// A subject on which a record is asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EvidenceKind {
    /// The objectives, and those that were not met.
    Objectives,
    /// The alerts and how they were answered.
    Alerts,
    /// Commands that failed or were refused.
    Refusals,
    /// The number of commands, and how many vehicles they addressed.
    Commands,
    /// The time that vehicles in the air waited for a task.
    Idle,
    /// The share of the time in which the trainee was busy.
    Workload,
    /// The hints that were taken.
    Hints,
    /// The predicted score beside the reached one.
    Prediction,
    /// Vehicles that crashed or were disarmed in the air.
    Crashes,
    /// A component of the score, with its main cause.
    Component(Component),
}

impl EvidenceKind {
    const OWN: [(&'static str, Self); 9] = [
        ("objectives", Self::Objectives),
        ("alerts", Self::Alerts),
        ("refusals", Self::Refusals),
        ("commands", Self::Commands),
        ("idle", Self::Idle),
        ("workload", Self::Workload),
        ("hints", Self::Hints),
        ("prediction", Self::Prediction),
        ("crashes", Self::Crashes),
    ];

    /// The kinds with their names in rubrics.
    pub fn named() -> impl Iterator<Item = (&'static str, Self)> {
        let components = Component::ALL.map(|it| (it.name(), Self::Component(it)));
        Self::OWN.into_iter().chain(components)
    }

    /// The kind with this name.
    pub fn by_name(name: &str) -> Option<Self> {
        let mut all = Self::named();
        all.find(|(known, _)| *known == name).map(|(_, kind)| kind)
    }

    /// What the report of a flight says; `None` if it says nothing about this.
    pub fn of(self, report: &Report) -> Option<Text> {
        match self {
            Self::Objectives => objectives(report),
            Self::Alerts => alerts(report),
            Self::Refusals => refusals(&report.ledger),
            Self::Commands => commands(report),
            Self::Idle => idle(&report.usage),
            Self::Workload => workload(report),
            Self::Hints => Some(text!("evidence-hints", count = report.hints.len())),
            Self::Prediction => prediction(report),
            Self::Crashes => Some(crashes(&report.usage)),
            Self::Component(component) => of_component(report, component),
        }
    }
}

fn objectives(report: &Report) -> Option<Text> {
    let missed: Vec<Text> = report
        .objectives
        .iter()
        .filter(|it| !it.met)
        .map(|it| it.title.clone())
        .collect();
    let count = report.objectives.len();
    let met = count - missed.len();
    let is_whole = missed.is_empty();
    let missed = Text::joined(", ", missed);
    (count > 0).then(|| {
        if is_whole {
            text!("evidence-objectives-all", count = count)
        } else {
            text!(
                "evidence-objectives",
                met = met,
                count = count,
                missed = missed
            )
        }
    })
}

fn alerts(report: &Report) -> Option<Text> {
    let count = report.alerts.len();
    let in_time = report.alerts.iter().filter(|it| it.in_time).count();
    let answers = report.alerts.iter().filter_map(|it| it.answered_after_s);
    let slowest = answers.max_by(f64::total_cmp);
    (count > 0).then(|| match slowest {
        Some(seconds) => text!(
            "evidence-alerts",
            in_time = in_time,
            count = count,
            slowest = figure(seconds, 0)
        ),
        None => text!("evidence-alerts-unanswered", count = count),
    })
}

fn refusals(ledger: &[LedgerReport]) -> Option<Text> {
    let is_failed = |it: &&LedgerReport| it.rows.iter().any(|row| row.state.is_failure());
    let failed = ledger.iter().filter(is_failed).count();
    let count = ledger.len();
    (count > 0).then(|| text!("evidence-refusals", failed = failed, count = count))
}

fn commands(report: &Report) -> Option<Text> {
    let count = report.ledger.len();
    let minutes = report.sim_time_s / 60.0;
    (count > 0 && minutes > 0.0).then(|| {
        text!(
            "evidence-commands",
            count = count,
            rate = figure(count as f64 / minutes, 1),
            percent = figure(100.0 * report.swarm.group_share, 0)
        )
    })
}

fn idle(usage: &[UseReport]) -> Option<Text> {
    let sum = |time: fn(&UseReport) -> f64| usage.iter().map(time).sum::<f64>();
    let airborne_s = sum(|it| it.airborne_s);
    let percent = 100.0 * sum(|it| it.idle_s) / airborne_s;
    (airborne_s > 0.0).then(|| text!("evidence-idle", percent = figure(percent, 0)))
}

fn workload(report: &Report) -> Option<Text> {
    let shares = &report.workload.utilisation;
    let mean = shares.iter().sum::<f64>() / shares.len() as f64;
    let most = shares.iter().copied().max_by(f64::total_cmp)?;
    Some(text!(
        "evidence-workload",
        mean = figure(100.0 * mean, 0),
        most = figure(100.0 * most, 0)
    ))
}

fn prediction(report: &Report) -> Option<Text> {
    let prediction = report.prediction?;
    Some(text!(
        "evidence-prediction",
        predicted = prediction.predicted,
        score = report.score
    ))
}

fn crashes(usage: &[UseReport]) -> Text {
    let fallen = usage.iter().filter(|it| it.crashed);
    let fallen: Vec<String> = fallen.map(|it| it.vehicle.to_string()).collect();
    if fallen.is_empty() {
        text!("evidence-no-crash")
    } else {
        text!("evidence-crashes", vehicles = fallen.join(", "))
    }
}

fn of_component(report: &Report, component: Component) -> Option<Text> {
    let mut components = report.components.iter();
    let found = components.find(|it| it.component == component)?;
    Some(text!(
        "evidence-component",
        component = component.title(),
        percent = figure(100.0 * found.value, 0),
        cause = found.moved_by.clone()
    ))
}

#[cfg(test)]
mod tests;
