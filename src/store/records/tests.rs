use std::sync::mpsc;
use std::time::Duration;

use super::*;
use crate::record::{Happening, Journal, JournalLine, Subject};
use crate::review::Review;

fn head() -> Head {
    Head::new(Subject::Free, 1_700_000_000_000_000)
}

fn bookmark(at_s: u64) -> JournalLine {
    let text = "here".to_owned();
    JournalLine::new(Duration::from_secs(at_s), Happening::Bookmark { text })
}

fn records(count: usize, bytes: u64) -> (tempfile::TempDir, Records) {
    let folder = tempfile::tempdir().expect("a folder");
    let records = Records::within(folder.path(), RecordLimits { count, bytes });
    (folder, records)
}

#[test]
fn what_is_recorded_is_in_the_files_when_the_record_is_over() {
    let (_folder, records) = records(10, 1 << 20);
    let (send, receive) = mpsc::channel();
    let source = move || receive.try_iter().flatten().collect();
    let recording = records
        .begin(&head(), None, "2026-11-20T14:03:22Z", source)
        .expect("a record");
    send.send(b"frames".to_vec()).expect("it listens");
    recording.note(bookmark(3));
    recording.note(bookmark(2));
    assert!(records.list()[0].is_written());
    drop(recording);
    let [files] = &records.list()[..] else {
        panic!("one record");
    };
    assert!(!files.is_written());
    assert_eq!(files.head().expect("a head"), head());
    let journal = fs::read_to_string(files.journal.as_ref().expect("it")).expect("readable");
    let journal = Journal::read(&journal).expect("a journal");
    assert_eq!(journal.lines, [bookmark(3), bookmark(3)]);
    assert_eq!(journal.damage, None);
    assert_eq!(
        fs::read(files.frames.as_ref().expect("it")).expect("it"),
        b"frames"
    );
    assert_eq!(
        RecordFiles::beside(files.frames.as_ref().expect("it")),
        *files
    );
    files.delete().expect("it goes");
    assert_eq!(records.list(), []);
}

#[test]
fn a_record_without_frames_is_removed_and_never_the_newest() {
    let (_folder, records) = records(10, 1 << 20);
    let begin = |when: &str, frames: &'static [u8]| {
        let recording = records.begin(&head(), None, when, move || frames.to_vec());
        recording.expect("a record")
    };
    begin("2026-11-20T14:03:22Z", b"frames").finish(true);
    let newest = records.newest();
    assert!(newest.is_some());
    // Its console was killed before the first frame.
    drop(begin("2026-11-20T15:03:22Z", b""));
    assert_eq!(
        (records.list().len(), records.newest()),
        (2, newest.clone())
    );
    assert_eq!(records.newest_of(None), newest);
    assert!(records.list().iter().all(RecordFiles::is_cut_off));
    begin("2026-11-20T16:03:22Z", b"").finish(true);
    begin("2026-11-20T17:03:22Z", b"frames").finish(false);
    assert_eq!(records.list().len(), 2);
}

#[test]
fn the_oldest_records_make_room_and_runs_stay() {
    let (_folder, records) = records(3, 1 << 20);
    for second in 0..5 {
        let when = format!("2026-11-20T14:03:0{second}Z");
        drop(
            records
                .begin(&head(), None, &when, Vec::new)
                .expect("a record"),
        );
        let stem = records.list().pop().expect("it").stem;
        fs::write(records.folder().join(format!("{stem}{RUN}")), "run").expect("writable");
    }
    let stems: Vec<String> = records.list().into_iter().map(|it| it.stem).collect();
    assert_eq!(stems.len(), 3);
    assert!(
        stems[0].starts_with("2026-11-20T14-03-02Z_free_"),
        "{stems:?}"
    );
    let runs = fs::read_dir(records.folder()).expect("a folder").flatten();
    let runs = runs.filter(|it| it.file_name().to_string_lossy().ends_with(RUN));
    assert_eq!(runs.count(), 5);
}

#[test]
fn a_record_that_is_too_large_ends_and_says_so() {
    let (_folder, records) = records(10, 1000);
    let recording = records
        .begin(&head(), None, "2026-11-20T14:03:22Z", || vec![7; 400])
        .expect("a record");
    let stem = recording.stem().to_owned();
    drop(recording);
    // The parts that fitted are there.
    let files = RecordFiles::beside(&records.folder().join(format!("{stem}{JOURNAL}")));
    assert!(files.head().is_ok());
    assert!(files.bytes <= 500, "{}", files.bytes);
}

#[test]
fn a_record_is_called_like_its_run() {
    let (_folder, records) = records(10, 1 << 20);
    let stem = "2026-11-20T14-03-22Z_01-air-sample_7-00";
    let recording = records
        .begin(&head(), Some(stem), "2026-11-20T14:03:22Z", Vec::new)
        .expect("a record");
    assert_eq!(recording.stem(), stem);
}

#[test]
fn a_review_outlives_the_frames_and_the_newest_of_a_mission_counts() {
    let folder = tempfile::tempdir().expect("a folder");
    let records = Records::within(folder.path(), RecordLimits::default());
    let write = |when: &str, whose: &str, why: &str| {
        let mut head = Head::new(Subject::Mission("01".to_owned()), 0);
        head.profile = Some(whose.to_owned());
        drop(
            records
                .begin(&head, None, when, Vec::new)
                .expect("a record"),
        );
        let files = records.list().pop().expect("it is there");
        let mut review = Review::of(Some(&head));
        why.clone_into(&mut review.why);
        files.write_review(&review).expect("it is written");
        files
    };
    write("2026-11-20T10:00:00Z", "vera", "first");
    let last = write("2026-11-20T11:00:00Z", "vera", "second");
    write("2026-11-20T12:00:00Z", "oleg", "other");
    last.delete().expect("the frames go");
    let newest = records.newest_reviews(Some("vera"));
    assert_eq!(newest["01"].why, "second");
    assert_eq!(records.list().len(), 2);
    last.delete_review().expect("it goes");
    assert_eq!(records.newest_reviews(Some("vera"))["01"].why, "first");
    assert!(records.newest_reviews(None).is_empty());
    assert_eq!(last.read_review(), Ok(None));
}
