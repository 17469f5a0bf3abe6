//! The autopilot's motor mixer: shares of the thrust range for each motor from roll, pitch, yaw and throttle, after
//! `ArduPilot`'s `AP_MotorsMatrix`, with its handling of a lost motor on frames of six and more.

use glam::DVec3;

use super::airframe::Motor;

/// The maximum number of motors of a frame.
pub(super) const MOTORS_MAX: usize = 12;
/// Share of the range that yaw may always use (`MOT_YAW_HEADROOM`).
const YAW_HEADROOM: f64 = 0.2;
/// The time constant of the thrust boost after the loss of a motor (`MOT_SPOOL_TIME`), in seconds.
const BOOST_S: f64 = 0.5;
/// The approximate share of the thrust range in the hover.
const HOVER_SHARE: f64 = 0.4;
/// The filter time of the check for a lost motor, in seconds.
const WATCH_S: f64 = 0.5;

#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Mixer {
    /// The result: shares of the thrust range, 0 to 1.
    pub(super) shares: [f64; MOTORS_MAX],
    /// The demands that could not be met in full.
    pub(super) limited: Limited,
    /// Whether the thrust is boosted to make up for a lost motor.
    pub(super) boost: bool,
    /// The motor with the greatest load, counted from 0. If its load is far greater than the
    /// others', it counts as failed.
    pub(super) lost: usize,
    boost_ratio: f64,
    unbalanced: bool,
    filtered: [f64; MOTORS_MAX],
}

/// The demands beyond the motors' range: lean, yaw, and more throttle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Limited {
    pub(super) lean: bool,
    pub(super) yaw: bool,
    pub(super) throttle: bool,
}

impl Mixer {
    /// Runs the mixer for `dt_s`. `turn` is roll, pitch and yaw from -1 to 1, `throttle` a share of the thrust range.
    pub(super) fn mix(&mut self, motors: &[Motor], turn: DVec3, throttle: f64, dt_s: f64) {
        self.limited = Limited::default();
        let throttle = throttle.clamp(0.0, 1.0);
        self.limited.throttle = throttle >= 1.0;
        for (share, motor) in self.shares.iter_mut().zip(motors) {
            *share = turn.truncate().dot(motor.mix.truncate());
        }
        let yaw_most = self.yaw_room(motors, turn.z, throttle.min(0.5));
        if turn.z.abs() > yaw_most {
            self.limited.yaw = true;
        }
        let yaw = turn.z.clamp(-yaw_most, yaw_most);
        let (mut low, mut high) = (1.0_f64, -1.0_f64);
        for (place, motor) in motors.iter().enumerate() {
            self.shares[place] += yaw * motor.mix.z;
            let share = self.shares[place];
            low = low.min(share);
            if !(self.boost && place == self.lost) {
                high = high.max(share);
            }
        }
        if self.boost && self.shares[self.lost] > high {
            high += (1.0 - self.boost_ratio) * (self.shares[self.lost] - high);
        }
        self.fit(motors.len(), low, high, throttle);
        self.watch(motors.len(), dt_s);
    }

    /// The yaw that is possible in addition to roll and pitch, without a lost motor.
    fn yaw_room(&self, motors: &[Motor], yaw: f64, throttle: f64) -> f64 {
        let room_of = |place: usize, motor: &Motor| {
            let share = throttle + self.shares[place];
            let room = if yaw * motor.mix.z > 0.0 {
                1.0 - share
            } else {
                share
            };
            room.max(0.0) / motor.mix.z.abs().max(1e-3)
        };
        let healthy = motors
            .iter()
            .enumerate()
            .filter(|(place, _)| !(self.boost && *place == self.lost))
            .map(|(place, motor)| room_of(place, motor))
            .fold(1.0, f64::min);
        let headroom = YAW_HEADROOM + self.boost_ratio * (0.5 - YAW_HEADROOM);
        let room = healthy.max(headroom);
        match motors.get(self.lost).filter(|_| self.boost) {
            // The limit from the lost motor fades out as the boost grows.
            Some(motor) => {
                let all = room_of(self.lost, motor).min(room);
                all + self.boost_ratio * (room - all)
            }
            None => room,
        }
    }

    /// Scales and shifts the shares into the range of the motors.
    fn fit(&mut self, count: usize, low: f64, high: f64, throttle: f64) {
        let mut scale = 1.0;
        if high - low > 1.0 {
            scale = 1.0 / (high - low);
        }
        // The throttle may be raised halfway towards the hover to keep the attitude.
        let throttle_mean_most = throttle.max(0.5 * (throttle + HOVER_SHARE));
        if throttle_mean_most + low < 0.0 {
            scale = f64::min(scale, -throttle_mean_most / low);
        }
        let (low, high) = (low * scale, high * scale);
        let mut base = -low;
        if scale < 1.0 {
            self.limited.lean = true;
            self.limited.yaw = true;
            self.limited.throttle |= throttle > base;
        } else if throttle > base {
            let most = 1.0 - high;
            self.limited.throttle |= throttle > most;
            base = throttle.min(most);
        }
        for share in &mut self.shares[..count] {
            *share = (base + scale * *share).clamp(0.0, 1.0);
        }
    }

    /// Detects a motor with a much greater load than the others.
    fn watch(&mut self, count: usize, dt_s: f64) {
        let blend = dt_s / (dt_s + WATCH_S);
        let (mut highest, mut sum) = (0.0, 0.0);
        for place in 0..count {
            self.filtered[place] += blend * (self.shares[place] - self.filtered[place]);
            let share = self.filtered[place];
            sum += share;
            if share > highest {
                highest = share;
                if !self.boost {
                    self.lost = place;
                }
            }
        }
        let balance = if sum > 0.1 {
            highest * count as f64 / sum
        } else {
            1.0
        };
        if count >= 6 && balance >= 1.5 {
            self.unbalanced = true;
        } else if balance <= 1.25 {
            self.unbalanced = false;
        }
        let step = dt_s / BOOST_S;
        let towards = if self.boost && self.unbalanced {
            step
        } else {
            -step
        };
        self.boost_ratio = (self.boost_ratio + towards).clamp(0.0, 1.0);
        if highest < 0.9 && !self.unbalanced && !self.limited.throttle {
            self.boost = false;
        }
    }
}
