//! The list of rooms. A new room is a line here, a module of its own in `app::room`, and one in `ui::screen`.

use crate::language::{Listed, Named};
use crate::text::Text;

/// Hands the list of rooms to a macro. Each line gives the room's name in the program, its module in `app::room` and
/// `ui::screen`, its name in keymap files and on the command line, the key that leads there from anywhere, and what it
/// remembers. The messages `room-NAME` and `action-NAME` are its title and what it is for.
macro_rules! for_each_room {
    ($then:ident) => {
        $then! {
            Home, home, "home", 'H', home::Home;
            /// The swarm in flight.
            Fly, fly, "fly", 'F', fly::Fly;
            /// Everything about one vehicle.
            Vehicle, vehicle, "vehicle", 'V', vehicle::Vehicle;
            Map, map, "map", 'M', map::Map;
            /// Every command so far.
            Ledger, ledger, "commands", 'C', ledger::Ledger;
            /// Every message that comes in.
            Messages, messages, "messages", 'I', messages::Messages;
            /// The links, and what is wrong with them.
            Links, links, "links", 'L', links::Links;
            /// The processes that simulate the vehicles.
            Hangar, hangar, "hangar", 'G', hangar::Hangar;
            Parameters, parameters, "parameters", 'P', parameters::Parameters;
            /// The mission's brief, objectives and rules.
            Mission, mission, "mission", 'B', mission::Mission;
            /// What the last flight was worth.
            Debrief, debrief, "debrief", 'D', Option<debrief::Debrief>;
            /// What is made of a recorded flight.
            Review, review, "review", 'A', review::Review;
            /// How far the trainee has come.
            Standing, standing, "standing", 'T', standing::Standing;
            /// Where drones are built.
            Workshop, workshop, "workshop", 'W', workshop::Workshop;
        }
    };
}
pub(crate) use for_each_room;

macro_rules! declare_rooms {
    ($($(#[$about:meta])* $Room:ident, $module:ident, $name:literal, $key:literal, $Model:ty;)+) => {
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Room {
            $($(#[$about])* $Room,)+
        }

        impl Room {
            /// Every room, in the order of the help.
            pub const ALL: [Self; [$($key),+].len()] = [$(Self::$Room),+];

            /// The key that leads there from anywhere, unless a keymap file says otherwise.
            pub const fn key(self) -> char {
                match self {
                    $(Self::$Room => $key,)+
                }
            }

            /// Its name in keymap files and on the command line.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$Room => $name,)+
                }
            }
        }
    };
}

for_each_room!(declare_rooms);

impl Default for Room {
    fn default() -> Self {
        Self::Home
    }
}

impl Room {
    /// Whether vehicles are selected and commanded by keys there.
    pub const fn shows_vehicles(self) -> bool {
        matches!(self, Self::Fly | Self::Vehicle | Self::Map)
    }

    /// The room of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|room| room.name() == name)
    }

    /// Every room, as a word of a line.
    pub fn listed() -> Listed {
        let named = |room: Self| Named {
            name: room.name().to_owned(),
            meaning: room.explained(),
        };
        Listed::Names(Self::ALL.map(named).into())
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
