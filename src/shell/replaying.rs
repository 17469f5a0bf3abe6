//! Recordings that are replayed.

use std::path::Path;
use std::time::Duration;

use super::Console;
use crate::app::effect::ReplayEffect;
use crate::app::event::{Event, LinkEvent};
use crate::app::room::messages;
use crate::record::Happening;
use crate::replay::Replay;
use crate::store::{Records, user_path};
use crate::text;
use crate::text::Text;

/// The messages are looked at this often.
const LOOK_EVERY: Duration = Duration::from_millis(250);

impl Console {
    /// Replays a recording in place of what runs.
    pub(super) fn replay(&mut self, path: Option<&str>) -> Result<(), Text> {
        if let Some(path) = path {
            let path = user_path(path);
            return self.open_replay(Path::new(&path));
        }
        // The newest may be the one that is being recorded: it ends first.
        self.end_session();
        let records = self.options.preferences.records.as_ref();
        let newest = records.and_then(Records::newest);
        let path = newest.ok_or_else(|| text!("records-none"))?;
        self.open_replay(&path)
    }

    pub(super) fn open_replay(&mut self, path: &Path) -> Result<(), Text> {
        let (replay, events) = Replay::open(path, self.app.state().config())?;
        self.end_session();
        self.replaying = Some(replay);
        for event in events {
            self.post(event);
        }
        Ok(())
    }

    /// Has the replay do what its user wants.
    pub(super) fn steer_replay(&mut self, effect: ReplayEffect) {
        let events = self.replaying.as_mut().map(|it| it.steer(effect));
        for event in events.into_iter().flatten() {
            self.post(event);
        }
    }

    /// Lets the replay go on.
    pub(super) async fn go_on_replaying(&mut self, now: Duration) {
        let Some(replaying) = &mut self.replaying else {
            return;
        };
        let mut events = replaying.tick(now);
        if now >= self.next_traffic
            && let Some(wanted) = messages::wanted(self.app.state())
        {
            self.next_traffic = now + LOOK_EVERY;
            let traffic = vec![replaying.inspect(&wanted)];
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
        if !running.is_recorded() {
            self.post(Event::Failed(text!("bookmark-not-recorded")));
            return;
        }
        running.note_down(self.clock.now(), Happening::Bookmark { text });
        self.post(Event::Answer(text!("bookmark-set")));
    }
}
