//! Parameter files: one parameter per line.
//!
//! Files are written as Mission Planner writes them, `NAME,VALUE`. The reader also accepts `NAME
//! VALUE`, separated by any blanks (MAVProxy), and the five columns of QGroundControl (`SYSTEM
//! COMPONENT NAME VALUE TYPE`, separated by tabs). `#` begins a comment.

use std::collections::BTreeMap;
use std::ops::Range;

use super::{is_whole, written};
use crate::diagnostic::Diagnostic;
use crate::text;
use crate::text::Text;

/// The longest name that fits its field on the wire.
const LONGEST_NAME: usize = 16;

/// Reads a parameter file.
///
/// # Errors
/// Every invalid line, with its place: a wrong name, a value that is not a finite number or does not fit a float, text
/// after the value, a name with two different values.
pub fn parse(text: &str) -> Result<BTreeMap<String, f64>, Vec<Diagnostic>> {
    let mut values: BTreeMap<String, (f64, usize)> = BTreeMap::new();
    let mut faults = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        let start = line.as_ptr().addr() - text.as_ptr().addr();
        match parse_line(line, start) {
            Ok(None) => {}
            Ok(Some(read)) => {
                let known = values.entry(read.name.to_owned());
                let (value, first) = *known.or_insert((read.value, number));
                if value.to_bits() != read.value.to_bits() {
                    let said = text!(
                        "parameters-file-twice",
                        name = read.name,
                        value = written(value),
                        line = first
                    );
                    faults.push(Diagnostic::new(read.span, said));
                }
            }
            Err(fault) => faults.push(fault),
        }
    }
    if faults.is_empty() {
        let values = values.into_iter().map(|(name, (value, _))| (name, value));
        Ok(values.collect())
    } else {
        Err(faults)
    }
}

/// Writes a parameter file, with a comment before the values. A value that is not a finite number is written as a
/// comment, since no vehicle could accept it.
pub fn write<'a>(comment: &str, values: impl Iterator<Item = (&'a str, f64)>) -> String {
    let mut text = String::new();
    for line in comment.lines() {
        text.push_str("# ");
        text.push_str(line);
        text.push('\n');
    }
    for (name, value) in values {
        let sign = if value.is_finite() { "" } else { "# " };
        for part in [sign, name, ",", &written(value), "\n"] {
            text.push_str(part);
        }
    }
    text
}

struct ParameterLine<'a> {
    name: &'a str,
    value: f64,
    span: Range<usize>,
}

fn parse_line(line: &str, start: usize) -> Result<Option<ParameterLine<'_>>, Diagnostic> {
    // Some editors begin a file with a byte order mark.
    let content = line
        .trim_start_matches('\u{feff}')
        .split('#')
        .next()
        .unwrap_or_default();
    let fields: Vec<&str> = content
        .split(|c: char| c == ',' || c.is_whitespace())
        .filter(|field| !field.is_empty())
        .collect();
    let at = |field: &str| {
        let from = field.as_ptr().addr() - line.as_ptr().addr() + start;
        from..from + field.len()
    };
    let whole = |field: &str| field.parse::<u32>().is_ok();
    let (name, value) = match fields.as_slice() {
        [] => return Ok(None),
        [name, value] => (*name, *value),
        [system, component, name, value, kind]
            if whole(system) && whole(component) && whole(kind) =>
        {
            (*name, *value)
        }
        [name] => {
            let end = at(name).end;
            let said = text!("parameters-file-no-value", name = *name);
            return Err(Diagnostic::new(end..end, said).with_help(text!("parameters-file-help")));
        }
        [_, _, extra, ..] => {
            let said = text!("parameters-file-more");
            return Err(Diagnostic::new(at(extra), said).with_help(text!("parameters-file-help")));
        }
    };
    check_name(name).map_err(|message| Diagnostic::new(at(name), message))?;
    let value_span = at(value);
    let value = number(value).map_err(|message| Diagnostic::new(value_span.clone(), message))?;
    Ok(Some(ParameterLine {
        name,
        value,
        span: at(name).start..value_span.end,
    }))
}

fn check_name(name: &str) -> Result<(), Text> {
    let good = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_';
    if name.len() <= LONGEST_NAME && name.bytes().all(good) {
        return Ok(());
    }
    Err(text!("parameters-file-name", name = name))
}

/// A value: a whole number to the last digit, any other as the float that a vehicle has.
fn number(written: &str) -> Result<f64, Text> {
    match written.parse::<f64>() {
        Ok(value) if is_whole(value) => Ok(value),
        Ok(value) if (value as f32).is_finite() => Ok(f64::from(value as f32)),
        Ok(_) => Err(text!("parameters-file-too-large", value = written)),
        Err(_) => Err(text!("parameters-no-number", value = written)),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn the_formats_of_three_ground_stations_are_read() {
        let text = "\u{feff}#NOTE: 21.11.2026\r\nACRO_YAW_P,4.5\r\n\r\n\
                    ANGLE_MAX        3000.000000 # centidegrees\n\
                    1\t1\tRTL_ALT\t1500\t4\nBATT_CAPACITY , 3300\nTINY,1e-7";
        let values = parse(text).expect("all are good");
        let expected = [
            ("ACRO_YAW_P", 4.5),
            ("ANGLE_MAX", 3000.0),
            ("BATT_CAPACITY", 3300.0),
            ("RTL_ALT", 1500.0),
            ("TINY", f64::from(1e-7f32)),
        ];
        let expected = expected.map(|(name, value)| (name.to_owned(), value));
        assert_eq!(values, BTreeMap::from(expected));
    }

    #[test]
    fn every_fault_is_told_with_its_line_and_column() {
        let text = "A,1\nB\nC,x\nD,1 2\n é,1\nF,nan\nG,1e39\nA,2\nA,1\nSEVENTEEN_LETTERS,1\n";
        let faults = parse(text).expect_err("there are faults");
        let places: Vec<(usize, usize)> =
            faults.iter().map(|fault| fault.line_column(text)).collect();
        assert_eq!(
            places,
            [
                (2, 2),
                (3, 3),
                (4, 5),
                (5, 2),
                (6, 3),
                (7, 3),
                (8, 1),
                (10, 1)
            ]
        );
    }

    #[test]
    fn what_is_no_number_is_kept_as_a_comment() {
        let text = write(
            "vehicle 3\ntwo lines",
            [("A", f64::NAN), ("B", f64::from(0.1f32))].into_iter(),
        );
        assert_eq!(text, "# vehicle 3\n# two lines\n# A,NaN\nB,0.1\n");
    }

    proptest! {
        #[test]
        fn what_is_written_reads_the_same_to_the_last_bit(
            values in proptest::collection::btree_map(
                "[A-Za-z0-9_]{1,16}",
                prop_oneof![
                    any::<f32>().prop_filter("finite", |value| value.is_finite()).prop_map(f64::from),
                    any::<i32>().prop_map(f64::from),
                    any::<u32>().prop_map(f64::from),
                ],
                0..50,
            ),
        ) {
            let text = write("a comment", values.iter().map(|(name, value)| (name.as_str(), *value)));
            let read = parse(&text).expect("it was written by us");
            let bits = |all: &BTreeMap<String, f64>| -> Vec<(String, u64)> {
                all.iter().map(|(name, value)| (name.clone(), value.to_bits())).collect()
            };
            prop_assert_eq!(bits(&read), bits(&values));
        }

        #[test]
        fn no_text_makes_the_reader_stumble(text in "[ -~\t\n,#é]{0,200}") {
            if let Err(faults) = parse(&text) {
                prop_assert!(faults.iter().all(|fault| text.get(fault.span.clone()).is_some()));
            }
        }
    }
}
