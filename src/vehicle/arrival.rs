//! How near to a place a vehicle flies or drives, by its own parameters.

/// The radii of a vehicle, in metres; `None` until its parameters have been read.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ArrivalRadii {
    /// Within this distance a rover or boat stops (`WP_RADIUS`).
    pub waypoint_radius_m: Option<f32>,
    /// At this distance a plane circles (`WP_LOITER_RAD`).
    pub loiter_radius_m: Option<f32>,
}

impl ArrivalRadii {
    /// Takes in the value of a parameter.
    pub fn note(&mut self, name: &str, value: f32) {
        if !value.is_finite() {
            return;
        }
        match name {
            "WP_RADIUS" => self.waypoint_radius_m = Some(value.abs()),
            // A negative radius circles counterclockwise.
            "WP_LOITER_RAD" => self.loiter_radius_m = Some(value.abs()),
            _ => {}
        }
    }
}
