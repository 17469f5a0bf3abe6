//! A mission in the trainee's career: its state, the skills it trains, its rewards and unlocks.

use crate::app::State;
use crate::app::room::page::Tone;
use crate::app::state::Career;
use crate::campaign::{LockReason, Mastery, MissionStage, Offer, PracticeReason, Skill};
use crate::mission::{Listing, Unlock, threat_title};
use crate::scoring::Medal;
use crate::text;
use crate::text::Text;
use crate::workshop::{Part, part};

#[derive(Debug, Clone, PartialEq)]
pub struct Fact {
    /// The label of the fact.
    pub name: Text,
    pub what: Text,
    pub tone: Tone,
}

/// The facts for the trainee, most important first; empty without a profile.
pub fn facts(state: &State, mission: &Listing) -> Vec<Fact> {
    let Some(career) = &state.training.career else {
        return Vec::new();
    };
    if let Some(reason) = PracticeReason::of_file(mission.file) {
        return practice(&reason);
    }
    let Some(offer) = career.course.offer(&mission.id) else {
        return Vec::new();
    };
    let plain = |name, what| Fact {
        name,
        what,
        tone: Tone::Plain,
    };
    let mut facts = vec![stage(career, offer)];
    facts.extend(exam(career, offer));
    facts.extend(advice(career, &mission.id));
    facts.extend(review(career, offer));
    facts.push(plain(text!("fact-pays"), pay(career, offer)));
    let unlock = &mission.rewards.unlock;
    if !unlock.is_empty() {
        let unlocked = unlock.iter().map(|unlock| unlocked(state, unlock));
        let what = Text::joined(", ", unlocked.collect());
        facts.push(plain(text!("fact-opens"), what));
    }
    facts.push(plain(text!("fact-trains"), skills(career, offer)));
    let daily = if career.flew_daily(&mission.id) {
        text!("fact-daily-flown")
    } else {
        text!("fact-daily-open")
    };
    facts.push(plain(text!("fact-daily"), daily));
    let licence = career.standing.licence();
    let drones = text!("fact-drones-are", count = offer.vehicles, licence = licence);
    facts.push(plain(text!("fact-drones"), drones));
    facts
}

/// The facts of a mission that is flown only as practice.
fn practice(reason: &PracticeReason) -> Vec<Fact> {
    let stage = Fact {
        name: text!("fact-stage"),
        what: text!("fact-practice", why = reason.text()),
        tone: Tone::Warning,
    };
    let pay = Fact {
        name: text!("fact-pays"),
        what: text!("fact-pays-nothing"),
        tone: Tone::Plain,
    };
    vec![stage, pay]
}

/// The name of a mission, part, threat or kind of vehicle that a mission unlocks.
pub fn unlocked(state: &State, unlock: &Unlock) -> Text {
    match unlock {
        Unlock::Mission(id) => {
            let mut missions = state.training.missions.iter();
            let known = missions.find(|mission| mission.id == *id);
            let title = known.map_or_else(|| id.as_str().into(), |it| it.title.clone());
            text!("mission-reward-mission", title = title)
        }
        Unlock::Part(id) => {
            let name = part(id).map_or_else(|| id.as_str().into(), Part::name);
            text!("mission-reward-part", part = name)
        }
        Unlock::Threat(id) => {
            let title = threat_title(id).unwrap_or_else(|| id.as_str().into());
            text!("mission-reward-threat", threat = title)
        }
        Unlock::Vehicle(kind) => text!("mission-reward-vehicle", kind = kind.name()),
    }
}

/// The state of the mission in the career, and why it is locked.
fn stage(career: &Career, offer: &Offer) -> Fact {
    let best = career.standing.best(&offer.id);
    let count = career.growth.tries(&offer.id).len();
    let (what, tone) = match career.course.stage(offer, &career.standing, career.day) {
        MissionStage::Locked(reasons) => {
            let reasons = reasons.iter().map(LockReason::text).collect();
            let why = Text::joined("; ", reasons);
            (text!("fact-locked", why = why), Tone::Warning)
        }
        MissionStage::Open => {
            let what = match (best, best.and_then(|best| best.score)) {
                (_, Some(score)) => text!("fact-open", score = score, count = count),
                (Some(_), None) => text!("fact-no-points", count = count),
                (None, None) if count > 0 => text!("fact-practised", count = count),
                (None, None) => text!("fact-new"),
            };
            (what, Tone::Plain)
        }
        MissionStage::Passed(medal) => {
            let medal = medal.map_or(text!("debrief-no-medal"), Medal::title);
            let score = best.and_then(|best| best.passed).unwrap_or_default();
            let what = text!("fact-passed", score = score, medal = medal, count = count);
            (what, Tone::Met)
        }
    };
    Fact {
        name: text!("fact-stage"),
        what,
        tone,
    }
}

fn exam(career: &Career, offer: &Offer) -> Option<Fact> {
    let result = career.standing.best(&offer.id)?.exam?;
    let (what, tone) = if result.passed {
        (text!("fact-exam-passed", score = result.score), Tone::Met)
    } else {
        (
            text!("fact-exam-failed", score = result.score),
            Tone::Missed,
        )
    };
    Some(Fact {
        name: text!("fact-exam"),
        what,
        tone,
    })
}

/// Why this mission is recommended next, if it is.
fn advice(career: &Career, mission: &str) -> Option<Fact> {
    let (skill, offer) = career.next()?;
    let what = if offer.id == mission {
        text!("fact-next-is", skill = skill.title())
    } else if offer.drill_of.as_deref() == Some(mission) {
        text!(
            "fact-next-drill",
            drill = offer.title.clone(),
            skill = skill.title()
        )
    } else {
        return None;
    };
    Some(Fact {
        name: text!("fact-next"),
        what,
        tone: Tone::Hint,
    })
}

fn review(career: &Career, offer: &Offer) -> Option<Fact> {
    let due = career.due(offer);
    let titles = due.into_iter().map(Skill::title).collect::<Vec<Text>>();
    (!titles.is_empty()).then(|| Fact {
        name: text!("fact-review"),
        what: Text::joined(", ", titles),
        tone: Tone::Warning,
    })
}

/// The skills that the mission trains, with the trainee's mastery of each; untried ones are listed
/// together at the end.
fn skills(career: &Career, offer: &Offer) -> Text {
    let mut tried = Vec::new();
    let mut new = Vec::new();
    for skill in &offer.skills {
        let known = career.standing.skill(*skill);
        let percent = (known.chance(career.day) * 100.0).round() as u32;
        let title = skill.title();
        match known.mastery(career.day) {
            Mastery::Unknown => new.push(title),
            Mastery::Mastered => tried.push(text!(
                "fact-skill-mastered",
                skill = title,
                percent = percent
            )),
            Mastery::Learning | Mastery::Due => {
                tried.push(text!("fact-skill", skill = title, percent = percent));
            }
        }
    }
    let new = (!new.is_empty()).then(|| text!("fact-skills-new", skills = Text::joined(", ", new)));
    let tried = (!tried.is_empty()).then(|| Text::joined(", ", tried));
    Text::joined("; ", tried.into_iter().chain(new).collect())
}

fn pay(career: &Career, offer: &Offer) -> Text {
    let left = career.credits_left(offer);
    if offer.credits == 0 {
        text!("fact-pays-nothing")
    } else if career.standing.has_passed(&offer.id) && left == 0 {
        text!("fact-pays-paid")
    } else if career.standing.has_passed(&offer.id) {
        text!("fact-pays-left", left = left)
    } else {
        text!("fact-pays-first", credits = offer.credits)
    }
}
