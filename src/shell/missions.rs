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

/// Keeps only the attempts at the current revisions of missions.
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

/// The available missions, the course that they form, and the faults of the missions that cannot be
/// offered.
pub fn listings() -> (Vec<MissionListing>, MissionCourse, Vec<Text>) {
    let (missions, warnings) = readable();
    let files = store::mission_files(&missions);
    let (listings, offers): (Vec<MissionListing>, Vec<Option<Offer>>) = missions
        .iter()
        .zip(files)
        .map(|(mission, file)| (listed(mission, file), offered(mission, file)))
        .unzip();
    let course = MissionCourse::new(offers.into_iter().flatten());
    (listings, course, warnings)
}

/// The faults of the missions that cannot be offered.
pub fn mission_faults() -> Vec<Text> {
    readable().1
}

/// The missions without faults, each id once, and the faults of the other missions.
fn readable() -> (Vec<Mission>, Vec<Text>) {
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
    let unreadable = store::unreadable_missions();
    let unread = unreadable.iter().map(Text::from);
    warnings.extend(unread.map(|fault| text!("config-faulty", fault = fault)));
    (missions, warnings)
}

/// A mission as it is listed. Flights with a file other than that of the course are practice: they
/// earn nothing.
pub fn listed(mission: &Mission, file: MissionFile) -> MissionListing {
    let listing = MissionListing {
        file,
        ..mission.listing()
    };
    match file {
        MissionFile::Course => listing,
        MissionFile::Own | MissionFile::OtherRevision | MissionFile::Altered => MissionListing {
            rewards: Rewards::default(),
            ..listing
        },
    }
}

/// A mission as the course offers it; `None` if it is not part of the course.
fn offered(mission: &Mission, file: MissionFile) -> Option<Offer> {
    let offer = Offer::of(mission);
    match file {
        MissionFile::Course => Some(offer),
        MissionFile::Own => None,
        // The parts that the mission of the course unlocks stay locked.
        MissionFile::OtherRevision | MissionFile::Altered => Some(Offer {
            credits: 0,
            ..offer
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mission_file_of_ones_own_offers_no_credits() {
        let source = include_str!("../../missions/01-air-sample.toml");
        let mission = Mission::parse(source).expect("no faults");
        let credits = |file| offered(&mission, file).map(|offer| offer.credits);
        let listing = listed(&mission, MissionFile::Course);
        assert_eq!(listing.rewards.credits, 300);
        assert_eq!(credits(MissionFile::Course), Some(300));
        assert_eq!(credits(MissionFile::Altered), Some(0));
        assert_eq!(credits(MissionFile::Own), None, "it is not in the course");
        for file in [
            MissionFile::Own,
            MissionFile::OtherRevision,
            MissionFile::Altered,
        ] {
            let listing = listed(&mission, file);
            assert_eq!((listing.rewards.credits, listing.file), (0, file));
            assert_eq!(listing.rewards.unlock, []);
        }
    }
}
