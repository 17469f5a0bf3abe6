//! Flights as xAPI statements: one JSON object per line, as a learning record store takes them.
//!
//! Source: ADL, "Experience API", part 2 (statements), version 1.0.3; the verbs are those of ADL.

use std::fmt::Write as _;

use serde_json::{Value, json};

use crate::class_results::{ClassFlight, ClassTrainee, FlownObjective};
use crate::hash::fnv1a;
use crate::scoring::ALL_POINTS;
use crate::text::{Language, Locale};

const VERBS: &str = "http://adlnet.gov/expapi/verbs/";
const SIMULATION: &str = "http://adlnet.gov/expapi/activities/simulation";
const COURSE: &str = "http://adlnet.gov/expapi/activities/course";

/// What all statements of a class have in common.
pub(super) struct Statements<'a> {
    /// The name of the class.
    pub class: &'a str,
    /// The address of the system on which the trainees have their accounts.
    pub home_page: &'a str,
}

impl Statements<'_> {
    /// A line for each flight.
    pub fn lines(&self, trainees: &[ClassTrainee]) -> String {
        let flights = trainees
            .iter()
            .flat_map(|trainee| trainee.flights.iter().map(move |it| (trainee, it)));
        let lines: Vec<String> = flights
            .map(|(trainee, flight)| self.statement(trainee, flight).to_string() + "\n")
            .collect();
        lines.concat()
    }

    fn statement(&self, trainee: &ClassTrainee, flight: &ClassFlight) -> Value {
        // The texts of activities are English.
        let locale = Locale::new(Language::English);
        let verb = verb(flight);
        let name = flight.profile.as_deref().unwrap_or(&trainee.user);
        json!({
            "id": self.id(&trainee.user, &flight.record),
            "timestamp": flight.when,
            "actor": {
                "objectType": "Agent",
                "name": name,
                "account": { "homePage": self.home_page, "name": trainee.user },
            },
            "verb": { "id": format!("{VERBS}{verb}"), "display": { "en": verb } },
            "object": {
                "objectType": "Activity",
                "id": format!("urn:sortie:mission:{}", flight.flight.mission),
                "definition": {
                    "type": SIMULATION,
                    "name": { "en": locale.text(&flight.title) },
                },
            },
            "result": result(flight, &locale),
            "context": {
                "platform": "sortie",
                "contextActivities": {
                    "grouping": [{
                        "objectType": "Activity",
                        "id": format!("urn:sortie:class:{}", escaped(self.class)),
                        "definition": { "type": COURSE, "name": { "en": self.class } },
                    }],
                },
            },
        })
    }

    /// A UUID that is the same whenever the flight is exported, so that a store does not take it twice.
    fn id(&self, user: &str, record: &str) -> String {
        let named = format!("{} {} {user} {record}", self.home_page, self.class);
        let again = format!("{named} ");
        let high = fnv1a(named.as_bytes());
        let low = fnv1a(again.as_bytes());
        format!(
            "{:08x}-{:04x}-5{:03x}-{:04x}-{:012x}",
            high >> 32,
            (high >> 16) & 0xffff,
            high & 0xfff,
            0x8000 | ((low >> 48) & 0x3fff),
            low & 0xffff_ffff_ffff
        )
    }
}

/// A flight that counts is passed or failed; any other is completed.
fn verb(flight: &ClassFlight) -> &'static str {
    match (flight.counts(), flight.flight.passed) {
        (true, true) => "passed",
        (true, false) => "failed",
        (false, _) => "completed",
    }
}

fn result(flight: &ClassFlight, locale: &Locale) -> Value {
    let score = flight.flight.score;
    let objectives = flight.objectives.iter().map(|it| objective(it, locale));
    json!({
        "score": {
            "scaled": f64::from(score) / f64::from(ALL_POINTS),
            "raw": score,
            "min": 0,
            "max": ALL_POINTS,
        },
        "success": flight.flight.passed,
        "completion": flight.has_end,
        "duration": format!("PT{}S", flight.sim_time_s.max(0.0)),
        "extensions": {
            "urn:sortie:objectives": objectives.collect::<Vec<Value>>(),
            "urn:sortie:record": flight.record,
            "urn:sortie:seed": flight.seed.to_string(),
        },
    })
}

fn objective(objective: &FlownObjective, locale: &Locale) -> Value {
    let result = &objective.result;
    json!({
        "id": result.id,
        "title": locale.text(&result.title),
        "skill": objective.skill,
        "mandatory": result.mandatory,
        "met": result.met,
        "points": result.points,
        "points_max": result.points_max,
    })
}

/// A name as a part of an IRI.
fn escaped(name: &str) -> String {
    let mut text = String::new();
    for c in name.chars() {
        if c.is_alphanumeric() || matches!(c, '-' | '.' | '_') {
            text.push(c);
        } else {
            let mut bytes = [0; 4];
            for byte in c.encode_utf8(&mut bytes).bytes() {
                // Writing to a text cannot fail.
                let _ = write!(text, "%{byte:02X}");
            }
        }
    }
    text
}

#[cfg(test)]
mod tests;
