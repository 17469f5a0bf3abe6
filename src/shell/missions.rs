//! The available missions.

use std::collections::BTreeMap;

use crate::app::state::MissionListing;
use crate::campaign::{MissionCourse, Offer};
use crate::mission::Mission;
use crate::scoring::TryReport;
use crate::store;
use crate::text;
use crate::text::Text;
use crate::workshop::Design;

/// Attempts by mission, oldest first.
pub type Tries = BTreeMap<String, Vec<TryReport>>;

/// Keeps only the attempts at missions' current revisions.
pub fn current(mut tries: Tries, missions: &[MissionListing]) -> Tries {
    tries.retain(|id, tries| {
        let mission = missions.iter().find(|mission| mission.id == *id);
        tries.retain(|one| mission.is_some_and(|mission| mission.rev == one.revision));
        !tries.is_empty()
    });
    tries
}

/// The designs that come with the program.
pub fn stock() -> Vec<Design> {
    let sources = store::designs();
    let designs = sources.iter().map(|source| Design::from_toml(&source.text));
    designs.filter_map(Result::ok).collect()
}

/// The available missions, the course that they form, and the faults of the others.
pub fn listings() -> (Vec<MissionListing>, MissionCourse, Vec<Text>) {
    let mut listings: Vec<MissionListing> = Vec::new();
    let mut offers: Vec<Offer> = Vec::new();
    let mut names: Vec<String> = Vec::new();
    let mut warnings = Vec::new();
    for source in store::missions() {
        match Mission::parse(&source.text) {
            Ok(mission) => {
                let first = listings.iter().position(|known| known.id == mission.id);
                if let Some(first) = first {
                    let (id, flown) = (&mission.id, &names[first]);
                    let other = &source.name;
                    warnings.push(text!(
                        "mission-twice",
                        id = id,
                        flown = flown,
                        other = other
                    ));
                    continue;
                }
                offers.push(Offer::of(&mission));
                listings.push(mission.listing());
                names.push(source.name);
            }
            Err(faults) => {
                let first = faults.first();
                let fault = first.map(|fault| fault.text(&source.name, &source.text));
                warnings.extend(fault.map(|fault| text!("config-faulty", fault = fault)));
                for fault in faults {
                    tracing::warn!("{}", fault.one_line(&source.name, &source.text));
                }
            }
        }
    }
    (listings, MissionCourse::new(offers), warnings)
}
