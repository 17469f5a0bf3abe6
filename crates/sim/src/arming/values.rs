//! Checks of the parameters' own values before arming. Their results depend only on parameters, so they are computed
//! when one changes.

use super::reason::Reason;
use crate::kind::VehicleKind;
use crate::parameters::Parameters;

/// Frames of a multicopter (`FRAME_CLASS`): quad, hexa, octa, octa quad, Y6, tri, dodecahexa, deca.
const FRAME_CLASSES: [i32; 8] = [1, 2, 3, 4, 5, TRICOPTER, 12, 14];
const TRICOPTER: i32 = 7;
/// The largest number of an arrangement of motors (`FRAME_TYPE`).
const FRAME_TYPE_MAX: i32 = 19;
/// The `SERVOn_FUNCTION` of the first motor.
const MOTOR_1: i32 = 33;
const SERVOS: usize = 16;
/// The maximum of `MOT_SPIN_MIN`, the throttle at which thrust begins.
const SPIN_MIN_MAX: f64 = 0.3;
/// A calibrated stick reaches beyond these, in microseconds.
const STICK_MIN_US: f64 = 1300.0;
const STICK_MAX_US: f64 = 1700.0;
/// The voltage of the board, and the highest one that is in range.
const BOARD_V: f64 = 5.0;
const BOARD_MAX_V: f64 = 5.8;
/// The number of receiver channels that are checked.
const CHANNELS: usize = 8;

/// The reasons not to arm that parameters cause.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ValueChecks {
    /// The reason that concerns the motors; if there is one, no other check is made.
    pub(super) motors: Option<Reason>,
    /// The first wrong parameter of the controllers.
    pub(super) controllers: Option<Reason>,
    pub(super) sticks: Vec<Reason>,
    pub(super) servos: Vec<Reason>,
    pub(super) board: Option<Reason>,
    /// A source of the estimator that does not exist, for modes that need a position and for others.
    pub(super) sources: [Option<Reason>; 2],
}

impl ValueChecks {
    pub(super) fn read(all: &Parameters) -> Self {
        let flies = all.kind() == VehicleKind::Copter;
        let motors = flies.then(|| motors(all)).flatten();
        Self {
            motors: motors.map(|reason| format!("Motors: {reason}").into()),
            controllers: flies.then(|| controllers(all)).flatten(),
            sticks: sticks(all),
            servos: servos(all),
            board: board(all),
            sources: [true, false].map(|with_position| source(all, with_position)),
        }
    }
}

fn motors(all: &Parameters) -> Option<String> {
    let class = all.value("FRAME_CLASS") as i32;
    let arrangement = all.value("FRAME_TYPE") as i32;
    if !FRAME_CLASSES.contains(&class) || !(0..=FRAME_TYPE_MAX).contains(&arrangement) {
        return Some("Check frame class and type".to_owned());
    }
    let functions: Vec<i32> = (1..=SERVOS)
        .map(|servo| all.value(&format!("SERVO{servo}_FUNCTION")) as i32)
        .collect();
    // The autopilot itself assigns the outputs of further motors.
    let needed: &[i32] = if class == TRICOPTER {
        &[1, 2, 4]
    } else {
        &[1, 2, 3, 4]
    };
    if let Some(motor) = needed
        .iter()
        .find(|motor| !functions.contains(&(MOTOR_1 + **motor - 1)))
    {
        return Some(format!("no SERVOx_FUNCTION set to Motor{motor}"));
    }
    let spin_min = all.value("MOT_SPIN_MIN");
    let pulses = ["MOT_PWM_MIN", "MOT_PWM_MAX"].map(|name| all.value(name));
    if spin_min > SPIN_MIN_MAX {
        Some(format!("MOT_SPIN_MIN too high {spin_min:.2} > 0.3"))
    } else if all.value("MOT_SPIN_ARM") > spin_min {
        Some("MOT_SPIN_ARM > MOT_SPIN_MIN".to_owned())
    } else if pulses[0] < 1.0 || pulses[0] >= pulses[1] {
        Some("Check MOT_PWM_MIN and MOT_PWM_MAX".to_owned())
    } else {
        None
    }
}

/// Gains that must be positive: the position controller's, then the attitude controller's.
const POSITIVE: &[&str] = &[
    "PSC_POSXY_P",
    "PSC_POSZ_P",
    "PSC_VELZ_P",
    "PSC_ACCZ_P",
    "PSC_ACCZ_I",
    "ATC_ANG_PIT_P",
    "ATC_ANG_RLL_P",
    "ATC_ANG_YAW_P",
];
const RATES: [&str; 3] = ["ATC_RAT_RLL", "ATC_RAT_PIT", "ATC_RAT_YAW"];

fn controllers(all: &Parameters) -> Option<Reason> {
    let mut needs = POSITIVE
        .iter()
        .map(|name| ((*name).to_owned(), false))
        .collect::<Vec<_>>();
    for stem in RATES {
        // With a feed-forward, the other gains may be zero.
        let may_be_zero = all.value(&format!("{stem}_FF")) > 0.0;
        for (gain, may_be_zero) in [("P", may_be_zero), ("I", may_be_zero), ("D", true)] {
            needs.push((format!("{stem}_{gain}"), may_be_zero));
        }
    }
    needs.into_iter().find_map(|(name, may_be_zero)| {
        let value = all.value(&name);
        let wrong = value < 0.0 || (value == 0.0 && !may_be_zero);
        let sign = if may_be_zero { ">=" } else { ">" };
        wrong.then(|| format!("Bad parameter: {name} must be {sign} 0").into())
    })
}

/// The faults in the calibration of the remote control.
fn sticks(all: &Parameters) -> Vec<Reason> {
    let mut reasons = Vec::new();
    let of = |channel: usize, what: &str| all.value(&format!("RC{channel}_{what}"));
    let names: &[_] = match all.kind() {
        VehicleKind::Copter => &[
            ("Roll", "RCMAP_ROLL"),
            ("Pitch", "RCMAP_PITCH"),
            ("Throttle", "RCMAP_THROTTLE"),
            ("Yaw", "RCMAP_YAW"),
        ],
        VehicleKind::Rover(_) => &[("Steer", "RCMAP_ROLL"), ("Throttle", "RCMAP_THROTTLE")],
    };
    for (stick, map) in names {
        let channel = (all.value(map) as usize).clamp(1, SERVOS);
        if of(channel, "MIN") > STICK_MIN_US {
            reasons.push(format!("{stick} radio min too high").into());
        }
        if of(channel, "MAX") < STICK_MAX_US {
            reasons.push(format!("{stick} radio max too low").into());
        }
    }
    for channel in 1..=CHANNELS {
        reasons.extend(limits(all, "RC", channel));
    }
    reasons
}

fn servos(all: &Parameters) -> Vec<Reason> {
    (1..=SERVOS)
        .filter(|servo| all.value(&format!("SERVO{servo}_FUNCTION")) > 0.0)
        .flat_map(|servo| limits(all, "SERVO", servo))
        .collect()
}

/// The reason if the board's voltage is below what the parameters ask for.
fn board(all: &Parameters) -> Option<Reason> {
    let least = all.value("BRD_VBUS_MIN");
    let text = || format!("Board ({BOARD_V:.1}v) out of range {least:.1}-{BOARD_MAX_V:.1}v");
    (least > BOARD_V).then(|| text().into())
}

/// The reasons if the trim of a channel is beyond its limits.
fn limits(all: &Parameters, stem: &str, channel: usize) -> Vec<Reason> {
    let of = |what: &str| all.value(&format!("{stem}{channel}_{what}"));
    let mut reasons = Vec::new();
    let mut wrong = |limit: &str, how: &str| {
        let text = format!("{stem}{channel}_{limit} is {how} than {stem}{channel}_TRIM");
        reasons.push(text.into());
    };
    if of("MIN") > of("TRIM") {
        wrong("MIN", "greater");
    }
    if of("MAX") < of("TRIM") {
        wrong("MAX", "less");
    }
    reasons
}

/// The valid sources, by the ends of their parameters' names; the last is needed in every mode.
const SOURCES: [(&str, &[i32]); 5] = [
    ("POSXY", &[0, 3, 4, 6]),
    ("VELXY", &[0, 3, 5, 6, 7]),
    ("POSZ", &[0, 1, 2, 3, 4, 6]),
    ("VELZ", &[0, 3, 6]),
    ("YAW", &[0, 1, 2, 3, 6, 8]),
];
/// Sources whose sensors the vehicle lacks.
const BEACON: i32 = 4;
const OPTICAL_FLOW: i32 = 5;
const EXTERNAL: i32 = 6;
const WHEELS: i32 = 7;
const RANGEFINDER: i32 = 2;

/// The first source that does not exist, or else one whose sensor is missing.
fn source(all: &Parameters, with_position: bool) -> Option<Reason> {
    let used = if with_position {
        &SOURCES[..]
    } else {
        &SOURCES[4..]
    };
    let mut missing = Vec::new();
    for set in 1..=3 {
        for (what, known) in used {
            let source = all.value(&format!("EK3_SRC{set}_{what}")) as i32;
            if !known.contains(&source) {
                return Some(format!("AHRS: Check EK3_SRC{set}_{what}").into());
            }
            missing.push(match (*what, source) {
                ("POSZ", RANGEFINDER) => Some("RangeFinder"),
                ("YAW", _) if source != EXTERNAL => None,
                (_, BEACON) => Some("Beacon"),
                (_, OPTICAL_FLOW) => Some("OpticalFlow"),
                (_, EXTERNAL) => Some("VisualOdom"),
                (_, WHEELS) => Some("WheelEncoder"),
                _ => None,
            });
        }
    }
    // In the order in which the estimator looks for them.
    [
        "Beacon",
        "OpticalFlow",
        "RangeFinder",
        "VisualOdom",
        "WheelEncoder",
    ]
    .into_iter()
    .find(|sensor| missing.contains(&Some(*sensor)))
    .map(|sensor| format!("AHRS: EK3 sources require {sensor}").into())
}
