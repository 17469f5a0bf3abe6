//! The mission of a session.

use super::{Heights, MissionListing};
use crate::mission::{Area, Progress};

/// The mission that is being flown, and its progress.
#[derive(Debug, Clone, Default)]
pub struct FlownMission {
    /// The mission, if there is one.
    pub(in crate::app) listing: Option<Box<MissionListing>>,
    /// The mission's progress, once it is known.
    pub(in crate::app) progress: Option<Progress>,
    /// Whether the mission is over and its debrief is ready.
    pub(in crate::app) over: bool,
    /// The mission's areas that are known from the start.
    pub(in crate::app) areas: Vec<Area>,
    /// The greatest height of any vehicle by mission time, in metres above home.
    pub(in crate::app) heights: Heights,
}
