//! A ground station of another program, tested against a simulated `ArduCopter`: it arms the vehicle, takes off, and
//! reads the vehicle's position from the telemetry. There are no sockets, no threads and no waiting: a minute of flight
//! takes milliseconds, and every run is the same.
//!
//! `cargo run -p sortie-sim --example takeoff`

use std::error::Error;

use sortie_sim::geo::LatLon;
use sortie_sim::mavlink::dialects::ardupilotmega::{
    COMMAND_ACK_DATA, COMMAND_LONG_DATA, GLOBAL_POSITION_INT_DATA, HEARTBEAT_DATA, MavCmd,
    MavMessage, MavResult,
};
use sortie_sim::wire::{Content, Decoder, Encoder};
use sortie_sim::{PortId, Start, World, WorldConfig};

/// `ArduCopter`'s GUIDED mode.
const GUIDED: f32 = 4.0;
/// The message id of `GLOBAL_POSITION_INT`.
const GLOBAL_POSITION_INT: f32 = 33.0;

/// The program under test: it only handles bytes, as behind a socket.
struct GroundStation {
    encoder: Encoder,
    decoder: Decoder,
    position: Option<GLOBAL_POSITION_INT_DATA>,
    ack: Option<COMMAND_ACK_DATA>,
}

impl GroundStation {
    fn new() -> Self {
        Self {
            encoder: Encoder::new(255, 190),
            decoder: Decoder::new(),
            position: None,
            ack: None,
        }
    }

    fn frame(&mut self, message: MavMessage) -> Vec<u8> {
        let mut bytes = Vec::new();
        self.encoder.encode(&message.into(), &mut bytes);
        bytes
    }

    fn command(&mut self, command: MavCmd, [param1, param2, param7]: [f32; 3]) -> Vec<u8> {
        self.ack = None;
        self.frame(MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
            command,
            param1,
            param2,
            param7,
            target_system: 1,
            target_component: 1,
            ..Default::default()
        }))
    }

    fn receive(&mut self, bytes: &[u8]) {
        self.decoder.push(bytes);
        while let Some(frame) = self.decoder.next_frame() {
            match frame.content {
                Content::Message(MavMessage::GLOBAL_POSITION_INT(data)) => {
                    self.position = Some(data);
                }
                Content::Message(MavMessage::COMMAND_ACK(data)) => self.ack = Some(data),
                _ => {}
            }
        }
    }
}

struct Flight {
    world: World,
    port: PortId,
    station: GroundStation,
}

impl Flight {
    fn begin() -> Self {
        let start = Start {
            at: LatLon::new(50.4501, 30.5234),
            altitude_amsl_m: 170.0,
            heading_deg: 90.0,
        };
        let mut world = World::new(&WorldConfig::row(1, start));
        let port = world.connect(0);
        Self {
            world,
            port,
            station: GroundStation::new(),
        }
    }

    fn send(&mut self, bytes: &[u8]) {
        self.world.receive(self.port, bytes);
        self.listen();
    }

    fn order(&mut self, command: MavCmd, params: [f32; 3]) -> Result<(), Box<dyn Error>> {
        let bytes = self.station.command(command, params);
        self.send(&bytes);
        match self.station.ack.take() {
            Some(ack) if ack.result == MavResult::MAV_RESULT_ACCEPTED => Ok(()),
            answer => Err(format!("{command:?}: {answer:?}").into()),
        }
    }

    fn run(&mut self, seconds: u32) {
        // The world moves in steps of 10 ms.
        for _ in 0..seconds * 100 {
            self.world.step();
            self.listen();
        }
    }

    fn listen(&mut self) {
        let mut bytes = Vec::new();
        self.world.take_output(self.port, &mut bytes);
        self.station.receive(&bytes);
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut flight = Flight::begin();
    let heartbeat = MavMessage::HEARTBEAT(HEARTBEAT_DATA::default());
    let bytes = flight.station.frame(heartbeat);
    flight.send(&bytes);
    flight.run(2);
    // Positions twice a second.
    let every_us = [GLOBAL_POSITION_INT, 500_000.0, 0.0];
    flight.order(MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL, every_us)?;
    flight.order(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, GUIDED, 0.0])?;
    flight.order(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0, 0.0])?;
    flight.order(MavCmd::MAV_CMD_NAV_TAKEOFF, [0.0, 0.0, 20.0])?;
    flight.run(30);

    let position = flight.station.position.ok_or("no position was heard")?;
    let heard_m = f64::from(position.relative_alt) / 1000.0;
    let truth = flight.world.truth(0);
    println!(
        "armed: {}, {heard_m:.2} m above home at {:.7}, {:.7}",
        truth.armed,
        f64::from(position.lat) * 1e-7,
        f64::from(position.lon) * 1e-7,
    );
    // The telemetry agrees with the true state.
    assert!(truth.armed && (heard_m - 20.0).abs() < 0.5);
    assert!((heard_m + truth.position_ned_m[2]).abs() < 0.1);
    Ok(())
}
