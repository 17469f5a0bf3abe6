//! Rovers, boats and planes with `ArduPilot`: conversations of a session with a scripted stand-in. A real `ArduRover` is in
//! `ardurover`; no `ArduPlane` takes part.

use std::time::Duration;

use mavlink::dialects::ardupilotmega::{MavMessage, MavType};
use sortie::commands::{
    ArmingCommand, Command, Destination, FlightCommand, Heading, MotionCommand, PlanFlight, suits,
};
use sortie::language::{self, Findings, Seen, Situation, Until};
use sortie::ledger::{EntryId, Given, Ledger, Risk, RowState, RowUpdate};
use sortie::session::{Report, Session, VehicleCommand};
use sortie::vehicle::{SpeedAxis, Vehicles};
use sortie::wire::{Decoder, Encoder, Outgoing};

mod stand_in;

use stand_in::{HOME, STEP_MS, StandIn};

/// A session and a stand-in, which hear each other at once.
struct Talk {
    craft: StandIn,
    session: Session,
    encoder: Encoder,
    decoder: Decoder,
    now: Duration,
    rows: Vec<RowUpdate>,
    ledger: Ledger,
}

impl Talk {
    fn new(mav_type: MavType) -> Self {
        let mut talk = Self {
            craft: StandIn::new(mav_type),
            session: Session::new(1, 1, Duration::ZERO),
            encoder: Encoder::new(1, 1),
            decoder: Decoder::new(),
            now: Duration::ZERO,
            rows: Vec::new(),
            ledger: Ledger::new(),
        };
        talk.pass(3);
        talk
    }

    /// A vehicle that is armed in GUIDED.
    fn guided(mav_type: MavType) -> Self {
        let mut talk = Self::new(mav_type);
        talk.craft.set_mode("GUIDED");
        talk.craft.armed = true;
        talk.pass(1);
        talk
    }

    fn pass(&mut self, seconds: u32) {
        for _ in 0..seconds * 1000 / STEP_MS {
            self.now += Duration::from_millis(STEP_MS.into());
            let said = self.craft.step();
            self.carry(said);
            self.session.poll(self.now);
            self.settle();
        }
    }

    fn carry(&mut self, said: Vec<MavMessage>) {
        for message in said {
            let mut bytes = Vec::new();
            self.encoder.encode_message(&message, &mut bytes);
            self.decoder.push(&bytes);
            while let Some(frame) = self.decoder.next_frame() {
                self.session.receive(&frame, self.now);
            }
        }
    }

    /// Carries answers until both are silent.
    fn settle(&mut self) {
        loop {
            for report in self.session.take_reports() {
                match report {
                    Report::Row(row) => {
                        self.ledger.apply(&row);
                        self.rows.push(row);
                    }
                    Report::Notice(_) | Report::Folder(_) => {}
                }
            }
            let sent = self.session.take_outgoing();
            if sent.is_empty() {
                return;
            }
            for message in sent {
                let answers = match message {
                    Outgoing::Message(message) => self.craft.hear(&message),
                    Outgoing::Raw { id, payload } => self.hear_raw(id, &payload),
                };
                self.carry(answers);
            }
        }
    }

    /// A command that this program encodes itself, read again.
    fn hear_raw(&mut self, id: u32, payload: &[u8]) -> Vec<MavMessage> {
        use mavlink::{MavlinkVersion, Message as _};
        let read = MavMessage::parse(MavlinkVersion::V2, id, payload);
        read.map(|message| self.craft.hear(&message))
            .unwrap_or_default()
    }

    /// Gives an order; returns its entry.
    fn order(&mut self, verb: &str, command: Command) -> EntryId {
        let verb = language::verb(verb).expect("a verb");
        let given = Given {
            line: verb.name,
            verb,
            risk: Risk::None,
        };
        let entry = self.ledger.open(self.now, given, &[1]);
        let order = VehicleCommand::new(entry, verb, command);
        self.session.order(order, self.now);
        self.settle();
        entry
    }

    /// Whether `wait arrived` is over.
    fn has_arrived(&self) -> bool {
        let seen = Seen {
            vehicles: &Vehicles::default(),
            ledger: &self.ledger,
            findings: &Findings::default(),
        };
        Until::Situation(Situation::Arrived).holds(self.session.vehicle(), seen)
    }

    fn last(&self, entry: EntryId) -> Option<RowState> {
        let rows = self.rows.iter().rev();
        let mut own = rows.filter(|row| row.entry == entry);
        own.next().map(|row| row.state)
    }

    fn explanation(&self, entry: EntryId) -> String {
        let rows = self.rows.iter().rev();
        let mut own = rows.filter(|row| row.entry == entry);
        own.find_map(|row| row.explanation.as_ref().map(ToString::to_string))
            .unwrap_or_default()
    }

    /// Gives orders that the console refuses, with these words, before anything is sent.
    fn assert_unsuited(&mut self, orders: &[(&str, Command, &str)]) {
        for (verb, command, words) in orders {
            let heard = self.craft.heard.len();
            let entry = self.order(verb, command.clone());
            self.pass(1);
            let why = self.explanation(entry);
            assert_eq!(self.last(entry), Some(RowState::Refused), "{verb}: {why}");
            assert!(why.contains(words), "{verb}: {why}");
            let sent = self.craft.heard.get(heard..).unwrap_or_default();
            assert_eq!(sent, [""; 0], "{verb}");
        }
    }
}

fn goto(north_m: f64, east_m: f64) -> Command {
    Command::Motion(MotionCommand::Goto {
        destination: Destination::Global {
            at_point: HOME.moved(north_m, east_m),
            altitude_m: None,
        },
        heading: Heading::Auto,
    })
}

fn takeoff() -> Command {
    Command::Flight(FlightCommand::Takeoff { altitude_m: 10.0 })
}

fn land() -> Command {
    Command::Flight(FlightCommand::Land)
}

fn resume() -> Command {
    Command::Flight(FlightCommand::Resume)
}

fn hold() -> Command {
    Command::Flight(FlightCommand::Hold)
}

fn rtl() -> Command {
    Command::Flight(FlightCommand::ReturnToLaunch)
}

fn altitude() -> Command {
    Command::Motion(MotionCommand::Altitude { altitude_m: 10.0 })
}

fn yaw() -> Command {
    Command::Motion(MotionCommand::Yaw {
        angle_deg: 90.0,
        relative: false,
        rate_deg_s: None,
    })
}

fn orbit() -> Command {
    Command::Motion(MotionCommand::Orbit {
        radius_m: 20.0,
        speed_m_s: 3.0,
        centre: None,
        altitude_m: None,
    })
}

fn velocity(ned_m_s: [f64; 3]) -> Command {
    Command::Motion(MotionCommand::Velocity {
        ned_m_s,
        lasting: Duration::from_secs(2),
    })
}

fn speed(axis: SpeedAxis) -> Command {
    Command::Motion(MotionCommand::Speed {
        axis,
        speed_m_s: 3.0,
    })
}

const ROVER: MavType = MavType::MAV_TYPE_GROUND_ROVER;
const BOAT: MavType = MavType::MAV_TYPE_SURFACE_BOAT;
const PLANE: MavType = MavType::MAV_TYPE_FIXED_WING;

#[test]
fn verbs_that_do_not_suit_a_rover_are_refused_before_anything_is_sent() {
    let mut talk = Talk::guided(ROVER);
    talk.assert_unsuited(&[
        (
            "takeoff",
            takeoff(),
            "it is a rover, which does not take off",
        ),
        ("land", land(), "`1 rtl` brings it back"),
        ("altitude", altitude(), "no height to change"),
        ("yaw", yaw(), "a rover turns only as it moves"),
        ("orbit", orbit(), "mode circle"),
        ("resume", resume(), "`1 plan resume`"),
        ("speed", speed(SpeedAxis::Climb), "neither climbs nor"),
        ("velocity", velocity([1.0, 0.0, -1.0]), "neither climbs nor"),
    ]);
    let mut talk = Talk::guided(BOAT);
    talk.assert_unsuited(&[("takeoff", takeoff(), "it is a boat")]);
}

#[test]
fn joint_manoeuvres_are_for_vehicles_that_hover() {
    for mav_type in [ROVER, BOAT, PLANE] {
        let talk = Talk::guided(mav_type);
        for verb in [
            "formation",
            "follow",
            "survey",
            "search",
            "spread",
            "relay to",
        ] {
            let verb = language::verb(verb).expect("a verb");
            let refused = suits(verb, talk.session.vehicle(), true).expect_err(verb.name);
            assert!(refused.to_string().contains("plan survey"), "{refused}");
        }
    }
}

#[test]
fn a_rover_has_arrived_where_it_stops_short_of_its_goal() {
    let mut talk = Talk::guided(ROVER);
    // A road uphill is not in the air.
    talk.craft.height_m = 12.0;
    let order = talk.order("goto", goto(30.0, 0.0));
    talk.pass(3);
    assert_eq!(talk.last(order), Some(RowState::Sent));
    let vehicle = talk.session.vehicle();
    assert!(!vehicle.airborne() && vehicle.is_under_way() && vehicle.moves());
    talk.pass(8);
    assert_eq!(talk.last(order), Some(RowState::Done));
    assert!((talk.craft.at_m[0] - 28.0).abs() < 0.5);
    assert!(!talk.session.vehicle().moves());
}

#[test]
fn a_rover_holds_in_hold_and_a_boat_in_loiter() {
    for (mav_type, mode) in [(ROVER, "HOLD"), (BOAT, "LOITER"), (PLANE, "LOITER")] {
        let mut talk = Talk::guided(mav_type);
        let order = talk.order("hold", hold());
        talk.pass(1);
        assert_eq!(talk.craft.mode(), mode);
        assert_eq!(talk.last(order), Some(RowState::Done));
    }
}

#[test]
fn the_return_of_a_rover_is_done_when_it_stands_at_home() {
    let mut talk = Talk::guided(ROVER);
    let order = talk.order("goto", goto(0.0, 40.0));
    talk.pass(12);
    assert_eq!(talk.last(order), Some(RowState::Done));
    let order = talk.order("rtl", rtl());
    talk.pass(2);
    assert_eq!(talk.craft.mode(), "RTL");
    assert_eq!(talk.last(order), Some(RowState::Accepted));
    assert!(!talk.has_arrived());
    talk.pass(10);
    assert_eq!(talk.last(order), Some(RowState::Done));
    assert!(talk.has_arrived());
    assert!(talk.craft.armed, "a rover does not disarm itself");
}

#[test]
fn a_rover_in_smart_rtl_has_arrived_when_it_stands_at_home() {
    let mut talk = Talk::guided(ROVER);
    talk.craft.at_m = [0.0, 20.0];
    let name = "SMART_RTL".to_owned();
    talk.order("mode", Command::Flight(FlightCommand::SetMode { name }));
    talk.pass(2);
    // The target of this mode is the next place on the way back.
    talk.craft.goal_m = Some(talk.craft.at_m);
    talk.pass(1);
    assert!(!talk.has_arrived());
    (talk.craft.at_m, talk.craft.goal_m) = ([0.0, 1.0], None);
    talk.pass(1);
    assert!(talk.has_arrived());
}

#[test]
fn a_plan_goes_on_after_a_rover_has_held() {
    let mut talk = Talk::guided(ROVER);
    talk.craft.set_mode("HOLD");
    talk.pass(1);
    let order = talk.order(
        "plan resume",
        Command::PlanFlight(PlanFlight::Resume { item: None }),
    );
    // It has no plan, which is the only reason.
    let why = talk.explanation(order);
    assert!(!why.contains("on the ground"), "{why}");
}

#[test]
fn a_rover_that_stops_keeps_the_heading_of_its_velocity() {
    let mut talk = Talk::guided(ROVER);
    talk.order("velocity", velocity([0.0, 1.5, 0.0]));
    talk.pass(3);
    let last = talk.craft.velocity.expect("a setpoint");
    assert_eq!((last.vx, last.vy), (0.0, 0.0));
    assert!((last.yaw.to_degrees() - 90.0).abs() < 0.1);
    assert_eq!(last.type_mask.bits() & 0x400, 0, "the heading counts");
}

#[test]
fn a_rover_without_a_place_to_go_takes_no_speed_and_the_reason_says_so() {
    let mut talk = Talk::guided(ROVER);
    let order = talk.order("speed", speed(SpeedAxis::Ground));
    talk.pass(8);
    assert_eq!(talk.last(order), Some(RowState::Refused));
    let why = talk.explanation(order);
    assert!(why.contains("`goto` first"), "{why}");
    talk.craft.set_mode("STEERING");
    talk.pass(1);
    let order = talk.order("speed", speed(SpeedAxis::Ground));
    talk.pass(8);
    let why = talk.explanation(order);
    assert!(why.contains("STEERING"), "{why}");
}

#[test]
fn verbs_that_do_not_suit_a_plane_are_refused_before_anything_is_sent() {
    let mut talk = Talk::guided(PLANE);
    talk.assert_unsuited(&[("goto", goto(500.0, 0.0), "`1 mode takeoff`")]);
    talk.craft.height_m = 50.0;
    talk.pass(1);
    talk.assert_unsuited(&[
        ("takeoff", takeoff(), "`1 mode takeoff`"),
        ("land", land(), "a plane lands by plan"),
        ("yaw", yaw(), "a plane turns only as it moves"),
        ("velocity", velocity([10.0, 0.0, 0.0]), "`1 speed`"),
        ("orbit", orbit(), "WP_LOITER_RAD"),
        ("resume", resume(), "`1 plan resume`"),
        ("speed", speed(SpeedAxis::Climb), "TECS_CLMB_MAX"),
    ]);
}

#[test]
fn a_plane_has_arrived_when_it_circles_around_its_goal() {
    let mut talk = Talk::guided(PLANE);
    talk.craft.height_m = 50.0;
    talk.pass(1);
    let order = talk.order("goto", goto(150.0, 0.0));
    talk.pass(5);
    assert_eq!(talk.last(order), Some(RowState::Accepted));
    assert_eq!(
        talk.craft.heard.last().map(String::as_str),
        Some("MAV_CMD_DO_REPOSITION")
    );
    talk.pass(20);
    assert_eq!(talk.last(order), Some(RowState::Done));
    let order = talk.order("speed", speed(SpeedAxis::Ground));
    talk.pass(1);
    assert_eq!(talk.last(order), Some(RowState::Done));
    // The type of the speed: 0 is airspeed.
    assert_eq!(
        talk.craft.heard.last().map(String::as_str),
        Some("MAV_CMD_DO_CHANGE_SPEED 0")
    );
}

#[test]
fn a_plane_is_back_when_it_circles_above_home() {
    let mut talk = Talk::guided(PLANE);
    (talk.craft.height_m, talk.craft.at_m) = (50.0, [200.0, 0.0]);
    talk.pass(1);
    let order = talk.order("rtl", rtl());
    talk.pass(5);
    assert_eq!(talk.last(order), Some(RowState::Accepted));
    talk.pass(30);
    assert_eq!(talk.last(order), Some(RowState::Done));
    assert!(talk.has_arrived() && talk.session.vehicle().airborne());
}

#[test]
fn a_plane_that_hovers_may_take_off() {
    let mut talk = Talk::guided(PLANE);
    talk.craft.hovers = true;
    talk.session.fetch_parameters(talk.now);
    talk.pass(2);
    let order = talk.order("takeoff", takeoff());
    talk.pass(2);
    assert_eq!(
        talk.last(order),
        Some(RowState::Done),
        "{}",
        talk.explanation(order)
    );
    let mut talk = Talk::guided(MavType::MAV_TYPE_VTOL_TILTROTOR);
    talk.craft.hovers = true;
    let order = talk.order("takeoff", takeoff());
    talk.pass(2);
    assert_eq!(talk.last(order), Some(RowState::Done));
}

#[test]
fn arming_and_modes_are_those_of_the_class() {
    let mut talk = Talk::new(ROVER);
    let order = talk.order("arm", Command::Arming(ArmingCommand::Arm));
    talk.pass(1);
    assert_eq!(talk.last(order), Some(RowState::Done));
    for mode in [
        "MANUAL",
        "ACRO",
        "STEERING",
        "HOLD",
        "LOITER",
        "CIRCLE",
        "SMART_RTL",
        "GUIDED",
    ] {
        let name = mode.to_owned();
        let order = talk.order("mode", Command::Flight(FlightCommand::SetMode { name }));
        talk.pass(2);
        assert_eq!(
            (talk.craft.mode(), talk.last(order)),
            (mode, Some(RowState::Done))
        );
    }
    let name = "ALT_HOLD".to_owned();
    let order = talk.order("mode", Command::Flight(FlightCommand::SetMode { name }));
    assert_eq!(talk.last(order), Some(RowState::Refused));
    let order = talk.order("disarm", Command::Arming(ArmingCommand::Disarm));
    talk.pass(1);
    assert_eq!(talk.last(order), Some(RowState::Done));
}
