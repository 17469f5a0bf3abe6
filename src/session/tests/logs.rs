//! Logs from a scripted vehicle that answers as `ArduPilot` does.

use mavlink::dialects::ardupilotmega::{LOG_DATA_DATA, LOG_ENTRY_DATA};
use proptest::prelude::*;
use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::commands::{LogChoice, LogCommand, LogGroup};
use crate::text::Text;

mod files;
mod shelf;

use shelf::{Shelf, log};

#[test]
fn logs_are_listed() {
    let mut shelf = Shelf::new(vec![log(1000, 1), log(48_200, 2)]);
    shelf.order(LogCommand::List);
    shelf.until_over(ms(3000));
    let row = shelf.last_row();
    assert_eq!(row.state, RowState::Done);
    let text = row.explanation.as_ref().expect("words").to_string();
    assert_eq!(
        text,
        "2 logs, 49.2 kB: 2 (48.2 kB, 2026-01-01 00:00:00); 1 (1.0 kB, 2026-01-01 00:00:00)"
    );
    let mut empty = Shelf::new(Vec::new());
    empty.order(LogCommand::List);
    empty.until_over(ms(3000));
    assert_eq!(empty.last_row().state, RowState::Done);
    empty.download(LogChoice::Group(LogGroup::Last));
    empty.step();
    empty.until_over(ms(3000));
    assert_eq!(empty.last_row().state, RowState::Refused);
}

#[test]
fn a_log_comes_with_one_request_where_nothing_is_lost() {
    let mut shelf = Shelf::new(vec![log(10, 1), log(50_000, 2)]);
    shelf.download(LogChoice::Group(LogGroup::Last));
    shelf.until_over(ms(10_000));
    assert_eq!(
        shelf.last_row().state,
        RowState::Done,
        "{:?}",
        shelf.last_row()
    );
    assert_eq!(shelf.requests, 1);
    assert_eq!(shelf.keeper.whole.lock().expect("kept")[&2], log(50_000, 2));
    let percents = shelf.scene.rows.iter();
    let percents = percents.filter(|row| matches!(row.state, RowState::InProgress(_)));
    assert!(percents.count() > 20);
}

#[test]
fn a_download_that_was_broken_off_goes_on_unless_it_is_another_log() {
    for (is_other, most) in [(false, 25_000), (true, 51_000)] {
        let mut shelf = Shelf::new(vec![log(50_000, 2)]);
        shelf.download(LogChoice::Group(LogGroup::All));
        while shelf.last_row().state != RowState::InProgress(60) {
            shelf.step();
        }
        shelf.scene.heartbeat(STABILIZE, true);
        shelf.step();
        let row = shelf.last_row().clone();
        assert_eq!(row.state, RowState::Refused);
        let words = row.explanation.expect("words").to_string();
        assert!(
            words.contains(": 60 % of log 1") || words.contains(": 61 % of log 1"),
            "{words}"
        );
        shelf.sending = None;
        shelf.scene.heartbeat(STABILIZE, false);
        if is_other {
            shelf.logs[0] = log(50_000, 3);
        }
        let before = shelf.passed;
        shelf.download(LogChoice::Number(1));
        shelf.step();
        shelf.until_over(ms(10_000));
        assert_eq!(shelf.last_row().state, RowState::Done);
        let kept = shelf.keeper.whole.lock().expect("kept")[&1].clone();
        assert!(kept == shelf.logs[0], "other bytes");
        let bytes = (shelf.passed - before) * 90;
        assert!(bytes < most, "{bytes} bytes");
    }
}

#[test]
fn a_download_is_stopped_and_goes_on_later() {
    let mut shelf = Shelf::new(vec![log(50_000, 2)]);
    shelf.download(LogChoice::Group(LogGroup::Last));
    while shelf.last_row().state != RowState::InProgress(30) {
        shelf.step();
    }
    shelf.order(LogCommand::Stop);
    shelf.step();
    let states: Vec<_> = shelf.scene.rows.iter().rev().take(2).collect();
    assert_eq!(states[0].state, RowState::Done);
    assert_eq!(states[1].state, RowState::Superseded);
    let requests = shelf.requests;
    shelf.sending = None;
    shelf.until_over(ms(3000));
    assert_eq!(shelf.requests, requests);
    shelf.order(LogCommand::Stop);
    shelf.step();
    assert_eq!(shelf.last_row().state, RowState::Refused);
    shelf.carried = 0;
    shelf.download(LogChoice::Group(LogGroup::Last));
    shelf.step();
    shelf.until_over(ms(10_000));
    assert_eq!(shelf.last_row().state, RowState::Done);
    assert!(shelf.kept(1) == log(50_000, 2) && shelf.carried < 40_000);
}

#[test]
fn a_vehicle_that_falls_silent_is_given_up_and_what_came_is_kept() {
    let mut shelf = Shelf::new(vec![log(50_000, 2)]);
    shelf.download(LogChoice::Group(LogGroup::Last));
    while shelf.last_row().state != RowState::InProgress(30) {
        shelf.step();
    }
    shelf.loss = 1.0;
    shelf.until_over(Duration::from_secs(120));
    assert_eq!(shelf.last_row().state, RowState::TimedOut);
    let parts = shelf.keeper.parts.lock().expect("kept");
    assert!((30..=31).contains(&parts[&1].1.percent()));
}

#[test]
fn logs_are_refused_while_armed_and_where_they_cannot_be_kept() {
    let mut shelf = Shelf::new(vec![log(500, 2)]);
    shelf.scene.heartbeat(STABILIZE, true);
    shelf.order(LogCommand::List);
    assert_eq!(shelf.last_row().state, RowState::Refused);
    let mut scene = Scene::new();
    let verb = &language::row("logs").expect("a verb").verb;
    let command = Command::Log(LogCommand::Download {
        which: LogChoice::Group(LogGroup::Last),
        folder: None,
    });
    let order = VehicleCommand::new(EntryId(1), verb, command);
    scene.session.order(order, scene.now);
    scene.collect();
    assert_eq!(scene.rows.last().expect("a row").state, RowState::Refused);
}

#[test]
fn the_highest_number_of_logs_is_listed() {
    let mut shelf = Shelf::new(vec![log(100, 1)]);
    shelf.order(LogCommand::List);
    for id in 1..=u16::MAX {
        let entry = LOG_ENTRY_DATA {
            time_utc: 0,
            size: 1,
            id,
            num_logs: u16::MAX,
            last_log_num: u16::MAX,
        };
        shelf.scene.pass(Duration::ZERO);
        shelf.scene.hear(MavMessage::LOG_ENTRY(entry));
    }
    shelf.scene.pass(ms(10));
    assert_eq!(shelf.last_row().state, RowState::Done);
    assert!(
        shelf
            .explanation()
            .starts_with("65535 logs, 65.5 kB: 65535")
    );
}

#[test]
fn bytes_all_over_a_huge_log_make_no_endless_list() {
    let mut shelf = Shelf::new(vec![Vec::new()]);
    shelf.download(LogChoice::Number(1));
    let entry = LOG_ENTRY_DATA {
        time_utc: 0,
        size: u32::MAX,
        id: 1,
        num_logs: 1,
        last_log_num: 1,
    };
    shelf.scene.pass(Duration::ZERO);
    shelf.scene.hear(MavMessage::LOG_ENTRY(entry));
    shelf.scene.pass(ms(10));
    for (step, count) in [(2, 1), (180, 90)] {
        for place in 0..20_000 {
            let data = LOG_DATA_DATA {
                ofs: place * step,
                id: 1,
                count,
                ..LOG_DATA_DATA::DEFAULT
            };
            shelf.scene.hear(MavMessage::LOG_DATA(data));
        }
        shelf.scene.pass(Duration::from_secs(2));
    }
    let parts = shelf.keeper.kept_gaps.lock().expect("kept");
    assert!(*parts > 5000 && *parts <= 10_000, "{parts} gaps");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// As long as some messages arrive, the received log is correct, whatever is lost.
    #[test]
    fn a_log_survives_losses(
        seed in any::<u64>(),
        loss in 0.0..0.4,
        len in 1usize..60_000,
        rate in 1usize..40,
    ) {
        let mut shelf = Shelf::new(vec![log(len, 7)]);
        shelf.loss = loss;
        shelf.random = ChaCha8Rng::seed_from_u64(seed);
        shelf.rate = rate;
        shelf.download(LogChoice::Group(LogGroup::Last));
        shelf.until_over(Duration::from_secs(600));
        prop_assert_eq!(shelf.last_row().state, RowState::Done);
        let whole = shelf.keeper.whole.lock().expect("kept");
        prop_assert!(whole[&1] == log(len, 7));
    }
}
