//! The inputs of a flight's simulated vehicles, from which it can be repeated.
//!
//! The file begins with an [`InputsHead`]. Each further line belongs to a step of the simulator: the frames that
//! reached its vehicles after that step, connections made and ended, every 10 s a fingerprint of each vehicle's state,
//! and finally the end. Frames that set keys are left out; they do not change how a vehicle flies.

use std::collections::BTreeMap;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::line::written;
use crate::geo::LatLon;
use crate::sim::{
    Airframe, BootPace, Input, InputKind, PortId, STEP, Serial, Start, VehicleKind, World,
    WorldConfig,
};
use crate::text;
use crate::text::Text;
use crate::wire::{Decoder, SystemId, is_secret};

const VERSION: u32 = 1;
/// The number of steps from one fingerprint to the next, which is 10 s.
const FINGERPRINT_STEPS: u64 = 1000;
/// The longest flight, in steps: a day. A line with a later step counts as damage.
const LONGEST_STEPS: u64 = 24 * 60 * 60 * 100;

/// The simulated world: the first line.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct InputsHead {
    /// The version of the format.
    pub sortie_inputs: u32,
    /// The program that simulated the flight.
    pub program: String,
    /// The seed of the simulator's random numbers.
    pub seed: u64,
    /// The start of each vehicle: latitude and longitude in degrees, altitude in metres above sea level, heading in
    /// degrees; as text, which keeps all digits.
    pub starts: Vec<[String; 4]>,
    /// The kinds of the vehicles, if any is not a copter: one for each; the last one applies to all further vehicles.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub kinds: Vec<String>,
    /// Whether the vehicles were ready at the start; otherwise they booted for a second.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub booted: bool,
    /// The frame files of airframes that the mission does not define, as JSON.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub airframes: Vec<serde_json::Value>,
}

impl InputsHead {
    /// The head for a world; `airframes` are the airframes that the mission does not define.
    pub fn of(world: &WorldConfig, airframes: &[impl AsRef<Airframe>]) -> Self {
        let files = airframes.iter().map(|airframe| airframe.as_ref().file());
        Self {
            sortie_inputs: VERSION,
            program: env!("SORTIE_VERSION").to_owned(),
            seed: world.seed,
            starts: world.starts.iter().map(numbers).collect(),
            kinds: world
                .kinds
                .iter()
                .map(|kind| kind.name().to_owned())
                .collect(),
            booted: world.boot == BootPace::Over,
            airframes: files.flatten().cloned().collect(),
        }
    }

    /// A world with this seed and these starts; the airframes are added later.
    pub fn world(&self) -> WorldConfig {
        let start = |[lat, lon, altitude, heading]: &[String; 4]| {
            let number = |text: &String| text.parse().unwrap_or_default();
            Start {
                at: LatLon::new(number(lat), number(lon)),
                altitude_amsl_m: number(altitude),
                heading_deg: number(heading),
            }
        };
        WorldConfig {
            starts: self.starts.iter().map(start).collect(),
            airframes: Vec::new(),
            kinds: self
                .kinds
                .iter()
                .filter_map(|name| VehicleKind::named(name))
                .collect(),
            seed: self.seed,
            obstacles: Vec::new(),
            boot: if self.booted {
                BootPace::Over
            } else {
                BootPace::Quick
            },
        }
    }

    /// Whether a world has the same seed and the same starts.
    pub fn fits(&self, world: &WorldConfig) -> bool {
        self.seed == world.seed
            && self.starts == world.starts.iter().map(numbers).collect::<Vec<_>>()
    }
}

fn numbers(start: &Start) -> [String; 4] {
    let Start {
        at,
        altitude_amsl_m,
        heading_deg,
    } = *start;
    [at.lat_deg, at.lon_deg, altitude_amsl_m, heading_deg].map(|number| number.to_string())
}

/// A line after the head.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct InputLine {
    /// The number of steps that the simulator had made before the inputs of this line.
    pub s: u64,
    #[serde(flatten)]
    pub what: Entered,
}

/// An input of the simulated vehicles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Entered {
    /// A connection was made: the vehicle counted from 0, the number of the connection, the serial port.
    On(usize, u64, u8),
    /// A connection was ended: vehicle and number.
    Off(usize, u64),
    In(Vec<Frames>),
    /// The speed-up over the wall clock has changed.
    Pace(f64),
    /// The fingerprint of each vehicle's state, in hexadecimal.
    State(Vec<String>),
    /// The flight has ended.
    End,
}

/// Frames of a connection: vehicle, number of the connection, and the bytes in hexadecimal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Frames(pub usize, pub u64, pub String);

/// Records the inputs of a world.
#[derive(Debug)]
pub struct InputLog {
    written: String,
    /// The decoders of the connections: frames are recorded when complete, as the vehicle receives them.
    decoders: BTreeMap<u64, Decoder>,
    pace: Option<f64>,
}

impl InputLog {
    /// Begins the log of a world before its first step, with the existing connections, all of them to serial 0.
    pub fn begin(head: &InputsHead, world: &mut World, connected: &[PortId]) -> Self {
        world.keep_inputs();
        let mut log = Self {
            written: written(head),
            decoders: BTreeMap::new(),
            pace: None,
        };
        for port in connected {
            log.note(0, Entered::On(port.vehicle(), port.number(), 0));
        }
        log
    }

    /// Records new inputs; must be called after each step.
    pub fn follow(&mut self, world: &mut World) {
        self.take_inputs(world);
        if has_fingerprint(world.steps()) {
            self.note_state(world);
        }
    }

    /// Records the speed-up over the wall clock if it has changed.
    pub fn note_pace(&mut self, world: &World, speedup: f64) {
        if self.pace.replace(speedup) != Some(speedup) {
            self.note(world.steps(), Entered::Pace(speedup));
        }
    }

    pub fn end(&mut self, world: &mut World) {
        self.take_inputs(world);
        self.note_state(world);
        self.note(world.steps(), Entered::End);
    }

    /// The lines since the last call.
    pub fn take(&mut self) -> String {
        std::mem::take(&mut self.written)
    }

    fn take_inputs(&mut self, world: &mut World) {
        let mut step = 0;
        let mut frames = Vec::new();
        for input in world.take_inputs() {
            if !frames.is_empty()
                && (input.step != step || !matches!(input.what, InputKind::Bytes(_)))
            {
                self.note(step, Entered::In(std::mem::take(&mut frames)));
            }
            step = input.step;
            let (vehicle, connection) = (input.vehicle, input.connection);
            match input.what {
                InputKind::Connected(serial) => {
                    self.note(step, Entered::On(vehicle, connection, serial.index() as u8));
                }
                InputKind::Disconnected => {
                    self.decoders.remove(&connection);
                    self.note(step, Entered::Off(vehicle, connection));
                }
                InputKind::Bytes(bytes) => {
                    let hex = self.whole_frames(connection, &bytes);
                    frames.extend((!hex.is_empty()).then_some(Frames(vehicle, connection, hex)));
                }
            }
        }
        if !frames.is_empty() {
            self.note(step, Entered::In(frames));
        }
    }

    /// The frames that are complete with these bytes of a connection, in hexadecimal.
    fn whole_frames(&mut self, connection: u64, bytes: &[u8]) -> String {
        let decoder = self.decoders.entry(connection).or_default();
        decoder.push(bytes);
        let mut hex = String::new();
        while let Some(frame) = decoder.next_frame() {
            if !is_secret(frame.content.id()) {
                push_hex(&mut hex, decoder.bytes_of(&frame));
            }
        }
        hex
    }

    fn note_state(&mut self, world: &World) {
        let prints = (0..world.vehicles()).map(|vehicle| fingerprint(world, vehicle));
        self.note(world.steps(), Entered::State(prints.collect()));
    }

    fn note(&mut self, s: u64, what: Entered) {
        self.written.push_str(&written(&InputLine { s, what }));
    }
}

/// Whether the fingerprints of all vehicles are recorded after this number of steps.
pub fn has_fingerprint(step: u64) -> bool {
    step > 0 && step.is_multiple_of(FINGERPRINT_STEPS)
}

/// The fingerprint of a vehicle in hexadecimal digits.
pub fn fingerprint(world: &World, vehicle: usize) -> String {
    format!("{:016x}", world.fingerprint(vehicle))
}

/// A log of inputs, as read from its file.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredInputs {
    pub head: InputsHead,
    /// The inputs, in order.
    pub lines: Vec<InputLine>,
    /// The damage to the file after its readable part.
    pub damage: Option<Text>,
    /// Whether the damage is more than a missing end.
    is_damaged: bool,
}

impl StoredInputs {
    /// Reads a log. A line that is damaged, goes back in time or follows the end stops it.
    ///
    /// # Errors
    /// The text is not a log of inputs, or comes from another version.
    pub fn read(text: &str) -> Result<Self, Text> {
        let mut all = text.split_inclusive('\n');
        let head: InputsHead = serde_json::from_str(all.next().unwrap_or_default())
            .map_err(|error| text!("record-head", error = error.to_string()))?;
        if head.sortie_inputs != VERSION {
            return Err(text!(
                "record-version",
                version = head.sortie_inputs,
                known = VERSION
            ));
        }
        if head.starts.len() > usize::from(SystemId::MAX) {
            return Err(text!("verify-too-many", count = head.starts.len()));
        }
        let mut stored = Self {
            head,
            lines: Vec::new(),
            damage: None,
            is_damaged: false,
        };
        let mut since = 0;
        for (index, line) in all.enumerate() {
            let parsed = serde_json::from_str(line).ok();
            let in_order = parsed.filter(|line: &InputLine| {
                (since..=LONGEST_STEPS).contains(&line.s) && !stored.is_whole()
            });
            let Some(read) = in_order else {
                stored.break_off(index + 2, !line.ends_with('\n'));
                break;
            };
            since = read.s;
            stored.lines.push(read);
        }
        if stored.damage.is_none() && !stored.is_whole() {
            stored.damage = Some(text!("verify-no-end"));
        }
        Ok(stored)
    }

    /// Ends the log before a line of the file. A killed console may leave a part of a line, which is not damage.
    fn break_off(&mut self, line: usize, is_torn: bool) {
        self.is_damaged = !is_torn;
        self.damage = Some(if is_torn {
            text!("verify-torn", line = line)
        } else {
            text!("verify-damaged", line = line)
        });
    }

    /// Whether it covers the whole flight.
    pub fn is_whole(&self) -> bool {
        matches!(self.lines.last(), Some(line) if line.what == Entered::End)
    }

    /// Whether it is intact but without its end.
    pub fn is_cut(&self) -> bool {
        !self.is_whole() && !self.is_damaged
    }

    /// Whether it has a fingerprint of the vehicles, with which a repeated flight can be compared.
    pub fn has_fingerprints(&self) -> bool {
        let mut lines = self.lines.iter();
        lines.any(|line| matches!(line.what, Entered::State(_)))
    }

    /// The time that the log covers.
    pub fn lasts(&self) -> Duration {
        self.lines.last().map_or(Duration::ZERO, InputLine::at)
    }
}

impl InputLine {
    /// The simulated time of the line.
    pub fn at(&self) -> Duration {
        STEP * u32::try_from(self.s).unwrap_or(u32::MAX)
    }

    /// The inputs of a line for a world; `None` if it has none, or if they are invalid.
    pub fn inputs(&self) -> Option<Vec<Input>> {
        let input = |vehicle, connection, what| Input {
            step: self.s,
            vehicle,
            connection,
            what,
        };
        match &self.what {
            Entered::On(vehicle, connection, serial) => {
                let serial = *Serial::ALL.get(usize::from(*serial))?;
                Some(vec![input(
                    *vehicle,
                    *connection,
                    InputKind::Connected(serial),
                )])
            }
            Entered::Off(vehicle, connection) => {
                Some(vec![input(*vehicle, *connection, InputKind::Disconnected)])
            }
            Entered::In(frames) => frames
                .iter()
                .map(|Frames(vehicle, connection, hex)| {
                    Some(input(
                        *vehicle,
                        *connection,
                        InputKind::Bytes(from_hex(hex)?),
                    ))
                })
                .collect(),
            Entered::Pace(_) | Entered::State(_) | Entered::End => Some(Vec::new()),
        }
    }
}

fn push_hex(hex: &mut String, bytes: &[u8]) {
    for byte in bytes {
        for nibble in [byte >> 4, byte & 15] {
            hex.extend(char::from_digit(u32::from(nibble), 16));
        }
    }
}

fn from_hex(hex: &str) -> Option<Vec<u8>> {
    let digits = hex
        .chars()
        .map(|digit| Some(digit.to_digit(16)? as u8))
        .collect::<Option<Vec<u8>>>()?;
    let is_even = digits.len().is_multiple_of(2);
    is_even.then(|| {
        digits
            .chunks_exact(2)
            .map(|pair| pair[0] << 4 | pair[1])
            .collect()
    })
}
