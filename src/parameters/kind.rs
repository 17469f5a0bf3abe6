//! The types of parameters, and the values that fit them.

use std::fmt;

use mavlink::dialects::ardupilotmega::MavParamType;
use strum::IntoStaticStr;

use super::{shown, written};
use crate::text;
use crate::text::Text;

/// The type that the vehicle stores a parameter in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "lowercase")]
pub enum ParameterType {
    Uint8,
    Int8,
    Uint16,
    Int16,
    Uint32,
    Int32,
    Uint64,
    Int64,
    /// 32 bits, floating point.
    #[strum(serialize = "float")]
    Real32,
    /// 64 bits, floating point.
    #[strum(serialize = "double")]
    Real64,
}

/// How a vehicle puts integers into the float of `PARAM_VALUE` and `PARAM_SET`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ParameterEncoding {
    /// Converted to a float, which has 24 significant bits: `ArduPilot`.
    #[default]
    Converted,
    /// By their bytes (`MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE`): PX4.
    Bytewise,
}

/// Why a value does not fit a parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ParameterUnfit {
    /// The value is infinite or not a number.
    NotFinite,
    /// It has a fraction, but the vehicle stores a whole number.
    NotWhole(ParameterType),
    /// The value is outside the range of the type.
    OutOfRange {
        kind: ParameterType,
        /// The minimum value of the type.
        least: f64,
        /// The maximum value of the type.
        greatest: f64,
    },
    /// The value is whole and in range, but `PARAM_SET` carries it as a float with only 24
    /// significant bits.
    Inexact {
        /// The nearest value that `PARAM_SET` can carry.
        nearest: f64,
    },
}

impl ParameterType {
    /// The name, such as `int16`.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Checks that a value fits a parameter of this type and its encoding, and returns it as it is sent.
    ///
    /// # Errors
    /// The value does not fit. `ArduPilot` itself does not check: it cuts off fractions and wraps or saturates values
    /// that are too large.
    pub fn check(self, value: f64, encoding: ParameterEncoding) -> Result<f64, ParameterUnfit> {
        if !value.is_finite() {
            return Err(ParameterUnfit::NotFinite);
        }
        let (least, greatest) = self.limits();
        if !(least..=greatest).contains(&value) {
            return Err(ParameterUnfit::OutOfRange {
                kind: self,
                least,
                greatest,
            });
        }
        let carried = f64::from(value as f32);
        if !self.is_whole() {
            return Ok(carried);
        }
        if value.fract() != 0.0 {
            return Err(ParameterUnfit::NotWhole(self));
        }
        if encoding == ParameterEncoding::Bytewise && self.fits_a_float_by_its_bytes() {
            return Ok(value);
        }
        if (carried - value).abs() > 0.0 {
            return Err(ParameterUnfit::Inexact { nearest: carried });
        }
        Ok(carried)
    }

    /// Whether it stores whole numbers only.
    pub fn is_whole(self) -> bool {
        !matches!(self, Self::Real32 | Self::Real64)
    }

    /// Whether all bytes of its numbers fit the four of a float.
    fn fits_a_float_by_its_bytes(self) -> bool {
        self.is_whole() && !matches!(self, Self::Uint64 | Self::Int64)
    }

    /// The minimum and the maximum value of the type.
    pub fn limits(self) -> (f64, f64) {
        match self {
            Self::Uint8 => (0.0, f64::from(u8::MAX)),
            Self::Int8 => (f64::from(i8::MIN), f64::from(i8::MAX)),
            Self::Uint16 => (0.0, f64::from(u16::MAX)),
            Self::Int16 => (f64::from(i16::MIN), f64::from(i16::MAX)),
            Self::Uint32 => (0.0, f64::from(u32::MAX)),
            Self::Int32 => (f64::from(i32::MIN), f64::from(i32::MAX)),
            Self::Uint64 => (0.0, u64::MAX as f64),
            Self::Int64 => (i64::MIN as f64, i64::MAX as f64),
            // A double is sent as a float, too.
            Self::Real32 | Self::Real64 => (f64::from(f32::MIN), f64::from(f32::MAX)),
        }
    }
}

impl ParameterUnfit {
    /// The reason in words, for a parameter of that name.
    pub fn text(&self, name: &str) -> Text {
        match self {
            Self::NotFinite => text!("parameters-not-finite", name = name),
            Self::NotWhole(kind) => {
                text!("parameters-not-whole", name = name, kind = kind.name())
            }
            Self::OutOfRange {
                kind,
                least,
                greatest,
            } => text!(
                "parameters-out-of-range",
                name = name,
                kind = kind.name(),
                least = shown(*least),
                greatest = shown(*greatest)
            ),
            Self::Inexact { nearest } => text!(
                "parameters-inexact",
                name = name,
                nearest = written(*nearest)
            ),
        }
    }
}

impl From<MavParamType> for ParameterType {
    fn from(wire: MavParamType) -> Self {
        match wire {
            MavParamType::MAV_PARAM_TYPE_UINT8 => Self::Uint8,
            MavParamType::MAV_PARAM_TYPE_INT8 => Self::Int8,
            MavParamType::MAV_PARAM_TYPE_UINT16 => Self::Uint16,
            MavParamType::MAV_PARAM_TYPE_INT16 => Self::Int16,
            MavParamType::MAV_PARAM_TYPE_UINT32 => Self::Uint32,
            MavParamType::MAV_PARAM_TYPE_INT32 => Self::Int32,
            MavParamType::MAV_PARAM_TYPE_UINT64 => Self::Uint64,
            MavParamType::MAV_PARAM_TYPE_INT64 => Self::Int64,
            MavParamType::MAV_PARAM_TYPE_REAL32 => Self::Real32,
            MavParamType::MAV_PARAM_TYPE_REAL64 => Self::Real64,
        }
    }
}

impl fmt::Display for ParameterType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_types_take_whole_numbers_of_their_range_only() {
        use ParameterType as T;
        let cases = [
            (T::Int8, 127.0, true),
            (T::Int8, 128.0, false),
            (T::Int8, -128.0, true),
            (T::Uint8, -1.0, false),
            (T::Uint8, 255.0, true),
            (T::Int16, 1500.7, false),
            (T::Int16, 32767.0, true),
            (T::Int16, 40000.0, false),
            (T::Int32, 16_777_216.0, true),
            (T::Int32, 2_147_483_648.0, false),
            (T::Int32, -0.0, true),
            (T::Real32, 1500.7, true),
            (T::Real32, 1e39, false),
        ];
        for (kind, value, fits) in cases {
            assert_eq!(
                kind.check(value, ParameterEncoding::Converted).is_ok(),
                fits,
                "{value} as {kind}"
            );
        }
    }

    #[test]
    fn what_is_no_number_is_refused_by_every_type() {
        for kind in [ParameterType::Int8, ParameterType::Real32] {
            for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                assert_eq!(
                    kind.check(value, ParameterEncoding::Converted),
                    Err(ParameterUnfit::NotFinite)
                );
            }
        }
    }

    #[test]
    fn a_whole_number_that_a_float_would_change_is_refused() {
        assert_eq!(
            ParameterType::Int32.check(16_777_217.0, ParameterEncoding::Converted),
            Err(ParameterUnfit::Inexact {
                nearest: 16_777_216.0
            })
        );
        let bytewise = |kind: ParameterType| kind.check(16_777_217.0, ParameterEncoding::Bytewise);
        assert_eq!(bytewise(ParameterType::Int32), Ok(16_777_217.0));
        assert!(bytewise(ParameterType::Int64).is_err());
    }
}
