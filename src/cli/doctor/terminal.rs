//! Checks whether the terminal can show the console.

use std::env;
use std::io::IsTerminal as _;

use super::super::settings::CliSettings;
use super::HostFinding;
use crate::text::Language;

/// The minimum size of the screens: columns and rows.
const LEAST: (u16, u16) = (80, 24);

/// The findings about the terminal.
pub(super) fn findings(settings: &CliSettings) -> Vec<HostFinding> {
    let term = variable("TERM");
    let size = std::io::stdout()
        .is_terminal()
        .then(crossterm::terminal::size)
        .and_then(Result::ok);
    vec![
        kind(term.as_deref()),
        room(size),
        colours(term.as_deref(), variable("COLORTERM").as_deref()),
        locale(
            ["LC_ALL", "LC_CTYPE", "LANG"]
                .into_iter()
                .find_map(variable),
            settings.withheld_language(),
        ),
    ]
}

fn variable(name: &str) -> Option<String> {
    env::var(name).ok().filter(|value| !value.is_empty())
}

fn kind(term: Option<&str>) -> HostFinding {
    match term {
        None | Some("dumb") => HostFinding::note(
            "terminal",
            format!(
                "TERM is {}: no screen can be drawn",
                term.unwrap_or("not set")
            ),
            "use a terminal, or `sortie connect --plain` for lines of text",
        ),
        Some(term) => HostFinding::ok("terminal", format!("TERM is {term}")),
    }
}

fn room(size: Option<(u16, u16)>) -> HostFinding {
    match size {
        None => HostFinding::ok("size", "standard output is not a terminal"),
        Some((columns, rows)) if columns < LEAST.0 || rows < LEAST.1 => HostFinding::note(
            "size",
            format!("{columns} columns, {rows} rows"),
            format!(
                "make it {} by {} or larger: a smaller one hides columns and curves",
                LEAST.0, LEAST.1
            ),
        ),
        Some((columns, rows)) => HostFinding::ok("size", format!("{columns} columns, {rows} rows")),
    }
}

fn colours(term: Option<&str>, more: Option<&str>) -> HostFinding {
    let found = match (term, more) {
        (_, Some("truecolor" | "24bit")) => "16 million",
        (Some(term), _) if term.contains("256") => "256",
        (Some(term), _) if term == "dumb" || term.contains("mono") || term.starts_with("vt1") => {
            return HostFinding::note(
                "colours",
                "none",
                "the theme monochrome needs no colours: --theme monochrome",
            );
        }
        _ => "16, or unknown",
    };
    HostFinding::ok("colours", found)
}

fn locale(found: Option<String>, withheld: Option<Language>) -> HostFinding {
    let name = found.unwrap_or_default();
    let lower = name.to_lowercase();
    if lower.contains("utf-8") || lower.contains("utf8") {
        return HostFinding::ok("locale", name);
    }
    let said = if name.is_empty() {
        "is not set"
    } else {
        name.as_str()
    };
    let english = withheld.map_or_else(String::new, |language| {
        format!(", and English is used instead of {}", language.code())
    });
    HostFinding::note(
        "locale",
        format!("{said}: no UTF-8: maps and curves are drawn in ASCII{english}"),
        "export LC_ALL=C.UTF-8, also on the machine that runs ssh",
    )
}

#[cfg(test)]
mod tests {
    use super::super::CheckResult;
    use super::*;

    #[test]
    fn what_a_terminal_lacks_is_told() {
        let cases = [
            (kind(Some("xterm")), CheckResult::Ok),
            (kind(Some("dumb")), CheckResult::Note),
            (kind(None), CheckResult::Note),
            (room(Some((80, 24))), CheckResult::Ok),
            (room(Some((79, 24))), CheckResult::Note),
            (room(None), CheckResult::Ok),
            (colours(Some("xterm-256color"), None), CheckResult::Ok),
            (colours(Some("vt100"), None), CheckResult::Note),
            (
                locale(Some("uk_UA.UTF-8".to_owned()), None),
                CheckResult::Ok,
            ),
            (
                locale(Some("C".to_owned()), Some(Language::Ukrainian)),
                CheckResult::Note,
            ),
            (locale(None, None), CheckResult::Note),
        ];
        for (finding, expected) in cases {
            assert_eq!(finding.verdict, expected, "{}", finding.found);
        }
    }
}
