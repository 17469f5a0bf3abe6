//! Follows vehicles through a measurement: pauses in what they say, and the pace of their clocks.

use std::time::Duration;

use super::sample::Gaps;
use crate::vehicle::Vehicle;

/// What was seen of one vehicle.
#[derive(Debug, Clone, Copy, Default)]
struct Track {
    /// Its own clock in milliseconds, and ours, at the first and the last ATTITUDE.
    first: Option<(u32, Duration)>,
    last: Option<(u32, Duration)>,
}

/// Follows vehicles. Looking often enough (several times between two messages) makes the pauses exact: they are
/// taken from the times at which the messages came, not from the times of looking.
#[derive(Debug, Default)]
pub(super) struct Tracks {
    tracks: Vec<Track>,
    gaps_ms: Vec<f64>,
}

impl Tracks {
    /// Takes a look at one of the vehicles.
    pub fn see(&mut self, index: usize, vehicle: &Vehicle) {
        if self.tracks.len() <= index {
            self.tracks.resize(index + 1, Track::default());
        }
        let (Some(attitude), Some(boot_ms)) = (vehicle.attitude, vehicle.boot_ms) else {
            return;
        };
        let track = &mut self.tracks[index];
        let seen = Some((boot_ms, attitude.at));
        match track.last {
            None => track.first = seen,
            Some((_, before)) if before == attitude.at => return,
            Some((_, before)) => {
                let gap = attitude.at.saturating_sub(before);
                self.gaps_ms.push(gap.as_secs_f64() * 1e3);
            }
        }
        track.last = seen;
    }

    /// Pauses so far.
    pub fn gaps(&self) -> Gaps {
        Gaps::of(self.gaps_ms.clone())
    }

    /// Simulated seconds per second: the mean over the vehicles, and the slowest. A vehicle that has said nothing
    /// stands still.
    pub fn factor(&self) -> Option<(f64, f64)> {
        let factors: Vec<f64> = self.tracks.iter().map(Track::factor).collect();
        let least = factors.iter().copied().reduce(f64::min)?;
        Some((factors.iter().sum::<f64>() / factors.len() as f64, least))
    }
}

impl Track {
    fn factor(&self) -> f64 {
        let (Some((boot_before, before)), Some((boot_after, after))) = (self.first, self.last)
        else {
            return 0.0;
        };
        let wall_ms = after.saturating_sub(before).as_secs_f64() * 1e3;
        if wall_ms == 0.0 {
            return 0.0;
        }
        f64::from(boot_after.saturating_sub(boot_before)) / wall_ms
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vehicle::Attitude;

    fn vehicle(boot_ms: u32, at_ms: u64) -> Vehicle {
        let mut vehicle = Vehicle::new(1, 1);
        vehicle.boot_ms = Some(boot_ms);
        vehicle.attitude = Some(Attitude {
            roll_deg: 0.0,
            pitch_deg: 0.0,
            yaw_deg: 0.0,
            at: Duration::from_millis(at_ms),
        });
        vehicle
    }

    #[test]
    fn pauses_and_pace_are_of_messages_and_not_of_looks() {
        let mut tracks = Tracks::default();
        for (boot_ms, at_ms) in [
            (5000, 100),
            (5000, 100),
            (5100, 200),
            (5190, 300),
            (5370, 500),
        ] {
            tracks.see(0, &vehicle(boot_ms, at_ms));
            tracks.see(1, &vehicle(boot_ms - 5000, at_ms));
        }
        let gaps = tracks.gaps();
        assert!((gaps.p50_ms - 100.0).abs() < 1e-9 && (gaps.max_ms - 200.0).abs() < 1e-9);
        let (mean, least) = tracks.factor().expect("two vehicles");
        assert!((mean - 0.925).abs() < 1e-9 && (least - 0.925).abs() < 1e-9);
    }

    #[test]
    fn a_silent_vehicle_stands_still() {
        let mut tracks = Tracks::default();
        tracks.see(0, &Vehicle::new(1, 1));
        assert_eq!(tracks.factor(), Some((0.0, 0.0)));
        assert_eq!(Tracks::default().factor(), None);
    }
}
