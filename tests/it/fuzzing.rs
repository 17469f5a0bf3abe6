//! Every target of `fuzz/` with its seeds and with damaged seeds: the part of fuzzing that every run of the tests does.
//!
//! `SORTIE_MUTATIONS` sets the number of damaged inputs per folder of seeds. An input that once failed is kept in
//! `fuzz/seeds/NAME/`, and so is tried again by every run.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

#[path = "../../fuzz/targets.rs"]
mod targets;

use targets::TARGETS;

/// Longer seeds are cut: most damage to a long file is in a part that is like every other part.
const LONGEST: usize = 16 * 1024;
const FOLDERS: &str = include_str!("../../fuzz/seeds.txt");

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The folders with seeds of a target.
fn folders(target: &str) -> Vec<PathBuf> {
    let line = FOLDERS
        .lines()
        .find_map(|line| line.strip_prefix(target)?.strip_prefix(':'))
        .unwrap_or_else(|| panic!("fuzz/seeds.txt names no folder for {target}"));
    line.split_whitespace().map(|it| root().join(it)).collect()
}

fn seeds(folder: &Path) -> Vec<Vec<u8>> {
    let entries = folder.read_dir().expect("a folder of seeds");
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.is_file())
        .collect();
    files.sort();
    let read = |path: &PathBuf| {
        let mut seed = std::fs::read(path).expect("a readable seed");
        seed.truncate(LONGEST);
        seed
    };
    files.iter().map(read).collect()
}

fn damaged(seed: &[u8], other: &[u8], random: &mut ChaCha8Rng) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..random.random_range(1..5) {
        if bytes.is_empty() {
            break;
        }
        let at = random.random_range(0..bytes.len());
        let end = (at + random.random_range(0..40)).min(bytes.len());
        match random.random_range(0..8) {
            0 => bytes[at] ^= 1 << random.random_range(0..8),
            1 => bytes[at] = random.random(),
            2 => bytes.truncate(at),
            3 => drop(bytes.drain(at..end)),
            4 => drop(bytes.splice(at..at, bytes[at..end].to_vec())),
            5 => bytes[at..end].fill(*b"\0\xff9-".get(random.random_range(0..4)).unwrap_or(&0)),
            6 => drop(bytes.splice(at..at, b"99999999999".iter().copied())),
            _ if other.is_empty() => {}
            _ => {
                let from = random.random_range(0..other.len());
                let to = (from + random.random_range(0..200)).min(other.len());
                drop(bytes.splice(at..end, other[from..to].iter().copied()));
            }
        }
    }
    bytes
}

fn mutations() -> usize {
    let asked = std::env::var("SORTIE_MUTATIONS").ok();
    asked.and_then(|asked| asked.parse().ok()).unwrap_or(300)
}

/// Runs a target with its seeds and with damaged ones; fails with the input that made it panic.
fn survives(name: &str) {
    let target = TARGETS.iter().find(|target| target.name == name);
    let target = target.expect("a target");
    let seeds: Vec<Vec<Vec<u8>>> = folders(name).iter().map(|it| seeds(it)).collect();
    let all: Vec<&Vec<u8>> = seeds.iter().flatten().collect();
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let each = seeds.iter().flat_map(|of_folder| {
        assert!(!of_folder.is_empty(), "{name} has seeds");
        std::iter::repeat_n(of_folder, mutations())
    });
    let damaged = each.map(|of_folder| {
        let seed = random.random_range(0..of_folder.len());
        let other = random.random_range(0..all.len());
        damaged(&of_folder[seed], all[other], &mut random)
    });
    for input in all.iter().map(|it| (*it).clone()).chain(damaged) {
        let outcome = catch_unwind(AssertUnwindSafe(|| (target.run)(&input)));
        if outcome.is_err() {
            let kept = tempfile::Builder::new()
                .prefix(name)
                .tempfile()
                .expect("a file");
            let (_, path) = kept.keep().expect("a file that stays");
            std::fs::write(&path, &input).expect("room for the input");
            panic!("{name} panics with the bytes of {}", path.display());
        }
    }
}

#[test]
fn every_target_has_a_binary_for_libfuzzer() {
    for target in &TARGETS {
        let path = root().join(format!("fuzz/fuzz_targets/{}.rs", target.name));
        let source = std::fs::read_to_string(&path).unwrap_or_default();
        let call = format!("targets::{}(bytes)", target.name);
        assert!(source.contains(&call), "{}: {source}", path.display());
    }
}

macro_rules! damaged_seeds {
    ($($name:ident),+) => {
        #[test]
        fn every_target_is_run_with_damaged_seeds() {
            let names = TARGETS.map(|target| target.name);
            assert_eq!(names, [$(stringify!($name)),+]);
        }

        $(
            #[test]
            fn $name() {
                survives(stringify!($name));
            }
        )+
    };
}

damaged_seeds!(
    frames,
    vehicle,
    simulator,
    tlog,
    dataflash,
    plan,
    mission,
    journal,
    line,
    documentation,
    teaching,
    class,
    http
);
