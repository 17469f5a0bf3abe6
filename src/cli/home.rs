//! The option `--home` of the commands that place simulated vehicles.

use std::str::FromStr;

use crate::geo::LatLon;
use crate::sim::Start;

/// Where the first simulated vehicle stands, written `LAT,LON,ALT,HDG`: degrees, metres above sea level, degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct StartPlace(pub Start);

impl FromStr for StartPlace {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let numbers: Result<Vec<f64>, _> =
            text.split(',').map(|part| part.trim().parse()).collect();
        let [lat, lon, altitude_amsl_m, heading_deg] = numbers
            .ok()
            .and_then(|numbers| <[f64; 4]>::try_from(numbers).ok())
            .ok_or("expected LAT,LON,ALT,HDG, such as 50.45,30.52,180,90")?;
        let at = LatLon::new(lat, lon);
        if !at.is_valid() {
            return Err("latitude is -90 to 90 and longitude -180 to 180".to_owned());
        }
        // The limits are wider than the range of heights on the earth's surface, and well within
        // the range of the messages.
        if !(-1000.0..=20_000.0).contains(&altitude_amsl_m) || !heading_deg.is_finite() {
            return Err(
                "the height above sea level is -1000 to 20000 m, the heading a number of degrees"
                    .to_owned(),
            );
        }
        Ok(Self(Start {
            at,
            altitude_amsl_m,
            heading_deg,
        }))
    }
}
