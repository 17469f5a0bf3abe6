//! The workshop: a drone on the bench, the parts that could go into it and what each would change; the designs that
//! there are; two designs side by side; and the seats of a mission's fleet.
//!
//! Everything may be tried on the bench. What a career does not own yet has to be bought before it flies. What lies on
//! the bench stays there when the room is left; what was changed is only replaced after a question, and even then it
//! can be brought back.

use crossterm::event::KeyCode;

use crate::app::State;
use crate::app::action::{Action, Step};
use crate::app::keymap::{ENTER, ESCAPE, KeyHint, KeyRow, Press, does, hint, key};
use crate::app::room::home::{self, HomeItem};
use crate::app::room::{Room, RoomModel, RoomRequest, footer_keys};
use crate::campaign::STARTER_PARTS;
use crate::mission::Listing;
use crate::text;
use crate::vehicle::Severity;
use crate::workshop::{Air, Design, Part, Sheet};

mod bench;
mod files;
mod fit;
mod fleet;
mod licence;
mod shelf;
#[cfg(test)]
mod tests;

pub use bench::{Bench, Candidate, SlotRow, rows};
pub use files::{copied, exported, imported, read, renamed, saved_as};
pub use fit::{Fit, Stand, weigh};
pub use fleet::{Seat, bill, seats};
pub use licence::{Licence, lacking, licence};
pub use shelf::{Stored, heard, is_saved, lay, stored};

/// What the room remembers.
#[derive(Debug, Clone, Default)]
pub struct Workshop {
    /// What lies on the bench.
    pub(in crate::app) bench: Bench,
    pub(in crate::app) page: Page,
    /// Which list of the bench has the cursor.
    pub(in crate::app) pane: Pane,
    /// What is shown beside the lists.
    pub(in crate::app) view: View,
    /// The line under the cursor of the list of designs.
    pub(in crate::app) shelf: usize,
    /// The seat under the cursor.
    pub(in crate::app) seat: usize,
    /// The first line of the comparison.
    pub(in crate::app) scroll: usize,
    /// What the bench is compared with.
    pub(in crate::app) compared: Option<(Design, Sheet)>,
    /// How the bench stands to what the mission needs.
    pub(in crate::app) fit: Option<Fit>,
}

impl Workshop {
    /// What lies on the bench.
    pub fn bench(&self) -> &Bench {
        &self.bench
    }

    pub fn page(&self) -> Page {
        self.page
    }

    /// Which list of the bench has the cursor.
    pub fn pane(&self) -> Pane {
        self.pane
    }

    /// What is shown beside the lists.
    pub fn view(&self) -> View {
        self.view
    }

    /// The line under the cursor of the list of designs.
    pub fn shelf(&self) -> usize {
        self.shelf
    }

    /// The seat under the cursor.
    pub fn seat(&self) -> usize {
        self.seat
    }

    /// The first line of the comparison.
    pub fn scroll(&self) -> usize {
        self.scroll
    }

    /// What the bench is compared with.
    pub fn compared(&self) -> Option<&(Design, Sheet)> {
        self.compared.as_ref()
    }

    /// How the bench stands to what the mission needs.
    pub fn fit(&self) -> Option<&Fit> {
        self.fit.as_ref()
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Page {
    #[default]
    Bench,
    Designs,
    /// Another design beside the one on the bench.
    Compare,
    /// The seats of a mission's fleet.
    Fleet,
}

/// A list of the bench.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Pane {
    /// What is built in.
    #[default]
    Slots,
    Parts,
}

/// What is shown beside the lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum View {
    /// Figures, and what speaks against the design.
    #[default]
    Figures,
    Polar,
    /// Hover time by payload.
    Payload,
    /// What the mission needs, and what the design has.
    Mission,
}

impl View {
    fn next(self) -> Self {
        match self {
            Self::Figures => Self::Polar,
            Self::Polar => Self::Payload,
            Self::Payload => Self::Mission,
            Self::Mission => Self::Figures,
        }
    }
}

/// The air that figures are stated for.
pub fn air() -> Air {
    Air::default()
}

/// The mission that is built for: the one that is flown, else the one under the cursor of the home screen.
pub fn mission(state: &State) -> Option<&Listing> {
    super::mission::shown(state)
}

const BENCH_HINTS: &[KeyHint] = &[
    hint(&[Action::OtherPane], "bench-hint-lists"),
    hint(&[Action::Submit], "bench-hint-put-in"),
    hint(&[Action::TakeOut], "bench-hint-take-out"),
    hint(&[Action::Undo], "bench-hint-undo"),
    hint(&[Action::SaveDesign], "bench-hint-save"),
    hint(&[Action::Designs], "bench-hint-designs"),
    hint(&[Action::NextView], "bench-hint-view"),
    hint(&[Action::Seats], "bench-hint-fleet"),
    footer_keys::HELP,
    hint(&[Action::BuyPart], "bench-hint-buy"),
    hint(&[Action::CompareDesign], "bench-hint-compare"),
    hint(&[Action::NewDesign], "bench-hint-new"),
    hint(
        &[Action::MissionBefore, Action::MissionAfter],
        "bench-hint-mission",
    ),
    hint(
        &[Action::ExportDesign, Action::ImportDesign],
        "bench-hint-files",
    ),
];

const SHELF_HINTS: &[KeyHint] = &[
    hint(&[Action::Submit], "bench-hint-open"),
    hint(&[Action::CompareDesign], "bench-hint-compare"),
    hint(&[Action::CopyDesign], "bench-hint-copy"),
    hint(&[Action::RenameDesign], "bench-hint-rename"),
    hint(&[Action::TakeOut], "bench-hint-delete"),
    footer_keys::BACK,
    footer_keys::HELP,
];

const COMPARISON_HINTS: &[KeyHint] = &[
    footer_keys::SCROLL,
    hint(&[Action::Designs], "bench-hint-other"),
    footer_keys::BACK,
    footer_keys::HELP,
];

const FLEET_HINTS: &[KeyHint] = &[
    hint(&[Action::Submit], "bench-hint-assign"),
    hint(&[Action::AllSeats], "bench-hint-all"),
    hint(&[Action::TakeOut], "bench-hint-lend"),
    hint(&[Action::FlyFleet], "bench-hint-fly"),
    hint(
        &[Action::MissionBefore, Action::MissionAfter],
        "bench-hint-mission",
    ),
    footer_keys::BACK,
    footer_keys::HELP,
];

impl RoomModel for Workshop {
    const KEYS: &'static [KeyRow] = &[
        does(ENTER, Action::Submit),
        does(ESCAPE, Action::Escape),
        does(Press::Plain(KeyCode::Tab), Action::OtherPane),
        does(Press::Plain(KeyCode::Right), Action::OtherPane),
        does(Press::Plain(KeyCode::Left), Action::OtherPane),
        does(key('x'), Action::TakeOut),
        does(Press::Plain(KeyCode::Delete), Action::TakeOut),
        does(key('b'), Action::BuyPart),
        does(key('u'), Action::Undo),
        does(Press::Control('r'), Action::Redo),
        does(key('n'), Action::NewDesign),
        does(key('s'), Action::SaveDesign),
        does(key('o'), Action::Designs),
        does(key('d'), Action::CompareDesign),
        does(key('y'), Action::CopyDesign),
        does(key('r'), Action::RenameDesign),
        does(key('e'), Action::ExportDesign),
        does(key('i'), Action::ImportDesign),
        does(key('v'), Action::NextView),
        does(key('['), Action::MissionBefore),
        does(key(']'), Action::MissionAfter),
        does(key('f'), Action::Seats),
        does(key('*'), Action::AllSeats),
        does(key('g'), Action::FlyFleet),
    ];

    fn hints(state: &State) -> &'static [KeyHint] {
        match state.rooms.workshop.page {
            Page::Bench => BENCH_HINTS,
            Page::Designs => SHELF_HINTS,
            Page::Compare => COMPARISON_HINTS,
            Page::Fleet => FLEET_HINTS,
        }
    }

    fn act(state: &mut State, action: Action) -> Option<Vec<RoomRequest>> {
        let page = state.rooms.workshop.page;
        let own = match page {
            Page::Bench => on_bench(state, action),
            Page::Designs => shelf::act(state, action),
            Page::Compare => on_comparison(state, action),
            Page::Fleet => fleet::act(state, action),
        };
        own.or_else(|| anywhere(state, action))
    }

    fn entered(state: &mut State) {
        if state.rooms.workshop.bench.is_untouched() {
            let own = state.career.as_ref().and_then(|it| it.designs.first());
            let is_simple = |design: &&Design| {
                let mut parts = design.pieces();
                parts.all(|(part, _)| STARTER_PARTS.contains(&part.id))
            };
            let first = own.or_else(|| state.stock.iter().find(is_simple));
            if let Some(design) = first.cloned() {
                let origin = own.map(|own| own.name.clone());
                state.rooms.workshop.bench.open(design, origin, air());
                return;
            }
        }
        state.rooms.workshop.bench.renew(air());
    }

    fn forget_session(&mut self) {}
}

/// What actions do on every page that gives them no meaning of its own.
fn anywhere(state: &mut State, action: Action) -> Option<Vec<RoomRequest>> {
    match action {
        Action::Designs => turn(state, Page::Designs),
        Action::Seats => turn(state, Page::Fleet),
        Action::NewDesign => shelf::begin(state),
        Action::SaveDesign => files::ask_save(state),
        Action::ExportDesign => files::ask_export(state),
        Action::ImportDesign => files::ask_import(state),
        Action::CompareDesign => shelf::compare_or_choose(state),
        Action::MissionBefore => other_mission(state, Step::Up),
        Action::MissionAfter => other_mission(state, Step::Down),
        Action::FlyFleet => return Some(fleet::fly(state)),
        Action::Escape => return Some(escape(state)),
        // What another page knows.
        Action::OtherPane
        | Action::TakeOut
        | Action::BuyPart
        | Action::Undo
        | Action::Redo
        | Action::CopyDesign
        | Action::RenameDesign
        | Action::NextView
        | Action::AllSeats => {}
        _ => return None,
    }
    Some(Vec::new())
}

/// Shows a page, or the bench again.
fn turn(state: &mut State, page: Page) {
    let room = &mut state.rooms.workshop;
    room.page = if room.page == page { Page::Bench } else { page };
}

fn on_bench(state: &mut State, action: Action) -> Option<Vec<RoomRequest>> {
    let room = &mut state.rooms.workshop;
    match (action, room.pane) {
        (Action::Move(step), Pane::Slots) => room.bench.move_row(step, air()),
        (Action::Move(step), Pane::Parts) => room.bench.move_part(step),
        (Action::Submit | Action::OtherPane, Pane::Slots) => room.pane = Pane::Parts,
        (Action::OtherPane | Action::Escape, Pane::Parts) => room.pane = Pane::Slots,
        (Action::Submit, Pane::Parts) => put_in(state),
        (Action::TakeOut, _) => take_out(state),
        (Action::BuyPart, _) => licence::buy(state),
        (Action::Undo, _) if room.bench.undo(air()) => {}
        (Action::Redo, _) if room.bench.redo(air()) => {}
        (Action::Undo, _) => state.say(Severity::Notice, text!("bench-nothing-to-undo")),
        (Action::Redo, _) => state.say(Severity::Notice, text!("bench-nothing-to-redo")),
        (Action::NextView, _) => next_view(state),
        (Action::CopyDesign, _) => files::ask_copy(state, None),
        (Action::RenameDesign, _) => files::ask_rename(state, None),
        _ => return None,
    }
    Some(Vec::new())
}

fn on_comparison(state: &mut State, action: Action) -> Option<Vec<RoomRequest>> {
    let Action::Move(step) = action else {
        return None;
    };
    let room = &mut state.rooms.workshop;
    let most = crate::workshop::Measure::ALL.len() + 2 * crate::workshop::PartSlot::ALL.len();
    room.scroll = step.apply(room.scroll, most);
    Some(Vec::new())
}

/// The part that a deed of the bench is about: the one under the cursor.
fn part_under_cursor(state: &State) -> Option<&'static Part> {
    let room = &state.rooms.workshop;
    match room.pane {
        Pane::Slots => room.bench.rows().get(room.bench.row())?.part,
        Pane::Parts => room.bench.candidate().map(|candidate| candidate.part),
    }
}

fn put_in(state: &mut State) {
    let room = &mut state.rooms.workshop;
    let misfit = room.bench.candidate().and_then(|it| it.misfit.clone());
    let slot = room.bench.slot();
    let was_empty = room.bench.design().in_slot(slot).is_empty();
    if !room.bench.put_in(air()) {
        return state.say(Severity::Notice, text!("bench-no-more"));
    }
    // What was missing is settled, and a slot with room for one; of others, more may be wanted.
    if slot.room() == 1 || (was_empty && slot.is_required()) {
        room.pane = Pane::Slots;
        if was_empty {
            room.bench.move_to_empty(air());
        }
    }
    if let Some(reason) = misfit {
        state.say(Severity::Warning, reason);
    }
}

fn take_out(state: &mut State) {
    let part = part_under_cursor(state);
    let is_out = part.is_some_and(|part| state.rooms.workshop.bench.take_out(part, air()));
    if !is_out {
        state.say(Severity::Notice, text!("bench-not-on-board"));
    }
}

/// Goes on to the next view; on a wide screen figures and mission are always there.
fn next_view(state: &mut State) {
    let room = &mut state.rooms.workshop;
    room.view = if state.size.0 < WIDE {
        room.view.next()
    } else if room.view == View::Payload {
        View::Polar
    } else {
        View::Payload
    };
}

/// From this width on everything is shown at a time.
pub const WIDE: u16 = 150;

/// Builds for the mission before or after.
fn other_mission(state: &mut State, step: Step) {
    if state.session.activity.is_some() {
        return state.say(Severity::Notice, text!("bench-mission-flown"));
    }
    let items = home::items(state);
    let is_mission = |item: &&HomeItem| matches!(item, HomeItem::Mission(_));
    let missions = items.iter().filter(is_mission).count();
    let at = state.rooms.home.cursor.min(missions.saturating_sub(1));
    state.rooms.home.cursor = step.apply(at, missions);
    state.rooms.mission.scroll = 0;
}

/// Back to the bench; from there to where the room was entered from.
fn escape(state: &mut State) -> Vec<RoomRequest> {
    state.hush();
    if state.rooms.workshop.page != Page::Bench {
        state.rooms.workshop.page = Page::Bench;
        return Vec::new();
    }
    let is_flying = state.session.activity.is_some();
    let room = if is_flying { Room::Fly } else { Room::Home };
    vec![RoomRequest::Show(room)]
}
