//! The list of rooms. A new room needs a line here, and a module with its `pub mod` line in `app::room` and in
//! `ui::screen`.

use strum::EnumIter;

use crate::language::{Listed, Named};
use crate::text::Text;

/// Passes the list of rooms to a macro. Each line gives the room's variant of `Room`, its module in
/// `app::room` and `ui::screen`, its name in keymap files and on the command line, its default key,
/// and the type of its state. The messages `room-NAME` and `action-NAME` are its title and its
/// purpose.
macro_rules! for_each_room {
    ($then:ident) => {
        $then! {
            Home, home, "home", 'H', home::Home;
            /// The swarm in flight.
            Fly, fly, "fly", 'F', fly::Fly;
            /// One vehicle in detail.
            Vehicle, vehicle, "vehicle", 'V', vehicle::Vehicle;
            Map, map, "map", 'M', map::Map;
            /// The drafts of plans, fences and rally points.
            Plans, plans, "plans", 'E', plans::Drawing;
            Ledger, ledger, "commands", 'C', ledger::Ledger;
            /// All messages on the links.
            Messages, messages, "messages", 'I', messages::Messages;
            /// The links and their faults.
            Links, links, "links", 'L', links::Links;
            /// The processes that simulate the vehicles.
            Hangar, hangar, "hangar", 'G', hangar::Hangar;
            /// The files of the vehicles.
            Files, files, "files", 'X', files::Files;
            Parameters, parameters, "parameters", 'P', parameters::Parameters;
            /// The mission's brief, objectives and rules.
            Mission, mission, "mission", 'B', mission::Mission;
            /// The result of the last flight.
            Debrief, debrief, "debrief", 'D', debrief::Debriefs;
            /// The review of a recorded flight.
            Review, review, "review", 'A', review::Review;
            Standing, standing, "standing", 'T', standing::Standing;
            /// The workshop for designs.
            Workshop, workshop, "workshop", 'W', workshop::Workshop;
        }
    };
}
pub(crate) use for_each_room;

macro_rules! declare_rooms {
    ($($(#[$about:meta])* $Room:ident, $module:ident, $name:literal, $key:literal, $Model:ty;)+) => {
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
        matches!(self, Self::Fly | Self::Vehicle | Self::Map)
    }

    /// Whether the room is used apart from a flight: in a replay, its keys are shown above the timeline.
    pub const fn is_apart_from_flight(self) -> bool {
        match self {
            Self::Home | Self::Debrief | Self::Standing | Self::Workshop => true,
            Self::Fly
            | Self::Vehicle
            | Self::Map
            | Self::Plans
            | Self::Ledger
            | Self::Messages
            | Self::Links
            | Self::Hangar
            | Self::Parameters
            | Self::Files
            | Self::Mission
            | Self::Review => false,
        }
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
