use std::time::Duration;

use crossterm::event::{KeyCode, KeyEvent};

use super::*;
use crate::app::effect::{Effect, FileEffect, FileKind};
use crate::app::event::{Event, FileEvent, SessionEvent, Started, TerminalEvent, VehicleEvent};
use crate::app::state::{Activity, Overlay};
use crate::app::{App, Setup};
use crate::commands::{Act, Command, PlanDeed, PlanSource};
use crate::geo::LatLon;
use crate::plan::command;
use crate::vehicle::{
    FencePlan, Heartbeat, Mode, Place, Plan, Stored, SystemStatus, Transfer, Vehicle, VehicleClass,
    VehicleId,
};

mod area;
mod faults;
mod files;
mod rehearsals;
mod stage;

const HOME: LatLon = LatLon::new(50.45, 30.52);

struct Desk {
    app: App,
}

impl Desk {
    fn new() -> Self {
        Self::with_rooms(true)
    }

    fn with_rooms(has_rooms: bool) -> Self {
        let mut app = App::new(Setup {
            has_rooms,
            ..Setup::default()
        });
        let _ = app.update(Event::Session(SessionEvent::Started(Box::new(Started {
            activity: Activity::Free,
            mission: None,
            places: [("tower".to_owned(), HOME.moved(50.0, 0.0))].into(),
            areas: Vec::new(),
            processes: None,
            speedup: 1.0,
            is_again: false,
        }))));
        let mut desk = Self { app };
        for id in [1, 2] {
            desk.vehicle(id, |_| {});
        }
        desk.press("E");
        desk
    }

    fn vehicle(&mut self, id: VehicleId, change: impl FnOnce(&mut Vehicle)) {
        let mut vehicle = Vehicle::new(id as u8, 1);
        vehicle.home = Some(Place {
            at_point: HOME,
            altitude_amsl_m: 170.0,
        });
        change(&mut vehicle);
        let _ = self
            .app
            .update(Event::from(VehicleEvent::Telemetry(Arc::new(vehicle))));
    }

    fn key(&mut self, code: KeyCode) -> Vec<Effect> {
        let key = TerminalEvent::Key(KeyEvent::from(code));
        self.app.update(Event::from(key))
    }

    /// Presses letters; `^`, `v`, `<` and `>` stand for the arrow keys.
    fn press(&mut self, keys: &str) {
        for key in keys.chars() {
            let code = match key {
                '^' => KeyCode::Up,
                'V' => KeyCode::Down,
                '<' => KeyCode::Left,
                '>' => KeyCode::Right,
                letter => KeyCode::Char(letter),
            };
            let _ = self.key(code);
        }
    }

    fn give(&mut self, line: &str) -> Vec<Effect> {
        let line = TerminalEvent::Line(line.to_owned());
        self.app.update(Event::from(line))
    }

    fn read(&mut self, path: &str, content: &str) {
        let _ = self.app.update(Event::from(FileEvent::Read {
            kind: FileKind::Plan,
            path: path.to_owned(),
            text: content.to_owned(),
        }));
    }

    fn room(&self) -> &Drawing {
        self.app.state().rooms().plans()
    }

    fn plan(&self) -> Vec<u16> {
        let draft = self.room().drafts().current().expect("a draft");
        draft
            .document()
            .plan
            .iter()
            .map(|item| item.command)
            .collect()
    }

    fn said(&self) -> String {
        let message = self.app.state().message();
        message.map_or_else(String::new, |message| message.text.to_string())
    }

    fn line(&self) -> &str {
        match self.app.state().overlay() {
            Some(Overlay::Palette(palette)) => palette.input().value(),
            _ => "",
        }
    }
}

#[test]
fn a_plan_is_drawn_by_keys_from_nothing() {
    let mut desk = Desk::new();
    desk.press("t^^^a>>>ar");
    assert_eq!(
        desk.plan(),
        [
            command::TAKEOFF,
            command::WAYPOINT,
            command::WAYPOINT,
            command::RETURN_TO_LAUNCH
        ]
    );
    assert_eq!(desk.room().row(), Some(3));
    // Adds an item before the return, and removes the one next to it.
    desk.press("^^ikx");
    assert_eq!(desk.plan().len(), 4);
    desk.press("uuuuuu");
    assert!(desk.plan().is_empty());
    desk.press("u");
    assert!(!desk.said().is_empty(), "nothing to undo");
}

#[test]
fn keys_and_lines_are_undone_alike() {
    let mut desk = Desk::new();
    desk.press("t");
    desk.give("draft add n 100 e 50");
    desk.press("+");
    desk.give("draft height 1-2 40");
    let heights = |desk: &Desk| -> Vec<f32> { desk.room().items().iter().map(|it| it.z).collect() };
    assert_eq!(heights(&desk), [40.0, 40.0]);
    desk.give("draft undo");
    assert_eq!(heights(&desk), [30.0, 35.0]);
    desk.press("u");
    assert_eq!(heights(&desk), [30.0, 30.0]);
    desk.give("draft redo");
    assert_eq!(heights(&desk), [30.0, 35.0]);
}

#[test]
fn a_marked_range_moves_to_the_cursor() {
    let mut desk = Desk::new();
    desk.give("draft add n 0 e 0");
    desk.give("draft add n 20 e 0");
    desk.give("draft add n 20 e 20");
    desk.press("k k");
    let marked = desk.room().marked().expect("items");
    assert_eq!((marked.first, marked.last), (1, 2));
    desk.press(">>>>m");
    let east_m = |at: usize| {
        let (_, east_m) = HOME.offset_to(desk.room().items()[at].point());
        east_m
    };
    assert!(east_m(0) > 1.0 && (east_m(0) - east_m(1)).abs() < 0.1);
    assert!((east_m(2) - 20.0).abs() < 0.1);
    assert!(!desk.room().is_marking());
}

#[test]
fn fences_and_rally_points_have_lists_of_their_own() {
    let mut desk = Desk::new();
    desk.press("2bV>a>^aV");
    desk.press("v+");
    let draft = desk.room().drafts().current().expect("a draft");
    let fence: Vec<u16> = draft.document().fence.iter().map(|it| it.command).collect();
    let corner = command::FENCE_POLYGON_INCLUSION;
    assert_eq!(
        fence,
        [corner, corner, corner, command::FENCE_CIRCLE_INCLUSION]
    );
    assert_eq!(draft.document().fence[3].params[0] as i32, 55);
    desk.press("f3a");
    let draft = desk.room().drafts().current().expect("a draft");
    assert_eq!(
        draft.document().fence[3].command,
        command::FENCE_CIRCLE_EXCLUSION
    );
    assert_eq!(draft.document().rally.len(), 1);
    desk.press("1");
    assert!(desk.room().items().is_empty());
}

#[test]
fn keys_begin_the_lines_that_need_words() {
    let mut desk = Desk::new();
    desk.press("ta");
    for (key, line) in [
        ("e", "draft set 2 "),
        ("c", "draft command 2 "),
        ("h", "draft height 2 "),
        ("g", "draft jump 2 to "),
        ("o", "draft open "),
        ("w", "draft save plan.plan"),
        ("U", "draft upload 1"),
    ] {
        desk.press(key);
        assert_eq!(desk.line(), line);
        let _ = desk.key(KeyCode::Esc);
    }
}

#[test]
fn an_unsaved_draft_is_closed_only_after_a_question() {
    let mut desk = Desk::new();
    desk.press("ta");
    desk.give("draft close");
    assert!(matches!(
        desk.app.state().overlay(),
        Some(Overlay::Confirm(_))
    ));
    desk.press("n");
    assert_eq!(desk.room().drafts().all().len(), 1);
    let _ = desk.key(KeyCode::Esc);
    desk.give("draft close");
    desk.press("y");
    assert!(desk.room().drafts().current().is_none());
}

/// Marks a vehicle's lists as read and empty.
fn read_empty(vehicle: &mut Vehicle) {
    vehicle.plans.plan.transfer = Transfer::Done;
    vehicle.plans.fence.transfer = Transfer::Done;
}

/// Puts a vehicle in AUTO, armed.
fn flies_plan(vehicle: &mut Vehicle) {
    vehicle.heartbeat = Some(Heartbeat {
        mav_type: 2,
        autopilot: 3,
        class: VehicleClass::Copter,
        mode: Mode::copter(3),
        armed: true,
        status: SystemStatus::Active,
        at: Duration::ZERO,
    });
}

#[test]
fn each_list_of_a_draft_is_uploaded_by_an_order() {
    let mut desk = Desk::new();
    desk.vehicle(1, read_empty);
    desk.vehicle(2, read_empty);
    desk.press("ta");
    desk.give("draft fence circle 200 n 0 e 0");
    let effects = desk.give("draft upload 1-2");
    let mut lines = Vec::new();
    for effect in effects {
        let Effect::Order { order, .. } = effect else {
            panic!("{effect:?}");
        };
        let Act::Command(Command::Plan(command)) = &order.act else {
            panic!("{order:?}");
        };
        let PlanDeed::Upload {
            source: PlanSource::Document { document, .. },
        } = &command.deed
        else {
            panic!("{command:?}");
        };
        assert!(!document.list(command.kind).is_empty());
        assert_eq!(order.targets, [1, 2]);
        lines.push(order.line);
    }
    assert_eq!(lines, ["1-2 plan upload plan", "1-2 fence upload plan"]);
}

#[test]
fn a_fence_that_is_on_board_already_is_not_sent_again() {
    let mut desk = Desk::new();
    desk.vehicle(1, read_empty);
    desk.press("ta");
    desk.give("draft fence circle 200 n 0 e 0");
    let fence = desk.room().drafts().current().map(|draft| {
        let document = draft.document();
        document.fence.clone()
    });
    desk.vehicle(2, |vehicle| {
        read_empty(vehicle);
        vehicle.plans.fence.content = fence.map(|items| Arc::new(FencePlan::from_items(items)));
    });
    assert_eq!(desk.give("draft upload 2").len(), 1, "only the plan");
    assert_eq!(desk.give("draft upload 1-2").len(), 2, "1 has no fence yet");
}

#[test]
fn an_upload_to_a_vehicle_that_flies_its_plan_asks_once_for_all_lists() {
    let mut desk = Desk::new();
    desk.vehicle(1, flies_plan);
    desk.press("ta");
    desk.give("draft fence circle 200 n 0 e 0");
    assert!(desk.give("draft upload 1").is_empty());
    let effects = desk.key(KeyCode::Char('1'));
    assert_eq!(effects.len(), 2, "{effects:?}");
}

#[test]
fn plans_on_board_become_drafts_that_go_back_to_their_vehicles() {
    let mut desk = Desk::new();
    let waypoint = |command| Item {
        command,
        frame: 3,
        x: 504_500_000,
        y: 305_200_000,
        z: 20.0,
        ..Item::default()
    };
    for id in [1, 2] {
        desk.vehicle(id, |vehicle| {
            read_empty(vehicle);
            vehicle.plans.plan = Stored {
                content: Some(Arc::new(Plan {
                    items: vec![waypoint(command::WAYPOINT), waypoint(command::TAKEOFF)],
                    home_first: true,
                })),
                transfer: Transfer::Done,
            };
        });
    }
    desk.give("draft take all");
    let names: Vec<&str> = desk.room().drafts().all().iter().map(Draft::name).collect();
    assert_eq!(names, ["vehicle-1", "vehicle-2"]);
    assert_eq!(desk.plan(), [command::TAKEOFF]);
    assert!(is_kept(desk.app.state()));
    let orders = desk.give("draft upload each");
    let targets: Vec<Vec<VehicleId>> = orders
        .into_iter()
        .map(|effect| match effect {
            Effect::Order { order, .. } => order.targets,
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(targets, [vec![1], vec![2]]);
}

#[test]
fn drafts_outlive_the_session() {
    let mut desk = Desk::new();
    desk.press("ta");
    desk.give("leave");
    assert_eq!(desk.plan().len(), 2);
}

#[test]
fn the_parameters_of_the_item_are_offered_with_their_values() {
    let mut desk = Desk::new();
    desk.press("ta");
    desk.give("draft set 2 hold 5s");
    desk.press("e");
    let Some(Overlay::Palette(palette)) = desk.app.state().overlay() else {
        panic!("no line");
    };
    let offered: Vec<(&str, String)> = palette
        .completions()
        .iter()
        .map(|it| (it.text.as_str(), it.hint.to_string()))
        .collect();
    assert!(offered.contains(&("hold", "5s".to_owned())), "{offered:?}");
    assert!(
        offered.iter().all(|(name, _)| *name != "turns"),
        "{offered:?}"
    );
}

#[test]
fn without_a_screen_lines_name_their_places() {
    let mut desk = Desk::with_rooms(false);
    let size = TerminalEvent::Resize {
        columns: u16::MAX,
        rows: u16::MAX,
    };
    let _ = desk.app.update(Event::from(size));
    desk.give("draft new field");
    desk.give("draft fence polygon n 50 e 50");
    desk.give("draft add n 100 e 0");
    assert_eq!(desk.plan(), [command::WAYPOINT]);
    desk.give("draft add");
    assert_eq!(desk.plan().len(), 1, "nothing shows a cursor");
}

/// A new draft after one in another country moves the map and its cursor back home.
#[test]
fn a_new_draft_begins_at_home_after_one_that_was_far_away() {
    let mut desk = Desk::new();
    desk.give("draft new abroad");
    desk.give("draft home 47 8");
    desk.give("draft add 47.001 8.001 up 30");
    desk.give("draft add 47.002 8.001 up 30");
    desk.press("j");
    desk.give("draft close");
    desk.press("y");
    desk.give("draft new here");
    desk.give("draft add waypoint up 30");
    let item = desk.room().items()[0];
    let away_m = LatLon::from_e7(item.x, item.y).distance_m(HOME);
    assert!(away_m < 1000.0, "{away_m} m");
}
