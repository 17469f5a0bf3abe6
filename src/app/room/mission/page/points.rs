//! The plan for the next flight, and the points to keep and to improve, from the last review of the mission.

use super::MissionPage;
use crate::app::room::page::Tone;
use crate::review::{PointKind, Review};
use crate::text;
use crate::text::wrap;

impl MissionPage<'_> {
    /// Adds the plan and the points if the mission has not been flown yet.
    pub(super) fn points(&mut self) {
        let is_read = self.state.session.activity.is_none() || self.awaits_launch();
        let review = self.state.training.reviews.get(&self.mission.id);
        let says = |it: &&Review| is_read && (!it.points().is_empty() || !it.next.is_empty());
        let Some(review) = review.filter(says) else {
            return;
        };
        self.text.title(&text!("mission-review"));
        if !review.next.is_empty() {
            let next = text!("mission-review-next", text = review.next.as_str());
            let words = self.text.locale.text(&next);
            self.text.paragraph(Tone::Hint, &words);
        }
        let points = PointKind::ALL
            .into_iter()
            .flat_map(|kind| review.points_of(kind));
        for point in points {
            let lead = point.kind.sign();
            for (at, line) in wrap(&point.text, self.text.width - 2).iter().enumerate() {
                let lead = if at == 0 { lead } else { ' ' };
                self.text.add(Tone::Hint, format!("{lead} {line}"));
            }
        }
    }
}
