//! Other aircraft as lines, on demand.

use crate::app::State;
use crate::text::{Text, text};

/// Each aircraft with its approaches to vehicles in the air.
pub(super) fn now(state: &State) -> Vec<Text> {
    let picture = state.session().traffic();
    if picture.is_empty() {
        return vec![text!("traffic-none")];
    }
    let tracked = picture.tracked().iter();
    tracked
        .flat_map(|it| {
            let approaches = it.approaches.iter();
            let indented = approaches.map(|one| Text::joined("", vec!["  ".into(), one.text()]));
            std::iter::once(it.text(state.now())).chain(indented)
        })
        .collect()
}
