//! Drones, robots and boats of the workshop: computed figures against measured flights and drives, at sea level and
//! without wind.

use std::sync::Arc;

use mavlink::dialects::ardupilotmega::{
    COMMAND_LONG_DATA, MavCmd, MavFrame, MavMessage, PARAM_SET_DATA, PositionTargetTypemask,
    RC_CHANNELS_OVERRIDE_DATA, SET_POSITION_TARGET_GLOBAL_INT_DATA,
};
use mavlink::types::CharArray;
use sortie::geo::LatLon;
use sortie::geo::maths;
use sortie::sim::{Airframe, PortId, STEP, Start, Truth, VehicleKind, World, WorldConfig};
use sortie::wire::Encoder;
use sortie::workshop::{Air, Design, DriveFigures, Figures};

const ALT_HOLD: f32 = 2.0;
const GUIDED: f32 = 4.0;
const DRIVE_GUIDED: f32 = 15.0;
/// The share of the charge over which the endurance is compared.
const USED: f64 = 0.8;

/// A quad, a hexa, one with lithium ion cells, a heavy one and a racer.
const DESIGNS: [&str; 5] = [
    include_str!("../../designs/starter.toml"),
    include_str!("../../designs/gas-hexa.toml"),
    include_str!("../../designs/endurance.toml"),
    include_str!("../../designs/deminer.toml"),
    include_str!("../../designs/scout.toml"),
];

/// Steered and skid-steered robots, and boats.
const DRIVEN: [&str; 3] = [
    include_str!("../../designs/sapper.toml"),
    include_str!("../../designs/courier.toml"),
    include_str!("../../designs/lifeboat.toml"),
];

/// A simulated vehicle and the ground station that flies or drives it.
struct Flight {
    world: World,
    port: PortId,
    encoder: Encoder,
}

impl Flight {
    /// A vehicle that hovers at 20 m. No failsafe takes it home before its battery is empty.
    fn hovering(airframe: Airframe) -> Self {
        let mut flight = Self::ready(airframe, VehicleKind::Copter);
        flight.command(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, GUIDED], 0.0);
        flight.command(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0], 0.0);
        flight.command(MavCmd::MAV_CMD_NAV_TAKEOFF, [0.0, 0.0], 20.0);
        flight.run(35.0);
        assert!(flight.truth().armed && flight.height_m() > 19.0, "hovers");
        flight
    }

    /// A vehicle at rest that no failsafe takes home.
    fn ready(airframe: Airframe, kind: VehicleKind) -> Self {
        let start = Start {
            at: LatLon::new(-35.363_262, 149.165_237),
            altitude_amsl_m: 0.0,
            heading_deg: 0.0,
        };
        let mut world = World::new(&WorldConfig {
            airframes: vec![Arc::new(airframe)],
            kinds: vec![kind],
            ..WorldConfig::row(1, start)
        });
        let port = world.connect(0);
        let mut flight = Self {
            world,
            port,
            encoder: Encoder::new(255, 190),
        };
        for name in ["BATT_FS_LOW_ACT", "BATT_FS_CRT_ACT", "SIM_WIND_SPD"] {
            flight.set(name, 0.0);
        }
        flight.run(2.0);
        flight
    }

    fn set(&mut self, name: &str, value: f32) {
        self.say(MavMessage::PARAM_SET(PARAM_SET_DATA {
            param_value: value,
            target_system: 1,
            target_component: 1,
            param_id: CharArray::from(name),
            ..Default::default()
        }));
    }

    /// Sends the vehicle far to the north.
    fn go_north(&mut self) {
        self.say(MavMessage::SET_POSITION_TARGET_GLOBAL_INT(
            SET_POSITION_TARGET_GLOBAL_INT_DATA {
                lat_int: -345_000_000,
                lon_int: 1_491_652_370,
                coordinate_frame: MavFrame::MAV_FRAME_GLOBAL,
                type_mask: PositionTargetTypemask::from_bits_retain(0b1101_1111_1000),
                target_system: 1,
                target_component: 1,
                ..Default::default()
            },
        ));
    }

    fn ground_speed_m_s(&self) -> f64 {
        let [north, east, _] = self.truth().velocity_ned_m_s;
        maths::hypot(north, east)
    }

    fn say(&mut self, message: MavMessage) {
        let mut bytes = Vec::new();
        self.encoder.encode(&message.into(), &mut bytes);
        self.world.receive(self.port, &bytes);
    }

    fn command(&mut self, command: MavCmd, [param1, param2]: [f32; 2], param7: f32) {
        self.say(MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
            command,
            param1,
            param2,
            param7,
            target_system: 1,
            target_component: 1,
            ..Default::default()
        }));
    }

    fn run(&mut self, seconds: f64) {
        for _ in 0..(seconds * 100.0).round() as usize {
            self.world.step();
        }
    }

    fn truth(&self) -> Truth {
        self.world.truth(0)
    }

    fn height_m(&self) -> f64 {
        -self.truth().position_ned_m[2]
    }
}

/// A design, its computed figures, and its vehicle in the air.
fn flown(source: &str) -> (Design, Figures, Flight) {
    let design = Design::from_toml(source).expect("a good design");
    let figures = design.figures(Air::default()).expect("complete");
    let built = design.airframe().expect("complete");
    let frame = built.frame().expect("a drone").to_string();
    let (_, warnings) = Airframe::from_json(&frame).expect("valid");
    assert_eq!(warnings, []);
    let airframe = built.simulated().expect("valid");
    (design, figures, Flight::hovering(airframe))
}

fn compare(name: &str, what: &str, computed: f64, found: f64, within: f64) {
    println!("{name:14} {what:14} computed {computed:8.2} flown {found:8.2}");
    let error = (found - computed).abs();
    assert!(
        error <= within,
        "{name}: {what} {found:.3} instead of {computed:.3}"
    );
}

/// The seconds of hovering from a full battery until a share of its charge is used. The takeoff
/// counts as hovering.
fn endurance_s(flight: &mut Flight, capacity_ah: f64, share: f64) -> f64 {
    let begun = flight.truth();
    let before_s = begun.battery_consumed_mah * 3.6 / begun.battery_current_a;
    let mut steps = 0_u32;
    while flight.truth().battery_consumed_mah < share * capacity_ah * 1000.0 {
        flight.world.step();
        steps += 1;
    }
    before_s + f64::from(steps) * STEP.as_secs_f64()
}

#[test]
fn a_design_hovers_with_the_throttle_the_power_and_for_as_long_as_computed() {
    for source in DESIGNS {
        let (design, figures, mut flight) = flown(source);
        let name = design.name.as_str();
        let truth = flight.truth();
        compare(
            name,
            "throttle",
            figures.hover_throttle,
            truth.throttle,
            0.03,
        );
        let power_w = truth.battery_current_a * truth.battery_voltage_v;
        compare(
            name,
            "hover W",
            figures.hover_power_w,
            power_w,
            0.02 * power_w,
        );
        let time_s = endurance_s(&mut flight, figures.capacity_ah, USED);
        compare(name, "hover s", figures.hover_80_s, time_s, 0.05 * time_s);
        let height_m = flight.height_m();
        assert!(
            (height_m - 20.0).abs() < 1.0,
            "{name}: still up at {height_m} m"
        );
    }
}

#[test]
fn a_design_flies_as_fast_as_computed() {
    for source in DESIGNS {
        let (design, figures, mut flight) = flown(source);
        let name = design.name.as_str();
        flight.command(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, ALT_HOLD], 0.0);
        // The nose is held down until the speed no longer rises.
        for _ in 0..600 {
            flight.say(MavMessage::RC_CHANNELS_OVERRIDE(
                RC_CHANNELS_OVERRIDE_DATA {
                    chan1_raw: 1500,
                    chan2_raw: 1000,
                    chan3_raw: 1500,
                    chan4_raw: 1500,
                    target_system: 1,
                    target_component: 1,
                    ..Default::default()
                },
            ));
            flight.run(0.1);
        }
        let speed = flight.ground_speed_m_s();
        compare(name, "top m/s", figures.top_speed_m_s, speed, 0.1 * speed);
    }
}

/// A design that drives, its computed figures, and its vehicle under way to a far place.
fn driven(source: &str) -> (Design, DriveFigures, Flight) {
    let design = Design::from_toml(source).expect("a good design");
    let figures = design.drive_figures(Air::default()).expect("complete");
    let built = design.airframe().expect("complete");
    let airframe = built.simulated().expect("valid");
    let mut flight = Flight::ready(airframe, design.vehicle_kind());
    flight.command(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, DRIVE_GUIDED], 0.0);
    flight.command(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0], 0.0);
    flight.run(1.0);
    flight.go_north();
    flight.run(30.0);
    assert!(flight.truth().armed && flight.ground_speed_m_s() > 0.1);
    (design, figures, flight)
}

#[test]
fn a_design_drives_at_cruise_speed_for_as_long_as_computed() {
    for source in DRIVEN {
        let (design, figures, mut flight) = driven(source);
        let name = design.name.as_str();
        let speed = flight.ground_speed_m_s();
        let cruise = figures.cruise_speed_m_s;
        compare(name, "cruise m/s", cruise, speed, 0.05 * cruise);
        let time_s = endurance_s(&mut flight, figures.capacity_ah, USED);
        compare(name, "drive s", figures.drive_80_s, time_s, 0.05 * time_s);
    }
}

#[test]
fn a_design_drives_as_fast_as_computed_and_stops_when_its_battery_is_empty() {
    for source in DRIVEN {
        let (design, figures, mut flight) = driven(source);
        flight.command(MavCmd::MAV_CMD_DO_CHANGE_SPEED, [1.0, 50.0], 0.0);
        flight.run(60.0);
        let speed = flight.ground_speed_m_s();
        let top = figures.top_speed_m_s;
        compare(&design.name, "top m/s", top, speed, 0.1 * top);
        flight.set("SIM_BATT_VOLTAGE", 0.1);
        flight.run(120.0);
        let speed = flight.ground_speed_m_s();
        assert!(speed < 0.05 * top, "{}: {speed} m/s", design.name);
    }
}
