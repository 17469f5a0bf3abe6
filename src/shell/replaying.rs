//! The replay of recordings.

use std::path::{Path, PathBuf};
use std::time::Duration;

use super::Console;
use super::career::Careers;
use crate::app::effect::ReplayEffect;
use crate::app::event::{CareerEvent, Event, LinkEvent, SessionEvent};
use crate::app::room::messages;
use crate::record::Happening;
use crate::replay::Replay;
use crate::store::Records;
use crate::text;
use crate::text::Text;

/// The time between counts of the messages.
const LOOK_EVERY: Duration = Duration::from_millis(250);

impl Console {
    /// Replays a recording in place of the current session; with `review`, begins with its review.
    /// The recording is the one at `path`, otherwise that of the current session, otherwise the
    /// trainee's newest.
    pub(super) fn replay(&mut self, path: Option<&str>, review: bool) -> Result<(), Text> {
        if let Some(path) = path {
            let records = self.options.preferences.records.as_ref();
            let files = Records::find(records, path)?;
            return self.open_replay(files.frames()?, review);
        }
        let newest = match &self.running {
            Some(running) => running.record().map(Path::to_owned),
            None => self.newest_record(),
        };
        let current = newest.ok_or_else(|| text!("records-none"))?;
        // A recording under way ends first; an empty one is removed.
        let was_running = self.running.is_some();
        if was_running {
            self.end_session();
        }
        let left = Some(current).filter(|path| path.is_file());
        let opened = match left.or_else(|| self.newest_record()) {
            Some(path) => self.open_replay(&path, review),
            None => Err(text!("records-none")),
        };
        if opened.is_err() && was_running {
            self.post(SessionEvent::Ended);
        }
        opened
    }

    fn newest_record(&self) -> Option<PathBuf> {
        let trainee = self.careers.as_ref().and_then(Careers::name);
        self.options
            .preferences
            .records
            .as_ref()?
            .newest_of(trainee)
    }

    pub(super) fn open_replay(&mut self, path: &Path, review: bool) -> Result<(), Text> {
        let config = self.app.state().config();
        let (replay, events) = if review {
            Replay::review(path, config)?
        } else {
            Replay::open(path, config)?
        };
        self.end_session();
        self.replaying = Some(replay);
        for event in events {
            self.post(event);
        }
        Ok(())
    }

    /// Applies the user's action to the replay.
    pub(super) fn steer_replay(&mut self, effect: ReplayEffect) {
        let is_review = matches!(effect, ReplayEffect::Keep(_));
        let events = self.replaying.as_mut().map(|it| it.steer(effect));
        for event in events.into_iter().flatten() {
            self.post(event);
        }
        if is_review {
            self.show_reviews();
        }
    }

    /// Shows the trainee's reviews of earlier flights.
    pub(super) fn show_reviews(&mut self) {
        if let Some(records) = &self.options.preferences.records {
            let reviews = records.newest_reviews(self.trainee());
            self.post(CareerEvent::Reviews(reviews));
        }
    }

    pub(super) async fn go_on_replaying(&mut self, now: Duration) {
        let Some(replaying) = &mut self.replaying else {
            return;
        };
        let mut events = replaying.tick(now);
        if now >= self.next_traffic
            && let Some(request) = messages::traffic_request(self.app.state())
        {
            self.next_traffic = now + LOOK_EVERY;
            let traffic = vec![replaying.inspect(&request)];
            events.push(Event::Link(LinkEvent::Traffic(traffic)));
        }
        for event in events {
            self.feed(event).await;
        }
    }

    /// Sets a bookmark at this moment of the flight.
    pub(super) fn bookmark(&mut self, text: String) {
        let Some(running) = &self.running else {
            return;
        };
        if !running.is_recording() {
            self.post(Event::Failed(text!("bookmark-not-recorded")));
            return;
        }
        running.note_down(self.clock.now(), Happening::Bookmark { text });
        self.post(Event::Answer(text!("bookmark-set")));
    }
}

#[cfg(test)]
mod tests;
