//! Two hundred damaged missions: each is read or refused with a place; none panics, hangs or grows without bound.

use std::sync::Arc;

use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;
use sortie::exercise::Exercise;
use sortie::language::{Context, Script};
use sortie::mission::Mission;

use super::{folder, toml_files};

const MUTANTS: u64 = 200;
/// Replacement values for the mutations.
const STRANGE: [&str; 12] = [
    "1e308",
    "-1",
    "nan",
    "-inf",
    "99999999999999999999",
    "\"\"",
    "\"їжак 🦔\"",
    "[]",
    "{}",
    "true",
    "[[[[[[[[1]]]]]]]]",
    "1979-05-27",
];

/// One or more random changes of a file.
fn mutated(source: &str, random: &mut ChaCha8Rng) -> String {
    let mut lines: Vec<String> = source.lines().map(str::to_owned).collect();
    for _ in 0..random.random_range(1..4) {
        let line = random.random_range(0..lines.len());
        let other = random.random_range(0..lines.len());
        match random.random_range(0..7) {
            0 => drop(lines.remove(line)),
            1 => lines.insert(line, lines[other].clone()),
            2 => lines.swap(line, other),
            3 => {
                let value = STRANGE[random.random_range(0..STRANGE.len())];
                let key = lines[line].split('=').next().unwrap_or("").to_owned();
                lines[line] = format!("{key}= {value}");
            }
            4 => {
                let depth = random.random_range(1..5000);
                lines[line] = format!("x = {}", "[".repeat(depth));
            }
            5 => {
                let digits: String = lines[line]
                    .chars()
                    .map(|c| if c.is_ascii_digit() { '9' } else { c })
                    .collect();
                lines[line] = digits.replace("99", "999999999");
            }
            _ => {
                let mut bytes = lines[line].clone().into_bytes();
                if !bytes.is_empty() {
                    let at = random.random_range(0..bytes.len());
                    bytes[at] ^= 1 << random.random_range(0..8);
                }
                lines[line] = String::from_utf8_lossy(&bytes).into_owned();
            }
        }
    }
    lines.join("\n")
}

/// Lists, examines and flies an accepted mission.
fn fly_a_little(mission: Mission) {
    drop((mission.listing(), mission.places_to_name(), mission.check()));
    let nothing = Script::parse("", &Context::default()).expect("an empty script");
    let mut exercise = Exercise::new(Arc::new(mission), 1, nothing, Vec::new());
    for _ in 0..5 {
        exercise.step();
    }
}

#[test]
fn two_hundred_damaged_missions_are_read_or_refused_with_a_place() {
    let missions = toml_files(&folder("missions")).into_iter();
    let mut sources: Vec<String> = missions
        .chain(toml_files(&folder("missions/drills")))
        .map(|path| std::fs::read_to_string(path).expect("it is there"))
        .collect();
    let basics = folder("tests/data/basics_mission.toml");
    sources.push(std::fs::read_to_string(basics).expect("it is there"));
    let mut refused = 0;
    for seed in 0..MUTANTS {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let source = &sources[seed as usize % sources.len()];
        let source = mutated(source, &mut random);
        match Mission::parse(&source) {
            Ok(mission) => fly_a_little(mission),
            Err(faults) => {
                refused += 1;
                assert!(!faults.is_empty(), "{seed}");
                for fault in faults {
                    let (line, column) = fault.line_column(&source);
                    let lines = source.lines().count() + 1;
                    assert!((1..=lines).contains(&line) && column >= 1, "{seed}");
                    assert!(!fault.one_line("m", &source).contains('\n'), "{seed}");
                }
            }
        }
    }
    assert!((100..MUTANTS).contains(&refused), "{refused} were refused");
}
