//! The list of rooms. A new room needs a line here, and a module with its `pub mod` line in `app::room` and in
//! `ui::screen`.

use strum::EnumIter;

use crate::language::{Listed, Named};
use crate::text::Text;

/// Passes the list of rooms to a macro. Each line gives the room's variant of `Room`, its module in
/// `app::room` and `ui::screen`, its name in keymap files and on the command line, its default key, what it is about,
/// and the type of its state. The messages `room-NAME` and `action-NAME` are its title and its
/// purpose.
macro_rules! for_each_room {
    ($then:ident) => {
        $then! {
            Home, home, "home", 'H', Apart, home::Home;
            /// The swarm in flight.
            Fly, fly, "fly", 'F', Vehicles, fly::Fly;
            /// One vehicle in detail.
            Vehicle, vehicle, "vehicle", 'V', Vehicles, vehicle::Vehicle;
            Map, map, "map", 'M', Vehicles, map::Map;
            /// The drafts of plans, fences and rally points.
            Plans, plans, "plans", 'E', Flight, plans::Drawing;
            Ledger, ledger, "commands", 'C', Flight, ledger::Ledger;
            /// All messages on the links.
            Messages, messages, "messages", 'I', Flight, messages::Messages;
            /// The links and their faults.
            Links, links, "links", 'L', Flight, links::Links;
            /// The processes that simulate the vehicles.
            Hangar, hangar, "hangar", 'G', Flight, hangar::Hangar;
            /// The files of the vehicles.
            Files, files, "files", 'X', Flight, files::Files;
            Parameters, parameters, "parameters", 'P', Flight, parameters::Parameters;
            /// The mission's brief, objectives and rules.
            Mission, mission, "mission", 'B', Flight, mission::Mission;
            /// The result of the last flight.
            Debrief, debrief, "debrief", 'D', Apart, debrief::Debriefs;
            /// The review of a recorded flight.
            Review, review, "review", 'A', Flight, review::Review;
            Standing, standing, "standing", 'T', Apart, standing::Standing;
            /// The workshop for designs.
            /// The seats of a class, at the instructor's desk.
            Class, class, "class", 'K', Apart, class::ClassRoom;
            Workshop, workshop, "workshop", 'W', Apart, workshop::Workshop;
        }
    };
}
pub(crate) use for_each_room;

/// What a room is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum RoomScope {
    /// The vehicles in flight, which keys select and command there.
    Vehicles,
    /// The present flight: its plans, orders, links, files and mission.
    Flight,
    /// What comes before and after flights.
    Apart,
}

macro_rules! declare_rooms {
    ($($(#[$about:meta])* $Room:ident, $module:ident, $name:literal, $key:literal, $Scope:ident, $Model:ty;)+) => {
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, EnumIter)]
        pub enum Room {
            $($(#[$about])* $Room,)+
        }

        impl Room {
            /// Every room, in the order of the help.
            pub const ALL: [Self; [$($key),+].len()] = [$(Self::$Room),+];

            /// The default key that opens the room.
            pub const fn key(self) -> char {
                match self {
                    $(Self::$Room => $key,)+
                }
            }

            /// The room's name in keymap files and on the command line.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$Room => $name,)+
                }
            }

            const fn scope(self) -> RoomScope {
                match self {
                    $(Self::$Room => RoomScope::$Scope,)+
                }
            }
        }
    };
}

for_each_room!(declare_rooms);

impl From<Room> for &'static str {
    fn from(room: Room) -> Self {
        room.name()
    }
}

impl Default for Room {
    fn default() -> Self {
        Self::Home
    }
}

impl Room {
    /// Whether keys select and command vehicles in this room.
    pub const fn shows_vehicles(self) -> bool {
        matches!(self.scope(), RoomScope::Vehicles)
    }

    /// Whether the room is used apart from a flight: in a replay, its keys are shown above the timeline.
    pub const fn is_apart_from_flight(self) -> bool {
        matches!(self.scope(), RoomScope::Apart)
    }

    /// The room with a name, if there is one.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|room| room.name() == name)
    }

    /// Every room, as a completion.
    pub fn listed() -> Listed {
        let named = |room: Self| Named {
            name: room.name().to_owned(),
            meaning: room.explained(),
        };
        Listed::Names(Self::ALL.map(named).into())
    }

    pub fn explained(self) -> Text {
        Text::new(format!("action-{}", self.name()), Vec::new())
    }

    /// The room's title in the header.
    pub fn title(self) -> Text {
        Text::new(format!("room-{}", self.name()), Vec::new())
    }
}
