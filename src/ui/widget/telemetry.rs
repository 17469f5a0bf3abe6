//! What the vehicle under the cursor says, the most needed lines first.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::app::state::{Session, State, alert};
use crate::ui::look::Look;
use crate::ui::theme::Role;
use crate::ui::widget::{below, put, severity_role, titled, wrap};
use crate::vehicle::{EkfFlags, Vehicle};

/// Columns of the labels.
const LABEL_WIDTH: usize = 9;

/// Rows that the pane would like to have.
pub fn height(state: &State, width: u16) -> u16 {
    let Some(vehicle) = state.session.under_cursor() else {
        return 1;
    };
    let alert = alert(vehicle, state.now);
    let alert = alert.map_or(0, |alert| {
        wrap(&alert.text.to_string(), usize::from(width)).len()
    });
    let lines = lines(vehicle, state).into_iter();
    let lines = lines.filter(|(_, text)| !text.is_empty()).count();
    (1 + alert + lines) as u16
}

/// Draws as many lines as fit; a vehicle in trouble says so first, in full.
pub fn draw(state: &State, look: &Look, area: Rect, buffer: &mut Buffer) {
    let Some(vehicle) = state.session.under_cursor() else {
        titled("telemetry", look, area, buffer);
        return;
    };
    let title = format!("vehicle {}  {}", vehicle.id, Session::name(vehicle));
    let mut inner = titled(&title, look, area, buffer);
    if let Some(alert) = alert(vehicle, state.now) {
        let style = look.style(severity_role(alert.severity));
        for line in wrap(&look.text(&alert.text), usize::from(inner.width)) {
            put(buffer, inner, 0, &Line::styled(line, style));
            inner = below(inner, 1);
        }
    }
    let lines = lines(vehicle, state).into_iter();
    for (row, (label, text)) in lines.filter(|(_, text)| !text.is_empty()).enumerate() {
        let line = Line::from(vec![
            Span::styled(format!("{label:LABEL_WIDTH$}"), look.style(Role::Muted)),
            Span::raw(text),
        ]);
        put(buffer, inner, row as u16, &line);
    }
}

fn lines(vehicle: &Vehicle, state: &State) -> Vec<(&'static str, String)> {
    vec![
        ("mode", mode(vehicle)),
        ("height", altitude(vehicle)),
        ("speed", speed(vehicle)),
        ("battery", battery(vehicle)),
        ("home", home(vehicle)),
        ("target", target(vehicle)),
        ("place", place(vehicle)),
        ("GPS", gps(vehicle)),
        ("EKF", ekf(vehicle)),
        ("attitude", attitude(vehicle)),
        ("link", link(vehicle, state)),
        ("wind", wind(vehicle)),
        ("vibe", vibration(vehicle)),
        (
            "ground",
            vehicle
                .rangefinder_m
                .map_or(String::new(), |m| format!("{m:.1} m below")),
        ),
        ("plan", plan(vehicle)),
        ("RC", channels(vehicle)),
        ("servos", pulses(&vehicle.servos_us)),
        ("load", load(vehicle)),
        ("firmware", firmware(vehicle)),
    ]
}

fn mode(vehicle: &Vehicle) -> String {
    let Some(heartbeat) = vehicle.heartbeat else {
        return "no heartbeat yet".to_owned();
    };
    let armed = if heartbeat.armed { "ARMED" } else { "disarmed" };
    format!("{}  {armed}  {}", heartbeat.mode, vehicle.landed)
}

fn altitude(vehicle: &Vehicle) -> String {
    let Some(global) = vehicle.global else {
        return String::new();
    };
    let climb = -global.down_m_s;
    // A climb of -0.0 would flicker.
    let climb = if climb.abs() < 0.05 { 0.0 } else { climb };
    format!(
        "{:.1} m  climb {climb:+.1}  sea {:.0} m",
        global.altitude_m, global.altitude_amsl_m
    )
}

fn speed(vehicle: &Vehicle) -> String {
    let Some(speed) = vehicle.ground_speed_m_s() else {
        return String::new();
    };
    let heading = vehicle.heading_deg();
    let heading = heading.map_or(String::new(), |deg| format!("  heading {deg:.0}°"));
    format!("{speed:.1} m/s{heading}")
}

fn battery(vehicle: &Vehicle) -> String {
    let packs = vehicle.batteries.iter().map(|pack| {
        let parts = [
            pack.remaining_percent.map(|left| format!("{left} %")),
            pack.voltage_v.map(|volts| format!("{volts:.1} V")),
            pack.current_a.map(|amps| format!("{amps:.1} A")),
            pack.consumed_mah.map(|mah| format!("{mah:.0} mAh")),
        ];
        parts.into_iter().flatten().collect::<Vec<_>>().join("  ")
    });
    packs.collect::<Vec<_>>().join(" | ")
}

fn home(vehicle: &Vehicle) -> String {
    let (Some(global), Some(home)) = (vehicle.global, vehicle.home) else {
        return String::new();
    };
    let bearing = global.at_point.bearing_deg(home.at_point);
    let distance = global.at_point.distance_m(home.at_point);
    if distance < 1.0 {
        return "here".to_owned();
    }
    format!("{distance:.0} m  bearing {bearing:.0}°")
}

fn target(vehicle: &Vehicle) -> String {
    let (Some(global), Some(target)) = (vehicle.global, vehicle.target) else {
        return String::new();
    };
    let distance = target
        .at_point
        .map(|to| format!("{:.0} m away", global.at_point.distance_m(to)));
    let altitude = target
        .altitude_m
        .map(|altitude| format!("at {altitude:.0} m"));
    let parts = [distance, altitude].into_iter().flatten();
    parts.collect::<Vec<_>>().join("  ")
}

fn place(vehicle: &Vehicle) -> String {
    let point = vehicle.global.map(|global| global.at_point);
    point.map_or(String::new(), |point| {
        format!("{:.6} {:.6}", point.lat_deg, point.lon_deg)
    })
}

fn gps(vehicle: &Vehicle) -> String {
    let Some(gps) = vehicle.gps else {
        return String::new();
    };
    let satellites = gps
        .satellites
        .map_or(String::new(), |count| format!("  {count} satellites"));
    let hdop = gps
        .hdop
        .map_or(String::new(), |hdop| format!("  HDOP {hdop:.1}"));
    format!("{}{satellites}{hdop}", gps.fix)
}

fn ekf(vehicle: &Vehicle) -> String {
    let Some(ekf) = vehicle.ekf else {
        return String::new();
    };
    let position = EkfFlags::POSITION_HORIZONTAL_ABSOLUTE;
    let state = if ekf.flags.has(position) {
        "ok"
    } else {
        "no position"
    };
    let ratios = [
        ekf.velocity_variance,
        ekf.position_horizontal_variance,
        ekf.compass_variance,
    ];
    let [velocity, position, compass] = ratios.map(|ratio| figure(ratio, 2));
    format!("{state}  vel {velocity} pos {position} mag {compass}")
}

fn attitude(vehicle: &Vehicle) -> String {
    let attitude = vehicle.attitude;
    attitude.map_or(String::new(), |attitude| {
        // Adding zero turns a rounded -0 into +0, which does not flicker.
        let [roll, pitch] = [attitude.roll_deg, attitude.pitch_deg].map(|deg| deg.round() + 0.0);
        format!("roll {roll:+.0}°  pitch {pitch:+.0}°")
    })
}

fn link(vehicle: &Vehicle, state: &State) -> String {
    let link = &vehicle.link;
    let quality = if link.lost {
        let silent = state
            .now
            .saturating_sub(link.last_heard.unwrap_or_default());
        format!("LOST {} s ago", silent.as_secs())
    } else {
        format!("{} %", link.percent())
    };
    let trip = link.round_trip;
    let trip = trip.map_or(String::new(), |trip| {
        format!("  round trip {} ms", trip.as_millis())
    });
    let reboots = match link.reboots {
        0 => String::new(),
        count => format!("  rebooted {count}x"),
    };
    format!("{quality}{trip}{reboots}")
}

fn wind(vehicle: &Vehicle) -> String {
    let wind = vehicle.wind.filter(|wind| wind.speed_m_s >= 0.05);
    wind.map_or(String::new(), |wind| {
        format!("{:.1} m/s from {:.0}°", wind.speed_m_s, wind.from_deg)
    })
}

fn vibration(vehicle: &Vehicle) -> String {
    let Some(vibration) = vehicle.vibration else {
        return String::new();
    };
    let [x, y, z] = vibration.level_m_s2.map(|level| figure(level, 0));
    let clipped: u32 = vibration.clipping.iter().sum();
    format!("{x} {y} {z} m/s²  clipped {clipped}")
}

fn plan(vehicle: &Vehicle) -> String {
    match vehicle.plan.total {
        Some(total) if total > 0 => format!("item {} of {total}", vehicle.plan.current),
        _ => String::new(),
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

/// A value with so many decimals, or a dash for what the vehicle cannot tell.
fn figure(value: f32, decimals: usize) -> String {
    if value.is_finite() {
        format!("{value:.decimals$}")
    } else {
        "-".to_owned()
    }
}

fn firmware(vehicle: &Vehicle) -> String {
    vehicle.version.map_or(String::new(), |version| {
        let (major, minor, patch) = version.firmware;
        format!("{major}.{minor}.{patch}")
    })
}
