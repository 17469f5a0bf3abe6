//! A stand-in for rovers, boats and planes with `ArduPilot`: NOT `ArduPilot`, but a script that answers as the sources of
//! Rover and `ArduPlane` 4.6 say they do (`GCS_Mavlink.cpp`, `mode_guided.cpp`). Its movement is the simplest that shows the
//! same telemetry.

use mavlink::dialects::ardupilotmega::{
    COMMAND_ACK_DATA, COMMAND_INT_DATA, COMMAND_LONG_DATA, EXTENDED_SYS_STATE_DATA,
    GLOBAL_POSITION_INT_DATA, HEARTBEAT_DATA, HOME_POSITION_DATA, LOCAL_POSITION_NED_DATA,
    MavAutopilot, MavCmd, MavLandedState, MavMessage, MavModeFlag, MavParamType, MavResult,
    MavState, MavType, PARAM_VALUE_DATA, POSITION_TARGET_GLOBAL_INT_DATA,
    SET_POSITION_TARGET_LOCAL_NED_DATA,
};
use sortie::geo::{LatLon, maths};
use sortie::vehicle::{Mode, VehicleClass};

/// Home, where the vehicle begins.
pub const HOME: LatLon = LatLon::new(50.45, 30.52);
const HOME_AMSL_M: f64 = 120.0;
/// The time between two calls of [`StandIn::step`], in milliseconds.
pub const STEP_MS: u32 = 100;
/// The way per step, in metres.
const WAY_M: f64 = 0.4;
/// A rover stops this far from its goal (`WP_RADIUS`).
const STOPS_M: f64 = 2.0;
/// A plane circles at this distance from its goal (`WP_LOITER_RAD`).
const CIRCLE_M: f64 = 60.0;
/// The height above home at which a plane returns (`RTL_ALTITUDE`).
const RETURN_HEIGHT_M: f64 = 50.0;
/// The item at which a plane continues its plan after a landing.
const LANDING_ITEM: u16 = 4;

/// The state of the stand-in.
#[derive(Debug)]
pub struct StandIn {
    mav_type: MavType,
    class: VehicleClass,
    clock_ms: u32,
    mode: u32,
    pub armed: bool,
    /// Metres north and east of home.
    pub at_m: [f64; 2],
    pub height_m: f64,
    pub goal_m: Option<[f64; 2]>,
    /// The height above home of the goal, in metres.
    pub goal_height_m: f64,
    /// The item of its plan at which it continues.
    pub plan_item: u16,
    speed_m_s: f64,
    /// `Q_ENABLE` of a plane.
    pub hovers: bool,
    /// The commands and setpoints that it has received, apart from questions.
    pub heard: Vec<String>,
    /// The last setpoint of a velocity.
    pub velocity: Option<SET_POSITION_TARGET_LOCAL_NED_DATA>,
}

impl StandIn {
    pub fn new(mav_type: MavType) -> Self {
        let class = VehicleClass::from_mav_type(mav_type as u8);
        Self {
            mav_type,
            class,
            clock_ms: 10_000,
            mode: 0,
            armed: false,
            at_m: [0.0; 2],
            height_m: 0.0,
            goal_m: None,
            goal_height_m: 0.0,
            plan_item: LANDING_ITEM,
            speed_m_s: 0.0,
            hovers: false,
            heard: Vec::new(),
            velocity: None,
        }
    }

    pub fn mode(&self) -> &'static str {
        let (class, number) = (self.class, self.mode);
        Mode { class, number }.name().expect("a name")
    }

    pub fn set_mode(&mut self, name: &str) {
        let mode = self.class.mode(name).expect("a mode of this class");
        if mode.number != self.mode {
            self.mode = mode.number;
            self.goal_m = (name == "RTL").then_some([0.0; 2]);
            if self.class == VehicleClass::Plane {
                self.goal_height_m = RETURN_HEIGHT_M;
            }
        }
    }

    /// Answers a message.
    pub fn hear(&mut self, message: &MavMessage) -> Vec<MavMessage> {
        match message {
            MavMessage::COMMAND_LONG(long) => self.long(long),
            MavMessage::COMMAND_INT(int) => self.int(int),
            MavMessage::SET_POSITION_TARGET_LOCAL_NED(target) => self.target(target),
            MavMessage::SET_POSITION_TARGET_GLOBAL_INT(target) => {
                let goal = LatLon::from_e7(target.lat_int, target.lon_int);
                self.heard.push("global setpoint".to_owned());
                self.go(goal);
                Vec::new()
            }
            MavMessage::PARAM_REQUEST_READ(_) | MavMessage::PARAM_REQUEST_LIST(_) => {
                vec![self.parameter()]
            }
            _ => Vec::new(),
        }
    }

    fn long(&mut self, long: &COMMAND_LONG_DATA) -> Vec<MavMessage> {
        let answer = |result| vec![ack(long.command, result)];
        let is_question = [
            MavCmd::MAV_CMD_REQUEST_MESSAGE,
            MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL,
        ];
        if is_question.contains(&long.command) {
            return match long.param1 as u32 {
                242 => vec![home(), ack(long.command, MavResult::MAV_RESULT_ACCEPTED)],
                _ => answer(MavResult::MAV_RESULT_UNSUPPORTED),
            };
        }
        self.heard
            .push(format!("{:?} {}", long.command, long.param1));
        match long.command {
            MavCmd::MAV_CMD_COMPONENT_ARM_DISARM => self.armed = long.param1 > 0.5,
            MavCmd::MAV_CMD_DO_SET_MODE => {
                let (class, number) = (self.class, long.param2 as u32);
                let name = Mode { class, number }.name().expect("a mode");
                self.set_mode(name);
            }
            MavCmd::MAV_CMD_NAV_RETURN_TO_LAUNCH => self.set_mode("RTL"),
            MavCmd::MAV_CMD_MISSION_START => self.set_mode("AUTO"),
            MavCmd::MAV_CMD_DO_SET_MISSION_CURRENT => self.plan_item = long.param1 as u16,
            MavCmd::MAV_CMD_NAV_TAKEOFF if self.hovers => self.height_m = long.param7.into(),
            // A rover that has no place to go takes no speed.
            MavCmd::MAV_CMD_DO_CHANGE_SPEED if self.goal_m.is_none() => {
                return answer(MavResult::MAV_RESULT_FAILED);
            }
            MavCmd::MAV_CMD_DO_CHANGE_SPEED => {}
            _ => return answer(MavResult::MAV_RESULT_UNSUPPORTED),
        }
        vec![
            ack(long.command, MavResult::MAV_RESULT_ACCEPTED),
            self.heartbeat(),
        ]
    }

    fn int(&mut self, int: &COMMAND_INT_DATA) -> Vec<MavMessage> {
        self.heard.push(format!("{:?}", int.command));
        if int.command != MavCmd::MAV_CMD_DO_REPOSITION {
            return vec![ack(int.command, MavResult::MAV_RESULT_UNSUPPORTED)];
        }
        self.height_m = int.z.into();
        self.goal_height_m = self.height_m;
        self.go(LatLon::from_e7(int.x, int.y));
        vec![ack(int.command, MavResult::MAV_RESULT_ACCEPTED)]
    }

    fn target(&mut self, target: &SET_POSITION_TARGET_LOCAL_NED_DATA) -> Vec<MavMessage> {
        self.heard.push("local setpoint".to_owned());
        if target.type_mask.bits() & 1 == 0 {
            self.goal_m = Some([target.x.into(), target.y.into()]);
        } else {
            self.velocity = Some(target.clone());
        }
        Vec::new()
    }

    fn go(&mut self, goal: LatLon) {
        let (north_m, east_m) = HOME.offset_to(goal);
        self.goal_m = Some([north_m, east_m]);
    }

    /// Moves on for [`STEP_MS`], and returns the telemetry.
    pub fn step(&mut self) -> Vec<MavMessage> {
        self.clock_ms += STEP_MS;
        self.advance();
        let mut said = vec![self.position(), self.local()];
        said.extend(self.position_target());
        if self.class == VehicleClass::Plane {
            said.push(self.landed_state());
        }
        if self.clock_ms.is_multiple_of(500) {
            said.push(self.heartbeat());
        }
        said
    }

    fn advance(&mut self) {
        self.speed_m_s = 0.0;
        let (Some(goal), true) = (self.goal_m, self.armed) else {
            return;
        };
        let way = [0, 1].map(|axis| goal[axis] - self.at_m[axis]);
        let left_m = maths::hypot(way[0], way[1]);
        let is_plane = self.class == VehicleClass::Plane;
        let stops_m = if is_plane { CIRCLE_M } else { STOPS_M };
        let is_there = left_m <= stops_m;
        if is_there && !is_plane {
            return;
        }
        // A plane flies on, along its circle.
        let course = if is_there { [-way[1], way[0]] } else { way };
        for axis in [0, 1] {
            self.at_m[axis] += course[axis] / left_m.max(0.1) * WAY_M;
        }
        self.speed_m_s = WAY_M * 1000.0 / f64::from(STEP_MS);
    }

    fn heartbeat(&self) -> MavMessage {
        let custom = MavModeFlag::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED;
        let armed = MavModeFlag::MAV_MODE_FLAG_SAFETY_ARMED;
        MavMessage::HEARTBEAT(HEARTBEAT_DATA {
            custom_mode: self.mode,
            mavtype: self.mav_type,
            autopilot: MavAutopilot::MAV_AUTOPILOT_ARDUPILOTMEGA,
            base_mode: if self.armed { custom | armed } else { custom },
            system_status: MavState::MAV_STATE_ACTIVE,
            mavlink_version: 3,
        })
    }

    fn position(&self) -> MavMessage {
        let (lat, lon) = HOME.moved(self.at_m[0], self.at_m[1]).to_e7();
        MavMessage::GLOBAL_POSITION_INT(GLOBAL_POSITION_INT_DATA {
            time_boot_ms: self.clock_ms,
            lat,
            lon,
            alt: ((HOME_AMSL_M + self.height_m) * 1000.0) as i32,
            relative_alt: (self.height_m * 1000.0) as i32,
            vx: (self.speed_m_s * 100.0) as i16,
            ..GLOBAL_POSITION_INT_DATA::DEFAULT
        })
    }

    fn local(&self) -> MavMessage {
        MavMessage::LOCAL_POSITION_NED(LOCAL_POSITION_NED_DATA {
            time_boot_ms: self.clock_ms,
            x: self.at_m[0] as f32,
            y: self.at_m[1] as f32,
            z: -self.height_m as f32,
            vx: self.speed_m_s as f32,
            ..LOCAL_POSITION_NED_DATA::DEFAULT
        })
    }

    fn position_target(&self) -> Option<MavMessage> {
        let [north_m, east_m] = self.goal_m?;
        let (lat_int, lon_int) = HOME.moved(north_m, east_m).to_e7();
        Some(MavMessage::POSITION_TARGET_GLOBAL_INT(
            POSITION_TARGET_GLOBAL_INT_DATA {
                time_boot_ms: self.clock_ms,
                lat_int,
                lon_int,
                alt: (HOME_AMSL_M + self.goal_height_m) as f32,
                ..POSITION_TARGET_GLOBAL_INT_DATA::DEFAULT
            },
        ))
    }

    fn landed_state(&self) -> MavMessage {
        MavMessage::EXTENDED_SYS_STATE(EXTENDED_SYS_STATE_DATA {
            landed_state: if self.height_m > 0.0 {
                MavLandedState::MAV_LANDED_STATE_IN_AIR
            } else {
                MavLandedState::MAV_LANDED_STATE_ON_GROUND
            },
            ..EXTENDED_SYS_STATE_DATA::DEFAULT
        })
    }

    fn parameter(&self) -> MavMessage {
        MavMessage::PARAM_VALUE(PARAM_VALUE_DATA {
            param_id: "Q_ENABLE".into(),
            param_value: f32::from(u8::from(self.hovers)),
            param_type: MavParamType::MAV_PARAM_TYPE_INT8,
            param_count: 1,
            param_index: 0,
        })
    }
}

fn ack(command: MavCmd, result: MavResult) -> MavMessage {
    MavMessage::COMMAND_ACK(COMMAND_ACK_DATA {
        command,
        result,
        target_system: 255,
        target_component: 190,
        ..COMMAND_ACK_DATA::DEFAULT
    })
}

fn home() -> MavMessage {
    let (latitude, longitude) = HOME.to_e7();
    MavMessage::HOME_POSITION(HOME_POSITION_DATA {
        latitude,
        longitude,
        altitude: (HOME_AMSL_M * 1000.0) as i32,
        ..HOME_POSITION_DATA::DEFAULT
    })
}
