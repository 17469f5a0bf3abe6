//! What the vehicle under the cursor says, the most needed lines first.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use super::swarm::since;
use crate::app::State;
use crate::app::state::{FlightView, Standing};
use crate::text;
use crate::text::{Text, figure};
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, below, put, severity_role, wrap};
use crate::vehicle::{EkfFlags, Grade, LandedState, Vehicle};

/// Columns of the labels.
const LABEL_WIDTH: usize = 9;
/// Alerts that are told here; the rest wait until these are over.
const MOST_ALERTS: usize = 3;

/// Rows that the pane would like to have.
pub fn height(state: &State, look: &Look, width: u16) -> u16 {
    let Some(vehicle) = state.session().under_cursor() else {
        return 1;
    };
    let alerts = alert_lines(vehicle, state, look, usize::from(width)).len();
    let lines = lines(vehicle, state);
    (1 + alerts + usize::from(vehicle.link.lost) + lines.len()) as u16
}

/// That what is shown of a vehicle is not of now, if its link is lost.
pub fn last_known(vehicle: &Vehicle, state: &State, look: &Look) -> Option<Line<'static>> {
    let link = vehicle.link;
    let silent = state
        .now()
        .saturating_sub(link.last_heard.unwrap_or_default());
    let text = text!("vehicle-last-known", seconds = silent.as_secs());
    link.lost
        .then(|| Line::styled(look.text(&text), look.style(Role::Danger)))
}

/// Draws as many lines as fit; a vehicle in trouble says so first, in full.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let Some(vehicle) = state.session().under_cursor() else {
        panel.titled(&panel.say("telemetry-title"), buffer);
        return;
    };
    let name = FlightView::name(vehicle);
    let title = panel.text(&text!(
        "telemetry-vehicle",
        vehicle = vehicle.id,
        name = name
    ));
    let mut inner = panel.titled(&title, buffer);
    let alerts = alert_lines(vehicle, state, panel.look, usize::from(inner.width));
    for line in alerts
        .into_iter()
        .chain(last_known(vehicle, state, panel.look))
    {
        put(buffer, inner, 0, &line);
        inner = below(inner, 1);
    }
    let lines = lines(vehicle, state).into_iter();
    let role = if vehicle.link.lost {
        Role::Muted
    } else {
        Role::Text
    };
    for (row, (label, text)) in lines.take(usize::from(inner.height)).enumerate() {
        let label = aligned(&panel.say(label), LABEL_WIDTH, false);
        let line = Line::from(vec![
            Span::styled(label, panel.style(Role::Muted)),
            Span::styled(panel.text(&text), panel.style(role)),
        ]);
        put(buffer, inner, row as u16, &line);
    }
}

/// What is wrong with it and since when, the worst first.
fn alert_lines(vehicle: &Vehicle, state: &State, look: &Look, width: usize) -> Vec<Line<'static>> {
    let session = state.session();
    let mut alerts: Vec<&Standing> = session.alarms().of(vehicle.id).collect();
    alerts.sort_by_key(|one| (session.alarms().is_calm(one), one.alert.severity));
    let told = alerts.into_iter().take(MOST_ALERTS);
    let lines = told.flat_map(|one| {
        let role = if session.alarms().is_calm(one) {
            Role::Muted
        } else {
            severity_role(one.alert.severity)
        };
        let text = since(one, session.time(one.since), look, usize::MAX);
        let lines = wrap(&text, width).into_iter();
        lines.map(move |line| Line::styled(line, look.style(role)))
    });
    lines.collect()
}

fn lines(vehicle: &Vehicle, state: &State) -> Vec<(&'static str, Text)> {
    let mut lines = vec![
        ("telemetry-mode", mode(vehicle)),
        ("telemetry-height", altitude(vehicle)),
        ("telemetry-speed", speed(vehicle)),
        ("telemetry-battery", battery(vehicle).into()),
        ("telemetry-return", way_home(vehicle)),
        ("telemetry-home", home(vehicle)),
        ("telemetry-target", target(vehicle)),
        ("telemetry-place", place(vehicle).into()),
        ("telemetry-gps", gps(vehicle)),
        ("telemetry-ekf", ekf(vehicle)),
        ("telemetry-attitude", attitude(vehicle)),
        ("telemetry-link", link(vehicle, state)),
        ("telemetry-reboots", reboots(vehicle).into()),
        ("telemetry-wind", wind(vehicle)),
        ("telemetry-vibration", vibration(vehicle)),
        ("telemetry-ground", ground(vehicle)),
        ("telemetry-plan", plan(vehicle)),
        ("telemetry-rc", channels(vehicle).into()),
        ("telemetry-servos", pulses(&vehicle.servos_us).into()),
        ("telemetry-load", load(vehicle).into()),
        ("telemetry-firmware", firmware(vehicle).into()),
    ];
    lines.retain(|(_, text)| !text.is_empty());
    lines
}

fn mode(vehicle: &Vehicle) -> Text {
    let Some(heartbeat) = vehicle.heartbeat else {
        return text!("telemetry-no-heartbeat");
    };
    let armed = if heartbeat.armed {
        text!("telemetry-armed")
    } else {
        text!("telemetry-disarmed")
    };
    let mode = heartbeat.mode.to_string().into();
    Text::joined("  ", vec![mode, armed, landed(vehicle.landed)])
}

fn landed(state: LandedState) -> Text {
    match state {
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
    let climb = figure(-global.down_m_s, 1);
    let sign = if climb.starts_with('-') { "" } else { "+" };
    text!(
        "telemetry-altitudes",
        altitude = figure(global.altitude_m, 1),
        climb = format!("{sign}{climb}"),
        sea = figure(global.altitude_amsl_m, 0)
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
            heading = figure(deg, 0)
        ),
        None => text!("telemetry-speed-alone", speed = speed),
    }
}

fn battery(vehicle: &Vehicle) -> String {
    let packs = vehicle.batteries.iter().map(|pack| {
        let parts = [
            pack.remaining_percent.map(|left| format!("{left} %")),
            pack.voltage_v
                .map(|volts| format!("{} V", figure(volts, 1))),
            pack.current_a.map(|amps| format!("{} A", figure(amps, 1))),
            pack.consumed_mah
                .map(|mah| format!("{} mAh", figure(mah, 0))),
        ];
        parts.into_iter().flatten().collect::<Vec<_>>().join("  ")
    });
    packs.collect::<Vec<_>>().join(" | ")
}

/// What the way home takes, and what there is: both in percent of the charge and in minutes.
fn way_home(vehicle: &Vehicle) -> Text {
    let clock = |time: Duration| format!("{}:{:02}", time.as_secs() / 60, time.as_secs() % 60);
    vehicle.endurance().map_or_else(Text::default, |endurance| {
        text!(
            "telemetry-way-home",
            needed = figure(endurance.needed_percent.ceil(), 0),
            time = clock(endurance.needed),
            left = figure(endurance.left_percent, 0),
            lasts = clock(endurance.left)
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
        bearing = figure(bearing, 0)
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
    let altitude = target
        .altitude_m
        .map(|altitude_m| text!("telemetry-at", altitude = figure(altitude_m, 0)));
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

fn ekf(vehicle: &Vehicle) -> Text {
    let Some(ekf) = vehicle.ekf else {
        return Text::default();
    };
    let position = EkfFlags::POSITION_HORIZONTAL_ABSOLUTE;
    // Beside a longer word there is room for the tenths that the limits are given in.
    let (state, decimals) = match Grade::of_ekf(&ekf) {
        _ if vehicle.link.lost => (text!("vehicle-grade-old"), 1),
        _ if !ekf.flags.has(position) => (text!("telemetry-ekf-lost"), 1),
        Grade::Good => (text!("telemetry-ekf-ok"), 2),
        Grade::Poor => (text!("vehicle-grade-poor"), 1),
        Grade::Bad => (text!("vehicle-grade-bad"), 1),
    };
    let ratios = [
        ekf.velocity_variance,
        ekf.position_horizontal_variance,
        ekf.compass_variance,
    ];
    let [velocity, position, compass] = ratios.map(|ratio| figure(ratio, decimals));
    let figures = format!("vel {velocity} pos {position} mag {compass}");
    Text::joined("  ", vec![state, figures.into()])
}

fn attitude(vehicle: &Vehicle) -> Text {
    vehicle.attitude.map_or_else(Text::default, |attitude| {
        // Adding zero turns a rounded -0 into +0, which does not flicker.
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
        format!("{} %", link.percent()).into()
    };
    let trip = link
        .round_trip
        .map(|trip| text!("telemetry-round-trip", ms = trip.as_millis() as u64));
    let parts = [Some(quality), trip].into_iter().flatten();
    Text::joined("  ", parts.collect())
}

/// How often it has rebooted, if it has.
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
        let clipped: u32 = vibration.clipping.iter().sum();
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

/// The first channels that carry something.
fn pulses(pulses_us: &[u16]) -> String {
    let used = pulses_us.iter().take(5).filter(|&&pulse| pulse > 0);
    used.map(u16::to_string).collect::<Vec<_>>().join(" ")
}

fn load(vehicle: &Vehicle) -> String {
    vehicle.health.map_or(String::new(), |health| {
        format!("{} %", figure(health.load_percent, 0))
    })
}

fn firmware(vehicle: &Vehicle) -> String {
    vehicle.version.map_or(String::new(), |version| {
        let (major, minor, patch) = version.firmware;
        format!("{major}.{minor}.{patch}")
    })
}
