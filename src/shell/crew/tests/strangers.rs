//! Who is no member, or behaves badly.

use super::*;
use crate::carrier::{Outbox, SeatPort};
use crate::crew::protocol::{Confirmed, CrewDenial, CrewHello, SaidLine, VERSION};

/// A connection without a console behind it.
pub(super) struct Raw {
    port: SeatPort<HostMessage>,
    outbox: Option<Outbox>,
    said: Vec<HostMessage>,
}

impl Raw {
    pub(super) fn new(folder: &Path) -> Self {
        Self {
            port: place(folder).join(),
            outbox: None,
            said: Vec::new(),
        }
    }

    /// Joins as a pilot.
    pub(super) async fn join(&mut self, host: &mut Aboard) {
        until_raw(host, self, |raw| raw.outbox.is_some()).await;
        let hello = MemberMessage::Hello(CrewHello {
            protocol: VERSION,
            role: Some(Role::Pilot),
            has: None,
        });
        self.outbox.as_ref().expect("open").send(&hello);
        until_raw(host, self, |raw| {
            let mut said = raw.said.iter();
            said.any(|it| matches!(it, HostMessage::Welcome { .. }))
        })
        .await;
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
        given_ms: None,
    };
    raw.outbox.as_ref().expect("open").send(&say(1, "all arm"));
    until_raw(&mut host, &mut raw, |raw| {
        raw.said.contains(&HostMessage::Denied(CrewDenial::NoHello))
    })
    .await;
    let (_, by) = host.last().expect("the host's own command");
    assert_eq!(by, None, "nothing was commanded");

    until_raw(&mut host, &mut raw, |raw| raw.outbox.is_none()).await;
    raw.join(&mut host).await;
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
        given_ms: None,
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
