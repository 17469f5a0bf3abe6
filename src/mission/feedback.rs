//! The single line of feedback during a flight: the newest item that matters.

use std::time::Duration;

use crate::notice::Notice;
use crate::text::Text;
use crate::vehicle::Severity;

/// The minimum time between two items, unless the new one is critical.
const CALM_FOR: Duration = Duration::from_secs(5);

/// The state of the feedback line.
#[derive(Debug, Clone, Default)]
pub(crate) struct Feedback {
    shown: Option<(Duration, Text)>,
    /// The most important item that is waiting; of equally important ones, the newest.
    waiting: Option<(Severity, Text)>,
}

impl Feedback {
    /// Adds the notices of a step. Plain information, such as one sample of many, is left out.
    pub fn hear(&mut self, notices: &[Notice], now: Duration) {
        for notice in notices.iter().filter(|it| it.severity <= Severity::Notice) {
            if notice.severity <= Severity::Critical {
                self.shown = Some((now, notice.text.clone()));
                self.waiting = None;
            } else if self
                .waiting
                .as_ref()
                .is_none_or(|(severity, _)| notice.severity <= *severity)
            {
                self.waiting = Some((notice.severity, notice.text.clone()));
            }
        }
        let is_calm = self
            .shown
            .as_ref()
            .is_none_or(|(since, _)| now.saturating_sub(*since) >= CALM_FOR);
        if is_calm && let Some((_, text)) = self.waiting.take() {
            self.shown = Some((now, text));
        }
    }

    /// The text shown; `None` before the first item.
    pub fn line(&self) -> Option<&Text> {
        self.shown.as_ref().map(|(_, text)| text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_new_item_waits_for_its_turn_unless_it_is_critical() {
        let mut feedback = Feedback::default();
        for (at_s, said, shown) in [
            (0, Some((Severity::Notice, "map")), "map"),
            (1, Some((Severity::Warning, "fence")), "map"),
            (2, Some((Severity::Notice, "contact")), "map"),
            (5, None, "fence"),
            (6, Some((Severity::Notice, "home")), "fence"),
            (7, Some((Severity::Critical, "person")), "person"),
            (20, None, "person"),
            (21, Some((Severity::Info, "cell A4")), "person"),
            (30, Some((Severity::Notice, "gate")), "gate"),
        ] {
            let now = Duration::from_secs(at_s);
            let notice = said.map(|(severity, text)| Notice::general(now, severity, text.into()));
            feedback.hear(notice.as_slice(), now);
            let line = feedback.line().map(ToString::to_string);
            assert_eq!(line.as_deref(), Some(shown), "{at_s}");
        }
    }
}
