//! The ground below drafts, from files of a folder.

use std::collections::BTreeSet;

use super::{Drawing, change};
use crate::app::State;
use crate::app::effect::{Effect, FileEffect};
use crate::draft::{Draft, squares};
use crate::geo::{LatLon, Square, Terrain};
use crate::plan::check::USUAL_CLEARANCE_M;
use crate::text;
use crate::vehicle::Severity;

/// The known ground, and the folder it is read from.
#[derive(Debug, Clone, Default)]
pub(super) struct GroundFiles {
    /// The folder of the files; `None` if the ground counts as level.
    folder: Option<String>,
    terrain: Terrain,
    asked: BTreeSet<Square>,
    /// Whether the user must be shown the next answer.
    is_announced: bool,
}

impl Drawing {
    /// The ground, as far as it is known.
    pub fn ground(&self) -> &Terrain {
        &self.ground.terrain
    }
}

/// Reads the ground heights from a folder from now on; with `None`, the ground counts as level.
pub(super) fn choose(state: &mut State, folder: Option<String>) {
    let is_announced = folder.is_some();
    state.rooms.plans.ground = GroundFiles {
        folder,
        is_announced,
        ..GroundFiles::default()
    };
    if !is_announced {
        state.say(Severity::Notice, text!("draft-ground-level"));
    }
}

/// Requests the ground in the squares below the drafts, except those already requested; `None` if
/// none are missing, or if the ground counts as level.
pub fn wanted_ground(state: &mut State) -> Option<Effect> {
    let folder = state.rooms.plans.ground.folder.clone()?;
    let home = change::home(state).map(|home| Square::of(LatLon::from_e7(home.x, home.y)));
    let room = &mut state.rooms.plans;
    let drafts = room.drafts.all().iter().map(Draft::document);
    let below = drafts.flat_map(|document| squares(document)).chain(home);
    let new: BTreeSet<Square> = below.filter(|it| !room.ground.asked.contains(it)).collect();
    if new.is_empty() {
        return None;
    }
    room.ground.asked.extend(&new);
    let squares = new.into_iter().collect();
    Some(Effect::File(FileEffect::Ground { folder, squares }))
}

/// Handles the answer to [`wanted_ground`]: the ground of the squares that have files.
pub fn ground_read(state: &mut State, folder: &str, terrain: Terrain) {
    let own = &mut state.rooms.plans.ground;
    if own.folder.as_deref() != Some(folder) {
        return;
    }
    let found = !terrain.is_empty();
    own.terrain.join(terrain);
    if std::mem::take(&mut own.is_announced) {
        let (severity, text) = if found {
            let text = text!(
                "draft-ground-read",
                path = folder,
                clearance = USUAL_CLEARANCE_M as i64
            );
            (Severity::Info, text)
        } else {
            (Severity::Warning, text!("draft-ground-none", path = folder))
        };
        state.say(severity, text);
    }
}
