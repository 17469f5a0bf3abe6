//! The golden record, and forgeries of it.

use proptest::prelude::*;

use super::*;

const RUN: &str = include_str!("../../../../tests/data/golden/eight.run.jsonl");
const INPUTS: &str = include_str!("../../../../tests/data/golden/eight.inputs.jsonl");
const SCORE: &str = "\"score\":";
/// The sender (255/190) and the id of `COMMAND_LONG` in the hex of a frame, after length, flags and sequence number.
const COMMAND: &str = "ffbe4c0000";

/// Verifies a record from these texts; returns how much was compared, or the difference as an error text.
fn verified(run: &str, inputs: &str) -> Result<RecordExtent, String> {
    let stored = Stored::read(run).map_err(|fault| fault.to_string())?;
    let inputs = StoredInputs::read(inputs).map_err(|fault| fault.to_string())?;
    let verification = stored.verify(&inputs).map_err(|fault| fault.to_string())?;
    match verification.difference {
        None => Ok(verification.extent),
        Some(Divergence { at, vehicle, what }) => {
            let vehicle =
                vehicle.map_or_else(String::new, |vehicle| format!("vehicle {vehicle}: "));
            Err(format!("{:.2} s: {vehicle}{what}", at.as_secs_f64()))
        }
    }
}

/// The golden record with one line replaced: the first that contains all of `has`.
fn with_line(text: &str, has: &[&str], replace: impl Fn(&str) -> String) -> String {
    let line = text
        .lines()
        .find(|line| has.iter().all(|part| line.contains(part)))
        .expect("the golden record has such a line");
    let forged = replace(line);
    assert_ne!(line, forged);
    text.replacen(&format!("{line}\n"), &forged, 1)
}

fn edited(from: &'static str, to: &'static str) -> impl Fn(&str) -> String {
    move |line| format!("{}\n", line.replacen(from, to, 1))
}

fn removed(_: &str) -> String {
    String::new()
}

#[track_caller]
fn assert_named(run: &str, inputs: &str, named: &str) {
    let said = verified(run, inputs).expect_err(named);
    assert!(said.contains(named), "{said}");
}

/// Eight drones in wind, with a bad motor, a bad link and no satellite navigation. Another build of the program
/// recorded the flight, and this one verifies it.
#[test]
fn the_golden_record_is_verified() {
    assert_eq!(verified(RUN, INPUTS), Ok(RecordExtent::Whole));
}

#[test]
fn an_edited_score_is_named() {
    let forged = with_line(RUN, &["\"end\":", SCORE], |line| {
        let at = line.find(SCORE).expect("it is there") + SCORE.len();
        format!("{}1000{}\n", &line[..at], &line[at + 3..])
    });
    assert_named(&forged, INPUTS, "1000 points are recorded");
}

#[test]
fn an_edited_or_missing_input_is_named() {
    let frame = |line: &str| {
        // One bit of a command: the frame's checksum no longer matches.
        let at = line.find(COMMAND).expect("a command") + 20;
        let digit = if &line[at..=at] == "0" { "1" } else { "0" };
        format!("{}{digit}{}\n", &line[..at], &line[at + 1..])
    };
    // The state differs, or a text of the vehicle that depends on the command comes at another time.
    let is_named = |forged: &str| {
        let said = verified(RUN, forged).expect_err("the inputs differ");
        let named = ["does not match", "did not send the recorded text"];
        assert!(named.iter().any(|it| said.contains(it)), "{said}");
    };
    is_named(&with_line(INPUTS, &[COMMAND], frame));
    is_named(&with_line(INPUTS, &[COMMAND], removed));
}

#[test]
fn an_edited_state_is_named_with_its_vehicle() {
    let forged = with_line(INPUTS, &["\"s\":2000,", "\"state\":"], |line| {
        let (first, rest) = line.split_once("[\"").expect("a list");
        format!("{first}[\"{:016x}{}\n", 7, &rest[16..])
    });
    assert_named(RUN, &forged, "20.00 s: vehicle 1: the state");
}

#[test]
fn swapped_vehicles_are_named() {
    let swap = |text: &str| {
        let marked = text
            .replace("\"id\":1,", "\"id\":#,")
            .replace("\"id\":2,", "\"id\":1,");
        marked.replace("\"id\":#,", "\"id\":2,")
    };
    let ticks = RUN.lines().map(|line| {
        let line = if line.starts_with("{\"tick\"") {
            swap(line)
        } else {
            line.to_owned()
        };
        line + "\n"
    });
    assert_named(&ticks.collect::<String>(), INPUTS, "does not match");
}

#[test]
fn another_seed_is_named() {
    let forged = with_line(RUN, &["sortie_run"], edited("\"seed\":1", "\"seed\":2"));
    assert_named(&forged, INPUTS, "another seed");
    let seed = with_line(
        INPUTS,
        &["sortie_inputs"],
        edited("\"seed\":1", "\"seed\":2"),
    );
    assert_named(&forged, &seed, "does not match");
}

#[test]
fn another_mission_text_is_named() {
    let calm = with_line(RUN, &["sortie_run"], edited("speed = 6", "speed = 0"));
    assert_named(
        &calm,
        INPUTS,
        "SIM_WIND_SPD does not have the value that the mission requires",
    );
    let moved = with_line(RUN, &["sortie_run"], edited("lat = 50.45", "lat = 50.46"));
    assert_named(&moved, INPUTS, "other start positions");
}

#[test]
fn files_that_name_different_programs_are_named() {
    let newer = edited("\"program\":\"", "\"program\":\"9.");
    let forged = with_line(RUN, &["sortie_run"], &newer);
    assert_named(&forged, INPUTS, "different programs");
    let forged = with_line(INPUTS, &["sortie_inputs"], &newer);
    assert_named(RUN, &forged, "different programs");
}

#[test]
fn shortened_records_are_named() {
    let half = |text: &str| {
        let lines = text.lines().count() / 2;
        let kept = text.lines().take(lines).map(|line| format!("{line}\n"));
        kept.collect::<String>()
    };
    assert_named(RUN, &half(INPUTS), "does not match");
    let end = with_line(INPUTS, &["\"end\""], removed);
    assert_named(RUN, &end, "its end is missing");
}

/// The lines of a file up to the first one that contains a text.
fn up_to<'a>(text: &'a str, has: &str) -> &'a str {
    let at = text.find(has).expect("the golden record has such a line");
    &text[..=text[..at].rfind('\n').expect("a line before it")]
}

#[test]
fn a_record_without_an_end_is_verified_only_as_far_as_it_goes() {
    let run = up_to(RUN, "\"t\":30000,");
    let inputs = up_to(INPUTS, "{\"s\":3000,");
    let part = |run: &str, inputs: &str| match verified(run, inputs) {
        Ok(RecordExtent::Part { to, went_on }) => (to.as_millis(), went_on),
        other => panic!("{other:?}"),
    };
    // The last line of these inputs is that of 29 s.
    assert_eq!(part(run, inputs), (29_000, false));
    // The vehicles went on without the mission's record, or the record without their inputs.
    assert_eq!(part(run, INPUTS), (29_800, true));
    let later = up_to(RUN, "\"t\":40000,");
    assert_eq!(part(later, inputs), (29_000, false));
    let moved = with_line(run, &["\"t\":20000,", "\"at\":["], |line| {
        let at = line.find("\"at\":[").expect("a position") + 6;
        format!("{}9{}\n", &line[..at], &line[at + 1..])
    });
    assert_named(&moved, inputs, "20.00 s: vehicle 1: the recorded position");
    for (run, inputs) in [
        (run, inputs),
        (run, INPUTS),
        (up_to(RUN, "{\"end\""), INPUTS),
    ] {
        let stored = Stored::read(run).expect("a record");
        let inputs = StoredInputs::read(inputs).expect("inputs");
        assert!(!stored.is_confirmed(None, Some(&inputs)));
    }
}

/// Altered or removed telemetry is detected, because the repeated drones are elsewhere.
#[test]
fn moved_and_missing_telemetry_is_named() {
    let moved = with_line(RUN, &["\"t\":30000,", "\"at\":["], |line| {
        let at = line.find("\"at\":[").expect("a position") + 6;
        format!("{}9{}\n", &line[..at], &line[at + 1..])
    });
    assert_named(&moved, INPUTS, "30.00 s: vehicle 1: the recorded position");
    let missing = with_line(RUN, &["\"t\":30000,"], removed);
    assert_named(&missing, INPUTS, "does not match");
}

#[test]
fn a_refusal_that_is_left_out_is_named() {
    let forged = RUN.replace("\"state\":\"refused\"", "\"state\":\"done\"");
    assert_ne!(forged, RUN);
    assert_named(&forged, INPUTS, "refused");
}

#[test]
fn clocks_and_airframes_that_cannot_be_are_named() {
    // A line with a simulator clock among lines without one.
    let mixed = with_line(
        RUN,
        &["\"t\":30000,"],
        edited("\"t\":30000,", "\"t\":30000,\"s\":3000,"),
    );
    assert_named(&mixed, INPUTS, "clock");
    let late = with_line(RUN, &["\"score\""], |line| {
        let at = line.find("\"t\":").expect("a time") + 4;
        let digits = line[at..]
            .find(|c: char| !c.is_ascii_digit())
            .expect("an end");
        format!("{}10000000000000{}\n", &line[..at], &line[at + digits..])
    });
    assert_named(&late, INPUTS, "");
    let start = "[\"50\",\"30\",\"100\",\"0\"],";
    let crowd = INPUTS.replacen(
        "\"starts\":[",
        &format!("\"starts\":[{}", start.repeat(300)),
        1,
    );
    let refused = StoredInputs::read(&crowd).expect_err("there are too many");
    assert!(refused.to_string().contains("at most 255"), "{refused}");
    let own = INPUTS.replacen("\"starts\"", "\"airframes\":[{}],\"starts\"", 1);
    let graded = RUN.replacen("\"program\":", "\"stake\":\"graded\",\"program\":", 1);
    assert_named(&graded, &own, "airframes");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    #[test]
    fn mutated_records_are_judged_without_a_panic(at in 0.0..1.0f64, byte in b'0'..=b'9', of_inputs: bool) {
        let text = if of_inputs { INPUTS } else { RUN };
        let mut bytes = text.as_bytes().to_vec();
        let place = (at * bytes.len() as f64) as usize;
        prop_assume!(bytes[place].is_ascii_digit() && bytes[place] != byte);
        bytes[place] = byte;
        let forged = String::from_utf8(bytes).expect("ASCII stays ASCII");
        let (run, inputs) = if of_inputs { (RUN, forged.as_str()) } else { (forged.as_str(), INPUTS) };
        drop(verified(run, inputs));
    }
}
