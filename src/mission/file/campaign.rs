//! `[requires]` and `[rewards]`.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;
use toml::de::DeValue;

use super::Faults;
use super::head::is_mission_id;
use crate::mission::campaign::{Requires, Rewards, Unlock};
use crate::mission::event::standard::Standard;
use crate::scoring::Medal;
use crate::workshop;

/// The codes of the skills.
const SKILLS: [&str; 12] = [
    "K1", "K2", "K3", "K4", "K5", "K6", "K7", "K8", "K9", "K10", "K11", "K12",
];
/// Missions of one list, and things to unlock.
const MOST_NAMES: usize = 50;
/// No mission brings more.
const MOST_CREDITS: u32 = 100_000;
/// The highest difficulty.
const HIGHEST_TIER: u8 = 3;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RequiresFile {
    #[serde(default)]
    missions: Vec<Spanned<String>>,
    #[serde(default)]
    medals: BTreeMap<Spanned<String>, MedalFile>,
    #[serde(default)]
    skills: BTreeMap<Spanned<String>, Spanned<f64>>,
}

#[derive(Deserialize, Clone, Copy)]
#[serde(rename_all = "lowercase")]
enum MedalFile {
    Bronze,
    Silver,
    Gold,
}

impl From<MedalFile> for Medal {
    fn from(file: MedalFile) -> Self {
        match file {
            MedalFile::Bronze => Self::Bronze,
            MedalFile::Silver => Self::Silver,
            MedalFile::Gold => Self::Gold,
        }
    }
}

/// What has to be shown before.
pub(super) fn requires(value: Spanned<DeValue<'_>>, faults: &mut Faults) -> Option<Requires> {
    let place = value.span();
    let file: RequiresFile = faults.read_value(value)?;
    if file.missions.len() + file.medals.len() > MOST_NAMES {
        let fault = format!("`requires` may name {MOST_NAMES} missions");
        faults.add(place, fault);
    }
    for name in file.missions.iter().chain(file.medals.keys()) {
        mission(name, faults);
    }
    for (code, chance) in &file.skills {
        if !SKILLS.contains(&code.get_ref().as_str()) {
            faults.unknown("skill", code, &SKILLS);
        }
        faults.number(chance, 0.0..=1.0, code.get_ref());
    }
    let medals = file.medals.into_iter();
    let skills = file.skills.into_iter();
    Some(Requires {
        missions: file.missions.into_iter().map(Spanned::into_inner).collect(),
        medals: medals
            .map(|(id, medal)| (id.into_inner(), medal.into()))
            .collect(),
        skills: skills
            .map(|(code, chance)| (code.into_inner(), chance.into_inner()))
            .collect(),
    })
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RewardsFile {
    credits: Option<Spanned<u32>>,
    xp_tier: Option<Spanned<u8>>,
    unlock: Option<Spanned<Vec<Spanned<String>>>>,
}

/// What passing it brings.
pub(super) fn rewards(
    value: Spanned<DeValue<'_>>,
    tier: u8,
    faults: &mut Faults,
) -> Option<Rewards> {
    let file: RewardsFile = faults.read_value(value)?;
    if let Some(credits) = file
        .credits
        .as_ref()
        .filter(|it| *it.get_ref() > MOST_CREDITS)
    {
        let fault = format!("`credits` must lie between 0 and {MOST_CREDITS}");
        faults.add(credits.span(), fault);
    }
    if let Some(tier) = file
        .xp_tier
        .as_ref()
        .filter(|it| *it.get_ref() > HIGHEST_TIER)
    {
        let fault = format!("`xp_tier` must lie between 0 and {HIGHEST_TIER}");
        faults.add(tier.span(), fault);
    }
    let unlock = file.unlock.as_ref();
    if let Some(list) = unlock.filter(|list| list.get_ref().len() > MOST_NAMES) {
        let fault = format!("`unlock` may name {MOST_NAMES} things");
        faults.add(list.span(), fault);
    }
    let unlock = unlock.into_iter().flat_map(Spanned::get_ref);
    Some(Rewards {
        credits: file.credits.map_or(0, Spanned::into_inner),
        xp_tier: file.xp_tier.map_or(tier, Spanned::into_inner),
        unlock: unlock.filter_map(|name| unlocked(name, faults)).collect(),
    })
}

fn unlocked(written: &Spanned<String>, faults: &mut Faults) -> Option<Unlock> {
    let (kind, name) = written.get_ref().split_once(':').unwrap_or_default();
    let name = name.to_owned();
    match kind {
        "part" if is_part(&name) => {
            if workshop::part(&name).is_none() {
                let known: Vec<&str> = workshop::parts().map(|part| part.id).collect();
                faults.unknown("part", &Spanned::new(written.span(), name.clone()), &known);
            }
            Some(Unlock::Part(name))
        }
        "part" => {
            let fault = "a part's id is 1 to 40 small letters, digits, `-` and `_`";
            faults.add(written.span(), fault);
            None
        }
        "mission" => {
            mission(&Spanned::new(written.span(), name.clone()), faults);
            Some(Unlock::Mission(name))
        }
        "threat" => {
            if Standard::named(&name).is_none() {
                let name = Spanned::new(written.span(), name.clone());
                faults.unknown("threat", &name, &Standard::names());
            }
            Some(Unlock::Threat(name))
        }
        _ => {
            let fault = "what is unlocked is written `part:ID`, `mission:ID` or `threat:ID`";
            faults.add(written.span(), fault);
            None
        }
    }
}

/// An id of the parts catalogue.
pub(super) fn is_part(id: &str) -> bool {
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-' || c == '_';
    (1..=40).contains(&id.len()) && id.chars().all(plain)
}

/// Whether the mission is there, only the folder can tell.
fn mission(id: &Spanned<String>, faults: &mut Faults) {
    if !is_mission_id(id.get_ref()) {
        let fault = "a mission's id is 1 to 40 small letters, digits and `-`";
        faults.add(id.span(), fault);
    }
}
