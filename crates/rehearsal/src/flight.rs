//! One vehicle of a rehearsal: its start, and the record of its flight.

use sortie_geo::LatLon;
use sortie_plan::{Fence, FenceArea, command};
use sortie_sim::mavlink::dialects::ardupilotmega::{
    COMMAND_LONG_DATA, MavCmd, MavMessage, MavParamType, PARAM_SET_DATA,
};
use sortie_sim::mavlink::types::CharArray;
use sortie_sim::{PortId, SYSTEMS, Truth, World};
use sortie_wire::Encoder;

use crate::place::{Place, Track, sample_s};
use crate::{FlightEnding, Flown, Participant};

/// The numbers of ArduCopter's modes.
const AUTO: u8 = 3;
const GUIDED: f32 = 4.0;
/// The time after which a vehicle that is armed on the ground disarms, in seconds; 0 for never.
pub(crate) const DISARM_DELAY: &str = "DISARM_DELAY";
/// The time between two attempts to start, in samples, and the maximum number of attempts.
const RETRY: u32 = 50;
const ATTEMPTS: u32 = 30;

/// A vehicle that stays on the ground for this long during a return will not take off again; a
/// landing takes a few seconds.
const STUCK_S: f64 = 60.0;

/// The messages that are kept, and the time between two of them in microseconds: `SYS_STATUS`, `SYSTEM_TIME`,
/// `GPS_RAW_INT`, `ATTITUDE`, `LOCAL_POSITION_NED`, `GLOBAL_POSITION_INT`, `MISSION_CURRENT`, `NAV_CONTROLLER_OUTPUT`,
/// `VFR_HUD`, `BATTERY_STATUS`, `EKF_STATUS_REPORT`, `HOME_POSITION`, `EXTENDED_SYS_STATE`.
const TELEMETRY: &[u16] = &[1, 2, 24, 30, 32, 33, 42, 62, 74, 147, 193, 242, 245];
const TELEMETRY_EVERY_US: f32 = 250_000.0;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Stage {
    /// On the ground; contains the number of attempts to start.
    Waiting(u32),
    /// The motors are running; `lifted` is whether the vehicle has left the ground.
    Flying {
        lifted: bool,
    },
    Over,
}

/// The ground station of one vehicle, and the results of its flight.
#[derive(Debug)]
pub(crate) struct Flight {
    vehicle: usize,
    port: Option<PortId>,
    encoder: Encoder,
    /// The bytes that the vehicle has sent; `None` without a listener.
    heard: Option<Vec<u8>>,
    stage: Stage,
    /// The start time, in samples.
    starts_at: u32,
    started_at: Option<u32>,
    areas: Vec<FenceArea<[f64; 2]>>,
    is_fence_on: bool,
    /// How long the vehicle has been on the ground after its takeoff, in samples.
    grounded: u32,
    commands: Vec<u16>,
    flown: Flown,
    capacity_mah: f64,
    pub(crate) track: Track,
}

impl Flight {
    pub(crate) fn new(
        vehicle: usize,
        participant: &Participant,
        place: &Place,
        world: &mut World,
    ) -> Self {
        let fence = Fence::check(&participant.document.fence).unwrap_or_default();
        let metres = |point: &LatLon| <[f64; 2]>::from(place.start.at.offset_to(*point));
        Self {
            vehicle,
            port: Some(world.connect(vehicle)),
            encoder: Encoder::new(255, 190),
            heard: None,
            stage: Stage::Waiting(0),
            starts_at: (participant.delay_s / sample_s()).round().max(0.0) as u32,
            started_at: None,
            areas: fence.areas.iter().map(|area| area.map(metres)).collect(),
            is_fence_on: false,
            grounded: 0,
            commands: participant
                .document
                .plan
                .iter()
                .map(|item| item.command)
                .collect(),
            flown: Flown {
                time_s: 0.0,
                energy_used_percent: 0.0,
                farthest_m: 0.0,
                broke_fence_s: None,
                has_fence: !fence.areas.is_empty(),
                was_kept_armed: false,
                ending: FlightEnding::TimeUp,
                moved_east_m: place.moved_east_m,
            },
            capacity_mah: world.parameter(vehicle, "BATT_CAPACITY").max(1.0),
            track: Track::default(),
        }
    }

    fn system(&self) -> u8 {
        (self.vehicle % SYSTEMS) as u8 + 1
    }

    pub(crate) fn is_over(&self) -> bool {
        self.stage == Stage::Over
    }

    pub(crate) fn flown(&self) -> Flown {
        self.flown
    }

    pub(crate) fn set_parameter(&mut self, world: &mut World, name: &str, value: f32) {
        let message = MavMessage::PARAM_SET(PARAM_SET_DATA {
            param_value: value,
            target_system: self.system(),
            target_component: 1,
            param_id: CharArray::from(name),
            param_type: MavParamType::MAV_PARAM_TYPE_REAL32,
        });
        self.send(world, message);
        self.capacity_mah = world.parameter(self.vehicle, "BATT_CAPACITY").max(1.0);
    }

    fn command(&mut self, world: &mut World, command: MavCmd, [param1, param2]: [f32; 2]) {
        let message = MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
            command,
            param1,
            param2,
            target_system: self.system(),
            target_component: 1,
            ..Default::default()
        });
        self.send(world, message);
    }

    fn send(&mut self, world: &mut World, message: MavMessage) {
        let Some(port) = self.port else { return };
        let mut bytes = Vec::new();
        self.encoder.encode(&message.into(), &mut bytes);
        world.receive(port, &bytes);
        // The answers are not needed: their effect shows in the vehicle's true state.
        let heard = self.heard.as_mut();
        world.take_output(port, heard.unwrap_or(&mut Vec::new()));
    }

    /// Requests telemetry, and keeps everything that the vehicle sends from now on.
    pub(crate) fn listen(&mut self, world: &mut World) {
        for id in TELEMETRY {
            let request = [f32::from(*id), TELEMETRY_EVERY_US];
            self.command(world, MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL, request);
        }
        self.heard = Some(Vec::new());
    }

    /// The bytes that the vehicle has sent since the last call.
    pub(crate) fn take_heard(&mut self, world: &mut World) -> Vec<u8> {
        let Some(heard) = &mut self.heard else {
            return Vec::new();
        };
        if let Some(port) = self.port {
            world.take_output(port, heard);
        }
        std::mem::take(heard)
    }

    /// Follows the vehicle for one sample. Returns whether it is in the air.
    pub(crate) fn follow(&mut self, sample: u32, world: &mut World) -> bool {
        let truth = world.truth(self.vehicle);
        match self.stage {
            Stage::Waiting(attempts) => self.try_to_start(attempts, sample, &truth, world),
            Stage::Flying { lifted } => {
                let lifted = lifted || !truth.on_ground;
                let is_back_down = lifted && truth.on_ground;
                self.grounded = if is_back_down { self.grounded + 1 } else { 0 };
                self.stage = Stage::Flying { lifted };
                self.note(sample, &truth);
                if let Some(ending) = self.ending(&truth, lifted) {
                    self.end(ending);
                }
            }
            Stage::Over => {}
        }
        !truth.on_ground
    }

    fn try_to_start(&mut self, attempts: u32, sample: u32, truth: &Truth, world: &mut World) {
        if sample < self.starts_at || !(sample - self.starts_at).is_multiple_of(RETRY) {
            return;
        }
        if truth.armed && truth.mode == AUTO {
            return;
        }
        self.command(world, MavCmd::MAV_CMD_DO_SET_MODE, [1.0, GUIDED]);
        self.command(world, MavCmd::MAV_CMD_COMPONENT_ARM_DISARM, [1.0, 0.0]);
        self.command(world, MavCmd::MAV_CMD_MISSION_START, [0.0, 0.0]);
        let truth = world.truth(self.vehicle);
        if truth.armed && truth.mode == AUTO {
            self.started_at = Some(sample);
            self.stage = Stage::Flying { lifted: false };
            // Unread telemetry would take most of the computing time.
            if let Some(port) = self.port.take_if(|_| self.heard.is_none()) {
                world.disconnect(port);
            }
        } else if attempts >= ATTEMPTS {
            self.end(FlightEnding::Grounded);
        } else {
            self.stage = Stage::Waiting(attempts + 1);
        }
    }

    fn note(&mut self, sample: u32, truth: &Truth) {
        let begun = self.started_at.unwrap_or(sample);
        let [north_m, east_m, _] = truth.position_ned_m;
        let time_s = f64::from(sample - begun) * sample_s();
        self.flown.time_s = time_s;
        let used = truth.battery_consumed_mah / self.capacity_mah;
        self.flown.energy_used_percent = 100.0 * used.min(1.0);
        let away_m = (north_m * north_m + east_m * east_m).sqrt();
        self.flown.farthest_m = self.flown.farthest_m.max(away_m);
        let is_broken = self.is_fence_broken(truth, [north_m, east_m]);
        if self.flown.broke_fence_s.is_none() && !truth.on_ground && is_broken {
            self.flown.broke_fence_s = Some(time_s);
        }
    }

    /// Whether the fence is broken: as the vehicle reports it if the fence is switched on,
    /// otherwise by the areas of its list.
    fn is_fence_broken(&self, truth: &Truth, point: [f64; 2]) -> bool {
        if self.is_fence_on {
            return truth.broken_fences != 0;
        }
        self.areas.iter().any(|area| area.is_broken_at(point))
    }

    /// Switches the fence on or off by a command, unless `switch` is `None`, and records whether it
    /// is on.
    pub(crate) fn switch_fence(&mut self, switch: Option<bool>, world: &mut World) {
        if let Some(on) = switch {
            let on = f32::from(u8::from(on));
            self.command(world, MavCmd::MAV_CMD_DO_FENCE_ENABLE, [on, 0.0]);
        }
        self.is_fence_on = world.parameter(self.vehicle, "FENCE_ENABLE") > 0.0;
        self.flown.has_fence |= self.is_fence_on;
    }

    /// Sets `DISARM_DELAY` to 0, so the vehicle waits on the ground with its motors running.
    pub(crate) fn keep_armed(&mut self, world: &mut World) {
        self.set_parameter(world, DISARM_DELAY, 0.0);
        self.flown.was_kept_armed = true;
    }

    /// Ends the flight because of a collision, even after the end of its plan.
    pub(crate) fn crash(&mut self) {
        self.end(FlightEnding::Crashed);
    }

    fn end(&mut self, ending: FlightEnding) {
        self.flown.ending = ending;
        self.stage = Stage::Over;
    }

    fn ending(&self, truth: &Truth, lifted: bool) -> Option<FlightEnding> {
        if !truth.armed {
            return Some(match (lifted, truth.mode) {
                (false, _) => FlightEnding::Grounded,
                (true, AUTO) => FlightEnding::Landed,
                (true, mode) => FlightEnding::LeftPlan(mode),
            });
        }
        let is_under_way = truth.mode == AUTO && lifted;
        if truth.on_ground {
            let is_ended = self.flies_to(truth.plan_item) || self.cannot_return(truth.plan_item);
            let has_hit = is_under_way && !truth.plan_complete && is_ended;
            return has_hit.then_some(FlightEnding::HitGround(truth.plan_item));
        }
        (is_under_way && truth.plan_complete).then_some(FlightEnding::InAir)
    }

    /// Whether the vehicle stays on the ground at a return, with its motors on: its battery can no
    /// longer lift it.
    fn cannot_return(&self, item: u16) -> bool {
        let returns = self.command_of(item) == Some(command::RETURN_TO_LAUNCH);
        returns && f64::from(self.grounded) * sample_s() >= STUCK_S
    }

    fn command_of(&self, item: u16) -> Option<u16> {
        let index = usize::from(item).checked_sub(1)?;
        self.commands.get(index).copied()
    }

    /// Whether an item, counted from 1, leads to a place in the air, so the vehicle must not touch
    /// the ground on the way.
    fn flies_to(&self, item: u16) -> bool {
        self.command_of(item).is_some_and(|command| {
            matches!(
                command,
                command::WAYPOINT
                    | command::SPLINE_WAYPOINT
                    | command::LOITER_UNLIMITED
                    | command::LOITER_TURNS
                    | command::LOITER_TIME
                    | command::LOITER_TO_ALTITUDE
            )
        })
    }
}
