//! The differences between two flights of a mission.

use std::collections::BTreeSet;
use std::time::Duration;

use super::ComparedFlight;
use crate::language::{self, words};
use crate::ledger::RowState;
use crate::scoring::{EventKind, LedgerReport, Report};
use crate::text;
use crate::text::{Text, clock, rounded};

/// One difference between two flights.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// The mission time at which the flights first differ; `None` if the difference is known only
    /// at the end.
    pub at: Option<Duration>,
    /// The subject of the difference.
    pub what: Text,
    /// The value in the flight that is examined.
    pub own: Text,
    /// The value of the other flight.
    pub other: Text,
    /// The score gained over the other flight; `None` if the difference has no direct effect on the
    /// score.
    pub points: Option<f64>,
}

const SAME_TIME: Duration = Duration::from_secs(2);
const SAME_POINTS: f64 = 0.5;

/// The differences between two flights: first those during the flights, by time, then those of the score, the largest
/// first.
pub fn differences(own: &ComparedFlight, other: &ComparedFlight) -> Vec<Difference> {
    let mut timed: Vec<Difference> = objectives(own, other);
    timed.extend(times(text!("compare-takeoff"), own.takeoff, other.takeoff));
    timed.extend(commands(&own.report, &other.report));
    timed.extend(alerts(&own.report, &other.report));
    timed.extend(counts(&own.report, &other.report));
    timed.sort_by_key(|it| it.at);
    let mut scored = components(&own.report, &other.report);
    scored.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
    timed.extend(scored);
    timed
}

fn cost(difference: &Difference) -> f64 {
    difference.points.unwrap_or_default()
}

fn time(at: Option<Duration>) -> Text {
    at.map_or_else(|| text!("compare-never"), |at| clock(at).into())
}

/// The difference between the times of an event in the two flights; `None` if there is no
/// difference.
fn times(what: Text, own: Option<Duration>, other: Option<Duration>) -> Option<Difference> {
    let is_same = match (own, other) {
        (Some(own), Some(other)) => own.abs_diff(other) < SAME_TIME,
        (None, None) => true,
        (Some(_), None) | (None, Some(_)) => false,
    };
    (!is_same).then(|| Difference {
        at: own.into_iter().chain(other).min(),
        what,
        own: time(own),
        other: time(other),
        points: None,
    })
}

fn objectives(own: &ComparedFlight, other: &ComparedFlight) -> Vec<Difference> {
    let reports = own.report.objectives.iter().zip(&other.report.objectives);
    let reached = own.reached.iter().zip(&other.reached);
    let both = reports.zip(reached);
    both.filter_map(|((mine, theirs), (&reached, &their_reached))| {
        let points = rounded(mine.points - theirs.points, 1);
        if mine.met != theirs.met {
            return Some(Difference {
                at: reached.into_iter().chain(their_reached).min(),
                what: mine.title.clone(),
                own: mine.result.clone(),
                other: theirs.result.clone(),
                points: Some(points),
            });
        }
        let difference = times(mine.title.clone(), reached, their_reached)?;
        let points = (points.abs() >= SAME_POINTS).then_some(points);
        Some(Difference {
            points,
            ..difference
        })
    })
    .collect()
}

/// The first command that differs; `None` if all commands are the same.
fn commands(own: &Report, other: &Report) -> Option<Difference> {
    let [mine, theirs] = [own, other].map(|report| {
        let entries = report.ledger.iter();
        entries
            .filter(|it| is_flight_command(it))
            .collect::<Vec<_>>()
    });
    let is_same = |at: &usize| match (mine.get(*at), theirs.get(*at)) {
        (Some(mine), Some(theirs)) => is_same_command(mine, theirs),
        (Some(_), None) | (None, Some(_) | None) => false,
    };
    let longest = mine.len().max(theirs.len());
    let first = (0..longest).find(|at| !is_same(at))?;
    let (mine, theirs) = (mine.get(first).copied(), theirs.get(first).copied());
    let line = |entry: Option<&LedgerReport>| match entry {
        Some(entry) => Text::verbatim(entry.line.clone()),
        None => text!("compare-nothing"),
    };
    let when = mine.into_iter().chain(theirs).map(|it| it.at_s);
    let at = when.min_by(f64::total_cmp)?;
    Some(Difference {
        at: Duration::try_from_secs_f64(at).ok(),
        what: text!("compare-first-command"),
        own: line(mine),
        other: line(theirs),
        points: None,
    })
}

/// Whether an entry is a command, not a message to the mission such as a prediction or a goal.
fn is_flight_command(entry: &LedgerReport) -> bool {
    let words = words(&entry.line);
    let mut verbs = words.iter().skip_while(|word| word.is_targets());
    let named = verbs.next().and_then(|verb| language::row(verb.text));
    // Words without a row are modes.
    named.is_none_or(|row| !row.verb.counts_as.is_said_to_mission())
}

/// Whether two lines gave the same command to the same vehicles: `1 guided` is `all guided` if 1 is the only vehicle.
fn is_same_command(mine: &LedgerReport, theirs: &LedgerReport) -> bool {
    let vehicles = |entry: &LedgerReport| -> BTreeSet<u16> {
        let rows = entry.rows.iter();
        rows.map(|row| row.vehicle).collect()
    };
    if mine.rows.is_empty() || vehicles(mine) != vehicles(theirs) {
        return mine.line == theirs.line;
    }
    let (mine, theirs) = (words(&mine.line), words(&theirs.line));
    let mine = mine.iter().skip_while(|word| word.is_targets());
    let theirs = theirs.iter().skip_while(|word| word.is_targets());
    mine.map(|word| word.text).eq(theirs.map(|word| word.text))
}

/// The difference in the alerts: how many there were, and how many were not answered in time.
fn alerts(own: &Report, other: &Report) -> Option<Difference> {
    let answered = |report: &Report| {
        let late = report.alerts.iter().filter(|it| !it.in_time).count();
        text!(
            "compare-alerts-late",
            late = late,
            count = report.alerts.len()
        )
    };
    let (mine, theirs) = (answered(own), answered(other));
    let first = own.alerts.iter().chain(&other.alerts).map(|it| it.at_s);
    let at = first.min_by(f64::total_cmp);
    (mine != theirs).then(|| Difference {
        at: at.and_then(|at| Duration::try_from_secs_f64(at).ok()),
        what: text!("compare-alerts"),
        own: mine,
        other: theirs,
        points: None,
    })
}

/// The differences in the number of refused commands and of broken rules.
fn counts(own: &Report, other: &Report) -> Vec<Difference> {
    let refused = |report: &Report| {
        let entries = report.ledger.iter();
        entries
            .filter(|it| it.rows.iter().any(|row| row.state == RowState::Refused))
            .count()
    };
    let broken = |report: &Report| {
        let events = report.events.iter();
        events.filter(|it| it.kind == EventKind::Rule).count()
    };
    let first = |kind: EventKind| {
        let events = own.events.iter().chain(&other.events);
        let times = events.filter(|it| it.kind == kind).map(|it| it.at_s);
        let first = times.min_by(f64::total_cmp);
        first.and_then(|at| Duration::try_from_secs_f64(at).ok())
    };
    let counted = [
        (
            text!("compare-refused"),
            EventKind::Rejected,
            refused(own),
            refused(other),
        ),
        (
            text!("compare-broken"),
            EventKind::Rule,
            broken(own),
            broken(other),
        ),
    ];
    let differ = counted
        .into_iter()
        .filter(|(_, _, mine, theirs)| mine != theirs);
    differ
        .map(|(what, kind, mine, theirs)| Difference {
            at: first(kind),
            what,
            own: mine.to_string().into(),
            other: theirs.to_string().into(),
            points: None,
        })
        .collect()
}

fn components(own: &Report, other: &Report) -> Vec<Difference> {
    let both = own.components.iter().filter_map(|mine| {
        let theirs = other
            .components
            .iter()
            .find(|it| it.component == mine.component)?;
        Some((mine, theirs))
    });
    both.filter_map(|(mine, theirs)| {
        let points = rounded(mine.points - theirs.points, 1);
        (points.abs() >= SAME_POINTS).then(|| Difference {
            at: None,
            what: mine.component.title(),
            own: format!("{:.1}", mine.points).into(),
            other: format!("{:.1}", theirs.points).into(),
            points: Some(points),
        })
    })
    .collect()
}
