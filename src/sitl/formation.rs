//! The places of a swarm's vehicles at the start.

use serde::{Deserialize, Serialize};
use strum::{IntoStaticStr, VariantArray};

use crate::geo::maths;
use crate::sim::Start;

/// The arrangement of vehicles at the start. The first vehicle is at home, and all have the same
/// heading.
#[derive(
    Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr, VariantArray,
)]
#[serde(rename_all = "lowercase")]
#[strum(serialize_all = "lowercase")]
pub enum FormationShape {
    /// Side by side: the others to the right of the first.
    #[default]
    Row,
    /// One behind the other.
    Column,
    /// Rows one behind the other, with about as many rows as vehicles in a row.
    Grid,
    /// A circle, clockwise from home, with its centre behind the first vehicle.
    Circle,
    /// A wedge: the first vehicle at the tip, the others behind it alternately to the right and to the left.
    Wedge,
}

impl FormationShape {
    pub const ALL: &[Self] = <Self as VariantArray>::VARIANTS;

    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// A place in a formation, relative to the first vehicle and its heading.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Offset {
    /// Metres ahead of the first vehicle.
    pub forward_m: f64,
    /// Metres to the right of the first vehicle.
    pub right_m: f64,
}

/// The arrangement of vehicles at the start, and its spacing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StartFormation {
    pub shape: FormationShape,
    /// The distance between neighbours in metres; no two vehicles are closer.
    pub spacing_m: f64,
}

impl StartFormation {
    /// The place of vehicle `index`, counted from 0, of `of` vehicles.
    pub fn place(self, index: usize, of: usize) -> Offset {
        let nth = index as f64;
        let (back, right) = match self.shape {
            FormationShape::Row => (0.0, nth),
            FormationShape::Column => (nth, 0.0),
            FormationShape::Grid => {
                let wide = (1..=of).find(|wide| wide * wide >= of).unwrap_or(1);
                ((index / wide) as f64, (index % wide) as f64)
            }
            FormationShape::Circle => {
                let angle = std::f64::consts::TAU / (of.max(1) as f64);
                // The chord between neighbours is the spacing.
                let radius = if of < 2 {
                    0.0
                } else {
                    0.5 / maths::sin(angle * 0.5)
                };
                let (sin, cos) = maths::sin_cos(angle * nth);
                (radius - radius * cos, radius * sin)
            }
            FormationShape::Wedge => {
                let rank = index.div_ceil(2) as f64 * std::f64::consts::FRAC_1_SQRT_2;
                let side = if index % 2 == 1 { 1.0 } else { -1.0 };
                (rank, rank * side)
            }
        };
        Offset {
            forward_m: -back * self.spacing_m,
            right_m: right * self.spacing_m,
        }
    }

    /// The start of each vehicle, the first one at `first`.
    pub fn starts(self, of: usize, first: Start) -> Vec<Start> {
        let (sin, cos) = maths::sin_cos(first.heading_deg.to_radians());
        let start = |index: usize| {
            let Offset { forward_m, right_m } = self.place(index, of);
            let north_m = forward_m * cos - right_m * sin;
            let east_m = forward_m * sin + right_m * cos;
            Start {
                at: first.at.moved(north_m, east_m),
                ..first
            }
        };
        (0..of).map(start).collect()
    }
}
