//! The content of the lines of the telemetry pane.

use std::time::Duration;

use super::ekf;
use crate::app::State;
use crate::text;
use crate::text::{Text, figure};
use crate::ui::theme::Role;
use crate::ui::widget::gauge::{Gauge, battery_role, link_role, reach_role};
use crate::ui::widget::leg;
use crate::vehicle::{LandedState, Vehicle};

/// The level of detail of a vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Detail {
    /// The values needed for flying.
    Pilot,
    /// Additional values for engineers.
    Engineer,
}

/// A line: its label, a gauge if the value has one, and the value.
pub struct Reading {
    pub label: &'static str,
    pub gauge: Option<Gauge>,
    pub parts: Vec<(Text, Role)>,
    pub need: Need,
}

/// How important a line is if not all lines fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Need {
    /// Always shown, such as the battery needed for the way home.
    Always,
    /// Shown as far as there is room.
    IfItFits,
    /// Left out first, because the table or the state line also shows it.
    Least,
}

impl Reading {
    fn new(label: &'static str, text: Text) -> Self {
        Self {
            label,
            gauge: None,
            parts: vec![(text, Role::Text)],
            need: Need::IfItFits,
        }
    }

    fn needed(self, need: Need) -> Self {
        Self { need, ..self }
    }

    fn with(self, gauge: Option<Gauge>) -> Self {
        Self { gauge, ..self }
    }

    fn is_empty(&self) -> bool {
        self.parts.iter().all(|(text, _)| text.is_empty())
    }
}

/// A vehicle's values, the most important first. The vehicle room shows all of them.
pub fn readings(vehicle: &Vehicle, state: &State, detail: Detail) -> Vec<Reading> {
    let heard = Gauge {
        share: f64::from(vehicle.link.percent()) / 100.0,
        mark: None,
        role: link_role(&vehicle.link),
    };
    let mut lines = vec![
        Reading {
            label: "telemetry-mode",
            gauge: None,
            parts: mode(vehicle),
            need: Need::Least,
        },
        Reading::new("telemetry-height", altitude(vehicle)).needed(Need::Least),
        Reading::new("telemetry-speed", speed(vehicle)).needed(Need::Least),
        Reading::new("telemetry-battery", battery(vehicle, detail)).with(charge(vehicle)),
        Reading::new("telemetry-return", way_home(vehicle))
            .with(way_home_share(vehicle, state.session().reserve_percent()))
            .needed(Need::Always),
        Reading::new("telemetry-link", link(vehicle, state)).with(Some(heard)),
        Reading::new("telemetry-home", home(vehicle)),
        Reading::new("telemetry-target", target(vehicle)),
        Reading::new("telemetry-wind", wind(vehicle)),
        Reading::new("telemetry-gps", gps(vehicle)),
        Reading::new("telemetry-ekf", ekf::text(vehicle)),
        Reading::new("telemetry-ground", ground(vehicle)),
        Reading::new("telemetry-plan", plan(vehicle)),
        Reading::new("telemetry-reboots", reboots(vehicle).into()),
    ];
    if detail == Detail::Engineer {
        lines.extend([
            Reading::new("telemetry-place", place(vehicle).into()),
            Reading::new("telemetry-attitude", attitude(vehicle)),
            Reading::new("telemetry-vibration", vibration(vehicle)),
            Reading::new("telemetry-rc", channels(vehicle).into()),
            Reading::new("telemetry-servos", pulses(&vehicle.servos_us).into()),
            Reading::new("telemetry-load", load(vehicle).into()),
            Reading::new("telemetry-firmware", firmware(vehicle).into()),
        ]);
    }
    lines.retain(|line| !line.is_empty());
    lines
}

/// The lines that fit into this many rows, in their order: the least important ones make room for
/// those that are always shown.
pub fn fitting(mut lines: Vec<Reading>, rows: usize) -> Vec<Reading> {
    while let Some(needed) = lines.iter().rposition(|line| line.need == Need::Always)
        && needed >= rows
    {
        let before = lines.iter().take(needed);
        let Some(least) = before.rev().position(|line| line.need == Need::Least) else {
            break;
        };
        lines.remove(needed - 1 - least);
    }
    lines.truncate(rows);
    lines
}

fn mode(vehicle: &Vehicle) -> Vec<(Text, Role)> {
    let Some(heartbeat) = vehicle.heartbeat else {
        return vec![(text!("telemetry-no-heartbeat"), Role::Warning)];
    };
    let armed = if heartbeat.armed {
        (text!("telemetry-armed"), Role::Armed)
    } else {
        (text!("telemetry-disarmed"), Role::Muted)
    };
    let mode = vehicle.name_of(heartbeat.mode).into();
    vec![
        (mode, Role::Text),
        armed,
        if vehicle.has_paused() {
            (text!("telemetry-paused"), Role::Warning)
        } else {
            (landed(vehicle), Role::Text)
        },
    ]
}

fn landed(vehicle: &Vehicle) -> Text {
    match vehicle.landed {
        _ if vehicle.is_on_surface() && vehicle.moves() => text!("landed-moving"),
        _ if vehicle.is_on_surface() => text!("landed-still"),
        LandedState::Undefined => text!("landed-unknown"),
        LandedState::OnGround => text!("landed-ground"),
        LandedState::InAir => text!("landed-air"),
        LandedState::Takeoff => text!("landed-takeoff"),
        LandedState::Landing => text!("landed-landing"),
    }
}

fn altitude(vehicle: &Vehicle) -> Text {
    let Some(global) = vehicle.global else {
        return Text::default();
    };
    let sea = figure(global.altitude_amsl_m, 0);
    if vehicle.is_on_surface() {
        return text!("telemetry-sea", sea = sea);
    }
    let climb = figure(-global.down_m_s, 1);
    let sign = if climb.starts_with('-') { "" } else { "+" };
    text!(
        "telemetry-altitudes",
        altitude = figure(global.altitude_m, 1),
        climb = format!("{sign}{climb}"),
        sea = sea
    )
}

fn speed(vehicle: &Vehicle) -> Text {
    let Some(speed) = vehicle.ground_speed_m_s() else {
        return Text::default();
    };
    let speed = figure(speed, 1);
    match vehicle.heading_deg() {
        Some(deg) => text!(
            "telemetry-speed-heading",
            speed = speed,
            heading = (deg.round() as i32).rem_euclid(360)
        ),
        None => text!("telemetry-speed-alone", speed = speed),
    }
}

/// The charge of the first battery, with a mark at the share needed for the way home.
fn charge(vehicle: &Vehicle) -> Option<Gauge> {
    let left = vehicle.battery()?.remaining_percent?;
    let needed = vehicle.way_home().map(|it| it.needed_percent / 100.0);
    Some(Gauge {
        share: f64::from(left) / 100.0,
        mark: needed,
        role: battery_role(left),
    })
}

fn battery(vehicle: &Vehicle, detail: Detail) -> Text {
    let packs = vehicle.batteries.iter().map(|pack| {
        let used = pack.consumed_mah.filter(|_| detail == Detail::Engineer);
        let parts = [
            pack.remaining_percent.map(|left| format!("{left} %")),
            pack.voltage_v
                .map(|volts| format!("{} V", figure(volts, 1))),
            pack.current_a.map(|amps| format!("{} A", figure(amps, 1))),
            used.map(|mah| format!("{} mAh", figure(mah, 0))),
        ];
        parts.into_iter().flatten().collect::<Vec<_>>().join("  ")
    });
    packs.collect::<Vec<_>>().join(" | ").into()
}

/// The share of the remaining charge that is needed for the way home.
fn way_home_share(vehicle: &Vehicle, reserve_percent: f64) -> Option<Gauge> {
    let way_home = vehicle.way_home()?;
    Some(Gauge {
        share: way_home.needed_percent / way_home.left_percent.max(1.0),
        mark: None,
        role: reach_role(way_home.reach(reserve_percent)),
    })
}

/// The charge needed for the way home in percent, and its flight time of the remaining one, both in `m:ss`. The row of
/// the battery shows the remaining charge.
fn way_home(vehicle: &Vehicle) -> Text {
    let clock = |time: Duration| format!("{}:{:02}", time.as_secs() / 60, time.as_secs() % 60);
    vehicle.way_home().map_or_else(Text::default, |way_home| {
        text!(
            "telemetry-way-home",
            needed = figure(way_home.needed_percent.ceil(), 0),
            time = clock(way_home.needed),
            lasts = clock(way_home.left)
        )
    })
}

fn home(vehicle: &Vehicle) -> Text {
    let (Some(global), Some(home)) = (vehicle.global, vehicle.home) else {
        return Text::default();
    };
    let bearing = global.at_point.bearing_deg(home.at_point);
    let distance = global.at_point.distance_m(home.at_point);
    if distance < 1.0 {
        return text!("telemetry-here");
    }
    text!(
        "telemetry-bearing",
        distance = figure(distance, 0),
        bearing = (bearing.round() as i32).rem_euclid(360)
    )
}

fn target(vehicle: &Vehicle) -> Text {
    let (Some(global), Some(target)) = (vehicle.global, vehicle.target) else {
        return Text::default();
    };
    let distance = target.at_point.map(|to| {
        let distance = global.at_point.distance_m(to);
        text!("telemetry-away", distance = figure(distance, 0))
    });
    let height_m = target.altitude_m.filter(|_| !vehicle.is_on_surface());
    let altitude =
        height_m.map(|altitude_m| text!("telemetry-at", altitude = figure(altitude_m, 0)));
    Text::joined("  ", [distance, altitude].into_iter().flatten().collect())
}

fn place(vehicle: &Vehicle) -> String {
    let point = vehicle.global.map(|global| global.at_point);
    point.map_or(String::new(), |point| {
        format!("{:.6} {:.6}", point.lat_deg, point.lon_deg)
    })
}

fn gps(vehicle: &Vehicle) -> Text {
    let Some(gps) = vehicle.gps else {
        return Text::default();
    };
    let fix = gps.fix.text();
    let satellites = gps
        .satellites
        .map(|count| text!("telemetry-satellites", count = count));
    let hdop = gps
        .hdop
        .map(|hdop| Text::from(format!("HDOP {}", figure(hdop, 1))));
    let parts = [Some(fix), satellites, hdop].into_iter().flatten();
    Text::joined("  ", parts.collect())
}

fn attitude(vehicle: &Vehicle) -> Text {
    vehicle.attitude.map_or_else(Text::default, |attitude| {
        // Adding zero turns a rounded -0 into +0, so that the sign does not flicker.
        let [roll, pitch] = [attitude.roll_deg, attitude.pitch_deg].map(|deg| deg.round() + 0.0);
        text!(
            "telemetry-roll-pitch",
            roll = format!("{roll:+.0}"),
            pitch = format!("{pitch:+.0}")
        )
    })
}

fn link(vehicle: &Vehicle, state: &State) -> Text {
    let link = &vehicle.link;
    let quality = if link.lost {
        let heard = link.last_heard.unwrap_or_default();
        let silent = state.now().saturating_sub(heard);
        text!("telemetry-link-lost", seconds = silent.as_secs())
    } else {
        // Fixed widths, so that the gauge does not change its length with every digit.
        format!("{:>3} %", link.percent()).into()
    };
    let trip = link.round_trip.map(|trip| {
        text!(
            "telemetry-round-trip",
            ms = format!("{:>3}", trip.as_millis())
        )
    });
    let parts = [Some(quality), trip].into_iter().flatten();
    Text::joined("  ", parts.collect())
}

fn reboots(vehicle: &Vehicle) -> String {
    let count = Some(vehicle.link.reboots).filter(|&count| count > 0);
    count.map_or(String::new(), |count| count.to_string())
}

fn wind(vehicle: &Vehicle) -> Text {
    let wind = vehicle.wind.filter(|wind| wind.speed_m_s >= 0.05);
    wind.map_or_else(Text::default, |wind| {
        text!(
            "telemetry-wind-from",
            speed = figure(wind.speed_m_s, 1),
            from = figure(wind.from_deg, 0)
        )
    })
}

fn vibration(vehicle: &Vehicle) -> Text {
    vehicle.vibration.map_or_else(Text::default, |vibration| {
        let [x, y, z] = vibration.level_m_s2.map(|level| figure(level, 0));
        let clipped = vibration.clipping.map_or("-".to_owned(), |counts| {
            counts.into_iter().fold(0, u32::saturating_add).to_string()
        });
        text!(
            "telemetry-vibrations",
            levels = format!("{x} {y} {z}"),
            clipped = clipped
        )
    })
}

fn ground(vehicle: &Vehicle) -> Text {
    let metres = vehicle.rangefinder_m;
    metres.map_or_else(Text::default, |m| {
        text!("telemetry-below", metres = figure(m, 1))
    })
}

fn plan(vehicle: &Vehicle) -> Text {
    if let Some(leg) = vehicle.plan_leg() {
        let unknown = || "-".to_owned();
        if vehicle.has_paused() {
            return text!(
                "telemetry-item-paused",
                item = leg.item,
                total = leg.last,
                way = leg::way(&leg).unwrap_or_else(unknown)
            );
        }
        return text!(
            "telemetry-item-times",
            item = leg.item,
            total = leg.last,
            way = leg::way(&leg).unwrap_or_else(unknown),
            end = leg::end(&leg).unwrap_or_else(unknown)
        );
    }
    match vehicle.plan.total {
        Some(total) if total > 0 => {
            text!("telemetry-item", item = vehicle.plan.current, total = total)
        }
        _ => Text::default(),
    }
}

fn channels(vehicle: &Vehicle) -> String {
    vehicle
        .rc
        .map_or(String::new(), |rc| pulses(&rc.channels_us))
}

/// The pulses of the channels in use among the first five, in microseconds.
fn pulses(pulses_us: &[u16]) -> String {
    let used = pulses_us.iter().take(5).filter(|&&pulse| pulse > 0);
    used.map(u16::to_string).collect::<Vec<_>>().join(" ")
}

fn load(vehicle: &Vehicle) -> String {
    vehicle.health.map_or(String::new(), |health| {
        format!("{} %", figure(health.load_percent, 0))
    })
}

/// The firmware, once its version is known: a name alone is not worth a row.
fn firmware(vehicle: &Vehicle) -> String {
    vehicle
        .version
        .map_or_else(String::new, |_| vehicle.firmware_name())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_way_home_takes_is_shown_however_few_rows_there_are() {
        let lines = || {
            [
                ("mode", Need::Least),
                ("speed", Need::Least),
                ("battery", Need::IfItFits),
                ("return", Need::Always),
                ("link", Need::IfItFits),
            ]
            .map(|(label, need)| Reading::new(label, Text::default()).needed(need))
        };
        for (rows, shown) in [
            (9, vec!["mode", "speed", "battery", "return", "link"]),
            (4, vec!["mode", "speed", "battery", "return"]),
            (3, vec!["mode", "battery", "return"]),
            (2, vec!["battery", "return"]),
            (1, vec!["battery"]),
        ] {
            let kept = fitting(lines().into(), rows);
            let labels: Vec<&str> = kept.iter().map(|line| line.label).collect();
            assert_eq!(labels, shown, "{rows}");
        }
    }
}
