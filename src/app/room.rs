//! The rooms of the console: what each remembers, which keys it has, and what its actions do.

use super::action::Action;
use super::effect::Effect;
use super::keymap::Row;
use super::state::{Purpose, State};
use super::update::profiles;
use crate::text::Text;

pub mod debrief;
pub mod fly;
pub mod hangar;
pub mod home;
pub mod ledger;
pub mod links;
pub mod map;
pub mod messages;
pub mod mission;
pub mod parameters;
pub mod standing;
pub mod vehicle;
pub mod workshop;

/// A room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum Room {
    /// Where to begin.
    #[default]
    Home,
    /// The swarm in flight.
    Fly,
    /// Everything about one vehicle.
    Vehicle,
    /// Where everything is.
    Map,
    /// Every command so far.
    Ledger,
    /// Every message that comes in.
    Messages,
    /// The links, and what is wrong with them.
    Links,
    /// The processes that simulate the vehicles.
    Hangar,
    /// The vehicles' parameters.
    Parameters,
    /// The mission's brief, objectives and rules.
    Mission,
    /// What the flight was worth.
    Debrief,
    /// How far the trainee has come.
    Standing,
    /// Where drones are built.
    Workshop,
}

impl Room {
    /// Every room, in the order of the help.
    pub const ALL: [Self; 13] = [
        Self::Home,
        Self::Fly,
        Self::Vehicle,
        Self::Map,
        Self::Ledger,
        Self::Messages,
        Self::Links,
        Self::Hangar,
        Self::Parameters,
        Self::Mission,
        Self::Debrief,
        Self::Standing,
        Self::Workshop,
    ];

    /// The key that leads there from anywhere.
    pub fn key(self) -> char {
        match self {
            Self::Home => 'H',
            Self::Fly => 'F',
            Self::Vehicle => 'V',
            Self::Map => 'M',
            Self::Ledger => 'C',
            Self::Messages => 'I',
            Self::Links => 'L',
            Self::Hangar => 'G',
            Self::Parameters => 'P',
            Self::Mission => 'B',
            Self::Debrief => 'D',
            Self::Standing => 'T',
            Self::Workshop => 'W',
        }
    }

    /// Its name in keymap files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Home => "home",
            Self::Fly => "fly",
            Self::Vehicle => "vehicle",
            Self::Map => "map",
            Self::Ledger => "commands",
            Self::Messages => "messages",
            Self::Links => "links",
            Self::Hangar => "hangar",
            Self::Parameters => "parameters",
            Self::Mission => "mission",
            Self::Debrief => "debrief",
            Self::Standing => "standing",
            Self::Workshop => "workshop",
        }
    }

    /// Whether vehicles are selected and commanded by keys there.
    pub fn shows_vehicles(self) -> bool {
        matches!(self, Self::Fly | Self::Vehicle | Self::Map)
    }

    /// The room of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|room| room.name() == name)
    }

    /// What it is for.
    pub fn explained(self) -> Text {
        Text::new(format!("action-{}", self.name()), Vec::new())
    }

    /// What the header calls it.
    pub fn title(self) -> Text {
        Text::new(format!("room-{}", self.name()), Vec::new())
    }
}

/// What every room remembers. It survives leaving the room.
#[derive(Debug, Clone, Default)]
pub struct Rooms {
    /// Where to begin.
    pub home: home::Home,
    /// The swarm in flight.
    pub fly: fly::Fly,
    /// Everything about one vehicle.
    pub vehicle: vehicle::Vehicle,
    /// Where everything is.
    pub map: map::Map,
    /// Every command so far.
    pub ledger: ledger::Ledger,
    /// Every message that comes in.
    pub messages: messages::Messages,
    /// The links.
    pub links: links::Links,
    /// The processes that simulate the vehicles.
    pub hangar: hangar::Hangar,
    /// The vehicles' parameters.
    pub parameters: parameters::Parameters,
    /// The mission's brief, objectives and rules.
    pub mission: mission::Mission,
    /// What the last flight was worth.
    pub debrief: Option<debrief::Debrief>,
    /// How far the trainee has come.
    pub standing: standing::Standing,
    /// Where drones are built.
    pub workshop: workshop::Workshop,
}

impl Rooms {
    /// Forgets what belongs to the session that has ended.
    pub fn forget_session(&mut self) {
        *self = Self {
            home: std::mem::take(&mut self.home),
            standing: std::mem::take(&mut self.standing),
            map: self.map.for_next_session(),
            workshop: std::mem::take(&mut self.workshop),
            ..Self::default()
        };
    }
}

/// The keys that a room has of its own.
pub fn keys(room: Room) -> &'static [Row] {
    match room {
        Room::Home => home::KEYS,
        Room::Fly => fly::KEYS,
        Room::Vehicle => vehicle::KEYS,
        Room::Map => map::KEYS,
        Room::Ledger => ledger::KEYS,
        Room::Messages => messages::KEYS,
        Room::Links => links::KEYS,
        Room::Hangar => hangar::KEYS,
        Room::Parameters => parameters::KEYS,
        Room::Mission => mission::KEYS,
        Room::Debrief => debrief::KEYS,
        Room::Standing => standing::KEYS,
        Room::Workshop => workshop::KEYS,
    }
}

/// What an action does in the room that is shown; `None` where it means what it means everywhere.
pub fn act(state: &mut State, action: Action) -> Option<Vec<Effect>> {
    match state.room {
        Room::Home => home::act(state, action),
        Room::Fly => fly::act(state, action),
        Room::Vehicle => vehicle::act(state, action),
        Room::Map => map::act(state, action),
        Room::Ledger => ledger::act(state, action),
        Room::Messages => messages::act(state, action),
        Room::Links => links::act(state, action),
        Room::Hangar => hangar::act(state, action),
        Room::Parameters => parameters::act(state, action),
        Room::Mission => mission::act(state, action),
        Room::Debrief => debrief::act(state, action),
        Room::Standing => standing::act(state, action),
        Room::Workshop => workshop::act(state, action),
    }
}

/// Takes what was entered into a prompt.
///
/// # Errors
/// What is wrong with it; the prompt stays open and says so.
pub fn prompted(state: &mut State, purpose: &Purpose, entered: &str) -> Result<Vec<Effect>, Text> {
    match purpose {
        Purpose::Connect => home::connect(state, entered),
        Purpose::NewProfile => profiles::created(state, entered),
        Purpose::Seed(mission) => home::practise(state, mission, entered),
        Purpose::Filter(room) => {
            filter(state, *room, entered);
            Ok(Vec::new())
        }
        Purpose::Parameter { name, vehicles } => {
            parameters::entered(state, name, (vehicles, entered))
        }
        Purpose::SaveParameters => parameters::save(state, entered),
        Purpose::LoadParameters | Purpose::CompareParameters => parameters::load(state, entered),
        Purpose::SaveDesign => workshop::saved_as(state, entered),
        Purpose::CopyDesign(of) => workshop::copied(state, of, entered),
        Purpose::RenameDesign(old) => workshop::renamed(state, old, entered),
        Purpose::ExportDesign => workshop::exported(state, entered),
        Purpose::ImportDesign => workshop::imported(entered),
    }
}

/// Shows only those lines of a room that fit.
fn filter(state: &mut State, room: Room, entered: &str) {
    match room {
        Room::Parameters => entered.clone_into(&mut state.rooms.parameters.filter),
        Room::Messages => messages::filter(state, entered),
        Room::Fly => fly::filter(state, entered),
        Room::Ledger => ledger::filter(state, entered),
        _ => {}
    }
}
