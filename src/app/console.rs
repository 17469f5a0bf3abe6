//! What the command line can do besides commanding vehicles: a small table beside the verbs.

use std::ops::Range;

use super::effect::HangarDeed;
use super::room_list::Room;
use super::setting::Setting;
use crate::diagnostic::Diagnostic;
use crate::mission;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

mod offer;
pub mod swarm;

pub use offer::{Names, complete, last_word, lines};
use swarm::{SwarmLine, SwarmVerb};

/// One thing the console itself can do. The message `console-NAME` says what it does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ConsoleVerb {
    /// How it is called.
    pub name: &'static str,
    /// How it is written.
    pub usage: &'static str,
    kind: Kind,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Select,
    Group,
    Theme,
    Params,
    Hangar,
    Swarm(SwarmVerb),
    Show,
    Fly,
    Connect,
    Inject,
    Macro,
    Set,
    Plain(Deed),
}

impl ConsoleVerb {
    /// What it does.
    pub fn summary(&self) -> Text {
        Text::new(format!("console-{}", self.name), Vec::new())
    }
}

impl Kind {
    /// How many words may follow.
    fn most_arguments(self) -> usize {
        match self {
            Self::Plain(_) => 0,
            Self::Group | Self::Set | Self::Hangar => 2,
            Self::Connect | Self::Params | Self::Swarm(SwarmVerb::Filter | SwarmVerb::Columns) => {
                usize::MAX
            }
            Self::Select
            | Self::Theme
            | Self::Show
            | Self::Fly
            | Self::Inject
            | Self::Macro
            | Self::Swarm(_) => 1,
        }
    }
}

/// A line that the console carries out itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ConsoleLine {
    /// Select these vehicles.
    Select(String),
    /// Give vehicles a group's name; no targets means the selection.
    Group {
        /// The name, without `@`.
        name: String,
        /// The targets as they were written.
        targets: String,
    },
    /// Go to a room.
    Show(Room),
    /// Start a mission, by id; none starts free flight.
    Fly(Option<String>),
    /// Connect to these addresses.
    Connect(Vec<String>),
    /// Have something happen in the mission.
    Inject(String),
    /// Give the lines of a macro.
    Macro(String),
    /// Change a setting for this session.
    Set(Setting),
    /// Something about the parameters of the vehicle under the cursor.
    Params(ParamsDeed),
    /// Shows the hangar, or has the process of a vehicle ended or started again.
    Hangar(Option<(HangarDeed, VehicleId)>),
    /// One about the table or its alerts.
    Swarm(SwarmLine),
    /// One without arguments.
    Plain(Deed),
}

/// What the console does with parameters.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ParamsDeed {
    /// Shows them.
    Show,
    /// Asks the vehicle for all of them again.
    Fetch,
    /// Saves them to a file.
    Save(String),
    /// Loads a file, or compares with one or with another vehicle: first the differences show.
    Compare(String),
}

/// Console lines without arguments.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Deed {
    /// Help.
    Help,
    /// The links' counters.
    Links,
    /// All commands.
    Ledger,
    /// All notices.
    Notices,
    /// The mission's brief.
    Brief,
    /// Let the session stand still.
    Pause,
    /// Let it go on.
    GoOn,
    /// End the mission.
    Abandon,
    /// The same mission again.
    Restart,
    /// Back to the home screen.
    Leave,
    /// Leave the program.
    Quit,
}

/// What can be done with a vehicle's process.
const HANGAR_DEEDS: [(&str, HangarDeed); 2] =
    [("restart", HangarDeed::Restart), ("stop", HangarDeed::Stop)];

/// Everything the console itself can do.
pub const CONSOLE_VERBS: &[ConsoleVerb] = &[
    verb("show", "show ROOM", Kind::Show),
    verb("select", "select TARGETS", Kind::Select),
    verb("group", "group NAME [TARGETS]", Kind::Group),
    verb("ungroup", "ungroup NAME", Kind::Swarm(SwarmVerb::Ungroup)),
    verb("sort", "sort [[-]COLUMN]", Kind::Swarm(SwarmVerb::Sort)),
    verb("filter", "filter [WORDS]", Kind::Swarm(SwarmVerb::Filter)),
    verb(
        "columns",
        "columns [COLUMNS]",
        Kind::Swarm(SwarmVerb::Columns),
    ),
    verb(
        "ack",
        "ack [KIND|TARGETS]",
        Kind::Swarm(SwarmVerb::Acknowledge),
    ),
    verb("mute", "mute [KIND]", Kind::Swarm(SwarmVerb::Mute)),
    verb("unmute", "unmute [KIND]", Kind::Swarm(SwarmVerb::Unmute)),
    verb(
        "params",
        "params [fetch | save FILE | load FILE | diff FILE|N]",
        Kind::Params,
    ),
    verb("hangar", "hangar [restart N | stop N]", Kind::Hangar),
    verb("macro", "macro NAME", Kind::Macro),
    verb("fly", "fly [MISSION]", Kind::Fly),
    verb("connect", "connect ADDRESS...", Kind::Connect),
    verb("set", "set NAME VALUE", Kind::Set),
    verb("theme", "theme NAME", Kind::Theme),
    verb("help", "help", Kind::Plain(Deed::Help)),
    verb("links", "links", Kind::Plain(Deed::Links)),
    verb("ledger", "ledger", Kind::Plain(Deed::Ledger)),
    verb("notices", "notices", Kind::Plain(Deed::Notices)),
    verb("brief", "brief", Kind::Plain(Deed::Brief)),
    verb("inject", "inject NAME", Kind::Inject),
    verb("pause", "pause", Kind::Plain(Deed::Pause)),
    verb("continue", "continue", Kind::Plain(Deed::GoOn)),
    verb("abandon", "abandon", Kind::Plain(Deed::Abandon)),
    verb("restart", "restart", Kind::Plain(Deed::Restart)),
    verb("leave", "leave", Kind::Plain(Deed::Leave)),
    verb("quit", "quit", Kind::Plain(Deed::Quit)),
];

const fn verb(name: &'static str, usage: &'static str, kind: Kind) -> ConsoleVerb {
    ConsoleVerb { name, usage, kind }
}

/// Reads a line that is the console's own; `None` if it is not, so that the grammar of commands may try.
pub fn parse(line: &str, names: &Names<'_>) -> Option<Result<ConsoleLine, Diagnostic>> {
    let words = words(line);
    let (first, arguments) = words.split_first()?;
    let verb = find(&line[first.clone()])?;
    Some(read(verb, line, arguments, names))
}

/// The usage of the console's own verb that a line begins with.
pub fn usage(line: &str) -> Option<&'static str> {
    let words = words(line);
    find(&line[words.first()?.clone()]).map(|verb| verb.usage)
}

fn find(word: &str) -> Option<&'static ConsoleVerb> {
    CONSOLE_VERBS.iter().find(|verb| verb.name == word)
}

/// Where the words of a line lie.
fn words(line: &str) -> Vec<Range<usize>> {
    line.split_whitespace()
        .map(|word| {
            let start = word.as_ptr().addr() - line.as_ptr().addr();
            start..start + word.len()
        })
        .collect()
}

fn read(
    verb: &ConsoleVerb,
    line: &str,
    arguments: &[Range<usize>],
    names: &Names<'_>,
) -> Result<ConsoleLine, Diagnostic> {
    if let Some(extra) = arguments.get(verb.kind.most_arguments()) {
        return Err(Diagnostic::new(extra.clone(), text!("console-too-much"))
            .with_help(text!("console-usage", usage = verb.usage)));
    }
    let given: Vec<&str> = arguments.iter().map(|span| &line[span.clone()]).collect();
    let end = line.trim_end().len();
    let word = |at: usize| {
        given.get(at).copied().ok_or_else(|| {
            Diagnostic::new(end..end, text!("console-missing"))
                .with_help(text!("console-usage", usage = verb.usage))
        })
    };
    // A word that has to be one of those that could follow.
    let known = |at: usize| {
        let written = word(at)?;
        let before = &given[..at];
        let could: Vec<&str> = names
            .following(verb.kind, before)
            .into_iter()
            .map(|(name, _)| name)
            .collect();
        if could.contains(&written) {
            return Ok(written);
        }
        let fault = Diagnostic::new(
            arguments[at].clone(),
            text!("console-unknown", word = written),
        );
        let help = if could.is_empty() {
            text!("console-none")
        } else {
            text!("console-known", names = could.join(", "))
        };
        Err(fault.with_help(help).with_nearest(written, could))
    };
    match verb.kind {
        Kind::Plain(deed) => Ok(ConsoleLine::Plain(deed)),
        Kind::Params => params(verb, line, arguments).map(ConsoleLine::Params),
        Kind::Swarm(swarm) => {
            if swarm == SwarmVerb::Ungroup {
                word(0)?;
            }
            let words = arguments.iter().cloned();
            let words: Vec<_> = words.map(|span| (&line[span.clone()], span)).collect();
            swarm::read(swarm, &words).map(ConsoleLine::Swarm)
        }
        Kind::Hangar if given.is_empty() => Ok(ConsoleLine::Hangar(None)),
        Kind::Hangar => {
            let name = known(0)?;
            let (_, deed) = HANGAR_DEEDS[usize::from(name != HANGAR_DEEDS[0].0)];
            let vehicle = word(1)?.parse().map_err(|_| {
                Diagnostic::new(arguments[1].clone(), text!("hangar-which"))
                    .with_help(text!("console-usage", usage = verb.usage))
            })?;
            Ok(ConsoleLine::Hangar(Some((deed, vehicle))))
        }
        Kind::Select => word(0).map(|targets| ConsoleLine::Select(targets.to_owned())),
        Kind::Group => Ok(ConsoleLine::Group {
            name: word(0)?.trim_start_matches('@').to_owned(),
            targets: given.get(1).copied().unwrap_or_default().to_owned(),
        }),
        Kind::Show => known(0)
            .map(|name| Room::named(name).unwrap_or_default())
            .map(ConsoleLine::Show),
        Kind::Fly if given.is_empty() => Ok(ConsoleLine::Fly(None)),
        Kind::Fly => {
            let ids: Vec<&str> = names.missions.iter().map(|it| it.id.as_str()).collect();
            let id = mission::meant(given[0], &ids).map_or_else(|| known(0), Ok)?;
            Ok(ConsoleLine::Fly(Some(id.to_owned())))
        }
        Kind::Connect => {
            word(0)?;
            let addresses = given.iter().map(|word| (*word).to_owned()).collect();
            Ok(ConsoleLine::Connect(addresses))
        }
        Kind::Inject if names.injects.is_none_or(<[_]>::is_empty) => {
            let why = match names.injects {
                Some(_) => text!("console-no-injects"),
                None => text!("console-no-mission"),
            };
            // The verb itself is what is wrong here, whatever may follow.
            let start = line.len() - line.trim_start().len();
            Err(Diagnostic::new(start..start + verb.name.len(), why))
        }
        Kind::Inject => known(0).map(|name| ConsoleLine::Inject(name.to_owned())),
        Kind::Macro => known(0).map(|name| ConsoleLine::Macro(name.to_owned())),
        Kind::Theme => known(0).map(|name| ConsoleLine::Set(Setting::Theme(name.to_owned()))),
        Kind::Set => {
            let name = known(0)?;
            let value = match name {
                "fps" => word(1)?,
                _ => known(1)?,
            };
            Setting::read(name, value)
                .map(ConsoleLine::Set)
                .map_err(|text| Diagnostic::new(arguments[1].clone(), text))
        }
    }
}

/// The rest of the line after the second word is the file's name, which may have blanks in it.
fn params(
    verb: &ConsoleVerb,
    line: &str,
    arguments: &[Range<usize>],
) -> Result<ParamsDeed, Diagnostic> {
    let [deed, rest @ ..] = arguments else {
        return Ok(ParamsDeed::Show);
    };
    let usage = text!("console-usage", usage = verb.usage);
    let named = || {
        if let (Some(first), Some(last)) = (rest.first(), rest.last()) {
            return Ok(line[first.start..last.end].to_owned());
        }
        let end = line.trim_end().len();
        Err(Diagnostic::new(end..end, text!("parameters-no-path")).with_help(usage.clone()))
    };
    match &line[deed.clone()] {
        "fetch" if rest.is_empty() => Ok(ParamsDeed::Fetch),
        "save" => named().map(ParamsDeed::Save),
        "load" | "diff" => named().map(ParamsDeed::Compare),
        word => {
            let unknown = text!("parameters-no-deed", word = word);
            Err(Diagnostic::new(deed.clone(), unknown).with_help(usage))
        }
    }
}

#[cfg(test)]
mod tests;
