//! Makes a vehicle wait for another one in its way.
//!
//! The plan of a manoeuvre keeps its own members apart. The guard is for all other vehicles: those that hover, are
//! flown by hand, or are in another manoeuvre.

use glam::DVec3;

use super::geometry::MovingPoint;

/// How far the guard looks ahead, in seconds.
const AHEAD_S: f64 = 3.0;
/// The speed assumed for a slower or stationary vehicle, which may start at any time.
const LEAST_SPEED_M_S: f64 = 2.0;
/// The distance in metres: a vehicle this close to its setpoint counts as not moving.
const THERE_M: f64 = 1.0;

/// Whether flying on to `aim` would bring a vehicle closer than `separation_m` to the other one. A vehicle that is too
/// close already may move away.
pub(super) fn is_in_the_way(
    own: MovingPoint,
    aim: DVec3,
    other: MovingPoint,
    separation_m: f64,
) -> bool {
    let way = aim - own.at;
    if way.length() < THERE_M {
        return false;
    }
    let speed = own.velocity_m_s.length().max(LEAST_SPEED_M_S);
    let intended = way.normalize_or_zero() * speed;
    let (apart, closing) = (other.at - own.at, other.velocity_m_s - intended);
    let nearest_s = if closing.length_squared() > 0.0 {
        -apart.dot(closing) / closing.length_squared()
    } else {
        0.0
    };
    // A vehicle that stops before the other one does not come near it.
    let reach_s = AHEAD_S.min(way.length() / speed);
    let nearest_m = (apart + closing * nearest_s.clamp(0.0, reach_s)).length();
    nearest_m < separation_m && nearest_m < apart.length() - 0.1
}

#[cfg(test)]
mod tests {
    use super::*;

    const STILL: DVec3 = DVec3::ZERO;

    fn waits(aim: DVec3, other: DVec3, other_m_s: DVec3) -> bool {
        let own = MovingPoint {
            at: DVec3::ZERO,
            velocity_m_s: DVec3::X * 5.0,
        };
        let other = MovingPoint {
            at: other,
            velocity_m_s: other_m_s,
        };
        is_in_the_way(own, aim, other, 5.0)
    }

    #[test]
    fn somebody_on_the_way_is_waited_for_and_somebody_beside_it_is_not() {
        let aim = DVec3::new(50.0, 0.0, 0.0);
        assert!(waits(aim, DVec3::new(12.0, 1.0, 0.0), STILL));
        assert!(!waits(aim, DVec3::new(12.0, 8.0, 0.0), STILL));
        assert!(
            !waits(aim, DVec3::new(12.0, 0.0, 7.0), STILL),
            "it is above"
        );
        assert!(
            !waits(aim, DVec3::new(-4.0, 0.0, 0.0), STILL),
            "it is behind"
        );
        assert!(!waits(aim, DVec3::new(40.0, 0.0, 0.0), STILL), "it is far");
        let nearer = DVec3::new(5.0, 0.0, 0.0);
        assert!(
            !waits(nearer, DVec3::new(12.0, 0.0, 0.0), STILL),
            "it stops before"
        );
    }

    #[test]
    fn somebody_who_comes_along_is_seen_early_and_one_who_has_arrived_stays() {
        let aim = DVec3::new(50.0, 0.0, 0.0);
        let towards = DVec3::new(-5.0, 0.0, 0.0);
        assert!(waits(aim, DVec3::new(28.0, 0.0, 0.0), towards));
        assert!(!waits(DVec3::ZERO, DVec3::new(8.0, 0.0, 0.0), towards));
    }
}
