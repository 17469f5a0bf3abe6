//! Host and members over real sockets, by the system's clock: threads write and read the record.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use crossterm::event::KeyCode;

use super::*;
use crate::app::event::TerminalEvent;
use crate::app::state::FlightView;
use crate::ledger::{LedgerEntry, RowState};
use crate::mission::Mission;
use crate::shell::key;
use crate::shell::pace::TICK;
use crate::shell::{Opening, Preferences};
use crate::store::{RecordLimits, Records, Runs};

mod flights;
mod joining;
mod plain;
mod roles;
mod strangers;

const THREE: &str = include_str!("../../../missions/02-formation.toml");

/// A console with its end of the crew.
struct Aboard {
    console: Console,
    end: CrewEnd,
}

impl Aboard {
    async fn new(options: ConsoleOptions) -> Self {
        let end = CrewEnd::open(&options).expect("the crew opens");
        let mut console = Console::new(options, true);
        let (columns, rows) = (120, 40);
        console.feed(TerminalEvent::Resize { columns, rows }).await;
        Box::pin(console.begin()).await;
        Self { console, end }
    }

    /// What the run loop does in one tick.
    async fn turn(&mut self) {
        self.console.tick().await;
        let moment = Duration::from_millis(2);
        while let Ok(arrival) = tokio::time::timeout(moment, self.end.next()).await {
            self.console.attend_crew(&mut self.end, arrival).await;
        }
        self.console.tell_crew(&mut self.end);
    }

    async fn say(&mut self, line: &str) {
        self.console
            .feed(TerminalEvent::Line(line.to_owned()))
            .await;
    }

    fn session(&self) -> &FlightView {
        self.console.app.state().session()
    }

    /// All notices, oldest first.
    fn notices(&self) -> Vec<String> {
        let lines = self.console.app.state().notices().lines();
        lines.map(|line| line.notice.text.to_string()).collect()
    }

    fn has_notice(&self, word: &str) -> bool {
        self.notices().iter().any(|text| text.contains(word))
    }

    /// The last entry of the ledger, with its giver.
    fn last(&self) -> Option<(&LedgerEntry, Option<String>)> {
        let entry = self.session().ledger().entries().next_back()?;
        Some((entry, entry.by.as_ref().map(|by| by.name().to_owned())))
    }

    /// Whether the last command has this line and giver, and ended in this state.
    fn has_ended(&self, line: &str, by: Option<&str>, state: RowState) -> bool {
        self.last().is_some_and(|(entry, giver)| {
            entry.line == line
                && giver.as_deref() == by
                && entry.rows.iter().all(|row| row.state == state)
        })
    }

    fn is_waiting(&self, count: usize) -> bool {
        self.session().vehicles().len() < count
    }
}

fn options(opening: Opening, crew: CrewOptions, data: &Path) -> ConsoleOptions {
    ConsoleOptions {
        crew: Some(crew),
        preferences: Preferences {
            runs: Some(Runs::within(data)),
            records: Some(Records::within(data, RecordLimits::default())),
            data: Some(data.to_owned()),
            ..Preferences::default()
        },
        ..ConsoleOptions::for_test(opening)
    }
}

/// Lets the consoles run until something is so.
async fn until(aboard: &mut [&mut Aboard], is_so: impl Fn(&[&mut Aboard]) -> bool) {
    for _ in 0..600 {
        if is_so(aboard) {
            return;
        }
        tokio::time::sleep(TICK).await;
        for one in &mut *aboard {
            Box::pin(one.turn()).await;
        }
    }
    let said = aboard.iter().map(|one| one.notices());
    let said: Vec<_> = said.collect();
    panic!("it did not happen within a minute: {said:#?}");
}

fn place(folder: &Path) -> HostPlace {
    HostPlace::crew(&folder.join("alpha").display().to_string(), None)
}

async fn host(folder: &Path, source: &str) -> Aboard {
    let crew = CrewOptions::Host {
        place: place(folder),
        name: "alpha".to_owned(),
    };
    let mission = Arc::new(Mission::parse(source).expect("it is good"));
    let data = folder.join("host");
    let options = options(Opening::Mission(mission), crew, &data);
    let mut host = Box::pin(Aboard::new(options)).await;
    until(&mut [&mut host], |aboard| !aboard[0].is_waiting(3)).await;
    // The first command ends the brief.
    host.say("all guided").await;
    host
}

async fn member(folder: &Path, name: &str, role: Option<Role>) -> Aboard {
    Box::pin(Aboard::new(member_options(folder, name, role))).await
}

fn member_options(folder: &Path, name: &str, role: Option<Role>) -> ConsoleOptions {
    let data = folder.join(name);
    let crew = CrewOptions::Member {
        place: place(folder),
        name: "alpha".to_owned(),
        role,
        data: data.clone(),
    };
    options(Opening::Home, crew, &data)
}

/// The name of a member of the user who runs the tests.
fn named(number: u32) -> String {
    format!("{}#{number}", own_user_name())
}
