use super::*;

#[test]
fn every_embedded_theme_gives_every_role() {
    for name in Theme::names() {
        let theme = Theme::named(name).expect("it is embedded");
        assert_eq!(theme.styles.len(), Role::ALL.len(), "{name}");
    }
}

#[test]
fn a_theme_changes_only_what_it_names() {
    let mine =
        Theme::parse("inherits = \"light\"\n[roles]\nok = { fg = \"blue\" }").expect("it is right");
    let light = Theme::named("light").expect("embedded");
    assert_eq!(mine.style(Role::Ok).fg, Some(Color::Blue));
    assert_eq!(mine.style(Role::Danger), light.style(Role::Danger));
}

#[test]
fn faults_are_told_at_their_place() {
    let cases = [
        (
            "inherits = \"drak\"\n",
            "1:12",
            "no theme is named `drak`",
            "did you mean `dark`?",
        ),
        (
            "inherits = \"dark\"\n[roles]\nwarnin = {}",
            "3:1",
            "unknown role `warnin`",
            "`warning`",
        ),
        (
            "inherits = \"dark\"\n[roles]\nok = { fg = \"grin\" }",
            "3:13",
            "`grin` is no colour",
            "#rrggbb",
        ),
        (
            "inherits = \"dark\"\n[roles]\nok = { blink = true }",
            "3:8",
            "unknown field `blink`",
            "",
        ),
        (
            "[roles]\nok = {}",
            "1:1",
            "the role `text` has no style",
            "inherits",
        ),
    ];
    for (source, place, message, help) in cases {
        let faults = Theme::parse(source).expect_err(source);
        let line = faults[0].one_line("x.toml", source);
        assert!(
            line.starts_with(&format!("x.toml:{place}: {message}")),
            "{line}"
        );
        assert!(line.contains(help), "{line}");
    }
}

#[test]
fn terminals_without_colour_get_none() {
    for name in Theme::names() {
        let theme = Theme::named(name)
            .expect("embedded")
            .for_colours(ColourDepth::None);
        for (role, style) in &theme.styles {
            let plain = |colour: Option<Color>| colour.is_none_or(|colour| colour == Color::Reset);
            assert!(plain(style.fg) && plain(style.bg), "{name} {role:?}");
        }
        assert_ne!(theme.style(Role::Cursor), theme.style(Role::Text));
    }
}

#[test]
fn colours_map_to_their_nearest() {
    let cases = [
        (
            ColourDepth::Sixteen,
            Color::Rgb(250, 10, 10),
            Color::LightRed,
        ),
        (ColourDepth::Sixteen, Color::Indexed(231), Color::White),
        (
            ColourDepth::Indexed,
            Color::Rgb(95, 135, 255),
            Color::Indexed(69),
        ),
        (
            ColourDepth::Indexed,
            Color::Rgb(18, 18, 18),
            Color::Indexed(233),
        ),
        (ColourDepth::True, Color::Rgb(1, 2, 3), Color::Rgb(1, 2, 3)),
    ];
    for (depth, colour, expected) in cases {
        assert_eq!(depth.map(colour), expected, "{depth:?} {colour:?}");
    }
}
