//! Demands of threats on the vehicles' simulators and links.
//!
//! Wind and faults are `SIM_*` parameters with the names of `ArduCopter` 4.6, which the embedded simulator has as well.
//! The code that carries a demand out translates it for other versions. A parameter returns to its usual value once no
//! threat sets it.

use std::collections::BTreeMap;

use super::fault::{Broken, FaultKind};
use crate::geo::maths;
use crate::geo::{LatLon, METRES_PER_DEGREE};
use crate::mission::weather::Wind;
use crate::session::{RadioFault, Want};
use crate::vehicle::VehicleId;

/// A change to make to one vehicle, its simulator or its link, without a notice.
#[derive(Debug, Clone, PartialEq)]
pub struct Demand {
    pub vehicle: VehicleId,
    /// The change to the vehicle, its simulator or its link.
    pub want: Want,
}

const WIND_SPEED: &str = "SIM_WIND_SPD";
const WIND_FROM: &str = "SIM_WIND_DIR";
const TURBULENCE: &str = "SIM_WIND_TURB";
/// The parameter of the wind profile; with 0 the wind grows with the square root of the height, up to
/// [`WIND_FULL_FROM_M`].
const WIND_PROFILE: &str = "SIM_WIND_T";
const WIND_PROFILE_HEIGHT: &str = "SIM_WIND_T_ALT";
const GPS_DISABLED: &str = "SIM_GPS_DISABLE";
const SATELLITES: &str = "SIM_GPS_NUMSATS";
const GLITCH_NORTH: &str = "SIM_GPS_GLITCH_X";
const GLITCH_EAST: &str = "SIM_GPS_GLITCH_Y";
/// Which motor fails: 1 is the second motor in versions that count from 0, and the first one in versions with a bit
/// mask.
const MOTOR: &str = "SIM_ENGINE_FAIL";
const THRUST: &str = "SIM_ENGINE_MUL";
const COMPASS: &str = "SIM_MAG1_OFS_X";
const BAROMETER: &str = "SIM_BARO_DRIFT";
const BATTERY: &str = "SIM_BATT_VOLTAGE";

/// The usual values that parameters return to. A battery parameter is not among them: a battery does not recover.
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
/// The number of satellites in view at the inner border of a jammed zone's edge.
const FEWEST_SATELLITES: f64 = 5.0;
const USUAL_COMPASS_MGAUSS: f64 = 5.0;
/// The height below which the wind weakens towards the ground, in metres. Without that, an `ArduCopter` that has landed
/// in 6 m/s keeps leaning against the wind, and with a lean of more than 15 degrees it never detects its landing.
pub const WIND_FULL_FROM_M: f64 = 5.0;
/// The smallest change of wind that is sent.
const WIND_STEP_M_S: f64 = 0.2;
const WIND_STEP_DEG: f64 = 2.0;

/// The parameter values that one vehicle should have.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Wishes(BTreeMap<&'static str, f64>);

impl Wishes {
    /// Sets the wind at this moment; the simulators add no gusts of their own.
    pub fn wind(&mut self, wind: Wind) {
        let rounded = |value: f64, step: f64| (value / step).round() * step;
        let all = [
            (WIND_SPEED, rounded(wind.speed_m_s, WIND_STEP_M_S)),
            (WIND_FROM, rounded(wind.from_deg, WIND_STEP_DEG)),
            (TURBULENCE, 0.0),
            (WIND_PROFILE, 0.0),
            (WIND_PROFILE_HEIGHT, WIND_FULL_FROM_M),
        ];
        self.0.extend(all);
    }

    pub fn jam(&mut self) {
        self.0.insert(GPS_DISABLED, 1.0);
    }

    /// Removes some of the satellites: the closer the vehicle is to a jammed zone (`nearness`, 0 to 1), the more.
    pub fn lose_satellites(&mut self, nearness: f64) {
        let left = USUAL_SATELLITES - (USUAL_SATELLITES - FEWEST_SATELLITES) * nearness;
        self.0.insert(SATELLITES, left.round());
    }

    /// Shifts the position of satellite navigation by this many metres east and north.
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

/// The demands made so far, for all vehicles.
#[derive(Debug, Clone, Default)]
pub(crate) struct Demands {
    wished: BTreeMap<VehicleId, Wishes>,
    radio: BTreeMap<VehicleId, RadioFault>,
    new: Vec<Demand>,
}

impl Demands {
    /// Sets the values that a vehicle should have now; each difference becomes a demand.
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

    /// Sets the state that a vehicle's radio should have now.
    pub fn radio(&mut self, vehicle: VehicleId, fault: RadioFault) {
        let known = self.radio.get(&vehicle).copied().unwrap_or_default();
        if known.differs(fault) {
            self.radio.insert(vehicle, fault);
            let want = Want::Radio(fault);
            self.new.push(Demand { vehicle, want });
        }
    }

    /// The demands since the last call.
    pub fn take(&mut self) -> Vec<Demand> {
        std::mem::take(&mut self.new)
    }
}
