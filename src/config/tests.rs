use super::*;
use crate::diagnostic::Diagnostic;
use crate::text::Language;

fn check(_: &str, word: &str) -> Result<(), Diagnostic> {
    match word.find("wrong") {
        Some(at) => Err(Diagnostic::new(at..at + 5, "no verb")),
        None => Ok(()),
    }
}

fn of_file(source: &str) -> Layers {
    let mut layers = Layers::default();
    layers
        .file("config.toml", source, &check)
        .expect("it is right");
    layers
}

fn faults_of(source: &str) -> Vec<String> {
    let faults = Layers::default()
        .file("c.toml", source, &check)
        .expect_err(source);
    let lines = faults.iter();
    lines
        .map(|fault| fault.one_line("c.toml", source))
        .collect()
}

#[test]
fn nothing_set_is_the_default() {
    assert_eq!(Layers::default().config(), Config::default());
    assert_eq!(of_file("").config(), Config::default());
    assert_eq!(of_file("").origin("theme"), &Origin::Default);
}

#[test]
fn the_guide_has_every_setting() {
    let guide = include_str!("../../docs/configuration.md");
    let (_, rest) = guide.split_once("<!-- settings begin").expect("it begins");
    let (_, rest) = rest.split_once("-->").expect("the mark is whole");
    let (written, _) = rest.split_once("<!-- settings end -->").expect("it ends");
    assert!(
        written.trim() == setting_reference().trim(),
        "put what `sortie config --reference` prints between the marks of docs/configuration.md"
    );
}

#[test]
fn every_setting_of_the_table_is_one_of_the_configuration() {
    for setting in SETTINGS {
        let (value, tail) = match setting.kind {
            SettingKind::OneOf(choices) => (format!("{:?}", choices[choices.len() - 1]), ""),
            SettingKind::Text => ("\"something\"".to_owned(), ""),
            SettingKind::Whole(_, most) => (most.to_string(), ""),
            SettingKind::Flag => ("true".to_owned(), ""),
            SettingKind::Words => ("[\"a\", \"b\"]".to_owned(), ""),
            SettingKind::Columns => ("[\"id\", \"alt\"]".to_owned(), ""),
            SettingKind::Sort => ("\"-bat\"".to_owned(), ""),
            SettingKind::Vehicles => ("\"1-4,7\"".to_owned(), ""),
            SettingKind::AlertKinds => ("[\"gps\"]".to_owned(), ""),
            SettingKind::Lines => ("\"all arm\"".to_owned(), ".m"),
        };
        // Booleans have different defaults, so one of the two values differs from the default.
        let configs = [value.clone(), "false".to_owned()].map(|value| {
            let mut layers = Layers::default();
            let line = format!("{}{tail} = {value}", setting.name);
            drop(layers.file("c", &line, &check));
            layers.config()
        });
        let differs = configs.iter().any(|config| *config != Config::default());
        assert!(differs, "{} changes nothing", setting.name);
    }
}

#[test]
fn a_flag_comes_before_the_environment_that_before_the_file() {
    let mut layers = of_file("theme = \"light\"\nfps = 20\n[alerts]\nbell = false\n");
    let variables = [
        ("SORTIE_FPS", "5"),
        ("SORTIE_THEME", "monochrome"),
        ("SORTIE_LANG", ""),
    ];
    let variable = |name: &str| {
        let found = variables.iter().find(|(known, _)| *known == name);
        found.map(|(_, value)| (*value).to_owned())
    };
    layers.environment(variable).expect("they are right");
    layers
        .flag("theme", "--theme", "dark")
        .expect("it is right");
    layers.follow("lang", "LANG", "uk");
    layers.follow("theme", "LANG", "uk");
    let config = layers.config();
    assert_eq!(config.theme, "dark");
    assert_eq!(config.fps, 5);
    assert_eq!(config.lang, Some(Language::Ukrainian));
    assert!(!config.alerts.bell);
    let origins = ["theme", "fps", "lang", "alerts.bell", "mouse"];
    let origins = origins.map(|name| layers.origin(name).to_string());
    let expected = [
        "flag --theme",
        "environment SORTIE_FPS",
        "environment LANG",
        "config.toml:4",
        "default",
    ];
    assert_eq!(origins, expected);
}

#[test]
fn what_is_shown_reads_back_as_the_same() {
    let layers = of_file(
        "lang = \"uk\"\nsymbols = \"ascii\"\nlog.file = 'a\"b'\ntable.columns = [\"id\", \"mode\"]\n\
         [macros]\nup = \"all takeoff 20\"\n\"в дорогу\" = [\"all guided\", \"all arm\"]\n",
    );
    let shown = layers.show();
    assert_eq!(of_file(&shown).config(), layers.config(), "{shown}");
    assert!(
        shown.contains("symbols = \"ascii\" # config.toml:2\n"),
        "{shown}"
    );
    assert!(shown.contains("fps = 10 # default\n"), "{shown}");
    assert!(shown.contains("# keymap is not set\n"), "{shown}");
}

#[test]
fn faults_are_told_at_their_place_and_leave_the_rest_alone() {
    let cases = [
        (
            "them = \"dark\"",
            "c.toml:1:1: unknown setting `them` (did you mean `theme`?)",
        ),
        (
            "[alert]\nbell = true",
            "c.toml:1:2: unknown setting `alert` (did you mean `alerts`?)",
        ),
        (
            "[alerts]\nbel = true",
            "c.toml:2:1: unknown setting `alerts.bel` (did you mean `bell`?)",
        ),
        (
            "alerts = true",
            "c.toml:1:10: `alerts` is a section: write `[alerts]`",
        ),
        (
            "fps = \"10\"",
            "c.toml:1:7: `fps` must be a whole number from 1 to 60",
        ),
        (
            "fps = 0",
            "c.toml:1:7: `fps` must be a whole number from 1 to 60",
        ),
        ("mouse = 1", "c.toml:1:9: `mouse` must be `true` or `false`"),
        ("lang = \"ua\"", "c.toml:1:8: `lang` must be one of en, uk"),
        (
            "symbols = \"brail\"",
            "c.toml:1:11: `symbols` must be one of braille, block, ascii (did you",
        ),
        (
            "table.columns = \"id\"",
            "c.toml:1:17: `table.columns` must be a list of words",
        ),
        (
            "macros.x = []",
            "c.toml:1:12: `macros.x` must be a line of the command language",
        ),
        (
            "macros.x = [\"all arm\", \"all wrong\"]",
            "c.toml:1:29: no verb",
        ),
        (
            "table.columns = [\"id\", \"mod\"]",
            "c.toml:1:25: unknown column `mod` (did you mean `mode`?)",
        ),
        (
            "table.sort = \"-btt\"",
            "c.toml:1:15: unknown column `btt` (did you mean `bat`?)",
        ),
        (
            "alerts.mute = [\"crash\", \"batery\"]",
            "c.toml:1:26: unknown kind of alert: `batery` (did you mean `battery`?)",
        ),
        ("macros.x = \"\\u0061 wrong\"", "c.toml:1:12: no verb"),
        (
            "\"alerts.bell\" = true",
            "c.toml:1:1: unknown setting `alerts.bell`",
        ),
        ("\"\" = 1", "c.toml:1:1: unknown setting ``"),
        ("fps = 5\nfps = 6", "c.toml:2:1: duplicate key"),
        ("theme = dark", "c.toml:1:9: expected a value: a number"),
    ];
    for (source, expected) in cases {
        let faults = faults_of(source);
        assert!(faults[0].starts_with(expected), "{source}: {faults:?}");
    }
    let mut layers = Layers::default();
    let faults = layers.file("c", "fps = 0\nmouse = true\n", &check);
    assert_eq!(faults.expect_err("0 is too little").len(), 1);
    assert!(layers.config().mouse);
}

#[test]
fn a_wrong_variable_is_told_and_left_out() {
    let mut layers = Layers::default();
    let variable = |name: &str| (name == "SORTIE_FPS").then(|| "many".to_owned());
    let faults = layers.environment(variable).expect_err("it is no number");
    let expected = "`SORTIE_FPS` must be a whole number from 1 to 60, not `many`";
    assert_eq!(faults[0].to_string(), expected);
    assert_eq!(layers.config(), Config::default());
    assert!(layers.flag("mouse", "--mouse", "maybe").is_err());
}
