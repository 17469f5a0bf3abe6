//! The plans that are being drawn: several drafts at a time, their items, and a map with a cursor.
//!
//! Keys and lines produce the same [`Edit`](crate::draft::Edit)s, so both are undone in the same way.
//!
//! # How the parts fit
//! - Changing a draft: `act` (keys), `line` (lines), `change` (what both have in common), `divide` (one task, a draft
//!   for each vehicle).
//! - Whether it can be flown: `judge` finds faults by the limits of the vehicle, `trial` flies the drafts together in
//!   simulation, `figures` shows how that went, `ground` reads the height of the ground.
//! - Where drafts are: `files` reads, writes and uploads them, `keeping` saves unsaved ones for the next console.
//! - What the screen shows: `view`, the next step in `stage`, the keys in `hints`.

use std::sync::Arc;

use crossterm::event::KeyCode;

use self::ground::GroundFiles;
use self::keeping::KeptContent;
use super::map::Map;
use crate::app::State;
use crate::app::action::{Action, DrawAction, PlansAction, Step};
use crate::app::keymap::{ENTER, ESCAPE, KeyHint, KeyRow, Press, does, key};
use crate::app::room::{Answer, RoomModel};
use crate::draft::{Draft, Drafts, Items, Tried};
use crate::ledger::EntryId;
use crate::plan::{Document, Item, ListKind};
use crate::swarm::DividedWork;

mod act;
mod change;
mod divide;
mod figures;
mod files;
mod ground;
mod hints;
mod judge;
mod keeping;
mod line;
mod stage;
mod trial;
mod view;

pub(super) use act::{act, draw};
pub use figures::{FIGURES_WITH_END, FigureRow};
pub use files::{ask_close, close, fill, is_elsewhere, is_kept, read, uploads, written};
pub use ground::{ground_read, wanted_ground};
pub use hints::of_items as room_hints;
pub use judge::{findings, pace};
pub use keeping::{keep, restore};
pub use line::{carry_out, meant};
pub use stage::{NextStep, PlanStage, next_step};
pub use trial::tried;
pub use view::{PlansLayout, click, layout};

/// The state of the room.
#[derive(Debug, Clone)]
pub struct Drawing {
    drafts: Drafts,
    /// The list whose items the keys change.
    list: ListKind,
    /// The item under the cursor, from 0; if the list is shorter, its last item counts.
    row: usize,
    /// The index of the item where marking began; `None` if only the item under the cursor is
    /// marked.
    mark: Option<usize>,
    map: Map,
    /// The speed from which flight times are computed, in m/s; `None` for the vehicle's own.
    speed_m_s: Option<f64>,
    /// The content that is being written, with the path and the draft's name.
    saving: Option<(String, String, Arc<Document>)>,
    uploads: Vec<EntryId>,
    ground: GroundFiles,
    /// The vehicles among which work was last divided.
    divided: DividedWork,
    /// The outcome of the last trial, until a draft changes.
    tried: Option<Tried>,
    /// The first visible line of the trial's figures, while they are shown in place of the items.
    figures_top: Option<usize>,
    /// The unsaved drafts that are stored in the data folder.
    written: KeptContent,
}

impl Default for Drawing {
    fn default() -> Self {
        Self {
            drafts: Drafts::default(),
            list: ListKind::Plan,
            row: 0,
            mark: None,
            map: Map::default(),
            speed_m_s: None,
            saving: None,
            uploads: Vec::new(),
            ground: GroundFiles::default(),
            divided: DividedWork::default(),
            tried: None,
            figures_top: None,
            written: KeptContent::new(),
        }
    }
}

impl Drawing {
    pub fn drafts(&self) -> &Drafts {
        &self.drafts
    }

    /// The list whose items the keys change.
    pub fn list(&self) -> ListKind {
        self.list
    }

    /// The view of the map and its cursor.
    pub fn map(&self) -> &Map {
        &self.map
    }

    /// The items of the list.
    pub fn items(&self) -> &[Item] {
        let document = self.drafts.current().map(Draft::document);
        document.map_or(&[], |document| document.list(self.list))
    }

    /// The item under the cursor, from 0; `None` in an empty list.
    pub fn row(&self) -> Option<usize> {
        self.items()
            .len()
            .checked_sub(1)
            .map(|last| self.row.min(last))
    }

    /// The marked items, otherwise the one under the cursor.
    pub fn marked(&self) -> Option<Items> {
        let row = self.row()?;
        let mark = self
            .mark
            .map_or(row, |mark| mark.min(self.items().len() - 1));
        Some(Items {
            first: row.min(mark) + 1,
            last: row.max(mark) + 1,
        })
    }

    /// Whether several items are being marked.
    pub fn is_marking(&self) -> bool {
        self.mark.is_some()
    }

    /// The ledger's entries of the last upload, one for each list.
    pub fn uploads(&self) -> &[EntryId] {
        &self.uploads
    }

    /// Stores the ledger entries of an upload.
    pub(in crate::app) fn note_uploads(&mut self, entries: Vec<EntryId>) {
        self.uploads = entries;
    }

    /// The outcome of the last trial of the drafts as they are.
    pub fn tried(&self) -> Option<&Tried> {
        self.tried.as_ref()
    }

    /// The speed that the user has set for flight times, in m/s; `None` for the vehicle's own.
    pub fn speed_m_s(&self) -> Option<f64> {
        self.speed_m_s
    }
}

const fn own(action: PlansAction) -> Action {
    Action::Plans(action)
}

const fn drawing(action: DrawAction) -> Action {
    Action::Draw(action)
}

impl RoomModel for Drawing {
    const KEYS: &'static [KeyRow] = &[
        does(Press::Plain(KeyCode::Left), Action::Move(Step::Left)),
        does(Press::Plain(KeyCode::Right), Action::Move(Step::Right)),
        does(key('j'), own(PlansAction::NextItem)),
        does(key('k'), own(PlansAction::PreviousItem)),
        does(ENTER, Action::Submit),
        does(ESCAPE, Action::Escape),
        does(key('a'), drawing(DrawAction::AddItem)),
        does(key('i'), drawing(DrawAction::InsertItem)),
        does(key('m'), drawing(DrawAction::MoveItem)),
        does(key('x'), drawing(DrawAction::DeleteItem)),
        does(
            Press::Plain(KeyCode::Delete),
            drawing(DrawAction::DeleteItem),
        ),
        does(key('s'), drawing(DrawAction::SplitLeg)),
        does(key(' '), own(PlansAction::MarkItems)),
        does(key('+'), drawing(DrawAction::Higher)),
        does(key('='), drawing(DrawAction::Higher)),
        does(key('-'), drawing(DrawAction::Lower)),
        does(key('h'), own(PlansAction::WriteHeight)),
        does(key('f'), drawing(DrawAction::NextFrame)),
        does(key('e'), own(PlansAction::SetField)),
        does(key('c'), own(PlansAction::WriteCommand)),
        does(key('g'), own(PlansAction::WriteJump)),
        does(key('t'), drawing(DrawAction::AddTakeoff)),
        does(key('l'), drawing(DrawAction::AddLand)),
        does(key('r'), drawing(DrawAction::AddReturn)),
        does(key('1'), own(PlansAction::PlanList)),
        does(key('2'), own(PlansAction::FenceList)),
        does(key('3'), own(PlansAction::RallyList)),
        does(key('b'), drawing(DrawAction::BeginPolygon)),
        does(key('v'), drawing(DrawAction::AddCircle)),
        does(key('u'), own(PlansAction::UndoEdit)),
        does(Press::Control('r'), own(PlansAction::RedoEdit)),
        does(Press::Plain(KeyCode::Tab), own(PlansAction::NextDraft)),
        does(
            Press::Plain(KeyCode::BackTab),
            own(PlansAction::PreviousDraft),
        ),
        does(key('n'), own(PlansAction::NewDraft)),
        does(key('o'), own(PlansAction::OpenDraft)),
        does(key('y'), own(PlansAction::TakePlan)),
        does(key('w'), own(PlansAction::SaveDraft)),
        does(key('U'), own(PlansAction::UploadDraft)),
        does(key('d'), own(PlansAction::ShowFigures)),
        does(key('S'), own(PlansAction::SurveyDraft)),
        does(key('R'), own(PlansAction::TryDrafts)),
        does(key(']'), own(PlansAction::CloserDraft)),
        does(key('['), own(PlansAction::WiderDraft)),
        does(key('z'), own(PlansAction::FitDrafts)),
        does(key('.'), own(PlansAction::CentreDraft)),
    ];

    fn hints(state: &State) -> &'static [KeyHint] {
        hints::of_drafts(state)
    }

    fn step(state: &mut State, step: Step) -> Answer {
        act::step(state, step);
        Some(Vec::new())
    }

    fn submit(state: &mut State) -> Answer {
        Some(act::draw(state, DrawAction::AddItem))
    }

    fn escape(state: &mut State) -> Answer {
        let room = &mut state.rooms.plans;
        let is_closed = room.figures().is_some() && room.turn_figures();
        (is_closed || room.mark.take().is_some()).then(Vec::new)
    }

    fn entered(state: &mut State) {
        if state.rooms.plans.map.overview().frame().is_none() {
            view::fit(state);
        }
    }

    /// Forgets the uploads only: drafts belong to the user, not to a session.
    fn forget_session(&mut self) {
        self.uploads.clear();
    }
}

#[cfg(test)]
mod tests;
