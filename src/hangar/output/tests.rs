use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;

use proptest::prelude::*;

use super::*;
use crate::hangar::launcher::tests as launcher;

fn texts(lines: &[OutputLine]) -> Vec<&str> {
    lines.iter().map(|line| line.text.as_str()).collect()
}

fn sizes(folder: &Path) -> Vec<u64> {
    let names = ["output.log", "output.log.1", "output.log.2", "output.log.3"];
    let size = |name| fs::metadata(folder.join(name)).map_or(0, |data| data.len());
    names.map(size).to_vec()
}

async fn read(output: &ProcessOutput, bytes: &'static [u8]) {
    output.clone().read(Box::new(bytes)).await;
}

#[tokio::test]
async fn lines_are_numbered_and_found_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = ProcessOutput::new(folder.path().to_owned());
    let mut watch = output.watch();
    read(&output, b"one\ntwo\r\nthr\x1b[31mee\nlast \xff words").await;
    assert!(watch.has_changed().expect("it is there"));
    assert_eq!(*watch.borrow_and_update(), 4);
    assert_eq!(
        texts(&output.last(9)),
        ["one", "two", "thr?[31mee", "last \u{fffd} words"]
    );
    assert_eq!(texts(&output.last(1)), ["last \u{fffd} words"]);
    assert_eq!(output.since(3).first().map(|line| line.number), Some(3));
    assert_eq!((output.since(0).len(), output.since(5).len()), (4, 0));
    read(&output, b"again\n").await;
    output.note("it has ended");
    assert_eq!(texts(&output.since(5)), ["again", "it has ended"]);
    let written = fs::read_to_string(folder.path().join("output.log")).expect("written");
    assert_eq!(
        written,
        "one\ntwo\nthr?[31mee\nlast \u{fffd} words\nagain\nit has ended\n"
    );
}

#[tokio::test]
async fn a_line_that_tells_nothing_is_in_the_file_only() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = ProcessOutput::new(folder.path().to_owned());
    read(&output, b"one\nSkipping port (null)\ntwo\n").await;
    assert_eq!(texts(&output.last(9)), ["one", "two"]);
    let written = fs::read_to_string(folder.path().join("output.log")).expect("written");
    assert!(written.contains("Skipping"));
}

#[tokio::test]
async fn only_the_last_lines_stay_in_memory() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = ProcessOutput::new(folder.path().to_owned());
    for number in 1..=1000 {
        output.note(&format!("line {number}"));
    }
    let lines = output.since(0);
    assert_eq!(lines.len(), 200);
    assert!(
        lines
            .iter()
            .all(|line| line.text == format!("line {}", line.number))
    );
    assert_eq!(lines.last().map(|line| line.number), Some(1000));
    // The same when all lines arrive at once.
    let many: Vec<String> = (1..=1000).map(|number| format!("more {number}")).collect();
    output.add(many);
    let lines = output.since(0);
    assert_eq!(lines.len(), 200);
    assert!(
        lines
            .iter()
            .all(|line| line.text == format!("more {}", line.number - 1000))
    );
}

#[tokio::test]
async fn the_files_are_bounded_whatever_is_printed() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = ProcessOutput::new(folder.path().to_owned());
    let line = "x".repeat(99);
    for _ in 0..100 {
        output.add(vec![line.clone(); 700]);
    }
    let [now, before, oldest, none] = sizes(folder.path())[..] else {
        panic!("four names");
    };
    assert!(now > 0 && none == 0);
    for size in [before, oldest] {
        assert!((1024 * 1024..1_200_000).contains(&size), "{size}");
    }
    assert_eq!(*output.watch().borrow(), 70_000);
}

#[tokio::test]
async fn a_line_without_an_end_is_cut() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = ProcessOutput::new(folder.path().to_owned());
    let endless = tokio::io::AsyncReadExt::take(tokio::io::repeat(b'x'), 100_000_000);
    output.clone().read(Box::new(endless)).await;
    let lines = output.last(9);
    assert_eq!(lines.len(), 1);
    assert_eq!(lines[0].text, "x".repeat(399) + "…");
    assert!(sizes(folder.path())[0] < 1000);
}

#[tokio::test(start_paused = true)]
async fn a_full_disk_is_told_once_and_tried_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let log = folder.path().join("output.log");
    symlink("/dev/full", &log).expect("a link");
    let output = ProcessOutput::new(folder.path().to_owned());
    for number in 0..50 {
        output.note(&format!("line {number}"));
        tokio::time::advance(Duration::from_secs(1)).await;
    }
    let lines = output.last(100);
    let told = |word: &str| lines.iter().filter(|line| line.text.contains(word)).count();
    assert_eq!(
        (told("line "), told("cannot be written"), lines.len()),
        (50, 1, 51)
    );
    assert!(lines[1].text.contains("No space left"), "{}", lines[1].text);
    fs::remove_file(&log).expect("ours");
    tokio::time::advance(Duration::from_secs(20)).await;
    output.note("there is room");
    let said = output.last(1).remove(0).text;
    assert!(
        said.contains("written again") && said.contains("50 lines"),
        "{said}"
    );
    let written = fs::read_to_string(&log).expect("written");
    assert_eq!(written, "[50 lines are missing]\nthere is room\n");
}

#[tokio::test]
async fn a_folder_that_is_gone_stops_nobody_from_reading() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = ProcessOutput::new(folder.path().join("gone"));
    read(&output, b"one\ntwo\n").await;
    read(&output, b"three\n").await;
    let lines = output.last(9);
    assert_eq!(lines.len(), 4);
    assert!(lines[2].text.contains("cannot be written"), "{lines:?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn however_bytes_arrive_the_lines_are_the_same(
        bytes in prop::collection::vec(prop_oneof![Just(b'\n'), Just(b'x'), any::<u8>()], 0..2500),
        piece in 1..700_usize,
    ) {
        let cut = |pieces: Vec<&[u8]>| {
            let mut cutter = Cutter::default();
            let mut lines: Vec<String> = pieces.into_iter().flat_map(|piece| cutter.push(piece)).collect();
            lines.extend(cutter.finish());
            lines
        };
        let whole = cut(vec![&bytes]);
        prop_assert_eq!(&whole, &cut(bytes.chunks(piece).collect()));
        for line in &whole {
            prop_assert!(line.chars().count() <= 400);
            prop_assert!(!line.chars().any(char::is_control));
        }
    }

    #[test]
    fn long_lines_of_any_script_keep_their_beginning(text in "[а-яa-z😀]{380,420}", more in 0..2000_usize) {
        let text = text + &"ї".repeat(more);
        let mut cutter = Cutter::default();
        let line = cutter.push(format!("{text}\n").as_bytes()).remove(0);
        let is_cut = text.chars().count() > 400;
        let kept: String = text.chars().take(if is_cut { 399 } else { 400 }).collect();
        prop_assert_eq!(line, if is_cut { kept + "…" } else { kept });
    }
}

#[tokio::test]
async fn a_program_that_prints_without_end_is_read_and_ended() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = ProcessOutput::new(folder.path().to_owned());
    let mut order = launcher::shell("yes one & yes two >&2; wait");
    order.folder = folder.path().to_owned();
    let (_launcher, mut running) = launcher::start(order).await;
    let following = output.follow(&mut running);
    let mut watch = output.watch();
    watch
        .wait_for(|&number| number > 50_000)
        .await
        .expect("it goes on");
    running.end().await.expect("it ends");
    following.finish().await;
    let lines = output.since(0);
    assert_eq!(lines.len(), 200);
    assert!(sizes(folder.path()).iter().sum::<u64>() < 4 * 1024 * 1024);
    // Numbers have no gaps, although two pipes are read.
    let numbers: Vec<u64> = lines.iter().map(|line| line.number).collect();
    let last = *watch.borrow();
    assert_eq!(numbers, (last - 199..=last).collect::<Vec<_>>());
}

#[tokio::test]
async fn the_last_words_of_a_program_are_heard() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = ProcessOutput::new(folder.path().to_owned());
    let (_launcher, mut running) =
        launcher::start(launcher::shell("echo out; printf err >&2")).await;
    let following = output.follow(&mut running);
    running.wait().await.expect("it ends");
    following.finish().await;
    let last = output.last(9);
    let mut said = texts(&last);
    said.retain(|line| matches!(*line, "out" | "err"));
    said.sort_unstable();
    assert_eq!(said, ["err", "out"]);
}
