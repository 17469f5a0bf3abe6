//! The command line as a palette of all commands and rooms, and macros.

use sortie::app::effect::{Effect, Launch, SessionEffect};
use sortie::app::state::Room;
use sortie::mission::Listing;

use super::palette_line;
use crate::fixtures;
use crate::harness::Console;

fn offered(console: &Console) -> Vec<String> {
    match console.state().overlay() {
        Some(sortie::app::state::Overlay::Palette(palette)) => {
            let texts = palette.completions().iter();
            texts.map(|choice| choice.text.clone()).collect()
        }
        other => panic!("the command line is not open: {other:?}"),
    }
}

/// The fault of the line that is being edited.
fn fault(console: &Console) -> String {
    match console.state().overlay() {
        Some(sortie::app::state::Overlay::Palette(palette)) => {
            let fault = palette.fault().expect("the line is wrong");
            fault.message.to_string()
        }
        other => panic!("the command line is not open: {other:?}"),
    }
}

#[test]
fn rooms_missions_settings_and_old_lines_are_found_by_any_of_their_words() {
    let mut console = Console::flying(3);
    console.give("all takeoff 20");
    for (written, line) in [
        ("map", "show map"),
        ("m01", "fly m01"),
        ("desktop", "set notify on"),
        ("light", "set theme light"),
        ("20", "all takeoff 20"),
        ("2", "select 2"),
        ("swarm flight", "show fly"),
    ] {
        console.press(":").write(written);
        assert!(
            offered(&console).contains(&line.to_owned()),
            "{written}: {:?}",
            offered(&console)
        );
        console.press("esc");
    }
}

#[test]
fn a_line_typed_in_the_ukrainian_layout_says_how_it_is_read_and_one_enter_gives_it() {
    let mut console = Console::flying(1);
    console.press(":").write("пгшвув");
    let screen = console.screen(80, 24);
    assert!(screen.contains("reads as `guided`"), "{screen}");
    assert_eq!(console.press("enter").sent_to(), [1]);
    // While its arguments are missing, it is no fault either.
    console.press(":").write("ефлущаа ");
    let screen = console.screen(80, 24);
    assert!(screen.contains("reads as `takeoff `"), "{screen}");
    assert!(!screen.contains("unknown"), "{screen}");
    console.write("10").press("enter");
    assert_eq!(console.sent_to(), [1]);
    assert!(console.state().overlay().is_none());
    assert_eq!(console.state().typing().last_line(), Some("takeoff 10"));
    console.give("set lang uk").press(":").write("ефлущаа 10");
    let screen = console.screen(80, 24);
    assert!(
        screen.contains("буде прочитано як `takeoff 10`"),
        "{screen}"
    );
}

#[test]
fn a_line_in_the_ukrainian_layout_is_completed_and_faulted_in_latin_letters() {
    let mut console = Console::flying(1);
    console.press(":").write("ефлущаа 20").press("tab");
    assert!(palette_line(&console).starts_with("takeoff 20"));
    console.press("ctrl-u").write("ефлущаа фи").press("enter");
    assert_eq!(palette_line(&console), "takeoff ab");
    assert!(!fault(&console).is_empty());
    console.press("ctrl-u").write("пгшвувв").press("enter");
    assert_eq!(palette_line(&console), "guidedd");
    // A line that makes no sense in any keyboard layout stays as it was typed.
    console.press("ctrl-u").write("злетіти").press("enter");
    assert_eq!(palette_line(&console), "злетіти");
}

#[test]
fn an_unfinished_line_in_the_ukrainian_layout_is_offered_what_its_keys_begin() {
    let mut console = Console::flying(2);
    console.give("group red 1-2").press(":").write("ефлущ");
    assert_eq!(offered(&console)[0], "takeoff");
    console.press("tab");
    assert!(palette_line(&console).starts_with("takeoff"));
    console.press("ctrl-u").write("фдд ефл");
    assert_eq!(offered(&console)[0], "takeoff");
    console.press("ctrl-u").write("\"ку");
    assert_eq!(offered(&console)[0], "@red");
    console.press("ctrl-u").write("\"кув дфтв").press("enter");
    assert_eq!(console.sent_to(), [1, 2]);
}

#[test]
fn a_wrong_word_in_the_ukrainian_layout_is_marked_and_has_the_advice_for_its_keys() {
    let mut console = Console::flying(1);
    let cases = [("ефлуща 20", "ефлуща"), ("фдд елущаа 20", "елущаа")];
    for (line, wrong) in cases {
        console.press(":").write(line);
        let Some(sortie::app::state::Overlay::Palette(palette)) = console.state().overlay() else {
            panic!("the command line is not open");
        };
        let fault = palette.fault().expect("the line is wrong");
        let marked = palette.input().value().get(fault.span.clone());
        assert_eq!(marked, Some(wrong));
        let help = fault.help.as_ref().map(ToString::to_string);
        assert!(help.unwrap_or_default().contains("takeoff"), "{line}");
        console.press("esc");
    }
}

#[test]
fn free_text_after_a_verb_in_the_ukrainian_layout_stays_as_typed() {
    let mut console = Console::flying(1);
    console.press(":").write("ищщльфкл поворот");
    let screen = console.screen(80, 24);
    assert!(screen.contains("reads as `bookmark поворот`"), "{screen}");
    console
        .press("ctrl-u")
        .write("іутв іефегіеуче еуче=\"два слова");
    let screen = console.screen(80, 24);
    assert!(
        screen.contains("reads as `send statustext text=\"два слова`"),
        "{screen}"
    );
    console.press("ctrl-u").write("карта");
    let screen = console.screen(80, 24);
    assert!(!screen.contains("reads as"), "{screen}");
}

#[test]
fn a_dangerous_line_in_the_ukrainian_layout_asks_and_valid_text_stays_as_typed() {
    let mut console = Console::flying(1);
    console.press(":").write("лшдд").press("enter");
    let asks = matches!(
        console.state().overlay(),
        Some(sortie::app::state::Overlay::Confirm(_))
    );
    assert!(asks && console.effects.is_empty());
    console.press("esc").press(":").write("bookmark поворот");
    let screen = console.screen(80, 24);
    assert!(!screen.contains("reads as"), "{screen}");
}

#[test]
fn a_key_pressed_twice_writes_its_word_once() {
    let mut console = Console::flying(1);
    for (key, line) in [("w", "hint"), ("h", "hold"), ("ц", "hint"), ("ф", "arm")] {
        console.press(key).press(key);
        assert_eq!(palette_line(&console), line, "{key}");
        console.press("esc");
    }
    console
        .press("w")
        .write(" x")
        .press("backspace")
        .press("backspace")
        .write("w");
    assert_eq!(palette_line(&console), "hintw", "typed on purpose");
    // A place may begin with the letter of the key that has written `goto `.
    console.press("esc").press("g").write("gate1");
    assert!(palette_line(&console).ends_with(" gate1"));
}

#[test]
fn what_a_line_means_is_searched_in_the_language_of_the_screens() {
    let mut console = Console::flying(1);
    console.give("set lang uk").press(":").write("карта");
    assert_eq!(offered(&console), ["show map"]);
    console.press("tab").press("enter");
    assert_eq!(console.state().room(), Room::Map);
}

#[test]
fn verbs_are_found_by_ukrainian_words() {
    let mut console = Console::flying(1);
    console.give("set lang uk");
    for (written, verb) in [
        ("злетіти", "takeoff"),
        ("сісти", "land"),
        ("повернутися", "rtl"),
        ("активувати", "arm"),
        ("зупинитися", "hold"),
        ("летіти", "goto"),
    ] {
        console.press(":").write(written);
        let found = offered(&console);
        assert!(found.iter().any(|it| it == verb), "{written}: {found:?}");
        console.press("esc");
    }
}

#[test]
fn exact_words_and_beginnings_come_before_scattered_letters() {
    let mut console = Console::flying(3);
    let mut first = |written: &str| {
        console.press(":").write(written);
        let found = offered(&console);
        console.press("esc");
        found
    };
    for written in ["w", "q", "a", "s", "ta"] {
        let found = first(written);
        let begins = |line: &String| {
            line.split([' ', '-', '_'])
                .any(|it| it.starts_with(written))
        };
        let noise: Vec<&String> = found.iter().filter(|line| !begins(line)).collect();
        assert!(
            noise.is_empty() && !found.is_empty(),
            "{written}: {noise:?}"
        );
    }
    for verb in ["arm", "land", "set", "speed", "hold"] {
        assert_eq!(first(verb)[0], verb);
    }
    assert_eq!(first("tko")[0], "takeoff");
    let noise = first("tlog");
    assert!(!noise.contains(&"quit".to_owned()), "{noise:?}");
}

#[test]
fn a_word_offers_the_lines_that_have_it_and_no_mission_with_its_letters() {
    let fire = Listing {
        id: "09-fire-attack".to_owned(),
        title: "Fire attack".into(),
        ..fixtures::listing()
    };
    let mut console = Console::set_up(|setup| setup.missions.push(fire)).in_flight(3);
    let mut first = |written: &str| {
        console.press(":").write(written);
        let found = offered(&console);
        console.press("esc");
        found
    };
    let fires = first("fire");
    assert!(
        fires.contains(&"fly 09-fire-attack".to_owned()),
        "{fires:?}"
    );
    let found = first("ekf");
    let has_it = |line: &String| line.split([' ', '-']).any(|word| word == "ekf");
    assert!(
        found.iter().any(has_it) && found.iter().all(has_it),
        "{found:?}"
    );
}

#[test]
fn arguments_of_the_consoles_own_verbs_complete() {
    let mut console = Console::flying(1);
    console
        .press(":")
        .write("set lang ")
        .press("tab")
        .press("tab");
    assert_eq!(palette_line(&console), "set lang uk ");
    console.press("enter");
    assert_eq!(
        console.state().config().lang,
        Some(sortie::text::Language::Ukrainian)
    );
}

fn with_macros<const N: usize>(macros: [(&str, Vec<String>); N]) -> Console {
    let named = macros.map(|(name, lines)| (name.to_owned(), lines));
    Console::set_up(|setup| setup.config.macros.extend(named)).in_flight(2)
}

#[test]
fn a_macro_gives_its_lines_in_order() {
    let lines = ["all guided", "all arm", "show map"].map(str::to_owned);
    let mut console = with_macros([("up", lines.to_vec())]);
    console.give("macro up");
    let given: Vec<String> = console
        .state()
        .session()
        .ledger()
        .entries()
        .map(|entry| entry.line.clone())
        .collect();
    assert_eq!(given, ["all guided", "all arm"]);
    assert_eq!(console.state().room(), Room::Map);
}

#[test]
fn a_macro_waits_for_the_answer_to_a_question_and_no_means_none_of_the_rest() {
    let lines = ["1 kill", "2 arm"].map(str::to_owned);
    let mut console = with_macros([("m", lines.to_vec())]);
    let given = |console: &Console| console.state().session().ledger().entries().len();
    console.give("macro m");
    assert_eq!(given(&console), 0);
    console.press("1");
    assert_eq!(given(&console), 2);
    console.give("macro m").press("n").press("esc");
    assert_eq!(given(&console), 2);
    assert!(!console.state().typing().is_in_macro());
}

#[test]
fn a_macro_that_calls_itself_ends_and_one_that_is_wrong_shows_where() {
    let endless = vec!["macro m".to_owned()];
    let wrong = vec!["all takeof 20".to_owned(), "all arm".to_owned()];
    let mut console = with_macros([("m", endless), ("w", wrong)]);
    console.give("macro m");
    let message = console.state().message().expect("it says so");
    assert!(
        message.text.to_string().contains("does it call itself"),
        "{}",
        message.text
    );
    console.give("macro w");
    assert_eq!(palette_line(&console), "macro w");
    assert_eq!(console.state().session().ledger().entries().len(), 0);
}

#[test]
fn a_macro_with_a_wrong_line_sends_none_of_its_lines() {
    for (line, reason) in [
        ("wait all armed", "`wait` is for pilot scripts"),
        ("all takeof 20", "unknown command `takeof`"),
        ("7 takeoff 20", "7"),
        ("show nowhere", "`nowhere`"),
        ("macro inner", "line 1 of the macro `inner`"),
    ] {
        let lines = ["group new 1", "@new arm", line].map(str::to_owned);
        let inner = vec!["fly nowhere".to_owned()];
        let mut console = with_macros([("inner", inner), ("up", lines.to_vec())]);
        console.give("macro up");
        assert_eq!(
            console.state().session().ledger().entries().len(),
            0,
            "{line}"
        );
        let fault = fault(&console);
        assert!(fault.contains("the macro `"), "{fault}");
        assert!(fault.contains(reason), "{fault}");
    }
}

#[test]
fn a_macro_may_use_what_its_own_lines_make() {
    let lines = ["group new 1", "@new guided", "select 1", "arm"].map(str::to_owned);
    let mut console = with_macros([("up", lines.to_vec())]);
    console.give("macro up");
    assert_eq!(console.state().session().ledger().entries().len(), 2);
}

#[test]
fn another_mission_from_the_command_line_asks_before_the_present_one_is_lost() {
    let mut console = Console::flying(1);
    assert_eq!(
        console.give("fly m01").effects,
        [Effect::Session(SessionEffect::StartMission(
            Launch::graded("m01")
        ))],
        "nothing is armed"
    );
}
