//! The stages of the vehicles' processes as lines.

use crate::app::State;
use crate::app::state::Hangar;
use crate::text::{Text, text};
use crate::vehicle::VehicleId;
use crate::vehicle_id::ranges;

/// The stages that were printed last.
#[derive(Debug, Default)]
pub(super) struct PrintedStages(Option<Text>);

impl PrintedStages {
    /// The stages while the vehicles start, if they have changed.
    pub fn news(&mut self, state: &State) -> Option<Text> {
        let hangar = state
            .session()
            .hangar()
            .filter(|hangar| !hangar.has_begun())?;
        let stages = stages(hangar);
        let is_new = !hangar.instances().is_empty() && self.0.as_ref() != Some(&stages);
        is_new.then(|| {
            self.0 = Some(stages.clone());
            text!("hangar-plain-stages", stages = stages)
        })
    }
}

/// The vehicles' processes, on demand.
pub(super) fn now(state: &State) -> Vec<Text> {
    match state.session().hangar() {
        Some(hangar) => vec![stages(hangar)],
        None => vec![text!("hangar-plain-none")],
    }
}

/// The stages of processes; vehicles at the same stage are merged.
fn stages(hangar: &Hangar) -> Text {
    let mut together: Vec<(Text, Vec<VehicleId>)> = Vec::new();
    for instance in hangar.instances() {
        let says = instance.says();
        match together.iter_mut().find(|(known, _)| *known == says) {
            Some((_, vehicles)) => vehicles.push(instance.vehicle),
            None => together.push((says, vec![instance.vehicle])),
        }
    }
    let stage = |(stage, vehicles): (Text, Vec<VehicleId>)| {
        let vehicles = ranges(vehicles);
        text!("hangar-plain-stage", vehicles = vehicles, stage = stage)
    };
    Text::joined(", ", together.into_iter().map(stage).collect())
}
