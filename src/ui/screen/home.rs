//! The home screen: what there is to do, and what it is about.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::app::room::home::{HomeItem, drill, items};
use crate::app::state::{Room, State};
use crate::scoring::Medal;
use crate::text;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, below, columns, put, reflow, row_of, titled, wrap};

/// Columns of the list.
const LIST_WIDTH: u16 = 34;
/// Columns of the text at most: longer lines are hard to read.
const TEXT_WIDTH: u16 = 88;

/// Headings of the missions by difficulty.
const TIERS: [&str; 4] = ["home-tier-0", "home-tier-1", "home-tier-2", "home-tier-3"];
/// Up to so many lines are set apart by blank ones.
const FEW: usize = 12;

/// Lines that can be given as they stand, up to the one that takes a while.
const FIRST_CLIMB: [&str; 3] = ["all guided", "all arm", "all takeoff 20"];
/// Lines that can be given once the drones are up.
const FIRST_FLIGHT: [&str; 2] = ["all goto by n 50", "all rtl"];

/// Draws the list with its cursor, and a text about the line under it.
pub fn draw(state: &State, look: &Look, area: Rect, buffer: &mut Buffer) {
    let cursor = state.rooms.home.cursor;
    let mut area = below(area, 1);
    if let Some(activity) = &state.session.activity {
        let running = text!(
            "home-running",
            session = activity.title(),
            key = Room::Fly.key()
        );
        let line = format!(" {}", look.text(&running));
        put(
            buffer,
            area,
            0,
            &Line::styled(line, look.style(Role::Accent)),
        );
        area = below(area, 2);
    }
    draw_list(state, cursor, look, columns(area, 1, LIST_WIDTH), buffer);
    let width = area.width.saturating_sub(LIST_WIDTH + 4).min(TEXT_WIDTH);
    draw_about(
        state,
        cursor,
        look,
        columns(area, LIST_WIDTH + 3, width),
        buffer,
    );
}

fn draw_list(state: &State, cursor: usize, look: &Look, area: Rect, buffer: &mut Buffer) {
    let lines = list(state, look);
    let cursor_line = lines.iter().position(|(at, _)| *at == Some(cursor));
    let inner = titled("sortie", look, area, buffer);
    let rows = usize::from(inner.height);
    let middle = cursor_line.unwrap_or(0).saturating_sub(rows / 2);
    let first = middle.min(lines.len().saturating_sub(rows));
    for (row, (at, text)) in lines.into_iter().skip(first).take(rows).enumerate() {
        let row = row as u16;
        let under_cursor = at == Some(cursor);
        let line = if at.is_some() {
            let mark = if under_cursor { '>' } else { ' ' };
            let best = at.map_or(String::new(), |at| best(state, items(state)[at]));
            let room = usize::from(inner.width).saturating_sub(3 + best.len());
            let text = aligned(&text, room, false);
            Line::raw(format!("{mark} {text}{best}"))
        } else {
            Line::styled(text, look.style(Role::Muted))
        };
        put(buffer, inner, row, &line);
        if under_cursor {
            buffer.set_style(row_of(inner, row), look.style(Role::Cursor));
        }
    }
}

/// The best score at a mission, and its medal in stars: three are gold.
fn best(state: &State, item: HomeItem) -> String {
    let HomeItem::Mission(at) = item else {
        return String::new();
    };
    let best = state.best_try(&state.missions[at].id);
    let best = best.and_then(|best| Some((best.score?, best.medal)));
    best.map_or(String::new(), |(score, medal)| {
        format!(" {score:>4} {:<3}", stars(medal))
    })
}

fn stars(medal: Option<Medal>) -> &'static str {
    match medal {
        Some(Medal::Gold) => "***",
        Some(Medal::Silver) => "**",
        Some(Medal::Bronze) => "*",
        None => "",
    }
}

/// The lines of the list: items with their number, headings and blanks without.
fn list(state: &State, look: &Look) -> Vec<(Option<usize>, String)> {
    let mut lines = Vec::new();
    let items = items(state);
    let tier = |item: &HomeItem| match item {
        HomeItem::Mission(at) => Some(state.missions[*at].tier),
        _ => None,
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
            (HomeItem::Free, _) => Some("home-others"),
            _ => None,
        };
        if let Some(heading) = heading {
            // A blank line is worth less than a line of a long list.
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

fn draw_about(state: &State, cursor: usize, look: &Look, area: Rect, buffer: &mut Buffer) {
    let Some(item) = items(state).get(cursor).copied() else {
        return;
    };
    let inner = titled(&name(state, item, look), look, area, buffer);
    let text = about(state, item, look);
    let mut row = 0;
    for line in wrap(&reflow(&text), usize::from(inner.width)) {
        put(buffer, inner, row, &Line::raw(line));
        row += 1;
    }
    if let Some(best) = best_words(state, item) {
        let line = Line::styled(look.text(&best), look.style(Role::Accent));
        put(buffer, inner, row + 1, &line);
        row += 2;
    }
    let mut keys = vec![("Enter".to_owned(), look.say(deed(item)))];
    if let HomeItem::Mission(_) = item
        && state.session.activity.is_none()
    {
        let rules = look.say("home-mission-rules");
        keys.push((Room::Mission.key().to_string(), rules));
    }
    if let HomeItem::Mission(at) = item
        && let Some(drill) = drill(state, &state.missions[at].id)
    {
        let about = text!(
            "home-drill",
            title = &drill.title,
            seconds = drill.time_limit.as_secs()
        );
        keys.push(("t".to_owned(), look.text(&about)));
    }
    // As many to a line as fit; with a long text above them, the last lines are theirs.
    let most = inner.height.saturating_sub(keys.len() as u16);
    let (mut row, mut used) = ((row + 1).min(most), 0);
    for (key, what) in keys {
        let spans = [
            Span::styled(key, look.style(Role::Key)),
            Span::styled(format!(" {what}   "), look.style(Role::Muted)),
        ];
        let line: Line<'_> = spans.into_iter().collect();
        let width = line.width() as u16;
        if used > 0 && used + width > inner.width + 3 {
            (row, used) = (row + 1, 0);
        }
        put(buffer, columns(inner, used, inner.width), row, &line);
        used += width;
    }
}

/// The best of the trainee's tries, in words.
fn best_words(state: &State, item: HomeItem) -> Option<Text> {
    let HomeItem::Mission(at) = item else {
        return None;
    };
    let id = &state.missions[at].id;
    let best = state.best_try(id)?;
    let medal = best.medal.map_or(text!("debrief-no-medal"), Medal::title);
    let count = state.tries.get(id).map_or(0, Vec::len);
    Some(text!(
        "home-best",
        score = best.score?,
        medal = medal,
        count = count
    ))
}

/// An item as the list has it: missions with the number that `fly` takes.
fn listed(state: &State, item: HomeItem, look: &Look) -> String {
    let name = name(state, item, look);
    let HomeItem::Mission(at) = item else {
        return name;
    };
    let number = state.missions[at].id.split('-').next().unwrap_or_default();
    if number.is_empty() || !number.chars().all(|c| c.is_ascii_digit()) {
        return name;
    }
    format!("{number} {name}")
}

fn name(state: &State, item: HomeItem, look: &Look) -> String {
    match item {
        HomeItem::Mission(at) => look.text(&state.missions[at].title),
        HomeItem::Free => look.say("home-free"),
        HomeItem::ArduPilot => look.say("home-ardupilot"),
        HomeItem::Connect => look.say("home-connect"),
        HomeItem::Quit => look.say("home-quit"),
    }
}

fn about(state: &State, item: HomeItem, look: &Look) -> String {
    match item {
        HomeItem::Mission(at) => look.locale.text(&state.missions[at].brief),
        HomeItem::Free => {
            let (about, first) = (look.say("home-free-about"), look.say("home-free-first"));
            let wait = look.say("home-free-wait");
            let indented = |line: &str| format!("  {line}");
            let climb = FIRST_CLIMB.map(indented).join("\n");
            let flight = FIRST_FLIGHT.map(indented).join("\n");
            format!("{about}\n\n{first}\n\n{climb}\n\n{wait}\n\n{flight}")
        }
        HomeItem::ArduPilot => look.say("home-ardupilot-about"),
        HomeItem::Connect => look.say("home-connect-about"),
        HomeItem::Quit => look.say("home-quit-about"),
    }
}

fn deed(item: HomeItem) -> &'static str {
    match item {
        HomeItem::Mission(_) => "home-mission-deed",
        HomeItem::Free | HomeItem::ArduPilot => "home-free-deed",
        HomeItem::Connect => "home-connect-deed",
        HomeItem::Quit => "home-quit-deed",
    }
}

#[cfg(test)]
mod tests {
    use super::{FIRST_CLIMB, FIRST_FLIGHT};
    use crate::language::{Context, parse};

    #[test]
    fn the_first_flight_can_be_flown_as_it_is_written() {
        for line in FIRST_CLIMB.into_iter().chain(FIRST_FLIGHT) {
            assert!(parse(line, &Context::default()).is_ok(), "{line}");
        }
    }
}
