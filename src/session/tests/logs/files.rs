//! Logs that are read as files, and the cases where that fails.

use super::*;
use crate::session::ftp::server::{Quirks, Sums};

const LOG: &str = "logs/00000001.BIN";

#[test]
fn a_log_comes_by_messages_and_is_checked_where_the_vehicle_hands_out_files() {
    let mut shelf = Shelf::with_files(vec![log(700, 1), log(250_000, 2)]);
    shelf.download(LogChoice::Group(LogGroup::All));
    shelf.until_over(ms(30_000));
    assert_eq!(shelf.last_row().state, RowState::Done);
    let text = "250.7 kB saved by log messages, checksum verified: log1.bin, log2.bin";
    assert_eq!(shelf.explanation(), text);
    assert_eq!(shelf.carried, 250_700);
    assert!(shelf.kept(1) == log(700, 1) && shelf.kept(2) == log(250_000, 2));
    shelf.step();
    shelf.step();
    assert!(!shelf.server.is_open());
}

#[test]
fn what_is_not_checked_says_why() {
    let silent = Quirks {
        is_silent: true,
        ..Quirks::default()
    };
    let wrong = Quirks {
        sums: Sums::Wrong,
        ..Quirks::default()
    };
    let without = Quirks {
        sums: Sums::None,
        ..Quirks::default()
    };
    let size = 100_000;
    for (quirks, carried, check) in [
        (silent, size, "no checksum: no answer"),
        (without, size, "no checksum: "),
        (wrong, 2 * size, "read twice: the checksum differs"),
    ] {
        let mut shelf = Shelf::with_files(vec![log(size, 2)]);
        shelf.server.quirks = quirks;
        shelf.download(LogChoice::Group(LogGroup::Last));
        shelf.until_over(Duration::from_secs(60));
        let words = shelf.explanation();
        let start = format!("100.0 kB saved by log messages, {check}");
        assert!(words.starts_with(&start), "{words}");
        assert_eq!(shelf.carried, carried, "{check}");
        assert!(shelf.kept(1) == log(size, 2), "{check}");
    }
}

#[test]
fn files_go_on_where_log_messages_cease() {
    let half = Quirks {
        refuses_from: Some(50_000),
        ..Quirks::default()
    };
    // Each row: the number of answered requests for log messages, the behaviour of files, and the outcome.
    for (answers, quirks, state) in [
        (0, Quirks::default(), RowState::Done),
        (0, half, RowState::TimedOut),
    ] {
        let mut shelf = Shelf::with_files(vec![log(100_000, 2)]);
        shelf.answers = answers;
        shelf.server.quirks = quirks;
        shelf.download(LogChoice::Group(LogGroup::Last));
        shelf.until_over(Duration::from_secs(120));
        assert_eq!(shelf.last_row().state, state);
        let words = shelf.explanation();
        if state == RowState::Done {
            let expected = "100.0 kB saved by MAVFTP, checksum verified: log1.bin";
            assert_eq!(words, expected);
            assert!(shelf.kept(1) == log(100_000, 2));
        } else {
            assert!(words.contains("stopped sending log 1: 5"), "{words}");
        }
        let rows = shelf.scene.rows.iter();
        let percents = rows.filter_map(|row| match row.state {
            RowState::InProgress(percent) => Some(percent),
            _ => None,
        });
        assert!(percents.is_sorted());
    }
}

#[test]
fn a_log_that_grows_while_it_is_read_ends_where_it_was_listed() {
    let mut shelf = Shelf::with_files(vec![log(100_000, 2)]);
    shelf.download(LogChoice::Group(LogGroup::Last));
    while shelf.last_row().state != RowState::InProgress(50) {
        shelf.step();
    }
    shelf.server.files.insert(LOG.to_owned(), log(120_000, 2));
    shelf.until_over(ms(30_000));
    let words = shelf.explanation();
    assert!(
        words.contains("by log messages, no checksum: the vehicle was still writing this log"),
        "{words}"
    );
    assert!(shelf.kept(1) == log(100_000, 2));
    assert_eq!(shelf.carried, 100_000);
}

#[test]
fn files_that_are_not_those_of_the_list_are_left_alone() {
    let mut shelf = Shelf::with_files(vec![log(9000, 1), log(5000, 2)]);
    let path = "logs/00000002.BIN".to_owned();
    shelf.server.files.insert(path.clone(), log(5100, 3));
    shelf.download(LogChoice::Group(LogGroup::Last));
    shelf.until_over(ms(30_000));
    let way = "by log messages, no checksum: no file of the listed size";
    assert_eq!(shelf.explanation(), format!("5.0 kB saved {way}: log2.bin"));
    assert!(shelf.kept(2) == log(5000, 2));
    // A board stores the logs in another folder.
    let mut shelf = Shelf::with_files(vec![log(9000, 1)]);
    let file = shelf.server.files.pop_first().expect("a log");
    shelf
        .server
        .files
        .insert("/APM/LOGS/00000001.BIN".to_owned(), file.1);
    shelf.download(LogChoice::Group(LogGroup::Last));
    shelf.until_over(ms(30_000));
    assert!(
        shelf
            .explanation()
            .contains("by log messages, checksum verified")
    );
    shelf.server.files.clear();
    shelf.keeper.whole.lock().expect("kept").clear();
    shelf.download(LogChoice::Group(LogGroup::Last));
    shelf.step();
    shelf.until_over(ms(30_000));
    assert!(
        shelf
            .explanation()
            .contains("no checksum: file not found: "),
        "{}",
        shelf.explanation()
    );
}

#[test]
fn a_file_that_was_broken_off_goes_on_unless_it_is_another_log() {
    for is_other in [false, true] {
        let mut shelf = Shelf::with_files(vec![log(150_000, 2)]);
        shelf.download(LogChoice::Group(LogGroup::All));
        while shelf.last_row().state != RowState::InProgress(60) {
            shelf.step();
        }
        shelf.scene.heartbeat(STABILIZE, true);
        shelf.step();
        assert_eq!(shelf.last_row().state, RowState::Refused);
        shelf.scene.heartbeat(STABILIZE, false);
        if is_other {
            shelf.logs[0] = log(150_000, 3);
            shelf.server.files.insert(LOG.to_owned(), log(150_000, 3));
        }
        shelf.sending = None;
        let before = shelf.passed;
        shelf.download(LogChoice::Number(1));
        shelf.step();
        shelf.until_over(ms(30_000));
        assert!(
            shelf
                .explanation()
                .contains("by log messages, checksum verified")
        );
        assert!(shelf.kept(1) == shelf.logs[0], "other bytes");
        let packets = shelf.passed - before;
        assert!(is_other || packets < 900, "{packets} packets");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// The received log is correct, whichever way it is read.
    #[test]
    fn a_file_survives_losses(
        seed in any::<u64>(),
        loss in 0.0..0.4,
        len in 1usize..100_000,
        rate in 1usize..20,
        refuses_from in prop_oneof![3 => Just(None), 1 => (0usize..100_000).prop_map(Some)],
        answers in prop_oneof![2 => Just(usize::MAX), 1 => 0usize..20],
        forgets_after in prop_oneof![3 => Just(None), 1 => (0usize..400).prop_map(Some)],
    ) {
        let mut shelf = Shelf::with_files(vec![log(len, 7)]);
        shelf.server.quirks = Quirks { refuses_from, forgets_after, ..Quirks::default() };
        shelf.answers = answers;
        shelf.loss = loss;
        shelf.random = ChaCha8Rng::seed_from_u64(seed);
        shelf.rate = rate;
        shelf.download(LogChoice::Group(LogGroup::Last));
        shelf.until_over(Duration::from_secs(600));
        // If messages stop, files may have failed before.
        let is_done = shelf.last_row().state == RowState::Done;
        prop_assert!(is_done || answers < usize::MAX);
        prop_assert!(!is_done || shelf.kept(1) == log(len, 7));
    }
}
