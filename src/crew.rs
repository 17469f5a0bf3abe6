//! A crew: several people on one swarm.
//!
//! The host's console flies the session; members watch a live copy of its record and ask it to carry out their commands.
//! A [`Crew`] is the host's list of members with their roles, and of the proposals to hand vehicles over. Who flies a
//! vehicle is in [`PilotsInCommand`] alone: every change here goes there.
//!
//! [`protocol`] has the lines between host and members.

use std::collections::BTreeMap;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::class::ConnectionId;
use crate::pilot_in_command::{Person, PilotsInCommand};
use crate::vehicle_id::VehicleId;
use crate::verb::{CountsAs, CrewDuty, Verb};

use protocol::CrewDenial;

mod change;
mod fault;
mod handover;
pub mod protocol;

#[cfg(test)]
mod tests;

pub use change::{CrewChange, CrewRecord, CrewViewpoint, Departure, Flown};
pub use fault::CrewFault;
pub use handover::{CrewDeed, CrewScene, DeedOutcome, Proposal, ProposalChoice};

/// The maximum number of members.
pub const MOST_MEMBERS: usize = 16;
/// The maximum number of members of one user, the host's own too: nobody takes all places.
pub const MOST_OF_ONE_USER: usize = 4;
/// How long a post of the mission is kept for a user whose connection has ended.
const KEPT: Duration = Duration::from_secs(60);
/// The time without a line of the other side, which says something every 2 s, after which it is silent: a member counts as
/// gone.
pub const SILENT: Duration = Duration::from_secs(10);
/// The maximum age of a member's line that is still carried out.
const FRESH: Duration = Duration::from_secs(5);
/// The longest time between two looks at the clock while the host's console runs. After a longer one, it has been stopped,
/// as by Ctrl-Z, or was busy: it could hear nobody meanwhile.
const STALLED: Duration = Duration::from_secs(2);

/// What a member does in a crew.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// Flies the vehicles that are the member's own.
    #[default]
    Pilot,
    /// Reports, and operates the payloads of every vehicle.
    Sensors,
    /// May make every vehicle safe.
    Safety,
    /// Only looks on, and gives no commands.
    Observer,
}

impl Role {
    /// All roles, in the order in which they are listed.
    pub const ALL: [Self; 4] = [Self::Pilot, Self::Sensors, Self::Safety, Self::Observer];

    /// The name in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pilot => "pilot",
            Self::Sensors => "sensors",
            Self::Safety => "safety",
            Self::Observer => "observer",
        }
    }

    /// The role with a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|role| role.name() == name)
    }

    /// The names of the roles that a mission may provide: anybody may look on.
    pub fn in_missions() -> Vec<&'static str> {
        let roles = Self::ALL.into_iter().filter(|it| *it != Self::Observer);
        roles.map(Self::name).collect()
    }

    /// The role with a name, if a mission may provide it.
    pub fn in_mission(name: &str) -> Option<Self> {
        Self::named(name).filter(|it| *it != Self::Observer)
    }

    /// The duty with which the role reaches every vehicle, whoever flies it.
    fn duty(self) -> Option<CrewDuty> {
        match self {
            Self::Sensors => Some(CrewDuty::Sensors),
            Self::Safety => Some(CrewDuty::Safety),
            Self::Pilot | Self::Observer => None,
        }
    }

    /// Whether members with the role may give orders with a verb at all; for which vehicles is another question.
    pub fn may_say(self, verb: &Verb) -> bool {
        match (self, verb.counts_as) {
            (Self::Observer, _) => false,
            // The answers for the whole flight are those of the host: a prediction, a goal.
            (Self::Pilot, CountsAs::Pledge | CountsAs::SelfReport | CountsAs::Word) => {
                verb.duty == CrewDuty::Sensors
            }
            (Self::Pilot, _) => true,
            (Self::Sensors | Self::Safety, _) => self.duty() == Some(verb.duty),
        }
    }
}

/// A place in the crew that the mission provides.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Post {
    pub role: Role,
    /// The vehicles that its holder flies from the beginning.
    pub vehicles: Vec<VehicleId>,
}

/// Somebody on the crew besides the host.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Member {
    pub person: Person,
    /// The user at the other end, from the system.
    user: String,
    pub role: Role,
    /// The number of the mission's post that the member holds.
    post: Option<usize>,
    /// Whether the member asked for the role; otherwise it is that of a free post.
    is_role_wanted: bool,
    /// When the member last said something, by the wall clock.
    heard_at: Duration,
}

/// The members of a crew, at the host.
#[derive(Debug, Clone)]
pub struct Crew {
    name: String,
    host: Person,
    posts: Vec<Post>,
    members: BTreeMap<ConnectionId, Member>,
    /// The posts of members whose connections have ended, oldest first.
    kept: Vec<KeptPost>,
    /// Proposals that wait for an answer, oldest first.
    proposals: Vec<Proposal>,
    /// The last look at the wall clock.
    seen_at: Option<Duration>,
    /// The second of the wall clock that members were told last.
    told_second: Option<u64>,
}

impl Crew {
    /// A crew of the host alone.
    pub fn new(name: impl Into<String>, host: Person) -> Self {
        Self {
            name: name.into(),
            host,
            posts: Vec::new(),
            members: BTreeMap::new(),
            kept: Vec::new(),
            proposals: Vec::new(),
            seen_at: None,
            told_second: None,
        }
    }

    /// The name of the crew.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The user of the host's console.
    pub fn host(&self) -> &Person {
        &self.host
    }

    /// The members, by the order in which they joined.
    pub fn members(&self) -> impl Iterator<Item = &Member> {
        self.members.values()
    }

    /// The member at the other end of a connection.
    pub fn member(&self, connection: ConnectionId) -> Option<&Member> {
        self.members.get(&connection)
    }

    /// The members with their connections, by the order in which they joined.
    pub fn connections(&self) -> impl Iterator<Item = (ConnectionId, &Member)> {
        self.members
            .iter()
            .map(|(&connection, it)| (connection, it))
    }

    /// The connection to a member.
    pub fn connection(&self, person: &Person) -> Option<ConnectionId> {
        let mut members = self.connections();
        let found = members.find(|(_, member)| member.person == *person);
        found.map(|(connection, _)| connection)
    }

    /// The proposals that wait for an answer, oldest first.
    pub fn proposals(&self) -> &[Proposal] {
        &self.proposals
    }

    /// Takes a user in. The name is the user's, with a number if it is taken.
    ///
    /// # Errors
    /// The crew is full, the user has as many consoles on it as one may have, or the connection has a member already.
    pub fn join(
        &mut self,
        joining: Joining<'_>,
        pilots: &mut PilotsInCommand,
        now: Duration,
    ) -> Result<CrewChange, CrewDenial> {
        if self.members.contains_key(&joining.connection) {
            return Err(CrewDenial::NoHello);
        }
        if self.members.len() >= MOST_MEMBERS {
            return Err(CrewDenial::Full);
        }
        let of_user = self.members().filter(|it| it.user == joining.user).count();
        if of_user >= MOST_OF_ONE_USER {
            return Err(CrewDenial::FullForUser);
        }
        let person = self.free_name(joining.user);
        let member = Member {
            person: person.clone(),
            user: joining.user.to_owned(),
            role: joining.role.unwrap_or_default(),
            post: None,
            is_role_wanted: joining.role.is_some(),
            heard_at: now,
        };
        self.members.insert(joining.connection, member);
        self.assign(joining.connection, pilots, now);
        let role = self.members[&joining.connection].role;
        let vehicles = pilots.flown_by(&person);
        Ok(CrewChange::Joined {
            who: person,
            role,
            vehicles,
        })
    }

    /// The first name for a user that nobody here has: `anna`, `anna#2`. No user name of the system has a `#`, so a user who
    /// joins later cannot have the name of a console of somebody else.
    fn free_name(&self, user: &str) -> Person {
        let names = std::iter::once(user.to_owned());
        let mut names = names.chain((2..).map(|number| format!("{user}#{number}")));
        let is_free = |name: &String| {
            self.host.name() != name && self.members().all(|it| it.person.name() != name)
        };
        Person::named(names.find(is_free).unwrap_or_default())
    }

    /// Gives a member the vehicles and the duty of a post of the mission: of the one that the member holds, otherwise of a
    /// free one that suits.
    fn assign(&mut self, connection: ConnectionId, pilots: &mut PilotsInCommand, now: Duration) {
        let found = self.members.get(&connection);
        let number = found.and_then(|it| it.post.or_else(|| self.free_post(it, now)));
        let Some(member) = self.members.get_mut(&connection) else {
            return;
        };
        if let Some((number, post)) = number.and_then(|it| Some((it, self.posts.get(it)?))) {
            self.kept.retain(|it| it.post != number);
            (member.post, member.role) = (Some(number), post.role);
            // What somebody has got by a hand-over meanwhile stays there.
            let is_of_host = |vehicle: &VehicleId| pilots.of(*vehicle).is_none();
            let vehicles: Vec<_> = post.vehicles.iter().copied().filter(is_of_host).collect();
            pilots.take_over(&vehicles, &member.person);
        }
        if let Some(duty) = member.role.duty() {
            pilots.put_on_duty(&member.person, duty);
        }
    }

    /// The number of a free post that suits a member: the one that is kept for the user, or the first of those that are
    /// kept for nobody. Who asks for a role also gets what is kept for somebody else, if nothing else is free.
    fn free_post(&self, member: &Member, now: Duration) -> Option<usize> {
        let wanted = member.is_role_wanted.then_some(member.role);
        let taken: Vec<usize> = self.members().filter_map(|it| it.post).collect();
        let suits = |(number, post): &(usize, &Post)| {
            !taken.contains(number) && wanted.is_none_or(|role| role == post.role)
        };
        let free = self.posts.iter().enumerate().filter(suits);
        let free: Vec<usize> = free.map(|(number, _)| number).collect();
        let kept_for = |number: usize| {
            let mut kept = self.kept.iter().filter(|it| now < it.until);
            kept.find(|it| it.post == number).map(|it| it.user.as_str())
        };
        let of = |user: Option<&str>| free.iter().copied().find(|&it| kept_for(it) == user);
        let others = || wanted.and_then(|_| free.first().copied());
        of(Some(&member.user)).or_else(|| of(None)).or_else(others)
    }

    /// A member is gone: the vehicles are the host's again. A post of the mission is kept for the user for a while.
    pub fn leave(
        &mut self,
        connection: ConnectionId,
        why: Departure,
        pilots: &mut PilotsInCommand,
        now: Duration,
    ) -> Option<CrewChange> {
        let member = self.members.remove(&connection)?;
        if let Some(post) = member.post {
            let (user, until) = (member.user, now + KEPT);
            self.kept.push(KeptPost { post, user, until });
        }
        let who = member.person;
        let vehicles = pilots.flown_by(&who);
        pilots.hand_back(&vehicles, &who);
        pilots.relieve(&who);
        self.proposals
            .retain(|it| it.giver != who && it.taker != who);
        Some(CrewChange::Left { who, vehicles, why })
    }

    /// Looks at the clock. While the host's console was stopped, it heard nobody: that time counts neither as silence nor
    /// as time to answer a proposal.
    pub fn look(&mut self, now: Duration) {
        let seen = self.seen_at.replace(now).unwrap_or(now);
        let unseen = now.saturating_sub(seen);
        if unseen <= STALLED {
            return;
        }
        for member in self.members.values_mut() {
            member.heard_at += unseen;
        }
        self.postpone(unseen);
    }

    /// The wall clock in ms for the members, once a second while there are any.
    pub fn clock_to_tell(&mut self, now: Duration) -> Option<u64> {
        let second = Some(now.as_secs()).filter(|_| !self.members.is_empty());
        if std::mem::replace(&mut self.told_second, second) == second {
            return None;
        }
        second.map(|_| milliseconds(now))
    }

    /// For how long a line of a member has waited for the host, if that is too long to carry it out: what it was meant for
    /// may be over. `None` if it is fresh, or if it is not known when it was given.
    pub fn waited_too_long(given_ms: Option<u64>, now: Duration) -> Option<Duration> {
        let waited = now.saturating_sub(Duration::from_millis(given_ms?));
        (waited > FRESH).then_some(waited)
    }

    /// Notes that a member has said something.
    pub fn hear(&mut self, connection: ConnectionId, now: Duration) {
        if let Some(member) = self.members.get_mut(&connection) {
            member.heard_at = now;
        }
    }

    /// The members that have said nothing for too long.
    pub fn silent(&self, now: Duration) -> Vec<ConnectionId> {
        let members = self.members.iter();
        let silent = members.filter(|(_, it)| now >= it.heard_at + SILENT);
        silent.map(|(&connection, _)| connection).collect()
    }

    /// A session begins, with these posts: its vehicles are the host's, except for those of members that have a post.
    pub fn begin(&mut self, posts: Vec<Post>, pilots: &mut PilotsInCommand, now: Duration) {
        *pilots = PilotsInCommand::of_user(self.host.clone());
        let is_same = self.posts == posts;
        self.kept.retain(|it| is_same && now < it.until);
        self.posts = posts;
        self.proposals.clear();
        for member in self.members.values_mut() {
            // In the same mission again, everybody keeps the post.
            member.post.take_if(|_| !is_same);
            // The role of a post ends with its mission.
            if !member.is_role_wanted && member.post.is_none() {
                member.role = Role::default();
            }
        }
        let connections: Vec<_> = self.members.keys().copied().collect();
        for connection in connections {
            self.assign(connection, pilots, now);
        }
    }
}

fn milliseconds(time: Duration) -> u64 {
    u64::try_from(time.as_millis()).unwrap_or(u64::MAX)
}

/// A post of the mission that is kept for a user whose connection has ended.
#[derive(Debug, Clone, PartialEq, Eq)]
struct KeptPost {
    /// The number of the post.
    post: usize,
    user: String,
    /// Until when, by the wall clock.
    until: Duration,
}

/// Who asks to join.
#[derive(Debug, Clone, Copy)]
pub struct Joining<'a> {
    pub connection: ConnectionId,
    /// The user at the other end, from the system.
    pub user: &'a str,
    /// The role that the user wants; `None` for that of a free post.
    pub role: Option<Role>,
}
