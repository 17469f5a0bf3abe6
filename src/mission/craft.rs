//! One vehicle as a mission sees it: its position in the mission's frame, and its state.

use std::time::Duration;

use super::ground_truth::Passage;
use super::report::distance_m;
use super::saying::TextListener;
use super::sensor::{Probe, Sensor};
use super::zone::ZoneKind;
use super::{Mission, Point, TICK};
use crate::geo::maths;
use crate::scoring::SafetyKind;
use crate::text;
use crate::text::Text;
use crate::vehicle::{GlobalPosition, Mode, Vehicle, VehicleId};

/// Motors that stop above this height let a vehicle fall.
const FALL_FROM_M: f64 = 2.0;
/// Below this height, the descent rate is used to judge a touchdown.
const NEAR_GROUND_M: f64 = 3.0;
/// Touching down faster than this is a crash; `ArduCopter` lands at 0.5 m/s.
const HARD_TOUCHDOWN_M_S: f64 = 2.5;
/// The margin above a limit before it counts as exceeded: the height of a hovering vehicle varies by some decimetres.
pub const SWING_M: f64 = 1.0;
/// How near the battery may come to what is required at landing before a vehicle should land, in percentage points.
pub const RUNNING_SHORT: f64 = 10.0;
/// A landing farther than this from every pad costs safety points.
const OFF_PAD_M: f64 = 3.0;

/// A vehicle in a mission.
#[derive(Debug, Clone)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "independent facts about one vehicle"
)]
pub(crate) struct Craft {
    pub id: VehicleId,
    /// Its position, once received.
    pub at: Option<Point>,
    /// Height above home, in metres.
    pub height_m: f64,
    pub speed_m_s: f64,
    /// The course that the vehicle flies or flew last.
    pub course: CraftCourse,
    /// Whether its pre-arm checks pass.
    pub ready: bool,
    pub armed: bool,
    /// Whether it is in the air or, as a ground robot or a boat, has set out and is still armed.
    pub under_way: bool,
    /// Whether it moves on the ground or on water.
    pub on_surface: bool,
    /// Whether it is in the mode that flies plans.
    pub in_auto: bool,
    /// Whether its mode makes the vehicle return or land on its own.
    pub comes_down: bool,
    /// Whether it reports an active failsafe.
    pub in_failsafe: bool,
    /// Whether it has been in the air during this mission.
    pub flown: bool,
    /// Whether it has crashed, or its simulator's process has ended.
    pub lost: bool,
    /// Whether its telemetry arrives.
    pub heard: bool,
    /// Distance to the nearest pad, in metres.
    pub pad_distance_m: Option<f64>,
    pub battery_percent: Option<f64>,
    /// How long it has been disarmed on the ground after flying.
    pub down_for: Duration,
    pub sensors: Vec<&'static Sensor>,
    /// Whether it carries a flail.
    pub has_flail: bool,
    /// Its sensors that measure a field.
    pub probes: Vec<Probe>,
    /// Position and height while the vehicle is not heard.
    unheard: Option<(Point, f64)>,
    /// Energy reading at the beginning and now, in Wh.
    energy_wh: Option<(f64, f64)>,
    /// The fastest descent since the vehicle last came near the ground, in m/s.
    sink_m_s: f64,
    listener: TextListener,
}

/// A broken rule with its description.
pub(crate) type Breach = (SafetyKind, Text);

impl Craft {
    /// A vehicle with its sensors; their noise depends on the seed.
    pub fn new(id: VehicleId, sensors: &[&'static Sensor], seed: u64) -> Self {
        let stream = |index: usize| u64::from(id) * 256 + index as u64;
        let fitted = sensors.iter().enumerate();
        Self {
            id,
            at: None,
            height_m: 0.0,
            speed_m_s: 0.0,
            course: CraftCourse::default(),
            ready: false,
            armed: false,
            under_way: false,
            on_surface: false,
            in_auto: false,
            comes_down: false,
            in_failsafe: false,
            flown: false,
            lost: false,
            heard: false,
            pad_distance_m: None,
            battery_percent: None,
            down_for: Duration::ZERO,
            sensors: sensors.to_vec(),
            has_flail: false,
            probes: fitted
                .filter_map(|(index, sensor)| Probe::new(sensor, seed, stream(index)))
                .collect(),
            unheard: None,
            energy_wh: None,
            sink_m_s: 0.0,
            listener: TextListener::default(),
        }
    }

    /// Whether the vehicle is disarmed on the ground after flying.
    pub fn is_down(&self) -> bool {
        self.flown && !self.lost && !self.armed && !self.under_way
    }

    /// Whether a ground robot or a boat is back on its pad and waits there to be disarmed.
    pub fn awaits_disarming(&self) -> bool {
        let is_home = self.pad_distance_m.is_some_and(|far| far <= OFF_PAD_M);
        self.on_surface && self.under_way && is_home && self.comes_down && self.speed_m_s < 0.3
    }

    /// The ground that a ground robot passes now; `None` for other vehicles, and while it stands.
    pub fn passage(&self) -> Option<Passage> {
        let drives = self.on_surface && self.under_way && !self.lost;
        Some(Passage {
            at: self.at.filter(|_| drives)?,
            speed_m_s: self.speed_m_s,
            has_flail: self.has_flail,
        })
    }

    /// Whether the vehicle is under way and not lost.
    pub fn flies(&self) -> bool {
        self.under_way && !self.lost
    }

    /// Whether the vehicle's detectors work and its radio delivers their results.
    pub fn can_see(&self) -> bool {
        self.heard && self.under_way && !self.lost
    }

    /// Whether the vehicle flies a plan.
    pub fn flies_plan(&self) -> bool {
        self.in_auto && self.under_way && !self.lost
    }

    /// The vehicle's true position, even while the operator does not receive it; `None` before the
    /// first position.
    pub fn truly_at(&self) -> Option<Point> {
        self.unheard.map(|(at, _)| at).or(self.at)
    }

    /// The vehicle's true position with its height: metres east, north and up; `None` before the
    /// first position.
    pub fn place_m(&self) -> Option<[f64; 3]> {
        let known = self.at.map(|at| (at, self.height_m));
        let ([east_m, north_m], up_m) = self.unheard.or(known)?;
        Some([east_m, north_m, up_m])
    }

    /// Whether the vehicle has a sensor, by id.
    pub fn carries(&self, sensor: &str) -> bool {
        self.sensors.iter().any(|fitted| fitted.id == sensor)
    }

    /// The readings of the vehicle's hazard sensors.
    pub fn shown(&self) -> Vec<f64> {
        self.probes.iter().map(|probe| probe.shown).collect()
    }

    /// Energy used during this mission, in Wh; `None` without a reading.
    pub fn used_wh(&self) -> Option<f64> {
        self.energy_wh.map(|(first, now)| (now - first).max(0.0))
    }

    /// Takes a snapshot of the vehicle; `active` marks the zones that are active now. Returns the rules that it breaks
    /// now.
    pub fn step(&mut self, vehicle: &Vehicle, mission: &Mission, active: &[bool]) -> Vec<Breach> {
        let (was_armed, was_under_way, old_height_m) = (self.armed, self.under_way, self.height_m);
        self.take(vehicle, mission);
        let texts = self.listener.listen(vehicle);
        if self.lost {
            return Vec::new();
        }
        let mut breaches: Vec<Breach> = texts
            .iter()
            .filter_map(|text| from_text(&text.text))
            .collect();
        if was_armed && !self.armed && was_under_way && self.under_way && old_height_m > FALL_FROM_M
        {
            let text = text!(
                "mission-motors-stopped",
                height = format!("{old_height_m:.0}")
            );
            breaches.push((SafetyKind::DisarmInFlight, text));
        }
        if was_under_way && !self.under_way && self.sink_m_s > HARD_TOUCHDOWN_M_S {
            breaches.push(hit_ground(self.sink_m_s));
        }
        if let Some(loss) = breaches.iter().position(|(kind, _)| kind.is_loss()) {
            self.lost = true;
            return vec![breaches.swap_remove(loss)];
        }
        if self.under_way {
            breaches.extend(self.place_breaches(mission, active));
        }
        if was_armed && self.is_down() {
            breaches.extend(self.landing_breaches(mission));
        }
        self.down_for = if self.is_down() {
            self.down_for + TICK
        } else {
            Duration::ZERO
        };
        breaches
    }

    fn take(&mut self, vehicle: &Vehicle, mission: &Mission) {
        self.heard = !vehicle.link.lost;
        self.ready = vehicle.ready_to_arm();
        self.armed = vehicle.armed();
        self.on_surface = vehicle.is_on_surface();
        self.under_way = if self.on_surface {
            self.armed && (self.under_way || vehicle.moves())
        } else {
            vehicle.airborne()
        };
        self.in_auto = vehicle.flies_plan();
        self.comes_down = vehicle.mode().is_some_and(Mode::comes_down);
        self.in_failsafe = vehicle.in_failsafe();
        self.flown |= self.under_way && self.armed;
        self.speed_m_s = vehicle.ground_speed_m_s().map_or(0.0, f64::from);
        let sound =
            |global: &GlobalPosition| global.at_point.is_valid() && global.altitude_m.is_finite();
        if let Some(global) = vehicle.global.filter(sound) {
            let at = mission.site.origin.point(global.at_point);
            let distances = mission.seats.pads.iter().map(|&pad| distance_m(at, pad));
            self.pad_distance_m = distances.min_by(f64::total_cmp);
            self.at = Some(at);
            self.course.turn(&global);
            // A ground robot or a boat is on the surface, whatever its autopilot takes for its home's height.
            self.height_m = if self.on_surface {
                0.0
            } else {
                global.altitude_m
            };
            if self.height_m > NEAR_GROUND_M {
                self.sink_m_s = 0.0;
            } else if self.under_way {
                self.sink_m_s = self.sink_m_s.max(f64::from(global.down_m_s));
            }
        }
        self.unheard = vehicle
            .unheard
            .map(|unheard| (mission.site.origin.point(unheard.at), unheard.altitude_m));
        if let Some(battery) = vehicle.battery() {
            self.battery_percent = battery.remaining_percent.map(f64::from);
            let from_charge =
                || Some(f64::from(battery.consumed_mah?) / 1000.0 * f64::from(battery.voltage_v?));
            if let Some(now) = battery
                .consumed_wh
                .map(f64::from)
                .or_else(from_charge)
                .filter(|wh| wh.is_finite())
            {
                let first = self.energy_wh.map_or(now, |(first, _)| first);
                self.energy_wh = Some((first, now));
            }
        }
    }

    fn place_breaches(&self, mission: &Mission, active: &[bool]) -> Vec<Breach> {
        let mut breaches = Vec::new();
        if self.height_m > mission.rules.max_height_m + SWING_M {
            let text = text!(
                "mission-too-high",
                height = format!("{:.0}", mission.rules.max_height_m)
            );
            breaches.push((SafetyKind::TooHigh, text));
        }
        let Some(at) = self.at else { return breaches };
        let zones = mission.site.zones.iter().zip(active);
        for (zone, _) in zones.filter(|(_, active)| **active) {
            if let ZoneKind::Geofence { ceiling_m } = zone.kind {
                let over = ceiling_m.is_some_and(|ceiling| self.height_m > ceiling + SWING_M);
                if over || !zone.shape.contains(at) {
                    let text = text!("mission-outside-fence", fence = &zone.id);
                    breaches.push((SafetyKind::Geofence, text));
                }
            }
        }
        breaches
    }

    fn landing_breaches(&self, mission: &Mission) -> Vec<Breach> {
        let mut breaches = Vec::new();
        if let Some(distance) = self.pad_distance_m.filter(|&distance| distance > OFF_PAD_M) {
            breaches.push((
                SafetyKind::OffPad,
                text!("mission-off-pad", distance = format!("{distance:.1}")),
            ));
        }
        if let Some(percent) = self.below_reserve(mission) {
            let text = text!(
                "mission-low-reserve",
                percent = format!("{percent:.0}"),
                needed = format!("{:.0}", mission.rules.land_reserve_percent)
            );
            breaches.push((SafetyKind::LowReserve, text));
        }
        breaches
    }

    /// The rules that the vehicle breaks by not being disarmed on the ground at the end of the
    /// mission.
    pub fn unlanded_breaches(&self, mission: &Mission) -> Vec<Breach> {
        let mut breaches = Vec::new();
        if self.lost || !self.flown || self.is_down() {
            return breaches;
        }
        if self.under_way {
            let text = if self.on_surface {
                text!("mission-not-stopped")
            } else {
                text!("mission-not-landed")
            };
            breaches.push((SafetyKind::NotLanded, text));
        }
        if let Some(percent) = self.below_reserve(mission) {
            let text = text!(
                "mission-end-reserve",
                percent = format!("{percent:.0}"),
                needed = format!("{:.0}", mission.rules.land_reserve_percent)
            );
            breaches.push((SafetyKind::LowReserve, text));
        }
        breaches
    }

    /// Whether the battery is so near the reserve required at landing that the vehicle should land.
    pub fn runs_short(&self, mission: &Mission) -> bool {
        let least = mission.rules.land_reserve_percent + RUNNING_SHORT;
        self.battery_percent.is_some_and(|percent| percent < least)
    }

    /// The vehicle's battery in percent, if that is below the reserve required at landing.
    fn below_reserve(&self, mission: &Mission) -> Option<f64> {
        let percent = self.battery_percent?;
        (percent < mission.rules.land_reserve_percent).then_some(percent)
    }
}

/// A vehicle's course over the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CraftCourse {
    east: f64,
    north: f64,
}

impl Default for CraftCourse {
    fn default() -> Self {
        Self {
            east: 0.0,
            north: 1.0,
        }
    }
}

impl CraftCourse {
    /// A vehicle slower than this hovers and keeps its course.
    const SLOWEST_M_S: f64 = 0.3;

    fn turn(&mut self, global: &GlobalPosition) {
        let (east, north) = (f64::from(global.east_m_s), f64::from(global.north_m_s));
        let speed = maths::hypot(east, north);
        if speed >= Self::SLOWEST_M_S {
            *self = Self {
                east: east / speed,
                north: north / speed,
            };
        }
    }

    /// Converts an offset east and north into an offset to the right of the course and along it.
    pub fn offset_m(self, [east, north]: Point) -> [f64; 2] {
        [
            east * self.north - north * self.east,
            east * self.east + north * self.north,
        ]
    }

    /// Converts an offset to the right of the course into an offset east and north.
    pub fn aside(self, right_m: f64) -> Point {
        [right_m * self.north, -right_m * self.east]
    }
}

fn hit_ground(speed_m_s: f64) -> Breach {
    let text = text!("mission-hit-ground", speed = format!("{speed_m_s:.1}"));
    (SafetyKind::Crash, text)
}

/// The broken rule that a status text of `ArduPilot` or its simulator reports, if any.
fn from_text(text: &str) -> Option<Breach> {
    if let Some(rest) = text.strip_prefix("SIM Hit ground at ") {
        let speed: f64 = rest.split_whitespace().next()?.parse().ok()?;
        return (speed > HARD_TOUCHDOWN_M_S).then(|| hit_ground(speed));
    }
    let known = [
        ("Crash:", SafetyKind::Crash),
        ("EKF Failsafe", SafetyKind::OtherFailsafe),
        ("GCS Failsafe", SafetyKind::OtherFailsafe),
    ];
    if let Some((_, kind)) = known.iter().find(|(start, _)| text.starts_with(start)) {
        let cleared = text.ends_with("Cleared");
        return (!cleared).then(|| (*kind, Text::verbatim(text)));
    }
    if !text.starts_with("Battery ") {
        return None;
    }
    if text.contains(" is critical") {
        Some((
            SafetyKind::BatteryCritical,
            text!("mission-battery-critical"),
        ))
    } else if text.contains(" is low") {
        Some((SafetyKind::BatteryLow, text!("mission-battery-low")))
    } else {
        None
    }
}
