//! A ground station for tests.

use std::sync::Arc;

use mavlink::dialects::ardupilotmega::{
    COMMAND_ACK_DATA, COMMAND_INT_DATA, COMMAND_LONG_DATA, HEARTBEAT_DATA, MavCmd, MavFrame,
    MavMessage, MavResult, PARAM_SET_DATA, PositionTargetTypemask, RC_CHANNELS_OVERRIDE_DATA,
    SET_POSITION_TARGET_LOCAL_NED_DATA,
};
use mavlink::types::CharArray;

use super::super::*;
use super::start;
use sortie_wire::{Content, Decoder, Encoder, Frame, Outgoing};

/// Modes by number, for the tests.
pub(super) const GUIDED: f32 = 4.0;

/// One ground station on one vehicle of a world.
pub(crate) struct Ground {
    pub(crate) world: World,
    pub(crate) port: PortId,
    encoder: Encoder,
    decoder: Decoder,
    /// Everything received so far.
    pub(crate) heard: Vec<Frame>,
}

impl Ground {
    /// A ground station connected to SITL's default quadcopter in a world that has just begun.
    pub(crate) fn new() -> Self {
        Self::flying(Airframe::shared_default())
    }

    /// A ground station connected to a vehicle with this airframe.
    pub(crate) fn flying(airframe: Arc<Airframe>) -> Self {
        Self::in_world(&WorldConfig {
            airframes: vec![airframe],
            ..WorldConfig::row(1, start())
        })
    }

    /// A ground station connected to the first vehicle of a world that has just begun.
    pub(crate) fn in_world(config: &WorldConfig) -> Self {
        let mut world = World::new(config);
        let port = world.connect(0);
        Self {
            world,
            port,
            encoder: Encoder::new(255, 190),
            decoder: Decoder::new(),
            heard: Vec::new(),
        }
    }

    /// A ground station whose vehicle is ready, in GUIDED and armed.
    pub(crate) fn armed() -> Self {
        let mut ground = Self::new();
        ground.arm();
        ground
    }

    /// Waits for the boot, enters GUIDED and arms.
    pub(crate) fn arm(&mut self) {
        self.run(2.0);
        assert_eq!(
            self.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, GUIDED]),
            MavResult::MAV_RESULT_ACCEPTED
        );
        assert_eq!(
            self.long(MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]),
            MavResult::MAV_RESULT_ACCEPTED
        );
    }

    /// A ground station whose vehicle hovers at a height.
    pub(crate) fn hovering(height_m: f32) -> Self {
        Self::new().hover(height_m)
    }

    /// Arms, takes off and comes to rest at a height.
    pub(crate) fn hover(self, height_m: f32) -> Self {
        let mut ground = self;
        ground.arm();
        ground.takeoff(height_m);
        ground.run(25.0 + f64::from(height_m) / 2.0);
        ground
    }

    pub(crate) fn takeoff(&mut self, height_m: f32) {
        let mut p = [0.0; 7];
        p[6] = height_m;
        assert_eq!(
            self.long7(MavCmd::MAV_CMD_NAV_TAKEOFF, p),
            MavResult::MAV_RESULT_ACCEPTED
        );
    }

    pub(crate) fn send(&mut self, outgoing: &Outgoing) {
        let mut bytes = Vec::new();
        self.encoder.encode(outgoing, &mut bytes);
        self.world.receive(self.port, &bytes);
        self.listen();
    }

    pub(crate) fn say(&mut self, message: MavMessage) {
        self.send(&message.into());
    }

    pub(crate) fn heartbeat(&mut self) {
        self.say(MavMessage::HEARTBEAT(HEARTBEAT_DATA::default()));
    }

    pub(crate) fn long<const N: usize>(&mut self, command: MavCmd, first: [f32; N]) -> MavResult {
        let mut p = [0.0; 7];
        p[..N].copy_from_slice(&first);
        self.long7(command, p)
    }

    pub(crate) fn long7(&mut self, command: MavCmd, p: [f32; 7]) -> MavResult {
        let before = self.heard.len();
        self.say(MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
            param1: p[0],
            param2: p[1],
            param3: p[2],
            param4: p[3],
            param5: p[4],
            param6: p[5],
            param7: p[6],
            command,
            target_system: 1,
            target_component: 1,
            confirmation: 0,
        }));
        self.ack_since(before).expect("an ack at once").result
    }

    pub(crate) fn int(&mut self, data: &COMMAND_INT_DATA) -> MavResult {
        let before = self.heard.len();
        self.say(MavMessage::COMMAND_INT(COMMAND_INT_DATA {
            target_system: 1,
            target_component: 1,
            ..data.clone()
        }));
        self.ack_since(before).expect("an ack at once").result
    }

    pub(crate) fn ack_since(&self, first: usize) -> Option<COMMAND_ACK_DATA> {
        self.messages_since(first)
            .into_iter()
            .find_map(|message| match message {
                MavMessage::COMMAND_ACK(data) => Some(data),
                _ => None,
            })
    }

    pub(crate) fn messages_since(&self, first: usize) -> Vec<MavMessage> {
        self.heard[first..]
            .iter()
            .filter_map(|frame| match &frame.content {
                Content::Message(message) => Some(message.clone()),
                Content::Undecoded { .. } | Content::Unknown { .. } => None,
            })
            .collect()
    }

    pub(crate) fn texts(&self) -> Vec<String> {
        self.messages_since(0)
            .iter()
            .filter_map(|message| match message {
                MavMessage::STATUSTEXT(data) => Some(data.text.to_str().expect("text").to_owned()),
                _ => None,
            })
            .collect()
    }

    pub(crate) fn target(&mut self, p: [f32; 3], v: [f32; 3], mask: u16, frame: MavFrame) {
        self.say(MavMessage::SET_POSITION_TARGET_LOCAL_NED(
            SET_POSITION_TARGET_LOCAL_NED_DATA {
                x: p[0],
                y: p[1],
                z: p[2],
                vx: v[0],
                vy: v[1],
                vz: v[2],
                type_mask: PositionTargetTypemask::from_bits_truncate(mask),
                target_system: 1,
                target_component: 1,
                coordinate_frame: frame,
                ..Default::default()
            },
        ));
    }

    pub(crate) fn goto(&mut self, p: [f32; 3]) {
        self.target(p, [0.0; 3], 0x0DF8, MavFrame::MAV_FRAME_LOCAL_NED);
    }

    pub(crate) fn fly(&mut self, v: [f32; 3]) {
        self.target([0.0; 3], v, 0x0DC7, MavFrame::MAV_FRAME_LOCAL_NED);
    }

    pub(crate) fn set(&mut self, name: &str, value: f32) {
        self.say(MavMessage::PARAM_SET(PARAM_SET_DATA {
            param_value: value,
            target_system: 1,
            target_component: 1,
            param_id: CharArray::from(name),
            ..Default::default()
        }));
    }

    /// Sends centred sticks with this throttle.
    pub(crate) fn sticks(&mut self, throttle_us: u16) {
        self.say(MavMessage::RC_CHANNELS_OVERRIDE(
            RC_CHANNELS_OVERRIDE_DATA {
                chan1_raw: 1500,
                chan2_raw: 1500,
                chan3_raw: throttle_us,
                chan4_raw: 1500,
                target_system: 1,
                target_component: 1,
                ..Default::default()
            },
        ));
    }

    pub(crate) fn step(&mut self) {
        self.world.step();
        self.listen();
    }

    pub(crate) fn run(&mut self, seconds: f64) {
        for _ in 0..(seconds * 100.0).round() as usize {
            self.step();
        }
    }

    /// Seconds until a condition holds; fails after `most_s`.
    pub(crate) fn until(&mut self, most_s: f64, mut holds: impl FnMut(&Truth) -> bool) -> f64 {
        let mut elapsed = 0.0;
        while elapsed < most_s {
            if holds(&self.truth()) {
                return elapsed;
            }
            self.step();
            elapsed += STEP.as_secs_f64();
        }
        panic!("not within {most_s} s: {:?}", self.truth());
    }

    pub(crate) fn truth(&self) -> Truth {
        self.world.truth(0)
    }

    fn listen(&mut self) {
        let mut bytes = Vec::new();
        self.world.take_output(self.port, &mut bytes);
        self.decoder.push(&bytes);
        while let Some(frame) = self.decoder.next_frame() {
            self.heard.push(frame);
        }
    }
}
