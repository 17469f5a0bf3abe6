//! ArduPilot's parameter file with defaults: `@PARAM/param.pck?withdefaults=1`.
//!
//! A header of three 16-bit numbers (magic, parameters in the file, all parameters), then per parameter: a byte with the
//! type in its low half and a flag for a default in its high half; a byte with the number of letters shared with the
//! previous name in its low half, and the number of further letters less one in its high half; these letters; the
//! value; the default, if it differs from the value. Zeros may precede a parameter. Source: `AP_Filesystem_Param.cpp`.

use std::collections::BTreeMap;

/// The file, as MAVFTP names it.
pub const DEFAULTS_FILE: &str = "@PARAM/param.pck?withdefaults=1";

const MAGIC: u16 = 0x671C;
const HEADER: usize = 6;
const LONGEST_NAME: usize = 16;
const HAS_DEFAULT: u8 = 1;

/// The default of each parameter in a file; `None` if the file is not whole, or has no defaults.
pub fn read_defaults(file: &[u8]) -> Option<BTreeMap<String, f64>> {
    let number = |at: usize| Some(u16::from_le_bytes([*file.get(at)?, *file.get(at + 1)?]));
    if number(0)? != MAGIC {
        return None;
    }
    let mut rest = file.get(HEADER..)?;
    let mut name: Vec<u8> = Vec::new();
    let mut defaults = BTreeMap::new();
    for _ in 0..number(2)? {
        let padding = rest.iter().take_while(|byte| **byte == 0).count();
        let (&[head, lengths], letters) = rest[padding..].split_first_chunk()?;
        let (shared, own) = (usize::from(lengths & 15), usize::from(lengths >> 4) + 1);
        if shared > name.len() || shared + own > LONGEST_NAME {
            return None;
        }
        let (letters, values) = letters.split_at_checked(own)?;
        name.truncate(shared);
        name.extend_from_slice(letters);
        let (kind, flags) = (head & 15, head >> 4);
        let (value, after) = value(kind, values)?;
        let (default, end) = if flags & HAS_DEFAULT == 0 {
            (value, after)
        } else {
            self::value(kind, after)?
        };
        rest = end;
        defaults.insert(String::from_utf8(name.clone()).ok()?, default);
    }
    Some(defaults)
}

fn value(kind: u8, bytes: &[u8]) -> Option<(f64, &[u8])> {
    match kind {
        1 => {
            let (value, rest) = bytes.split_first()?;
            Some((f64::from(*value as i8), rest))
        }
        2 => {
            let (value, rest) = bytes.split_first_chunk()?;
            Some((f64::from(i16::from_le_bytes(*value)), rest))
        }
        3 => {
            let (value, rest) = bytes.split_first_chunk()?;
            // `PARAM_VALUE` has the same number, rounded to a float.
            Some((f64::from(i32::from_le_bytes(*value) as f32), rest))
        }
        4 => {
            let (value, rest) = bytes.split_first_chunk()?;
            Some((f64::from(f32::from_le_bytes(*value)), rest))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// `RTL_ALT` 2000 (default 1500), `RTL_ALT_TYPE` 1, and after padding `RTL_CONE_SLOPE` 1.5 (default 3).
    fn file() -> Vec<u8> {
        let mut file = vec![0x1C, 0x67, 3, 0, 3, 0];
        file.extend([0x12, 0x60]);
        file.extend(b"RTL_ALT");
        file.extend([0xD0, 0x07, 0xDC, 0x05]);
        file.extend([0x01, 0x47]);
        file.extend(b"_TYPE");
        file.push(1);
        file.extend([0, 0, 0, 0x14, 0x94]);
        file.extend(b"CONE_SLOPE");
        file.extend(1.5f32.to_le_bytes());
        file.extend(3f32.to_le_bytes());
        file
    }

    #[test]
    fn a_parameter_without_a_default_of_its_own_has_its_value() {
        let defaults = read_defaults(&file()).expect("it is whole");
        let expected = [
            ("RTL_ALT", 1500.0),
            ("RTL_ALT_TYPE", 1.0),
            ("RTL_CONE_SLOPE", 3.0),
        ];
        let expected = expected.map(|(name, value)| (name.to_owned(), value));
        assert_eq!(defaults, BTreeMap::from(expected));
    }

    #[test]
    fn a_file_that_is_cut_off_or_has_no_defaults_is_none() {
        let file = file();
        for len in 0..file.len() {
            assert_eq!(read_defaults(&file[..len]), None, "{len}");
        }
        let mut without = file;
        without[0] = 0x1B;
        assert_eq!(read_defaults(&without), None);
    }

    proptest! {
        #[test]
        fn no_bytes_make_the_reader_stumble(mut bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
            if let Some(start) = bytes.first_chunk_mut() {
                *start = [0x1C, 0x67];
            }
            drop(read_defaults(&bytes));
        }
    }
}
