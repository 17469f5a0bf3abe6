//! Demands of threats on the vehicles' simulators and links.
//!
//! Wind and faults are `SIM_*` parameters by the names of `ArduCopter` 4.6, which the embedded simulator has as well;
//! whoever carries a demand out finds the name that another version has for it. What is no longer wanted goes back to
//! the parameter's usual value.

use std::collections::BTreeMap;

use super::fault::{Broken, FaultKind};
use crate::geo::maths;
use crate::geo::{LatLon, METRES_PER_DEGREE};
use crate::mission::weather::Weather;
use crate::session::{RadioFault, Want};
use crate::vehicle::VehicleId;

/// Something that has to be done to one vehicle, quietly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Demand {
    /// The vehicle that it is about.
    pub vehicle: VehicleId,
    /// What its simulator or its link has to do.
    pub want: Want,
}

const WIND_SPEED: &str = "SIM_WIND_SPD";
const WIND_FROM: &str = "SIM_WIND_DIR";
const TURBULENCE: &str = "SIM_WIND_TURB";
/// How wind changes with height; 0: with the root of the height, up to a height.
const WIND_PROFILE: &str = "SIM_WIND_T";
const WIND_PROFILE_HEIGHT: &str = "SIM_WIND_T_ALT";
const GPS_DISABLED: &str = "SIM_GPS_DISABLE";
const SATELLITES: &str = "SIM_GPS_NUMSATS";
const GLITCH_NORTH: &str = "SIM_GPS_GLITCH_X";
const GLITCH_EAST: &str = "SIM_GPS_GLITCH_Y";
/// Which motor: 1 is the second one where they are counted from 0, and the first one where it is a mask of bits.
const MOTOR: &str = "SIM_ENGINE_FAIL";
const THRUST: &str = "SIM_ENGINE_MUL";
const COMPASS: &str = "SIM_MAG1_OFS_X";
const BAROMETER: &str = "SIM_BARO_DRIFT";
const BATTERY: &str = "SIM_BATT_VOLTAGE";

/// Values that parameters go back to. What is not here stays: a battery does not mend.
const USUAL: [(&str, f64); 7] = [
    (GPS_DISABLED, 0.0),
    (SATELLITES, USUAL_SATELLITES),
    (GLITCH_NORTH, 0.0),
    (GLITCH_EAST, 0.0),
    (THRUST, 1.0),
    (COMPASS, USUAL_COMPASS_MGAUSS),
    (BAROMETER, 0.0),
];
const USUAL_SATELLITES: f64 = 10.0;
/// As few are in view at the inner border of a jammed zone's edge.
const FEWEST_SATELLITES: f64 = 5.0;
const USUAL_COMPASS_MGAUSS: f64 = 5.0;
/// Standard deviation of gusts in m/s for each `SIM_WIND_TURB`; the embedded simulator has it from how a vehicle of
/// the real one moves.
const GUST_PER_TURBULENCE: f64 = 0.35;
/// Below this the wind dies down towards the ground. Where it does not, an `ArduCopter` that has landed in 6 m/s goes on
/// leaning against it, and by more than 15 degrees its landing is never noticed.
const WIND_FULL_FROM_M: f64 = 5.0;
/// Steps of wind that are worth being told.
const WIND_STEP_M_S: f64 = 0.2;
const WIND_STEP_DEG: f64 = 2.0;

/// What the parameters of one vehicle should be.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Wishes(BTreeMap<&'static str, f64>);

impl Wishes {
    /// The weather, as far as simulators make it.
    pub fn weather(&mut self, weather: &Weather) {
        let rounded = |value: f64, step: f64| (value / step).round() * step;
        let all = [
            (WIND_SPEED, rounded(weather.wind.speed_m_s, WIND_STEP_M_S)),
            (WIND_FROM, rounded(weather.wind.from_deg, WIND_STEP_DEG)),
            (TURBULENCE, weather.gust_m_s / GUST_PER_TURBULENCE),
            (WIND_PROFILE, 0.0),
            (WIND_PROFILE_HEIGHT, WIND_FULL_FROM_M),
        ];
        self.0.extend(all);
    }

    pub fn jam(&mut self) {
        self.0.insert(GPS_DISABLED, 1.0);
    }

    /// So near to a zone where it fails, 0 to 1, some of the satellites are gone.
    pub fn lose_satellites(&mut self, nearness: f64) {
        let left = USUAL_SATELLITES - (USUAL_SATELLITES - FEWEST_SATELLITES) * nearness;
        self.0.insert(SATELLITES, left.round());
    }

    /// Satellite navigation shows a place that lies so far to the east and to the north.
    pub fn mislead(&mut self, [east_m, north_m]: [f64; 2], origin: LatLon) {
        let east = east_m / (METRES_PER_DEGREE * maths::cos(origin.lat_deg.to_radians()));
        self.0.insert(GLITCH_NORTH, north_m / METRES_PER_DEGREE);
        self.0.insert(GLITCH_EAST, east);
    }

    pub fn broken(&mut self, broken: &Broken, origin: LatLon) {
        match broken.kind {
            FaultKind::Motor => {
                self.0.insert(MOTOR, 1.0);
                self.0.insert(THRUST, broken.to);
            }
            FaultKind::Battery => {
                if let Some(voltage_v) = broken.held.last() {
                    self.0.insert(BATTERY, voltage_v * broken.to);
                }
            }
            FaultKind::Gps => self.jam(),
            FaultKind::GpsGlitch => self.mislead([0.0, broken.to], origin),
            FaultKind::Compass => {
                let offset = USUAL_COMPASS_MGAUSS + broken.to;
                self.0.insert(COMPASS, offset);
            }
            FaultKind::Barometer => {
                self.0.insert(BAROMETER, broken.to);
            }
            FaultKind::SensorStuck | FaultKind::SensorDrift | FaultKind::Link => {}
        }
    }
}

/// What has been demanded of all vehicles.
#[derive(Debug, Clone, Default)]
pub(crate) struct Demands {
    wished: BTreeMap<VehicleId, Wishes>,
    radio: BTreeMap<VehicleId, RadioFault>,
    new: Vec<Demand>,
}

impl Demands {
    /// A vehicle should be like this now; what has changed becomes a demand.
    pub fn wish(&mut self, vehicle: VehicleId, wishes: Wishes) {
        let old = self.wished.remove(&vehicle).unwrap_or_default().0;
        let usual = |name: &str| USUAL.iter().find(|(usual, _)| *usual == name);
        let over = old
            .keys()
            .filter(|name| !wishes.0.contains_key(*name))
            .filter_map(|name| usual(name).copied());
        let changed = wishes
            .0
            .iter()
            .map(|(name, value)| (*name, *value))
            .filter(|(name, value)| old.get(name) != Some(value));
        let demands = changed.chain(over).map(|(name, value)| Demand {
            vehicle,
            want: Want::Parameter { name, value },
        });
        self.new.extend(demands);
        self.wished.insert(vehicle, wishes);
    }

    /// The state that a vehicle's radio should have now.
    pub fn radio(&mut self, vehicle: VehicleId, fault: RadioFault) {
        let known = self.radio.get(&vehicle).copied().unwrap_or_default();
        if known.differs(fault) {
            self.radio.insert(vehicle, fault);
            let want = Want::Radio(fault);
            self.new.push(Demand { vehicle, want });
        }
    }

    /// What has been demanded since this was asked last.
    pub fn take(&mut self) -> Vec<Demand> {
        std::mem::take(&mut self.new)
    }
}
