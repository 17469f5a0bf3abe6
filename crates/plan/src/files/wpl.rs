//! `QGC WPL`: a line for each item, twelve fields each.
//!
//! The first item is home if it is a waypoint above sea level, as with ArduPilot; otherwise the
//! file counts its items without home, and its jumps are renumbered. A home with only zeros counts
//! as missing.

use std::fmt::Write as _;
use std::ops::Range;

use super::Parsed;
use super::number::{Word, decimals, decimals_of, lines, unfixed};
use crate::fault::{Fault, FaultKind, NoteKind, Unwritable};
use crate::{Document, Home, Item, ListKind, command, frame};

const FIELDS: usize = 12;

pub(super) fn parse(text: &str) -> Result<Parsed, Vec<Fault>> {
    let mut lines = lines(text);
    let mut faults: Vec<Fault> = lines
        .next()
        .and_then(|head| wrong_head(&head))
        .into_iter()
        .collect();
    let mut parsed = Parsed::default();
    let mut has_home = false;
    for (index, words) in lines.enumerate() {
        match Line::read(&words, index) {
            Ok(line) if index == 0 && line.is_home() => {
                has_home = true;
                let Item { x, y, z, .. } = line.item;
                if (x, y) != (0, 0) || z.abs() > 0.0 {
                    parsed.set_home(Home { x, y, z }, line.span);
                }
            }
            Ok(line) => {
                let list = list_of(line.item.command);
                if line.lost_fraction {
                    parsed.note(list, &line.span, NoteKind::FractionLost);
                }
                parsed.push(list, line.item, line.span);
            }
            Err(fault) => faults.push(fault),
        }
    }
    if !has_home {
        for item in &mut parsed.document.plan {
            if item.command == command::DO_JUMP {
                item.params[0] += 1.0;
            }
        }
    }
    if faults.is_empty() {
        Ok(parsed)
    } else {
        Err(faults)
    }
}

fn wrong_head(words: &[Word<'_>]) -> Option<Fault> {
    let [_, _, version] = words else {
        let span = words.first().map_or(0..0, Word::span);
        return Some(Fault::new(span, FaultKind::UnknownFormat));
    };
    let known = "110, 120";
    let is_known = matches!(version.text, "110" | "120");
    (!is_known).then(|| {
        let found = version.text.to_owned();
        Fault::new(version.span(), FaultKind::Version { found, known })
    })
}

fn list_of(number: u16) -> ListKind {
    if number == command::RALLY_POINT {
        ListKind::Rally
    } else if command::is_fence(number) {
        ListKind::Fence
    } else {
        ListKind::Plan
    }
}

struct Line {
    item: Item,
    span: Range<usize>,
    lost_fraction: bool,
}

impl Line {
    fn read(words: &[Word<'_>], index: usize) -> Result<Self, Fault> {
        let start = words.first().map_or(0, |word| word.start);
        let span = start..words.last().map_or(start, |word| word.span().end);
        let wrong = FaultKind::Fields {
            found: words.len(),
            expected: FIELDS,
        };
        let fields: &[Word<'_>; FIELDS] = words
            .try_into()
            .map_err(|_| Fault::new(span.clone(), wrong))?;
        let [seq, _, frame, number, p1, p2, p3, p4, x, y, z, auto] = fields;
        let found: u32 = seq.whole()?;
        let expected = index as u32;
        if found != expected {
            return Err(Fault::new(seq.span(), FaultKind::Order { found, expected }));
        }
        let (command, frame) = (number.whole()?, frame.whole()?);
        let places = decimals(command, frame);
        let has_fraction =
            |word: &Word<'_>| word.number().is_ok_and(|number| number.fract().abs() > 0.0);
        Ok(Self {
            lost_fraction: places == 0 && (has_fraction(x) || has_fraction(y)),
            item: Item {
                command,
                frame,
                auto_continue: auto.number()? != 0.0,
                params: [p1.number()?, p2.number()?, p3.number()?, p4.number()?].map(|p| p as f32),
                x: x.fixed(places)?,
                y: y.fixed(places)?,
                z: z.number()? as f32,
            },
            span,
        })
    }

    fn is_home(&self) -> bool {
        self.item.command == command::WAYPOINT && self.item.frame == 0
    }
}

/// Writes one list.
///
/// # Errors
/// The document has items in other lists, which would be lost.
pub(super) fn write(document: &Document, kind: ListKind) -> Result<String, Unwritable> {
    if let Some(other) = document.kinds().find(|other| *other != kind) {
        return Err(Unwritable::List(other));
    }
    let mut text = "QGC WPL 110\n".to_owned();
    let home = (kind == ListKind::Plan).then(|| {
        let Home { x, y, z } = document.home.unwrap_or(Home { x: 0, y: 0, z: 0.0 });
        Item {
            command: command::WAYPOINT,
            frame: frame::SEA_LEVEL,
            auto_continue: true,
            params: [0.0; 4],
            x,
            y,
            z,
        }
    });
    for (seq, item) in home.iter().chain(document.list(kind)).enumerate() {
        let [p1, p2, p3, p4] = item.params.map(number);
        let places = decimals_of(item);
        let (x, y) = (unfixed(item.x, places), unfixed(item.y, places));
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{seq}\t{}\t{}\t{}\t{p1}\t{p2}\t{p3}\t{p4}\t{x}\t{y}\t{}\t{}",
            u8::from(seq == 0),
            item.frame,
            item.command,
            number(item.z),
            u8::from(item.auto_continue),
        );
    }
    Ok(text)
}

/// The shortest form that reads back as the same number.
fn number(value: f32) -> String {
    if value.is_nan() {
        "nan".to_owned()
    } else {
        value.to_string()
    }
}
