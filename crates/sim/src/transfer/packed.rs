//! Parameters as a file: `@PARAM/param.pck`.
//!
//! A header of three 16-bit numbers (magic, parameters in the file, total parameters), then per parameter: a byte with
//! the type in its low half and flags in its high half; a byte with the number of letters shared with the previous name
//! in its low half, and the number of further letters less one in its high half; the further letters; the value; its
//! default, if the flag is set. Zeros before a parameter keep a value within one block of the size in which the file is
//! read.

use crate::parameters::{Kind, Parameter, Parameters};

const MAGIC: u16 = 0x671B;
const MAGIC_WITH_DEFAULTS: u16 = 0x671C;
const HEADER: usize = 6;
const NAME: usize = 16;
/// Bytes per parameter in the length that is reported before the file is packed.
const ESTIMATE: usize = 12;
const FILE: &str = "param.pck";

/// The parameters that a ground station requests.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct PackRequest {
    start: usize,
    /// The number of parameters; 0 for all that follow.
    count: usize,
    with_defaults: bool,
}

/// Whether a name is that of the parameter file, with or without a query.
pub(super) fn is_name(name: &str) -> bool {
    let rest = name.strip_prefix(FILE);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('?'))
}

/// The reported length of the file.
pub(super) fn estimated_len(parameters: &Parameters) -> usize {
    usize::from(parameters.count()) * ESTIMATE
}

impl PackRequest {
    /// Reads `start`, `count` and `withdefaults` from the query in a name; `None` if a value is
    /// invalid.
    pub(super) fn read(name: &str) -> Option<Self> {
        let mut wanted = Self::default();
        let query = name.split_once('?').map_or("", |(_, query)| query);
        for part in query.split('&') {
            let Some((key, value)) = part.split_once('=') else {
                continue;
            };
            // Numbers are read as in C: the leading digits, or nothing at all.
            let digits = value.len() - value.trim_start_matches(|c: char| c.is_ascii_digit()).len();
            let value: usize = value[..digits].parse().unwrap_or(0);
            match key {
                "start" if value < usize::from(u16::MAX) => wanted.start = value,
                "count" if value < usize::from(u16::MAX) => wanted.count = value,
                "withdefaults" if value <= 1 => wanted.with_defaults = value == 1,
                "start" | "count" | "withdefaults" => return None,
                _ => {}
            }
        }
        Some(wanted)
    }

    /// The file, packed for reads of `block` bytes; `None` if it would begin after the last
    /// parameter.
    pub(super) fn pack(self, parameters: &Parameters, block: usize) -> Option<Vec<u8>> {
        let total = usize::from(parameters.count());
        let mut packed = total.checked_sub(self.start).filter(|left| *left > 0)?;
        if self.count > 0 {
            packed = packed.min(self.count);
        }
        let magic = if self.with_defaults {
            MAGIC_WITH_DEFAULTS
        } else {
            MAGIC
        };
        let mut file = Vec::with_capacity(packed * ESTIMATE);
        for number in [magic, packed as u16, total as u16] {
            file.extend_from_slice(&number.to_le_bytes());
        }
        let mut before = "";
        for index in self.start..self.start + packed {
            let Some(parameter) = parameters.at(index as u16) else {
                break;
            };
            let default = self.with_defaults.then_some(parameter.default);
            append(&mut file, &parameter, before, default, block);
            before = parameter.name;
        }
        Some(file)
    }
}

/// Appends a parameter that follows the one named `before`.
fn append(
    file: &mut Vec<u8>,
    parameter: &Parameter,
    before: &str,
    default: Option<f32>,
    block: usize,
) {
    let name = parameter.name;
    let same = name.bytes().zip(before.bytes()).take_while(|(a, b)| a == b);
    // At least one letter is always written.
    let shared = same.count().min(name.len().saturating_sub(1));
    let own = &name.as_bytes()[shared..];
    let value = bytes_of(parameter.kind, parameter.value);
    let default = default
        .filter(|default| (default - parameter.value).abs() > f32::EPSILON)
        .map(|default| bytes_of(parameter.kind, default));
    let length = 2 + own.len() + value.len() + default.as_ref().map_or(0, Vec::len);
    let over = (file.len() + length) % block.max(1);
    if value.len() > 1 && over > 0 && over < value.len() {
        file.resize(file.len() + value.len() - over, 0);
    }
    let flags = u8::from(default.is_some());
    file.push(type_of(parameter.kind) | flags << 4);
    file.push(shared as u8 | ((own.len() - 1) as u8) << 4);
    file.extend_from_slice(own);
    file.extend_from_slice(&value);
    file.extend(default.unwrap_or_default());
}

/// The names and values of a file that a ground station wrote, where the third number of the header is the length
/// of the file in bytes. `None` if it is not complete.
pub(super) fn unpack(file: &[u8]) -> Option<Vec<(String, f32)>> {
    let number = |at: usize| Some(u16::from_le_bytes([*file.get(at)?, *file.get(at + 1)?]));
    if number(0)? != MAGIC || usize::from(number(4)?) != file.len() {
        return None;
    }
    let mut rest = file.get(HEADER..)?;
    let mut name: Vec<u8> = Vec::new();
    let mut values = Vec::new();
    for _ in 0..number(2)? {
        let (&[kind, lengths], after) = rest.split_first_chunk()?;
        let (shared, own) = (usize::from(lengths & 15), usize::from(lengths >> 4) + 1);
        if kind >> 4 != 0 || shared > name.len() || shared + own > NAME {
            return None;
        }
        let (letters, after) = after.split_at_checked(own)?;
        name.truncate(shared);
        name.extend_from_slice(letters);
        let (value, after) = read_value(kind, after)?;
        values.push((String::from_utf8_lossy(&name).into_owned(), value));
        rest = after;
    }
    Some(values)
}

fn read_value(kind: u8, bytes: &[u8]) -> Option<(f32, &[u8])> {
    match kind {
        1 => bytes
            .split_first()
            .map(|(value, rest)| (f32::from(*value as i8), rest)),
        2 => bytes
            .split_first_chunk()
            .map(|(value, rest)| (f32::from(i16::from_le_bytes(*value)), rest)),
        3 => bytes
            .split_first_chunk()
            .map(|(value, rest)| (i32::from_le_bytes(*value) as f32, rest)),
        _ => bytes
            .split_first_chunk()
            .map(|(value, rest)| (f32::from_le_bytes(*value), rest)),
    }
}

fn type_of(kind: Kind) -> u8 {
    match kind {
        Kind::Int8 => 1,
        Kind::Int16 => 2,
        Kind::Int32 => 3,
        Kind::Real32 => 4,
    }
}

fn bytes_of(kind: Kind, value: f32) -> Vec<u8> {
    match kind {
        Kind::Int8 => vec![value as i8 as u8],
        Kind::Int16 => (value as i16).to_le_bytes().to_vec(),
        Kind::Int32 => (value as i32).to_le_bytes().to_vec(),
        Kind::Real32 => value.to_le_bytes().to_vec(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reads a file as ground stations do: zeros before a parameter are padding.
    fn read(file: &[u8], block: usize) -> Vec<(String, f32)> {
        let mut at = HEADER;
        let mut name = Vec::new();
        let mut values = Vec::new();
        while at < file.len() {
            if file[at] == 0 {
                at += 1;
                continue;
            }
            let (kind, own) = (file[at] & 15, usize::from(file[at + 1] >> 4) + 1);
            name.truncate(usize::from(file[at + 1] & 15));
            name.extend_from_slice(&file[at + 2..at + 2 + own]);
            let begin = at + 2 + own;
            let (value, rest) = read_value(kind, &file[begin..]).expect("complete");
            at = file.len() - rest.len();
            assert_eq!(
                begin / block,
                (at - 1) / block,
                "a value lies across blocks"
            );
            values.push((String::from_utf8(name.clone()).expect("text"), value));
        }
        values
    }

    #[test]
    fn what_is_packed_reads_back_in_blocks_of_any_size() {
        let parameters = Parameters::new(crate::VehicleKind::Copter, 14);
        for block in [110, 239, 80] {
            let file = PackRequest::default()
                .pack(&parameters, block)
                .expect("some");
            assert_eq!(&file[..6], &[0x1B, 0x67, 0x66, 0x05, 0x66, 0x05]);
            let values = read(&file, block);
            assert_eq!(values.len(), usize::from(parameters.count()));
            for (index, (name, value)) in values.iter().enumerate() {
                let parameter = parameters.at(index as u16).expect("there");
                assert_eq!((parameter.name, parameter.value), (name.as_str(), *value));
            }
        }
    }

    #[test]
    fn the_file_begins_as_the_real_vehicles_does() {
        // The first bytes of a file read from an ArduCopter SITL with the system id 14.
        let real = b"\x1bgf\x05f\x05\x02\xd0FORMAT_VERSIONx\x00\x02\xc0SYSID_THISMAV\x0e\x00\x02FMYGCS\xff\x00\
            \x04\xd0PILOT_THR_FILT\x00\x00\x00\x00\x04wKOFF_ALT\x00\x00\x00\x00\x02WHR_BHV\x00\x00\x01\xa0TELEM_DELAY\x00";
        let file = PackRequest::default()
            .pack(&Parameters::new(crate::VehicleKind::Copter, 14), 239)
            .expect("some");
        assert_eq!(&file[..real.len()], real);
        // Device ids and calibrations differ from one boot to the next, but not in length.
        assert_eq!(file.len(), 15_140);
    }

    #[test]
    fn a_query_chooses_what_is_packed() {
        let mut parameters = Parameters::new(crate::VehicleKind::Copter, 1);
        let wanted = PackRequest::read("param.pck?start=2&count=3").expect("sense");
        let file = wanted.pack(&parameters, 239).expect("some");
        assert_eq!(read(&file, 239).len(), 3);
        assert_eq!(PackRequest::read("param.pck?start=70000"), None);
        assert_eq!(PackRequest::read("param.pck?withdefaults=2"), None);
        let far = PackRequest::read("param.pck?start=2000").expect("sense");
        assert_eq!(far.pack(&parameters, 239), None);
        parameters.set("SYSID_MYGCS", 250.0);
        let wanted = PackRequest::read("param.pck?start=2&count=1&withdefaults=1").expect("sense");
        let file = wanted.pack(&parameters, 239).expect("some");
        assert_eq!(&file[6..], b"\x12\xA0SYSID_MYGCS\xfa\x00\xff\x00");
    }

    #[test]
    fn a_written_file_is_taken_only_whole() {
        let mut file = b"\x1bg\x02\x00\x00\x00\x02\x60RTL_ALT\xd0\x07\x04\x94CONE_SLOPE".to_vec();
        file.extend_from_slice(&1.5_f32.to_le_bytes());
        file[4] = file.len() as u8;
        let values = unpack(&file).expect("whole");
        let wanted = [("RTL_ALT", 2000.0), ("RTL_CONE_SLOPE", 1.5)];
        assert_eq!(values, wanted.map(|(name, value)| (name.to_owned(), value)));
        assert_eq!(unpack(&file[..file.len() - 1]), None);
    }
}
