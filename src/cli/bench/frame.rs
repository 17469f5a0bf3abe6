//! `sortie bench frame`: the cost of drawing.

use std::process::ExitCode;
use std::sync::Arc;
use std::time::{Duration, Instant};

use clap::Args;
use serde::Serialize;

use super::super::Failure;
use crate::app::State;
use crate::app::event::{Event, SessionEvent, Started, TerminalEvent, VehicleEvent};
use crate::app::state::Activity;
use crate::app::{App, Setup};
use crate::geo::LatLon;
use crate::terminal::Screen;
use crate::ui::{self, Look};
use crate::vehicle::{
    Attitude, Battery, FixType, GlobalPosition, Gps, Heartbeat, LandedState, Mode, Place,
    SystemStatus, Vehicle, VehicleClass, VehicleId,
};

/// The sizes of the swarms that are drawn.
const SWARMS: [VehicleId; 4] = [1, 10, 100, 1000];
/// Frames per swarm; the first ones warm up and are not counted.
const FRAMES: u32 = 300;
const WARM_UP: u32 = 20;
/// One vehicle in this many has changed since the last frame.
const ONE_IN: u32 = 10;

/// Options of `sortie bench frame`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie bench frame\n  \
    sortie bench frame --width 200 --height 50 --json")]
pub(in crate::cli) struct FrameArguments {
    /// Draw a screen with this many columns.
    #[arg(long, default_value_t = 120, value_parser = clap::value_parser!(u16).range(80..=1000))]
    width: u16,
    /// Draw a screen with this many rows.
    #[arg(long, default_value_t = 40, value_parser = clap::value_parser!(u16).range(24..=1000))]
    height: u16,
    /// Draw the map instead of the flight screen.
    #[arg(long)]
    map: bool,
    /// Print one JSON document instead of the table.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Serialize)]
struct FrameCost {
    vehicles: VehicleId,
    width: u16,
    height: u16,
    us_per_frame: f64,
    bytes_per_frame: f64,
    bytes_idle: u64,
}

pub(in crate::cli) fn frame(options: &FrameArguments) -> Result<ExitCode, Failure> {
    let measured: Vec<FrameCost> = SWARMS
        .iter()
        .map(|&vehicles| measure(vehicles, options))
        .collect::<Result<_, _>>()?;
    if options.json {
        say!("{}", serde_json::to_string(&measured)?)?;
        return Ok(ExitCode::SUCCESS);
    }
    say!(
        "screen {}x{}, a tenth of the vehicles changes per frame",
        options.width,
        options.height
    )?;
    say!("vehicles   us per frame   bytes per frame   bytes when nothing changes")?;
    for row in measured {
        say!(
            "{:>8} {:>14.0} {:>17.0} {:>28}",
            row.vehicles,
            row.us_per_frame,
            row.bytes_per_frame,
            row.bytes_idle
        )?;
    }
    Ok(ExitCode::SUCCESS)
}

fn measure(vehicles: VehicleId, options: &FrameArguments) -> Result<FrameCost, Failure> {
    let look = Look::default();
    let mut screen = Screen::nowhere(options.width, options.height)?;
    let mut app = swarm(vehicles);
    let (columns, rows) = (options.width, options.height);
    feed(&mut app, TerminalEvent::Resize { columns, rows });
    if options.map {
        feed(&mut app, TerminalEvent::Line("show map".to_owned()));
    }
    let mut drawing = Duration::ZERO;
    let mut bytes_before = 0;
    for frame in 0..FRAMES {
        if frame == WARM_UP {
            drawing = Duration::ZERO;
            bytes_before = screen.bytes();
        }
        advance(&mut app, vehicles, frame);
        let started = Instant::now();
        draw_if_changed(&mut screen, app.state(), &look, None)?;
        drawing += started.elapsed();
    }
    let counted = f64::from(FRAMES - WARM_UP);
    let bytes_after = screen.bytes();
    let drawn = Some(app.state().revision());
    draw_if_changed(&mut screen, app.state(), &look, drawn)?;
    Ok(FrameCost {
        vehicles,
        width: options.width,
        height: options.height,
        us_per_frame: drawing.as_secs_f64() * 1e6 / counted,
        bytes_per_frame: (bytes_after - bytes_before) as f64 / counted,
        bytes_idle: screen.bytes() - bytes_after,
    })
}

/// Draws a frame only if the state has changed since the last one, as the console does.
fn draw_if_changed(
    screen: &mut Screen,
    state: &State,
    look: &Look,
    drawn: Option<u64>,
) -> std::io::Result<()> {
    if drawn == Some(state.revision()) {
        return Ok(());
    }
    screen.draw(|frame| ui::draw(state, look, frame))
}

/// A swarm on the flight screen.
fn swarm(vehicles: VehicleId) -> App {
    let mut app = App::new(Setup::default());
    let started = Started {
        activity: Activity::Free,
        mission: None,
        places: std::collections::BTreeMap::new(),
        areas: Vec::new(),
        processes: None,
        speedup: 1.0,
        is_again: false,
    };
    feed(&mut app, SessionEvent::Started(Box::new(started)));
    for id in 1..=vehicles {
        feed(&mut app, VehicleEvent::Telemetry(Arc::new(flying(id, 0))));
    }
    app
}

/// Moves the next tenth of the swarm.
fn advance(app: &mut App, vehicles: VehicleId, frame: u32) {
    let now = Duration::from_millis(u64::from(frame) * 100);
    feed(app, Event::Tick { now, wall: now });
    let is_due = |id: &VehicleId| vehicles == 1 || u32::from(*id) % ONE_IN == frame % ONE_IN;
    for id in (1..=vehicles).filter(is_due) {
        feed(app, VehicleEvent::Telemetry(Arc::new(flying(id, frame))));
    }
}

/// Handles an event. Only drawing is measured: effects are dropped.
fn feed(app: &mut App, event: impl Into<Event>) {
    let _effects = app.update(event);
}

/// A copter in flight, with figures that differ by vehicle and by frame.
fn flying(id: VehicleId, frame: u32) -> Vehicle {
    let at = Duration::from_millis(u64::from(frame) * 100);
    let home = LatLon::new(50.45, 30.52);
    let class = VehicleClass::Copter;
    let far = f64::from(frame) + f64::from(id);
    let mut vehicle = Vehicle::new((id % 250) as u8, 1);
    vehicle.id = id;
    vehicle.landed = LandedState::InAir;
    vehicle.heartbeat = Some(Heartbeat {
        mav_type: 2,
        autopilot: 3,
        class,
        mode: Mode { class, number: 4 },
        armed: true,
        status: SystemStatus::Active,
        at,
    });
    vehicle.global = Some(GlobalPosition {
        // Each vehicle flies along a line of its own; close to another one, it would raise an alert
        // that hides the rest.
        at_point: home.moved(20.0 * f64::from(id), 5.0 * f64::from(frame)),
        altitude_amsl_m: 180.0 + far % 60.0,
        altitude_m: far % 60.0,
        north_m_s: (far % 10.0) as f32,
        east_m_s: 1.0,
        down_m_s: 0.0,
        heading_deg: Some((far % 360.0) as f32),
        at,
    });
    vehicle.attitude = Some(Attitude {
        roll_deg: (far % 20.0) as f32 - 10.0,
        pitch_deg: (far % 14.0) as f32 - 7.0,
        yaw_deg: (far % 360.0) as f32,
        at,
    });
    vehicle.home = Some(Place {
        at_point: home,
        altitude_amsl_m: 180.0,
    });
    vehicle.gps = Some(Gps {
        fix: FixType::RtkFixed,
        satellites: Some(10),
        hdop: Some(1.2),
        at,
    });
    vehicle.batteries = vec![Battery {
        id: 0,
        voltage_v: Some(12.6),
        current_a: Some(28.1 + (far % 3.0) as f32),
        consumed_mah: Some(far as f32),
        consumed_wh: None,
        remaining_percent: Some(100 - (frame / 10 % 100) as u8),
        at,
    }];
    vehicle.link.received = 100;
    vehicle.link.last_heard = Some(at);
    vehicle
}
