//! Objectives, hints and contacts of a mission as lines.

use std::collections::BTreeMap;

use crate::app::State;
use crate::mission::{ObjectiveProgress, ObjectiveState, ShownContact, Trust};
use crate::text::{Text, text};

/// The parts of a mission's state that have been printed.
#[derive(Debug, Default)]
pub(super) struct PrintedMission {
    /// The states of the objectives by index, and the hint, as last seen.
    objectives: BTreeMap<usize, ObjectiveState>,
    hint: Option<Text>,
    contacts: usize,
}

impl PrintedMission {
    /// The lines since the last call.
    pub fn news(&mut self, state: &State) -> Vec<Text> {
        let mut texts = self.decided_objectives(state);
        texts.extend(self.new_contacts(state));
        texts
    }

    fn new_contacts(&mut self, state: &State) -> Vec<Text> {
        let contacts = state
            .session()
            .mission()
            .into_iter()
            .flat_map(|it| &it.contacts);
        let texts: Vec<Text> = contacts.skip(self.contacts).map(contact_text).collect();
        self.contacts += texts.len();
        texts
    }

    fn decided_objectives(&mut self, state: &State) -> Vec<Text> {
        let Some(mission) = state.session().mission() else {
            return Vec::new();
        };
        let mut texts = Vec::new();
        for (at, objective) in mission.objectives.iter().enumerate() {
            let before = self.objectives.insert(at, objective.state);
            if before.is_some_and(|before| before != objective.state) {
                texts.push(objective_text(objective));
            }
        }
        if mission.hint != self.hint {
            self.hint.clone_from(&mission.hint);
            let hint = mission.hint.iter();
            texts.extend(hint.map(|hint| text!("plain-hint", hint = hint)));
        }
        texts
    }
}

fn objective_text(objective: &ObjectiveProgress) -> Text {
    let (title, detail) = (&objective.title, &objective.detail);
    let words = Text::joined(", ", vec![title.clone(), detail.clone()]);
    match objective.state {
        ObjectiveState::Open => text!("plain-objective-open", objective = words),
        ObjectiveState::Met => text!("plain-objective-met", objective = words),
        ObjectiveState::Missed => text!("plain-objective-missed", objective = words),
    }
}

/// The objectives, the score so far and the time left, on demand.
pub(super) fn objectives(state: &State) -> Vec<Text> {
    let Some(mission) = state.session().mission() else {
        return vec![text!("mission-none")];
    };
    let mut texts: Vec<Text> = mission.objectives.iter().map(objective_text).collect();
    if let Some(score) = mission.score_so_far {
        texts.push(text!("plain-score", score = score));
    }
    let left = mission.limit.saturating_sub(mission.elapsed);
    texts.push(text!("plain-time-left", seconds = left.as_secs()));
    texts
}

fn contact_text(contact: &ShownContact) -> Text {
    let trust = match contact.trust {
        Trust::Harmless => text!("map-legend-harmless"),
        Trust::Seen => text!("map-legend-seen"),
        Trust::Confirmed => text!("map-legend-confirmed"),
        Trust::Reported => text!("map-legend-reported"),
    };
    let (latitude, longitude) = (contact.at.lat_deg, contact.at.lon_deg);
    text!(
        "plain-contact",
        name = &contact.name,
        kind = contact.kind.name(),
        place = format!("{latitude:.6} {longitude:.6}"),
        trust = trust
    )
}

/// The contacts, and the trainee's reports, on demand.
pub(super) fn contacts(state: &State) -> Vec<Text> {
    let Some(mission) = state.session().mission() else {
        return vec![text!("mission-none")];
    };
    let marks = text!("mission-marks-count", count = mission.marks.len());
    let contacts = mission.contacts.iter().map(contact_text);
    contacts.chain([marks]).collect()
}
