//! `[sim]` and `[weather]`: the site, the time limit and the weather.

use std::time::Duration;

use crate::geo::LatLon;
use crate::mission::Origin;
use crate::mission::format::{FileTable, LONGEST_S, number, seconds, table as table_of, word};
use crate::mission::weather::{Light, Weather, Wind};

/// The site and the time limit.
pub(super) struct SiteSection {
    pub time_limit: Duration,
    pub origin: Origin,
}

pub(super) fn site(table: &mut FileTable<'_>) -> Option<SiteSection> {
    let limit = seconds(10.0, LONGEST_S);
    let time_limit = table.need("time_limit", limit, "maximum mission time");
    let origin = table.need("origin", table_of(origin), "position of `[0, 0]`");
    table.draft().time_limit = time_limit;
    Some(SiteSection {
        time_limit: time_limit?,
        origin: origin?,
    })
}

fn origin(table: &mut FileTable<'_>) -> Option<Origin> {
    let lat = table.need("lat", number(-85.0, 85.0, "degrees"), "latitude");
    let lon = table.need("lon", number(-180.0, 180.0, "degrees"), "longitude");
    let altitude_amsl_m = table.need("alt", number(-500.0, 9000.0, "m"), "height above sea level");
    let heading = number(0.0, 360.0, "degrees");
    let heading_deg = table.or("heading", heading, 0.0, "heading of parked vehicles");
    Some(Origin {
        at: LatLon::new(lat?, lon?),
        altitude_amsl_m: altitude_amsl_m?,
        heading_deg,
    })
}

pub(super) fn weather(table: &mut FileTable<'_>) -> Option<Weather> {
    let calm = Weather::CALM;
    let wind = table.may("wind", table_of(wind), "mean wind (default calm)");
    let gust_m_s = table.or(
        "gust",
        number(0.0, 20.0, "m/s"),
        calm.gust_m_s,
        "variation of the wind about its mean (standard deviation)",
    );
    let temperature = number(-40.0, 60.0, "degrees Celsius");
    let temperature_c = table.or("temp_c", temperature, calm.temperature_c, "air temperature");
    let light = table.or(
        "light",
        word(&Light::WORDS),
        calm.light,
        "light for the cameras; see the sensors",
    );
    Some(Weather {
        wind: wind.unwrap_or(calm.wind),
        gust_m_s,
        temperature_c,
        light,
    })
}

fn wind(table: &mut FileTable<'_>) -> Option<Wind> {
    let speed_m_s = table.need(
        "speed",
        number(0.0, 60.0, "m/s"),
        "wind speed; below a height of 5 m it falls with the square root of the height",
    );
    let from_deg = table.need(
        "dir",
        number(0.0, 360.0, "degrees"),
        "direction from which the wind blows",
    );
    Some(Wind {
        speed_m_s: speed_m_s?,
        from_deg: from_deg?,
    })
}
