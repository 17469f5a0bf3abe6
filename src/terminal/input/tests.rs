use proptest::prelude::*;

use super::*;

fn inputs(bytes: &[u8]) -> Vec<Input> {
    let mut parser = Parser::default();
    parser.push(bytes);
    std::iter::from_fn(|| parser.next_input()).collect()
}

#[test]
fn keys_of_terminals_in_use_are_known() {
    use KeyModifiers as M;
    let cases: &[(&str, KeyCode, KeyModifiers)] = &[
        ("a", KeyCode::Char('a'), M::NONE),
        ("G", KeyCode::Char('G'), M::SHIFT),
        ("ї", KeyCode::Char('ї'), M::NONE),
        ("\r", KeyCode::Enter, M::NONE),
        ("\t", KeyCode::Tab, M::NONE),
        ("\x7f", KeyCode::Backspace, M::NONE),
        ("\x03", KeyCode::Char('c'), M::CONTROL),
        ("\x1a", KeyCode::Char('z'), M::CONTROL),
        ("\x1bb", KeyCode::Char('b'), M::ALT),
        ("\x1b\x7f", KeyCode::Backspace, M::ALT),
        ("\x1b[A", KeyCode::Up, M::NONE),
        ("\x1bOB", KeyCode::Down, M::NONE),
        ("\x1b[1;5C", KeyCode::Right, M::CONTROL),
        ("\x1b[H", KeyCode::Home, M::NONE),
        ("\x1b[4~", KeyCode::End, M::NONE),
        ("\x1b[3~", KeyCode::Delete, M::NONE),
        ("\x1b[6~", KeyCode::PageDown, M::NONE),
        ("\x1b[Z", KeyCode::BackTab, M::SHIFT),
        ("\x1bOP", KeyCode::F(1), M::NONE),
        ("\x1b[[A", KeyCode::F(1), M::NONE),
        ("\x1b[15~", KeyCode::F(5), M::NONE),
        ("\x1b[24~", KeyCode::F(12), M::NONE),
        ("\x1b[97;5u", KeyCode::Char('a'), M::CONTROL),
    ];
    for (bytes, code, modifiers) in cases {
        let expected = vec![key(*code, *modifiers)];
        assert_eq!(inputs(bytes.as_bytes()), expected, "{bytes:?}");
    }
}

#[test]
fn answers_and_what_nobody_asked_for_are_no_keys() {
    assert_eq!(inputs(b"\x1b[0n"), [Input::Answer]);
    for strange in [
        "\x1b[?62;22c",
        "\x1b[12;40R9",
        "\x1b[I",
        "\x1b[8;24;80t",
        "\x1b[>0;1;0c",
    ] {
        let found = inputs(strange.as_bytes());
        let keys = found.iter().filter(|input| matches!(input, Input::Key(key) if !matches!(key.code, KeyCode::F(3) | KeyCode::Char('9'))));
        assert_eq!(keys.count(), 0, "{strange:?}: {found:?}");
    }
}

#[test]
fn a_lone_escape_is_the_key_when_nothing_follows() {
    let mut parser = Parser::default();
    parser.push(b"\x1b");
    assert_eq!(parser.next_input(), None);
    assert!(parser.is_waiting());
    assert_eq!(
        parser.give_up(),
        Some(key(KeyCode::Esc, KeyModifiers::NONE))
    );
    parser.push(b"\x1b[1;");
    assert_eq!(parser.next_input(), None);
    assert_eq!(parser.give_up(), None, "half a sequence is no key");
    assert!(!parser.is_waiting());
}

#[test]
fn a_paste_is_one_thing_whatever_is_in_it() {
    let pasted = inputs("\x1b[200~all arm\r\x1b[A\x1b[201~x".as_bytes());
    let text = Input::Paste("all arm\r\u{1b}[A".to_owned());
    assert_eq!(pasted, [text, key(KeyCode::Char('x'), KeyModifiers::NONE)]);
}

#[test]
fn the_wheel_moves_and_the_left_button_points() {
    let none = KeyModifiers::NONE;
    let click = Input::Click { column: 9, row: 4 };
    assert_eq!(inputs(b"\x1b[<0;10;5M\x1b[<0;10;5m"), [click]);
    for other in [
        "\x1b[<2;10;5M",
        "\x1b[<0;0;5M",
        "\x1b[<0;10M",
        "\x1b[<0;99999;5M",
    ] {
        assert_eq!(inputs(other.as_bytes()), [], "{other:?}");
    }
    assert_eq!(inputs(b"\x1b[<64;1;1M"), [key(KeyCode::Up, none)]);
    assert_eq!(inputs(b"\x1b[<65;1;1M"), [key(KeyCode::Down, none)]);
}

proptest! {
    #[test]
    fn where_the_bytes_are_cut_makes_no_difference(
        parts in proptest::collection::vec(
            prop_oneof![
                Just("a"), Just("ї"), Just("\x1b[A"), Just("\x1b[1;5C"), Just("\x1b[0n"), Just("\r"), Just("\x1bx"),
                Just("\x1b[200~p q\x1b[201~"), Just("\x1b[<0;3;4M"), Just("\x1bOP"), Just("🛩"),
            ], 0..12),
        cuts in proptest::collection::vec(0_usize..200, 0..6),
    ) {
        let all: String = parts.concat();
        let whole = inputs(all.as_bytes());
        let mut cuts: Vec<usize> = cuts.into_iter().map(|cut| cut % (all.len() + 1)).collect();
        cuts.extend([0, all.len()]);
        cuts.sort_unstable();
        let mut parser = Parser::default();
        let mut pieces = Vec::new();
        for pair in cuts.windows(2) {
            parser.push(&all.as_bytes()[pair[0]..pair[1]]);
            pieces.extend(std::iter::from_fn(|| parser.next_input()));
        }
        prop_assert_eq!(pieces, whole);
    }

    #[test]
    fn no_bytes_hang_or_stop_it(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        let mut parser = Parser::default();
        parser.push(&bytes);
        while parser.next_input().is_some() {}
        prop_assert!(parser.bytes.len() <= bytes.len());
        parser.give_up();
    }
}
