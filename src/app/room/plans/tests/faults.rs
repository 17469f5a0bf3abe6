//! Refusals: the faulty word, and the messages for keys.

use super::*;
use crate::draft::PlanFrame;

impl Desk {
    /// The word of the command line that is marked as faulty.
    fn faulty(&self) -> &str {
        let Some(Overlay::Palette(palette)) = self.app.state().overlay() else {
            return "no line";
        };
        let span = palette.fault().map(|fault| fault.span.clone());
        span.and_then(|span| self.line().get(span)).unwrap_or("")
    }

    /// The contents that a tick at this time writes as unsaved drafts; `None` removes them.
    fn writings_at(&mut self, ms: u64) -> Vec<Option<String>> {
        let now = Duration::from_millis(ms);
        let effects = self.app.update(Event::Tick { now, wall: now }).into_iter();
        let writings = effects.filter_map(|effect| match effect {
            Effect::File(FileEffect::KeepDrafts(text)) => Some(text),
            _ => None,
        });
        writings.collect()
    }

    /// The text of the unsaved drafts, if a tick at this time writes them.
    pub(super) fn kept_at(&mut self, ms: u64) -> Option<String> {
        self.writings_at(ms).into_iter().flatten().next()
    }
}

#[test]
fn a_refusal_marks_the_word_at_fault() {
    let mut desk = Desk::new();
    desk.press("taa");
    for (line, word) in [
        ("draft insert 9 n 1 e 1", "9"),
        ("draft height 9 40", "9"),
        ("draft set 3 direction 1", "direction"),
        ("draft order 1-2 to 7", "to 7"),
        ("draft take 9", "9"),
        ("draft rehearse 9", "9"),
        ("draft upload 9", "9"),
    ] {
        desk.give(line);
        assert_eq!(desk.faulty(), word, "{line}");
        let _ = desk.key(KeyCode::Esc);
        let _ = desk.key(KeyCode::Esc);
    }
}

#[test]
fn a_vehicle_that_is_not_there_is_named() {
    for line in ["draft take 9", "draft upload 9"] {
        let mut desk = Desk::new();
        desk.give(line);
        let Some(Overlay::Palette(palette)) = desk.app.state().overlay() else {
            panic!("a fault");
        };
        let message = palette.fault().expect("a fault").message.to_string();
        assert!(message.contains("no vehicle 9"), "{line}: {message}");
    }
}

#[test]
fn several_vehicles_need_several_files() {
    let mut desk = Desk::new();
    assert!(desk.give("1-2 plan download one.plan").is_empty());
    assert_eq!(desk.faulty(), "one.plan");
    let _ = desk.key(KeyCode::Esc);
    assert_eq!(desk.give("1-2 plan download v{id}.plan").len(), 1);
}

/// Without terrain data, the ground counts as level, so the key cycles through all height
/// references.
#[test]
fn the_reference_of_heights_goes_around() {
    let mut desk = Desk::new();
    desk.press("a");
    let frame = |desk: &Desk| {
        let item = desk.room().items()[0];
        (PlanFrame::of(&item), item.z)
    };
    let seen = [(); 4].map(|()| {
        let before = frame(&desk);
        desk.press("f");
        before
    });
    assert_eq!(
        seen,
        [
            (Some(PlanFrame::Home), 30.0),
            (Some(PlanFrame::Terrain), 30.0),
            (Some(PlanFrame::Sea), 200.0),
            (Some(PlanFrame::Home), 30.0),
        ]
    );
    desk.press("f");
    assert!(desk.said().contains("level"), "{}", desk.said());
}

#[test]
fn keys_say_what_rally_points_do_not_have() {
    let mut desk = Desk::new();
    desk.press("3a");
    desk.press("f");
    assert!(desk.said().contains("rally points keep"), "{}", desk.said());
    desk.press("e");
    assert_eq!(desk.line(), "");
    assert!(desk.said().contains("no parameters"), "{}", desk.said());
}

#[test]
fn a_draft_with_errors_is_mended_before_it_is_uploaded() {
    let mut desk = Desk::new();
    desk.vehicle(1, |_| {});
    desk.press("ta");
    assert!(desk.next().contains("`U`"), "{}", desk.next());
    desk.give("draft fence polygon n 0 e 0");
    assert!(desk.next().contains("fix the faults"), "{}", desk.next());
}

#[test]
fn lines_and_circles_are_divided_among_vehicles() {
    let mut desk = Desk::new();
    for id in [1, 2] {
        super::area::standing(&mut desk, id);
    }
    desk.give("draft new road");
    desk.give("draft line 1-2");
    assert_eq!(desk.room().drafts().all().len(), 1, "nothing is drawn");
    let _ = desk.key(KeyCode::Esc);
    desk.give("draft add n 50 e 0");
    desk.give("draft add n 350 e 0");
    desk.give("draft line 1-2 spacing 20 up 25");
    assert_eq!(desk.room().drafts().all().len(), 3, "{}", desk.said());
    assert!(
        desk.room()
            .items()
            .iter()
            .any(|item| (item.z - 25.0).abs() < 0.01)
    );
    desk.give("draft orbit 1-2 around tower radius 60 turns 3");
    let circles = desk.room().items().iter();
    let turns: Vec<f32> = circles
        .filter(|item| item.command == command::LOITER_TURNS)
        .map(|item| item.params[0])
        .collect();
    assert_eq!(turns, [3.0], "{}", desk.said());
}

/// Unsaved drafts are written with the next tick, and opened again by another console.
#[test]
fn unsaved_drafts_outlive_the_program() {
    let mut desk = Desk::new();
    assert!(desk.writings_at(100).is_empty());
    desk.press("ta");
    let text = desk.kept_at(200).expect("it is written");
    assert!(desk.writings_at(300).is_empty(), "once");
    let mut another = Desk::new();
    let _ = another.app.update(Event::from(FileEvent::Kept { text }));
    assert_eq!(another.plan(), [command::TAKEOFF, command::WAYPOINT]);
    assert!(another.said().contains("plan"), "{}", another.said());
    assert!(!is_kept(another.app.state()));
    let own = another.kept_at(100);
    assert!(own.is_some(), "the other console has a file of its own");
    assert!(another.writings_at(150).is_empty(), "once");
    let saved = another.give("draft save field");
    assert_eq!(saved.len(), 1);
    let path = "field.plan".to_owned();
    let _ = another.app.update(Event::from(FileEvent::Written { path }));
    assert_eq!(another.writings_at(200), [None], "the file is removed");
}

/// Two consoles may have left drafts of the same name.
#[test]
fn drafts_of_two_consoles_are_both_opened_again() {
    let left = |keys: &str| {
        let mut desk = Desk::new();
        desk.press(keys);
        desk.kept_at(100).expect("it is written")
    };
    let mut desk = Desk::new();
    for text in [left("ta"), left("taa"), left("ta")] {
        let _ = desk.app.update(Event::from(FileEvent::Kept { text }));
    }
    let drafts = desk.room().drafts().all().iter();
    let counts = drafts.map(|it| (it.name(), it.document().plan.len()));
    let counts: Vec<(&str, usize)> = counts.collect();
    assert_eq!(
        counts,
        [("plan", 2), ("plan-2", 3)],
        "the third is open already"
    );
}
