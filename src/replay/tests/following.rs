//! Recordings that are followed while they are made.

use std::fs::File;
use std::io::Write as _;
use std::path::PathBuf;

use super::*;
use crate::app::state::FlightView;
use crate::crew::CrewViewpoint;
use crate::pilot_in_command::Person;
use crate::record::Head;
use crate::store::RecordFiles;

/// The files of a record.
const ENDINGS: [&str; 2] = ["flight.jsonl", "tlog"];
/// The number of bytes that are added to each file at once, at first and later.
const FIRST: usize = 40_000;
const NEXT: usize = 7_001;

fn viewpoint() -> CrewViewpoint {
    CrewViewpoint {
        own: Person::named("anna"),
        host: Person::named("bohdan"),
    }
}

/// Makes a file a member's copy of the record of a host.
fn copied_by_anna(frames: &Path) -> PathBuf {
    let journal = frames.with_extension("flight.jsonl");
    let text = std::fs::read_to_string(&journal).expect("it is there");
    let (head, lines) = text.split_once('\n').expect("lines");
    let mut head: Head = serde_json::from_str(head).expect("a head");
    head.host = Some(viewpoint().host);
    std::fs::write(&journal, head.to_line() + lines).expect("written");
    let files = RecordFiles::beside(frames);
    files.write_viewer(&viewpoint().own).expect("written");
    frames.to_owned()
}

fn vehicles(session: &FlightView) -> String {
    format!("{:#?}", session.vehicles())
}

#[test]
fn a_recording_followed_as_it_grows_leads_to_the_same_state() {
    let recorded = record();
    let folder = tempfile::tempdir().expect("a folder");
    let own = folder.path().join("flight.tlog");
    let whole = ENDINGS
        .map(|ending| std::fs::read(recorded.frames.with_extension(ending)).expect("it is there"));
    let mut files =
        ENDINGS.map(|ending| File::create(own.with_extension(ending)).expect("created"));
    let mut written = [0; 2];
    let mut grow = |count: usize| {
        for ((file, whole), written) in files.iter_mut().zip(&whole).zip(&mut written) {
            let to = whole.len().min(*written + count);
            file.write_all(&whole[*written..to]).expect("written");
            *written = to;
        }
        written
            .iter()
            .zip(&whole)
            .all(|(written, whole)| *written == whole.len())
    };
    grow(FIRST);
    let (mut replay, begun) = Replay::follow(&own, &viewpoint()).expect("a recording");
    let mut observer = {
        let film = replay.film();
        Observer::new(film.view(), &film.started(), &Config::default(), None)
    };
    observer.see_all(begun);
    while !grow(NEXT) {
        observer.see_all(replay.tick(Duration::ZERO));
    }
    // Nothing is played beyond what is complete.
    assert_eq!(replay.now(), Duration::ZERO);
    let times = [s(15), s(40)];
    for to in times {
        replay.complete(to);
        while replay.now() + FRAME <= to {
            observer.see_all(replay.tick(Duration::ZERO));
        }
    }
    // So does a replay of the copy later, at any time.
    let copied = copied_by_anna(&own);
    let (mut again, mut later) = watched_at(&copied);
    seek(&mut again, &mut later, s(40));
    let (mut straight, mut watcher) = watched(&recorded);
    for to in times {
        seek(&mut straight, &mut watcher, to);
    }
    let (followed, played) = (observer.app().state(), watcher.app().state());
    assert_eq!(vehicles(followed.session()), vehicles(played.session()));
    let lines = |state: &State| -> Vec<String> {
        let entries = state.session().ledger().entries();
        entries.map(|entry| entry.line.clone()).collect()
    };
    assert_eq!(lines(followed), lines(played));
    // On a member's console, the commands and the vehicles of the host have the host's name.
    let entries = followed.session().ledger().entries();
    let host = Some(Person::named("bohdan"));
    assert!(entries.into_iter().all(|entry| entry.by == host));
    assert_eq!(followed.session().pilots().of(1), host.as_ref());
    let replayed = later.app().state().session();
    let mut entries = replayed.ledger().entries();
    assert!(entries.len() > 0 && entries.all(|entry| entry.by == host));
    assert_eq!(replayed.pilots().of(1), host.as_ref());
    assert!(replay.damage().next().is_none());
    let refused = replay.steer(ReplayEffect::Play(false));
    assert!(matches!(&refused[..], [Event::Failed(_)]));
}
