//! The parts that a trainee may use, and the purchase of more parts.

use super::part_under_cursor;
use crate::app::State;
use crate::app::effect::{CareerEffect, Effect};
use crate::app::state::Consequence;
use crate::campaign::{PartState, PurchaseRefusal};
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;
use crate::workshop::{Design, Part};

/// Whether the trainee may use a part.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Licence {
    /// The trainee may use the part; without a career, this is true of every part.
    Held,
    /// The trainee may use it after paying this many credits.
    ForSale(u32),
    /// The trainee may use it after passing the mission with this title.
    Locked(Text),
}

/// Whether the trainee may use a part.
pub fn licence(state: &State, part: &Part) -> Licence {
    let Some(career) = &state.training.career else {
        return Licence::Held;
    };
    match career.standing.part_state(part, &career.course) {
        PartState::Owned => Licence::Held,
        PartState::ForSale(price) => Licence::ForSale(price),
        PartState::Locked(mission) => Licence::Locked(title(state, &mission)),
    }
}

/// The parts of a design that the trainee may not use yet, each once.
pub fn lacking(state: &State, design: &Design) -> Vec<&'static Part> {
    let Some(career) = &state.training.career else {
        return Vec::new();
    };
    let missing = career.standing.missing_parts(design, &career.course);
    missing.into_iter().map(|(part, _)| part).collect()
}

/// Asks before buying the part under the cursor.
pub(super) fn buy(state: &mut State) {
    let Some(part) = part_under_cursor(state) else {
        return;
    };
    let Some(career) = &state.training.career else {
        return state.say(Severity::Warning, text!("bench-guests-buy-nothing"));
    };
    match career.standing.buy(part.id, &career.course) {
        Ok(purchase) => {
            let credits = career.standing.credits();
            let left = credits.saturating_sub(purchase.credits);
            let question = text!(
                "bench-ask-buy",
                part = part.name(),
                price = purchase.credits
            );
            let reason = text!("bench-ask-buy-reason", credits = credits, left = left);
            let effect = Effect::Career(CareerEffect::BuyPart(part.id.to_owned()));
            state.ask(question, reason, Consequence::Effect(effect));
        }
        Err(refusal) => {
            let text = match refusal {
                PurchaseRefusal::Locked(mission) => {
                    text!("bench-locked-by", mission = title(state, &mission))
                }
                other @ (PurchaseRefusal::Unknown
                | PurchaseRefusal::Owned
                | PurchaseRefusal::TooDear(..)) => other.text(),
            };
            state.say(Severity::Warning, text);
        }
    }
}

fn title(state: &State, mission: &str) -> Text {
    let career = state.training.career.as_ref();
    let offer = career.and_then(|career| career.course.offer(mission));
    offer.map_or_else(|| Text::verbatim(mission), |offer| offer.title.clone())
}
