//! What to do next time, and the points to keep and to improve, from the last review of the mission.

use super::Page;
use crate::app::room::page::Tone;
use crate::review::PointKind;
use crate::text;
use crate::text::wrap;

impl Page<'_> {
    /// Adds them before the flight.
    pub(super) fn points(&mut self) {
        let is_read = self.state.session.activity.is_none() || self.awaits_launch();
        let review = self.state.reviews.get(&self.mission.id);
        let Some(review) = review.filter(|it| is_read && !it.points().is_empty()) else {
            return;
        };
        self.text.title(&text!("mission-review"));
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
