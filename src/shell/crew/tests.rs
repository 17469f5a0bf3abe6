//! Host and members over real sockets, by the system's clock: threads write and read the record.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use crossterm::event::KeyCode;

use super::*;
use crate::app::event::TerminalEvent;
use crate::app::state::FlightView;
use crate::carrier::{Outbox, SeatPort};
use crate::crew::protocol::{Confirmed, CrewDenial, CrewHello, SaidLine, VERSION};
use crate::ledger::{LedgerEntry, RowState};
use crate::mission::Mission;
use crate::shell::key;
use crate::shell::pace::TICK;
use crate::shell::{Opening, Preferences};
use crate::store::{RecordLimits, Records, Runs};

const THREE: &str = include_str!("../../../missions/02-formation.toml");

/// A console with its end of the crew.
struct Aboard {
    console: Console,
    end: CrewEnd,
}

impl Aboard {
    async fn new(opening: Opening, crew: CrewOptions, data: &Path) -> Self {
        let options = ConsoleOptions {
            crew: Some(crew),
            preferences: Preferences {
                runs: Some(Runs::within(data)),
                records: Some(Records::within(data, RecordLimits::default())),
                data: Some(data.to_owned()),
                ..Preferences::default()
            },
            ..ConsoleOptions::for_test(opening)
        };
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

    fn has_notice(&self, word: &str) -> bool {
        let notices = self.console.app.state().notices();
        let mut lines = notices.lines();
        lines.any(|line| line.notice.text.to_string().contains(word))
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
    panic!("it did not happen within a minute");
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
    let mut host = Box::pin(Aboard::new(Opening::Mission(mission), crew, &data)).await;
    until(&mut [&mut host], |aboard| !aboard[0].is_waiting(3)).await;
    // The first command ends the brief.
    host.say("all guided").await;
    host
}

async fn member(folder: &Path, name: &str, role: Option<Role>) -> Aboard {
    let data = folder.join(name);
    let crew = CrewOptions::Member {
        place: place(folder),
        name: "alpha".to_owned(),
        role,
        data: data.clone(),
    };
    Box::pin(Aboard::new(Opening::Home, crew, &data)).await
}

/// The name of a member of the user who runs the tests.
fn named(number: u32) -> String {
    format!("{}#{number}", own_user_name())
}

#[tokio::test]
async fn a_member_flies_a_vehicle_that_was_handed_over_and_both_see_who_commanded() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut host = Box::pin(host(folder.path(), THREE)).await;
    let mut anna = Box::pin(member(folder.path(), "anna", None)).await;
    until(&mut [&mut host, &mut anna], |aboard| {
        !aboard[1].is_waiting(3)
    })
    .await;
    let (own, theirs) = (own_user_name(), named(2));
    // A late joiner has the whole flight, with the names as this member sees them.
    until(&mut [&mut host, &mut anna], |aboard| {
        aboard[1].has_ended("all guided", Some(&own), RowState::Done)
    })
    .await;
    assert_eq!(anna.session().pilots().own(), Some(Vec::new()));

    host.say(&format!("crew offer 3 to {theirs}")).await;
    until(&mut [&mut host, &mut anna], |aboard| {
        aboard[1].has_notice("offers you 3")
    })
    .await;
    anna.say("crew accept").await;
    until(&mut [&mut host, &mut anna], |aboard| {
        aboard[1].session().pilots().own() == Some(vec![3])
    })
    .await;
    anna.say("3 arm").await;
    until(&mut [&mut host, &mut anna], |aboard| {
        aboard[0].has_ended("3 arm", Some(&theirs), RowState::Done)
            && aboard[1].has_ended("3 arm", None, RowState::Done)
    })
    .await;
    // The member's own console asks before a dangerous command.
    anna.say("3 kill").await;
    anna.console.feed(key(KeyCode::Char('1'))).await;
    until(&mut [&mut host, &mut anna], |aboard| {
        aboard[0].has_ended("3 kill", Some(&theirs), RowState::Done)
    })
    .await;
    // Each is refused the vehicles of the other.
    host.say("3 land").await;
    anna.say("1 arm").await;
    until(&mut [&mut host, &mut anna], |aboard| {
        aboard[1].has_ended("1 arm", None, RowState::Barred)
    })
    .await;
    let (entry, _) = anna.last().expect("a command");
    let why = entry.rows[0].explanation.as_ref().expect("a reason");
    assert_eq!(why.to_string(), format!("{own} flies 1"));
    let landed = host
        .session()
        .ledger()
        .entries()
        .find(|it| it.line == "3 land");
    assert_eq!(landed.map(|it| it.rows[0].state), Some(RowState::Barred));

    // Who leaves gives the vehicles back.
    let copy = std::fs::read_dir(folder.path().join("anna/crew")).expect("a copy");
    assert_eq!(copy.count(), 3, "the copy remains");
    anna.end.close().await;
    until(&mut [&mut host], |aboard| {
        aboard[0].has_notice("has left the crew: the host flies 3")
    })
    .await;
    assert_eq!(host.session().pilots().of(3), None);
}

/// The files in a folder and below, by name.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(files(&path));
        } else {
            let name = path.file_name().expect("a name").to_string_lossy();
            found.insert(name.into_owned(), std::fs::read(&path).expect("a file"));
        }
    }
    found
}

/// The copies of a member that differ from the host's files.
fn differing(folder: &Path, member: &str) -> Vec<String> {
    let (own, theirs) = (
        files(&folder.join("host")),
        files(&folder.join(member).join("crew")),
    );
    let differs = theirs
        .iter()
        .filter(|(name, bytes)| own.get(*name) != Some(bytes));
    differs.map(|(name, _)| name.clone()).collect()
}

#[tokio::test]
async fn a_member_gets_every_flight_to_its_end() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut host = Box::pin(host(folder.path(), THREE)).await;
    let mut anna = Box::pin(member(folder.path(), "anna", None)).await;
    until(&mut [&mut host, &mut anna], |aboard| {
        !aboard[1].is_waiting(3)
    })
    .await;
    host.say("all arm").await;
    Box::pin(host.console.start_again(true))
        .await
        .expect("it starts");
    let copies = folder.path().join("anna/crew");
    let first: Vec<_> = files(&copies).into_keys().collect();
    until(&mut [&mut host, &mut anna], |aboard| {
        files(&copies).len() == 6 && !aboard[1].is_waiting(3)
    })
    .await;
    let differing_now = differing(folder.path(), "anna");
    assert!(first.iter().all(|name| !differing_now.contains(name)));
    host.say("all guided").await;
    Box::pin(host.turn()).await;
    // The host quits.
    let Aboard {
        mut console,
        mut end,
    } = host;
    Box::pin(console.close()).await;
    console.tell_crew(&mut end);
    let turns = async {
        while anna
            .console
            .app
            .state()
            .crew()
            .member()
            .is_some_and(MemberPlace::is_connected)
        {
            Box::pin(anna.turn()).await;
        }
    };
    tokio::join!(end.close(), turns);
    assert_eq!(differing(folder.path(), "anna"), [""; 0]);
    until(&mut [&mut anna], |aboard| {
        aboard[0].has_notice("has ended")
            && aboard[0]
                .last()
                .is_some_and(|(entry, _)| entry.line == "all guided")
    })
    .await;
}

#[tokio::test]
async fn each_role_reaches_what_is_its_own() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut host = Box::pin(host(folder.path(), THREE)).await;
    let mut safety = Box::pin(member(folder.path(), "olena", Some(Role::Safety))).await;
    let mut looks = Box::pin(member(folder.path(), "petro", Some(Role::Observer))).await;
    until(&mut [&mut host, &mut safety, &mut looks], |aboard| {
        !aboard[1].is_waiting(3) && !aboard[2].is_waiting(3)
    })
    .await;
    host.say("all arm").await;
    until(&mut [&mut host, &mut safety, &mut looks], |aboard| {
        aboard[1]
            .last()
            .is_some_and(|(entry, _)| entry.is_final() && entry.line == "all arm")
    })
    .await;
    let message = |aboard: &Aboard| {
        let overlay = aboard.console.app.state().overlay();
        let Some(crate::app::state::Overlay::Palette(palette)) = overlay else {
            return String::new();
        };
        palette
            .fault()
            .map_or_else(String::new, |it| it.message.to_string())
    };
    safety.say("1 takeoff 10").await;
    assert_eq!(
        message(&safety),
        "this command is not part of your role: safety"
    );
    looks.say("1 disarm").await;
    assert_eq!(message(&looks), "observers give no commands");
    safety.say("1 disarm").await;
    until(&mut [&mut host, &mut safety, &mut looks], |aboard| {
        let is_safe = |vehicle: &Arc<crate::vehicle::Vehicle>| !vehicle.armed();
        aboard[0].session().vehicles().get(&1).is_some_and(is_safe)
    })
    .await;
    let (_, by) = host.last().expect("a command");
    assert!(by.is_some());
}

/// A connection without a console behind it.
struct Raw {
    port: SeatPort<HostMessage>,
    outbox: Option<Outbox>,
    said: Vec<HostMessage>,
}

impl Raw {
    fn new(folder: &Path) -> Self {
        Self {
            port: place(folder).join(),
            outbox: None,
            said: Vec::new(),
        }
    }

    async fn turn(&mut self) {
        let moment = Duration::from_millis(2);
        while let Ok(Some(arrival)) = tokio::time::timeout(moment, self.port.next()).await {
            match arrival {
                SeatArrival::Found { outbox, .. } => self.outbox = Some(outbox),
                SeatArrival::Line(line) => self.said.extend(line.ok()),
                SeatArrival::Lost => self.outbox = None,
                SeatArrival::Refused(_) => {}
            }
        }
    }
}

async fn until_raw(host: &mut Aboard, raw: &mut Raw, is_so: impl Fn(&Raw) -> bool) {
    for _ in 0..300 {
        if is_so(raw) {
            return;
        }
        tokio::time::sleep(TICK).await;
        Box::pin(host.turn()).await;
        raw.turn().await;
    }
    panic!("it did not happen within half a minute: {:?}", raw.said);
}

#[tokio::test]
async fn who_is_no_member_commands_nothing_and_no_file_can_be_asked_for() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut host = Box::pin(host(folder.path(), THREE)).await;
    let mut raw = Raw::new(folder.path());
    until_raw(&mut host, &mut raw, |raw| raw.outbox.is_some()).await;
    let say = |id, line: &str| MemberMessage::Say {
        id,
        line: SaidLine::try_from(line.to_owned()).expect("a line"),
        confirmed: Confirmed::Hazard,
    };
    raw.outbox.as_ref().expect("open").send(&say(1, "all arm"));
    until_raw(&mut host, &mut raw, |raw| {
        raw.said.contains(&HostMessage::Denied(CrewDenial::NoHello))
    })
    .await;
    let (_, by) = host.last().expect("the host's own command");
    assert_eq!(by, None, "nothing was commanded");

    until_raw(&mut host, &mut raw, |raw| raw.outbox.is_none()).await;
    until_raw(&mut host, &mut raw, |raw| raw.outbox.is_some()).await;
    let hello = MemberMessage::Hello(CrewHello {
        protocol: VERSION,
        role: Some(Role::Pilot),
        has: None,
    });
    raw.outbox.as_ref().expect("open").send(&hello);
    until_raw(&mut host, &mut raw, |raw| {
        raw.said
            .iter()
            .any(|it| matches!(it, HostMessage::Now { .. }))
    })
    .await;
    for (id, line) in [
        (1, "1 plan upload /etc/passwd"),
        (2, "1 plan download /tmp/x.plan"),
        (3, "quit"),
        (4, "abandon"),
    ] {
        raw.outbox.as_ref().expect("open").send(&say(id, line));
        until_raw(&mut host, &mut raw, |raw| {
            let refused = |it: &HostMessage| {
                matches!(it, HostMessage::Answer { id: answered, fault: Some(_) } if *answered == id)
            };
            raw.said.iter().any(refused)
        })
        .await;
    }
    // A dangerous command is not carried out before its member has confirmed it.
    let unconfirmed = MemberMessage::Say {
        id: 5,
        line: SaidLine::try_from("1 kill".to_owned()).expect("a line"),
        confirmed: Confirmed::Nothing,
    };
    raw.outbox.as_ref().expect("open").send(&unconfirmed);
    until_raw(&mut host, &mut raw, |raw| {
        let refused = |it: &HostMessage| {
            matches!(
                it,
                HostMessage::Answer {
                    id: 5,
                    fault: Some(_)
                }
            )
        };
        raw.said.iter().any(refused)
    })
    .await;
    let (entry, by) = host.last().expect("the host's own command");
    assert_eq!((entry.line.as_str(), by), ("all guided", None));
    // Who floods the host is sent away.
    for id in 100..200 {
        raw.outbox.as_ref().expect("open").send(&say(id, "crew"));
        raw.turn().await;
    }
    until_raw(&mut host, &mut raw, |raw| raw.outbox.is_none()).await;
}
