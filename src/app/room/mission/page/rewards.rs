//! The reward for passing the mission.

use super::MissionPage;
use crate::app::room::home::unlocked;
use crate::text;
use crate::text::Text;

impl MissionPage<'_> {
    /// Credits and unlocks; `None` if the mission has none.
    pub(super) fn rewards(&self) -> Option<(Text, Text)> {
        let rewards = &self.mission.rewards;
        let credits = (rewards.credits > 0)
            .then(|| text!("mission-reward-credits", credits = rewards.credits));
        let unlocked = rewards
            .unlock
            .iter()
            .map(|unlock| unlocked(self.state, unlock));
        let all: Vec<Text> = credits.into_iter().chain(unlocked).collect();
        (!all.is_empty()).then(|| (text!("mission-rewards"), Text::joined(", ", all)))
    }
}
