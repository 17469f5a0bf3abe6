//! The console's part in a crew: the host, or a member.

use std::collections::BTreeMap;
use std::time::Duration;

use super::{Activity, State};
use crate::crew::protocol::{CrewDenial, RosterLine};
use crate::crew::{Crew, CrewViewpoint, Role, SILENT};
use crate::mission::Stake;
use crate::text;
use crate::text::Text;

/// What a console is in a crew.
#[derive(Debug, Clone, Default)]
pub enum CrewPart {
    /// Nothing: the console flies alone.
    #[default]
    None,
    /// The console that flies the session.
    Host(Box<Crew>),
    /// The console of a member, which follows the host's flight.
    Member(Box<MemberPlace>),
}

/// A member's place in a crew.
#[derive(Debug, Clone, Default)]
pub struct MemberPlace {
    /// The name of the crew, as the user wrote it.
    pub(in crate::app) crew: String,
    /// Who looks at whose flight; `None` until the host has let the member in.
    pub(in crate::app) viewpoint: Option<CrewViewpoint>,
    pub(in crate::app) role: Role,
    pub(in crate::app) roster: Vec<RosterLine>,
    /// The lines that the host has not answered yet, by number.
    pub(in crate::app) asked: BTreeMap<u32, AskedLine>,
    /// By how much the host's wall clock is ahead of this console's, in ms: the largest difference so far, because a word of
    /// the host that took its time makes it smaller. `None` until the host has told it.
    pub(in crate::app) ahead_ms: Option<i64>,
    pub(in crate::app) next: u32,
    /// When the host last said something, by the wall clock; it says something every 2 s.
    pub(in crate::app) heard_at: Duration,
    /// Whether there is a connection.
    pub(in crate::app) is_connected: bool,
    /// Whether the host has said that it ends the crew.
    pub(in crate::app) is_ended: bool,
    /// Why the host did not let this member in again; told once.
    pub(in crate::app) denied: Option<CrewDenial>,
}

/// A line that the host has not answered yet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AskedLine {
    /// What its answer is shown with.
    pub(in crate::app) line: String,
    /// When it was given, by the wall clock.
    pub(in crate::app) at: Duration,
    /// Whether the user was told that it waits.
    pub(in crate::app) is_told: bool,
}

/// The connection of a member to its host.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CrewLink {
    /// The host has not let the member in yet.
    Awaited,
    Up,
    /// The host has said nothing for this time, which is too long.
    Silent(Duration),
    /// It has broken, and is tried again.
    Lost,
    /// The host has ended the crew.
    Ended,
}

impl MemberPlace {
    /// A place in a crew that is not joined yet.
    pub fn new(crew: impl Into<String>) -> Self {
        Self {
            crew: crew.into(),
            ..Self::default()
        }
    }

    /// Who looks at whose flight; `None` until the host has let the member in.
    pub fn viewpoint(&self) -> Option<&CrewViewpoint> {
        self.viewpoint.as_ref()
    }

    /// The name of the crew, as the user wrote it.
    pub fn crew(&self) -> &str {
        &self.crew
    }

    pub fn role(&self) -> Role {
        self.role
    }

    /// Takes in the host's wall clock, in ms.
    pub(in crate::app) fn hear_clock(&mut self, ms: u64, wall: Duration) {
        let ahead = signed(ms).saturating_sub(signed_ms(wall));
        self.ahead_ms = self.ahead_ms.max(Some(ahead));
    }

    /// The present time by the host's wall clock, in ms, if it is known.
    pub(in crate::app) fn host_ms(&self, wall: Duration) -> Option<u64> {
        let ms = signed_ms(wall).saturating_add(self.ahead_ms?);
        u64::try_from(ms).ok()
    }

    /// What the member waits for while no flight is shown.
    pub fn awaited(&self) -> Text {
        match &self.viewpoint {
            Some(viewpoint) => text!("crew-waiting-flight", host = viewpoint.host.name()),
            None => text!("crew-waiting", crew = self.crew.as_str()),
        }
    }

    /// For how long the host has said nothing, if that is too long: it has been stopped, or is busy.
    fn host_silent_for(&self, wall: Duration) -> Option<Duration> {
        let silent = wall.saturating_sub(self.heard_at);
        (self.is_connected && silent >= SILENT).then_some(silent)
    }

    /// What the header says about the connection.
    pub fn link(&self, wall: Duration) -> CrewLink {
        match (self.is_connected, &self.viewpoint) {
            _ if self.is_ended => CrewLink::Ended,
            (false, None) => CrewLink::Awaited,
            (false, Some(_)) => CrewLink::Lost,
            (true, _) => match self.host_silent_for(wall) {
                Some(silent) => CrewLink::Silent(silent),
                None => CrewLink::Up,
            },
        }
    }

    /// Whether there is a connection to the host.
    pub fn is_connected(&self) -> bool {
        self.is_connected
    }
}

fn signed_ms(time: Duration) -> i64 {
    i64::try_from(time.as_millis()).unwrap_or(i64::MAX)
}

fn signed(ms: u64) -> i64 {
    i64::try_from(ms).unwrap_or(i64::MAX)
}

impl CrewPart {
    /// The crew, at its host.
    pub fn host(&self) -> Option<&Crew> {
        match self {
            Self::Host(crew) => Some(crew),
            Self::None | Self::Member(_) => None,
        }
    }

    pub(in crate::app) fn host_mut(&mut self) -> Option<&mut Crew> {
        match self {
            Self::Host(crew) => Some(crew),
            Self::None | Self::Member(_) => None,
        }
    }

    /// The place in a crew, at a member.
    pub fn member(&self) -> Option<&MemberPlace> {
        match self {
            Self::Member(place) => Some(place),
            Self::None | Self::Host(_) => None,
        }
    }

    pub(in crate::app) fn member_mut(&mut self) -> Option<&mut MemberPlace> {
        match self {
            Self::Member(place) => Some(place),
            Self::None | Self::Host(_) => None,
        }
    }
}

impl<R> State<R> {
    /// The console's part in a crew.
    pub fn crew(&self) -> &CrewPart {
        &self.crew
    }

    /// Whether an exam is flown, which everybody flies alone.
    pub fn is_exam(&self) -> bool {
        matches!(
            self.session.activity,
            Some(Activity::Mission {
                stake: Stake::Exam,
                ..
            })
        )
    }

    /// Whether this console follows a flight that the host of a crew is flying.
    pub fn is_following(&self) -> bool {
        self.replay.as_ref().is_some_and(|view| view.is_live)
    }

    /// Whether this console shows a flight of the past.
    pub fn shows_past(&self) -> bool {
        self.replay.as_ref().is_some_and(|view| !view.is_live)
    }
}
