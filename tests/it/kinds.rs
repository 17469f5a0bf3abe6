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

mod planes;
mod rovers;
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
            by: None,
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
fn a_rover_holds_in_hold_and_a_boat_in_loiter() {
    for (mav_type, mode) in [(ROVER, "HOLD"), (BOAT, "LOITER"), (PLANE, "LOITER")] {
        let mut talk = Talk::guided(mav_type);
        let order = talk.order("hold", hold());
        talk.pass(1);
        assert_eq!(talk.craft.mode(), mode);
        assert_eq!(talk.last(order), Some(RowState::Done));
    }
}
