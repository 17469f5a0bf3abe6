//! Maths functions with the same results, to the last bit, on every machine.
//!
//! `+ - * /` and the square root give the same results everywhere; the other functions of `std`
//! come from the platform's library and differ between machines. Scores must not depend on the
//! machine, so the whole workspace uses these functions: those of musl, ported to Rust ([`libm`]).
//! Clippy forbids the corresponding functions of `std` (`.clippy.toml`).

/// Sine of an angle in radians.
#[must_use]
pub fn sin(angle_rad: f64) -> f64 {
    libm::sin(angle_rad)
}

/// Cosine of an angle in radians.
#[must_use]
pub fn cos(angle_rad: f64) -> f64 {
    libm::cos(angle_rad)
}

/// Sine and cosine of an angle in radians.
#[must_use]
pub fn sin_cos(angle_rad: f64) -> (f64, f64) {
    libm::sincos(angle_rad)
}

/// Tangent of an angle in radians.
#[must_use]
pub fn tan(angle_rad: f64) -> f64 {
    libm::tan(angle_rad)
}

/// Arc sine, in radians.
#[must_use]
pub fn asin(sine: f64) -> f64 {
    libm::asin(sine)
}

/// Arc cosine, in radians.
#[must_use]
pub fn acos(cosine: f64) -> f64 {
    libm::acos(cosine)
}

/// Arc tangent, in radians.
#[must_use]
pub fn atan(tangent: f64) -> f64 {
    libm::atan(tangent)
}

/// The angle of the point (`x`, `y`) from the x axis, in radians.
#[must_use]
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// Hyperbolic cosine of `x`.
#[must_use]
pub fn cosh(x: f64) -> f64 {
    libm::cosh(x)
}

/// Hyperbolic sine of `x`.
#[must_use]
pub fn sinh(x: f64) -> f64 {
    libm::sinh(x)
}

/// e to the power of `x`.
#[must_use]
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// [`exp`] in single precision.
#[must_use]
pub fn exp_f32(x: f32) -> f32 {
    libm::expf(x)
}

/// 2 to the power of `x`.
#[must_use]
pub fn exp2(x: f64) -> f64 {
    libm::exp2(x)
}

/// Natural logarithm of `x`.
#[must_use]
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// Logarithm to base 2.
#[must_use]
pub fn log2(x: f64) -> f64 {
    libm::log2(x)
}

/// Logarithm to base 10.
#[must_use]
pub fn log10(x: f64) -> f64 {
    libm::log10(x)
}

/// `base` to the power of `exponent`.
#[must_use]
pub fn powf(base: f64, exponent: f64) -> f64 {
    libm::pow(base, exponent)
}

/// `base` to an integer power, by squaring: the order of the products is fixed.
#[inline]
#[must_use]
pub fn powi(base: f64, exponent: i32) -> f64 {
    let (mut square, mut left, mut product) = (base, exponent.unsigned_abs(), 1.0);
    while left > 0 {
        if left & 1 == 1 {
            product *= square;
        }
        square *= square;
        left >>= 1;
    }
    if exponent < 0 { 1.0 / product } else { product }
}

/// Cube root of `x`.
#[must_use]
pub fn cbrt(x: f64) -> f64 {
    libm::cbrt(x)
}

/// The length of the vector (`x`, `y`).
#[must_use]
pub fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}

/// [`hypot`] in single precision.
#[must_use]
pub fn hypot_f32(x: f32, y: f32) -> f32 {
    libm::hypotf(x, y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bits_are_these() {
        let x = 0.732_421_875;
        for (value, bits) in [
            (sin(x), 0x3fe5_65c3_a777_bda0),
            (cos(x), 0x3fe7_cb38_59d2_7dce),
            (tan(x), 0x3fec_c6f8_b333_83ae),
            (asin(x), 0x3fea_4cc7_2702_bd91),
            (acos(x), 0x3fe7_f72f_8185_9c9f),
            (atan(x), 0x3fe4_3a9e_f04c_f58d),
            (atan2(x, 1.1), 0x3fe2_cc37_5add_6441),
            (cosh(x), 0x3ff4_7ca1_d768_1f36),
            (sinh(x), 0x3fe9_9703_f437_af5d),
            (exp(x), 0x4000_a411_e8c1_fb72),
            (exp2(x), 0x3ffa_9533_3beb_0b7e),
            (ln(x), 0xbfd3_edf4_63c1_683e),
            (log2(x), 0xbfdc_c090_8e19_b7bd),
            (log10(x), 0xbfc1_4f80_6253_c3ed),
            (powf(x, 1.2), 0x3fe6_05b8_59a9_b52d),
            (cbrt(x), 0x3fec_d851_5b56_ceb4),
            (hypot(x, 1.1), 0x3ff5_24fc_bec8_f580),
        ] {
            assert_eq!(value.to_bits(), bits, "{value}");
        }
    }

    #[test]
    fn whole_powers_are_products() {
        assert_eq!(powi(3.0, 4).to_bits(), 81.0f64.to_bits());
        assert_eq!(powi(2.0, -3).to_bits(), 0.125f64.to_bits());
        assert_eq!(powi(7.0, 0).to_bits(), 1.0f64.to_bits());
        let x = 1.1;
        assert_eq!(powi(x, 3).to_bits(), (x * (x * x)).to_bits());
    }
}
