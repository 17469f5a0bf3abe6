//! Damaged files: a fault with a place in the text, or loaded; never a panic.

use super::examples::{GEOJSON, KML, OLD_FENCE, OLD_RALLY, PLAN, WPL, zip};
use crate::{ReadOptions, read};

/// Numbers that are always the same (Knuth's MMIX).
struct Dice(u64);

impl Dice {
    fn below(&mut self, most: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % most.max(1)
    }
}

fn damage(file: &[u8], dice: &mut Dice) -> Vec<u8> {
    let mut bytes = file.to_vec();
    for _ in 0..=dice.below(2) {
        if bytes.is_empty() {
            break;
        }
        let at = dice.below(bytes.len());
        match dice.below(7) {
            0 => bytes[at] = dice.below(130) as u8,
            1 => drop(bytes.remove(at)),
            2 => bytes.truncate(at),
            3 => bytes.insert(at, b"-9e{}[]<>\",/&;\t\n\0"[dice.below(17)]),
            4 => bytes[at] = b"0123456789-.eN"[dice.below(14)],
            5 => {
                let end = (at + dice.below(40)).min(bytes.len());
                let piece = bytes[at..end].to_vec();
                bytes.splice(at..at, piece);
            }
            _ => {
                let end = (at + dice.below(40)).min(bytes.len());
                bytes.drain(at..end);
            }
        }
    }
    bytes
}

#[test]
fn two_hundred_damaged_files_of_each_format_are_read_or_have_a_place_for_each_fault() {
    let kmz = zip(KML.as_bytes());
    let files = [WPL, PLAN, OLD_FENCE, OLD_RALLY, KML, GEOJSON];
    let files = files.map(str::as_bytes).into_iter().chain([kmz.as_slice()]);
    let mut dice = Dice(20);
    let (mut read_well, mut faulty) = (0, 0);
    for file in files {
        for _ in 0..200 {
            let bytes = damage(file, &mut dice);
            match read(&bytes, &ReadOptions::default()) {
                Ok(_) => read_well += 1,
                Err((text, faults)) => {
                    faulty += 1;
                    assert!(!faults.is_empty());
                    for fault in faults {
                        let span = fault.span.clone();
                        assert!(text.get(span).is_some(), "{fault:?}");
                    }
                }
            }
        }
    }
    assert!(read_well > 150 && faulty > 400, "{read_well} {faulty}");
}
