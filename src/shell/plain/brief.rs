//! The brief of a mission as lines.

use crate::app::State;
use crate::mission::{Listing, ObjectiveListing};
use crate::text::{Text, text};

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
        .chain([limits(mission), text!("plain-before-launch")])
        .collect()
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
