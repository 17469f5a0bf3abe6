//! The table of what the console itself can do: everything about a verb stands in its row.

use super::following;
use super::offer::Names;
use super::reader::LineReader;
use super::swarm;
use super::{BareLine, ConsoleLine, ParamsDeed};
use crate::app::effect::HangarDeed;
use crate::app::room_list::Room;
use crate::app::setting::Setting;
use crate::diagnostic::Diagnostic;
use crate::mission;
use crate::text;
use crate::text::Text;

/// Offers the words that may come after those before, each with its meaning.
type FollowingWords = for<'n> fn(&Names<'n>, &[&str]) -> Vec<(&'n str, Text)>;

/// One thing the console itself can do. The message `console-NAME` says what it does.
#[derive(Debug, Clone, Copy)]
pub struct ConsoleVerb {
    /// How it is called.
    pub name: &'static str,
    /// How it is written.
    pub usage: &'static str,
    /// How many words may follow.
    pub(super) most_words: usize,
    /// What a line with it means.
    pub(super) read: fn(&LineReader<'_>) -> Result<ConsoleLine, Diagnostic>,
    /// The words that could follow those before, with what each means.
    pub(super) following: FollowingWords,
    pub(super) offered: Offered,
    pub(super) in_plain: InPlain,
}

impl ConsoleVerb {
    pub fn summary(&self) -> Text {
        Text::new(format!("console-{}", self.name), Vec::new())
    }
}

/// Which whole lines the command line offers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Offered {
    None,
    Alone,
    /// The verb with each word that could follow.
    Words,
    /// The verb with each word that could follow, and each that could follow that.
    Pairs,
}

/// What a verb does in the console without a screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InPlain {
    /// The same as on a screen.
    Same,
    /// Without further words, what it would show is said.
    Says(PlainAnswer),
    /// Nothing: it is about the screen.
    NoRoom,
}

/// What the console without a screen can say.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlainAnswer {
    Status,
    /// How the mission stands.
    Objectives,
    /// What detectors have found.
    Contacts,
    /// What can be said.
    Help,
    Links,
    Ledger,
    Notices,
    Hangar,
    Brief,
}

/// Verbs that only the console without a screen has.
const PLAIN_ONLY: [(&str, PlainAnswer); 4] = [
    ("status", PlainAnswer::Status),
    ("objectives", PlainAnswer::Objectives),
    ("contacts", PlainAnswer::Contacts),
    ("commands", PlainAnswer::Ledger),
];

/// What a line does in the console without a screen, and the words after its verb.
pub fn in_plain(line: &str) -> (InPlain, &str) {
    let (verb, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
    let only = PLAIN_ONLY.iter().find(|(name, _)| *name == verb);
    let meaning = match (only, find(verb)) {
        (Some((_, report)), _) => InPlain::Says(*report),
        (None, Some(row)) => row.in_plain,
        (None, None) => InPlain::Same,
    };
    let rest = rest.trim();
    match meaning {
        InPlain::Says(PlainAnswer::Status) => (meaning, rest),
        InPlain::Says(_) if !rest.is_empty() => (InPlain::Same, rest),
        InPlain::Says(_) | InPlain::Same | InPlain::NoRoom => (meaning, rest),
    }
}

pub(super) fn find(word: &str) -> Option<&'static ConsoleVerb> {
    CONSOLE_VERBS.iter().find(|verb| verb.name == word)
}

/// What can be done with a vehicle's process.
pub(super) const HANGAR_DEEDS: [(&str, HangarDeed); 2] =
    [("restart", HangarDeed::Restart), ("stop", HangarDeed::Stop)];

/// Everything the console itself can do.
pub const CONSOLE_VERBS: &[ConsoleVerb] = &[
    ConsoleVerb {
        name: "show",
        usage: "show ROOM",
        most_words: 1,
        read: |line| {
            let room = Room::named(line.known(0)?).unwrap_or_default();
            Ok(ConsoleLine::Show(room))
        },
        following: following::rooms,
        offered: Offered::Words,
        in_plain: InPlain::NoRoom,
    },
    ConsoleVerb {
        name: "select",
        usage: "select TARGETS",
        most_words: 1,
        read: |line| Ok(ConsoleLine::Select(line.required(0)?.to_owned())),
        following: following::nothing,
        offered: Offered::None,
        in_plain: InPlain::Same,
    },
    ConsoleVerb {
        name: "group",
        usage: "group NAME [TARGETS]",
        most_words: 2,
        read: |line| {
            Ok(ConsoleLine::Group {
                name: line.required(0)?.trim_start_matches('@').to_owned(),
                targets: line.word(1).unwrap_or_default().to_owned(),
            })
        },
        following: following::groups,
        offered: Offered::None,
        in_plain: InPlain::Same,
    },
    ConsoleVerb {
        name: "ungroup",
        usage: "ungroup NAME",
        most_words: 1,
        read: |line| Ok(ConsoleLine::Swarm(swarm::ungroup(line.required(0)?))),
        following: following::nothing,
        offered: Offered::None,
        in_plain: InPlain::Same,
    },
    ConsoleVerb {
        name: "sort",
        usage: "sort [[-]COLUMN]",
        most_words: 1,
        read: |line| swarm::sort(line.first()).map(ConsoleLine::Swarm),
        following: following::columns,
        offered: Offered::Words,
        in_plain: InPlain::NoRoom,
    },
    ConsoleVerb {
        name: "filter",
        usage: "filter [WORDS]",
        most_words: usize::MAX,
        read: |line| {
            Ok(ConsoleLine::Swarm(swarm::filter(
                line.rest(0).unwrap_or_default(),
            )))
        },
        following: following::nothing,
        offered: Offered::None,
        in_plain: InPlain::NoRoom,
    },
    ConsoleVerb {
        name: "columns",
        usage: "columns [COLUMNS]",
        most_words: usize::MAX,
        read: |line| swarm::columns(line.words()).map(ConsoleLine::Swarm),
        following: following::columns,
        offered: Offered::Words,
        in_plain: InPlain::NoRoom,
    },
    ConsoleVerb {
        name: "ack",
        usage: "ack [KIND|TARGETS]",
        most_words: 1,
        read: |line| swarm::acknowledge(line.first()).map(ConsoleLine::Swarm),
        following: following::alerts,
        offered: Offered::Words,
        in_plain: InPlain::Same,
    },
    ConsoleVerb {
        name: "mute",
        usage: "mute [KIND]",
        most_words: 1,
        read: |line| swarm::mute(line.first()).map(ConsoleLine::Swarm),
        following: following::alerts,
        offered: Offered::Words,
        in_plain: InPlain::Same,
    },
    ConsoleVerb {
        name: "unmute",
        usage: "unmute [KIND]",
        most_words: 1,
        read: |line| swarm::unmute(line.first()).map(ConsoleLine::Swarm),
        following: following::alerts,
        offered: Offered::Words,
        in_plain: InPlain::Same,
    },
    ConsoleVerb {
        name: "params",
        usage: "params [fetch | save FILE | load FILE | diff FILE|N]",
        most_words: usize::MAX,
        read: |line| params(line).map(ConsoleLine::Params),
        following: following::params,
        offered: Offered::None,
        in_plain: InPlain::NoRoom,
    },
    ConsoleVerb {
        name: "hangar",
        usage: "hangar [restart N | stop N]",
        most_words: 2,
        read: hangar,
        following: following::processes,
        offered: Offered::None,
        in_plain: InPlain::Says(PlainAnswer::Hangar),
    },
    ConsoleVerb {
        name: "macro",
        usage: "macro NAME",
        most_words: 1,
        read: |line| Ok(ConsoleLine::Macro(line.known(0)?.to_owned())),
        following: following::macros,
        offered: Offered::Words,
        in_plain: InPlain::Same,
    },
    ConsoleVerb {
        name: "fly",
        usage: "fly [MISSION]",
        most_words: 1,
        read: fly,
        following: following::missions,
        offered: Offered::Words,
        in_plain: InPlain::Same,
    },
    ConsoleVerb {
        name: "connect",
        usage: "connect ADDRESS...",
        most_words: usize::MAX,
        read: |line| {
            line.required(0)?;
            let addresses = line.rest(0).unwrap_or_default().split_whitespace();
            let addresses = addresses.map(str::to_owned).collect();
            Ok(ConsoleLine::Connect(addresses))
        },
        following: following::nothing,
        offered: Offered::None,
        in_plain: InPlain::Same,
    },
    ConsoleVerb {
        name: "set",
        usage: "set NAME VALUE",
        most_words: 2,
        read: set,
        following: following::settings,
        offered: Offered::Pairs,
        in_plain: InPlain::Same,
    },
    ConsoleVerb {
        name: "theme",
        usage: "theme NAME",
        most_words: 1,
        read: |line| {
            let theme = line.known(0)?.to_owned();
            Ok(ConsoleLine::Set(Setting::Theme(theme)))
        },
        following: following::themes,
        // The same as `set theme`.
        offered: Offered::None,
        in_plain: InPlain::NoRoom,
    },
    bare(
        "help",
        |_| Ok(ConsoleLine::Bare(BareLine::Help)),
        InPlain::Says(PlainAnswer::Help),
    ),
    bare(
        "links",
        |_| Ok(ConsoleLine::Bare(BareLine::Links)),
        InPlain::Says(PlainAnswer::Links),
    ),
    bare(
        "ledger",
        |_| Ok(ConsoleLine::Bare(BareLine::Ledger)),
        InPlain::Says(PlainAnswer::Ledger),
    ),
    bare(
        "notices",
        |_| Ok(ConsoleLine::Bare(BareLine::Notices)),
        InPlain::Says(PlainAnswer::Notices),
    ),
    bare(
        "brief",
        |_| Ok(ConsoleLine::Bare(BareLine::Brief)),
        InPlain::Says(PlainAnswer::Brief),
    ),
    ConsoleVerb {
        name: "inject",
        usage: "inject NAME",
        most_words: 1,
        read: inject,
        following: following::injects,
        offered: Offered::Words,
        in_plain: InPlain::Same,
    },
    bare(
        "pause",
        |_| Ok(ConsoleLine::Bare(BareLine::Pause)),
        InPlain::Same,
    ),
    bare(
        "continue",
        |_| Ok(ConsoleLine::Bare(BareLine::Continue)),
        InPlain::Same,
    ),
    bare(
        "abandon",
        |_| Ok(ConsoleLine::Bare(BareLine::Abandon)),
        InPlain::Same,
    ),
    bare(
        "restart",
        |_| Ok(ConsoleLine::Bare(BareLine::Restart)),
        InPlain::Same,
    ),
    bare(
        "leave",
        |_| Ok(ConsoleLine::Bare(BareLine::Leave)),
        InPlain::Same,
    ),
    bare(
        "quit",
        |_| Ok(ConsoleLine::Bare(BareLine::Quit)),
        InPlain::Same,
    ),
];

/// A verb that no word follows.
const fn bare(
    name: &'static str,
    read: fn(&LineReader<'_>) -> Result<ConsoleLine, Diagnostic>,
    in_plain: InPlain,
) -> ConsoleVerb {
    ConsoleVerb {
        name,
        usage: name,
        most_words: 0,
        read,
        following: following::nothing,
        offered: Offered::Alone,
        in_plain,
    }
}

fn hangar(line: &LineReader<'_>) -> Result<ConsoleLine, Diagnostic> {
    if line.words().is_empty() {
        return Ok(ConsoleLine::Hangar(None));
    }
    let name = line.known(0)?;
    let (_, deed) = HANGAR_DEEDS[usize::from(name != HANGAR_DEEDS[0].0)];
    let vehicle = line.required(1)?.parse();
    let vehicle = vehicle.map_err(|_| line.wrong(1, text!("hangar-which")))?;
    Ok(ConsoleLine::Hangar(Some((deed, vehicle))))
}

fn fly(line: &LineReader<'_>) -> Result<ConsoleLine, Diagnostic> {
    let Some(written) = line.word(0) else {
        return Ok(ConsoleLine::Fly(None));
    };
    let missions = line.names.missions.iter();
    let ids: Vec<&str> = missions.map(|it| it.id.as_str()).collect();
    let id = mission::meant(written, &ids).map_or_else(|| line.known(0), Ok)?;
    Ok(ConsoleLine::Fly(Some(id.to_owned())))
}

fn inject(line: &LineReader<'_>) -> Result<ConsoleLine, Diagnostic> {
    let why = match line.names.injects {
        Some(injects) if !injects.is_empty() => {
            return Ok(ConsoleLine::Inject(line.known(0)?.to_owned()));
        }
        Some(_) => text!("console-no-injects"),
        None => text!("console-no-mission"),
    };
    // The verb itself is what is wrong here, whatever may follow.
    Err(Diagnostic::new(line.verb_span.clone(), why))
}

fn set(line: &LineReader<'_>) -> Result<ConsoleLine, Diagnostic> {
    let name = line.known(0)?;
    let value = match name {
        "fps" => line.required(1)?,
        _ => line.known(1)?,
    };
    Setting::read(name, value)
        .map(ConsoleLine::Set)
        .map_err(|text| Diagnostic::new(line.words()[1].span.clone(), text))
}

/// The rest of the line after the second word is the file's name, which may have blanks in it.
fn params(line: &LineReader<'_>) -> Result<ParamsDeed, Diagnostic> {
    let Some(deed) = line.word(0) else {
        return Ok(ParamsDeed::Show);
    };
    let named = || {
        let rest = line.rest(1).map(str::to_owned);
        rest.ok_or_else(|| line.missing(text!("parameters-no-path")))
    };
    match deed {
        "fetch" if line.words().len() == 1 => Ok(ParamsDeed::Fetch),
        "save" => named().map(ParamsDeed::Save),
        "load" | "diff" => named().map(ParamsDeed::Compare),
        word => Err(line.wrong(0, text!("parameters-no-deed", word = word))),
    }
}
