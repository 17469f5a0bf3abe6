//! Fire as a field: burnt ground as last seen, and the flames that sensors see. Dozens of labels in a row would hide
//! the fire itself.

use std::collections::BTreeMap;

use ratatui::buffer::Buffer;
use ratatui::style::Modifier;
use ratatui::text::{Line, Span};

use super::labels::{self, MapCell};
use super::squares;
use crate::app::State;
use crate::commands::FindKind;
use crate::config::Symbols;
use crate::geo::Viewport;
use crate::mission::{Progress, ShownContact, Trust};
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;

/// The width of the burning area around a contact, in metres: about the size that a thermal camera sees as one fire.
const FLAMES_M: f64 = 20.0;

/// The strength of fire in a cell of the map, weakest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum FireLevel {
    /// Less than 60 % of the cell has burnt.
    Scorched,
    /// At least 60 % of the cell has burnt.
    Burnt,
    /// One kind of sensor sees flames.
    Flames,
    /// Two kinds of sensors see flames, or the flames were reported.
    SureFlames,
}

impl FireLevel {
    const ALL: [Self; 4] = [Self::Scorched, Self::Burnt, Self::Flames, Self::SureFlames];

    const fn sign(self, symbols: Symbols) -> char {
        match symbols {
            Symbols::Braille | Symbols::Block => match self {
                Self::Scorched => '░',
                Self::Burnt => '▒',
                Self::Flames => '▓',
                Self::SureFlames => '█',
            },
            Symbols::Ascii => match self {
                Self::Scorched => '"',
                Self::Burnt => '%',
                Self::Flames => '^',
                Self::SureFlames => '$',
            },
        }
    }

    /// The message that explains the level.
    const fn about(self) -> &'static str {
        match self {
            Self::Scorched => "map-fire-scorched",
            Self::Burnt => "map-fire-burnt",
            Self::Flames => "map-fire-flames",
            Self::SureFlames => "map-fire-sure",
        }
    }
}

/// The sign of ground that burns, or has burnt, and its meaning, for the map of the truth.
pub fn truth_sign(burns: bool, symbols: Symbols) -> (char, &'static str) {
    if burns {
        (FireLevel::SureFlames.sign(symbols), "truth-burning")
    } else {
        (FireLevel::Burnt.sign(symbols), FireLevel::Burnt.about())
    }
}

/// The shades for the legend, weakest first.
pub fn sample(symbols: Symbols) -> String {
    FireLevel::ALL
        .map(|level| level.sign(symbols))
        .into_iter()
        .collect()
}

/// The role of fire: danger, unless the theme marks danger by the background, which would invert the shades.
pub fn role(look: &Look) -> Role {
    let (danger, text) = (look.style(Role::Danger), look.style(Role::Text));
    let is_ground = danger.bg.is_some_and(|ground| Some(ground) != text.bg);
    if is_ground || danger.add_modifier.contains(Modifier::REVERSED) {
        Role::Hazard
    } else {
        Role::Danger
    }
}

/// Whether a contact is a fire: the map shows fires as a field, without names.
pub fn is_fire(contact: &ShownContact) -> bool {
    contact.kind == FindKind::Fire
}

/// Whether any fire or burnt ground is known.
pub fn is_any(state: &State) -> bool {
    let progress = state.session().mission();
    progress.is_some_and(|it| !it.mapped.is_empty() || it.contacts.iter().any(is_fire))
}

pub fn draw(state: &State, view: &Viewport, panel: Panel<'_>, buffer: &mut Buffer) {
    let Some(progress) = state.session().mission() else {
        return;
    };
    let style = panel.look.fill(role(panel.look));
    for (cell, level) in levels(progress, view) {
        let sign = level.sign(panel.look.symbols);
        squares::fill(cell, sign, style, panel, buffer);
    }
}

fn levels(progress: &Progress, view: &Viewport) -> BTreeMap<MapCell, FireLevel> {
    let mut shares: BTreeMap<MapCell, f64> = BTreeMap::new();
    for ground in &progress.mapped {
        let share = squares::share_of_cell(view, ground.side_m);
        for cell in squares::cells(view, ground.centre, ground.side_m) {
            *shares.entry(cell).or_default() += share;
        }
    }
    let burnt = |share: f64| match share {
        share if share < 0.6 => FireLevel::Scorched,
        _ => FireLevel::Burnt,
    };
    let mut levels: BTreeMap<MapCell, FireLevel> = shares
        .into_iter()
        .map(|(cell, share)| (cell, burnt(share)))
        .collect();
    for contact in progress.contacts.iter().filter(|it| is_fire(it)) {
        let level = match contact.trust {
            Trust::Harmless | Trust::Seen => FireLevel::Flames,
            Trust::Confirmed | Trust::Reported => FireLevel::SureFlames,
        };
        for cell in squares::cells(view, contact.at, FLAMES_M) {
            let known = levels.entry(cell).or_insert(level);
            *known = level.max(*known);
        }
    }
    levels
}

/// Explains the shades that are on the map, at the right end of a row.
pub fn draw_scale(state: &State, view: &Viewport, panel: Panel<'_>, buffer: &mut Buffer) {
    let Some(progress) = state.session().mission() else {
        return;
    };
    let levels = levels(progress, view);
    let muted = panel.style(Role::Muted);
    let mut spans = vec![Span::styled(format!(" {} ", panel.say("map-fire")), muted)];
    for level in FireLevel::ALL {
        if levels.values().any(|it| *it == level) {
            let sign = level.sign(panel.look.symbols);
            spans.push(Span::styled(
                sign.to_string(),
                panel.style(role(panel.look)),
            ));
            spans.push(Span::styled(
                format!(" {}  ", panel.say(level.about())),
                muted,
            ));
        }
    }
    labels::stamp_right(&Line::from(spans), panel, buffer);
}
