//! The connection of a member.

use std::path::PathBuf;
use std::time::Duration;

use super::faults;
use super::sign::SignOfLife;
use crate::app::effect::CrewEffect;
use crate::app::event::{CrewEvent, Event};
use crate::carrier::{Outbox, SeatArrival, SeatPort};
use crate::class::{RecordName, RecordPart};
use crate::crew::protocol::{CrewHello, HeldRecord, HostMessage, MemberMessage, VERSION};
use crate::crew::{CrewViewpoint, Role};
use crate::pilot_in_command::Person;
use crate::replay::Replay;
use crate::shell::Console;
use crate::store::{RecordCopy, RecordFiles};
use crate::text;
use crate::text::Text;

/// The maximum number of records of one connection: a host that begins one after the other fills no disk with files.
const MOST_RECORDS: u32 = 200;

/// The connection of a member, and its copy of the host's record.
pub(in crate::shell) struct MemberEnd {
    pub(super) port: SeatPort<HostMessage>,
    outbox: Option<Outbox>,
    sign: SignOfLife,
    role: Option<Role>,
    /// The program's data folder.
    data: PathBuf,
    copy: Option<RecordCopy>,
    /// The number of records since the connection opened.
    records: u32,
    /// Whether the copy is shown.
    is_shown: bool,
}

impl MemberEnd {
    pub(super) fn new(port: SeatPort<HostMessage>, role: Option<Role>, data: PathBuf) -> Self {
        Self {
            port,
            outbox: None,
            sign: SignOfLife::new(),
            role,
            data,
            copy: None,
            records: 0,
            is_shown: false,
        }
    }

    /// The first line of a connection.
    fn hello(&self) -> MemberMessage {
        let has = self.copy.as_ref().map(|copy| HeldRecord {
            record: copy.name().clone(),
            bytes: copy.held(),
        });
        MemberMessage::Hello(CrewHello {
            protocol: VERSION,
            role: self.role,
            has,
        })
    }

    /// Ends the connection, after the host was told that the user leaves.
    pub(super) async fn close(mut self) {
        self.sign.end();
        if let Some(outbox) = &self.outbox {
            outbox.send(&MemberMessage::Leave);
        }
        self.port.close().await;
    }

    /// Does what the state asks for.
    pub(super) fn carry_out(&self, work: Vec<CrewEffect>) {
        self.sign.note_run();
        let Some(outbox) = &self.outbox else {
            return;
        };
        for effect in work {
            if let CrewEffect::Say(message) = effect {
                outbox.send(&message);
            }
        }
    }

    /// Begins the copy of a record, unless it is the one that is there.
    fn begin(&mut self, name: RecordName, own: Option<&Person>) -> Result<(), Text> {
        if self.copy.as_ref().is_none_or(|copy| *copy.name() != name) {
            self.begin_anew(name)?;
        }
        // After a broken connection, this console may have another name.
        let noted = self
            .copy
            .iter()
            .zip(own)
            .try_for_each(|(copy, own)| copy.belongs_to(own));
        noted.map_err(|error| Text::from(&error))
    }

    fn begin_anew(&mut self, name: RecordName) -> Result<(), Text> {
        self.is_shown = false;
        if let Some(copy) = self.copy.take() {
            copy.close();
        }
        self.records += 1;
        if self.records > MOST_RECORDS {
            return Err(text!("crew-many-records"));
        }
        let copy = RecordCopy::create(&self.data, name).map_err(|error| Text::from(&error))?;
        self.copy = Some(copy);
        Ok(())
    }

    fn append(&mut self, part: RecordPart, bytes: &[u8]) -> Result<(), Text> {
        let Some(copy) = &mut self.copy else {
            return Ok(());
        };
        let written = copy.append(part, bytes);
        written.map_err(|error| {
            // It is not played any further.
            (self.copy, self.is_shown) = (None, false);
            Text::from(&error)
        })
    }

    /// The frames of the copy, once it has the heads of its files and a frame, and is not shown yet.
    fn showable(&self) -> Option<PathBuf> {
        let copy = self.copy.as_ref().filter(|_| !self.is_shown)?;
        let frames = copy.frames();
        let files = RecordFiles::beside(&frames);
        let head = files.head().ok()?;
        let has_run = head.subject.mission().is_none() || files.run_outline().is_some();
        let has_frames = copy
            .held()
            .iter()
            .any(|(part, bytes)| *part == RecordPart::Frames && *bytes > 0);
        (has_run && has_frames).then_some(frames)
    }
}

impl Console {
    /// Takes in what has arrived from the host.
    pub(super) async fn attend_host(
        &mut self,
        end: &mut MemberEnd,
        arrival: SeatArrival<HostMessage>,
    ) {
        match arrival {
            SeatArrival::Found { outbox, .. } => {
                outbox.send(&end.hello());
                end.sign.begin(outbox.clone());
                (end.outbox, end.records) = (Some(outbox), 0);
            }
            SeatArrival::Line(Ok(message)) => self.hear_host(end, message).await,
            // The carrier ends the connection.
            SeatArrival::Line(Err(fault)) => tracing::warn!("a line of the host: {fault}"),
            SeatArrival::Lost => {
                end.outbox = None;
                end.sign.end();
                self.feed(CrewEvent::Lost).await;
                if let Some(copy) = &end.copy {
                    let file = copy.frames().display().to_string();
                    self.feed(Event::Answer(text!("crew-copy", file = file)))
                        .await;
                }
            }
            SeatArrival::Refused(fault) => {
                self.feed(CrewEvent::Refused(faults::not_joined(&fault)))
                    .await;
            }
        }
    }

    async fn hear_host(&mut self, end: &mut MemberEnd, message: HostMessage) {
        if let HostMessage::Record(_) | HostMessage::Piece { .. } | HostMessage::Now { .. } =
            message
        {
            self.feed(CrewEvent::Said(HostMessage::Here)).await;
        }
        let taken = match message {
            HostMessage::Record(name) => {
                let viewpoint = self.viewpoint();
                end.begin(name, viewpoint.as_ref().map(|it| &it.own))
            }
            HostMessage::Piece { part, data } => end.append(part, &data.0),
            HostMessage::Now { us } => {
                self.show_copy(end, Duration::from_micros(us));
                Ok(())
            }
            message => {
                let before = self.viewpoint();
                self.feed(CrewEvent::Said(message)).await;
                // After a broken connection, this console may have another name.
                end.is_shown &= self.viewpoint() == before;
                Ok(())
            }
        };
        if let Err(fault) = taken {
            self.feed(Event::Failed(fault)).await;
        }
    }

    /// Who looks at whose flight, at a member that the host has let in.
    fn viewpoint(&self) -> Option<CrewViewpoint> {
        let place = self.app.state().crew().member();
        place.and_then(|it| it.viewpoint().cloned())
    }

    /// Plays the copy of the host's record, which is complete up to a time.
    fn show_copy(&mut self, end: &mut MemberEnd, complete_to: Duration) {
        if let Some(frames) = end.showable() {
            let Some(viewpoint) = self.viewpoint() else {
                return;
            };
            match Replay::follow(&frames, &viewpoint) {
                Ok((replay, events)) => {
                    self.end_session();
                    self.replaying = Some(replay);
                    end.is_shown = true;
                    for event in events {
                        self.post(event);
                    }
                }
                // More of the files may be needed.
                Err(fault) => tracing::debug!("the host's record: {fault}"),
            }
        }
        if let Some(replaying) = self.replaying.as_mut().filter(|_| end.is_shown) {
            replaying.complete(complete_to);
        }
    }
}
