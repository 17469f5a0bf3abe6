//! Damaged files either load or give a fault with a place in the text; reading never panics.

use super::examples::{GEOJSON, KML, OLD_FENCE, OLD_RALLY, PLAN, WPL, zip};
use crate::check::{CheckOptions, check};
use crate::generate::source::areas;
use crate::{Document, FileFormat, ListKind, ReadOptions, read, write};

/// Reproducible pseudo-random numbers (Knuth's MMIX).
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

/// Files of the list format with fence items and rally points, as current versions of MAVProxy write them.
fn lists() -> [String; 2] {
    let mut loaded = read(PLAN.as_bytes(), &ReadOptions::default()).expect("a good file");
    [ListKind::Fence, ListKind::Rally].map(|kind| {
        let mut alone = Document::default();
        alone
            .list_mut(kind)
            .clone_from(loaded.document.list_mut(kind));
        let text = write(&alone, FileFormat::Wpl(kind)).expect("a list");
        assert!(text.lines().count() > 1, "{text}");
        text
    })
}

/// The number of damaged files of each format; `SORTIE_MUTATIONS` sets a different number.
fn wanted() -> usize {
    let asked = std::env::var("SORTIE_MUTATIONS").ok();
    asked.and_then(|asked| asked.parse().ok()).unwrap_or(200)
}

/// Reads damaged files; returns how many were read, and how many had faults.
fn try_damaged(file: &[u8], count: usize, dice: &mut Dice) -> [usize; 2] {
    let mut outcomes = [0, 0];
    for _ in 0..count {
        let bytes = damage(file, dice);
        match read(&bytes, &ReadOptions::default()) {
            Ok(loaded) => {
                outcomes[0] += 1;
                // Neither the rules of the vehicle nor the writers may fail on a document that was
                // read.
                drop(check(&loaded.document, &CheckOptions::default()));
                drop(areas(&loaded.document));
                for format in [FileFormat::QgcPlan, FileFormat::Kml, FileFormat::GeoJson] {
                    drop(write(&loaded.document, format));
                }
            }
            Err((text, faults)) => {
                outcomes[1] += 1;
                assert!(!faults.is_empty());
                for fault in faults {
                    let span = fault.span.clone();
                    assert!(text.get(span).is_some(), "{fault:?}");
                }
            }
        }
    }
    outcomes
}

#[test]
fn two_hundred_damaged_files_of_each_format_are_read_or_have_a_place_for_each_fault() {
    let kmz = zip(KML.as_bytes());
    let older = WPL.replacen("WPL 110", "WPL 120", 1);
    assert_ne!(older, WPL);
    let [fence, rally] = lists();
    let files: [(&str, &[u8]); 10] = [
        ("QGC WPL 110", WPL.as_bytes()),
        ("QGC WPL 120", older.as_bytes()),
        (".plan", PLAN.as_bytes()),
        ("MAVProxy fence", fence.as_bytes()),
        ("MAVProxy rally", rally.as_bytes()),
        ("MAVProxy old fence", OLD_FENCE.as_bytes()),
        ("MAVProxy old rally", OLD_RALLY.as_bytes()),
        ("KML", KML.as_bytes()),
        ("KMZ", &kmz),
        ("GeoJSON", GEOJSON.as_bytes()),
    ];
    let count = wanted();
    let mut dice = Dice(20);
    for (name, file) in files {
        let [read_well, faulty] = try_damaged(file, count, &mut dice);
        println!("{name}: {count} damaged files, {read_well} read, {faulty} with faults");
        assert_eq!(read_well + faulty, count);
        assert!(
            read_well.min(faulty) * 50 > count,
            "{name}: {read_well} {faulty}"
        );
    }
}
