//! The positions of the motors in the usual frames.

use glam::DVec3;
use sortie_geo::maths;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Motor {
    /// Metres forward, right and down from the centre.
    pub(crate) position_m: DVec3,
    /// Unit vector of its thrust in the same axes; straight up unless the file sets another
    /// direction.
    pub(crate) thrust: DVec3,
    /// +1 for a propeller that turns counterclockwise and so turns the body clockwise, -1 for the
    /// opposite.
    pub(crate) spin: f64,
    /// The motor's factors in the autopilot's mixer: for a roll to the right, a pitch up and a turn
    /// to the right, each at most one half.
    pub(crate) mix: DVec3,
}

/// The motors of plus frames in the order of `ArduPilot`'s outputs: the angle clockwise from the nose in degrees, and
/// the spin.
const QUAD: &[(f64, f64)] = &[(90.0, 1.0), (-90.0, 1.0), (0.0, -1.0), (180.0, -1.0)];
const HEXA: &[(f64, f64)] = &[
    (0.0, -1.0),
    (180.0, 1.0),
    (-120.0, -1.0),
    (60.0, 1.0),
    (-60.0, 1.0),
    (120.0, -1.0),
];
const OCTA: &[(f64, f64)] = &[
    (0.0, -1.0),
    (180.0, -1.0),
    (45.0, 1.0),
    (135.0, 1.0),
    (-45.0, 1.0),
    (-135.0, 1.0),
    (-90.0, -1.0),
    (90.0, -1.0),
];
const DODECA: &[(f64, f64)] = &[
    (30.0, 1.0),
    (30.0, -1.0),
    (90.0, -1.0),
    (90.0, 1.0),
    (150.0, 1.0),
    (150.0, -1.0),
    (-150.0, -1.0),
    (-150.0, 1.0),
    (-90.0, 1.0),
    (-90.0, -1.0),
    (-30.0, -1.0),
    (-30.0, 1.0),
];

/// The supported numbers of motors.
pub(super) const COUNTS: [usize; 5] = [4, 6, 8, 10, 12];

/// A plus frame with this number of motors.
pub(super) fn standard(count: usize, radius_m: f64) -> Vec<Motor> {
    let angles: Vec<(f64, f64)> = match count {
        6 => HEXA.to_vec(),
        8 => OCTA.to_vec(),
        12 => DODECA.to_vec(),
        10 => (0..10)
            .map(|place| {
                let spin = if place % 2 == 0 { 1.0 } else { -1.0 };
                (36.0 * f64::from(place), spin)
            })
            .collect(),
        _ => QUAD.to_vec(),
    };
    let rolls = angles
        .iter()
        .map(|(angle, _)| maths::sin(angle.to_radians()).abs());
    let pitches = angles
        .iter()
        .map(|(angle, _)| maths::cos(angle.to_radians()).abs());
    let (most_roll, most_pitch) = (rolls.fold(0.1, f64::max), pitches.fold(0.1, f64::max));
    angles
        .iter()
        .map(|&(angle, spin)| {
            let (sin, cos) = maths::sin_cos(angle.to_radians());
            Motor {
                position_m: DVec3::new(cos, sin, 0.0) * radius_m,
                thrust: DVec3::NEG_Z,
                spin,
                mix: DVec3::new(-0.5 * sin / most_roll, 0.5 * cos / most_pitch, 0.5 * spin),
            }
        })
        .collect()
}
