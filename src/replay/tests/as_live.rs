//! Comparisons of a replay with the live console.

use std::collections::{BTreeMap, BTreeSet};

use super::*;
use crate::link::TlogReader;
use crate::notice::NoticeSource;
use crate::record::NoticeLine;
use crate::session::{Report, Session, autopilot_of};

/// The notices of sessions that receive the recorded frames as they come: their texts, and whether a vehicle sent them.
fn heard_live(recorded: &Recorded) -> BTreeSet<(String, bool)> {
    let file = std::fs::File::open(&recorded.frames).expect("it is there");
    let mut sessions: BTreeMap<u8, Session> = BTreeMap::new();
    for record in TlogReader::new(std::io::BufReader::new(file)) {
        let record = record.expect("a sound tlog");
        let at = Duration::from_micros(record.unix_us - BEGAN_US);
        let mut decoder = Decoder::new();
        decoder.push(&record.bytes);
        let frame = decoder.next_frame().expect("a frame");
        if let Some(component) = autopilot_of(&frame) {
            let new = || Session::new(frame.system, component, at).following_plans();
            sessions.entry(frame.system).or_insert_with(new);
        }
        if let Some(session) = sessions.get_mut(&frame.system) {
            session.receive(&frame, at);
        }
    }
    let reports = sessions.values_mut().flat_map(Session::take_reports);
    let notices = reports.filter_map(|report| match report {
        Report::Notice(notice) => Some((notice.text.to_string(), is_of_vehicle(&notice))),
        Report::Row(_) | Report::Folder(_) => None,
    });
    notices.collect()
}

fn is_of_vehicle(notice: &Notice) -> bool {
    match notice.source {
        NoticeSource::Vehicle => true,
        NoticeSource::Program | NoticeSource::Class => false,
    }
}

#[test]
fn notices_have_the_source_that_they_had_in_the_flight() {
    let recorded = record();
    let journal = recorded.frames.with_extension("flight.jsonl");
    let own = Notice::about(1, s(41), Severity::Warning, Text::verbatim("ours"));
    let line = JournalLine::new(s(41), Happening::Notice(NoticeLine::of(&own)));
    let before = std::fs::read_to_string(&journal).expect("there");
    std::fs::write(&journal, before + &line.to_line()).expect("writable");
    let live = heard_live(&recorded);
    assert!(
        live.contains(&("Arming motors".to_owned(), true)),
        "{live:?}"
    );
    let (mut replay, mut observer) = watched(&recorded);
    seek(&mut replay, &mut observer, s(44));
    let notices = observer.app().state().notices();
    let replayed: BTreeSet<(String, bool)> = notices
        .lines()
        .map(|line| (line.notice.text.to_string(), is_of_vehicle(&line.notice)))
        .collect();
    assert!(replayed.is_superset(&live), "{live:?} {replayed:?}");
    let sent = |it: &&(String, bool)| it.1;
    assert!(replayed.iter().filter(sent).eq(live.iter().filter(sent)));
    assert!(replayed.contains(&("ours".to_owned(), false)));
}

#[test]
fn the_traffic_is_counted_in_both_directions_and_nothing_else() {
    let recorded = record();
    let (mut replay, mut observer) = watched(&recorded);
    seek(&mut replay, &mut observer, s(18));
    let [link] = observer.app().state().session().links() else {
        panic!("one link")
    };
    assert!(link.bytes_in_per_s > 5.0 * link.bytes_out_per_s, "{link:?}");
    // A heartbeat each second.
    assert!((link.messages_out_per_s - 1.0).abs() < 0.5, "{link:?}");
    assert_eq!((&link.counters, link.round_trip), (&None, None));
}
