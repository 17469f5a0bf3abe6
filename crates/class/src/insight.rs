//! What an instructor sees of a watched flight beside its screen: how the mission stands, and where the vehicles are in
//! truth.
//!
//! It is sent only while the desk watches, at most once a second, and on average at most 2 kB/s: a long one is
//! followed by a longer pause.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::Words;

/// The least time between two insights.
const INSIGHT_EVERY: Duration = Duration::from_secs(1);
/// An insight that has not changed is sent again after this time: the desk may have forgotten it.
const UNCHANGED_EVERY: Duration = Duration::from_secs(5);
/// The most that insights may take, in bytes per second on average.
const BYTES_PER_S: usize = 2_000;

/// How much of each kind an insight has at most, so that its size has a bound.
const MOST_OBJECTIVES: usize = 12;
/// The maximum number of alerts.
const MOST_ALERTS: usize = 8;
/// The maximum number of vehicles.
const MOST_VEHICLES: usize = 64;
/// The maximum number of corners of all fences.
const MOST_CORNERS: usize = 64;
/// The maximum number of targets.
const MOST_TARGETS: usize = 64;

/// A place in decimetres east and north of the mission's origin.
pub type InsightPlace = [i32; 2];

/// The state of a flight, as only the instructor sees it.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Insight {
    /// The mission's objectives in their order.
    #[serde(default)]
    pub objectives: Vec<ObjectiveInsight>,
    /// The serious alerts that the trainee has not answered.
    #[serde(default)]
    pub alerts: Vec<Words>,
    /// The vehicles of the flight, as they are and as the trainee sees them.
    #[serde(default)]
    pub vehicles: Vec<VehicleInsight>,
    /// The fences of the mission, by their corners.
    #[serde(default)]
    pub fences: Vec<Vec<InsightPlace>>,
    /// What the trainee has to find.
    #[serde(default)]
    pub targets: Vec<TargetInsight>,
}

/// An objective and its state.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ObjectiveInsight {
    /// What is to be reached, in the language of the trainee.
    pub title: Words,
    /// How far it is.
    pub detail: Words,
    /// Whether it is met.
    pub standing: ObjectiveStanding,
}

/// Whether an objective is met.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ObjectiveStanding {
    /// It can still be met.
    Open,
    /// It is met at present.
    Met,
    /// It cannot be met any more.
    Missed,
}

/// A vehicle: what its trainee sees, and the truth.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct VehicleInsight {
    /// Its number, as the trainee types it.
    pub id: u16,
    /// Its mode; empty if it is not known.
    #[serde(default, skip_serializing_if = "Words::is_empty")]
    pub mode: Words,
    /// The charge of its battery in percent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub battery: Option<u8>,
    /// Where the trainee sees it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shown: Option<VehiclePlace>,
    /// Where it is, if the console simulates it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub truth: Option<VehiclePlace>,
}

/// Where a vehicle is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "[i32; 3]", into = "[i32; 3]")]
pub struct VehiclePlace {
    /// Its place over ground.
    pub at: InsightPlace,
    /// Its height above its start in decimetres.
    pub height: i32,
}

impl From<[i32; 3]> for VehiclePlace {
    fn from([east, north, height]: [i32; 3]) -> Self {
        let at = [east, north];
        Self { at, height }
    }
}

impl From<VehiclePlace> for [i32; 3] {
    fn from(VehiclePlace { at, height }: VehiclePlace) -> Self {
        [at[0], at[1], height]
    }
}

impl VehicleInsight {
    /// Where it is, as far as the desk knows: in truth, otherwise as its trainee sees it.
    pub fn place(&self) -> Option<VehiclePlace> {
        self.truth.or(self.shown)
    }

    /// How far from its true place the trainee sees it, in metres over ground; `None` if either is not known.
    pub fn error_m(&self) -> Option<f64> {
        let (shown, truth) = (self.shown?, self.truth?);
        let off = |axis: usize| f64::from(shown.at[axis]) - f64::from(truth.at[axis]);
        let (east, north) = (off(0), off(1));
        Some((east * east + north * north).sqrt() / 10.0)
    }
}

/// An object that the trainee has to find.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct TargetInsight {
    /// Its true position.
    pub at: InsightPlace,
    /// Whether the trainee has reported it.
    #[serde(default, rename = "found", skip_serializing_if = "std::ops::Not::not")]
    pub is_found: bool,
}

impl Insight {
    /// Leaves out what exceeds the bounds, so that every insight fits a line.
    #[must_use]
    pub fn bounded(mut self) -> Self {
        self.objectives.truncate(MOST_OBJECTIVES);
        self.alerts.truncate(MOST_ALERTS);
        self.vehicles.truncate(MOST_VEHICLES);
        self.targets.truncate(MOST_TARGETS);
        let mut corners = 0;
        self.fences.retain(|fence| {
            corners += fence.len();
            corners <= MOST_CORNERS
        });
        self
    }
}

/// What a desk that watches has been sent.
#[derive(Debug, Clone, Default)]
pub(super) struct InsightSender {
    sent: Option<Insight>,
    sent_at: Duration,
    /// When the next one may be sent.
    due: Duration,
}

impl InsightSender {
    /// The next insight, if one is due. It is taken only when one is due.
    pub fn next(
        &mut self,
        insight: impl FnOnce() -> Option<Insight>,
        now: Duration,
    ) -> Option<Insight> {
        if now < self.due {
            return None;
        }
        self.due = now + INSIGHT_EVERY;
        let insight = insight()?.bounded();
        let is_fresh = now < self.sent_at + UNCHANGED_EVERY;
        if is_fresh && self.sent.as_ref() == Some(&insight) {
            return None;
        }
        let bytes = super::protocol::line(&insight).len();
        let lasts = Duration::from_secs_f64(bytes as f64 / BYTES_PER_S as f64);
        self.due = now + lasts.max(INSIGHT_EVERY);
        self.sent = Some(insight.clone());
        self.sent_at = now;
        Some(insight)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::protocol::{LONGEST_LINE, SeatMessage, line};

    /// An insight of the greatest size.
    fn largest(moved: i32) -> Insight {
        let place = VehiclePlace {
            at: [-1_000_000 + moved, -1_000_000],
            height: 100_000,
        };
        let vehicle = VehicleInsight {
            id: 60_000,
            mode: "ї".repeat(200).into(),
            battery: Some(100),
            shown: Some(place),
            truth: Some(place),
        };
        let target = TargetInsight {
            at: place.at,
            is_found: true,
        };
        let objective = ObjectiveInsight {
            title: "ї".repeat(200).into(),
            detail: "ї".repeat(200).into(),
            standing: ObjectiveStanding::Missed,
        };
        Insight {
            objectives: vec![objective; 100],
            alerts: vec!["ї".repeat(200).into(); 100],
            vehicles: vec![vehicle; 300],
            fences: vec![vec![place.at; 40]; 10],
            targets: vec![target; 500],
        }
    }

    #[test]
    fn the_largest_insight_fits_a_line() {
        let insight = largest(0).bounded();
        assert_eq!(insight.fences.len(), 1);
        let line = line(&SeatMessage::Insight(Box::new(insight)));
        assert!(line.len() < LONGEST_LINE, "{}", line.len());
    }

    #[test]
    fn insights_keep_to_their_rate_and_are_sent_only_if_they_have_changed() {
        for vehicles in [1, 12, 300] {
            let mut sender = InsightSender::default();
            let mut bytes = 0;
            for tick in 0..600 {
                let now = Duration::from_millis(tick * 100);
                let insight = Insight {
                    vehicles: largest(tick as i32).vehicles[..vehicles].to_vec(),
                    ..Insight::default()
                };
                let sent = sender.next(|| Some(insight), now);
                bytes += sent.map_or(0, |it| line(&it).len());
            }
            // The last one may have been sent just now.
            let most = 60 * BYTES_PER_S + line(&largest(0).bounded()).len();
            assert!((1..=most).contains(&bytes), "{bytes}");
        }
        let mut sender = InsightSender::default();
        let mut next = |at| sender.next(|| Some(Insight::default()), Duration::from_secs(at));
        assert!(next(0).is_some());
        assert!(next(3).is_none());
        assert!(next(10).is_some());
    }

    #[test]
    fn a_vehicle_is_where_it_is_in_truth() {
        let place = |at| VehiclePlace { at, height: 0 };
        let mut vehicle = VehicleInsight {
            id: 1,
            mode: Words::default(),
            battery: None,
            shown: Some(place([0, 0])),
            truth: None,
        };
        assert_eq!(vehicle.place(), Some(place([0, 0])));
        assert_eq!(vehicle.error_m(), None);
        vehicle.truth = Some(place([300, 400]));
        assert_eq!(vehicle.place(), Some(place([300, 400])));
        assert_eq!(vehicle.error_m(), Some(50.0));
    }
}
