//! Whether what the scoring promises can be earned.

use super::{Examined, WrittenEntry};
use crate::mission::event::Action;
use crate::scoring::{Component, Gate};

pub(super) fn check(examined: &mut Examined<'_>) {
    let Some(scoring) = examined.section("scoring") else {
        return;
    };
    let gates = scoring
        .get("gold_requires")
        .map_or(Vec::new(), WrittenEntry::items);
    for entry in gates {
        let gate = entry.text().and_then(|text| Gate::parse(text).ok());
        if gate.is_some_and(|gate| !gate.can_hold()) {
            examined.add(entry.span(), "nobody can reach this");
        }
    }
    let weight = scoring.get("weights").and_then(|it| it.get("attention"));
    let mission = examined.mission;
    let weighs = mission.scoring.weights.of(Component::Attention) > 0.0;
    let mut actions = mission.events.iter().flat_map(|event| &event.actions);
    let asks = |action: &Action| matches!(action, Action::Alert { ok: Some(_), .. });
    let can_be_asked = !mission.may_inject.is_empty() || actions.any(asks);
    if let Some(entry) = weight.filter(|_| weighs && !can_be_asked) {
        examined.add(
            entry.span(),
            "no alert of this mission has an `ok` to answer it by",
        );
    }
}
