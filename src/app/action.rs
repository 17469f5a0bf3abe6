//! The user's intents, independent of their keys.

use strum::{EnumIter, IntoEnumIterator as _, IntoStaticStr};

use super::room_list::Room;

mod of_rooms;
mod shared;
mod step;

pub use of_rooms::{
    ClassAction, DebriefAction, DrawAction, FilesAction, HangarAction, LedgerAction, MapAction,
    MessagesAction, ParametersAction, PlansAction, WorkshopAction,
};
pub use shared::{LineAction, ReplayAction, SelectAction, StartAction, ViewAction};
pub use step::Step;

/// Declares [`Action`], and the order and the names of its groups.
macro_rules! actions {
    (
        first { $($(#[$first_about:meta])* $first:ident($First:ty),)+ }
        single { $($(#[$about:meta])* $single:ident,)+ }
        groups { $($(#[$group_about:meta])* $group:ident($Group:ty),)+ }
    ) => {
        /// An intent, to which the keymap maps keys. Its name in keymap files is that of the
        /// innermost variant; the message `action-NAME` describes it. Actions that only some rooms
        /// have are in enums of their own.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, EnumIter, IntoStaticStr)]
        #[strum(serialize_all = "kebab-case")]
        pub enum Action {
            $($(#[$first_about])* #[strum(disabled)] $first($First),)+
            $($(#[$about])* $single,)+
            $($(#[$group_about])* #[strum(disabled)] $group($Group),)+
        }

        impl Action {
            /// Every action: the rooms, the cursor steps, the general ones, and those of some rooms.
            pub fn all() -> impl Iterator<Item = Self> {
                let mut all = Vec::new();
                $(all.extend(<$First>::iter().map(Self::$first));)+
                all.extend(Self::iter());
                $(all.extend(<$Group>::iter().map(Self::$group));)+
                all.into_iter()
            }

            /// The action's name in keymap files.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$first(action) => action.into(),)+
                    $(Self::$single)|+ => self.into(),
                    $(Self::$group(action) => action.into(),)+
                }
            }
        }
    };
}

actions! {
    first {
        /// Go to a room; the action has the room's name.
        Show(Room),
        /// Move the cursor or scroll; its name is that of the step.
        Move(Step),
    }
    single {
        /// Open the command line.
        CommandLine,
        /// Open or close the help.
        Help,
        /// Show the past notices.
        #[strum(serialize = "look-back-notices")]
        Notices,
        /// Show the mission's brief again.
        Brief,
        /// Submit the typed text, or choose the item under the cursor.
        Submit,
        /// Cancel: the typed text, the selection, the overlay.
        Escape,
        /// Fly the same mission again with a new seed.
        Again,
        /// Fly the same mission again with the same seed.
        AgainAlike,
        Profiles,
        /// Change the level of automatic advice.
        Aids,
        /// Pause or resume the mission.
        PauseMission,
        /// Speed up simulated time.
        Faster,
        /// Return simulated time to real time.
        UsualPace,
        /// End the mission now.
        Abandon,
        /// Return to the home screen.
        Leave,
        Acknowledge,
        /// Take the sticks of the vehicle under the cursor.
        TakeSticks,
        Quit,
    }
    groups {
        /// List order, filter and vehicle, for the rooms that have them.
        View(ViewAction),
        /// Select vehicles, or mark parameters in a comparison.
        Select(SelectAction),
        /// Completions and history of the line being typed.
        Line(LineAction),
        /// Other ways to fly the listed mission.
        Start(StartAction),
        /// Actions that control the replay, in every room.
        Replay(ReplayAction),
        /// Actions of the Debrief room.
        Debrief(DebriefAction),
        /// Actions of the Map room.
        Map(MapAction),
        /// Actions of the Ledger room.
        Ledger(LedgerAction),
        /// Actions of the Parameters room.
        Parameters(ParametersAction),
        /// Actions of the Files room.
        Files(FilesAction),
        /// Actions of the Plans room about drafts, lists and the view.
        Plans(PlansAction),
        /// Changes of the draft in the Plans room.
        Draw(DrawAction),
        /// Actions of the Messages room.
        Messages(MessagesAction),
        /// Actions of the Hangar room.
        Hangar(HangarAction),
        /// Actions of the Class room.
        Class(ClassAction),
        /// Actions of the Workshop room.
        Workshop(WorkshopAction),
    }
}

impl Action {
    /// The cursor keys, in the order of hints.
    pub const UP_AND_DOWN: &[Self] = &[Self::Move(Step::Down), Self::Move(Step::Up)];

    /// The action with a name, if there is one.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|action| action.name() == name)
    }
}
