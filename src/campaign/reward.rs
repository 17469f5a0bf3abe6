//! The reward of a flight, and the reasons for it.

use serde::Serialize;

use super::{
    CareerFlight, CareerStanding, Evidence, MissionCourse, MissionStage, PartState, Skill, Stake,
};
use crate::scoring::ALL_POINTS;
use crate::text;
use crate::text::Text;
use crate::workshop::{DesignKind, Part, parts};

/// The changes that a flight makes to a career.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reward {
    /// The stake of the flight.
    pub stake: Stake,
    /// Whether the exam was passed; `None` if the flight was not an exam.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exam_passed: Option<bool>,
    pub pay_credits: u32,
    /// Credits deducted for wear and loss of the trainee's own drones.
    pub wear_credits: u32,
    pub credits: u32,
    pub experience: u64,
    /// The level before the flight.
    pub level_before: u32,
    /// The level after the flight.
    pub level: u32,
    /// The experience still required for the next level.
    pub experience_left: u64,
    /// The number of drones that the licence covered before the flight.
    pub licence_before: u8,
    /// The number of drones that the licence covers after the flight.
    pub licence: u8,
    /// The newly opened missions.
    pub missions: Vec<OpenedItem>,
    /// The kinds of vehicles that can be built now, with their parts.
    pub vehicles: Vec<OpenedItem>,
    /// The other parts newly for sale.
    pub parts: Vec<OpenedItem>,
    /// The skills with evidence, in order.
    pub skills: Vec<SkillChange>,
    /// Why no credits were paid; `None` if any were.
    pub unpaid: Option<Text>,
    /// The recommended next flight, by the standing after this one.
    #[serde(skip)]
    pub next: Option<Text>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OpenedItem {
    /// The id of the mission, kind of vehicle or part.
    pub id: String,
    /// The item's name on the screen.
    pub title: Text,
}

/// A skill before and after the flight.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SkillChange {
    pub skill: Skill,
    /// The skill's name on the screen.
    pub title: Text,
    /// Whether the flight was the first to show the skill.
    pub is_new: bool,
    /// The probability of mastery before the flight, in percent.
    pub before_percent: u8,
    /// The probability of mastery after the flight, in percent.
    pub after_percent: u8,
    pub why: Vec<Evidence>,
}

impl Reward {
    /// The changes that a flight made to a standing.
    pub fn between(
        before: &CareerStanding,
        after: &CareerStanding,
        course: &MissionCourse,
        flight: &CareerFlight,
    ) -> Self {
        let pay_credits = before.pay(flight);
        let owned = before.credits().saturating_add(pay_credits);
        let wear_credits = owned.saturating_sub(after.credits());
        let (experience, level, needed) = after.experience();
        let (experience_before, level_before, _) = before.experience();
        Self {
            stake: flight.stake,
            exam_passed: (flight.stake == Stake::Exam).then_some(flight.passed),
            pay_credits,
            wear_credits,
            credits: after.credits(),
            experience: experience.saturating_sub(experience_before),
            level_before,
            level,
            experience_left: needed.saturating_sub(experience),
            licence_before: before.licence(),
            licence: after.licence(),
            missions: opened_missions(before, after, course, flight.day),
            vehicles: opened_kinds(before, after, course)
                .map(|kind| OpenedItem {
                    id: kind.id().to_owned(),
                    title: kind.name(),
                })
                .collect(),
            parts: opened_parts(before, after, course),
            skills: skill_changes(before, after, flight),
            unpaid: (pay_credits == 0).then(|| unpaid(before, flight)),
            next: next_step(after, course, flight),
        }
    }

    /// The changes as text, most important first.
    pub fn lines(&self) -> Vec<Text> {
        let mut lines = Vec::new();
        lines.extend(self.exam_passed.map(|passed| {
            if passed {
                text!("reward-exam-passed")
            } else {
                text!("reward-exam-failed")
            }
        }));
        lines.extend([self.credits_line(), self.experience_line()]);
        if self.licence > self.licence_before {
            lines.push(text!(
                "reward-licence",
                before = self.licence_before,
                after = self.licence
            ));
        }
        let missions = self.missions.iter();
        lines.extend(missions.map(|it| text!("reward-mission", mission = it.title.clone())));
        let vehicles = self.vehicles.iter();
        lines.extend(vehicles.map(|it| text!("reward-vehicle", kind = it.title.clone())));
        if !self.parts.is_empty() {
            let names = self.parts.iter().map(|it| it.title.clone()).collect();
            lines.push(text!("reward-parts", parts = Text::joined(", ", names)));
        }
        lines.extend(self.skills.iter().map(SkillChange::text));
        lines
    }

    fn credits_line(&self) -> Text {
        let (pay, now) = (self.pay_credits, self.credits);
        match (&self.unpaid, self.wear_credits) {
            (Some(why), 0) => text!("reward-unpaid", why = why, now = now),
            (Some(why), wear) => text!("reward-unpaid-wear", why = why, wear = wear, now = now),
            (None, 0) => text!("reward-credits", pay = pay, now = now),
            (None, wear) => text!("reward-credits-wear", pay = pay, wear = wear, now = now),
        }
    }

    fn experience_line(&self) -> Text {
        let (gained, left) = (self.experience, self.experience_left);
        if self.level > self.level_before {
            let (before, after) = (self.level_before, self.level);
            text!(
                "reward-level",
                gained = gained,
                before = before,
                after = after,
                left = left
            )
        } else {
            text!(
                "reward-experience",
                gained = gained,
                level = self.level,
                left = left
            )
        }
    }
}

impl SkillChange {
    /// The change as text, with the evidence.
    pub fn text(&self) -> Text {
        let seen = |it: &Evidence| {
            let percent = (it.outcome * 100.0).round() as u32;
            text!("reward-seen", what = it.what.clone(), percent = percent)
        };
        let why = Text::joined(", ", self.why.iter().map(seen).collect());
        let (skill, after) = (self.title.clone(), self.after_percent);
        if self.is_new {
            return text!("reward-skill-new", skill = skill, after = after, why = why);
        }
        text!(
            "reward-skill",
            skill = skill,
            before = self.before_percent,
            after = after,
            why = why
        )
    }
}

/// The recommended next flight. After practice, this may be the same mission again, flown so that
/// it counts.
fn next_step(
    after: &CareerStanding,
    course: &MissionCourse,
    flight: &CareerFlight,
) -> Option<Text> {
    let (_, offer) = course.next(after, flight.day)?;
    let is_same = offer.id == flight.mission;
    Some(if is_same && flight.stake == Stake::Practice {
        text!("debrief-next-count")
    } else {
        text!("debrief-next-mission", mission = offer.title.clone())
    })
}

fn unpaid(before: &CareerStanding, flight: &CareerFlight) -> Text {
    let best = before.best(&flight.mission).and_then(|best| best.passed);
    match best {
        _ if flight.stake == Stake::Practice => text!("reward-practice"),
        _ if !flight.passed => text!("reward-not-passed"),
        _ if !before.counts(flight) => text!("reward-daily-again"),
        Some(best) if best >= ALL_POINTS => text!("reward-all-points", best = best),
        Some(best) if flight.score <= best => text!("reward-not-better", best = best),
        _ => text!("reward-no-pay"),
    }
}

fn opened_missions(
    before: &CareerStanding,
    after: &CareerStanding,
    course: &MissionCourse,
    day: i64,
) -> Vec<OpenedItem> {
    let is_locked =
        |offer, standing| matches!(course.stage(offer, standing, day), MissionStage::Locked(_));
    let offers = course.offers().iter();
    offers
        .filter(|offer| is_locked(offer, before) && !is_locked(offer, after))
        .map(|offer| OpenedItem {
            id: offer.id.clone(),
            title: offer.title.clone(),
        })
        .collect()
}

fn opened_kinds(
    before: &CareerStanding,
    after: &CareerStanding,
    course: &MissionCourse,
) -> impl Iterator<Item = DesignKind> {
    let is_locked =
        move |kind, standing: &CareerStanding| standing.kind_lock(kind, course).is_some();
    let kinds = DesignKind::ALL.into_iter();
    kinds.filter(move |kind| is_locked(*kind, before) && !is_locked(*kind, after))
}

fn opened_parts(
    before: &CareerStanding,
    after: &CareerStanding,
    course: &MissionCourse,
) -> Vec<OpenedItem> {
    let is_locked = |part, standing: &CareerStanding| {
        matches!(standing.part_state(part, course), PartState::Locked(_))
    };
    let kinds: Vec<DesignKind> = opened_kinds(before, after, course).collect();
    let is_of_kind = |part: &Part| part.only_for().is_some_and(|kind| kinds.contains(&kind));
    parts()
        .filter(|part| is_locked(part, before) && !is_locked(part, after))
        .filter(|part| !is_of_kind(part))
        .map(|part| OpenedItem {
            id: part.id.to_owned(),
            title: part.name(),
        })
        .collect()
}

/// The skills with evidence; empty for a flight that does not count, because it changes no skill.
fn skill_changes(
    before: &CareerStanding,
    after: &CareerStanding,
    flight: &CareerFlight,
) -> Vec<SkillChange> {
    if !before.counts(flight) {
        return Vec::new();
    }
    let percent = |standing: &CareerStanding, skill| {
        (standing.skill(skill).chance(flight.day) * 100.0).round() as u8
    };
    let seen = |skill| flight.evidence.iter().filter(move |it| it.skill == skill);
    Skill::ALL
        .iter()
        .copied()
        .filter(|skill| seen(*skill).next().is_some())
        .map(|skill| SkillChange {
            skill,
            title: skill.title(),
            is_new: before.skill(skill).opportunities() == 0,
            before_percent: percent(before, skill),
            after_percent: percent(after, skill),
            why: seen(skill).cloned().collect(),
        })
        .collect()
}
