//! Faulty configurations, keymaps and themes: one file per fault.

use std::fs;
use std::path::Path;

use super::{home, sortie, text};

/// The refusal of each file in the folders of bad files: one fault each.
const REFUSALS: &[&str] = &[
    "bad_configs/columns.toml:1:34: unknown column `battery` (did you mean `bat`?)",
    "bad_configs/flag.toml:1:9: `mouse` must be `true` or `false`",
    "bad_configs/log-level.toml:2:10: unknown log levels: ",
    "bad_configs/macro-kind.toml:2:6: `macros.up` must be a line of the command language in quotes, or a list of them",
    "bad_configs/macro-line.toml:2:26: unknown command `takeof` (did you mean `takeoff`?)",
    "bad_configs/macro-wait.toml:2:22: `wait` is for pilot scripts (in the console, give the next command",
    "bad_configs/mute.toml:2:10: unknown kind of alert: `gsp` (did you mean `gps`?)",
    "bad_configs/no-section.toml:2:10: `alerts` is a section: write `[alerts]` on a line of its own and its settings below",
    "bad_configs/number-as-section.toml:1:2: `fps` must be a whole number from 1 to 60",
    "bad_configs/number.toml:1:7: `fps` must be a whole number from 1 to 60",
    "bad_configs/sort.toml:2:9: unknown column `batt` (did you mean `bat`?)",
    "bad_configs/syntax.toml:1:9: expected a value: a number, `true`, `false`, or text in quotes",
    "bad_configs/text.toml:1:9: `theme` must be text in quotes",
    "bad_configs/theme.toml:1:10: unknown theme `drak` (did you mean `dark`?)",
    "bad_configs/twice.toml:2:1: duplicate key",
    "bad_configs/unknown-in-section.toml:2:1: unknown setting `alerts.bel` (did you mean `bell`?)",
    "bad_configs/unknown-section.toml:1:2: unknown setting `alert` (did you mean `alerts`?)",
    "bad_configs/unknown-setting.toml:2:1: unknown setting `them` (did you mean `theme`?)",
    "bad_configs/word.toml:1:8: `lang` must be one of en, uk (did you mean `uk`?)",
    "bad_configs/words.toml:1:17: `table.columns` must be a list of words, such as `[\"one\", \"two\"]`",
    "bad_keymaps/action.toml:2:5: unknown action or command `inver` (did you mean `invert`?)",
    "bad_keymaps/context.toml:1:2: unknown context `fyl` (did you mean `fly`?)",
    "bad_keymaps/key.toml:2:1: unknown key `f55`",
    "bad_keymaps/line.toml:2:10: unknown command `takeof` (did you mean `takeoff`?)",
    "bad_keymaps/meaning.toml:2:5: expected the name of an action or a command line in quotes, or `false`",
    "bad_keymaps/no-context.toml:1:6: expected the name of an action or a command line in quotes, or `false`",
    "bad_keymaps/open-line.toml:2:10: unknown command `takeof` (did you mean `takeoff`?)",
    "bad_keymaps/prompt-letter.toml:2:1: `x` types a letter in this context",
    "bad_keymaps/prompt-line.toml:2:10: only actions can be given to the keys of `prompt`",
    "bad_keymaps/same-key.toml:2:1: terminals send the same code for `ctrl-m` and `enter`",
    "bad_keymaps/shadow.toml:5:1: `x` is used under `[anywhere]`, on line 2 (give one of them another key)",
    "bad_keymaps/syntax.toml:2:5: expected a value: a number, `true`, `false`, or text in quotes",
    "bad_keymaps/twice.toml:3:1: `Ctrl-A` is already used in this context, on line 2",
    "bad_keymaps/wait-open.toml:2:8: `wait` is for pilot scripts (in the console, give the next command",
    "bad_keymaps/wait.toml:2:8: `wait` is for pilot scripts (in the console, give the next command",
    "bad_themes/circle-a.toml:1:12: themes inherit from each other in a circle: circle-a -> circle-b -> circle-a",
    "bad_themes/circle-b.toml:1:12: themes inherit from each other in a circle: circle-b -> circle-a -> circle-b",
    "bad_themes/colour.toml:3:13: `grin` is not a colour (write `\"#rrggbb\"`, ",
    "bad_themes/entry.toml:3:1: unknown role `siren` (roles: text, muted, title, ",
    "bad_themes/entry.toml:3:9: `siren` must be a table with its colours (write `siren = { fg = \"#ff0000\" }`)",
    "bad_themes/faulty-parent.toml:1:12: the parent theme `role` has faults (tests/data/bad_themes/role.toml:3:1: ",
    "bad_themes/incomplete.toml:1:1: the role `text` has no style (give it one under `[roles]`, or inherit it: ",
    "bad_themes/no-parent.toml:1:12: unknown theme `drak` (did you mean `dark`?)",
    "bad_themes/role.toml:3:1: unknown role `warnin` (did you mean `warning`?)",
    "bad_themes/style.toml:3:8: unknown field `blink`; known: ",
];

#[test]
fn bad_files_are_refused_with_the_place_and_the_reason() {
    let mut files: Vec<String> = Vec::new();
    for folder in ["bad_configs", "bad_keymaps", "bad_themes"] {
        let folder = Path::new("tests/data").join(folder);
        for entry in fs::read_dir(folder).expect("it is there").flatten() {
            files.push(entry.path().to_str().expect("plain").to_owned());
        }
    }
    files.sort();
    let arguments: Vec<&str> = std::iter::once("check")
        .chain(files.iter().map(String::as_str))
        .collect();
    let home = home(&[]);
    let output = sortie(home.path(), &[], &arguments);
    assert_eq!(output.status.code(), Some(1));
    let printed = text(&output.stdout);
    // The lines below a fault show its place.
    let is_fault = |line: &&str| !line.starts_with("  ");
    let found: Vec<&str> = printed.lines().filter(is_fault).collect();
    for (found, expected) in found.iter().zip(REFUSALS) {
        let found = found.strip_prefix("tests/data/").expect("its path");
        assert!(
            found.starts_with(expected),
            "{found}\nrather than\n{expected}"
        );
    }
    assert_eq!(found.len(), REFUSALS.len(), "{printed}");
}
