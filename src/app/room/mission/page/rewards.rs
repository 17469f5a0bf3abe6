//! What passing the mission brings.

use super::Page;
use crate::mission::Unlock;
use crate::text;
use crate::text::Text;

impl Page<'_> {
    /// Credits and what becomes available; nothing where the mission's file promises nothing.
    pub(super) fn rewards(&self) -> Option<(Text, Text)> {
        let rewards = &self.mission.rewards;
        let credits = (rewards.credits > 0)
            .then(|| text!("mission-reward-credits", credits = rewards.credits));
        let unlocked = rewards.unlock.iter().map(|unlock| self.unlocked(unlock));
        let all: Vec<Text> = credits.into_iter().chain(unlocked).collect();
        (!all.is_empty()).then(|| (text!("mission-rewards"), Text::joined(", ", all)))
    }

    /// Missions by their names, all else by what the catalogue calls it.
    fn unlocked(&self, unlock: &Unlock) -> Text {
        match unlock {
            Unlock::Mission(id) => {
                let mut missions = self.state.missions.iter();
                let known = missions.find(|mission| mission.id == *id);
                let title = known.map_or_else(|| id.as_str().into(), |it| it.title.clone());
                text!("mission-reward-mission", title = title)
            }
            Unlock::Part(id) => text!("mission-reward-part", part = id),
            Unlock::Threat(id) => text!("mission-reward-threat", threat = id),
        }
    }
}
