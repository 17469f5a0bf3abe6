//! Designs of the workshop on a real `ArduCopter` and `ArduRover`, named by `SORTIE_ARDUCOPTER` and `SORTIE_ARDUROVER`:
//! computed figures against measured flights and drives.

use std::fmt::Write as _;
use std::path::Path;

use sortie::geo::LatLon;
use sortie::sim::Start;
use sortie::sitl::{Recipe, gear_parameters};
use sortie::vehicle::VehicleId;
use sortie::workshop::{Air, AirframeBuild, Design, Figures};

use crate::fleet::Console;
use crate::sitl::{self, Sitl};

/// The number of the first SITL instance: its TCP port is 5760 plus ten per instance, which avoids
/// ports that other programs usually use.
const FIRST_INSTANCE: u16 = 84;
const VEHICLE: VehicleId = 7;
const SPEEDUP: f64 = 10.0;
/// The share of the charge that is flown; the endurance is extrapolated from it.
const STRETCH: f64 = 0.1;
/// The maximum difference between either simulator and the computed figures, as a share.
const WITHIN: f64 = 0.15;

/// A skid-steered and a steered robot, and a boat.
const DRIVEN: [&str; 3] = [
    include_str!("../../designs/sapper.toml"),
    include_str!("../../designs/courier.toml"),
    include_str!("../../designs/lifeboat.toml"),
];

const DESIGNS: [&str; 3] = [
    include_str!("../../designs/starter.toml"),
    include_str!("../../designs/gas-hexa.toml"),
    include_str!("../../designs/endurance.toml"),
];

fn start(program: &Path, design: &Design, instance: u16) -> Sitl {
    let built = design.airframe().expect("complete");
    let kind = design.vehicle_kind();
    let of_gear = match &built.build {
        AirframeBuild::Frame(_) => Vec::new(),
        AirframeBuild::Gear(gear) => gear_parameters(kind, gear),
    };
    // The model of a boat has wind, which drives it.
    let calm = ("SIM_WIND_SPD", 0.0);
    let set = built.parameters.iter().chain(&of_gear).chain([&calm]);
    let recipe = Recipe {
        kind: kind.into(),
        model: Some(built.model.to_owned()),
        airframe: built.frame().map(ToString::to_string),
        start: Start {
            at: LatLon::new(50.45, 30.52),
            altitude_amsl_m: 0.0,
            heading_deg: 0.0,
        },
        system: VEHICLE as u8,
        speedup: SPEEDUP,
        parameters: set.map(|&(name, value)| (name.to_owned(), value)).collect(),
    };
    Sitl::of(program, &recipe, instance)
}

/// Seconds by the vehicle's clock, and the charge drawn from the battery, in mAh.
fn reading(console: &Console) -> Option<(f64, f64)> {
    let vehicle = console.vehicle(VEHICLE)?;
    let taken_mah = f64::from(vehicle.battery()?.consumed_mah?);
    Some((f64::from(vehicle.clock_ms()?) / 1000.0, taken_mah))
}

fn throttle(console: &Console) -> Option<f64> {
    let hud = console.vehicle(VEHICLE)?.hud?;
    Some(f64::from(hud.throttle_percent) / 100.0)
}

async fn wait(console: &mut Console, seconds: f64) {
    let begun_s = reading(console).expect("it tells its time").0;
    let over =
        |console: &Console| reading(console).is_some_and(|(now_s, _)| now_s >= begun_s + seconds);
    console.until("time has passed", over).await;
}

/// Hover time in seconds from a full battery to a fifth of the charge, extrapolated from a part of it.
async fn endurance_s(console: &mut Console, figures: &Figures) -> f64 {
    let stretch_mah = STRETCH * figures.capacity_ah * 1000.0;
    let (begun_s, before_mah) = reading(console).expect("it tells its charge");
    let over = |console: &Console| {
        reading(console).is_some_and(|(_, taken_mah)| taken_mah >= before_mah + stretch_mah)
    };
    console.until("a part of the charge is used", over).await;
    let (now_s, taken_mah) = reading(console).expect("it tells its charge");
    (now_s - begun_s) * 0.8 * figures.capacity_ah * 1000.0 / (taken_mah - before_mah)
}

/// The speed that the vehicle reaches on a long straight leg, in m/s.
async fn top_speed_m_s(console: &mut Console) -> f64 {
    // A new leg resets the speed to its default.
    console.give("goto n 4000 e 0 up 20", &[VEHICLE]);
    wait(console, 5.0).await;
    console.give("speed 40", &[VEHICLE]);
    wait(console, 60.0).await;
    let vehicle = console.vehicle(VEHICLE).expect("it flies");
    f64::from(vehicle.ground_speed_m_s().expect("it tells its speed"))
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs SORTIE_ARDUCOPTER"]
async fn designs_fly_on_a_real_arducopter_as_computed() {
    let program = sitl::arducopter();
    let mut table = String::new();
    let mut worst: f64 = 0.0;
    for (source, instance) in DESIGNS.into_iter().zip(FIRST_INSTANCE..) {
        let design = Design::from_toml(source).expect("a good design");
        let figures = design.figures(Air::default()).expect("complete");
        let _sitl = start(&program, &design, instance);
        let mut console = Console::start();
        console.connect(&format!("tcp:127.0.0.1:{}", 5760 + 10 * instance));
        console.until_ready(&[VEHICLE]).await;
        for line in ["guided", "arm", "takeoff 20"] {
            let entry = console.give(line, &[VEHICLE]);
            console.until_done(entry, VEHICLE).await;
        }
        wait(&mut console, 20.0).await;
        let found = [
            throttle(&console).expect("it tells its throttle"),
            endurance_s(&mut console, &figures).await,
            top_speed_m_s(&mut console).await,
        ];
        let computed = [
            figures.hover_throttle,
            figures.hover_80_s,
            figures.top_speed_m_s,
        ];
        for ((what, computed), found) in ["throttle", "hover s", "top m/s"]
            .iter()
            .zip(computed)
            .zip(found)
        {
            let error = found / computed - 1.0;
            worst = worst.max(error.abs());
            let name = &design.name;
            writeln!(
                table,
                "{name:14} {what:9} computed {computed:8.2} flown {found:8.2} {:+5.1} %",
                error * 100.0
            )
            .expect("a string takes it");
        }
    }
    println!("{table}");
    assert!(worst <= WITHIN, "{table}");
}

/// The current from the battery by its charge, in amperes, over a minute.
async fn current_a(console: &mut Console) -> f64 {
    let (begun_s, before_mah) = reading(console).expect("it tells its charge");
    wait(console, 60.0).await;
    let (now_s, taken_mah) = reading(console).expect("it tells its charge");
    (taken_mah - before_mah) * 3.6 / (now_s - begun_s)
}

fn ground_speed_m_s(console: &Console) -> f64 {
    let vehicle = console.vehicle(VEHICLE).expect("it drives");
    f64::from(vehicle.ground_speed_m_s().expect("it tells its speed"))
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs SORTIE_ARDUROVER"]
async fn designs_drive_on_a_real_ardurover_at_the_speeds_and_the_current_computed() {
    let program = sitl::ardurover();
    let mut table = String::new();
    let mut worst: f64 = 0.0;
    for (source, instance) in DRIVEN.into_iter().zip(FIRST_INSTANCE + 10..) {
        let design = Design::from_toml(source).expect("a good design");
        let figures = design.drive_figures(Air::default()).expect("complete");
        let _sitl = start(&program, &design, instance);
        let mut console = Console::start();
        console.connect(&format!("tcp:127.0.0.1:{}", 5760 + 10 * instance));
        let is_ready =
            |console: &Console| console.vehicle(VEHICLE).is_some_and(|it| it.ready_to_arm());
        console.until("the position is known", is_ready).await;
        for line in ["guided", "arm"] {
            let entry = console.give(line, &[VEHICLE]);
            console.until_done(entry, VEHICLE).await;
        }
        console.give("goto n 6000 e 0", &[VEHICLE]);
        wait(&mut console, 30.0).await;
        let cruise_m_s = ground_speed_m_s(&console);
        let cruise_a = current_a(&mut console).await;
        console.give("speed 40", &[VEHICLE]);
        wait(&mut console, 60.0).await;
        let found = [cruise_m_s, cruise_a, ground_speed_m_s(&console)];
        let computed = [
            figures.cruise_speed_m_s,
            figures.cruise_current_a,
            figures.top_speed_m_s,
        ];
        let what = ["cruise m/s", "cruise A", "top m/s"];
        for ((what, computed), found) in what.iter().zip(computed).zip(found) {
            let error = found / computed - 1.0;
            worst = worst.max(error.abs());
            let name = &design.name;
            writeln!(
                table,
                "{name:14} {what:10} computed {computed:8.2} driven {found:8.2} {:+5.1} %",
                error * 100.0
            )
            .expect("a string takes it");
        }
    }
    println!("{table}");
    assert!(worst <= WITHIN, "{table}");
}
