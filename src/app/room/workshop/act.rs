//! The keys of the workshop.

use crossterm::event::KeyCode;

use super::footer::{BENCH_HINTS, COMPARISON_HINTS, FLEET_HINTS, SHELF_HINTS};
use super::{
    Page, Pane, View, WIDE, Workshop, air, files, fleet, licence, part_under_cursor, shelf,
};
use crate::app::State;
use crate::app::action::{Action, Step, WorkshopAction};
use crate::app::keymap::{ENTER, ESCAPE, KeyHint, KeyRow, Press, does, key};
use crate::app::room::home::{self, HomeItem};
use crate::app::room::{Answer, Room, RoomModel, RoomRequest};
use crate::campaign::STARTER_PARTS;
use crate::text;
use crate::vehicle::Severity;
use crate::workshop::Design;

impl RoomModel for Workshop {
    const KEYS: &'static [KeyRow] = &[
        does(ENTER, Action::Submit),
        does(ESCAPE, Action::Escape),
        does(
            Press::Plain(KeyCode::Tab),
            Action::Workshop(WorkshopAction::OtherPane),
        ),
        does(
            Press::Plain(KeyCode::Right),
            Action::Workshop(WorkshopAction::OtherPane),
        ),
        does(
            Press::Plain(KeyCode::Left),
            Action::Workshop(WorkshopAction::OtherPane),
        ),
        does(key('x'), Action::Workshop(WorkshopAction::TakeOut)),
        does(
            Press::Plain(KeyCode::Delete),
            Action::Workshop(WorkshopAction::TakeOut),
        ),
        does(key('b'), Action::Workshop(WorkshopAction::BuyPart)),
        does(key('u'), Action::Workshop(WorkshopAction::Undo)),
        does(Press::Control('r'), Action::Workshop(WorkshopAction::Redo)),
        does(key('n'), Action::Workshop(WorkshopAction::NewDesign)),
        does(key('s'), Action::Workshop(WorkshopAction::SaveDesign)),
        does(key('o'), Action::Workshop(WorkshopAction::Designs)),
        does(key('d'), Action::Workshop(WorkshopAction::CompareDesign)),
        does(key('y'), Action::Workshop(WorkshopAction::CopyDesign)),
        does(key('r'), Action::Workshop(WorkshopAction::RenameDesign)),
        does(key('e'), Action::Workshop(WorkshopAction::ExportDesign)),
        does(key('i'), Action::Workshop(WorkshopAction::ImportDesign)),
        does(key('v'), Action::Workshop(WorkshopAction::NextView)),
        does(key('['), Action::Workshop(WorkshopAction::MissionBefore)),
        does(key(']'), Action::Workshop(WorkshopAction::MissionAfter)),
        does(key('f'), Action::Workshop(WorkshopAction::Seats)),
        does(key('*'), Action::Workshop(WorkshopAction::AllSeats)),
        does(key('g'), Action::Workshop(WorkshopAction::FlyFleet)),
    ];

    fn hints(state: &State) -> &'static [KeyHint] {
        match state.rooms.workshop.page {
            Page::Bench => BENCH_HINTS,
            Page::Designs => SHELF_HINTS,
            Page::Compare => COMPARISON_HINTS,
            Page::Fleet => FLEET_HINTS,
        }
    }

    fn step(state: &mut State, step: Step) -> Answer {
        let room = &mut state.rooms.workshop;
        match room.page {
            Page::Bench => match room.pane {
                Pane::Slots => room.bench.move_row(step, air()),
                Pane::Parts => room.bench.move_part(step, air()),
            },
            Page::Designs => shelf::step(state, step),
            Page::Compare => {
                let slots = crate::workshop::PartSlot::ALL.len();
                let most = crate::workshop::Measure::MOST + 2 * slots;
                room.scroll = step.apply(room.scroll, most);
            }
            Page::Fleet => fleet::step(state, step),
        }
        Some(Vec::new())
    }

    fn submit(state: &mut State) -> Answer {
        let room = &mut state.rooms.workshop;
        match room.page {
            Page::Bench => match room.pane {
                Pane::Slots => room.pane = Pane::Parts,
                Pane::Parts => put_in(state),
            },
            Page::Designs => shelf::open_listed(state),
            Page::Compare => {}
            Page::Fleet => fleet::assign_one(state),
        }
        Some(Vec::new())
    }

    fn escape(state: &mut State) -> Answer {
        let room = &mut state.rooms.workshop;
        if room.page == Page::Bench && room.pane == Pane::Parts {
            room.pane = Pane::Slots;
            return Some(Vec::new());
        }
        Some(escape(state))
    }

    fn entered(state: &mut State) {
        if state.rooms.workshop.bench.is_untouched() {
            let own = state
                .training
                .career
                .as_ref()
                .and_then(|it| it.designs.first());
            let is_simple = |design: &&Design| {
                let mut parts = design.pieces();
                parts.all(|(part, _)| STARTER_PARTS.contains(&part.id))
            };
            let first = own.or_else(|| state.training.stock.iter().find(is_simple));
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

pub(in crate::app::room) fn act(state: &mut State, action: WorkshopAction) -> Vec<RoomRequest> {
    let page = state.rooms.workshop.page;
    let is_bench = page == Page::Bench;
    match action {
        WorkshopAction::Designs => turn(state, Page::Designs),
        WorkshopAction::Seats => turn(state, Page::Fleet),
        WorkshopAction::NewDesign => shelf::begin(state),
        WorkshopAction::SaveDesign => files::ask_save(state),
        WorkshopAction::ExportDesign => files::ask_export(state),
        WorkshopAction::ImportDesign => files::ask_import(state),
        WorkshopAction::CompareDesign => shelf::compare_or_choose(state),
        WorkshopAction::MissionBefore => other_mission(state, Step::Up),
        WorkshopAction::MissionAfter => other_mission(state, Step::Down),
        WorkshopAction::FlyFleet => return fleet::fly(state),
        WorkshopAction::TakeOut => match page {
            Page::Bench => take_out(state),
            Page::Designs => shelf::ask_take_out(state),
            Page::Fleet => fleet::give_back(state),
            Page::Compare => {}
        },
        WorkshopAction::CopyDesign if is_bench => files::ask_copy(state, None),
        WorkshopAction::RenameDesign if is_bench => files::ask_rename(state, None),
        WorkshopAction::CopyDesign if page == Page::Designs => files::ask_copy_listed(state),
        WorkshopAction::RenameDesign if page == Page::Designs => files::ask_rename_listed(state),
        WorkshopAction::AllSeats if page == Page::Fleet => fleet::assign_all(state),
        WorkshopAction::OtherPane if is_bench => state.rooms.workshop.turn_pane(),
        WorkshopAction::BuyPart if is_bench => licence::buy(state),
        WorkshopAction::Undo if is_bench => undo(state),
        WorkshopAction::Redo if is_bench => redo(state),
        WorkshopAction::NextView if is_bench => next_view(state),
        // Actions of other pages.
        WorkshopAction::OtherPane
        | WorkshopAction::BuyPart
        | WorkshopAction::Undo
        | WorkshopAction::Redo
        | WorkshopAction::CopyDesign
        | WorkshopAction::RenameDesign
        | WorkshopAction::NextView
        | WorkshopAction::AllSeats => {}
    }
    Vec::new()
}

fn undo(state: &mut State) {
    if !state.rooms.workshop.bench.undo(air()) {
        state.say(Severity::Notice, text!("bench-nothing-to-undo"));
    }
}

fn redo(state: &mut State) {
    if !state.rooms.workshop.bench.redo(air()) {
        state.say(Severity::Notice, text!("bench-nothing-to-redo"));
    }
}

/// Shows a page, or the bench again.
fn turn(state: &mut State, page: Page) {
    let room = &mut state.rooms.workshop;
    room.page = if room.page == page { Page::Bench } else { page };
}

fn put_in(state: &mut State) {
    let room = &mut state.rooms.workshop;
    let misfit = room.bench.candidate().and_then(|it| it.misfit.clone());
    let slot = room.bench.slot();
    let was_empty = room.bench.design().in_slot(slot).is_empty();
    if !room.bench.put_in(air()) {
        return state.say(Severity::Warning, text!("bench-no-more"));
    }
    // A slot for a single part is complete once filled, and so is a required one that was empty; others may take more.
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
        state.say(Severity::Warning, text!("bench-not-on-board"));
    }
}

/// Shows the next view; on a wide screen, the figures and the mission are always visible.
fn next_view(state: &mut State) {
    let room = &mut state.rooms.workshop;
    room.view = if state.display.size.0 < WIDE {
        room.view.next()
    } else if room.view == View::Payload {
        View::Polar
    } else {
        View::Payload
    };
}

/// Builds for the previous or the next mission.
fn other_mission(state: &mut State, step: Step) {
    if state.session.activity.is_some() && !state.session.is_over() {
        return state.say(Severity::Warning, text!("bench-mission-flown"));
    }
    let items = home::items(state);
    let is_mission = |item: &&HomeItem| matches!(item, HomeItem::Mission(_));
    let missions = items.iter().filter(is_mission).count();
    let cursor = state.rooms.home.cursor;
    // From any other entry, the list of missions is entered at its near end.
    state.rooms.home.cursor = match step {
        _ if cursor < missions => step.apply(cursor, missions),
        Step::Down => 0,
        _ => missions.saturating_sub(1),
    };
    state.rooms.mission.scroll = 0;
    // Narrow screens do not show the mission.
    if let Some(mission) = home::under_cursor(state) {
        let text = text!("bench-mission-is", mission = mission.title.clone());
        state.say(Severity::Info, text);
    }
}

/// Returns to the bench, or from there to the flight; without a session, to the home screen.
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
