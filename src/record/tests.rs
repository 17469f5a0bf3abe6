use super::*;
use crate::ledger::{EntryId, ForeignCommand, ForeignId, RowState, RowUpdate, StationId};
use crate::text;
use crate::wire::MavAddress;

fn head() -> Head {
    Head::new(Subject::Free, 1_700_000_000_000_000)
}

fn bookmark(at_s: u64) -> JournalLine {
    let text = "here".to_owned();
    JournalLine::new(Duration::from_secs(at_s), Happening::Bookmark { text })
}

#[test]
fn what_a_later_program_has_added_is_passed_over() {
    let later = "{\"us\":2000000,\"wind\":{\"m_s\":3}}\n";
    let text = [
        head().to_line(),
        bookmark(1).to_line(),
        later.to_owned(),
        bookmark(3).to_line(),
    ];
    let journal = Journal::read(&text.concat()).expect("a journal");
    assert_eq!(
        (journal.damage.as_ref(), &journal.unknown[..]),
        (None, &[3][..])
    );
    let faults: Vec<String> = journal.faults().map(|it| it.to_string()).collect();
    assert!(faults.iter().all(|it| it.contains("line 3")), "{faults:?}");
    assert_eq!(faults.len(), 1);
    assert_eq!(journal.lines, [bookmark(1), bookmark(3)]);
}

#[test]
fn the_reason_for_a_refusal_is_read_as_a_message() {
    let why = text!("reason-takeoff-mode-arm", mode = "STABILIZE");
    let update = RowUpdate {
        entry: EntryId(3),
        vehicle: 1,
        state: RowState::Refused,
        tries: 1,
        at: Duration::ZERO,
        explanation: Some(why.clone()),
    };
    let row = RowLine::of(&update);
    assert_eq!(row.why, Some(why.to_string()), "English words for others");
    let line = JournalLine::new(Duration::ZERO, Happening::Row(row));
    let text = [head().to_line(), line.to_line()].concat();
    let journal = Journal::read(&text).expect("a journal");
    let Some(Happening::Row(read)) = journal.lines.first().map(|line| &line.what) else {
        panic!("a row: {:?}", journal.lines);
    };
    assert_eq!(read.update(Duration::ZERO), update);
}

#[test]
fn a_command_of_another_station_is_read_as_it_was_written() {
    let command = ForeignCommand {
        id: ForeignId(4),
        station: StationId(MavAddress {
            system: 254,
            component: 230,
        }),
        vehicle: 3,
        at: Duration::from_secs(5),
        last_at: Duration::from_secs(5),
        what: Text::verbatim("mode RTL"),
        count: 2,
        state: RowState::Refused,
        explanation: Some(Text::verbatim("denied")),
    };
    let foreign = ForeignLine::of(&command);
    assert_eq!(foreign.command(Duration::from_secs(5)), command);
    let line = JournalLine::new(Duration::from_secs(5), Happening::Foreign(foreign));
    let text = [head().to_line(), line.to_line()].concat();
    let journal = Journal::read(&text).expect("a journal");
    assert_eq!((journal.lines, journal.damage), (vec![line], None));
}

#[test]
fn what_was_cut_off_or_goes_back_in_time_ends_a_journal() {
    let whole = [
        head().to_line(),
        bookmark(4).to_line(),
        bookmark(6).to_line(),
    ]
    .concat();
    let cut = Journal::read(&whole[..whole.len() - 9]).expect("a journal");
    assert_eq!(cut.lines, [bookmark(4)]);
    assert!(cut.damage.is_some());
    let back = [
        head().to_line(),
        bookmark(4).to_line(),
        bookmark(3).to_line(),
    ]
    .concat();
    let back = Journal::read(&back).expect("a journal");
    assert_eq!(back.lines, [bookmark(4)]);
    assert!(back.damage.is_some());
}

#[test]
fn a_line_with_an_impossible_time_ends_a_journal() {
    let day = 24 * 3600;
    let mission = |ms| JournalLine::new(Duration::from_secs(2), Happening::Mission { ms });
    let lines = [
        bookmark(2 + day),
        bookmark(u64::MAX / 1_000_000),
        mission(u64::MAX),
    ];
    for line in lines {
        let text = [
            head().to_line(),
            bookmark(1).to_line(),
            line.to_line(),
            bookmark(3).to_line(),
        ];
        let journal = Journal::read(&text.concat()).expect("a journal");
        assert_eq!(journal.lines, [bookmark(1)], "{line:?}");
        assert!(journal.damage.is_some());
    }
}

#[test]
fn damage_is_named_with_its_line_and_kind() {
    let text = [head().to_line(), bookmark(1).to_line()].concat();
    for (line, named) in [
        (
            "{\"us\":1e308,\"end\":null}\n",
            "line 3 of the journal has an impossible time",
        ),
        (
            "{\"us\":-1,\"end\":null}\n",
            "line 3 of the journal has an impossible time",
        ),
        (
            "{\"end\":null}\n",
            "line 3 of the journal has an impossible time",
        ),
        (
            "{\"us\":5,\"end\":null}\n",
            "line 3 of the journal has an impossible time",
        ),
        (
            "{\"us\":200}}00,\"end\":null}\n",
            "line 3 of the journal is damaged at column 11",
        ),
        ("{\"us\":2000000,\"bookma", "ends in the middle of line 3"),
        (
            "{\"us\":2000000,\"mission\":{\"ms\":1e308}}\n",
            "line 3 of the journal",
        ),
    ] {
        let journal = Journal::read(&format!("{text}{line}")).expect("a journal");
        assert_eq!(journal.lines, [bookmark(1)]);
        let faults: Vec<String> = journal.faults().map(|it| it.to_string()).collect();
        assert!(
            faults.len() == 1 && faults[0].contains(named),
            "{line}: {faults:?}"
        );
    }
}

#[test]
fn what_is_no_journal_is_refused_with_the_reason() {
    for (text, reason) in [
        ("", "not the journal"),
        ("{\"sortie_run\":1}\n", "not the journal"),
        ("{\"sortie_flight\":2}\n", "version 2"),
        ("{\"sortie_flight\":1}\n", "missing field"),
    ] {
        let fault = Journal::read(text).expect_err("no journal").to_string();
        assert!(fault.contains(reason), "{fault}");
    }
}
