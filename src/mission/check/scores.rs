//! Whether the points and medals of the scoring can be earned.

use super::Examined;
use crate::mission::event::Action;
use crate::scoring::Component;
use crate::text;

pub(super) fn check(examined: &mut Examined<'_>) {
    let Some(scoring) = examined.section("scoring") else {
        return;
    };
    let mission = examined.mission;
    let gates = mission.scoring.gold_requires.iter();
    for (gate, written) in gates.zip(scoring.items_of("gold_requires")) {
        if !gate.can_hold() {
            examined.add(written.span.clone(), text!("check-gate-unreachable"));
        }
    }
    let weight = scoring.get("weights").and_then(|it| it.get("attention"));
    let weighs = mission.scoring.weights.of(Component::Attention) > 0.0;
    let mut actions = mission.events.iter().flat_map(|event| &event.actions);
    let asks = |action: &Action| matches!(action, Action::Alert { ok: Some(_), .. });
    let can_be_asked = !mission.may_inject.is_empty() || actions.any(asks);
    if let Some(written) = weight.filter(|_| weighs && !can_be_asked) {
        examined.add(written.span.clone(), text!("check-no-alert"));
    }
}
