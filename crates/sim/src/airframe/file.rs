//! The frame file: `SIM_Frame`'s JSON.

use std::ops::RangeInclusive;

use glam::DVec3;
use serde_json::{Map, Value};
use thiserror::Error;

use super::{Figures, layout};
use sortie_geo::maths;

/// A fault in a frame file, with its position.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("line {line}, column {column}: {what}")]
pub struct AirframeError {
    /// The line of the file, counted from 1.
    pub line: usize,
    /// The column in that line, in characters, counted from 1.
    pub column: usize,
    /// The fault and the expected value.
    pub what: String,
}

/// A field that holds one number: its name, its valid range, and the figure it sets.
struct Number {
    name: &'static str,
    least: f64,
    most: f64,
    place: fn(&mut Figures) -> &mut f64,
}

/// All fields with one number. Their ranges cover everything that flies, from a toy to a crewed multirotor.
const NUMBERS: &[Number] = &[
    number("mass", 0.01, 10_000.0, |f| &mut f.mass_kg),
    number("diagonal_size", 0.02, 100.0, |f| &mut f.diagonal_m),
    number("refSpd", 0.1, 200.0, |f| &mut f.reference_speed_m_s),
    number("refAngle", 0.1, 85.0, |f| &mut f.reference_lean_deg),
    number("refVoltage", 0.1, 2000.0, |f| &mut f.reference_voltage_v),
    number("refCurrent", 0.01, 10_000.0, |f| &mut f.reference_current_a),
    number("refAlt", -500.0, 10_000.0, |f| &mut f.reference_altitude_m),
    number("maxVoltage", 0.1, 2000.0, |f| &mut f.full_voltage_v),
    number("battCapacityAh", 0.0, 100_000.0, |f| {
        &mut f.battery_capacity_ah
    }),
    number("refBatRes", 0.0, 10.0, |f| &mut f.battery_resistance_ohm),
    number("propExpo", 0.0, 1.0, |f| &mut f.expo),
    number("refRotRate", 0.0, 5000.0, |f| &mut f.rotation_rate_deg_s),
    number("hoverThrOut", 0.01, 0.99, |f| &mut f.hover_throttle),
    number("pwmMin", 500.0, 2500.0, |f| &mut f.pwm_us.0),
    number("pwmMax", 500.0, 2500.0, |f| &mut f.pwm_us.1),
    number("spin_min", 0.0, 1.0, |f| &mut f.spin.0),
    number("spin_max", 0.0, 1.0, |f| &mut f.spin.1),
    number("slew_max", 0.0, 1e6, |f| &mut f.slew_per_s),
    number("disc_area", 0.0, 1000.0, |f| &mut f.disc_area_m2),
    number("mdrag_coef", 0.0, 100.0, |f| &mut f.momentum_drag),
];

/// Fields with a special meaning; the temperature is ignored, as in `SIM_Frame`.
const OTHERS: [&str; 3] = ["num_motors", "moment_inertia", "refTempC"];

const fn number(
    name: &'static str,
    least: f64,
    most: f64,
    place: fn(&mut Figures) -> &mut f64,
) -> Number {
    Number {
        name,
        least,
        most,
        place,
    }
}

/// Reads the figures of a file, with warnings.
pub(super) fn read(text: &str) -> Result<(Figures, Vec<AirframeError>), AirframeError> {
    let file = AirframeFile::parse(text)?;
    let mut figures = Figures::default();
    for number in NUMBERS {
        if let Some(value) = file.number(number.name, number.least..=number.most)? {
            *(number.place)(&mut figures) = value;
        }
    }
    file.check_order(&figures)?;
    if let Some(inertia) = file.vector("moment_inertia")? {
        if inertia.min_element() < 0.0 || inertia.max_element() > 1e6 {
            return Err(file.wrong(
                "moment_inertia",
                "moments of inertia lie between 0 and 1e6 kg m²",
            ));
        }
        if inertia.min_element() > 0.0 {
            // Less than a thousandth of the value that the size suggests means a wrong unit.
            let least = figures.mass_kg * maths::powi(figures.diagonal_m, 2) * 1e-3;
            figures.inertia_kg_m2 = inertia.max(DVec3::splat(least));
        }
    }
    let count = match file.number("num_motors", 1.0..=12.0)? {
        None => 4,
        Some(count) => layout::COUNTS
            .into_iter()
            .find(|known| (*known as f64 - count).abs() < 1e-9)
            .ok_or_else(|| file.wrong("num_motors", "a frame has 4, 6, 8, 10 or 12 motors"))?,
    };
    figures.motors = layout::standard(count, figures.diagonal_m);
    file.place_motors(&mut figures)?;
    let warnings = file.unknown(count);
    Ok((figures, warnings))
}

/// The file as JSON, without its comments.
pub(super) fn json(text: &str) -> Result<Value, AirframeError> {
    serde_json::from_str(&without_comments(text)).map_err(|error| AirframeError {
        line: error.line(),
        column: error.column(),
        what: reason(&error),
    })
}

struct AirframeFile {
    /// The text with its comments blanked, so that positions do not change.
    text: String,
    fields: Map<String, Value>,
}

impl AirframeFile {
    fn parse(text: &str) -> Result<Self, AirframeError> {
        let Value::Object(fields) = json(text)? else {
            return Err(AirframeError {
                line: 1,
                column: 1,
                what: "a frame file is one JSON object: { \"mass\": 3.0, … }".to_owned(),
            });
        };
        Ok(Self {
            text: without_comments(text),
            fields,
        })
    }

    fn wrong(&self, name: &str, what: &str) -> AirframeError {
        let quoted = format!("\"{name}\"");
        let before = &self.text[..self.text.rfind(&quoted).unwrap_or(0)];
        AirframeError {
            line: before.matches('\n').count() + 1,
            column: before.chars().rev().take_while(|c| *c != '\n').count() + 1,
            what: format!("{name}: {what}"),
        }
    }

    fn number(
        &self,
        name: &str,
        allowed: RangeInclusive<f64>,
    ) -> Result<Option<f64>, AirframeError> {
        match self.fields.get(name) {
            None | Some(Value::Null) => Ok(None),
            Some(value) => {
                let number = value
                    .as_f64()
                    .ok_or_else(|| self.wrong(name, &format!("expected a number, not {value}")))?;
                if allowed.contains(&number) {
                    Ok(Some(number))
                } else {
                    let (least, most) = (allowed.start(), allowed.end());
                    Err(self.wrong(name, &format!("{number} is not between {least} and {most}")))
                }
            }
        }
    }

    fn vector(&self, name: &str) -> Result<Option<DVec3>, AirframeError> {
        let Some(value) = self.fields.get(name).filter(|value| !value.is_null()) else {
            return Ok(None);
        };
        let numbers = value.as_array().and_then(|parts| {
            let parts: Option<Vec<f64>> = parts.iter().map(Value::as_f64).collect();
            <[f64; 3]>::try_from(parts?).ok()
        });
        numbers
            .map(|three| Some(DVec3::from_array(three)))
            .ok_or_else(|| self.wrong(name, "expected three numbers, such as [0.1, 0.1, 0.2]"))
    }

    fn check_order(&self, figures: &Figures) -> Result<(), AirframeError> {
        if figures.pwm_us.1 - figures.pwm_us.0 < 100.0 {
            return Err(self.wrong("pwmMax", "must be at least 100 µs above pwmMin"));
        }
        if figures.spin.1 - figures.spin.0 < 0.05 {
            return Err(self.wrong("spin_max", "must be at least 0.05 above spin_min"));
        }
        let outflow_m_s = figures.outflow_m_s();
        if !(5.0..=500.0).contains(&outflow_m_s) {
            let what = format!(
                "refVoltage and refCurrent make {:.3} W to carry {} kg: the air under the rotors would move at \
                 {outflow_m_s:.1} m/s, and 5 to 500 are possible",
                figures.hover_power_w(),
                figures.mass_kg
            );
            return Err(self.wrong("refCurrent", &what));
        }
        Ok(())
    }

    /// Reads motors that differ from the plus frame in position or spin.
    fn place_motors(&self, figures: &mut Figures) -> Result<(), AirframeError> {
        for (place, motor) in figures.motors.iter_mut().enumerate() {
            let name = |what: &str| format!("motor{}_{what}", place + 1);
            let label = name("position");
            if let Some(position) = self.vector(&label)? {
                if position.length() > 100.0 {
                    return Err(self.wrong(&label, "a motor is at most 100 m from the centre"));
                }
                if position != DVec3::ZERO {
                    motor.position_m = position;
                }
            }
            let label = name("vector");
            if let Some(thrust) = self.vector(&label)? {
                if thrust.length() > 10.0 {
                    return Err(self.wrong(&label, "expected a direction of length 1"));
                }
                motor.thrust = thrust.try_normalize().unwrap_or(motor.thrust);
            }
            let label = name("yaw");
            if let Some(spin) = self.number(&label, -10.0..=10.0)?
                && spin != 0.0
            {
                motor.spin = spin;
            }
        }
        Ok(())
    }

    /// Warnings about fields that no simulator reads. `ArduPilot` ignores them silently.
    fn unknown(&self, motors: usize) -> Vec<AirframeError> {
        let known = |name: &str| {
            NUMBERS.iter().any(|number| number.name == name)
                || OTHERS.contains(&name)
                || (1..=12).any(|motor| {
                    ["position", "vector", "yaw"]
                        .iter()
                        .any(|what| format!("motor{motor}_{what}") == name)
                })
        };
        let beyond =
            |name: &str| (motors + 1..=12).any(|motor| name.starts_with(&format!("motor{motor}_")));
        let mut warnings = Vec::new();
        for name in self.fields.keys() {
            if !known(name) {
                warnings.push(self.wrong(name, "not a field of a frame, ignored"));
            } else if beyond(name) {
                let what = format!("the frame has {motors} motors, ignored");
                warnings.push(self.wrong(name, &what));
            }
        }
        warnings
    }
}

/// The parser's reason without the position, which is reported separately.
fn reason(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let reason = text.split(" at line ").next().unwrap_or(&text);
    format!("not JSON: {reason}")
}

/// Blanks comments: from a `#` outside a string to the end of the line.
fn without_comments(text: &str) -> String {
    let mut kept = String::with_capacity(text.len());
    let (mut quoted, mut escaped, mut comment) = (false, false, false);
    for c in text.chars() {
        comment = c != '\n' && (comment || (c == '#' && !quoted));
        kept.push(if comment { ' ' } else { c });
        if !comment {
            quoted = c != '\n' && (quoted != (c == '"' && !escaped));
            escaped = c == '\\' && !escaped;
        }
    }
    kept
}

#[cfg(test)]
pub(super) mod tests {
    use std::fmt::Write as _;

    use super::{NUMBERS, maths};

    /// The number of fields with a range.
    pub(in crate::airframe) const RANGES: usize = NUMBERS.len();

    /// A frame file with each field at a place in its range, 0 to 1. The fourth power of the place keeps most values
    /// near the default's size.
    pub(in crate::airframe) fn fields_at(parts: &[f64]) -> String {
        let mut text = String::new();
        for (number, part) in NUMBERS.iter().zip(parts) {
            let value = number.least + (number.most - number.least) * maths::powi(*part, 4);
            write!(text, "\"{}\": {value:?}, ", number.name).expect("a string takes it");
        }
        text
    }
}
