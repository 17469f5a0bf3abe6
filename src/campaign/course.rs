//! The missions of a campaign, and which ones are open to a trainee.

use std::collections::BTreeMap;

use super::{CareerFlight, CareerStanding, EvidenceBasis, Mastery, Skill};
use crate::mission::{Mission, Requires, Unlock};
use crate::scoring::Medal;
use crate::text;
use crate::text::Text;
use crate::workshop::{DesignKind, Part};

/// A mission offered in a campaign.
#[derive(Debug, Clone, PartialEq)]
pub struct Offer {
    /// The id of the mission.
    pub id: String,
    pub title: Text,
    /// Difficulty, 0 to 3.
    pub tier: u8,
    /// The number of drones.
    pub vehicles: u8,
    /// The mission that a drill prepares for; `None` if this is not a drill.
    pub drill_of: Option<String>,
    pub requires: Requires,
    /// Credits for a perfect first pass.
    pub credits: u32,
    /// Parts that passing the mission unlocks.
    pub parts: Vec<String>,
    /// Kinds of vehicles that passing the mission unlocks.
    pub kinds: Vec<DesignKind>,
    /// The skills that the mission trains.
    pub skills: Vec<Skill>,
    /// The names of the mission's objectives, by their ids.
    pub objectives: BTreeMap<String, Text>,
}

/// All missions of a campaign, in order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MissionCourse {
    offers: Vec<Offer>,
}

/// Whether a mission may be flown.
#[derive(Debug, Clone, PartialEq)]
pub enum MissionStage {
    Locked(Vec<LockReason>),
    /// Open, and not passed yet.
    Open,
    /// Passed, with the best medal.
    Passed(Option<Medal>),
}

/// Why a mission is locked.
#[derive(Debug, Clone, PartialEq)]
pub enum LockReason {
    /// Another mission must be passed.
    Pass(Text),
    /// At least this medal is required in another mission.
    Medal(Text, Medal),
    /// A skill needs the first probability, but has the second; both in percent.
    Skill(Skill, u8, u8),
    /// The mission needs the first number of drones; the licence covers only the second.
    Licence(u8, u8),
}

impl LockReason {
    /// The required action, as text.
    pub fn text(&self) -> Text {
        match self {
            Self::Pass(title) => text!("locked-pass", mission = title.clone()),
            Self::Medal(title, medal) => {
                text!(
                    "locked-medal",
                    mission = title.clone(),
                    medal = medal.title()
                )
            }
            Self::Skill(skill, wanted, has) => text!(
                "locked-skill",
                skill = skill.title(),
                wanted = u32::from(*wanted),
                has = u32::from(*has)
            ),
            Self::Licence(wanted, has) => text!(
                "locked-licence",
                wanted = u32::from(*wanted),
                has = u32::from(*has)
            ),
        }
    }
}

impl Offer {
    /// The campaign's view of a mission.
    pub fn of(mission: &Mission) -> Self {
        let unlocked = mission.career.rewards.unlock.iter();
        let kinds = unlocked.clone().filter_map(|unlock| match unlock {
            Unlock::Vehicle(kind) => Some(*kind),
            Unlock::Part(_) | Unlock::Mission(_) | Unlock::Threat(_) => None,
        });
        let parts = unlocked.filter_map(|unlock| match unlock {
            Unlock::Part(id) => Some(id.clone()),
            Unlock::Mission(_) | Unlock::Threat(_) | Unlock::Vehicle(_) => None,
        });
        let mut skills: Vec<Skill> = mission
            .objective_skills()
            .filter_map(|(_, skill)| skill)
            .chain([Skill::K2, Skill::K4])
            .chain((mission.seats.count > 1).then_some(Skill::K10))
            .chain(mission.has_alerts().then_some(Skill::K8))
            .collect();
        skills.sort_unstable();
        skills.dedup();
        Self {
            id: mission.id.clone(),
            title: mission.title.clone(),
            tier: mission.summary.tier,
            vehicles: mission.seats.count as u8,
            drill_of: mission.summary.drill_of.clone(),
            requires: mission.career.requires.clone(),
            credits: mission.career.rewards.credits,
            parts: parts.collect(),
            kinds: kinds.collect(),
            skills,
            objectives: mission
                .objectives
                .iter()
                .map(|it| (it.id.clone(), it.title.clone()))
                .collect(),
        }
    }
}

impl MissionCourse {
    /// A course of missions.
    pub fn new(offers: impl IntoIterator<Item = Offer>) -> Self {
        Self {
            offers: offers.into_iter().collect(),
        }
    }

    /// The missions, in order.
    pub fn offers(&self) -> &[Offer] {
        &self.offers
    }

    /// A flight with the names of its evidence in all languages, since profiles store only the English ones.
    #[must_use]
    pub fn translated(&self, mut flight: CareerFlight) -> CareerFlight {
        let offer = self.offer(&flight.mission);
        for evidence in &mut flight.evidence {
            let title = evidence.basis.as_ref().and_then(|basis| match basis {
                EvidenceBasis::Objective(id) => offer?.objectives.get(id).cloned(),
                EvidenceBasis::Component(component) => Some(component.title()),
                EvidenceBasis::Prediction => Some(text!("skill-prediction")),
            });
            if let Some(title) = title {
                evidence.what = title;
            }
        }
        flight
    }

    /// The missions that unlock a part, by itself or with the kind of vehicle that alone takes it.
    pub(super) fn unlocking<'a>(&'a self, part: &'a Part) -> impl Iterator<Item = &'a Offer> {
        self.offers.iter().filter(|offer| {
            let with_kind = part
                .only_for()
                .is_some_and(|kind| offer.kinds.contains(&kind));
            with_kind || offer.parts.iter().any(|id| id == part.id)
        })
    }

    /// The mission with an id, if the course has it.
    pub fn offer(&self, id: &str) -> Option<&Offer> {
        self.offers.iter().find(|offer| offer.id == id)
    }

    /// The state of a mission for a trainee on a day. A drill opens with its mission.
    pub fn stage(&self, offer: &Offer, standing: &CareerStanding, day: i64) -> MissionStage {
        if let Some(best) = standing
            .best(&offer.id)
            .filter(|best| best.passed.is_some())
        {
            return MissionStage::Passed(best.medal);
        }
        let asked = offer
            .drill_of
            .as_deref()
            .and_then(|mission| self.offer(mission))
            .unwrap_or(offer);
        let reasons = self.reasons(asked, standing, day);
        if reasons.is_empty() {
            MissionStage::Open
        } else {
            MissionStage::Locked(reasons)
        }
    }

    /// Whether a mission may be flown; a drill that was passed also needs its mission open.
    fn is_open(&self, offer: &Offer, standing: &CareerStanding, day: i64) -> bool {
        let mission = offer.drill_of.as_deref().and_then(|of| self.offer(of));
        let mut both = std::iter::once(offer).chain(mission);
        both.all(|it| !matches!(self.stage(it, standing, day), MissionStage::Locked(_)))
    }

    fn reasons(&self, offer: &Offer, standing: &CareerStanding, day: i64) -> Vec<LockReason> {
        let title = |id: &String| {
            let known = self.offer(id).map(|offer| offer.title.clone());
            known.unwrap_or_else(|| Text::verbatim(id.clone()))
        };
        let passes = offer
            .requires
            .missions
            .iter()
            .filter(|id| !standing.has_passed(id));
        let medals = offer.requires.medals.iter().filter(|(id, medal)| {
            let best = standing.best(id).and_then(|best| best.medal);
            best.is_none_or(|best| best < **medal)
        });
        let skills = offer.requires.skills.iter().filter_map(|(code, wanted)| {
            let skill = Skill::of(code)?;
            let chance = standing.skill(skill).chance(day);
            (chance < *wanted).then(|| LockReason::Skill(skill, percent(*wanted), percent(chance)))
        });
        let held = standing.licence();
        let licence = (offer.vehicles > held).then_some(LockReason::Licence(offer.vehicles, held));
        passes
            .map(|id| LockReason::Pass(title(id)))
            .chain(medals.map(|(id, medal)| LockReason::Medal(title(id), *medal)))
            .chain(skills)
            .chain(licence)
            .collect()
    }

    /// The recommended skill, and the best open mission for it. The skill is one that is due for a refresher; otherwise
    /// the weakest one that the easiest new mission trains; without new missions, the weakest one that the easiest
    /// passed mission trains. Weak skills get drills first, better ones get whole missions. The last flight leads on:
    /// drills of other missions come after new missions, and of equally easy ones, those that it opens come first.
    pub fn next(&self, standing: &CareerStanding, day: i64) -> Option<(Skill, &Offer)> {
        let mut skills: Vec<(bool, f64, Skill)> = Skill::ALL
            .iter()
            .map(|&skill| {
                let known = standing.skill(skill);
                (known.mastery(day) != Mastery::Due, known.chance(day), skill)
            })
            .collect();
        skills.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let open = self.advisable(standing, day);
        let is_known = |offer: &Offer| standing.has_passed(&offer.id);
        let tier = |offer: &Offer| self.tier(offer);
        let advice = |may_be_known: &dyn Fn(bool) -> bool| {
            let best = skills.iter().filter_map(|&(is_fresh, chance, skill)| {
                let trains = open.iter().copied().filter(|offer| {
                    offer.skills.contains(&skill)
                        && (may_be_known(!is_fresh) || !is_known(offer))
                        && (offer.drill_of.is_none() || chance < SHAKY)
                });
                let rank = |offer: &&Offer| {
                    let rank = self.rank(offer, standing, chance);
                    (
                        is_known(offer),
                        is_aside(offer, standing),
                        rank,
                        !follows(offer, standing),
                    )
                };
                let best = trains.min_by_key(rank);
                best.map(|offer| (is_fresh, skill, offer))
            });
            // Due skills first, then new and easy missions that follow; among these, the weakest skill.
            let first = best.min_by_key(|(is_fresh, _, offer)| {
                let (is_aside, follows) = (is_aside(offer, standing), follows(offer, standing));
                (*is_fresh, is_known(offer), is_aside, tier(offer), !follows)
            });
            first.map(|(_, skill, offer)| (skill, offer))
        };
        advice(&|is_due| is_due).or_else(|| advice(&|_| true))
    }

    /// The mission or drill to fly for a skill: the recommended one if it is for this skill, otherwise the best open
    /// one; `None` if none that is open trains the skill.
    pub fn training(&self, skill: Skill, standing: &CareerStanding, day: i64) -> Option<&Offer> {
        if let Some((advised, offer)) = self.next(standing, day)
            && advised == skill
        {
            return Some(offer);
        }
        let chance = standing.skill(skill).chance(day);
        let open = self.advisable(standing, day).into_iter();
        open.filter(|offer| offer.skills.contains(&skill))
            .min_by_key(|offer| self.rank(offer, standing, chance))
    }

    /// The missions that may be flown, and the drills of those that were tried.
    fn advisable(&self, standing: &CareerStanding, day: i64) -> Vec<&Offer> {
        let open = self.offers.iter();
        open.filter(|offer| self.is_open(offer, standing, day))
            .filter(|offer| is_advisable(offer, standing))
            .collect()
    }

    /// The difficulty of a mission; for a drill, that of its mission.
    fn tier(&self, offer: &Offer) -> u8 {
        let mission = offer.drill_of.as_deref().and_then(|of| self.offer(of));
        mission.unwrap_or(offer).tier
    }

    /// The order of missions that train a skill of this probability, best first: new ones come before known ones; among
    /// these, drills first if the skill is weak; among these, the easiest first.
    fn rank(&self, offer: &Offer, standing: &CareerStanding, chance: f64) -> (bool, bool, u8) {
        let is_drill = offer.drill_of.is_some();
        (
            standing.has_passed(&offer.id),
            is_drill != (chance < SHAKY),
            self.tier(offer),
        )
    }
}

/// Whether a mission can be recommended: a drill only after an attempt at its mission.
fn is_advisable(offer: &Offer, standing: &CareerStanding) -> bool {
    let of = offer.drill_of.as_deref();
    of.is_none_or(|mission| standing.best(mission).is_some())
}

/// Whether a mission or drill continues the last flight: the drill of its mission, or a mission that it opens.
fn follows(offer: &Offer, standing: &CareerStanding) -> bool {
    standing.last_mission().is_some_and(|last| {
        let mut required = offer.requires.missions.iter();
        offer.drill_of.as_deref() == Some(last) || required.any(|mission| mission == last)
    })
}

/// Whether a drill prepares for another mission than the one flown last.
fn is_aside(offer: &Offer, standing: &CareerStanding) -> bool {
    offer.drill_of.is_some() && !follows(offer, standing)
}

/// Below this probability, a drill suits a skill better than a whole mission.
const SHAKY: f64 = 0.4;

fn percent(share: f64) -> u8 {
    (share * 100.0).floor().clamp(0.0, 100.0) as u8
}
