//! The terminal's capabilities, as its environment variables describe them.

use crate::config::Symbols;
use crate::text::{Text, text};
use crate::ui::ColourDepth;

/// The environment variables that describe the terminal.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Environment {
    pub term: String,
    pub colorterm: String,
    pub no_color: String,
    /// The character locale: the first one set of `LC_ALL`, `LC_CTYPE` and `LANG`.
    pub locale: String,
}

impl Environment {
    /// The environment of this process.
    pub fn of_process() -> Self {
        let variable = |name: &str| std::env::var(name).unwrap_or_default();
        let locales = ["LC_ALL", "LC_CTYPE", "LANG"].map(variable);
        Self {
            term: variable("TERM"),
            colorterm: variable("COLORTERM"),
            no_color: variable("NO_COLOR"),
            locale: locales
                .into_iter()
                .find(|locale| !locale.is_empty())
                .unwrap_or_default(),
        }
    }

    /// How many colours the terminal can show.
    pub fn colour_depth(&self) -> ColourDepth {
        if !self.no_color.is_empty() {
            return ColourDepth::None;
        }
        let term = self.term.as_str();
        let starts = |names: &[&str]| names.iter().any(|name| term.starts_with(name));
        if term.is_empty()
            || term == "dumb"
            || starts(&["vt1", "vt2", "vt3"])
            || term.ends_with("-m")
        {
            return ColourDepth::None;
        }
        // The Linux console and screen misread 24-bit sequences, even if other variables claim support.
        if term == "linux" || term == "screen" || term.starts_with("screen.") {
            return ColourDepth::Sixteen;
        }
        let is_direct = term.contains("direct")
            || starts(&[
                "xterm-kitty",
                "foot",
                "alacritty",
                "wezterm",
                "xterm-ghostty",
            ]);
        match self.colorterm.as_str() {
            "truecolor" | "24bit" => ColourDepth::True,
            _ if is_direct => ColourDepth::True,
            _ if term.contains("256color") => ColourDepth::Indexed,
            _ => ColourDepth::Sixteen,
        }
    }

    /// Whether the window has a title that a program may set: other terminals would show the sequence as garbage.
    pub fn has_window_title(&self) -> bool {
        let is_plain = matches!(self.term.as_str(), "" | "dumb" | "linux");
        !is_plain && !["vt1", "vt2"].iter().any(|old| self.term.starts_with(old))
    }

    /// The symbols for curves and maps. If no locale is set, as under `su` or `cron`, only ASCII is safe.
    pub fn symbols(&self) -> Symbols {
        if !self.speaks_utf8() {
            Symbols::Ascii
        } else if self.term == "linux" {
            Symbols::Block
        } else {
            Symbols::Braille
        }
    }

    /// Whether letters beyond ASCII can be shown.
    pub fn speaks_utf8(&self) -> bool {
        let locale = self.locale.to_ascii_lowercase();
        locale.contains("utf-8") || locale.contains("utf8")
    }

    /// Why the console cannot be shown on this terminal, if it cannot.
    pub fn fault(&self) -> Option<Text> {
        match self.term.as_str() {
            "" => Some(text!("terminal-unnamed")),
            "dumb" => Some(text!("terminal-dumb")),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn environment(term: &str, colorterm: &str, no_color: &str, locale: &str) -> Environment {
        let [term, colorterm, no_color, locale] =
            [term, colorterm, no_color, locale].map(str::to_owned);
        Environment {
            term,
            colorterm,
            no_color,
            locale,
        }
    }

    #[test]
    fn each_terminal_gets_the_colours_that_it_has() {
        let cases = [
            ("xterm", "", "", ColourDepth::Sixteen),
            ("xterm-256color", "", "", ColourDepth::Indexed),
            ("xterm-256color", "truecolor", "", ColourDepth::True),
            ("tmux-256color", "", "", ColourDepth::Indexed),
            ("tmux-256color", "24bit", "", ColourDepth::True),
            ("screen", "", "", ColourDepth::Sixteen),
            ("screen", "truecolor", "", ColourDepth::Sixteen),
            ("screen-256color", "", "", ColourDepth::Indexed),
            ("linux", "truecolor", "", ColourDepth::Sixteen),
            ("xterm-kitty", "", "", ColourDepth::True),
            ("xterm-direct", "", "", ColourDepth::True),
            ("vt100", "", "", ColourDepth::None),
            ("dumb", "truecolor", "", ColourDepth::None),
            ("", "", "", ColourDepth::None),
            ("xterm-256color", "truecolor", "1", ColourDepth::None),
        ];
        for (term, colorterm, no_color, depth) in cases {
            let found = environment(term, colorterm, no_color, "").colour_depth();
            assert_eq!(found, depth, "{term:?} {colorterm:?} {no_color:?}");
        }
    }

    #[test]
    fn symbols_follow_locale_and_terminal() {
        let cases = [
            ("xterm", "uk_UA.UTF-8", Symbols::Braille),
            ("xterm", "C.utf8", Symbols::Braille),
            ("linux", "en_US.UTF-8", Symbols::Block),
            ("xterm", "C", Symbols::Ascii),
            ("xterm", "", Symbols::Ascii),
            ("linux", "en_US.ISO-8859-1", Symbols::Ascii),
        ];
        for (term, locale, symbols) in cases {
            let found = environment(term, "", "", locale).symbols();
            assert_eq!(found, symbols, "{term} {locale:?}");
        }
    }

    #[test]
    fn a_title_goes_only_where_there_is_a_window() {
        let cases = [
            ("xterm-256color", true),
            ("tmux-256color", true),
            ("linux", false),
            ("vt100", false),
            ("dumb", false),
            ("", false),
        ];
        for (term, has) in cases {
            let found = environment(term, "", "", "").has_window_title();
            assert_eq!(found, has, "{term:?}");
        }
    }

    #[test]
    fn a_terminal_that_cannot_move_its_cursor_is_refused() {
        for (term, refused) in [
            ("dumb", true),
            ("", true),
            ("linux", false),
            ("xterm", false),
        ] {
            assert_eq!(
                environment(term, "", "", "").fault().is_some(),
                refused,
                "{term:?}"
            );
        }
    }
}
