//! The brief of a mission as lines.

use crate::app::State;
use crate::mission::{Listing, ObjectiveListing};
use crate::text::{Text, text};

/// The lines that the plain console recommends in flight.
const IN_FLIGHT: [&str; 5] = ["objectives", "contacts", "hint", "pause", "continue"];

/// The brief, the objectives with their points, and the questions before takeoff.
pub(super) fn lines(state: &State) -> Vec<Text> {
    let Some(mission) = state.flown_mission() else {
        return Vec::new();
    };
    let brief = state.locale().text(&mission.brief);
    let objectives = mission.objectives.iter().map(objective);
    let paragraphs = brief.lines().map(Text::from);
    paragraphs
        .chain(objectives)
        .chain([limits(mission)])
        .chain(lines_open(state))
        .collect()
}

/// What may be said before takeoff and in flight, as far as it is open to the user of the console.
fn lines_open(state: &State) -> Vec<Text> {
    let before = state
        .may_write("predict")
        .then(|| text!("plain-before-launch"));
    let in_flight = IN_FLIGHT.into_iter().filter(|line| state.may_write(line));
    let named: Vec<String> = in_flight.map(|line| format!("`{line}`")).collect();
    let in_flight = text!("plain-in-flight", lines = named.join(", "));
    before.into_iter().chain([in_flight]).collect()
}

fn objective(objective: &ObjectiveListing) -> Text {
    let points = format!("{:.0}", objective.value);
    let (title, target) = (&objective.title, &objective.target);
    if objective.mandatory {
        text!(
            "plain-asked-required",
            title = title,
            target = target,
            points = points
        )
    } else {
        text!(
            "plain-asked",
            title = title,
            target = target,
            points = points
        )
    }
}

fn limits(mission: &Listing) -> Text {
    text!(
        "plain-limits",
        seconds = mission.time_limit.as_secs(),
        par = mission.par_time.as_secs(),
        gold = mission.medals.gold,
        silver = mission.medals.silver,
        bronze = mission.medals.bronze
    )
}
