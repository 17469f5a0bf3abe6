//! No English remains in Ukrainian texts: Latin letters are used for names only.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::time::Duration;

use fluent_syntax::ast::{Entry, Expression, InlineExpression, Pattern, PatternElement};
use sortie::app::state::Room;
use sortie::commands::{
    AckResult, ArmingCommand, Command, Destination, DeviceCommand, FlightCommand, Heading,
    MotionCommand, ParameterCommand, explain,
};
use sortie::fleet::Unreachable;
use sortie::inspector::Definitions;
use sortie::language::{Context, Kind, Unit, complete, hint, parse, rows};
use sortie::ledger::RowState;
use sortie::link::{Address, LinkState};
use sortie::store;
use sortie::text::{Language, Locale, Text, messages};
use sortie::vehicle::{FixType, Vehicle, VehicleClass};

/// Names that are in no table (of protocols, programs, keys and units), and words that the user
/// types.
const NAMES: &[&str] = &[
    // Protocols, instruments and programs.
    "AHRS ASCII failsafe ArduCopter ArduPilot CRC DGPS EKF English FAILSAFE GPS HDOP HEARTBEAT IPv6 JSON Linux MAVFTP MAVLink PX4 NAT RC RTK RX SITL SQLite TOML DataFlash TCP TX UDP USB UTC UTF Zenoh",
    "sortie arducopter SORTIE_ARDUCOPTER pid tlog heartbeat ok root setgid",
    // A key of exams with its values, and an option.
    "layout own same public key take_over",
    // Keys.
    "Ctrl Enter Esc Tab WASD R1 g1 w3 w3/12 p3",
    // Parameters of rovers and planes.
    "CIRC_RADIUS CIRC_SPEED WP_LOITER_RAD WP_SPEED AIRSPEED_MIN AIRSPEED_MAX TRIM_THROTTLE",
    // Formats of plans, and the programs that write them.
    "MPC_Z_VEL_MAX_UP MPC_Z_VEL_MAX_DN MPC_YAWRAUTO_MAX GF_ACTION OFFBOARD QGC WPL plan MAVProxy KML KMZ kml GeoJSON XML QGroundControl SRTM deflate NAV_DELAY DISARM_DELAY",
    // Units that are not part of an argument.
    "B B/s cr g in kB/s kB MB kg mm min Hz V A dB km mAh ms Wh PM2 CO CH4 e7 NaN Ah GHz MHz mW W kW kg rpm/V uSv MiB GiB",
    // Kinds of batteries and radios.
    "LiPo Li ion LoRa Wi Fi S C",
    // Placeholders in a line to type.
    "BAUD DEVICE FILE HOST NAME PATH PLACE PORT TARGETS TERM _",
    // Parts of MAVLink's names and of parameters' names.
    "COMMAND_INT COMMAND_LONG COMPONENT_METADATA MAV_CMD MAV_FRAME SERIALn_BAUD SERIALn_PROTOCOL SYSID_ENFORCE SYSID_MYGCS MAV_GCS_SYSID SYSID_THISMAV MAV_SYSID CONTROL_STATUS RC_CHANNELS_OVERRIDE",
    // Addresses, options and files.
    "api data docs event features file hangar-token parameter token serial tcp tcpin udp udpbcast udpin plain run xFD xFE xterm",
    // Words of filters, and of the plain console.
    "air alert bat invert status peak",
    // Words in the user's files: themes, keymaps, missions.
    "dark dumb false filter id inherits light none objectives off one profile record roles rrggbb true try two red yes",
];

/// The words of the tables, which are typed and therefore the same in every language.
fn from_tables() -> BTreeSet<String> {
    let mut words = BTreeSet::new();
    let mut add = |word: &str| words.extend(parts(word).map(str::to_owned));
    for row in rows() {
        add(row.name());
        row.aliases.iter().copied().for_each(&mut add);
        row.examples.iter().copied().for_each(&mut add);
        for argument in row.forms.iter().flat_map(|form| form.arguments) {
            add(argument.keyword);
            add(&argument.name.to_uppercase());
            if let Kind::Choice(choices) = argument.kind {
                choices.iter().copied().for_each(&mut add);
            }
        }
    }
    for room in Room::ALL {
        add(room.name());
    }
    for unit in [
        Unit::Metres,
        Unit::MetresPerSecond,
        Unit::Seconds,
        Unit::Degrees,
        Unit::DegreesPerSecond,
        Unit::Microseconds,
    ] {
        add(unit.symbol());
    }
    for class in [
        VehicleClass::Copter,
        VehicleClass::Plane,
        VehicleClass::Rover,
        VehicleClass::Sub,
        VehicleClass::Px4,
    ] {
        class.modes().iter().for_each(|(_, mode)| add(mode));
    }
    for (_, message) in Definitions::get().messages() {
        for field in &message.fields {
            add(&field.kind.to_string());
            add(field.unit);
            field.names.into_iter().for_each(&mut add);
        }
    }
    add("LAT LON all");
    NAMES.iter().copied().for_each(&mut add);
    words
}

/// The Latin words of a text.
fn parts(text: &str) -> impl Iterator<Item = &str> {
    let is_latin = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '/';
    text.split(move |c| !is_latin(c))
        .map(|word| word.trim_matches('/'))
        .filter(|word| word.contains(|c: char| c.is_ascii_alphabetic()))
}

/// The words of a text that are neither Ukrainian nor names. Text between backticks is skipped,
/// because the user types it.
fn strangers<'a>(text: &'a str, known: &BTreeSet<String>) -> Vec<&'a str> {
    let outside = text.split('`').step_by(2);
    outside
        .flat_map(parts)
        .filter(|word| {
            let is_figure = word.starts_with(|c: char| c.is_ascii_digit());
            word.len() > 1 && !is_figure && !known.contains(*word)
        })
        .collect()
}

/// The literal words of a pattern, in all its variants.
fn literals<'a>(pattern: &Pattern<&'a str>, found: &mut Vec<&'a str>) {
    for element in &pattern.elements {
        match element {
            PatternElement::TextElement { value } => found.push(value),
            PatternElement::Placeable { expression } => match expression {
                Expression::Select { variants, .. } => {
                    for variant in variants {
                        literals(&variant.value, found);
                    }
                }
                Expression::Inline(InlineExpression::StringLiteral { value }) => found.push(value),
                Expression::Inline(_) => {}
            },
        }
    }
}

#[test]
fn the_ukrainian_messages_have_latin_letters_in_names_only() {
    let known = from_tables();
    let mut wrong = Vec::new();
    for (area, source) in messages(Language::Ukrainian) {
        let resource = fluent_syntax::parser::parse(*source).expect("it parses");
        for entry in &resource.body {
            let Entry::Message(message) = entry else {
                continue;
            };
            let mut found = Vec::new();
            literals(message.value.as_ref().expect("a value"), &mut found);
            let text = found.join(" ");
            for word in strangers(&text, &known) {
                wrong.push(format!("{word} in {} ({area})", message.id.name));
            }
        }
    }
    assert!(wrong.is_empty(), "no names, or missing here: {wrong:#?}");
}

/// A thing that has two names reads as two things.
#[test]
fn a_brief_has_one_name() {
    for (area, source) in messages(Language::Ukrainian) {
        assert!(!source.to_lowercase().contains("брифінг"), "{area}");
    }
}

fn faults() -> Vec<Text> {
    let vehicles = [1, 2, 3];
    let context = Context {
        vehicles: &vehicles,
        ..Context::default()
    };
    let lines = [
        "",
        "fly",
        "all takeof 20",
        "takeoff",
        "takeoff high",
        "takeoff 2000",
        "takeoff 20ft",
        "takeoff 1e999",
        "takeoff 20 30",
        "5-2 arm",
        "0 arm",
        "7 arm",
        "1,,2 arm",
        "1,x arm",
        "@rad arm",
        "goto n 100",
        "goto n 1 e 1 keep face 3",
        "goto by",
        "goto home",
        "yaw -20",
        "velocity for 5",
        "velocity d 1 up 1 for 5",
        "orbit 0.5",
        "mode CRUISE",
        "relay 1 half",
        "servo 9 1500.5",
        "interval NONE 4",
        "request 99999999",
        "param get A-B",
        "long NONE",
        "long 99999",
        "wait 1 wait",
        "1 wait 2 armed",
        "speed up",
        "servo 3kg 1500",
    ];
    let faults = lines.iter().filter_map(|line| {
        let fault = parse(line, &context).err();
        assert!(fault.is_some(), "{line}");
        fault
    });
    faults
        .flat_map(|fault| [Some(fault.message), fault.help])
        .flatten()
        .collect()
}

/// All hints that the command line shows while each example is typed.
fn hints() -> Vec<Text> {
    let context = Context::default();
    let mut said = Vec::new();
    for row in rows() {
        said.push(row.summary());
        for example in row.examples {
            let ends = example.char_indices().filter(|(_, c)| *c == ' ');
            for end in ends.map(|(at, _)| at + 1).chain([0, example.len()]) {
                let line = &example[..end];
                said.extend(hint(line, &context));
                let found = complete(line, end, &context).into_iter();
                // The hints for the thousand names of MAVLink are similar.
                said.extend(found.take(60).map(|completion| completion.hint));
            }
        }
    }
    said
}

/// The results of commands to a vehicle: refusals, awaited effects, states.
fn outcomes() -> Vec<Text> {
    let unheard = Vehicle::new(3, 1);
    let commands = [
        Command::Arming(ArmingCommand::Arm),
        Command::Arming(ArmingCommand::Kill),
        Command::Device(DeviceCommand::Reboot),
        Command::Flight(FlightCommand::Land),
        Command::Flight(FlightCommand::Hold),
        Command::Flight(FlightCommand::Takeoff { altitude_m: 5.0 }),
        Command::Motion(MotionCommand::Altitude { altitude_m: 5.0 }),
        Command::Flight(FlightCommand::SetMode {
            name: "GUIDED".to_owned(),
        }),
        Command::Motion(MotionCommand::Goto {
            destination: Destination::Local {
                north_m: 1.0,
                east_m: 1.0,
                up_m: Some(5.0),
            },
            heading: Heading::Auto,
        }),
        Command::Motion(MotionCommand::Velocity {
            ned_m_s: [1.0; 3],
            lasting: Duration::from_secs(5),
        }),
        Command::Motion(MotionCommand::Yaw {
            angle_deg: 10.0,
            relative: true,
            rate_deg_s: None,
        }),
        Command::Motion(MotionCommand::Orbit {
            radius_m: 5.0,
            speed_m_s: 1.0,
            centre: None,
            altitude_m: None,
        }),
        Command::Parameter(ParameterCommand::Set {
            name: "A".to_owned(),
            value: f64::NAN,
        }),
        Command::Parameter(ParameterCommand::Get {
            name: String::new(),
        }),
    ];
    let mut said = Vec::new();
    for command in &commands {
        said.extend(command.request(&unheard, 0).err());
        said.push(command.effect(&unheard).describe(&unheard));
        for result in 0..=10 {
            let result = AckResult::from_wire(result);
            said.push(explain("arm", result, &[], &unheard, command));
        }
    }
    for state in [
        RowState::Queued,
        RowState::Sent,
        RowState::InProgress(50),
        RowState::Accepted,
        RowState::Done,
        RowState::NoEffect,
        RowState::Refused,
        RowState::TimedOut,
        RowState::Superseded,
    ] {
        said.extend([state.text(), state.name()]);
    }
    said
}

fn states() -> Vec<Text> {
    let mut said = vec![Text::from(Unreachable)];
    let retry_in = Duration::from_secs(1);
    let links = [
        LinkState::Connecting,
        LinkState::Up,
        LinkState::Waiting { retry_in },
        LinkState::Ended,
    ];
    said.extend(links.map(LinkState::text));
    said.extend((0..8).map(|fix| FixType::from_wire(fix).text()));
    for address in [
        "", "1", "2:3:4:5", "tcp:", "tcp:1:0", "tcp:[1:2", "serial:", "file:",
    ] {
        said.extend(
            address
                .parse::<Address>()
                .err()
                .map(|error| Text::from(&error)),
        );
    }
    let missing = store::mission("99").expect_err("there is none");
    said.push(Text::from(&missing));
    said
}

/// The words in the names of missions and drills.
fn names_of_missions() -> Vec<String> {
    let missions = Path::new(env!("CARGO_MANIFEST_DIR")).join("missions");
    let mut words = Vec::new();
    for folder in [missions.join("drills"), missions] {
        for entry in fs::read_dir(folder).expect("readable").flatten() {
            let name = entry.file_name().into_string().expect("plain letters");
            if let Some(id) = name.strip_suffix(".toml") {
                words.extend(parts(id).map(str::to_owned));
            }
        }
    }
    words
}

#[test]
fn verbs_faults_outcomes_and_states_read_as_ukrainian() {
    let mut known = from_tables();
    // Names in examples, of missions, and of the commands and messages that are completed.
    known.insert("PreArm".to_owned());
    known.extend(names_of_missions());
    let locale = Locale::new(Language::Ukrainian);
    let all = [hints(), faults(), outcomes(), states()].concat();
    assert!(all.len() > 500, "the walk finds little: {}", all.len());
    let mut wrong = BTreeSet::new();
    for text in all {
        let words = locale.text(&text);
        for word in strangers(&words, &known) {
            wrong.insert(format!("{word} in \"{words}\""));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
