//! A design as an airframe for both simulators: a SITL frame file or a running gear, and the matching parameters.

mod driving;

use serde_json::{Value, json};

use super::air::Air;
use super::design::{Design, Drive};
use super::figures::Figures;
use super::kind::DesignKind;
use super::pack::Pack;
use super::part::{Battery, Chemistry};
use crate::geo::maths;
use crate::sim::{self, GRAVITY_M_S2, RunningGear, SEA_LEVEL_DENSITY};
use crate::text::rounded;

/// The lean of the reference flight in the frame file, in degrees.
const REFERENCE_LEAN_DEG: f64 = 30.0;
/// The share of the squared term in the curve of thrust over command; the autopilot uses the same
/// value.
const EXPO: f64 = 0.65;
/// Rate gains of the default quad, and its control authority: thrust over weight per metre of diagonal.
const RATE_GAIN: f64 = 0.135;
const RATE_DAMPING: f64 = 0.0036;
const DEFAULT_AUTHORITY: f64 = 7.31;

/// A design as the simulators need it: what moves it, a model and parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Airframe {
    pub build: AirframeBuild,
    /// The model of SITL, as `--model` names it: of a drone, its motor layout.
    pub model: &'static str,
    pub parameters: Vec<(&'static str, f64)>,
}

/// What moves a vehicle in the simulators.
#[derive(Debug, Clone, PartialEq)]
pub enum AirframeBuild {
    /// A drone: the frame file (`SIM_Frame` JSON).
    Frame(Value),
    /// A ground robot or boat, for the embedded simulator. SITL has models of its own for them.
    Gear(RunningGear),
}

impl Airframe {
    /// The vehicle for the embedded simulator; `None` if the simulator refuses its frame file.
    pub fn simulated(self) -> Option<sim::Airframe> {
        let airframe = match self.build {
            AirframeBuild::Frame(frame) => sim::Airframe::from_json(&frame.to_string()).ok()?.0,
            AirframeBuild::Gear(gear) => sim::Airframe::driven(gear),
        };
        Some(airframe.with_parameters(self.parameters))
    }

    /// The frame file for SITL; `None` for a ground robot or boat.
    pub fn frame(&self) -> Option<&Value> {
        match &self.build {
            AirframeBuild::Frame(frame) => Some(frame),
            AirframeBuild::Gear(_) => None,
        }
    }
}

impl Design {
    /// The airframe; `None` while parts of the drive are missing.
    pub fn airframe(&self) -> Option<Airframe> {
        match self.kind() {
            DesignKind::Drone => self.flying_airframe(),
            DesignKind::Robot | DesignKind::Boat => self.driving_airframe(),
        }
    }

    fn flying_airframe(&self) -> Option<Airframe> {
        let drive = self.drive()?;
        let figures = self.figures(Air::default())?;
        let pack = Pack::of(&drive, Air::default().battery_c);
        Some(Airframe {
            build: AirframeBuild::Frame(frame(&drive, &figures, &pack)),
            model: model(drive.frame.motors),
            parameters: parameters(&drive, &figures, &pack),
        })
    }
}

fn model(motors: u8) -> &'static str {
    match motors {
        6 => "hexax",
        8 => "octa-cwx",
        _ => "x",
    }
}

/// The frame file: its reference flight is the computed hover, and its drag follows from the
/// frame's area.
fn frame(drive: &Drive<'_>, figures: &Figures, pack: &Pack) -> Value {
    let lean = REFERENCE_LEAN_DEG.to_radians();
    let weight_n = figures.mass_kg * GRAVITY_M_S2;
    let drag_m = 0.5 * SEA_LEVEL_DENSITY * drive.frame.drag_area_m2;
    json!({
        "mass": rounded(figures.mass_kg, 3),
        "diagonal_size": drive.frame.wheelbase_m,
        "refSpd": rounded((weight_n * maths::tan(lean) / drag_m).sqrt(), 2),
        "refAngle": REFERENCE_LEAN_DEG,
        "refVoltage": rounded(figures.hover_voltage_v, 2),
        "refCurrent": rounded(figures.hover_power_w / figures.hover_voltage_v, 3),
        "refAlt": 0.0,
        "refTempC": 25.0,
        "refBatRes": rounded(pack.resistance_ohm, 4),
        "maxVoltage": rounded(pack.full_v(), 2),
        "battCapacityAh": pack.capacity_ah,
        "propExpo": EXPO,
        "refRotRate": (60.0 / drive.frame.wheelbase_m).clamp(80.0, 400.0).round(),
        "hoverThrOut": rounded(figures.hover_throttle, 3),
        "pwmMin": 1000.0,
        "pwmMax": 2000.0,
        "spin_min": 0.15,
        "spin_max": 0.95,
        "slew_max": 150.0,
        "disc_area": rounded(drive.disc_area_m2(), 4),
        "mdrag_coef": 0.1,
        "num_motors": f64::from(drive.frame.motors),
    })
}

/// Frame class, battery limits of its chemistry, and gains for its control authority.
fn parameters(drive: &Drive<'_>, figures: &Figures, pack: &Pack) -> Vec<(&'static str, f64)> {
    let cells = f64::from(drive.battery.cells);
    let authority = figures.thrust_to_weight_full / drive.frame.wheelbase_m;
    let gain = (DEFAULT_AUTHORITY / authority).clamp(0.25, 2.0);
    let rate = rounded(RATE_GAIN * gain, 4);
    let damping = rounded(RATE_DAMPING * gain, 5);
    let mut all = vec![
        (
            "FRAME_CLASS",
            match drive.frame.motors {
                6 => 2.0,
                8 => 3.0,
                _ => 1.0,
            },
        ),
        // An X frame; for an octocopter the outline of its model, since motors are numbered clockwise.
        (
            "FRAME_TYPE",
            if drive.frame.motors == 8 { 14.0 } else { 1.0 },
        ),
    ];
    all.extend(battery_limits(drive.battery, pack));
    all.extend([
        ("BATT_FS_LOW_ACT", 2.0),
        ("BATT_FS_CRT_ACT", 1.0),
        ("MOT_BAT_VOLT_MAX", rounded(pack.full_v(), 2)),
        ("MOT_BAT_VOLT_MIN", rounded(3.3 * cells, 2)),
        ("MOT_THST_EXPO", EXPO),
        (
            "MOT_THST_HOVER",
            rounded((1.0 / figures.thrust_to_weight).clamp(0.125, 0.8), 3),
        ),
        (
            "WPNAV_SPEED",
            (70.0 * figures.top_speed_m_s).min(1000.0).round(),
        ),
        // In hundredths of a degree; autopilots accept no less than 10 degrees.
        (
            "ANGLE_MAX",
            (figures.most_lean_deg.max(10.0) * 100.0).floor(),
        ),
        ("ATC_RAT_PIT_P", rate),
        ("ATC_RAT_PIT_I", rate),
        ("ATC_RAT_PIT_D", damping),
        ("ATC_RAT_RLL_P", rate),
        ("ATC_RAT_RLL_I", rate),
        ("ATC_RAT_RLL_D", damping),
    ]);
    all
}

/// The battery's monitor and capacity, and its low and critical levels by its chemistry.
fn battery_limits(battery: &Battery, pack: &Pack) -> [(&'static str, f64); 6] {
    let cells = f64::from(battery.cells);
    let capacity_mah = pack.capacity_ah * 1000.0;
    let reserve_mah = capacity_mah * (1.0 - pack.usable);
    let (low_v, critical_v) = match battery.chemistry {
        Chemistry::Polymer => (3.5, 3.35),
        Chemistry::Ion => (3.3, 3.1),
    };
    [
        ("BATT_MONITOR", 4.0),
        ("BATT_CAPACITY", capacity_mah.round()),
        ("BATT_LOW_VOLT", rounded(low_v * cells, 2)),
        ("BATT_CRT_VOLT", rounded(critical_v * cells, 2)),
        ("BATT_LOW_MAH", (reserve_mah * 1.25).round()),
        ("BATT_CRT_MAH", (reserve_mah * 0.6).round()),
    ]
}
