//! The description of a launch, and its check.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::{HangarRefusal, InstanceId};
use crate::geo::LatLon;
use crate::sim::{Airframe, SYSTEMS, Start};
use crate::sitl::{Recipe, SitlKind};

/// The valid speed-ups: below them, a boot takes an hour; above them, no machine keeps up.
const SPEEDUPS: std::ops::RangeInclusive<f64> = 0.01..=1000.0;
/// The valid altitudes: they include the whole surface of the earth, and are well within the range of messages.
const ALTITUDES_M: std::ops::RangeInclusive<f64> = -1000.0..=20_000.0;
/// The maximum length of a parameter's name, as in MAVLink.
const NAME_LEN: usize = 16;
/// Parameters that other fields of a launch set, with those fields.
const OTHERWISE: [(&str, &str); 3] = [
    ("SYSID_THISMAV", "system"),
    ("MAV_SYSID", "system"),
    ("SIM_SPEEDUP", "speedup"),
];
/// The maximum number of parameters, more than a vehicle has.
const MOST_PARAMETERS: usize = 2000;
const MODEL_LEN: usize = 64;

/// A SITL process to start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct Launch {
    /// The instance's number; the lowest free one by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub id: Option<InstanceId>,
    /// The kind of vehicle.
    #[serde(default)]
    pub kind: SitlKind,
    /// SITL's name for the model; by default, the model that suits the kind and the airframe.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub model: Option<String>,
    /// The content of a frame file for ArduPilot's SITL.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame: Option<serde_json::Value>,
    /// The position and heading of its pad.
    #[serde(default)]
    pub home: LaunchHome,
    /// The MAVLink system id, 1 to 254; by default the instance's number, or the lowest free one if that number is
    /// not available.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub system: Option<u8>,
    /// Simulated seconds per second once it is ready; until then, it runs faster if it can.
    #[serde(default = "real_time")]
    pub speedup: f64,
    /// Parameters to start with.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub parameters: BTreeMap<String, f64>,
    /// Ends the instance after this many seconds without a client; never by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub idle_s: Option<u32>,
}

fn real_time() -> f64 {
    1.0
}

impl Default for Launch {
    fn default() -> Self {
        Self {
            id: None,
            kind: SitlKind::default(),
            model: None,
            frame: None,
            home: LaunchHome::default(),
            system: None,
            speedup: real_time(),
            parameters: BTreeMap::new(),
            idle_s: None,
        }
    }
}

/// Where a vehicle stands when it is switched on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Home)]
pub struct LaunchHome {
    /// Latitude of the start, in degrees.
    pub lat_deg: f64,
    /// Longitude of the start, in degrees.
    pub lon_deg: f64,
    /// Metres above mean sea level.
    pub altitude_m: f64,
    /// Degrees clockwise from north.
    pub heading_deg: f64,
}

impl Default for LaunchHome {
    /// The model airfield near Canberra at which SITL starts by default.
    fn default() -> Self {
        Self {
            lat_deg: -35.363_262,
            lon_deg: 149.165_237,
            altitude_m: 584.0,
            heading_deg: 0.0,
        }
    }
}

impl From<LaunchHome> for Start {
    fn from(home: LaunchHome) -> Self {
        Self {
            at: LatLon::new(home.lat_deg, home.lon_deg),
            altitude_amsl_m: home.altitude_m,
            heading_deg: home.heading_deg,
        }
    }
}

impl From<Start> for LaunchHome {
    fn from(start: Start) -> Self {
        Self {
            lat_deg: start.at.lat_deg,
            lon_deg: start.at.lon_deg,
            altitude_m: start.altitude_amsl_m,
            heading_deg: start.heading_deg,
        }
    }
}

impl Launch {
    /// Checks that the instance can be started: with invalid input, SITL dies or hangs forever.
    ///
    /// # Errors
    /// The first fault.
    pub fn check(&self) -> Result<(), HangarRefusal> {
        let system = self.system.is_none_or(is_vehicle);
        require(system, || "a vehicle's system id is 1 to 254".to_owned())?;
        require(self.id != Some(0), || {
            "instances are numbered from 1".to_owned()
        })?;
        require(SPEEDUPS.contains(&self.speedup), || {
            let (least, most) = (SPEEDUPS.start(), SPEEDUPS.end());
            format!("the speedup is {least} to {most}, not {:?}", self.speedup)
        })?;
        self.home.check()?;
        self.check_parameters()?;
        self.check_model()
    }

    /// The recipe for SITL, with the instance's system id.
    pub(super) fn recipe(&self, system: u8) -> Recipe {
        Recipe {
            kind: self.kind,
            model: self.model.clone(),
            airframe: self.frame.as_ref().map(ToString::to_string),
            start: self.home.into(),
            system,
            speedup: self.speedup,
            parameters: self.parameters.clone(),
        }
    }

    fn check_parameters(&self) -> Result<(), HangarRefusal> {
        require(self.parameters.len() <= MOST_PARAMETERS, || {
            format!("there are more than {MOST_PARAMETERS} parameters")
        })?;
        for (name, value) in &self.parameters {
            let is_plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
            let is_name = (1..=NAME_LEN).contains(&name.len()) && name.chars().all(is_plain);
            require(is_name, || {
                format!(
                    "`{}` is not a parameter: a name is 1 to {NAME_LEN} letters, digits and _",
                    name.escape_default()
                )
            })?;
            let otherwise = OTHERWISE.iter().find(|(own, _)| own == name);
            require(otherwise.is_none(), || {
                let field = otherwise.map_or("", |(_, field)| field);
                format!("{name} is set by `{field}`")
            })?;
            // Values are sent as 32-bit floats; one that is not finite makes SITL exit.
            require((*value as f32).is_finite(), || {
                format!("{name} cannot be {value}: a vehicle cannot store this number")
            })?;
        }
        Ok(())
    }

    fn check_model(&self) -> Result<(), HangarRefusal> {
        if let Some(model) = &self.model {
            // SITL would read text after a colon as a file name or an address.
            let is_plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_' || c == '+';
            let is_name = (1..=MODEL_LEN).contains(&model.len())
                && model.chars().all(is_plain)
                && !model.starts_with('-');
            require(is_name, || {
                format!("`{}` is not a model of SITL", model.escape_default())
            })?;
        }
        let Some(frame) = &self.frame else {
            return Ok(());
        };
        require(self.kind == SitlKind::Copter, || {
            "a frame file is for a copter only".to_owned()
        })?;
        Airframe::from_json(&frame.to_string())
            .map(drop)
            .map_err(|error| HangarRefusal::Invalid(format!("the frame: {}", error.what)))
    }
}

impl LaunchHome {
    fn check(&self) -> Result<(), HangarRefusal> {
        let at = LatLon::new(self.lat_deg, self.lon_deg);
        require(at.is_valid(), || {
            "the home's latitude is -90 to 90 and its longitude -180 to 180 degrees".to_owned()
        })?;
        let is_high = ALTITUDES_M.contains(&self.altitude_m);
        require(is_high && self.heading_deg.is_finite(), || {
            "the home's altitude is -1000 to 20000 m, its heading a number of degrees".to_owned()
        })
    }
}

fn is_vehicle(system: u8) -> bool {
    (1..=SYSTEMS).contains(&usize::from(system))
}

fn require(is_right: bool, otherwise: impl FnOnce() -> String) -> Result<(), HangarRefusal> {
    if is_right {
        Ok(())
    } else {
        Err(HangarRefusal::Invalid(otherwise()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn launch(json: &str) -> Launch {
        serde_json::from_str(json).expect("it is a launch")
    }

    fn with_parameter(name: &str, value: f64) -> Launch {
        Launch {
            parameters: BTreeMap::from([(name.to_owned(), value)]),
            ..Launch::default()
        }
    }

    #[test]
    fn what_a_sitl_would_die_or_hang_of_is_refused_with_the_reason() {
        let speedup = |speedup| Launch {
            speedup,
            ..Launch::default()
        };
        for (launch, reason) in [
            (launch(r#"{"system": 0}"#), "system id is 1 to 254"),
            (launch(r#"{"system": 255}"#), "system id is 1 to 254"),
            (launch(r#"{"id": 0}"#), "numbered from 1"),
            (speedup(0.0), "speedup"),
            (speedup(-1.0), "speedup"),
            (speedup(1001.0), "speedup"),
            (speedup(f64::NAN), "speedup"),
            (speedup(f64::INFINITY), "speedup"),
            (
                launch(
                    r#"{"home": {"lat_deg": 91, "lon_deg": 0, "altitude_m": 0, "heading_deg": 0}}"#,
                ),
                "latitude",
            ),
            (
                launch(
                    r#"{"home": {"lat_deg": 0, "lon_deg": 0, "altitude_m": 1e9, "heading_deg": 0}}"#,
                ),
                "altitude",
            ),
            (with_parameter("WPNAV_SPEED", f64::NAN), "WPNAV_SPEED"),
            (with_parameter("WPNAV_SPEED", 1e300), "WPNAV_SPEED"),
            (with_parameter("", 1.0), "not a parameter"),
            (with_parameter("SIM_SPEEDUP", 1.0), "set by `speedup`"),
            (with_parameter("SEVENTEEN_LETTERS", 1.0), "not a parameter"),
            (with_parameter("A 1\nB", 1.0), "not a parameter"),
            (launch(r#"{"model": "quad:/etc/passwd"}"#), "not a model"),
            (launch(r#"{"model": "--wipe"}"#), "not a model"),
            (launch(r#"{"model": ""}"#), "not a model"),
            (launch(r#"{"frame": {"mass": "heavy"}}"#), "the frame"),
            (launch(r#"{"frame": {}, "kind": "plane"}"#), "copter only"),
        ] {
            let refusal = launch.check().expect_err(reason).to_string();
            assert!(refusal.contains(reason), "{refusal}");
        }
    }

    #[test]
    fn what_makes_sense_is_not() {
        for launch in [
            Launch::default(),
            launch(r#"{"system": 254, "speedup": 0.01, "model": "hexa-cwx"}"#),
            launch(r#"{"frame": {"mass": 2.5}}"#),
            with_parameter("SIXTEEN_LETTERS_", -1.5),
        ] {
            assert_eq!(
                launch.check().map_err(|refusal| refusal.to_string()),
                Ok(())
            );
        }
    }
}
