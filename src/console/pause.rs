//! Lets a session stand still and go on.

use super::{Console, Running};
use crate::app::event::Event;
use crate::app::update;

impl Console {
    /// Stops the simulator and the clock by which every deadline, every link's silence and the mission count.
    pub(super) fn pause(&mut self) {
        let Some(running) = &self.running else {
            return;
        };
        running.hold(true);
        self.clock.stop();
        // Nothing that a pause causes is an effect.
        update(&mut self.state, Event::Paused(true));
    }

    /// Lets everything go on; nothing happens where nothing stands still.
    pub(super) fn go_on(&mut self) {
        let Some(lasted) = self.clock.go_on() else {
            return;
        };
        let now = self.clock.now();
        update(&mut self.state, Event::Paused(false));
        if let Some(running) = &mut self.running {
            running.hold(false);
            for notice in running.note_pause(lasted, now) {
                update(&mut self.state, Event::Notice(notice));
            }
        }
    }

    /// Ends the mission; its report comes with the next tick.
    pub(super) fn abandon(&mut self) {
        self.go_on();
        self.running.iter_mut().for_each(Running::abandon);
    }
}
