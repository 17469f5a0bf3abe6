//! A console in a crew: the host, or a member.
//!
//! The host's record is the only source of what members see: `tail` sends it to each of them at the member's own pace, so
//! a slow member costs nobody anything, and one who joins late gets the flight from its beginning. A member's console
//! keeps a copy, and replays it while it grows.
//!
//! # How the parts fit
//! - `host_end` are the connections to members, `tail` sends the record; `member_end` is the connection to the host.
//!   `sign` says there that this console lives. `faults` says why there is no connection.

use std::path::PathBuf;

use super::{Console, ConsoleOptions};
use crate::app::effect::CrewEffect;
use crate::app::state::{CrewPart, MemberPlace};
use crate::carrier::{DeskArrival, HostPlace, SeatArrival, own_user_name};
use crate::crew::protocol::{HostMessage, MemberMessage};
use crate::crew::{Crew, Role};
use crate::pilot_in_command::Person;
use crate::record::Happening;
use crate::text;
use crate::text::Text;
use host_end::HostEnd;
use member_end::MemberEnd;

mod faults;
mod host_end;
mod member_end;
mod sign;
mod tail;
#[cfg(test)]
mod tests;

/// The console's part in a crew.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum CrewOptions {
    /// It flies the session, and lets others join.
    Host {
        place: HostPlace,
        /// The name of the crew.
        name: String,
    },
    /// It joins the crew of somebody else.
    Member {
        place: HostPlace,
        /// The name of the crew.
        name: String,
        /// The role that the user wants; `None` for that of a free post.
        role: Option<Role>,
        /// The folder for copies of records.
        data: PathBuf,
    },
}

impl CrewOptions {
    /// The console's part before anything has happened.
    pub(super) fn part(&self) -> CrewPart {
        match self {
            Self::Host { name, .. } => {
                let host = Person::named(own_user_name());
                CrewPart::Host(Box::new(Crew::new(name, host)))
            }
            Self::Member { name, .. } => CrewPart::Member(Box::new(MemberPlace::new(name))),
        }
    }

    /// Whether it is the host.
    pub fn is_host(&self) -> bool {
        matches!(self, Self::Host { .. })
    }
}

/// The console's connections in a crew.
pub(super) enum CrewEnd {
    None,
    Host(HostEnd),
    Member(Box<MemberEnd>),
}

/// What arrives from the other side.
pub(super) enum CrewArrival {
    AtHost(DeskArrival<MemberMessage>),
    AtMember(SeatArrival<HostMessage>),
}

impl CrewEnd {
    /// Opens the crew, or begins to look for one.
    ///
    /// # Errors
    /// Its socket cannot be opened, or flights are not recorded.
    pub fn open(options: &ConsoleOptions) -> Result<Self, Text> {
        match &options.crew {
            None => Ok(Self::None),
            Some(CrewOptions::Host { place, .. }) => {
                let preferences = &options.preferences;
                if preferences.records.is_none() || preferences.runs.is_none() {
                    return Err(text!("crew-unrecorded"));
                }
                let opened = place.open();
                let port = opened.map_err(|fault| faults::not_opened(&fault))?;
                Ok(Self::Host(HostEnd::new(port)))
            }
            Some(CrewOptions::Member {
                place, role, data, ..
            }) => {
                let end = MemberEnd::new(place.join(), *role, data.clone());
                Ok(Self::Member(Box::new(end)))
            }
        }
    }

    /// Waits for the next arrival; without a crew, it waits forever.
    pub async fn next(&mut self) -> CrewArrival {
        let arrival = match self {
            Self::None => None,
            Self::Host(end) => end.port.next().await.map(CrewArrival::AtHost),
            Self::Member(end) => end.port.next().await.map(CrewArrival::AtMember),
        };
        match arrival {
            Some(arrival) => arrival,
            None => std::future::pending().await,
        }
    }

    /// Ends the connections, so that the other side knows at once.
    pub async fn close(self) {
        match self {
            Self::None => {}
            Self::Host(end) => end.close().await,
            Self::Member(end) => end.close().await,
        }
    }
}

impl Console {
    /// Takes in what has arrived from the other side of a crew.
    pub(super) async fn attend_crew(&mut self, end: &mut CrewEnd, arrival: CrewArrival) {
        match (end, arrival) {
            (CrewEnd::Host(end), CrewArrival::AtHost(arrival)) => {
                self.attend_member(end, arrival).await;
            }
            (CrewEnd::Member(end), CrewArrival::AtMember(arrival)) => {
                self.attend_host(end, arrival).await;
            }
            _ => {}
        }
    }

    /// Tells the other side of a crew what is waiting.
    pub(super) fn tell_crew(&mut self, end: &mut CrewEnd) {
        let work = std::mem::take(&mut self.crew_work);
        match end {
            CrewEnd::None => {}
            CrewEnd::Host(end) => {
                end.carry_out(work);
                end.show(self.record_point(), self.record_before.clone());
            }
            CrewEnd::Member(end) => end.carry_out(work),
        }
    }

    /// Does something for the crew.
    pub(super) fn serve_crew(&mut self, effect: CrewEffect) {
        match effect {
            CrewEffect::Note(record) => {
                if let Some(running) = &self.running {
                    running.note_down(self.clock.now(), Happening::Crew(record));
                }
            }
            CrewEffect::GiveUp(why) => (self.crew_refusal, self.over) = (Some(why), true),
            effect => self.crew_work.push(effect),
        }
    }

    /// Requires that the crew could be joined, at a member.
    ///
    /// # Errors
    /// It could not; the text is in the reader's language.
    pub(super) fn require_joined(&self) -> anyhow::Result<()> {
        match &self.crew_refusal {
            Some(why) => Err(anyhow::anyhow!(self.sight.look.text(why))),
            None => Ok(()),
        }
    }
}
