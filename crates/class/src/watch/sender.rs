//! A seat's side.

use std::collections::VecDeque;
use std::time::Duration;

use super::part::{PicturePart, parts};
use super::picture::Picture;
use super::{LOOK_EVERY, PICTURE_EVERY, UNCHANGED_EVERY};

/// What a desk that watches has been sent.
#[derive(Debug, Clone, Default)]
pub struct PictureSender {
    sent: Option<Picture>,
    number: u32,
    waiting: VecDeque<PicturePart>,
    looked_at: Option<Duration>,
    said_at: Option<Duration>,
}

impl PictureSender {
    /// The next part, if there is something to send now. The picture is taken only when one is due.
    pub fn next(
        &mut self,
        picture: impl FnOnce() -> Option<Picture>,
        now: Duration,
    ) -> Option<PicturePart> {
        if self.waiting.is_empty() {
            self.look(picture, now);
        }
        let mut part = self.waiting.pop_front()?;
        self.number = self.number.wrapping_add(1);
        part.number = self.number;
        Some(part)
    }

    fn look(&mut self, picture: impl FnOnce() -> Option<Picture>, now: Duration) {
        let passed = |since: Option<Duration>, time| {
            since.is_none_or(|since| now.saturating_sub(since) >= time)
        };
        if !passed(self.looked_at, LOOK_EVERY) || !passed(self.said_at, PICTURE_EVERY) {
            return;
        }
        let Some(picture) = picture() else {
            return;
        };
        self.looked_at = Some(now);
        if self.sent.as_ref() == Some(&picture) && !passed(self.said_at, UNCHANGED_EVERY) {
            return;
        }
        self.said_at = Some(now);
        self.waiting = parts(self.sent.as_ref(), &picture).into();
        self.sent = Some(picture);
    }
}
