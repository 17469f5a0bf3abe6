//! Tests with logs made by hand, both intact and damaged.

use proptest::prelude::*;

use super::*;

#[derive(Default)]
struct Maker(Vec<u8>);

/// The records of the test: type, name, letters, columns.
const FORMATS: &[(u8, &str, &str, &str)] = &[
    (1, "PARM", "QNf", "TimeUS,Name,Value"),
    (2, "MODE", "QMBB", "TimeUS,Mode,ModeNum,Rsn"),
    (3, "ERR", "QBB", "TimeUS,Subsys,ECode"),
    (4, "EV", "QB", "TimeUS,Id"),
    (5, "VIBE", "QBfffI", "TimeUS,IMU,VibeX,VibeY,VibeZ,Clip"),
    (6, "XKF4", "QBcccc", "TimeUS,C,SV,SP,SH,SM"),
    (7, "BAT", "QBff", "TimeUS,Inst,Volt,Curr"),
    (8, "GPS", "QBBIH", "TimeUS,I,Status,GMS,GWk"),
    (9, "MSG", "QZ", "TimeUS,Message"),
];

impl Maker {
    fn with_formats() -> Self {
        let mut log = Self::default();
        for (kind, name, letters, columns) in FORMATS {
            let sizes = letters.chars().map(|letter| match letter {
                'B' | 'M' => 1,
                'c' | 'H' => 2,
                'f' | 'I' => 4,
                'Q' => 8,
                'N' => 16,
                _ => 64,
            });
            let length = 3 + sizes.sum::<u8>();
            log.0.extend([0xA3, 0x95, 0x80, *kind, length]);
            log.text(name, 4).text(letters, 16).text(columns, 64);
        }
        log
    }

    fn text(&mut self, text: &str, length: usize) -> &mut Self {
        let end = self.0.len() + length;
        self.0.extend(text.as_bytes());
        self.0.resize(end, 0);
        self
    }

    fn record(&mut self, kind: u8, ms: u64, rest: &[u8]) -> &mut Self {
        self.0.extend([0xA3, 0x95, kind]);
        self.0.extend((ms * 1000).to_le_bytes());
        self.0.extend(rest);
        self
    }

    fn parameter(&mut self, ms: u64, name: &str, value: f32) -> &mut Self {
        self.record(1, ms, &[]).text(name, 16);
        self.0.extend(value.to_le_bytes());
        self
    }

    fn floats(&mut self, values: &[f32]) -> &mut Self {
        self.0.extend(values.iter().flat_map(|it| it.to_le_bytes()));
        self
    }

    fn vibration(&mut self, ms: u64, z: f32, clips: u32) -> &mut Self {
        self.record(5, ms, &[0]).floats(&[1.0, 1.0, z]);
        self.0.extend(clips.to_le_bytes());
        self
    }

    fn ratios(&mut self, ms: u64, hundredths: [i16; 4]) -> &mut Self {
        self.record(6, ms, &[0]);
        self.0
            .extend(hundredths.iter().flat_map(|it| it.to_le_bytes()));
        self
    }
}

fn flight() -> Vec<u8> {
    let mut log = Maker::with_formats();
    log.parameter(1000, "SYSID_THISMAV", 3.0)
        .parameter(1000, "WPNAV_SPEED", 500.0);
    log.record(9, 1000, &[]).text("ArduCopter V4.6.0-dev", 64);
    log.record(4, 2000, &[10]).record(2, 2500, &[4, 4, 2]);
    // 2026-01-01 00:00:20 UTC is second 345 638 of GPS week 2399.
    log.record(8, 3000, &[0, 3]);
    log.0.extend(345_638_000_u32.to_le_bytes());
    log.0.extend(2399_u16.to_le_bytes());
    log.parameter(9000, "WPNAV_SPEED", 800.0);
    for (ms, z, clips) in [(10_000, 12.0, 0), (10_100, 35.0, 1), (10_200, 61.0, 3)] {
        log.vibration(ms, z, clips);
    }
    log.ratios(11_000, [20, 30, 40, 50])
        .ratios(11_100, [20, 130, 40, 50])
        .ratios(11_200, [20, 170, 40, 50]);
    for (ms, volt) in [(12_000, 12.6), (13_000, 10.1), (14_000, 11.9)] {
        log.record(7, ms, &[0]).floats(&[volt, 22.0]);
    }
    log.record(3, 15_000, &[6, 1]).record(2, 15_100, &[6, 6, 4]);
    log.record(4, 20_000, &[11]);
    log.0
}

fn texts(flight: &LoggedFlight) -> Vec<String> {
    let said = |it: &LoggedMoment| format!("{} {}", it.time_us / 1000, it.event.text());
    flight.moments.iter().map(said).collect()
}

#[test]
fn a_log_tells_its_flight() {
    let flight = LoggedFlight::read(&flight()).expect("a log");
    assert_eq!(
        texts(&flight),
        [
            "2000 event ARMED",
            "2500 mode GUIDED (GCS_COMMAND)",
            "9000 WPNAV_SPEED = 800 (was 500)",
            "10100 vibration up to 61 m/s²",
            "10100 accelerometers clipped 3 times",
            "11100 the EKF rejects the position: test ratio up to 1.70",
            "13000 battery 1: lowest 10.10 V at 22.0 A",
            "15000 error FAILSAFE_BATT: OCCURRED",
            "15100 mode RTL (BATTERY_FAILSAFE)",
            "20000 event DISARMED",
        ]
    );
    assert_eq!(flight.vehicle, Some(3));
    assert_eq!(flight.span_us, Some((1_000_000, 20_000_000)));
    assert_eq!(flight.armed_us, [2_000_000]);
    assert_eq!(flight.booted_unix_us, Some(1_767_225_617_000_000));
    assert_eq!(flight.damage, LogDamage::default());
    let until = std::time::Duration::from_secs(14);
    let readings = |channel| flight.curves.readings(channel, until, 5);
    let shaking = [Some(61.0), None, None, None, None];
    assert_eq!(readings(LogChannel::Vibration), shaking);
    let rejecting = [None, Some(1.7), None, None, None];
    assert_eq!(readings(LogChannel::Estimator), rejecting);
    let volts = [None, None, Some(12.6), Some(10.1), Some(11.9)];
    assert_eq!(readings(LogChannel::Voltage), volts);
}

#[test]
fn what_is_no_log_says_so_and_a_cut_one_how_much_is_missing() {
    for bytes in [&b""[..], b"# a text\n", &[0xA3, 0x95], &[0xA3, 0x95, 7, 0]] {
        let fault = LoggedFlight::read(bytes).expect_err("no log");
        assert!(fault.to_string().contains("not a DataFlash log"), "{fault}");
    }
    let formats = Maker::with_formats().0;
    let fault = LoggedFlight::read(&formats).expect_err("an empty one");
    assert!(fault.to_string().contains("no flight data"), "{fault}");
    let whole = flight();
    let cut = LoggedFlight::read(&whole[..whole.len() - 4]).expect("a log");
    assert_eq!(cut.damage.cut_off, 8);
    let words = cut.damage.text().expect("words").to_string();
    assert_eq!(
        words,
        "the log is cut off: its last 8 bytes are an incomplete record"
    );
    assert_eq!(cut.moments.len(), 9);
}

#[test]
fn bytes_between_records_are_counted_and_passed_over() {
    let mut log = Maker::with_formats();
    log.record(4, 2000, &[10]);
    log.0.extend([7; 100]);
    log.record(4, 3000, &[11]);
    let flight = LoggedFlight::read(&log.0).expect("a log");
    assert_eq!(texts(&flight), ["2000 event ARMED", "3000 event DISARMED"]);
    assert_eq!(flight.damage.skipped, 100);
}

#[test]
fn a_format_that_makes_no_sense_describes_nothing() {
    // Invalid formats: a length below that of the head, and letters that do not add up to the
    // length.
    for (length, letters) in [(2_u8, "QB"), (255, "QB"), (12, "Q?")] {
        let mut log = Maker::with_formats();
        log.0.extend([0xA3, 0x95, 0x80, 4, length]);
        log.text("EV", 4).text(letters, 16).text("TimeUS,Id", 64);
        log.record(4, 2000, &[10]);
        let flight = LoggedFlight::read(&log.0).expect("a log");
        assert_eq!(texts(&flight), ["2000 event ARMED"]);
        assert!(flight.damage.skipped > 0);
    }
}

#[test]
fn one_damaged_time_neither_hides_the_log_nor_counts() {
    for far in [u64::MAX / 2000, 1 << 40] {
        let mut log = Maker::with_formats();
        log.parameter(far, "SYSID_THISMAV", 3.0);
        log.parameter(1000, "SYSID_THISMAV", 3.0);
        for second in 2..8 {
            log.record(4, second * 1000, &[10]);
        }
        let flight = LoggedFlight::read(&log.0).expect("a log");
        assert_eq!(flight.span_us, Some((1_000_000, 7_000_000)));
        assert_eq!(flight.vehicle, Some(3));
        assert_eq!(flight.damage.skipped, 31);
    }
}

#[test]
fn what_is_beyond_the_most_of_a_kind_is_counted_and_hides_no_other_kind() {
    let mut log = Maker::with_formats();
    for ms in 0..6000 {
        log.record(2, 1000 + ms, &[4, 4, 2]);
    }
    log.vibration(7100, 35.0, 0).vibration(7200, 90.0, 0);
    log.record(4, 8000, &[11]);
    let flight = LoggedFlight::read(&log.0).expect("a log");
    assert_eq!(flight.moments.len(), 1002);
    assert_eq!(flight.damage.left_out, 5000);
    let words = flight.damage.text().expect("words").to_string();
    assert!(words.contains("5000 events are left out"), "{words}");
    let last = &texts(&flight)[1000..];
    assert_eq!(
        last,
        ["7100 vibration up to 90 m/s²", "8000 event DISARMED"]
    );
}

#[test]
fn readings_that_are_none_become_no_figures() {
    let mut log = Maker::with_formats();
    // A parameter may be a double in logs of other programs.
    log.0.extend([0xA3, 0x95, 0x80, 1, 35]);
    log.text("PARM", 4)
        .text("QNd", 16)
        .text("TimeUS,Name,Value", 64);
    for value in [1.0, 1e300_f64] {
        log.record(1, 1000, &[]).text("X", 16);
        log.0.extend(value.to_le_bytes());
    }
    log.vibration(2000, 1e37, 5)
        .vibration(2500, f32::INFINITY, 2);
    log.vibration(3000, 1.0, u32::MAX);
    log.record(7, 4000, &[255]).floats(&[10.0, 1.0]);
    log.vibration(5000, 1.0, 0).vibration(5001, 1.0, u32::MAX);
    let flight = LoggedFlight::read(&log.0).expect("a log");
    let texts = texts(&flight).join("\n");
    assert!(!texts.contains("inf"), "{texts}");
    assert!(texts.contains("battery 256: lowest"), "{texts}");
    assert!(texts.contains("clipped 4294967295 times"), "{texts}");
    let alignment = Alignment::identity();
    let length = std::time::Duration::from_secs(60);
    let joined = JoinedLog::new(1, "log.bin", &flight, &alignment, length);
    assert!(JoinedLog::read(&joined.to_json()).is_ok());
}

#[test]
fn many_armings_are_compared_in_no_time() {
    let mut log = Maker::with_formats();
    for ms in 0..50_000 {
        log.record(4, 1000 + ms, &[10]);
    }
    let flight = LoggedFlight::read(&log.0).expect("a log");
    assert_eq!(flight.armed_us.len(), clock::MOST_ARMINGS);
}

proptest! {
    /// A log with changed bytes, cut anywhere, is either read or refused with a text, and its joined part can be read
    /// again.
    #[test]
    fn broken_logs_do_no_harm(
        changes in proptest::collection::vec((any::<proptest::sample::Index>(), any::<u8>()), 0..40),
        cut in any::<proptest::sample::Index>(),
    ) {
        let mut bytes = flight();
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        bytes.truncate(cut.index(bytes.len()) + 1);
        if let Ok(flight) = LoggedFlight::read(&bytes) {
            let texts = texts(&flight);
            prop_assert_eq!(texts.len(), flight.moments.len());
            prop_assert!(flight.damage.skipped + flight.damage.cut_off <= bytes.len());
            let length = std::time::Duration::from_secs(600);
            let joined = JoinedLog::new(1, "log.bin", &flight, &Alignment::identity(), length);
            prop_assert!(JoinedLog::read(&joined.to_json()).is_ok());
        }
    }

    #[test]
    fn any_bytes_do_no_harm(bytes in proptest::collection::vec(prop_oneof![Just(0xA3), Just(0x95), Just(0x80), any::<u8>()], 0..2000)) {
        drop(LoggedFlight::read(&bytes));
    }
}
