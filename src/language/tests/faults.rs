use super::read;
use crate::diagnostic::Diagnostic;
use crate::language::{Channel, Context, Statement, parse};

#[test]
fn faults_in_the_fields_of_a_message_point_at_the_part() {
    check(&[
        (
            "send HARTBEAT",
            "HARTBEAT",
            "unknown message `HARTBEAT`",
            "did you mean `HEARTBEAT`?",
        ),
        ("send", "", "send needs MESSAGE", "3 send HEARTBEAT"),
        ("send 12345", "12345", "unknown message `12345`", ""),
        (
            "3 send HEARTBEAT mavlink_version=3 typ = 2 # why",
            "typ",
            "HEARTBEAT has no field `typ`",
            "did you mean `type`?",
        ),
        (
            "3 send  HEARTBEAT  type=300",
            "300",
            "type: `300` is out of range: 0 to 255",
            "",
        ),
        (
            "3 send SETUP_SIGNING initial_timestamp=1",
            "SETUP_SIGNING",
            "contains a key or a password",
            "`signing setup`",
        ),
        (
            "send WIFI_CONFIG_AP",
            "WIFI_CONFIG_AP",
            "contains a key or a password",
            "",
        ),
    ]);
}

#[test]
fn the_exact_word_that_is_wrong_is_named() {
    check(&[
        ("", "", "a command is missing", "all arm"),
        ("all", "", "a command is missing", ""),
        (
            "all takeof 20",
            "takeof",
            "unknown command `takeof`",
            "did you mean `takeoff`?",
        ),
        (
            "all guied",
            "guied",
            "unknown command",
            "did you mean `GUIDED`?",
        ),
        (
            "takeoff",
            "",
            "takeoff needs ALTITUDE (height above home, 0.5 to 1000 m)",
            "takeoff 20",
        ),
        (
            "takeoff high",
            "high",
            "`high` is not a number",
            "expected ALTITUDE",
        ),
        ("takeoff 2000", "2000", "out of range: 0.5 to 1000 m", ""),
        (
            "takeoff 20ft",
            "20ft",
            "`ft` is not a unit for this: use m, km",
            "",
        ),
        ("takeoff nan", "nan", "not a number", ""),
        ("takeoff inf", "inf", "not a number", ""),
        ("takeoff 1e999", "1e999", "too large", ""),
        ("takeoff 20 30", "30", "unexpected", "takeoff ALTITUDE"),
        ("5-2 arm", "5-2", "reversed: use `2-5`", ""),
        ("0 arm", "0", "numbered from 1 to 9999", ""),
        ("1,300 arm", "300", "no vehicle 300, only 1-8", ""),
        ("1-99 arm", "1-99", "no vehicle 9, only 1-8", ""),
        ("1,,2 arm", "", "a number is missing next to the comma", ""),
        ("1, arm", "", "a number is missing next to the comma", ""),
        ("1,x arm", "x", "`x` names no vehicles", ""),
        (
            "@rad arm",
            "@rad",
            "no group `@rad`",
            "did you mean `@red`?",
        ),
    ]);
}

#[test]
fn the_argument_that_is_wrong_or_missing_is_named() {
    check(&[
        ("goto n 100 east 50", "east", "expected `e`, `up`", ""),
        ("goto n 100", "", "goto needs `e`", ""),
        (
            "goto towr up 4",
            "towr",
            "`towr` does not fit here",
            "did you mean `tower`?",
        ),
        (
            "goto 95 30",
            "95",
            "LAT: `95` is out of range: -90 to 90 deg",
            "",
        ),
        (
            "goto 50 200",
            "200",
            "LON: `200` is out of range: -180 to 180 deg",
            "",
        ),
        (
            "goto 50",
            "",
            "the longitude is missing after `50`",
            "goto ",
        ),
        ("goto tower keep face 90", "face 90", "not both", ""),
        ("goto tower up -3", "-3", "UP: `-3` is out of range", ""),
        (
            "mode qloiter",
            "qloiter",
            "a copter has no mode `qloiter`",
            "did you mean `LOITER`?",
        ),
        ("yaw -90", "-90", "use `by`", ""),
        (
            "servo 1.5 1500",
            "1.5",
            "OUTPUT: `1.5` is not a whole number",
            "",
        ),
        (
            "int DO_REPOSITION -1 0 0 0 0 0 0 0",
            "-1",
            "FRAME: `-1` is out of range: 0 to 255",
            "",
        ),
        (
            "int DO_REPOSITION 6 -1 1 0 0 50.45 30 40",
            "50.45",
            "X: `50.45` is not a whole number",
            "",
        ),
        (
            "long 400 on",
            "on",
            "P1: `on` is not a number",
            "expected P1",
        ),
        ("mode 256", "256", "no mode `256`", ""),
        (
            "param set X",
            "",
            "param set needs VALUE",
            "param set WPNAV_SPEED 500",
        ),
        (
            "param get",
            "",
            "param get needs NAME",
            "param get WPNAV_SPEED",
        ),
        ("goto by up", "", "goto by needs UP", "goto by n 10"),
        (
            "home 50.45 30.52",
            "",
            "home needs ALTITUDE",
            "home 50.4501",
        ),
        ("servo 17 1500", "17", "1 to 16", ""),
        (
            "relay 1 onn",
            "onn",
            "not one of on, off",
            "did you mean `on`?",
        ),
        ("request ATTITUD", "ATTITUD", "unknown message", "ATTITUDE"),
        (
            "long NAV_TAKEOF",
            "NAV_TAKEOF",
            "unknown MAV_CMD",
            "NAV_TAKEOFF",
        ),
        ("long 70000", "70000", "65535", ""),
    ]);
}

#[test]
fn an_argument_of_the_wrong_kind_is_named() {
    check(&[
        (
            "param set THIS_NAME_IS_TOO_LONG 1",
            "THIS_NAME_IS_TOO_LONG",
            "1 to 16",
            "",
        ),
        ("wait all altitude", "", "wait needs", ""),
        ("wait all altitude 19", "19", "not one of", ""),
        ("wait all speed > 5deg", "5deg", "use m/s", ""),
        ("velocity for 5", "5", "the direction is missing", ""),
    ]);
}

/// For a verb with many forms, only the usages of those that begin as the line does are shown.
#[test]
fn a_fault_shows_the_usage_of_the_form_that_was_meant() {
    check(&[
        (
            "plan start 3",
            "3",
            "unexpected `3`",
            "write it as `plan start`",
        ),
        (
            "1 plan resume fro 2",
            "fro",
            "expected `from` or ITEM",
            "did you mean `from`?",
        ),
        (
            "plan goto",
            "",
            "plan goto needs ITEM",
            "example `plan goto 7`",
        ),
        (
            "plan upload",
            "",
            "plan upload needs FILE",
            "example `plan upload survey.waypoints`",
        ),
        (
            "plan survey",
            "",
            "plan survey needs `n`",
            "example `1-6 plan survey lane",
        ),
    ]);
    let fault = read("plan start 3").expect_err("too much");
    let help = fault.help.map(|help| help.to_string());
    assert_eq!(help.as_deref(), Some("write it as `plan start`"));
    let usages = |line| crate::language::usages_begun(line).map(|text| text.to_string());
    assert_eq!(usages("1 plan start 3").as_deref(), Some("plan start"));
    assert_eq!(
        usages("plan resume fro 2").as_deref(),
        Some("plan resume [from ITEM] | plan resume ITEM")
    );
}

#[test]
fn a_fault_in_a_draft_names_its_own_word() {
    let (groups, places) = (super::groups(), super::places());
    let context = Context {
        channel: Channel::Screen,
        ..super::context(&groups, &places)
    };
    let cases = &[
        (
            "draft undo 3",
            "3",
            "unexpected",
            "write it as `draft undo`",
        ),
        (
            "draft jump 3",
            "",
            "draft jump needs `to`",
            "example `draft jump 6 to 2 times 3`",
        ),
        ("draft jump x to 2", "x", "ITEM: `x` is not a number", ""),
        ("draft jump 3 to x", "x", "TO: `x` is not a number", ""),
        ("draft jump 3 2", "2", "expected `to`", ""),
        ("draft jump 3 too 2", "too", "expected `to`", "`to`"),
        (
            "draft jump 3 to 2 times x",
            "x",
            "TIMES: `x` is not a number",
            "",
        ),
        (
            "draft add 50.45",
            "",
            "the longitude is missing after `50.45`",
            "",
        ),
        ("draft jump 2 to 1 times 0", "times 0", "never jumps", ""),
        ("draft fence polygn", "polygn", "`polygon`", "`polygon`"),
        (
            "draft add takof 30",
            "takof",
            "unknown plan command `takof`",
            "did you mean `takeoff`",
        ),
        (
            "draft add loitr 30",
            "loitr",
            "unknown plan command",
            "did you mean `loiter`",
        ),
        (
            "draft add wrongcommand",
            "wrongcommand",
            "unknown plan command `wrongcommand`",
            "completion lists all commands, such as waypoint, loiter",
        ),
        (
            "draft command 4 trns",
            "trns",
            "unknown plan command",
            "did you mean `turns`? completion lists",
        ),
    ];
    check_with(|line| parse(line, &context), cases);
}

/// The line, the marked word ("" is the end of the line), a part of the message, and a part of the help.
type Case = (&'static str, &'static str, &'static str, &'static str);

fn check(cases: &[Case]) {
    check_with(read, cases);
}

fn check_with(read: impl Fn(&str) -> Result<Statement, Diagnostic>, cases: &[Case]) {
    let mut wrong = Vec::new();
    for &(line, word, message, help) in cases {
        let fault = read(line).expect_err(line);
        let pointed = &line[fault.span.clone()];
        let pointed = pointed.strip_prefix("for ").unwrap_or(pointed);
        let given = fault.help.clone().unwrap_or_default();
        if pointed != word || !fault.message.contains(message) || !given.contains(help) {
            wrong.push(format!("{line}: {fault:?}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn the_place_of_the_highest_reading_is_no_unknown_place_before_there_is_one() {
    let places = std::collections::BTreeMap::new();
    let context = Context {
        places: Some(&places),
        ..Context::default()
    };
    for (line, name) in [("1 mark peak as leak", "peak"), ("1 goto peak2", "peak2")] {
        let fault = parse(line, &context).expect_err("nothing was measured");
        let said = fault.message.to_string();
        let reason = format!("no `{name}`: nothing has been measured yet");
        assert!(said.contains(&reason), "{said}");
        assert!(
            fault.help.is_none(),
            "no lesson in grammar: {:?}",
            fault.help
        );
    }
}

#[test]
fn a_contact_that_does_not_exist_is_named_with_those_that_do() {
    check(&[
        ("1 goto c10", "c10", "no contact `c10`; known: c3", ""),
        ("1 goto fire2 up 20", "fire2", "no contact `fire2`", ""),
        ("1 goto by c10", "c10", "", ""),
    ]);
    let groups = super::groups();
    let said = |count: u32| {
        let places = (1..=count).map(|number| (format!("c{number}"), super::places()["tower"]));
        let places = places.collect();
        let fault = parse("1 goto c99", &super::context(&groups, &places)).expect_err("unknown");
        fault.message.to_string()
    };
    assert!(said(0).contains("no contact has been found yet"));
    assert!(said(3).contains("known: c1, c2, c3"), "{}", said(3));
    assert!(said(12).contains("known: c1, c2 .. c12"), "{}", said(12));
}
