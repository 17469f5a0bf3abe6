use super::*;

mod vision;

/// A library with these theme files of the user: name and text.
fn library(files: &[(&str, &str)]) -> Themes {
    let mut themes = Themes::default();
    for &(name, text) in files {
        let file = ThemeFile {
            path: format!("{name}.toml"),
            text: text.to_owned(),
        };
        themes.add(name.to_owned(), file);
    }
    themes
}

#[test]
fn every_embedded_theme_gives_every_role() {
    for name in Theme::names() {
        let theme = Theme::named(name).expect("it is embedded");
        assert_eq!(theme.styles.len(), Role::ALL.len(), "{name}");
    }
}

#[test]
fn a_theme_changes_only_what_it_names() {
    let mine = Themes::default()
        .read(
            "mine",
            "inherits = \"light\"\n[roles]\nok = { fg = \"blue\" }",
        )
        .expect("it is right");
    let light = Theme::named("light").expect("embedded");
    assert_eq!(mine.style(Role::Ok).fg, Some(Color::Blue));
    assert_eq!(mine.style(Role::Danger), light.style(Role::Danger));
}

#[test]
fn a_theme_that_inherits_nothing_needs_no_role_that_has_a_stand_in() {
    let first = Role::ALL
        .iter()
        .filter(|(_, role)| role.stand_in().is_none());
    let roles: Vec<String> = first
        .enumerate()
        .map(|(at, (name, _))| format!("{name} = {{ fg = \"#0000{at:02x}\" }}"))
        .collect();
    let source = format!("[roles]\n{}\n", roles.join("\n"));
    let theme = Themes::default().read("old", &source).expect("it is whole");
    assert_eq!(theme.style(Role::Fence), theme.style(Role::Warning));
    assert_eq!(theme.style(Role::Drone4), theme.style(Role::Text));
    let own = format!("{source}fence = {{ fg = \"#123456\" }}\n");
    let theme = Themes::default().read("own", &own).expect("it is whole");
    assert_eq!(
        theme.style(Role::Fence).fg,
        Some(Color::Rgb(0x12, 0x34, 0x56))
    );
}

/// Roles that must look different.
const MEANINGS: [Role; 8] = [
    Role::Armed,
    Role::Ready,
    Role::Alert,
    Role::Warning,
    Role::Fence,
    Role::Contact,
    Role::Hazard,
    Role::Locked,
];

#[test]
fn one_look_has_one_meaning() {
    for name in Theme::names() {
        let theme = Theme::named(name).expect("embedded");
        for depth in [ColourDepth::True, ColourDepth::Sixteen, ColourDepth::None] {
            let theme = theme.for_colours(depth);
            for (at, &a) in MEANINGS.iter().enumerate() {
                for &b in &MEANINGS[at + 1..] {
                    assert_ne!(
                        theme.style(a),
                        theme.style(b),
                        "{name} {depth:?}: {a:?} {b:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn faults_are_told_at_their_place() {
    let cases = [
        (
            "inherits = \"drak\"\n",
            "1:12",
            "unknown theme `drak`",
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
            "`grin` is not a colour",
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
        let faults = Themes::default().read("x", source).expect_err(source);
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

#[test]
fn the_users_themes_inherit_from_each_other_and_from_embedded_ones() {
    let themes = library(&[
        (
            "mine",
            "inherits = \"base\"\n[roles]\nok = { fg = \"blue\" }",
        ),
        (
            "base",
            "inherits = \"light\"\n[roles]\ninfo = { fg = \"red\" }",
        ),
        // The file replaces the embedded theme of the same name, and inherits from it.
        (
            "dark",
            "inherits = \"dark\"\n[roles]\nok = { fg = \"cyan\" }",
        ),
    ]);
    let names: Vec<&str> = themes.names().collect();
    assert_eq!(
        names,
        [
            "dark",
            "light",
            "high-contrast",
            "monochrome",
            "base",
            "mine"
        ]
    );
    let mine = themes.named("mine").expect("it is right");
    let light = Theme::named("light").expect("embedded");
    assert_eq!(mine.style(Role::Ok).fg, Some(Color::Blue));
    assert_eq!(mine.style(Role::Info).fg, Some(Color::Red));
    assert_eq!(mine.style(Role::Danger), light.style(Role::Danger));
    let dark = themes.named("dark").expect("it is right");
    assert_eq!(dark.style(Role::Ok).fg, Some(Color::Cyan));
    assert_eq!(
        dark.style(Role::Danger),
        Theme::default().style(Role::Danger)
    );
}

#[test]
fn what_cannot_be_inherited_is_pointed_at() {
    let themes = library(&[
        ("a", "inherits = \"b\""),
        ("b", "inherits = \"c\""),
        ("c", "inherits = \"a\""),
        ("self", "inherits = \"self\""),
        ("wrong", "inherits = \"dark\"\n[roles]\nokk = {}"),
        ("child", "inherits = \"wrong\""),
        ("slip", "inherits = \"chld\""),
    ]);
    let cases = [
        ("a", "circle: a -> b -> c -> a"),
        (
            "self",
            "self.toml:1:12: the theme `self` inherits from itself",
        ),
        (
            "child",
            "child.toml:1:12: the parent theme `wrong` has faults (wrong.toml:3:1: unknown role `okk`",
        ),
        (
            "slip",
            "slip.toml:1:12: unknown theme `chld` (did you mean `child`?)",
        ),
        ("chil", "unknown theme `chil`: choose one of dark,"),
    ];
    for (name, said) in cases {
        let error = themes.named(name).expect_err(name).to_string();
        assert!(error.contains(said), "{name}: {error}");
    }
}

#[test]
fn sixteen_colours_are_enough_to_tell_states_and_the_cursor() {
    for name in Theme::names() {
        let theme = Theme::named(name).expect("embedded");
        let theme = theme.for_colours(ColourDepth::Sixteen);
        let told_apart = [
            (Role::Warning, Role::Danger),
            (Role::Ok, Role::Warning),
            (Role::Ok, Role::Danger),
            (Role::Info, Role::Danger),
            (Role::Text, Role::Cursor),
            (Role::Text, Role::Header),
        ];
        for (a, b) in told_apart {
            assert_ne!(theme.style(a), theme.style(b), "{name}: {a:?} {b:?}");
        }
    }
    let dark = Theme::default().for_colours(ColourDepth::Sixteen);
    assert_eq!(dark.style(Role::Danger).fg, Some(Color::LightRed));
    assert_eq!(dark.style(Role::Warning).fg, Some(Color::Yellow));
    let is_reversed = |role| dark.style(role).add_modifier.contains(Modifier::REVERSED);
    assert!(is_reversed(Role::Cursor) && !is_reversed(Role::Danger));
}
