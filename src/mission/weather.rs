//! The weather of a mission: from the file, changed by events during the flight.

use crate::geo::maths;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Wind {
    pub speed_m_s: f64,
    /// The direction it comes from, in degrees clockwise from north.
    pub from_deg: f64,
}

impl Wind {
    /// Its velocity east and north, in m/s.
    pub fn drift_m_s(self) -> [f64; 2] {
        let (sin, cos) = maths::sin_cos(self.from_deg.to_radians());
        [-self.speed_m_s * sin, -self.speed_m_s * cos]
    }

    /// The wind with a velocity east and north.
    pub fn of_drift([east_m_s, north_m_s]: [f64; 2]) -> Self {
        Self {
            speed_m_s: maths::hypot(east_m_s, north_m_s),
            from_deg: maths::atan2(-east_m_s, -north_m_s).to_degrees(),
        }
    }
}

/// The light conditions, which determine what cameras can see.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Light {
    Day,
    /// First or last light.
    Dawn,
    Night,
}

impl Light {
    /// The values by their names in files.
    pub const WORDS: [(&str, Self); 3] = [
        ("day", Self::Day),
        ("dawn", Self::Dawn),
        ("night", Self::Night),
    ];
}

/// The weather at one moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Weather {
    pub wind: Wind,
    /// The gusts: standard deviation of the wind about its mean, in m/s.
    pub gust_m_s: f64,
    pub temperature_c: f64,
    pub light: Light,
}

impl Weather {
    /// No wind, a mild day.
    pub const CALM: Self = Self {
        wind: Wind {
            speed_m_s: 0.0,
            from_deg: 0.0,
        },
        gust_m_s: 0.0,
        temperature_c: 20.0,
        light: Light::Day,
    };
}
