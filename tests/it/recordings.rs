//! Recordings of the real `ArduCopter`, shortened, compared with facts that another implementation read from them
//! (tests/data/recordings/README.md).

use std::path::{Path, PathBuf};
use std::time::Duration;

use sortie::geo::LatLon;
use sortie::messages::Inbox;
use sortie::notice::Notice;
use sortie::vehicle::{EkfFlags, Fence, FixType, Vehicle};
use sortie::wire::{AUTOPILOT_COMPONENT, Counters, Decoder};
use toml::{Table, Value};

mod observed;

use observed::observed;

struct Reading {
    counters: Counters,
    frame_bytes: u64,
    signed: i64,
    vehicle: Vehicle,
    inbox: Inbox,
    notices: Vec<Notice>,
    seen: Seen,
}

/// The states of the model during the recording, without repeats.
#[derive(Default)]
struct Seen {
    modes: Vec<String>,
    armed: Vec<bool>,
    gps_fixed: Vec<bool>,
    ekf_position: Vec<bool>,
    fence_breach: Vec<bool>,
    last_fence: Option<Fence>,
    targets_e7: Vec<(i32, i32)>,
}

fn push_new<T: PartialEq>(list: &mut Vec<T>, value: Option<T>) {
    if let Some(value) = value.filter(|value| list.last() != Some(value)) {
        list.push(value);
    }
}

impl Seen {
    fn note(&mut self, vehicle: &Vehicle) {
        push_new(&mut self.modes, vehicle.mode().map(|mode| mode.to_string()));
        push_new(&mut self.armed, vehicle.heartbeat.map(|_| vehicle.armed()));
        push_new(
            &mut self.gps_fixed,
            vehicle.gps.map(|gps| gps.fix >= FixType::Fix3d),
        );
        let knows = |flags: EkfFlags| flags.has(EkfFlags::POSITION_HORIZONTAL_ABSOLUTE);
        push_new(
            &mut self.ekf_position,
            vehicle.ekf.map(|ekf| knows(ekf.flags)),
        );
        push_new(
            &mut self.fence_breach,
            vehicle.fence.map(|fence| fence.breached),
        );
        self.last_fence = vehicle.fence.or(self.last_fence);
        let target = vehicle.target.and_then(|target| target.at_point);
        push_new(&mut self.targets_e7, target.map(LatLon::to_e7));
    }
}

/// The pieces of a recording, each with its time: tlog records (8 bytes of big-endian microseconds before each frame),
/// or a bare byte stream in pieces of 1 kB.
fn pieces(path: &Path) -> Vec<(Duration, Vec<u8>)> {
    let bytes = std::fs::read(path).expect("the recording is there");
    if path.extension().is_some_and(|extension| extension == "raw") {
        let pieces = bytes.chunks(1000).map(<[u8]>::to_vec);
        return (0..).map(Duration::from_millis).zip(pieces).collect();
    }
    let mut records = Vec::new();
    let mut rest = bytes.as_slice();
    while let [s0, s1, s2, s3, s4, s5, s6, s7, frame @ ..] = rest {
        let at = u64::from_be_bytes([*s0, *s1, *s2, *s3, *s4, *s5, *s6, *s7]);
        assert_eq!(frame[0], 0xFD, "these recordings are MAVLink 2 throughout");
        let signature_len = if frame[2] & 1 != 0 { 13 } else { 0 };
        let (frame, after) = frame.split_at(12 + usize::from(frame[1]) + signature_len);
        records.push((Duration::from_micros(at), frame.to_vec()));
        rest = after;
    }
    records
}

fn read(path: &Path) -> Reading {
    let facts = facts(path);
    let system = facts["system"].as_integer().expect("a system id") as u8;
    let mut decoder = Decoder::new();
    let mut reading = Reading {
        counters: decoder.counters(),
        frame_bytes: 0,
        signed: 0,
        vehicle: Vehicle::new(system, AUTOPILOT_COMPONENT),
        inbox: Inbox::new(),
        notices: Vec::new(),
        seen: Seen::default(),
    };
    let mut end = Duration::ZERO;
    for (now, piece) in pieces(path) {
        decoder.push(&piece);
        while let Some(frame) = decoder.next_frame() {
            assert_eq!(frame.system, system);
            reading.frame_bytes += u64::from(frame.wire_len);
            reading.signed += i64::from(frame.seal.is_signature());
            let Reading {
                inbox,
                vehicle,
                notices,
                seen,
                ..
            } = &mut reading;
            inbox.apply(vehicle, &frame, now, notices);
            seen.note(vehicle);
        }
        end = now;
    }
    assert_eq!(decoder.next_frame_at_end(), None);
    let Reading {
        inbox,
        vehicle,
        notices,
        ..
    } = &mut reading;
    inbox.poll(vehicle, end + Duration::from_secs(2), notices);
    reading.counters = decoder.counters();
    reading
}

fn facts(path: &Path) -> Table {
    let text =
        std::fs::read_to_string(path.with_extension("toml")).expect("facts beside the recording");
    text.parse().expect("facts are TOML")
}

fn recordings() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/recordings");
    let mut found: Vec<PathBuf> = std::fs::read_dir(folder)
        .expect("the folder is there")
        .map(|entry| entry.expect("readable").path())
        .filter(|path| {
            path.extension()
                .is_some_and(|extension| extension == "tlog" || extension == "raw")
        })
        .collect();
    found.sort();
    assert!(found.len() >= 8, "recordings are missing");
    found
}

/// Whether two values are equal; floats are compared to the digits that the facts state.
fn same(fact: &Value, ours: &Value) -> bool {
    match (fact, ours) {
        (Value::Float(fact), Value::Float(ours)) => (fact - ours).abs() < 2e-3,
        (Value::Array(fact), Value::Array(ours)) => {
            fact.len() == ours.len() && fact.iter().zip(ours).all(|(fact, ours)| same(fact, ours))
        }
        _ => fact == ours,
    }
}

#[test]
fn the_model_after_each_recording_equals_the_facts() {
    let mut wrong = Vec::new();
    for path in recordings() {
        let reading = read(&path);
        let observed = observed(&reading);
        for (key, fact) in &facts(&path) {
            if key == "targets_e7" {
                continue;
            }
            let ours = observed.get(key);
            if !ours.is_some_and(|ours| same(fact, ours)) {
                wrong.push(format!(
                    "{}: {key}: the facts say {fact}, we say {ours:?}",
                    path.display()
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_byte_of_a_recording_is_a_frame_or_counted_as_noise() {
    for path in recordings() {
        let reading = read(&path);
        let counters = reading.counters;
        assert_eq!(
            counters.crc_errors + counters.unknown_messages + counters.undecoded,
            0
        );
        let accounted = reading.frame_bytes + counters.skipped_bytes;
        assert_eq!(accounted, counters.bytes, "{}", path.display());
    }
}

#[test]
fn a_notice_is_said_once_for_every_change_and_text() {
    for path in recordings() {
        let reading = read(&path);
        let changes = |states: usize| states.saturating_sub(1);
        let texts = facts(&path)["texts"].as_array().expect("texts").len();
        let seen = &reading.seen;
        let mut others = reading.notices.len();
        for (begins, expected) in [
            ("mode ", changes(seen.modes.len())),
            (
                "armed",
                seen.armed.iter().skip(1).filter(|armed| **armed).count(),
            ),
            (
                "disarmed",
                seen.armed.iter().skip(1).filter(|armed| !**armed).count(),
            ),
            ("GPS fix ", changes(seen.gps_fixed.len())),
            ("EKF position ", changes(seen.ekf_position.len())),
            (
                "fence breached",
                seen.fence_breach.iter().filter(|out| **out).count(),
            ),
            (
                "plan flown to its end",
                usize::from(path.ends_with("plan.tlog")),
            ),
            ("rebooted", 0),
            ("two vehicles", 0),
        ] {
            let said = |notice: &&Notice| notice.text.to_string().starts_with(begins);
            let count = reading.notices.iter().filter(said).count();
            assert_eq!(count, expected, "{}: {begins}", path.display());
            others -= count;
        }
        assert_eq!(others, texts, "{}: texts", path.display());
    }
}

#[test]
fn local_and_global_targets_name_the_same_places() {
    let mut compared = 0;
    for path in recordings() {
        let Some(targets) = facts(&path).get("targets_e7").cloned() else {
            continue;
        };
        let targets: Vec<(i32, i32)> = targets.try_into().expect("pairs of integers");
        for (lat_e7, lon_e7) in read(&path).seen.targets_e7 {
            let ours = LatLon::from_e7(lat_e7, lon_e7);
            let nearest_m = targets
                .iter()
                .map(|&(lat_e7, lon_e7)| LatLon::from_e7(lat_e7, lon_e7).distance_m(ours))
                .fold(f64::INFINITY, f64::min);
            assert!(
                nearest_m < 1.0,
                "{}: {ours:?} is {nearest_m} m off",
                path.display()
            );
            compared += 1;
        }
    }
    assert!(compared > 5, "only {compared} targets");
}
