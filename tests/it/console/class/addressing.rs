//! Which seats a key or a line at the desk is for.

use sortie::app::state::{Overlay, Room};
use sortie::class::Deed;
use sortie::text::Language;

use super::desk::{deeds, desk, report};

#[test]
fn a_key_gives_an_order_to_the_seat_under_the_cursor_or_to_marked_ones() {
    let mut console = desk(Language::English);
    assert_eq!(console.state().room(), Room::Class);
    console.press("f");
    assert_eq!(deeds(&console), [("anna".to_owned(), Deed::Freeze)]);
    console
        .press("down")
        .press("space")
        .press("down")
        .press("space");
    console.press("r");
    let resumed = [
        ("anna".to_owned(), Deed::Freeze),
        ("bohdan".to_owned(), Deed::Resume),
        ("vira".to_owned(), Deed::Resume),
    ];
    assert_eq!(deeds(&console), resumed);
    console.press("esc").press("h");
    assert_eq!(
        deeds(&console).last(),
        Some(&("vira".to_owned(), Deed::Hint))
    );
}

#[test]
fn a_line_names_a_seat_or_all_of_them() {
    let mut console = desk(Language::English);
    console.give("class message @bohdan land first");
    let text = "land first".into();
    let said = [("bohdan".to_owned(), Deed::Message { text })];
    assert_eq!(deeds(&console), said);
    console.give("class freeze @all");
    assert_eq!(deeds(&console).len(), 4);
    console.press("m").write("all of you").press("enter");
    let text = "all of you".into();
    assert!(deeds(&console).contains(&("anna".to_owned(), Deed::Message { text })));
    for line in ["class freeze @nobody", "class message @nobody hello"] {
        console.give(line);
        let screen = console.screen(120, 40);
        assert!(screen.contains("nobody"), "{screen}");
        assert_eq!(deeds(&console).len(), 5, "{line}");
    }
}

/// `class capture NAME @all` once made `@all` a part of the name, and captured only the flight under the cursor.
#[test]
fn a_seat_may_be_the_last_word_of_a_line() {
    let message = |text: &str| Deed::Message { text: text.into() };
    let inject = |when: Option<&str>| Deed::Inject {
        name: "gust".into(),
        when: when.map(Into::into),
    };
    let fly = super::start::fly("m01", true);
    let name = "low battery".into();
    let capture = Deed::Capture { name };
    let text = "in the air".into();
    let vehicles = vec![1, 2];
    let line = "3 takeoff 20".into();
    let both = &["bohdan", "vira"][..];
    for (line, seats, deed) in [
        (
            "class capture low battery @bohdan",
            &["bohdan"][..],
            capture,
        ),
        (
            "class mark in the air @vira",
            &["vira"],
            Deed::Mark { text },
        ),
        (
            "class message land now @bohdan",
            &["bohdan"],
            message("land now"),
        ),
        (
            "class message @bohdan ask @vira",
            &["bohdan"],
            message("ask @vira"),
        ),
        (
            "class message ask @vira first",
            both,
            message("ask @vira first"),
        ),
        (
            "class message write to me@lab",
            both,
            message("write to me@lab"),
        ),
        ("class inject gust @bohdan", &["bohdan"], inject(None)),
        (
            "class inject gust when t > 60 @bohdan",
            &["bohdan"],
            inject(Some("t > 60")),
        ),
        ("class fly m01 hold @bohdan", &["bohdan"], fly),
        (
            "class take 1-2 @bohdan",
            &["bohdan"],
            Deed::TakeOver { vehicles },
        ),
        (
            "class say 3 takeoff 20 @bohdan",
            &["bohdan"],
            Deed::Command { line },
        ),
        (
            "class freeze @all",
            &["anna", "bohdan", "vira"],
            Deed::Freeze,
        ),
    ] {
        let mut console = desk(Language::English);
        report(&mut console, 1, "anna", super::flight_with_injects());
        // With bohdan and vira marked, a line without seats goes to both.
        console
            .press("down")
            .press("space")
            .press("down")
            .press("space");
        console.give(line);
        let given = seats.iter().map(|seat| ((*seat).to_owned(), deed.clone()));
        assert_eq!(deeds(&console), given.collect::<Vec<_>>(), "{line}");
    }
    let mut console = desk(Language::English);
    for line in [
        "class capture low battery @nobody",
        "class message ask @nobody",
    ] {
        console.give(line);
        let screen = console.screen(120, 40);
        assert!(
            screen.contains("no seat of the class is called @nobody"),
            "{screen}"
        );
        assert_eq!(deeds(&console), [], "{line}");
        console.press("esc");
    }
    console.press(":").write("class capture low battery @b");
    let Some(Overlay::Palette(palette)) = console.state().overlay() else {
        panic!("the command line is not open");
    };
    let offered = palette.completions().iter().map(|it| it.text.as_str());
    assert_eq!(offered.collect::<Vec<_>>(), ["@bohdan"]);
}
