//! Records that are handed in, over a real socket and by the system's clock: threads read and write the files.

use super::*;
use crate::grading::Mark;
use crate::shell::Preferences;
use crate::store::{ClassRecords, Records, Runs};

/// A member whose files are in a folder of its own.
pub(super) async fn keeping(opening: Opening, class: ClassOptions, data: &Path) -> Member {
    let options = ConsoleOptions {
        class: Some(class),
        preferences: Preferences {
            runs: Some(Runs::within(data)),
            records: Some(Records::within(data, crate::store::RecordLimits::default())),
            data: Some(data.to_owned()),
            ..Preferences::default()
        },
        ..ConsoleOptions::for_test(opening)
    };
    Box::pin(Member::with(options)).await
}

/// Lets the members run until something is so.
pub(super) async fn until(members: &mut [&mut Member], is_so: impl Fn(&[&mut Member]) -> bool) {
    for _ in 0..600 {
        if is_so(members) {
            return;
        }
        tokio::time::sleep(TICK).await;
        for member in &mut *members {
            Box::pin(member.turn()).await;
        }
    }
    panic!("it did not happen within a minute");
}

impl Member {
    /// Ends the console as its user does.
    pub(super) async fn quit(mut self) {
        Box::pin(self.console.close()).await;
        Box::pin(self.console.hand_in_rest(&mut self.end)).await;
    }

    /// The number of trainees whose flights the desk knows; `None` until it has read its records.
    fn trainees(&self) -> Option<usize> {
        let room = self.console.app.state().rooms().class();
        Some(room.results()?.trainees.len())
    }

    /// The number of flights that the desk knows.
    pub(super) fn flights(&self) -> usize {
        let room = self.console.app.state().rooms().class();
        let trainees = room.results().map_or(&[][..], |it| &it.trainees);
        trainees.iter().map(|it| it.tries + it.practice).sum()
    }

    /// Whether the desk shows a flight to be graded.
    fn is_grading(&self) -> bool {
        let room = self.console.app.state().rooms().class();
        room.grading().is_some()
    }

    pub(super) fn is_flying(&self) -> bool {
        let report = self.console.app.state().seat_report(false).flight;
        report.is_some_and(|flight| flight.clock_s > 0.5)
    }
}

fn marks(data: &Path) -> usize {
    let names = std::fs::read_dir(data.join("runs")).into_iter().flatten();
    let names = names.flatten().map(|entry| entry.file_name());
    let is_mark = |name: &std::ffi::OsString| name.to_string_lossy().ends_with(".class");
    names.filter(is_mark).count()
}

#[tokio::test]
async fn a_desk_that_was_away_gets_the_record_from_the_next_console() {
    let folder = tempfile::tempdir().expect("a folder");
    let (own, theirs) = (folder.path().join("anna"), folder.path().join("petro"));
    let mission = Arc::new(Mission::parse(FIRST).expect("it is good"));
    let opening = Opening::Mission(mission);
    let mut anna = keeping(opening, seat_options(folder.path()), &own).await;
    anna.console.feed(key(KeyCode::Enter)).await;
    until(&mut [&mut anna], |members| members[0].is_flying()).await;
    Box::pin(anna.quit()).await;
    assert_eq!(marks(&own), 1, "it waits for the desk");

    let mut desk = keeping(Opening::Home, desk_options(folder.path()), &theirs).await;
    until(&mut [&mut desk], |members| members[0].trainees() == Some(0)).await;
    let mut anna = keeping(Opening::Home, seat_options(folder.path()), &own).await;
    until(&mut [&mut desk, &mut anna], |members| {
        members[0].trainees() == Some(1) && members[1].place().seat().hand_in().is_empty()
    })
    .await;
    let room = desk.console.app.state().rooms().class();
    let trainee = &room.results().expect("results").trainees[0];
    // A seed was chosen, so it is practice.
    assert_eq!((trainee.tries, trainee.practice), (0, 1));
    until(&mut [&mut desk, &mut anna], |_| marks(&own) == 0).await;

    desk.console.feed(key(KeyCode::Char('g'))).await;
    until(&mut [&mut desk, &mut anna], |members| {
        members[0].is_grading()
    })
    .await;
    desk.console.feed(key(KeyCode::Char('4'))).await;
    Box::pin(desk.quit()).await;
    let sheets = ClassRecords::within(&theirs, "9-A").sheets().0;
    let [kept] = &sheets[..] else {
        panic!("one sheet, even if the desk quits at once: {sheets:?}");
    };
    let marks: Vec<_> = kept.sheet.grades.values().map(|it| it.mark).collect();
    assert_eq!(marks, [Mark::try_from(4).ok()]);
}
