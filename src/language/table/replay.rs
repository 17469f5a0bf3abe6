//! Verbs about replays and their moments.

use std::time::Duration;

use super::{Built, console};
use crate::language::argument::{Argument, Arguments, Kind, Problem};
use crate::language::console::{ConsoleLine, LoopTarget, ReplayLine, SeekTarget};
use crate::language::verb::{Form, Scope, VerbRow};
use crate::moment::MomentKind;
use crate::text;
use crate::verb::Verb;

pub(super) static ROWS: &[VerbRow] = &[REPLAY, SEEK, REWIND, LOOP, STOP_AT, BOOKMARK];

/// A console verb with examples.
const fn said(
    name: &'static str,
    scope: Scope,
    examples: &'static [&'static str],
    forms: &'static [Form],
) -> VerbRow {
    VerbRow {
        verb: Verb::unsent(name),
        scope,
        aliases: &[],
        examples,
        forms,
    }
}

const REPLAY: VerbRow = said(
    "replay",
    Scope::Screen,
    &["replay", "replay flight.tlog"],
    &[Form::new(
        &[Argument::value("file", Kind::Rest, "argument-file").optional()],
        |given| {
            let path = given.word("file").map(str::to_owned);
            console(ConsoleLine::Replay(ReplayLine::Open(path)))
        },
    )],
);

const SEEK: VerbRow = said(
    "seek",
    Scope::Screen,
    &[
        "seek 12:30",
        "seek +30",
        "seek -5",
        "seek end",
        "seek next refusal",
        "seek mission 4:10",
    ],
    &[Form::new(
        &[Argument::value("time", Kind::Rest, "argument-seek")],
        |given| {
            let target = seek_target(given.required_word("time")?)
                .ok_or_else(|| Problem::new("time", text!("seek-unreadable")))?;
            console(ConsoleLine::Replay(ReplayLine::Seek(target)))
        },
    )],
);

const REWIND: VerbRow = said(
    "rewind",
    Scope::Screen,
    &["rewind"],
    &[Form::new(&[], |_| {
        console(ConsoleLine::Replay(ReplayLine::Rewind))
    })],
);

const LOOP: VerbRow = said(
    "loop",
    Scope::Screen,
    &["loop 1:10 1:40", "loop bookmark", "loop off"],
    &[
        Form::new(&[Argument::flag("off", "")], |_| {
            console(ConsoleLine::Replay(ReplayLine::Loop(None)))
        }),
        Form::new(
            &[Argument::value("times", Kind::Rest, "argument-loop")],
            built_loop,
        ),
    ],
);

const STOP_AT: VerbRow = said(
    "stopat",
    Scope::Screen,
    &["stopat refusal alert", "stopat off"],
    &[
        Form::new(&[Argument::flag("off", "")], |_| {
            console(ConsoleLine::Replay(ReplayLine::StopAt(Vec::new())))
        }),
        Form::new(
            &[Argument::value("kind", Kind::Choice(MomentKind::NAMES), "").repeated()],
            |given| {
                let words = given.words("kind").into_iter();
                let kinds = words.filter_map(MomentKind::named).collect();
                console(ConsoleLine::Replay(ReplayLine::StopAt(kinds)))
            },
        ),
    ],
);

const BOOKMARK: VerbRow = said(
    "bookmark",
    Scope::Console,
    &["bookmark", "bookmark 3 came too close", "bookmark off"],
    &[
        Form::new(&[Argument::flag("off", "")], |_| {
            console(ConsoleLine::Unbookmark)
        }),
        Form::new(
            &[Argument::value("text", Kind::Rest, "").optional()],
            |given| {
                let text = given.word("text").unwrap_or_default().trim();
                console(ConsoleLine::Bookmark(text.to_owned()))
            },
        ),
    ],
);

fn built_loop(given: &Arguments) -> Built {
    let target = loop_target(given.required_word("times")?)
        .ok_or_else(|| Problem::new("times", text!("loop-unreadable")))?;
    console(ConsoleLine::Replay(ReplayLine::Loop(Some(target))))
}

fn loop_target(words: &str) -> Option<LoopTarget> {
    let words: Vec<&str> = words.split_whitespace().collect();
    match words[..] {
        [kind] => MomentKind::named(kind).map(LoopTarget::Moments),
        [from, to] => {
            let (from, to) = (time(from)?, time(to)?);
            (from < to).then_some(LoopTarget::Times { from, to })
        }
        _ => None,
    }
}

fn seek_target(word: &str) -> Option<SeekTarget> {
    let word = word.trim();
    let words: Vec<&str> = word.split_whitespace().collect();
    match words[..] {
        ["next", kind] => return MomentKind::named(kind).map(SeekTarget::Next),
        ["mission", elapsed] => return time(elapsed).map(SeekTarget::Mission),
        ["previous", kind] => return MomentKind::named(kind).map(SeekTarget::Previous),
        _ => {}
    }
    if let Some(rest) = word.strip_prefix('+') {
        return time(rest).map(SeekTarget::Later);
    }
    if let Some(rest) = word.strip_prefix('-') {
        return time(rest).map(SeekTarget::Earlier);
    }
    match word {
        "start" => Some(SeekTarget::At(Duration::ZERO)),
        "end" => Some(SeekTarget::End),
        _ => time(word).map(SeekTarget::At),
    }
}

/// A time in clock notation: `90`, `1:30`, `1:02:30.5`; plain seconds may have an `s`.
fn time(word: &str) -> Option<Duration> {
    let word = word.strip_suffix('s').unwrap_or(word);
    let mut seconds = 0.0;
    let parts: Vec<&str> = word.split(':').collect();
    if parts.len() > 3 {
        return None;
    }
    for (at, part) in parts.iter().enumerate() {
        let is_plain = part
            .bytes()
            .all(|byte| byte.is_ascii_digit() || byte == b'.');
        let value: f64 = part.parse().ok().filter(|_| is_plain)?;
        if at > 0 && value >= 60.0 {
            return None;
        }
        seconds = seconds * 60.0 + value;
    }
    Duration::try_from_secs_f64(seconds).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_read_as_clocks_show_them() {
        let known = [
            ("90", Some(90.0)),
            ("90s", Some(90.0)),
            ("1:30", Some(90.0)),
            ("0:0.5", Some(0.5)),
            ("1:02:30.5", Some(3750.5)),
            ("1:75", None),
            ("1:2:3:4", None),
            ("", None),
            ("-3", None),
            ("1e3", None),
        ];
        for (word, seconds) in known {
            assert_eq!(time(word).map(|it| it.as_secs_f64()), seconds, "{word}");
        }
        assert_eq!(
            seek_target("-5"),
            Some(SeekTarget::Earlier(Duration::from_secs(5)))
        );
        assert_eq!(seek_target("end"), Some(SeekTarget::End));
        let refusal = SeekTarget::Previous(MomentKind::Refusal);
        assert_eq!(seek_target("previous refusal"), Some(refusal));
        let elapsed = SeekTarget::Mission(Duration::from_secs(250));
        assert_eq!(seek_target("mission 4:10"), Some(elapsed));
        assert_eq!(seek_target("next meal"), None);
        assert_eq!(seek_target("soon"), None);
        let times = LoopTarget::Times {
            from: Duration::from_secs(70),
            to: Duration::from_secs(100),
        };
        assert_eq!(loop_target("1:10 1:40"), Some(times));
        let bookmarks = LoopTarget::Moments(MomentKind::Bookmark);
        assert_eq!(loop_target("bookmark"), Some(bookmarks));
        for words in ["1:40 1:10", "1:10", "1:10 1:40 2:00", "meal"] {
            assert_eq!(loop_target(words), None, "{words}");
        }
    }
}
