//! The extent of everything, kept stable: a map that rescaled with every movement would be unreadable, and would be
//! redrawn completely each time.

use std::time::Duration;

use crate::geo::{Extent, LatLon, LocalFrame};

/// The margin added on a side when something leaves the frame, as a fraction of the frame's size.
const GROWTH: f64 = 0.4;
/// The minimum of the margin added on a side, in metres.
const LEAST_MARGIN_M: f64 = 10.0;
/// The margin around everything, as a share of its size.
const EDGE: f64 = 0.03;
/// The minimum length of the frame's longer side, in metres.
const LEAST_SIZE_M: f64 = 25.0;
/// The frame shrinks when everything fits into this fraction of its size on both axes.
const LOOSE: f64 = 0.5;
/// The time between checks for shrinking.
const LOOK_EVERY: Duration = Duration::from_secs(5);
/// Positions farther from the frame's centre than this, in metres, are ignored: they are wrong, or in another country.
const FARTHEST_M: f64 = 100_000.0;

#[derive(Debug, Clone, Default)]
pub struct Overview {
    frame: Option<Extent>,
    looked_at: Duration,
}

impl Overview {
    /// The frame; `None` while nothing has a position.
    pub fn frame(&self) -> Option<&Extent> {
        self.frame.as_ref()
    }

    /// Extends the frame to a place if needed.
    pub fn see(&mut self, place: LatLon) {
        match &mut self.frame {
            None => self.frame = Some(framed(Extent::at(place))),
            Some(frame) if frame.contains(place) => {}
            Some(frame) if frame.centre().distance_m(place) > FARTHEST_M => {}
            Some(frame) => {
                let mut grown = *frame;
                grown.include(place);
                // Add a margin, so the next few metres do not extend it again.
                let mut beyond = Extent::at(place);
                let size_m = grown.size_m();
                let margin_m = (size_m[0].max(size_m[1]) * GROWTH).max(LEAST_MARGIN_M);
                beyond = beyond.with_margin(0.0, margin_m);
                beyond
                    .corners()
                    .into_iter()
                    .for_each(|it| grown.include(it));
                *frame = grown;
            }
        }
    }

    /// Whether the check for a smaller frame is due; if so, the next interval begins now.
    pub fn is_due(&mut self, now: Duration) -> bool {
        let due = now.saturating_sub(self.looked_at) >= LOOK_EVERY;
        if due {
            self.looked_at = now;
        }
        due
    }

    /// Shrinks the frame if all places fit into a small part of it; returns whether it did.
    pub fn settle(&mut self, places: impl Iterator<Item = LatLon>) -> bool {
        let Some(frame) = self.frame else {
            return false;
        };
        let centre = LocalFrame::at(frame.centre());
        let near = |place: &LatLon| centre.distance_m(*place) <= FARTHEST_M;
        let Some(needed) = Extent::around(places.filter(near)) else {
            return false;
        };
        let tight = framed(needed);
        let (now_m, then_m) = (frame.size_m(), tight.size_m());
        let loose = (0..2).all(|axis| then_m[axis] < now_m[axis] * LOOSE);
        if loose {
            self.frame = Some(tight);
        }
        loose
    }

    /// Fits the frame to the places at once, whatever its present size; without places, the frame
    /// stays.
    pub fn fit(&mut self, places: impl Iterator<Item = LatLon>) {
        let places: Vec<LatLon> = places.collect();
        let Some(&first) = places.first() else {
            return;
        };
        let near = places
            .into_iter()
            .filter(|place| first.distance_m(*place) <= FARTHEST_M);
        self.frame = Extent::around(near).map(framed);
    }
}

/// The frame around everything: a narrow margin, or more ground around a single vehicle on its pad.
fn framed(all: Extent) -> Extent {
    let [east_m, north_m] = all.size_m();
    let missing_m = LEAST_SIZE_M - east_m.max(north_m);
    all.with_margin(EDGE, missing_m.max(0.0) / 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const HOME: LatLon = LatLon::new(50.45, 30.52);

    #[test]
    fn the_frame_moves_rarely_while_a_vehicle_flies_out() {
        let mut overview = Overview::default();
        overview.see(HOME);
        let mut frames = Vec::new();
        for metre in 0..2000 {
            let place = HOME.moved(f64::from(metre), f64::from(metre) / 3.0);
            overview.see(place);
            let frame = *overview.frame().expect("a frame");
            assert!(frame.contains(place) && frame.contains(HOME));
            if frames.last() != Some(&frame) {
                frames.push(frame);
            }
        }
        assert!(frames.len() < 40, "{} frames in 2000 m", frames.len());
    }

    #[test]
    fn the_frame_shrinks_when_everybody_is_back_and_ignores_what_is_in_another_country() {
        let mut overview = Overview::default();
        overview.see(HOME);
        overview.see(HOME.moved(1000.0, 1000.0));
        overview.see(LatLon::new(0.001, 0.001));
        let wide = overview.frame().expect("a frame").size_m();
        assert!(wide[0] < 2000.0, "{wide:?}");
        let spread = [HOME, HOME.moved(700.0, 700.0)];
        assert!(
            !overview.settle(spread.into_iter()),
            "not much would be won"
        );
        assert!(overview.settle([HOME, HOME.moved(10.0, 0.0)].into_iter()));
        assert!(overview.frame().expect("a frame").size_m()[0] < 60.0);
    }

    #[test]
    fn it_looks_now_and_then() {
        let mut overview = Overview::default();
        assert!(!overview.is_due(Duration::from_secs(4)));
        assert!(overview.is_due(Duration::from_secs(5)));
        assert!(!overview.is_due(Duration::from_secs(9)));
    }
}
