use std::process::Command;

use proptest::prelude::*;

use super::*;
use crate::geo::LatLon;
use crate::geo::maths;

fn recipe() -> Recipe {
    Recipe {
        kind: SitlKind::Copter,
        model: None,
        airframe: None,
        start: Start {
            at: LatLon::new(50.45, 30.52),
            altitude_amsl_m: 180.0,
            heading_deg: 90.0,
        },
        system: 7,
        speedup: 1.0,
        parameters: BTreeMap::new(),
    }
}

fn frame(motors: usize) -> String {
    format!(
        "{{\"num_motors\": {motors}, \"maxVoltage\": 16.8, \"battCapacityAh\": 5.0, \"hoverThrOut\": 0.33}}"
    )
}

fn with(parameters: &[(&str, f64)]) -> BTreeMap<String, f64> {
    let parameters = parameters.iter();
    parameters
        .map(|&(name, value)| (name.to_owned(), value))
        .collect()
}

fn value_of(recipe: &Recipe, name: &str) -> Option<f64> {
    let command = recipe
        .command_line(SerialEndpoint::Listening(0))
        .expect("it fits");
    let (_, text) = &command.files[0];
    let line = text.lines().find_map(|line| line.strip_prefix(name));
    line.and_then(|value| value.strip_prefix(' ')?.parse().ok())
}

#[test]
fn the_command_line_is_that_of_sitl() {
    let command = recipe()
        .command_line(SerialEndpoint::Listening(3))
        .expect("it fits");
    assert_eq!(
        command.line("arducopter"),
        "arducopter --model quad:frame.json --speedup 1 --slave 0 --defaults vehicle.parm --home 50.4500000,30.5200000,180,90 \
         --sysid 7 -I 3"
    );
    let address = "127.0.0.1:4711".parse().expect("an address");
    let command = recipe()
        .command_line(SerialEndpoint::Outwards(address))
        .expect("it fits");
    let line = command.line("arducopter");
    let end = "--serial0 tcpclient:127.0.0.1:4711 --serial1 none: --serial2 none: --rc-in-port 0";
    assert!(line.ends_with(end), "{line}");
    assert_eq!(
        SerialEndpoint::Listening(3).ports(),
        Ok(vec![5790, 5792, 5793])
    );
}

#[test]
fn an_airframe_chooses_the_model_and_the_frame_of_its_motors() {
    let cases = [
        (4, "quad", 1.0, 0.0),
        (6, "hexa", 2.0, 0.0),
        (8, "octa", 3.0, 0.0),
        (10, "deca", 14.0, 0.0),
        (12, "dodeca-hexa", 12.0, 0.0),
    ];
    for (motors, model, class, shape) in cases {
        let recipe = Recipe {
            airframe: Some(frame(motors)),
            ..recipe()
        };
        let command = recipe
            .command_line(SerialEndpoint::Listening(0))
            .expect("it fits");
        assert_eq!(command.arguments[1], format!("{model}:frame.json"));
        assert_eq!(command.files[1].0, "frame.json");
        let frame = ["FRAME_CLASS", "FRAME_TYPE"].map(|name| value_of(&recipe, name));
        assert_eq!(frame, [Some(class), Some(shape)]);
    }
}

#[test]
fn the_parameters_choose_the_model_that_they_mean() {
    let asked = Recipe {
        parameters: with(&[("FRAME_TYPE", 1.0)]),
        ..recipe()
    };
    let command = asked
        .command_line(SerialEndpoint::Listening(0))
        .expect("it fits");
    assert_eq!(command.arguments[1], "x:frame.json");
    let asked = Recipe {
        parameters: with(&[("FRAME_CLASS", 5.0)]),
        airframe: Some(frame(6)),
        ..recipe()
    };
    let command = asked
        .command_line(SerialEndpoint::Listening(0))
        .expect("it fits");
    assert_eq!(command.arguments[1], "y6:frame.json");
}

#[test]
fn the_battery_and_the_motors_follow_the_airframe() {
    let of = |airframe| Recipe {
        airframe,
        ..recipe()
    };
    let expected = [
        ("BATT_CAPACITY", Some(4000.0), Some(5000.0)),
        ("BATT_LOW_VOLT", Some(9.9), Some(14.0)),
        ("BATT_LOW_MAH", Some(800.0), None),
        ("BATT_FS_LOW_ACT", Some(2.0), None),
        ("MOT_BAT_VOLT_MAX", Some(12.8), Some(17.06667)),
        ("MOT_BAT_VOLT_MIN", Some(9.6), Some(12.8)),
        ("MOT_THST_HOVER", Some(0.39), Some(0.33)),
        ("ATC_RAT_RLL_P", Some(0.135), Some(0.11423)),
    ];
    for (name, usual, own) in expected {
        assert_eq!(value_of(&of(None), name), usual, "{name}");
        assert_eq!(value_of(&of(Some(frame(4))), name), own, "{name}");
    }
    let asked = Recipe {
        parameters: with(&[("BATT_CAPACITY", 1.5)]),
        ..of(Some(frame(4)))
    };
    assert_eq!(value_of(&asked, "BATT_CAPACITY"), Some(1.5));
}

/// With the firmware's defaults, a boat would drive at 2 m/s instead of 5.
#[test]
fn rovers_and_boats_drive_as_in_the_embedded_simulator() {
    let expected = [
        ("rover", "WP_SPEED", 5.0),
        ("rover", "ATC_SPEED_P", 0.1),
        ("rover-skid", "CRUISE_SPEED", 3.0),
        ("motorboat", "CRUISE_THROTTLE", 30.0),
        ("sailboat", "WP_RADIUS", 3.0),
    ];
    for (model, name, value) in expected {
        let recipe = Recipe {
            kind: SitlKind::Rover,
            model: Some(model.to_owned()),
            ..recipe()
        };
        assert_eq!(value_of(&recipe, name), Some(value), "{model}: {name}");
    }
}

/// Only a copter's battery runs down; 4.6 ignores the rate for rovers.
#[test]
fn only_copters_get_the_rate_at_which_their_batteries_are_right() {
    for &kind in SitlKind::ALL {
        let recipe = Recipe { kind, ..recipe() };
        let expected = (kind == SitlKind::Copter).then_some(400.0);
        assert_eq!(
            value_of(&recipe, "SIM_RATE_HZ"),
            expected,
            "{}",
            kind.name()
        );
    }
    let asked = Recipe {
        parameters: with(&[("SIM_RATE_HZ", 1200.0)]),
        ..recipe()
    };
    assert_eq!(value_of(&asked, "SIM_RATE_HZ"), Some(1200.0));
}

/// `SIM_BATT_CAP_AH` has no effect: only a frame file gives a copter a battery that runs down.
#[test]
fn a_copter_without_a_frame_file_gets_a_battery_that_ends() {
    for model in ["quad", "x", "hexa", "octa-quad"] {
        let recipe = Recipe {
            model: Some(model.to_owned()),
            ..recipe()
        };
        let command = recipe
            .command_line(SerialEndpoint::Listening(0))
            .expect("it fits");
        assert_eq!(command.arguments[1], format!("{model}:frame.json"));
        let (name, frame) = &command.files[1];
        let (airframe, warnings) = Airframe::from_json(frame).expect("it is valid");
        assert_eq!((*name, warnings), ("frame.json", Vec::new()));
        let embedded = Airframe::standard(airframe.motors());
        assert!(airframe.battery_capacity_ah() > 1.0);
        assert_eq!(
            airframe.battery_capacity_ah().to_bits(),
            embedded.battery_capacity_ah().to_bits()
        );
    }
}

#[test]
fn every_kind_has_a_model_and_parameters() {
    for (kind, model) in SitlKind::ALL
        .iter()
        .copied()
        .zip(["quad", "plane", "rover", "vectored"])
    {
        let recipe = Recipe { kind, ..recipe() };
        let command = recipe
            .command_line(SerialEndpoint::Listening(0))
            .expect("it fits");
        assert_eq!(command.arguments[1].split(':').next(), Some(model));
        assert!(command.files[0].1.contains("COMPASS_OFS_X 5\n"));
        // SITL reads at most 97 characters of a line in a parameter file.
        assert!(command.files[0].1.lines().all(|line| line.len() < 98));
    }
}

#[test]
fn a_plane_takes_speeds_from_its_airspeed_sensor() {
    let plane = Recipe {
        kind: SitlKind::Plane,
        ..recipe()
    };
    assert_eq!(value_of(&plane, "ARSPD_USE"), Some(1.0));
    assert_eq!(value_of(&plane, "AIRSPEED_CRUISE"), Some(22.0));
    assert_eq!(value_of(&recipe(), "ARSPD_USE"), None);
}

#[test]
fn what_sitl_would_misunderstand_is_refused_with_what_to_do() {
    let usual = recipe();
    let at = |lat, lon| Start {
        at: LatLon::new(lat, lon),
        ..usual.start
    };
    let model = |model: &str| Some(model.to_owned());
    #[rustfmt::skip]
    let cases = [
        (Recipe { system: 0, ..recipe() }, "use 1 to 254"),
        (Recipe { system: 255, ..recipe() }, "use 1 to 254"),
        (Recipe { speedup: f64::NAN, ..recipe() }, "use 0.01 to 1000"),
        (Recipe { start: at(0.0, 0.0), ..recipe() }, "SITL treats latitude 0"),
        (Recipe { start: at(91.0, 0.0), ..recipe() }, "latitude and longitude on earth"),
        (Recipe { model: model("quat"), ..recipe() }, "a copter has no model `quat`: use quad, +, copter, x"),
        (Recipe { model: model("x"), airframe: Some(frame(6)), ..recipe() },
         "the model x has 4 motors and the frame file 6: use the model hexa or hexax or hexa-dji or"),
        (Recipe { model: model("x"), parameters: with(&[("FRAME_TYPE", 0.0)]), ..recipe() },
         "x needs FRAME_TYPE 1 and would flip over with 0: leave FRAME_TYPE out, or use the model quad or + or copter"),
        (Recipe { airframe: Some(frame(4)), parameters: with(&[("FRAME_CLASS", 2.0)]), ..recipe() },
         "no model of a copter with 4 motors has the frame"),
        (Recipe { airframe: Some(frame(5)), ..recipe() }, "the frame file, line 1, column 2: num_motors: a frame has 4"),
        (Recipe { airframe: model("{\"mass\": NaN}"), ..recipe() }, "the frame file, line 1"),
        (Recipe { kind: SitlKind::Rover, airframe: Some(frame(4)), ..recipe() }, "only multirotors use a frame file"),
        (Recipe { kind: SitlKind::Rover, model: model("quad"), ..recipe() }, "use rover, rover-skid, motorboat"),
        (Recipe { parameters: with(&[("RTL ALT", 1.0)]), ..recipe() }, "`RTL ALT` is not the name of a parameter"),
        (Recipe { parameters: with(&[("RTL_ALT", f64::NAN)]), ..recipe() }, "RTL_ALT cannot be NaN"),
        (Recipe { parameters: with(&[("RTL_ALT", 1e39)]), ..recipe() }, "fits a float"),
    ];
    for (recipe, expected) in cases {
        let unfit = recipe
            .command_line(SerialEndpoint::Listening(0))
            .expect_err(expected);
        assert!(unfit.to_string().contains(expected), "{unfit}");
    }
    let far = recipe().command_line(SerialEndpoint::Listening(256));
    assert_eq!(far, Err(SitlUnfit::Instance(256)));
    assert!(
        recipe()
            .command_line(SerialEndpoint::Listening(255))
            .is_ok()
    );
}

/// The words that a shell parses from a line.
fn shell(line: &str) -> Vec<String> {
    let said = Command::new("sh")
        .args(["-c", &format!("printf '%s\\0' {line}")])
        .output()
        .expect("there is a shell");
    let said = String::from_utf8(said.stdout).expect("it is text");
    said.split_terminator('\0').map(str::to_owned).collect()
}

#[test]
fn files_come_out_of_the_shell_as_they_went_in() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let text = "{ \"mass\": 3.0 } # it's $HOME `here` \\n\nEND\nEND_\n";
    let command = CommandLine {
        arguments: Vec::new(),
        files: vec![("frame.json", text.to_owned())],
    };
    let within = folder.path().join("it's a folder");
    let script = command.preparation(&within.display().to_string());
    let status = Command::new("sh").args(["-c", &script]).status();
    assert!(status.expect("there is a shell").success(), "{script}");
    let written = std::fs::read_to_string(within.join("frame.json")).expect("it is there");
    assert_eq!(written, text);
}

fn any_shape() -> impl Strategy<Value = FormationShape> {
    prop::sample::select(FormationShape::ALL.to_vec())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn the_printed_line_reads_back_as_the_same_words(
        words in prop::collection::vec("[^\0\u{fffd}]{0,12}", 1..6),
        lat in -80.0..80.0f64,
        heading in -360.0..360.0f64,
        speedup in 0.01..1000.0f64,
    ) {
        let refs: Vec<&str> = words.iter().map(String::as_str).collect();
        prop_assert_eq!(shell(&line(refs)), words);
        let start = Start { at: LatLon::new(lat, 10.0), altitude_amsl_m: -3.25, heading_deg: heading };
        let command = Recipe { start, speedup, ..recipe() }.command_line(SerialEndpoint::Listening(1)).expect("it fits");
        let read = shell(&command.line("a program's name"));
        prop_assert_eq!(&read[0], "a program's name");
        prop_assert_eq!(&read[1..], &command.arguments[..]);
    }

    #[test]
    fn no_two_vehicles_of_a_formation_are_nearer_than_the_spacing(
        shape in any_shape(),
        of in 1..80usize,
        spacing_m in 0.5..30.0f64,
        heading_deg in -360.0..720.0f64,
    ) {
        let first = Start { heading_deg, ..recipe().start };
        let starts = StartFormation { shape, spacing_m }.starts(of, first);
        prop_assert_eq!(starts.len(), of);
        prop_assert!(starts[0].at.distance_m(first.at) < 1e-6);
        for (place, one) in starts.iter().enumerate() {
            prop_assert!(one.heading_deg.to_bits() == heading_deg.to_bits());
            for other in &starts[place + 1..] {
                let apart_m = one.at.distance_m(other.at);
                prop_assert!(apart_m > spacing_m * 0.999, "{apart_m} of {spacing_m}");
            }
        }
    }
}

#[test]
fn a_formation_turns_with_its_heading() {
    let cases = [
        (FormationShape::Row, (0.0, 5.0)),
        (FormationShape::Column, (-5.0, 0.0)),
        (FormationShape::Grid, (0.0, 5.0)),
        (FormationShape::Circle, (-5.0, 0.0)),
        (FormationShape::Wedge, (-3.5355, 3.5355)),
    ];
    for (shape, (forward_m, right_m)) in cases {
        let formation = StartFormation {
            shape,
            spacing_m: 5.0,
        };
        // With a heading of east, ahead is east and right is south.
        let second = formation.starts(2, recipe().start)[1];
        let (north_m, east_m) = recipe().start.at.offset_to(second.at);
        let off = maths::hypot(north_m + right_m, east_m - forward_m);
        assert!(off < 0.01, "{}: {north_m} {east_m}", shape.name());
    }
    let grid = StartFormation {
        shape: FormationShape::Grid,
        spacing_m: 2.0,
    };
    let place = |index| grid.place(index, 7);
    assert_eq!((place(2).forward_m, place(2).right_m), (-0.0, 4.0));
    assert_eq!((place(3).forward_m, place(3).right_m), (-2.0, 0.0));
}
