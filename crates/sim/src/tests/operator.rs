//! Operator control: two ground stations on one vehicle.

use mavlink::dialects::ardupilotmega::{MavCmd, MavResult};

use super::*;
use crate::operator::REQUEST_CONTROL;
use sortie_wire::{CONTROL_STATUS, Decoder, Encoder, Outgoing};

/// A ground station with an id of its own.
struct Station {
    port: PortId,
    encoder: Encoder,
    decoder: Decoder,
    system: u8,
}

impl Station {
    fn on(world: &mut World, system: u8) -> Self {
        Self {
            port: world.connect(0),
            encoder: Encoder::new(system, 190),
            decoder: Decoder::new(),
            system,
        }
    }

    /// Sends a command and returns its result.
    fn long(&mut self, world: &mut World, command: u16, params: [f32; 4]) -> Option<u8> {
        let mut payload: Vec<u8> = params.iter().flat_map(|it| it.to_le_bytes()).collect();
        payload.extend_from_slice(&[0; 12]);
        payload.extend_from_slice(&command.to_le_bytes());
        payload.extend_from_slice(&[1, 1, 0]);
        let mut bytes = Vec::new();
        let outgoing = Outgoing::Raw { id: 76, payload };
        self.encoder.encode(&outgoing, &mut bytes);
        world.receive(self.port, &bytes);
        let own = self.system;
        self.heard(world).into_iter().find_map(|(id, payload)| {
            let is_mine = payload[8] == own && payload[..2] == command.to_le_bytes();
            (id == 77 && is_mine).then_some(payload[2])
        })
    }

    fn control(&mut self, world: &mut World, request: bool, takeover: bool) -> Option<u8> {
        let number = |it: bool| f32::from(u8::from(it));
        let station = f32::from(self.system);
        let params = [number(request), number(takeover), 10.0, station];
        self.long(world, REQUEST_CONTROL, params)
    }

    fn arm(&mut self, world: &mut World) -> Option<u8> {
        let arm = MavCmd::MAV_CMD_COMPONENT_ARM_DISARM as u16;
        self.long(world, arm, [0.0; 4])
    }

    fn beat(&mut self, world: &mut World) {
        let mut bytes = Vec::new();
        let beat = sortie_wire::ground_station_heartbeat();
        self.encoder.encode(&beat, &mut bytes);
        world.receive(self.port, &bytes);
    }

    /// The messages since the last call: ids and payloads.
    fn heard(&mut self, world: &mut World) -> Vec<(u32, Vec<u8>)> {
        let mut bytes = Vec::new();
        world.take_output(self.port, &mut bytes);
        self.decoder.push(&bytes);
        std::iter::from_fn(|| self.decoder.next_frame())
            .map(|frame| {
                let payload = crate::payload::Payload::of(&frame.content);
                let payload = payload.map(|payload| payload.from(0).to_vec());
                (frame.content.id(), payload.unwrap_or_else(|| vec![0; 255]))
            })
            .collect()
    }

    /// The flags and the owner that the vehicle announced last.
    fn announced(&mut self, world: &mut World) -> Option<(u8, u8)> {
        let heard = self.heard(world).into_iter().rev();
        let mut announced = heard.filter(|(id, _)| *id == CONTROL_STATUS);
        announced
            .next()
            .map(|(_, payload)| (payload[0], payload[1]))
    }
}

fn run(world: &mut World, seconds: u32) {
    for _ in 0..seconds * 100 {
        world.step();
    }
}

fn two_stations() -> (World, Station, Station) {
    let mut world = World::new(&WorldConfig::row(1, start()));
    world.announce_control();
    let (first, second) = (Station::on(&mut world, 255), Station::on(&mut world, 250));
    run(&mut world, 2);
    (world, first, second)
}

const ACCEPTED: Option<u8> = Some(MavResult::MAV_RESULT_ACCEPTED as u8);
const FAILED: Option<u8> = Some(MavResult::MAV_RESULT_FAILED as u8);
const NOT_IN_CONTROL: Option<u8> = Some(MavResult::MAV_RESULT_NOT_IN_CONTROL as u8);

#[test]
fn only_the_owner_commands_and_hands_over() {
    let (mut world, mut first, mut second) = two_stations();
    assert_eq!(second.announced(&mut world), Some((1, 0)));
    assert_eq!(second.arm(&mut world), ACCEPTED, "the vehicle is free");
    assert_eq!(first.control(&mut world, true, false), ACCEPTED);
    run(&mut world, 1);
    assert_eq!(second.announced(&mut world), Some((1, 255)));
    assert_eq!(second.arm(&mut world), NOT_IN_CONTROL);
    first.heard(&mut world);
    assert_eq!(second.control(&mut world, true, false), FAILED);
    run(&mut world, 1);
    let asked = first
        .heard(&mut world)
        .into_iter()
        .find(|(id, _)| *id == 76);
    let (_, asked) = asked.expect("the owner is asked");
    assert_eq!(
        (&asked[12..16], asked[30]),
        (&250f32.to_le_bytes()[..], 255)
    );
    assert_eq!(first.control(&mut world, true, true), ACCEPTED);
    assert_eq!(second.control(&mut world, true, false), ACCEPTED);
    assert_eq!(first.arm(&mut world), NOT_IN_CONTROL);
    assert_eq!(first.control(&mut world, false, false), FAILED);
    assert_eq!(second.control(&mut world, false, false), ACCEPTED);
    assert_eq!(first.arm(&mut world), ACCEPTED);
}

#[test]
fn an_owner_that_is_gone_loses_control() {
    let (mut world, mut first, mut second) = two_stations();
    assert_eq!(first.control(&mut world, true, false), ACCEPTED);
    for _ in 0..8 {
        first.beat(&mut world);
        run(&mut world, 1);
    }
    assert_eq!(second.arm(&mut world), NOT_IN_CONTROL);
    run(&mut world, 6);
    assert_eq!(second.announced(&mut world), Some((1, 0)));
    assert_eq!(second.arm(&mut world), ACCEPTED);
}

#[test]
fn the_usual_vehicle_has_no_operator_control() {
    let mut world = World::new(&WorldConfig::row(1, start()));
    let mut station = Station::on(&mut world, 255);
    run(&mut world, 2);
    assert_eq!(station.announced(&mut world), None);
    let unsupported = Some(MavResult::MAV_RESULT_UNSUPPORTED as u8);
    assert_eq!(station.control(&mut world, true, false), unsupported);
}
