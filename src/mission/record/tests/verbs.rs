//! The verbs in records, which later programs have to read.

use super::*;

/// The verbs that a record may name. A record outlives the table: if a verb gets another name, the old one must stay
/// readable ([`language::verb`]) before it is changed here.
const RECORDED_VERBS: [&str; 59] = [
    "altitude",
    "arm",
    "control",
    "disarm",
    "drop",
    "fence",
    "fence switch",
    "follow",
    "formation",
    "formation off",
    "ftp",
    "goal",
    "goto",
    "hint",
    "hold",
    "home",
    "int",
    "interval",
    "kill",
    "land",
    "logs",
    "long",
    "mark",
    "mode",
    "orbit",
    "param",
    "plan",
    "plan abort",
    "plan change",
    "plan goto",
    "plan pause",
    "plan rehearse",
    "plan resume",
    "plan skip",
    "plan start",
    "predict",
    "rally",
    "rc",
    "reboot",
    "relay",
    "relay to",
    "request",
    "resume",
    "roi",
    "rtl",
    "sample",
    "search",
    "send",
    "servo",
    "signing",
    "speed",
    "spray",
    "spread",
    "survey",
    "takeoff",
    "unmark",
    "velocity",
    "workload",
    "yaw",
];

#[test]
fn every_verb_that_a_record_may_name_is_pinned() {
    for name in RECORDED_VERBS {
        assert!(language::verb(name).is_some(), "{name} reads no more");
    }
    for verb in language::verbs() {
        assert!(RECORDED_VERBS.contains(&verb.name), "add {}", verb.name);
    }
}
