//! The available missions.

use std::collections::BTreeMap;

use crate::app::state::MissionListing;
use crate::campaign::{MissionCourse, Offer};
use crate::mission::{Mission, Rewards};
use crate::scoring::{MissionFile, TryReport};
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
    let mut missions: Vec<Mission> = Vec::new();
    let mut names: Vec<String> = Vec::new();
    let mut warnings = Vec::new();
    for source in store::missions() {
        match Mission::parse(&source.text) {
            Ok(mission) => {
                let first = missions.iter().position(|known| known.id == mission.id);
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
                missions.push(mission);
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
    let files = store::mission_files(&missions);
    let (listings, offers): (Vec<MissionListing>, Vec<Offer>) = missions
        .iter()
        .zip(files)
        .map(|(mission, file)| offered(mission, file))
        .unzip();
    (listings, MissionCourse::new(offers), warnings)
}

/// A mission as it is listed and offered. Flights with another file than that of the course are practice: they earn no
/// credits and unlock nothing.
fn offered(mission: &Mission, file: MissionFile) -> (MissionListing, Offer) {
    let (listing, offer) = (mission.listing(), Offer::of(mission));
    match file {
        MissionFile::Course => (listing, offer),
        MissionFile::Own | MissionFile::OtherRevision | MissionFile::Altered => (
            MissionListing {
                rewards: Rewards::default(),
                ..listing
            },
            // The parts that the mission of the course unlocks stay locked.
            Offer {
                credits: 0,
                ..offer
            },
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mission_file_of_ones_own_offers_no_credits() {
        let source = include_str!("../../missions/01-air-sample.toml");
        let mission = Mission::parse(source).expect("no faults");
        let (listing, offer) = offered(&mission, MissionFile::Course);
        assert_eq!((listing.rewards.credits, offer.credits), (300, 300));
        for file in [
            MissionFile::Own,
            MissionFile::OtherRevision,
            MissionFile::Altered,
        ] {
            let (listing, offer) = offered(&mission, file);
            assert_eq!((listing.rewards.credits, offer.credits), (0, 0), "{file:?}");
            assert_eq!(listing.rewards.unlock, []);
        }
    }
}
