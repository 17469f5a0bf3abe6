//! Constants and functions for all parts that move: gravity, the time step, the approach to a
//! target.

/// Standard gravity, in metres per second squared.
pub const GRAVITY_M_S2: f64 = 9.806_65;
/// The step of the simulation, in seconds.
pub(super) const STEP_S: f64 = 0.01;

/// The square-root controller: proportional near the target, on a parabola of constant deceleration further out;
/// never so fast that one step would overshoot.
pub(super) fn square_root(error: f64, p: f64, accel: f64) -> f64 {
    let linear = accel / (p * p);
    let rate = if error > linear {
        (2.0 * accel * (error - linear / 2.0)).sqrt()
    } else if error < -linear {
        -(2.0 * accel * (-error - linear / 2.0)).sqrt()
    } else {
        error * p
    };
    let most = error.abs() / STEP_S;
    rate.clamp(-most, most)
}
