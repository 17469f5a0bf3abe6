//! The mission's part in the trainee's career.

use super::MissionPage;
use crate::app::room::home::facts;
use crate::text;

impl MissionPage<'_> {
    /// Adds the mission's state in the career before it is flown. Adds nothing without a profile.
    pub(super) fn career(&mut self) {
        let is_read = self.state.session.activity.is_none() || self.awaits_launch();
        let facts = facts(self.state, self.mission);
        if facts.is_empty() || !is_read {
            return;
        }
        self.text.title(&text!("mission-career"));
        let rows = facts.into_iter().map(|it| (it.name, it.what, it.tone));
        self.text.toned_rows(&rows.collect::<Vec<_>>());
    }
}
