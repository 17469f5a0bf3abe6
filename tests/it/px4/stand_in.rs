//! A stand-in for a copter with PX4: NOT PX4, but a script that answers as PX4's public sources say it does
//! (`Commander.cpp`, `navigator_main.cpp`, `takeoff.cpp`, `mavlink_parameters.cpp`, `mavlink_events.cpp`). Its flight is
//! the simplest that shows the same telemetry.

use mavlink::dialects::ardupilotmega::{
    AUTOPILOT_VERSION_DATA, COMMAND_ACK_DATA, COMMAND_INT_DATA, COMMAND_LONG_DATA,
    CURRENT_EVENT_SEQUENCE_DATA, ESTIMATOR_STATUS_DATA, EVENT_DATA, EXTENDED_SYS_STATE_DATA,
    EstimatorStatusFlags, GLOBAL_POSITION_INT_DATA, HEARTBEAT_DATA, HOME_POSITION_DATA,
    MavAutopilot, MavCmd, MavEventCurrentSequenceFlags, MavFrame, MavLandedState, MavMessage,
    MavModeFlag, MavParamType, MavProtocolCapability, MavResult, MavSeverity, MavState,
    MavSysStatusSensor, MavType, PARAM_SET_DATA, PARAM_VALUE_DATA,
    SET_POSITION_TARGET_LOCAL_NED_DATA, STATUSTEXT_DATA, SYS_STATUS_DATA,
};

/// Home's height above sea level, in metres.
pub const HOME_AMSL_M: f64 = 488.0;
/// Home in 1e-7 degrees.
pub const HOME_E7: (i32, i32) = (473_977_000, 85_456_000);
/// The time between two calls of [`Px4::step`], in milliseconds.
pub const STEP_MS: u32 = 100;

const LOITER: (u8, u8) = (4, 3);
const TAKEOFF: (u8, u8) = (4, 2);
const RTL: (u8, u8) = (4, 5);
const LAND: (u8, u8) = (4, 6);
const POSCTL: (u8, u8) = (3, 0);
pub const OFFBOARD: (u8, u8) = (6, 0);

/// How long setpoints must arrive before OFFBOARD, in milliseconds.
const OFFBOARD_AFTER_MS: u32 = 1000;

/// Climb and descent per step, in metres.
const CLIMB_M: f64 = 0.5;
/// The way per step, in 1e-7 degrees: about 1 m.
const WAY_E7: i32 = 90;

/// What a stand-in does not do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unwilling {
    /// The checks before arming fail.
    Arm,
    /// OFFBOARD is refused, whatever arrives.
    EnterOffboard,
    /// Changes to AUTO.LOITER are ignored without an answer.
    HearLoiter,
    /// It keeps its values, and reports them.
    TakeValues,
}

/// The state of the stand-in.
#[derive(Debug)]
pub struct Px4 {
    clock_ms: u32,
    pub mode: (u8, u8),
    pub armed: bool,
    /// What it does not do, if anything.
    pub unwilling: Option<Unwilling>,
    height_m: f64,
    goal_m: f64,
    at_e7: (i32, i32),
    goal_e7: (i32, i32),
    /// When the first of an unbroken stream of setpoints came, and the last.
    stream_ms: Option<(u32, u32)>,
    /// The velocity of the last setpoint: north, east, down in m/s.
    velocity_m_s: [f32; 3],
    /// The longest gap between setpoints (`COM_OF_LOSS_T`), in milliseconds.
    pub longest_gap_ms: u32,
    /// The events so far; the number of each is its place.
    events: Vec<EVENT_DATA>,
    /// `COM_RC_IN_MODE`, an `INT32`.
    pub stick_mode: i32,
    /// Commands with an unexpected content.
    pub faults: Vec<String>,
}

impl Px4 {
    pub fn new() -> Self {
        Self {
            clock_ms: 10_000,
            mode: LOITER,
            armed: false,
            unwilling: None,
            height_m: 0.0,
            goal_m: 0.0,
            at_e7: HOME_E7,
            goal_e7: HOME_E7,
            stream_ms: None,
            velocity_m_s: [0.0; 3],
            longest_gap_ms: 1000,
            events: Vec::new(),
            stick_mode: 1,
            faults: Vec::new(),
        }
    }

    /// The height above home, in metres.
    pub fn height_m(&self) -> f64 {
        self.height_m
    }

    /// The position in 1e-7 degrees.
    pub fn at_e7(&self) -> (i32, i32) {
        self.at_e7
    }

    /// The velocity of the last setpoint, in m/s.
    pub fn velocity_m_s(&self) -> [f32; 3] {
        self.velocity_m_s
    }

    /// Adds an event, and returns its message.
    pub fn event(&mut self, id: u32, level: u8) -> MavMessage {
        let event = EVENT_DATA {
            id,
            event_time_boot_ms: self.clock_ms,
            sequence: self.events.len() as u16,
            log_levels: level << 4 | level,
            ..EVENT_DATA::DEFAULT
        };
        self.events.push(event.clone());
        MavMessage::EVENT(event)
    }

    /// Answers a message.
    pub fn hear(&mut self, message: &MavMessage) -> Vec<MavMessage> {
        match message {
            MavMessage::COMMAND_LONG(long) => self.long(long),
            MavMessage::COMMAND_INT(int) => self.int(int),
            MavMessage::PARAM_REQUEST_LIST(_) => vec![self.stick(0), gain(1)],
            MavMessage::PARAM_REQUEST_READ(read) => match read.param_id.to_str() {
                Ok("COM_RC_IN_MODE") => vec![self.stick(0)],
                Ok("MPC_XY_P") => vec![gain(1)],
                _ => Vec::new(),
            },
            MavMessage::PARAM_SET(set) => self.set(set),
            MavMessage::SET_POSITION_TARGET_LOCAL_NED(setpoint) => {
                self.take_setpoint(setpoint);
                Vec::new()
            }
            MavMessage::REQUEST_EVENT(asked) => {
                let wanted = asked.first_sequence..=asked.last_sequence;
                let kept = self.events.iter();
                let found = kept.filter(|event| wanted.contains(&event.sequence));
                found.cloned().map(MavMessage::EVENT).collect()
            }
            _ => Vec::new(),
        }
    }

    /// Flies on for [`STEP_MS`], and returns the telemetry.
    pub fn step(&mut self) -> Vec<MavMessage> {
        self.clock_ms += STEP_MS;
        self.fly();
        let mut said = vec![self.position(), self.landed_state()];
        if self.clock_ms.is_multiple_of(500) {
            said.extend([
                self.heartbeat(),
                health(self.unwilling == Some(Unwilling::Arm)),
                estimator(),
            ]);
            if let Some(last) = self.events.last() {
                let current = CURRENT_EVENT_SEQUENCE_DATA {
                    sequence: last.sequence,
                    flags: MavEventCurrentSequenceFlags::empty(),
                };
                said.push(MavMessage::CURRENT_EVENT_SEQUENCE(current));
            }
        }
        said
    }

    fn take_setpoint(&mut self, setpoint: &SET_POSITION_TARGET_LOCAL_NED_DATA) {
        let now = self.clock_ms;
        let unbroken = self
            .stream_ms
            .filter(|(_, last)| now - last <= self.longest_gap_ms);
        self.stream_ms = Some((unbroken.map_or(now, |(first, _)| first), now));
        self.velocity_m_s = [setpoint.vx, setpoint.vy, setpoint.vz];
    }

    /// Whether setpoints have arrived for long enough, and still do.
    fn has_stream(&self) -> bool {
        self.stream_ms.is_some_and(|(first, last)| {
            last - first > OFFBOARD_AFTER_MS && self.clock_ms - last <= self.longest_gap_ms
        })
    }

    /// Flies at the velocity of the setpoints. Without them, PX4's failsafe leaves the mode (`COM_OBL_RC_ACT` 0).
    fn follow_setpoints(&mut self) {
        if !self.has_stream() {
            self.mode = POSCTL;
            return;
        }
        let seconds = f64::from(STEP_MS) / 1000.0;
        let [north, east, down] = self.velocity_m_s.map(f64::from);
        self.at_e7.0 += (north * seconds * 90.0) as i32;
        self.at_e7.1 += (east * seconds * 90.0) as i32;
        self.height_m -= down * seconds;
        (self.goal_e7, self.goal_m) = (self.at_e7, self.height_m);
    }

    fn fly(&mut self) {
        if !self.armed {
            return;
        }
        if self.mode == OFFBOARD {
            return self.follow_setpoints();
        }
        let near = |at: i32, goal: i32| at + (goal - at).clamp(-WAY_E7, WAY_E7);
        self.at_e7 = (
            near(self.at_e7.0, self.goal_e7.0),
            near(self.at_e7.1, self.goal_e7.1),
        );
        let is_there = self.at_e7 == self.goal_e7;
        if self.mode == LAND || self.mode == RTL && is_there {
            self.goal_m = 0.0;
        }
        self.height_m += (self.goal_m - self.height_m).clamp(-CLIMB_M, CLIMB_M);
        let is_up = (self.goal_m - self.height_m).abs() < 0.1;
        if self.mode == TAKEOFF && is_up {
            self.mode = LOITER;
        }
        if [LAND, RTL].contains(&self.mode) && self.height_m <= 0.0 {
            // PX4 returns to a mode in which it can be armed.
            (self.armed, self.mode) = (false, LOITER);
        }
    }

    fn long(&mut self, long: &COMMAND_LONG_DATA) -> Vec<MavMessage> {
        let ack = |result| vec![ack(long.command, result)];
        let accepted = MavResult::MAV_RESULT_ACCEPTED;
        match long.command {
            MavCmd::MAV_CMD_REQUEST_MESSAGE => match long.param1 as u32 {
                148 => vec![version(), ack(accepted).remove(0)],
                242 => vec![home(), ack(accepted).remove(0)],
                _ => ack(MavResult::MAV_RESULT_UNSUPPORTED),
            },
            MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL => ack(accepted),
            MavCmd::MAV_CMD_COMPONENT_ARM_DISARM => self.arm(long),
            MavCmd::MAV_CMD_DO_SET_MODE => {
                let mode = (long.param2 as u8, long.param3 as u8);
                if mode == LOITER && self.unwilling == Some(Unwilling::HearLoiter) {
                    return Vec::new();
                }
                if mode == OFFBOARD
                    && (self.unwilling == Some(Unwilling::EnterOffboard) || !self.has_stream())
                {
                    return ack(MavResult::MAV_RESULT_TEMPORARILY_REJECTED);
                }
                self.mode = (long.param2 as u8, long.param3 as u8);
                self.goal_m = self.height_m;
                ack(accepted)
            }
            MavCmd::MAV_CMD_NAV_TAKEOFF => {
                if !long.param5.is_nan() || !long.param6.is_nan() {
                    self.faults.push("a takeoff to another place".to_owned());
                }
                self.mode = TAKEOFF;
                self.goal_m = (f64::from(long.param7) - HOME_AMSL_M).max(self.height_m);
                ack(accepted)
            }
            MavCmd::MAV_CMD_NAV_LAND => {
                self.mode = LAND;
                ack(accepted)
            }
            MavCmd::MAV_CMD_NAV_RETURN_TO_LAUNCH => {
                (self.mode, self.goal_e7) = (RTL, HOME_E7);
                ack(accepted)
            }
            _ => ack(MavResult::MAV_RESULT_UNSUPPORTED),
        }
    }

    fn int(&mut self, int: &COMMAND_INT_DATA) -> Vec<MavMessage> {
        let changes_mode = int.param2 as u32 == 1;
        if int.command != MavCmd::MAV_CMD_DO_REPOSITION || !changes_mode {
            return vec![ack(int.command, MavResult::MAV_RESULT_UNSUPPORTED)];
        }
        // PX4 does not look at the frame.
        if int.frame != MavFrame::MAV_FRAME_GLOBAL {
            self.faults.push("a height above home".to_owned());
        }
        self.mode = LOITER;
        self.goal_e7 = (int.x, int.y);
        self.goal_m = f64::from(int.z) - HOME_AMSL_M;
        vec![ack(int.command, MavResult::MAV_RESULT_ACCEPTED)]
    }

    fn arm(&mut self, long: &COMMAND_LONG_DATA) -> Vec<MavMessage> {
        let arms = long.param1 as i32 == 1;
        if arms && self.unwilling == Some(Unwilling::Arm) {
            let text = "Preflight Fail: ekf2 missing data\t";
            let reason = MavMessage::STATUSTEXT(STATUSTEXT_DATA {
                severity: MavSeverity::MAV_SEVERITY_CRITICAL,
                text: text.into(),
                ..STATUSTEXT_DATA::DEFAULT
            });
            let event = self.event(17_001_234, 2);
            let refused = MavResult::MAV_RESULT_TEMPORARILY_REJECTED;
            return vec![reason, event, ack(long.command, refused)];
        }
        self.armed = arms;
        vec![
            ack(long.command, MavResult::MAV_RESULT_ACCEPTED),
            self.heartbeat(),
        ]
    }

    /// PX4 refuses a value of another type than the parameter's.
    fn set(&mut self, set: &PARAM_SET_DATA) -> Vec<MavMessage> {
        if set.param_id.to_str() != Ok("COM_RC_IN_MODE") {
            return Vec::new();
        }
        if set.param_type != MavParamType::MAV_PARAM_TYPE_INT32 {
            self.faults.push("a parameter of another type".to_owned());
            return Vec::new();
        }
        if self.unwilling != Some(Unwilling::TakeValues) {
            self.stick_mode = set.param_value.to_bits().cast_signed();
        }
        vec![self.stick(u16::MAX)]
    }

    fn stick(&self, index: u16) -> MavMessage {
        MavMessage::PARAM_VALUE(PARAM_VALUE_DATA {
            param_id: "COM_RC_IN_MODE".into(),
            param_value: f32::from_bits(self.stick_mode.cast_unsigned()),
            param_type: MavParamType::MAV_PARAM_TYPE_INT32,
            param_count: 2,
            param_index: index,
        })
    }

    fn heartbeat(&self) -> MavMessage {
        let (main, sub) = self.mode;
        let custom = MavModeFlag::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED;
        let armed = MavModeFlag::MAV_MODE_FLAG_SAFETY_ARMED;
        MavMessage::HEARTBEAT(HEARTBEAT_DATA {
            custom_mode: u32::from_le_bytes([0, 0, main, sub]),
            mavtype: MavType::MAV_TYPE_QUADROTOR,
            autopilot: MavAutopilot::MAV_AUTOPILOT_PX4,
            base_mode: if self.armed { custom | armed } else { custom },
            system_status: MavState::MAV_STATE_STANDBY,
            mavlink_version: 3,
        })
    }

    fn position(&self) -> MavMessage {
        let moves = self.armed && self.mode == OFFBOARD;
        let [vx, vy, vz] = self
            .velocity_m_s
            .map(|speed| if moves { (speed * 100.0) as i16 } else { 0 });
        MavMessage::GLOBAL_POSITION_INT(GLOBAL_POSITION_INT_DATA {
            time_boot_ms: self.clock_ms,
            lat: self.at_e7.0,
            lon: self.at_e7.1,
            alt: ((HOME_AMSL_M + self.height_m) * 1000.0) as i32,
            relative_alt: (self.height_m * 1000.0) as i32,
            vx,
            vy,
            vz,
            ..GLOBAL_POSITION_INT_DATA::DEFAULT
        })
    }

    fn landed_state(&self) -> MavMessage {
        let landed_state = if self.height_m <= 0.0 {
            MavLandedState::MAV_LANDED_STATE_ON_GROUND
        } else if self.mode == TAKEOFF {
            MavLandedState::MAV_LANDED_STATE_TAKEOFF
        } else if self.mode == LAND {
            MavLandedState::MAV_LANDED_STATE_LANDING
        } else {
            MavLandedState::MAV_LANDED_STATE_IN_AIR
        };
        MavMessage::EXTENDED_SYS_STATE(EXTENDED_SYS_STATE_DATA {
            landed_state,
            ..EXTENDED_SYS_STATE_DATA::DEFAULT
        })
    }
}

fn gain(index: u16) -> MavMessage {
    MavMessage::PARAM_VALUE(PARAM_VALUE_DATA {
        param_id: "MPC_XY_P".into(),
        param_value: 0.95,
        param_type: MavParamType::MAV_PARAM_TYPE_REAL32,
        param_count: 2,
        param_index: index,
    })
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

fn version() -> MavMessage {
    MavMessage::AUTOPILOT_VERSION(AUTOPILOT_VERSION_DATA {
        capabilities: MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE
            | MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_COMMAND_INT
            | MavProtocolCapability::MAV_PROTOCOL_CAPABILITY_MAVLINK2,
        flight_sw_version: u32::from_be_bytes([1, 15, 4, 255]),
        uid: 7,
        ..AUTOPILOT_VERSION_DATA::DEFAULT
    })
}

fn home() -> MavMessage {
    MavMessage::HOME_POSITION(HOME_POSITION_DATA {
        latitude: HOME_E7.0,
        longitude: HOME_E7.1,
        altitude: (HOME_AMSL_M * 1000.0) as i32,
        ..HOME_POSITION_DATA::DEFAULT
    })
}

fn health(is_unfit: bool) -> MavMessage {
    let checks = MavSysStatusSensor::MAV_SYS_STATUS_PREARM_CHECK;
    MavMessage::SYS_STATUS(SYS_STATUS_DATA {
        onboard_control_sensors_present: checks,
        onboard_control_sensors_enabled: checks,
        onboard_control_sensors_health: if is_unfit {
            MavSysStatusSensor::empty()
        } else {
            checks
        },
        voltage_battery: 16_200,
        battery_remaining: 90,
        ..SYS_STATUS_DATA::DEFAULT
    })
}

fn estimator() -> MavMessage {
    MavMessage::ESTIMATOR_STATUS(ESTIMATOR_STATUS_DATA {
        flags: EstimatorStatusFlags::ESTIMATOR_ATTITUDE
            | EstimatorStatusFlags::ESTIMATOR_POS_HORIZ_ABS
            | EstimatorStatusFlags::ESTIMATOR_POS_VERT_ABS,
        ..ESTIMATOR_STATUS_DATA::DEFAULT
    })
}
