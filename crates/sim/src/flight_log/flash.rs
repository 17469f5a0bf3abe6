//! A flight log in `ArduPilot`'s binary format: self-describing records of fixed length.
//!
//! Samples are kept in a compact form; the file is generated from them when a ground station reads it.

use mavlink::dialects::ardupilotmega::GpsFixType;

use super::sample::LogSample;
use crate::parameters::Parameters;

/// Every record begins with these bytes and its type.
const HEAD: [u8; 2] = [0xA3, 0x95];
/// The records: type, length, name, format and columns.
const FORMATS: &[(u8, u8, &str, &str, &str)] = &[
    (
        FORMAT,
        89,
        "FMT",
        "BBnNZ",
        "Type,Length,Name,Format,Columns",
    ),
    (PARAMETER, 35, "PARM", "QNff", "TimeUS,Name,Value,Default"),
    (TEXT, 75, "MSG", "QZ", "TimeUS,Message"),
    (MODE, 14, "MODE", "QMBB", "TimeUS,Mode,ModeNum,Rsn"),
    (
        GPS,
        51,
        "GPS",
        "QBBIHBcLLeffffB",
        "TimeUS,I,Status,GMS,GWk,NSats,HDop,Lat,Lng,Alt,Spd,GCrs,VZ,Yaw,U",
    ),
    (
        ATTITUDE,
        28,
        "ATT",
        "QccccCCCCB",
        "TimeUS,DesRoll,Roll,DesPitch,Pitch,DesYaw,Yaw,ErrRP,ErrYaw,AEKF",
    ),
    (
        POSITION,
        31,
        "POS",
        "QLLfff",
        "TimeUS,Lat,Lng,Alt,RelHomeAlt,RelOriginAlt",
    ),
    (EVENT, 12, "EV", "QB", "TimeUS,Id"),
    (ESTIMATOR, 20, "XKF4", "QBcccc", "TimeUS,C,SV,SP,SH,SM"),
    (
        BATTERY,
        41,
        "BAT",
        "QBfffffcfBBB",
        "TimeUS,Inst,Volt,VoltR,Curr,CurrTot,EnrgTot,Temp,Res,RemPct,H,SH",
    ),
];
const FORMAT: u8 = 0x80;
const PARAMETER: u8 = 64;
const TEXT: u8 = 65;
const MODE: u8 = 66;
const GPS: u8 = 67;
const ATTITUDE: u8 = 68;
const POSITION: u8 = 69;
const BATTERY: u8 = 70;
const EVENT: u8 = 71;
const ESTIMATOR: u8 = 72;
/// `EV.Id` of arming, and of disarming.
pub(super) const ARMED: u8 = 10;
pub(super) const DISARMED: u8 = 11;
const TEXT_BYTES: usize = 64;
const RTK_FIXED: u8 = GpsFixType::GPS_FIX_TYPE_RTK_FIXED as u8;
const WEEK_MS: u64 = 7 * 24 * 3600 * 1000;
/// Milliseconds of the Unix epoch at which GPS time began (1980-01-06), and the leap seconds since.
const GPS_EPOCH_MS: u64 = 315_964_800_000;
const LEAP_MS: u64 = 18_000;

/// The groups of records in a log.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Groups {
    pub(crate) attitude: bool,
    pub(crate) gps: bool,
    pub(crate) battery: bool,
}

/// The log of one flight, in compact form.
#[derive(Debug, Clone)]
pub(crate) struct RecordedLog {
    pub(crate) number: u16,
    pub(crate) groups: Groups,
    /// The parameters when the log began.
    pub(crate) parameters: Parameters,
    /// Milliseconds of the Unix epoch at boot.
    pub(crate) boot_utc_ms: u64,
    pub(crate) samples: Vec<LogSample>,
    /// Milliseconds since boot, and the mode's number.
    pub(crate) modes: Vec<(u32, u8)>,
    /// Milliseconds since boot, and the event's number.
    pub(crate) events: Vec<(u32, u8)>,
    pub(crate) texts: Vec<(u32, String)>,
}

impl RecordedLog {
    /// The name of the log's file, such as `00000012.BIN`.
    pub(crate) fn file_name(&self) -> String {
        format!("{:08}.BIN", self.number)
    }

    /// The length of the log's file in bytes, computed without the file.
    pub(crate) fn len(&self) -> usize {
        let groups = [
            (self.groups.gps, GPS),
            (self.groups.gps, POSITION),
            (self.groups.attitude, ATTITUDE),
            (self.groups.attitude, ESTIMATOR),
            (self.groups.battery, BATTERY),
        ];
        let sample: usize = groups
            .into_iter()
            .filter(|(kept, _)| *kept)
            .map(|(_, kind)| record_len(kind))
            .sum();
        FORMATS.len() * record_len(FORMAT)
            + usize::from(self.parameters.count()) * record_len(PARAMETER)
            + self.samples.len() * sample
            + self.modes.len() * record_len(MODE)
            + self.events.len() * record_len(EVENT)
            + self.texts.len() * record_len(TEXT)
    }

    /// The log's file: formats, parameters, then the records in order of time.
    pub(crate) fn file(&self) -> Vec<u8> {
        let mut file = FlashFile(Vec::with_capacity(self.len()));
        for (kind, length, name, format, columns) in FORMATS {
            let record = file.begin(FORMAT).bytes(&[*kind, *length]);
            record.text(name, 4).text(format, 16).text(columns, 64);
        }
        let begin_ms = self.begin_ms();
        let parameters = &self.parameters;
        for parameter in (0..parameters.count()).filter_map(|index| parameters.at(index)) {
            let default = parameter.default;
            let record = file.record(PARAMETER, begin_ms).text(parameter.name, 16);
            record.float(parameter.value).float(default);
        }
        let (mut modes, mut texts) = (
            self.modes.iter().copied().peekable(),
            self.texts.iter().peekable(),
        );
        let mut events = self.events.iter().copied().peekable();
        for sample in &self.samples {
            while let Some((at_ms, id)) = events.next_if(|(at, _)| *at <= sample.boot_ms) {
                file.record(EVENT, at_ms).bytes(&[id]);
            }
            while let Some((at_ms, number)) = modes.next_if(|(at, _)| *at <= sample.boot_ms) {
                file.mode(at_ms, number);
            }
            while let Some((at_ms, text)) = texts.next_if(|(at, _)| *at <= sample.boot_ms) {
                file.said(*at_ms, text);
            }
            file.sample(self, sample);
        }
        events.for_each(|(at_ms, id)| {
            file.record(EVENT, at_ms).bytes(&[id]);
        });
        modes.for_each(|(at_ms, number)| file.mode(at_ms, number));
        texts.for_each(|(at_ms, text)| file.said(*at_ms, text));
        file.0
    }

    /// The time at which the log begins, in milliseconds since boot.
    pub(crate) fn begin_ms(&self) -> u32 {
        let first = [
            self.samples.first().map(|sample| sample.boot_ms),
            self.modes.first().map(|(at, _)| *at),
            self.texts.first().map(|(at, _)| *at),
        ];
        first.into_iter().flatten().min().unwrap_or(0)
    }
}

fn record_len(kind: u8) -> usize {
    let format = FORMATS.iter().find(|(known, ..)| *known == kind);
    format.map_or(0, |(_, length, ..)| usize::from(*length))
}

struct FlashFile(Vec<u8>);

impl FlashFile {
    fn begin(&mut self, kind: u8) -> &mut Self {
        self.bytes(&HEAD).bytes(&[kind])
    }

    fn record(&mut self, kind: u8, boot_ms: u32) -> &mut Self {
        let micros = u64::from(boot_ms) * 1000;
        self.begin(kind).bytes(&micros.to_le_bytes())
    }

    fn bytes(&mut self, bytes: &[u8]) -> &mut Self {
        self.0.extend_from_slice(bytes);
        self
    }

    fn float(&mut self, value: f32) -> &mut Self {
        self.bytes(&value.to_le_bytes())
    }

    /// Appends a text as a field of fixed length, padded with zeros.
    fn text(&mut self, text: &str, length: usize) -> &mut Self {
        let end = self.0.len() + length;
        let shown = text.len().min(length);
        self.bytes(&text.as_bytes()[..shown]);
        self.0.resize(end, 0);
        self
    }

    fn mode(&mut self, at_ms: u32, number: u8) {
        self.record(MODE, at_ms).bytes(&[number, number, 0]);
    }

    fn said(&mut self, at_ms: u32, text: &str) {
        self.record(TEXT, at_ms).text(text, TEXT_BYTES);
    }

    fn sample(&mut self, log: &RecordedLog, sample: &LogSample) {
        if log.groups.gps {
            self.position(log, sample);
        }
        if log.groups.attitude {
            self.record(ATTITUDE, sample.boot_ms);
            for angle in [
                sample.roll_cd,
                sample.roll_cd,
                sample.pitch_cd,
                sample.pitch_cd,
            ] {
                self.bytes(&angle.to_le_bytes());
            }
            for angle in [sample.yaw_cd, sample.yaw_cd, 0, 0] {
                self.bytes(&angle.to_le_bytes());
            }
            self.bytes(&[3]);
            self.record(ESTIMATOR, sample.boot_ms).bytes(&[0]);
            for ratio in sample.ratios_percent {
                self.bytes(&i16::from(ratio).to_le_bytes());
            }
        }
        if log.groups.battery {
            let voltage = f32::from(sample.voltage_cv) * 0.01;
            let consumed = f32::from(sample.consumed_mah);
            self.record(BATTERY, sample.boot_ms).bytes(&[0]);
            self.float(voltage).float(voltage);
            self.float(f32::from(sample.current_ca) * 0.01);
            self.float(consumed).float(consumed * voltage * 0.001);
            self.bytes(&[0; 2]).float(0.0);
            self.bytes(&[sample.remaining_percent, 1, 0]);
        }
    }

    fn position(&mut self, log: &RecordedLog, sample: &LogSample) {
        let utc_ms = log.boot_utc_ms + u64::from(sample.boot_ms);
        let gps_ms = utc_ms.saturating_sub(GPS_EPOCH_MS) + LEAP_MS;
        let metres = |cm: i32| cm as f32 * 0.01;
        self.record(GPS, sample.boot_ms).bytes(&[0, RTK_FIXED]);
        self.bytes(&((gps_ms % WEEK_MS) as u32).to_le_bytes());
        self.bytes(&((gps_ms / WEEK_MS) as u16).to_le_bytes());
        self.bytes(&[sample.satellites])
            .bytes(&121_u16.to_le_bytes());
        for value in [sample.lat_e7, sample.lon_e7, sample.altitude_amsl_cm] {
            self.bytes(&value.to_le_bytes());
        }
        self.float(f32::from(sample.speed_cm_s) * 0.01)
            .float(f32::from(sample.course_cd) * 0.01)
            .float(f32::from(sample.down_cm_s) * 0.01)
            .float(0.0)
            .bytes(&[1]);
        self.record(POSITION, sample.boot_ms);
        for value in [sample.lat_e7, sample.lon_e7] {
            self.bytes(&value.to_le_bytes());
        }
        for height in [
            sample.altitude_amsl_cm,
            sample.above_home_cm,
            sample.above_origin_cm,
        ] {
            self.float(metres(height));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn log() -> RecordedLog {
        RecordedLog {
            number: 1,
            groups: Groups {
                attitude: true,
                gps: true,
                battery: true,
            },
            parameters: Parameters::new(crate::VehicleKind::Copter, 1),
            boot_utc_ms: 1_767_225_600_000,
            samples: vec![LogSample::default(); 3],
            modes: vec![(0, 4)],
            events: vec![(0, 10)],
            texts: vec![(5, "ArduCopter".to_owned())],
        }
    }

    #[test]
    fn every_format_has_the_length_that_its_letters_add_up_to() {
        for (_, length, name, format, columns) in FORMATS {
            let letters = format.chars().map(|letter| match letter {
                'B' | 'M' => 1,
                'c' | 'C' | 'H' => 2,
                'f' | 'L' | 'e' | 'I' | 'n' => 4,
                'Q' => 8,
                'N' => 16,
                'Z' => 64,
                other => panic!("letter {other}"),
            });
            assert_eq!(letters.sum::<usize>() + 3, usize::from(*length), "{name}");
            assert_eq!(columns.split(',').count(), format.len(), "{name}");
        }
    }

    #[test]
    fn the_file_is_made_of_whole_records_and_as_long_as_announced() {
        let file = log().file();
        assert_eq!(file.len(), log().len());
        let mut at = 0;
        while at < file.len() {
            assert_eq!(file[at..at + 2], HEAD, "at {at}");
            at += record_len(file[at + 2]);
        }
        assert_eq!(at, file.len());
    }
}
