use proptest::prelude::*;

use super::*;
use crate::commands::{
    Act, ArmingCommand, Command, Destination, DeviceCommand, FlightCommand, Heading, MotionCommand,
    ParameterCommand, PlanFlight, QueryCommand, RawCommand, RawMessage,
};
use crate::inspector::WrittenPayload;
use crate::vehicle::SpeedAxis;

mod console;
mod drafts;
mod faults;
mod modes;

pub(super) fn places() -> BTreeMap<String, LatLon> {
    BTreeMap::from([
        ("tower".to_owned(), LatLon::new(50.45, 30.52)),
        ("c3".to_owned(), LatLon::new(50.46, 30.53)),
    ])
}

static LANES: std::sync::LazyLock<BTreeMap<String, Outline>> = std::sync::LazyLock::new(|| {
    let corner = LatLon::new(50.45, 30.52);
    BTreeMap::from([("lane".to_owned(), Outline::square(corner, 100.0))])
});

pub(super) fn groups() -> Groups {
    BTreeMap::from([("red".to_owned(), vec![1, 3]), ("none".to_owned(), vec![])])
}

/// Parses a line with vehicles 1 to 8, the group `red` and the place `tower`.
fn read(line: &str) -> Result<Statement, crate::diagnostic::Diagnostic> {
    let (groups, places) = (groups(), places());
    parse(line, &context(&groups, &places))
}

pub(super) fn context<'a>(groups: &'a Groups, places: &'a BTreeMap<String, LatLon>) -> Context<'a> {
    Context {
        groups,
        places: Some(places),
        areas: Some(&LANES),
        vehicles: &[1, 2, 3, 4, 5, 6, 7, 8],
        class: VehicleClass::Copter,
        parameters: None,
        ..Context::default()
    }
}

#[test]
fn where_places_are_unknown_every_name_is_one_but_words_stay_words() {
    let anywhere = Context {
        places: None,
        ..Context::default()
    };
    for good in ["1 goto pad", "1 goto A1 up 20", "1 goto n 10 e 0 up 20"] {
        assert!(parse(good, &anywhere).is_ok(), "{good}");
    }
    for bad in ["1 goto", "1 goto A1 B2", "1 goto A1 up high", "1 goto 50.4"] {
        assert!(parse(bad, &anywhere).is_err(), "{bad}");
    }
    let known = parse("1 goto n 10 e 0", &Context::default());
    assert_eq!(parse("1 goto n 10 e 0", &anywhere), known);
}

fn command(line: &str) -> Command {
    match read(line).map(|statement| statement.meaning) {
        Ok(Meaning::Act(Act::Command(command))) => command,
        other => panic!("{line}: {other:?}"),
    }
}

fn goto(destination: Destination, heading: Heading) -> Command {
    Command::Motion(MotionCommand::Goto {
        destination,
        heading,
    })
}

#[test]
fn lines_about_flying_become_the_commands_they_say() {
    let local = |up_m| Destination::Local {
        north_m: 100.0,
        east_m: -50.0,
        up_m,
    };
    let tower = Destination::Global {
        at_point: LatLon::new(50.45, 30.52),
        altitude_m: Some(40.0),
    };
    let cases = [
        ("all ARM", Command::Arming(ArmingCommand::Arm)),
        (
            "takeoff 0.02km",
            Command::Flight(FlightCommand::Takeoff { altitude_m: 20.0 }),
        ),
        (
            "guided",
            Command::Flight(FlightCommand::SetMode {
                name: "GUIDED".to_owned(),
            }),
        ),
        (
            "mode alt_hold",
            Command::Flight(FlightCommand::SetMode {
                name: "ALT_HOLD".to_owned(),
            }),
        ),
        (
            "mode 27",
            Command::Flight(FlightCommand::SetMode {
                name: "27".to_owned(),
            }),
        ),
        ("land", Command::Flight(FlightCommand::Land)),
        ("plan pause", Command::PlanFlight(PlanFlight::Pause)),
        (
            "plan resume",
            Command::PlanFlight(PlanFlight::Resume { item: None }),
        ),
        (
            "plan resume from 7",
            Command::PlanFlight(PlanFlight::Resume { item: Some(7) }),
        ),
        (
            "plan resume 7",
            Command::PlanFlight(PlanFlight::Resume { item: Some(7) }),
        ),
        ("plan skip", Command::PlanFlight(PlanFlight::Skip)),
        ("plan abort", Command::PlanFlight(PlanFlight::Abort)),
        (
            "plan goto 3",
            Command::PlanFlight(PlanFlight::Goto { item: 3 }),
        ),
        ("stop", Command::Flight(FlightCommand::Hold)),
        (
            "goto n 100 e -50 up 30",
            goto(local(Some(30.0)), Heading::Auto),
        ),
        ("goto e -50m n 100m keep", goto(local(None), Heading::Keep)),
        (
            "goto tower up 40 face 90°",
            goto(tower, Heading::Fixed(90.0)),
        ),
        ("goto 50.45 30.52 up 40", goto(tower, Heading::Auto)),
        (
            "goto by up 2",
            goto(
                Destination::Offset {
                    north_m: 0.0,
                    east_m: 0.0,
                    up_m: 2.0,
                },
                Heading::Auto,
            ),
        ),
        (
            "speed climb 2",
            Command::Motion(MotionCommand::Speed {
                axis: SpeedAxis::Climb,
                speed_m_s: 2.0,
            }),
        ),
        (
            "yaw 90 by rate 20",
            Command::Motion(MotionCommand::Yaw {
                angle_deg: 90.0,
                relative: true,
                rate_deg_s: Some(20.0),
            }),
        ),
    ];
    for (line, expected) in cases {
        assert_eq!(command(line), expected, "{line}");
    }
}

#[test]
fn other_lines_become_the_commands_they_say() {
    let cases = [
        (
            "vel e 2 up 1 for 1min",
            Command::Motion(MotionCommand::Velocity {
                ned_m_s: [0.0, 2.0, -1.0],
                lasting: std::time::Duration::from_secs(60),
            }),
        ),
        (
            "interval attitude 10",
            Command::Query(QueryCommand::Interval {
                message: 30,
                rate_hz: 10.0,
            }),
        ),
        (
            "param set wpnav_speed 500",
            Command::Parameter(ParameterCommand::Set {
                name: "WPNAV_SPEED".to_owned(),
                value: 500.0,
            }),
        ),
        (
            "roi off",
            Command::Motion(MotionCommand::RegionOfInterest { target: None }),
        ),
        (
            "relay 2 off",
            Command::Device(DeviceCommand::Relay {
                relay: 2,
                on: false,
            }),
        ),
        (
            "long 31000 1 -2.5",
            Command::Raw(RawCommand::Long {
                command: 31000,
                params: [1.0, -2.5, 0.0, 0.0, 0.0, 0.0, 0.0],
            }),
        ),
        (
            "send heartbeat type=GCS",
            Command::Raw(RawCommand::Message(RawMessage {
                id: 0,
                name: "HEARTBEAT",
                fields: "type=GCS".to_owned(),
                payload: WrittenPayload {
                    bytes: vec![0, 0, 0, 0, 6, 0, 0, 0, 0],
                    base_len: 9,
                    open_system: None,
                    open_component: None,
                },
            })),
        ),
        (
            "int DO_REPOSITION 6 -1 1 0 0 504501000 305234000 40",
            Command::Raw(RawCommand::Int {
                command: 192,
                frame: 6,
                params: [-1.0, 1.0, 0.0, 0.0],
                x: 504_501_000,
                y: 305_234_000,
                z: 40.0,
            }),
        ),
    ];
    for (line, expected) in cases {
        assert_eq!(command(line), expected, "{line}");
    }
}

#[test]
fn other_units_are_converted() {
    let Command::Motion(MotionCommand::Speed { axis, speed_m_s }) = command("speed 36km/h") else {
        panic!("no speed");
    };
    assert_eq!(axis, SpeedAxis::Ground);
    assert!((speed_m_s - 10.0).abs() < 1e-9);
}

#[test]
fn targets_are_read_sorted_and_written_back_short() {
    let cases = [
        ("arm", Targets::Selection, "arm"),
        ("all arm", Targets::All, "all arm"),
        (
            "7,1-4,2 arm # now",
            Targets::Ids(vec![1, 2, 3, 4, 7]),
            "1-4,7 arm",
        ),
        ("@red  stop", Targets::Group("red".to_owned()), "@red hold"),
        ("wait 5 armed", Targets::Ids(vec![5]), "wait 5 armed"),
        ("wait 5", Targets::Selection, "wait 5"),
        (
            "all wait altitude>19",
            Targets::All,
            "wait all altitude > 19",
        ),
    ];
    for (line, targets, normalised) in cases {
        let statement = read(line).expect(line);
        assert_eq!(
            (statement.targets, statement.line.as_str()),
            (targets, normalised),
            "{line}"
        );
    }
}

#[test]
fn the_vehicles_of_a_line_can_be_written_as_numbers() {
    let (groups, places) = (groups(), places());
    let context = context(&groups, &places);
    for (line, numbers) in [
        ("@red takeoff 20", "1,3 takeoff 20"),
        ("all land", "1-8 land"),
        ("2 land", "2 land"),
        ("land", "land"),
    ] {
        let statement = parse(line, &context).expect(line);
        let written = statement.in_numbers(&context).expect(line);
        assert_eq!(written.line, numbers);
        assert_eq!(parse(numbers, &context), Ok(written), "{line}");
    }
    let empty = parse("@none land", &context).expect("a line");
    assert!(empty.in_numbers(&context).is_err());
}

#[test]
fn every_example_parses_to_its_own_verb() {
    let (groups, places) = (groups(), places());
    let anywhere = Context {
        channel: Channel::Plain,
        ..context(&groups, &places)
    };
    for row in rows() {
        let needs_words = row.forms.iter().any(|form| !form.arguments.is_empty());
        assert!(
            !row.examples.is_empty() || !needs_words,
            "{row:?} has no example"
        );
        for example in row.examples {
            let said = parse(example, &anywhere).expect(example).verb;
            assert!(row.verbs().any(|verb| verb == said), "{example}");
        }
    }
}

#[test]
fn names_and_aliases_are_unique_and_tries_end_by_the_deadline() {
    let mut seen = std::collections::BTreeSet::new();
    for row in rows() {
        for name in std::iter::once(row.name()).chain(row.aliases.iter().copied()) {
            assert!(seen.insert(name), "{name} is there twice");
        }
        for verb in row.verbs() {
            let last_try = verb.retry.every * (u32::from(verb.retry.tries) - 1);
            assert!(last_try < verb.retry.deadline, "{verb:?}");
        }
    }
}

#[test]
fn arguments_of_a_form_have_different_names() {
    for row in rows() {
        for form in row.forms {
            let names: std::collections::BTreeSet<&str> = form
                .arguments
                .iter()
                .map(|argument| argument.name)
                .collect();
            assert_eq!(names.len(), form.arguments.len(), "{row:?}");
        }
    }
}

#[test]
fn targets_resolve_to_vehicles_or_say_why_not() {
    let (groups, places) = (groups(), places());
    let context = context(&groups, &places);
    let ids = |targets: Targets, selection: &[VehicleId]| targets.resolve(selection, &context);
    assert_eq!(ids(Targets::Selection, &[4, 2]), Ok(vec![4, 2]));
    assert_eq!(ids(Targets::Group("red".to_owned()), &[]), Ok(vec![1, 3]));
    assert_eq!(ids(Targets::All, &[1]).map(|all| all.len()), Ok(8));
    for (targets, reason) in [
        (Targets::Selection, "no vehicle is selected"),
        (Targets::Ids(vec![9]), "no vehicle 9"),
        (Targets::Group("none".to_owned()), "empty"),
        (Targets::Group("blue".to_owned()), "no group `@blue`"),
    ] {
        let fault = ids(targets, &[]).expect_err(reason);
        assert!(fault.contains(reason), "{fault}");
    }
}

#[test]
fn all_names_the_expected_vehicles_if_only_others_are_heard() {
    let expected = std::collections::BTreeSet::from([2, 3, 4]);
    let among = |vehicles| {
        let context = Context {
            vehicles,
            expected: &expected,
            ..Context::default()
        };
        Targets::All.resolve(&[], &context)
    };
    assert_eq!(among(&[1, 2]), Ok(vec![2]));
    let fault = among(&[1]).expect_err("a vehicle that is missing");
    assert!(
        fault.contains("never heard: 2-4; heard, but not expected: 1"),
        "{fault}"
    );
    let fault = among(&[]).expect_err("a vehicle that is missing");
    assert!(fault.contains("no vehicles yet"), "{fault}");
}

#[test]
fn the_manual_tells_about_every_verb() {
    let manual = manual();
    for row in rows() {
        assert!(
            manual.contains(&row.summary().to_string())
                && manual.contains(row.examples.first().copied().unwrap_or(row.name())),
            "{row:?}"
        );
    }
    assert!(
        manual.contains("goto n NORTH e EAST [up UP] [keep] [face HEADING]"),
        "{manual}"
    );
    assert!(manual.contains("60 s"), "{manual}");
}

/// Lines made of the language's own words, which test more of the parser than random letters.
fn likely_line() -> impl Strategy<Value = String> {
    let names: Vec<String> = rows().map(|row| row.name().to_owned()).collect();
    let word = prop_oneof![
        3 => proptest::sample::select(names),
        3 => proptest::sample::select(vec![
            "all", "3", "1-4,7", "@red", "n", "e", "up", "by", "keep", "face", "tower", "for", "rate", "here",
            "off", "on", "get", "set", "mode", "GUIDED", "altitude", ">", "<=", "timeout", "ATTITUDE", "#",
        ]).prop_map(str::to_owned),
        4 => (-500.0..500.0f64).prop_map(|number| format!("{number:.2}")),
        2 => (0..20_u8).prop_map(|number| number.to_string()),
        1 => "\\PC{0,6}",
    ];
    proptest::collection::vec(word, 0..9).prop_map(|words| words.join(" "))
}

proptest! {
    #[test]
    fn no_text_makes_the_reader_panic(line in "\\PC*", cursor in 0..80_usize) {
        let _ = read(&line);
        let _ = hint(&line, &Context::default());
        let _ = complete(&line, cursor, &Context::default());
        let _ = Script::parse(&line, &Context::default());
    }

    #[test]
    fn the_normalised_line_means_the_same(line in likely_line()) {
        if let Ok(statement) = read(&line) {
            prop_assert_eq!(read(&statement.line), Ok(statement));
        }
    }

    #[test]
    fn faults_and_completions_lie_within_the_line(line in likely_line(), cursor in 0..80_usize) {
        if let Err(fault) = read(&line) {
            prop_assert!(line.get(fault.span.clone()).is_some(), "{:?}", fault);
        }
        for completion in complete(&line, cursor, &Context::default()) {
            prop_assert!(line.get(completion.replaces.clone()).is_some(), "{:?}", completion);
        }
    }
}

#[test]
fn the_fields_of_a_message_keep_their_spelling() {
    for (line, canonical) in [
        (
            r#"3   SEND statustext   text="two  blanks #1"  severity = 2 # why"#,
            r#"3 send statustext text="two  blanks #1"  severity = 2"#,
        ),
        ("3 send 0", "3 send 0"),
    ] {
        let statement = read(line).expect(line);
        assert_eq!(statement.line, canonical);
        assert_eq!(read(canonical).expect(canonical), statement);
    }
}
