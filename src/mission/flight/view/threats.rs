//! What threatens a flight, as the trainee sees it.

use crate::mission::event::alert::OpenAlert;
use crate::mission::flight::Flight;
use crate::mission::{Area, MovingThing};

impl Flight {
    /// The areas that are there now.
    pub(super) fn areas_now(&self) -> Vec<Area> {
        let zones = self.engine.zones_now();
        zones.map(|zone| self.mission.area(zone)).collect()
    }

    pub(super) fn moving_things(&self) -> Vec<MovingThing> {
        let movers = self.engine.movers().iter();
        let thing = |mover: &crate::mission::event::mover::Mover| MovingThing {
            name: mover.id.clone(),
            kind: mover.kind,
            at: self.mission.origin.place(mover.at),
            height_m: mover.height_m,
            keep_out_m: mover.keep_out_m,
        };
        movers.map(thing).collect()
    }

    pub(super) fn open_alerts(&self) -> Vec<OpenAlert> {
        if self.ended.is_some() {
            return Vec::new();
        }
        self.engine.waiting(self.elapsed)
    }
}
