//! `[requires]` and `[rewards]`.

use toml::Spanned;

use super::head::{is_mission_id, mission_id};
use crate::mission::campaign::{Requires, Rewards, Unlock};
use crate::mission::event::standard::Standard;
use crate::mission::format::{
    FileTable, NameKind, TextValue, list, map, number, text, text_by, whole, word,
};
use crate::mission::skill::Skill;
use crate::scoring::Medal;
use crate::text;
use crate::workshop::{self, DesignKind};

/// The maximum number of missions of one list, and the maximum number of unlocks.
const MOST_NAMES: usize = 50;
/// The highest reward in credits.
const MOST_CREDITS: u32 = 100_000;
const HIGHEST_TIER: u32 = 3;

/// The kinds of vehicles that missions unlock: drones can be built from the start.
const UNLOCKED_KINDS: [DesignKind; 2] = [DesignKind::Robot, DesignKind::Boat];

const MEDALS: [(&str, Medal); 3] = [
    ("bronze", Medal::Bronze),
    ("silver", Medal::Silver),
    ("gold", Medal::Gold),
];

/// Reads the section `[requires]`.
pub(super) fn requires(table: &mut FileTable<'_>) -> Option<Requires> {
    let missions_form = list(mission_id(), 0, usize::MAX);
    let missions = table.may("missions", missions_form, "missions that must be passed");
    let medals_form = map("mission", word(&MEDALS));
    let medals = table.may(
        "medals",
        medals_form,
        "missions in which this medal or a better one is required",
    );
    let skills_form = map("skill, `K1` to `K13`", number(0.0, 1.0, ""));
    let skills = table.may(
        "skills",
        skills_form,
        "required probability that a skill is mastered",
    );
    let (missions, medals) = (missions.unwrap_or_default(), medals.unwrap_or_default());
    let skills = skills.unwrap_or_default();
    if missions.len() + medals.len() > MOST_NAMES {
        table.fault(text!("fault-requires-most", most = MOST_NAMES));
    }
    for (name, _) in &medals {
        mission(table, name.get_ref(), name);
    }
    for (code, _) in &skills {
        if Skill::of(code.get_ref()).is_none() {
            let known: Vec<&str> = Skill::ALL.iter().map(|skill| skill.code()).collect();
            table.draft().faults.unknown(NameKind::Skill, code, &known);
        }
    }
    let owned = |name: Spanned<String>| name.into_inner();
    Some(Requires {
        missions: missions.into_iter().map(owned).collect(),
        medals: medals
            .into_iter()
            .map(|(id, medal)| (owned(id), medal))
            .collect(),
        skills: skills
            .into_iter()
            .map(|(code, chance)| (owned(code), chance))
            .collect(),
    })
}

/// Reads the section `[rewards]`.
pub(super) fn rewards(table: &mut FileTable<'_>) -> Option<Rewards> {
    let credits_form = whole(0, MOST_CREDITS, "");
    let credits = table.or(
        "credits",
        credits_form,
        0,
        "credits for a perfect first pass",
    );
    let tier = whole(0, HIGHEST_TIER, "");
    let xp_tier = table.may(
        "xp_tier",
        tier,
        "tier that sets the experience earned (default `tier`)",
    );
    let unlock_form = list(
        text("`part:ID`, `mission:ID`, `threat:ID`, `vehicle:KIND`"),
        0,
        MOST_NAMES,
    );
    let unlock = table
        .may(
            "unlock",
            unlock_form,
            "parts, missions, threats and kinds of vehicles that a pass unlocks",
        )
        .unwrap_or_default();
    let own = table.draft().tier;
    let unlocked = unlock.iter().filter_map(|name| unlocked(table, name));
    Some(Rewards {
        credits,
        unlock: unlocked.collect(),
        // At most 3, so it fits.
        xp_tier: xp_tier.map_or(own, |tier| u8::try_from(tier).unwrap_or(own)),
    })
}

fn unlocked(table: &mut FileTable<'_>, written: &Spanned<String>) -> Option<Unlock> {
    let (kind, name) = written.get_ref().split_once(':').unwrap_or_default();
    let named = Spanned::new(written.span(), name.to_owned());
    let name = name.to_owned();
    let faults = &mut table.draft().faults;
    match kind {
        "part" if is_part(&name) => {
            if workshop::part(&name).is_none() {
                let known: Vec<&str> = workshop::parts().map(|part| part.id).collect();
                faults.unknown(NameKind::Part, &named, &known);
            }
            Some(Unlock::Part(name))
        }
        "part" => {
            let fault = "a part's id is 1 to 40 lower-case letters, digits, `-` and `_`";
            faults.add(written.span(), fault);
            None
        }
        "mission" => {
            mission(table, &name, written);
            Some(Unlock::Mission(name))
        }
        "threat" => {
            if Standard::named(&name).is_none() {
                faults.unknown(NameKind::Threat, &named, &Standard::names());
            }
            Some(Unlock::Threat(name))
        }
        "vehicle" => {
            let kind = UNLOCKED_KINDS.into_iter().find(|kind| kind.id() == name);
            if kind.is_none() {
                let known = UNLOCKED_KINDS.map(DesignKind::id);
                faults.unknown(NameKind::VehicleKind, &named, &known);
            }
            kind.map(Unlock::Vehicle)
        }
        _ => {
            let fault = "write `part:ID`, `mission:ID`, `threat:ID` or `vehicle:KIND`";
            faults.add(written.span(), fault);
            None
        }
    }
}

/// The id of a design or of a part.
pub(super) const fn design_id() -> TextValue {
    text_by("id of a design", is_part, "fault-design-id")
}

fn is_part(id: &str) -> bool {
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-' || c == '_';
    (1..=40).contains(&id.len()) && id.chars().all(plain)
}

/// Reads a mission's id. Whether the mission exists can only be checked with all missions of its folder.
fn mission(table: &mut FileTable<'_>, id: &str, written: &Spanned<String>) {
    if !is_mission_id(id) {
        let fault = "a mission's id is 1 to 40 lower-case letters, digits and `-`";
        table.draft().faults.add(written.span(), fault);
    }
}
