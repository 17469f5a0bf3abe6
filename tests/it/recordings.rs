//! Recordings of the real `ArduCopter`, cut down, against facts that another MAVLink implementation read
//! from them (tests/data/recordings/README.md).

use std::path::{Path, PathBuf};
use std::time::Duration;

use sortie::messages::Inbox;
use sortie::notice::Notice;
use sortie::vehicle::{EkfFlags, Fence, FixType, Vehicle};
use sortie::wire::{AUTOPILOT_COMPONENT, Counters, Decoder};
use toml::{Table, Value};

/// What this program made of a recording.
struct Reading {
    counters: Counters,
    frame_bytes: u64,
    signed: i64,
    vehicle: Vehicle,
    inbox: Inbox,
    notices: Vec<Notice>,
    seen: Seen,
}

/// What the model said on the way, repeats left out.
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
        push_new(&mut self.targets_e7, target.map(|point| point.to_e7()));
    }
}

/// The pieces of a recording with the time at which each came: tlog records (8 bytes of big-endian
/// microseconds before each frame), or a bare byte stream in pieces of 1 kB.
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
            reading.signed += i64::from(frame.signed);
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

/// Puts what the model says in the words of the facts.
struct Observed(Table);

impl Observed {
    fn put(&mut self, key: &str, value: impl Into<Value>) {
        self.0.insert(key.to_owned(), value.into());
    }

    fn list<T: Into<Value>>(&mut self, key: &str, values: impl IntoIterator<Item = T>) {
        self.put(
            key,
            values.into_iter().map(Into::into).collect::<Vec<Value>>(),
        );
    }

    fn link(&mut self, reading: &Reading) {
        let counters = reading.counters;
        self.put("bytes", counters.bytes as i64);
        self.put("frames", counters.frames as i64);
        self.put("unknown", counters.unknown_messages as i64);
        self.put("crc_errors", counters.crc_errors as i64);
        self.put("skipped_bytes", counters.skipped_bytes as i64);
        self.put("signed", reading.signed);
    }

    fn history(&mut self, seen: &Seen) {
        self.list("modes", seen.modes.clone());
        self.list("armed_states", seen.armed.clone());
        self.list("gps_fixed_states", seen.gps_fixed.clone());
        self.list("ekf_position_states", seen.ekf_position.clone());
        self.list("fence_breach_states", seen.fence_breach.clone());
        if let Some(fence) = seen.last_fence {
            let parts = [
                i64::from(fence.breached),
                i64::from(fence.breaches),
                i64::from(fence.breach_type),
            ];
            self.list("fence", parts);
        }
    }

    fn state(&mut self, vehicle: &Vehicle) {
        let heartbeat = vehicle.heartbeat.expect("a heartbeat");
        self.put("system", i64::from(vehicle.id));
        self.put("mode", heartbeat.mode.to_string());
        self.put("armed", vehicle.armed());
        let statuses = [
            "",
            "boot",
            "calibrating",
            "standby",
            "active",
            "critical",
            "emergency",
        ];
        let named = heartbeat.status.to_string();
        self.put(
            "status",
            statuses
                .iter()
                .position(|name| *name == named)
                .expect("a known status") as i64,
        );
        self.put("landed", vehicle.landed as i64);
        self.put("fence_enabled", vehicle.fence.is_some());
        if let Some(boot_ms) = vehicle.boot_ms {
            self.put("boot_ms", i64::from(boot_ms));
        }
        if let Some(health) = vehicle.health {
            self.list(
                "health_bits",
                [health.present, health.enabled, health.healthy].map(i64::from),
            );
            self.put("load_permille", rounded(health.load_percent * 10.0));
        }
        if let Some(ekf) = vehicle.ekf {
            self.put("ekf_flags", i64::from(ekf.flags.0));
        }
        if let Some(gps) = vehicle.gps {
            self.put("gps_fix", gps.fix as i64);
            self.put("satellites", gps.satellites.map_or(255, i64::from));
            self.put(
                "hdop_c",
                gps.hdop.map_or(65_535, |hdop| rounded(hdop * 100.0)),
            );
        }
        self.put("plan_current", i64::from(vehicle.plan.current));
        self.put("plan_total", vehicle.plan.total.map_or(-1, i64::from));
        self.put("plan_reached", vehicle.plan.reached.map_or(-1, i64::from));
        let texts = vehicle.texts.iter().map(|text| {
            Value::Array(vec![
                (text.severity as i64).to_string().into(),
                text.text.clone().into(),
            ])
        });
        self.list("texts", texts);
    }

    fn motion(&mut self, vehicle: &Vehicle) {
        if let Some(attitude) = vehicle.attitude {
            self.list(
                "attitude_deg",
                [attitude.roll_deg, attitude.pitch_deg, attitude.yaw_deg],
            );
        }
        if let Some(global) = vehicle.global {
            let (lat_e7, lon_e7) = global.at_point.to_e7();
            self.list("position_e7", [lat_e7, lon_e7]);
            self.put("altitude_mm", rounded(global.altitude_m * 1e3));
            self.put("altitude_amsl_mm", rounded(global.altitude_amsl_m * 1e3));
            self.put(
                "heading_cd",
                global
                    .heading_deg
                    .map_or(65_535, |heading| rounded(heading * 100.0)),
            );
            let velocity_m_s = [global.north_m_s, global.east_m_s, global.down_m_s];
            self.list(
                "velocity_cm_s",
                velocity_m_s.map(|part| rounded(part * 100.0)),
            );
        }
        if let Some(local) = vehicle.local {
            self.list("local_m", local.ned_m);
        }
        if let Some(home) = vehicle.home {
            let (lat_e7, lon_e7) = home.at_point.to_e7();
            self.list(
                "home",
                [
                    i64::from(lat_e7),
                    i64::from(lon_e7),
                    rounded(home.altitude_amsl_m * 1e3),
                ],
            );
        }
        if let Some(hud) = vehicle.hud {
            let throttle_percent = f32::from(hud.throttle_percent);
            let speeds = [hud.airspeed_m_s, hud.ground_speed_m_s, hud.climb_m_s];
            let rest = [hud.altitude_amsl_m, throttle_percent, hud.heading_deg];
            self.list("hud", speeds.into_iter().chain(rest));
        }
        if let Some(wind) = vehicle.wind {
            self.list("wind", [wind.from_deg, wind.speed_m_s]);
        }
    }

    fn hardware(&mut self, vehicle: &Vehicle) {
        if let Some(battery) = vehicle.battery() {
            for (key, value) in [
                ("voltage_mv", battery.voltage_v.map(|volts| volts * 1e3)),
                (
                    "current_ca",
                    battery.current_a.map(|amperes| amperes * 100.0),
                ),
                ("consumed_mah", battery.consumed_mah),
                (
                    "consumed_hj",
                    battery.consumed_wh.map(|watt_hours| watt_hours * 36.0),
                ),
                (
                    "remaining_percent",
                    battery.remaining_percent.map(f32::from),
                ),
            ] {
                self.put(key, value.map_or(-1, rounded));
            }
        }
        if let Some(vibration) = vehicle.vibration {
            self.list("vibration_m_s2", vibration.level_m_s2);
        }
        if let Some(rc) = vehicle.rc {
            self.list("rc_us", rc.channels_us.map(i64::from));
        }
        self.list("servos_us", vehicle.servos_us.map(i64::from));
        if let Some(version) = vehicle.version {
            let (major, minor, patch) = version.firmware;
            self.list("firmware", [major, minor, patch].map(i64::from));
            self.put("capabilities", version.capabilities as i64);
            self.put(
                "firmware_hash",
                String::from_utf8_lossy(&version.hash).into_owned(),
            );
        }
    }

    fn parameters(&mut self, inbox: &Inbox) {
        let parameters = inbox.parameters();
        self.put("parameters", parameters.len() as i64);
        let indexed = parameters
            .iter()
            .filter(|(_, parameter)| parameter.index.is_some());
        self.put("parameters_indexed", indexed.count() as i64);
        self.put("parameter_count", parameters.count().map_or(-1, i64::from));
        for (name, parameter) in parameters.iter() {
            self.put(&format!("parameter_{name}"), f64::from(parameter.value));
        }
    }
}

fn rounded(value: impl Into<f64>) -> i64 {
    value.into().round() as i64
}

fn observed(reading: &Reading) -> Table {
    let mut observed = Observed(Table::new());
    observed.link(reading);
    observed.history(&reading.seen);
    observed.state(&reading.vehicle);
    observed.motion(&reading.vehicle);
    observed.hardware(&reading.vehicle);
    observed.parameters(&reading.inbox);
    observed.0
}

/// Equal, floats as far as the facts write them out.
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
            ("rebooted", 0),
            ("two vehicles", 0),
        ] {
            let said = |notice: &&Notice| notice.text.starts_with(begins);
            let count = reading.notices.iter().filter(said).count();
            assert_eq!(count, expected, "{}: {begins}", path.display());
            others -= count;
        }
        assert_eq!(others, texts, "{}: texts", path.display());
    }
}

#[test]
fn local_and_global_targets_name_the_same_places() {
    use sortie::geo::LatLon;
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
