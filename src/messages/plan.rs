//! Progress through the plan on board.

use std::collections::BTreeSet;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::{
    MISSION_CURRENT_DATA, MISSION_ITEM_REACHED_DATA, MissionState,
};

use super::HandlerNotices;
use crate::plan::Item;
use crate::plan::command::{is_end, is_jump, is_navigation};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Plan, PlanPause, PlanPhase, PlanProgress, Severity, Vehicle};

/// How long after an order a change of the current item may be its effect.
const ASKED_WITHIN: Duration = Duration::from_secs(10);
/// `MISSION_CURRENT.mission_mode` of a vehicle that flies its plan.
const FLIES_IT: u8 = 1;

/// The items reported as reached since the last change of the current item.
#[derive(Debug, Clone, Default)]
pub(super) struct PlanWatch {
    reached: BTreeSet<u16>,
    /// Whether there was a report since the vehicle's boot.
    has_report: bool,
    /// Whether the vehicle flew its plan at the last report.
    flew: bool,
    /// Whether the end of this flight of the plan has been reported.
    has_ended: bool,
}

impl PlanWatch {
    /// Applies `MISSION_CURRENT`, and reports items that were left out without an order.
    pub(super) fn apply_current(
        &mut self,
        vehicle: &mut Vehicle,
        data: &MISSION_CURRENT_DATA,
        report: &mut HandlerNotices<'_>,
    ) {
        let before = vehicle.plan;
        let total = total(data);
        let is_same = before.total == total;
        let is_news = before.current != data.seq || !is_same;
        let since = before.since.filter(|_| !is_news).or(vehicle.clock());
        let phase = phase(data.mission_state);
        vehicle.plan = PlanProgress {
            current: data.seq,
            total,
            // With a new plan, the item reached in the old one does not apply.
            reached: before.reached.filter(|_| is_same),
            phase,
            pause: PlanPause::reported(before.pause, [before.phase, phase], is_news),
            since,
            arrived: before.arrived.filter(|_| !is_news),
            asked: before.asked,
        };
        let flies = vehicle.armed() && (vehicle.flies_plan() || data.mission_mode == FLIES_IT);
        let flew = std::mem::replace(&mut self.flew, flies);
        let had_report = std::mem::replace(&mut self.has_report, true);
        self.has_ended &= flew || !flies;
        let mut ends = vehicle.plan.phase == Some(PlanPhase::Complete)
            && before.phase == Some(PlanPhase::Active);
        if is_news {
            let reached = std::mem::take(&mut self.reached);
            let is_own = is_same && had_report && !was_asked(before, report.now);
            let begins_anew = is_own && begins_anew(vehicle, before.current);
            ends |= begins_anew;
            if is_own && flies && !begins_anew {
                follow(vehicle, before.current, &reached, report);
            }
        }
        // The motors may stop before this report: the end counts if the vehicle flew at the last one.
        if ends && (flies || flew) && !std::mem::replace(&mut self.has_ended, true) {
            report.say(Severity::Notice, text!("heard-plan-complete"));
        }
    }

    /// Applies `MISSION_ITEM_REACHED`: notes the item as reached.
    pub(super) fn apply_reached(
        &mut self,
        vehicle: &mut Vehicle,
        data: &MISSION_ITEM_REACHED_DATA,
    ) {
        vehicle.plan.reached = Some(data.seq);
        self.reached.insert(data.seq);
    }
}

/// Whether a plan has gone from an item that ends the plan to its first item, as ArduPilot does
/// when the motors stop.
fn begins_anew(vehicle: &Vehicle, before: u16) -> bool {
    let plan = vehicle.plans.plan.content.as_ref();
    let last = plan.and_then(|plan| plan.items.get(usize::from(before)));
    vehicle.plan.current <= 1 && last.is_some_and(|item| is_end(item.command))
}

/// Reports a plan that continued at an unexpected item.
fn follow(
    vehicle: &Vehicle,
    before: u16,
    reached: &BTreeSet<u16>,
    report: &mut HandlerNotices<'_>,
) {
    let Some(plan) = &vehicle.plans.plan.content else {
        return;
    };
    let now = vehicle.plan.current;
    if now == 0 || before == 0 {
        return;
    }
    let text = if now < before {
        let mut from_here = plan.items.iter().skip(usize::from(before));
        let may_jump = from_here.any(|item| is_jump(item.command));
        (!may_jump).then(|| text!("heard-plan-back", before = before, item = now))
    } else {
        left_out(plan, before, now, reached).map(|items| {
            text!(
                "heard-plan-skipped",
                before = before,
                item = now,
                items = items
            )
        })
    };
    if let Some(text) = text {
        report.say(Severity::Warning, text);
    }
}

/// The items between `before` and `now` that were not flown: `5` or `5, 7`. `None` if there are
/// none, or if a jump may have led around them.
fn left_out(plan: &Plan, before: u16, now: u16, reached: &BTreeSet<u16>) -> Option<Text> {
    let number = |at: usize| u16::try_from(at).ok();
    let numbered = plan.items.iter().enumerate();
    let between: Vec<(u16, &Item)> = numbered
        .filter_map(|(at, item)| Some((number(at)?, item)))
        .filter(|(at, _)| (before + 1..now).contains(at))
        .collect();
    if between.iter().any(|(_, item)| is_jump(item.command)) {
        return None;
    }
    let missed = between
        .iter()
        .filter(|(at, item)| is_navigation(item.command) && !reached.contains(at));
    let numbers: Vec<Text> = missed.map(|(at, _)| at.to_string().into()).collect();
    (!numbers.is_empty()).then(|| Text::joined(", ", numbers))
}

fn was_asked(before: PlanProgress, now: Duration) -> bool {
    before
        .asked
        .is_some_and(|asked| now.saturating_sub(asked) <= ASKED_WITHIN)
}

/// The number of items; `None` if the sender does not set it. 0 comes both from such senders and
/// from `ArduPilot` without a plan; the mission state distinguishes them. 65535 means no plan.
fn total(data: &MISSION_CURRENT_DATA) -> Option<u16> {
    match data.total {
        0 if data.mission_state == MissionState::MISSION_STATE_UNKNOWN => None,
        u16::MAX => Some(0),
        items => Some(items),
    }
}

fn phase(state: MissionState) -> Option<PlanPhase> {
    match state {
        MissionState::MISSION_STATE_UNKNOWN => None,
        MissionState::MISSION_STATE_NO_MISSION => Some(PlanPhase::NoPlan),
        MissionState::MISSION_STATE_NOT_STARTED => Some(PlanPhase::NotStarted),
        MissionState::MISSION_STATE_ACTIVE => Some(PlanPhase::Active),
        MissionState::MISSION_STATE_PAUSED => Some(PlanPhase::Paused),
        MissionState::MISSION_STATE_COMPLETE => Some(PlanPhase::Complete),
    }
}

/// The meaning of an `ArduPilot` text for the plan that is flown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum PlanRemark {
    /// A jump was taken: "Mission: 5 Jump 2/3".
    Jumped { item: u16, times: u16 },
    /// A command was left out: "Skipping invalid cmd #210".
    Unknown { command: u16 },
}

impl PlanRemark {
    fn of(text: &str) -> Option<Self> {
        if let Some(command) = text.strip_prefix("Skipping invalid cmd #") {
            let command = command.trim().parse().ok()?;
            return Some(Self::Unknown { command });
        }
        let mut words = text.strip_prefix("Mission: ")?.split_whitespace();
        let item = words.next()?.parse().ok()?;
        let times = words
            .next()
            .filter(|word| *word == "Jump")
            .and(words.next());
        let (times, _) = times?.split_once('/')?;
        Some(Self::Jumped {
            item,
            times: times.parse().ok()?,
        })
    }
}

/// Applies a text of the vehicle.
pub(super) fn apply_text(vehicle: &mut Vehicle, text: &str, report: &mut HandlerNotices<'_>) {
    match PlanRemark::of(text) {
        None => {}
        Some(PlanRemark::Jumped { item, times }) => {
            vehicle.plan_jumps.insert(item, times);
        }
        Some(PlanRemark::Unknown { command }) => {
            let text = match nearest(vehicle, command) {
                Some(item) => text!("heard-plan-unknown", item = item, command = command),
                None => text!("heard-plan-unknown-somewhere", command = command),
            };
            report.say(Severity::Warning, text);
        }
    }
}

/// The number of the item with this command that is nearest to the current item; `None` without
/// such an item.
fn nearest(vehicle: &Vehicle, command: u16) -> Option<u16> {
    let plan = vehicle.plans.plan.content.as_ref()?;
    let numbered = plan.items.iter().enumerate();
    let same = numbered.filter(|(_, item)| item.command == command);
    let numbers = same.filter_map(|(at, _)| u16::try_from(at).ok());
    numbers.min_by_key(|at| at.abs_diff(vehicle.plan.current))
}

#[cfg(test)]
mod tests;
