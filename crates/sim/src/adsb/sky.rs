//! The simulated aircraft: they fly straight, and are replaced when they leave the radius or reach the ground.

use glam::DVec3;
use mavlink::dialects::ardupilotmega::{
    ADSB_VEHICLE_DATA, AdsbAltitudeType, AdsbEmitterType, AdsbFlags,
};
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;
use sortie_geo::maths;

use super::EVERY_STEPS;
use crate::kinematics::STEP_S;
use crate::parameters::Parameters;
use crate::place::LocalDatum;

/// SITL switches the aircraft off if there are to be this many or more.
const TOO_MANY: usize = 200;
/// Makes the seed of the sky differ from that of the wind.
const SALT: u64 = 0x4144_5342;
/// Mean and standard deviation of a velocity component in m/s, near the origin and farther away.
const NEAR_M_S: [f64; 2] = [5.0, 20.0];
const FAR_M_S: [f64; 2] = [15.0, 60.0];
const FAR_M: f64 = 500.0;
/// Mean and standard deviation of the vertical speed, downwards, in m/s.
const SINK_M_S: [f64; 2] = [-3.0, 3.0];
/// The time after which a stationary object is replaced, in seconds.
const STANDS_FOR_S: f64 = 3600.0;
/// The kinds of emitters, by number. From the 17th on they keep their height, and the last one is
/// stationary.
const EMITTERS: [AdsbEmitterType; 20] = [
    AdsbEmitterType::ADSB_EMITTER_TYPE_NO_INFO,
    AdsbEmitterType::ADSB_EMITTER_TYPE_LIGHT,
    AdsbEmitterType::ADSB_EMITTER_TYPE_SMALL,
    AdsbEmitterType::ADSB_EMITTER_TYPE_LARGE,
    AdsbEmitterType::ADSB_EMITTER_TYPE_HIGH_VORTEX_LARGE,
    AdsbEmitterType::ADSB_EMITTER_TYPE_HEAVY,
    AdsbEmitterType::ADSB_EMITTER_TYPE_HIGHLY_MANUV,
    AdsbEmitterType::ADSB_EMITTER_TYPE_ROTOCRAFT,
    AdsbEmitterType::ADSB_EMITTER_TYPE_UNASSIGNED,
    AdsbEmitterType::ADSB_EMITTER_TYPE_GLIDER,
    AdsbEmitterType::ADSB_EMITTER_TYPE_LIGHTER_AIR,
    AdsbEmitterType::ADSB_EMITTER_TYPE_PARACHUTE,
    AdsbEmitterType::ADSB_EMITTER_TYPE_ULTRA_LIGHT,
    AdsbEmitterType::ADSB_EMITTER_TYPE_UNASSIGNED2,
    AdsbEmitterType::ADSB_EMITTER_TYPE_UAV,
    AdsbEmitterType::ADSB_EMITTER_TYPE_SPACE,
    AdsbEmitterType::ADSB_EMITTER_TYPE_UNASSGINED3,
    AdsbEmitterType::ADSB_EMITTER_TYPE_EMERGENCY_SURFACE,
    AdsbEmitterType::ADSB_EMITTER_TYPE_SERVICE_SURFACE,
    AdsbEmitterType::ADSB_EMITTER_TYPE_POINT_OBSTACLE,
];
const FIRST_LEVEL: usize = 17;
const STANDING: usize = 19;

/// The aircraft around one vehicle.
#[derive(Debug, Clone)]
pub(super) struct Sky {
    rng: ChaCha8Rng,
    flights: Vec<SimAircraft>,
}

#[derive(Debug, Clone)]
struct SimAircraft {
    icao: u32,
    /// Metres north, east and down from the vehicle's origin, and metres per second.
    position_m: DVec3,
    velocity_m_s: DVec3,
    /// The index in [`EMITTERS`].
    emitter: usize,
    age_s: f64,
}

impl Sky {
    /// A sky that depends only on the board id.
    pub(super) fn new(board_id: u64) -> Self {
        Self {
            rng: ChaCha8Rng::seed_from_u64(board_id ^ SALT),
            flights: Vec::new(),
        }
    }

    /// Moves all aircraft by one step of the sky.
    pub(super) fn step(&mut self, parameters: &Parameters, here_m: DVec3) {
        let wanted = parameters.value("SIM_ADSB_COUNT").max(0.0) as usize;
        let count = if wanted < TOO_MANY { wanted } else { 0 };
        let radius_m = parameters.value("SIM_ADSB_RADIUS").clamp(0.0, 1e6);
        let height_m = parameters.value("SIM_ADSB_ALT").abs().min(1e5);
        let rules = SkyRules { radius_m, height_m };
        if self.flights.len() != count {
            self.flights.clear();
            for _ in 0..count {
                let flight = self.spawn(rules, here_m);
                self.flights.push(flight);
            }
        }
        let step_s = STEP_S * EVERY_STEPS as f64;
        for at in 0..self.flights.len() {
            let flight = &mut self.flights[at];
            flight.position_m += flight.velocity_m_s * step_s;
            flight.age_s += step_s;
            let away_m = (flight.position_m - here_m).truncate().length();
            let stood = flight.emitter == STANDING && flight.age_s > STANDS_FOR_S;
            if flight.position_m.z > 0.0 || away_m > radius_m || stood {
                self.flights[at] = self.spawn(rules, here_m);
            }
        }
    }

    fn spawn(&mut self, rules: SkyRules, here_m: DVec3) -> SimAircraft {
        let icao = self.rng.random_range(0..10_000);
        let position_m = DVec3::new(
            here_m.x + self.normal([0.0, rules.radius_m]),
            here_m.y + self.normal([0.0, rules.radius_m]),
            -rules.height_m,
        );
        let emitter = self.rng.random_range(0..EMITTERS.len());
        let usual = if position_m.length() > FAR_M {
            FAR_M_S
        } else {
            NEAR_M_S
        };
        let velocity_m_s = if emitter == STANDING {
            DVec3::ZERO
        } else {
            let (north, east) = (self.normal(usual), self.normal(usual));
            let down = if emitter < FIRST_LEVEL {
                self.normal(SINK_M_S)
            } else {
                0.0
            };
            DVec3::new(north, east, down)
        };
        SimAircraft {
            icao,
            position_m,
            velocity_m_s,
            emitter,
            age_s: 0.0,
        }
    }

    fn normal(&mut self, [mean, deviation]: [f64; 2]) -> f64 {
        let (radius, angle): (f64, f64) = (self.rng.random(), self.rng.random());
        let length = (-2.0 * maths::ln(1.0 - radius)).sqrt();
        mean + deviation * length * maths::cos(std::f64::consts::TAU * angle)
    }

    /// The present report of each aircraft.
    pub(super) fn reports(&self, datum: &LocalDatum) -> Vec<ADSB_VEHICLE_DATA> {
        self.flights.iter().map(|it| it.report(datum)).collect()
    }
}

/// Where aircraft appear, from the parameters.
#[derive(Debug, Clone, Copy)]
struct SkyRules {
    radius_m: f64,
    height_m: f64,
}

impl SimAircraft {
    fn report(&self, datum: &LocalDatum) -> ADSB_VEHICLE_DATA {
        let at = datum.place_of(self.position_m).at;
        let velocity = self.velocity_m_s;
        let course = maths::atan2(velocity.y, velocity.x).to_degrees();
        let cm_s = |m_s: f64| m_s * 100.0;
        ADSB_VEHICLE_DATA {
            ICAO_address: self.icao,
            lat: (at.lat_deg * 1e7) as i32,
            lon: (at.lon_deg * 1e7) as i32,
            // Above the origin, although the message means the sea: as in SITL.
            altitude: (-self.position_m.z * 1000.0) as i32,
            heading: (course.rem_euclid(360.0) * 100.0) as u16,
            hor_velocity: cm_s(velocity.truncate().length()) as u16,
            ver_velocity: cm_s(-velocity.z) as i16,
            flags: AdsbFlags::all() - AdsbFlags::ADSB_FLAGS_SOURCE_UAT,
            squawk: 1200,
            altitude_type: AdsbAltitudeType::ADSB_ALTITUDE_TYPE_PRESSURE_QNH,
            callsign: format!("SIM{}", self.icao).as_str().into(),
            emitter_type: EMITTERS[self.emitter],
            tslc: 1,
        }
    }
}
