//! The list: missions by tier with the trainee's progress, then everything else.

use ratatui::buffer::Buffer;
use ratatui::text::Line;

use super::name;
use crate::app::State;
use crate::app::action::{Action, Step};
use crate::app::room::home::{HomeItem, items};
use crate::app::state::Career;
use crate::campaign::MissionStage;
use crate::config::Symbols;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, below, put, row_of, stars, width};

const TIERS: [&str; 4] = ["home-tier-0", "home-tier-1", "home-tier-2", "home-tier-3"];
/// The maximum number of items for which groups are separated by blank lines.
const FEW: usize = 12;
/// The width of the marks before a name, and of the best score after it, in columns.
const MARKS: usize = 4;
const BEST: usize = 10;
/// The meaning of the signs before missions.
const SIGNS: [(Sign, &str); 4] = [
    (Sign::Passed, "home-sign-passed"),
    (Sign::Next, "home-sign-next"),
    (Sign::Due, "home-sign-due"),
    (Sign::Locked, "home-sign-locked"),
];

/// The trainee's progress with a mission, most important first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sign {
    /// The mission is recommended next, and not passed yet.
    Next,
    /// The mission is passed, and a skill that it trains is due for review.
    Due,
    Passed,
    Locked,
    Open,
}

/// The width of the longest line, in columns.
pub(super) fn wanted_width(state: &State, look: &Look) -> u16 {
    let items = items(state).into_iter();
    let longest = items.map(|item| width(&listed(state, item, look))).max();
    (longest.unwrap_or(0) + MARKS + BEST) as u16
}

/// Draws the list with its cursor visible.
pub(super) fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let cursor = state.rooms().home().cursor();
    let lines = lines(state, panel.look);
    let cursor_line = lines.iter().position(|(at, _)| *at == Some(cursor));
    let inner = panel.focused("sortie", true, buffer);
    let rows = usize::from(inner.height);
    let middle = cursor_line.unwrap_or(0).saturating_sub(rows / 2);
    let first = middle.min(lines.len().saturating_sub(rows));
    let count = lines.len();
    panel.at(inner).mark_scroll(first, count, buffer);
    let items = items(state);
    for (row, (at, text)) in lines.into_iter().skip(first).take(rows).enumerate() {
        let row = row as u16;
        let Some(at) = at else {
            let heading = Line::styled(text, panel.style(Role::Muted));
            put(buffer, inner, row, &heading);
            continue;
        };
        let (line, role) = item_line(
            state,
            items[at],
            &text,
            at == cursor,
            panel.look,
            inner.width.into(),
        );
        put(buffer, inner, row, &Line::styled(line, panel.style(role)));
        let click = Action::Move(Step::Row(at));
        panel.look.hits.add(row_of(inner, row), click);
        if at == cursor {
            panel.at(row_of(inner, row)).mark_cursor(buffer);
        }
    }
    if state.training().career().is_some() && count + SIGNS.len() < rows {
        draw_signs(panel.at(below(inner, count as u16 + 1)), buffer);
    }
}

fn draw_signs(panel: Panel<'_>, buffer: &mut Buffer) {
    for (row, (sign, meaning)) in SIGNS.into_iter().enumerate() {
        let text = format!(
            "  {} {}",
            sign.symbol(panel.look.symbols),
            panel.say(meaning)
        );
        let line = Line::styled(text, panel.style(Role::Muted));
        put(buffer, panel.area, row as u16, &line);
    }
}

impl Sign {
    fn of(career: &Career, mission: &str) -> Self {
        let Some(offer) = career.course.offer(mission) else {
            return Self::Open;
        };
        match career.course.stage(offer, &career.standing, career.day) {
            MissionStage::Locked(_) => Self::Locked,
            MissionStage::Passed(_) if !career.due(offer).is_empty() => Self::Due,
            MissionStage::Passed(_) => Self::Passed,
            MissionStage::Open if career.next_mission() == Some(mission) => Self::Next,
            MissionStage::Open => Self::Open,
        }
    }

    /// Its sign in the list; in ASCII, an arrow would look like the cursor.
    fn symbol(self, symbols: Symbols) -> char {
        match self {
            Self::Next if symbols == Symbols::Ascii => '+',
            Self::Next => '→',
            Self::Due => '!',
            Self::Passed => '✓',
            Self::Locked => '×',
            Self::Open => ' ',
        }
    }

    /// The sign as a word, for locked and for recommended missions; `None` for others.
    fn word(self, look: &Look) -> Option<String> {
        let id = match self {
            Self::Locked => "home-locked",
            Self::Next => "home-is-next",
            Self::Due | Self::Passed | Self::Open => return None,
        };
        Some(format!(" {}", look.say(id)))
    }

    fn role(self) -> Role {
        match self {
            Self::Next => Role::Accent,
            Self::Due => Role::Warning,
            Self::Locked => Role::Locked,
            Self::Passed | Self::Open => Role::Text,
        }
    }
}

/// A line with an item: its cursor and sign, its name, and at the right the best score or the sign as a word.
fn item_line(
    state: &State,
    item: HomeItem,
    text: &str,
    under_cursor: bool,
    look: &Look,
    columns: usize,
) -> (String, Role) {
    let cursor = if under_cursor { '>' } else { ' ' };
    let (sign, score) = match (item, state.training().career()) {
        (HomeItem::Mission(at), Some(career)) => {
            let id = &state.training().missions()[at].id;
            (Some(Sign::of(career, id)), career_best(career, id))
        }
        (HomeItem::Mission(at), None) => (
            None,
            recorded_best(state, &state.training().missions()[at].id),
        ),
        (
            HomeItem::Free | HomeItem::ArduPilot | HomeItem::Connect | HomeItem::Quit,
            Some(_) | None,
        ) => (None, None),
    };
    let mark = sign.map_or(' ', |sign| sign.symbol(look.symbols));
    // The sign means the same as its word, so the name takes precedence over the word.
    let word = sign
        .and_then(|sign| sign.word(look))
        .filter(|word| MARKS + 1 + width(word) + width(text) <= columns);
    let best = score.or(word).unwrap_or_default();
    let room = columns.saturating_sub(MARKS + 1 + width(&best));
    let role = sign.map_or(Role::Text, Sign::role);
    let name = aligned(text, room, false);
    (format!("{cursor} {mark} {name}{best} "), role)
}

/// The best score of the flights that count, with its medal in stars.
fn career_best(career: &Career, mission: &str) -> Option<String> {
    let best = career.standing.best(mission)?;
    let score = best.score?;
    Some(format!(" {score:>4} {:<3}", stars(best.medal)))
}

/// The best recorded score of flights without a profile.
fn recorded_best(state: &State, mission: &str) -> Option<String> {
    let best = state.training().best_try(mission)?;
    let score = best.score?;
    Some(format!(" {score:>4} {:<3}", stars(best.medal)))
}

/// The lines of the list: items with their number, headings and blank lines without one.
fn lines(state: &State, look: &Look) -> Vec<(Option<usize>, String)> {
    let mut lines = Vec::new();
    let items = items(state);
    let tier = |item: &HomeItem| match item {
        HomeItem::Mission(at) => Some(state.training().missions()[*at].tier),
        HomeItem::Free | HomeItem::ArduPilot | HomeItem::Connect | HomeItem::Quit => None,
    };
    let (least, most) = (
        items.first().and_then(tier),
        items.iter().filter_map(tier).max(),
    );
    let mut before = None;
    for (at, &item) in items.iter().enumerate() {
        let heading = match (item, tier(&item)) {
            (_, Some(now)) if before == Some(now) => None,
            (_, Some(_)) if least == most => Some("home-missions"),
            (_, Some(now)) => Some(TIERS[usize::from(now).min(TIERS.len() - 1)]),
            (HomeItem::Free, None) => Some("home-others"),
            (
                HomeItem::ArduPilot | HomeItem::Connect | HomeItem::Quit | HomeItem::Mission(_),
                None,
            ) => None,
        };
        if let Some(heading) = heading {
            // In a long list, items take precedence over blank lines.
            if at > 0 && items.len() <= FEW {
                lines.push((None, String::new()));
            }
            lines.push((None, look.say(heading)));
        }
        lines.push((Some(at), listed(state, item, look)));
        before = tier(&item);
    }
    lines
}

/// The label of an item; for a mission, with the number that `fly` takes.
fn listed(state: &State, item: HomeItem, look: &Look) -> String {
    let name = name(state, item, look);
    let HomeItem::Mission(at) = item else {
        return name;
    };
    let number = state.training().missions()[at]
        .id
        .split('-')
        .next()
        .unwrap_or_default();
    if number.is_empty() || !number.chars().all(|c| c.is_ascii_digit()) {
        return name;
    }
    format!("{number} {name}")
}
