//! Where simulated vehicles are in truth, for an instructor.

use std::sync::Arc;

use tokio::sync::watch;

use crate::geo::LatLon;
use crate::sim::World;

/// Places are published after this many steps.
const STEPS_BETWEEN: u64 = 25;

/// Where a simulated vehicle is in truth, whatever its telemetry says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TruePlace {
    pub at: LatLon,
    /// Metres above its start.
    pub height_m: f64,
}

/// The true places of the vehicles, in their order. They are published only while there is a subscriber.
pub type TruePlaces = watch::Sender<Arc<[TruePlace]>>;

/// Publishes the places of a world.
pub(super) struct PlaceFeed {
    places: TruePlaces,
    /// The step at which they were last published.
    published: Option<u64>,
}

impl PlaceFeed {
    pub fn new(places: TruePlaces) -> Self {
        Self {
            places,
            published: None,
        }
    }

    /// Forgets when the places were published last, because another world takes the place of the present one.
    pub fn start_again(&mut self) {
        self.published = None;
    }

    /// Publishes the places if they are due and there is a subscriber.
    pub fn publish(&mut self, world: &World) {
        let steps = world.steps();
        let is_due = self.published.is_none_or(|at| steps >= at + STEPS_BETWEEN);
        if !is_due || self.places.receiver_count() == 0 {
            return;
        }
        self.published = Some(steps);
        let place = |vehicle| {
            let truth = world.truth(vehicle);
            TruePlace {
                at: truth.at,
                height_m: -truth.position_ned_m[2],
            }
        };
        self.places
            .send_replace((0..world.vehicles()).map(place).collect());
    }
}
