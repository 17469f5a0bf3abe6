//! Details of the chosen item: its subject, its part in the trainee's career, its keys.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::name;
use crate::app::State;
use crate::app::action::{Action, StartAction};
use crate::app::room::home::{HomeItem, drill, facts, items};
use crate::app::room::mission::tasks;
use crate::app::state::Room;
use crate::scoring::Medal;
use crate::text;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::screen::mission::{draw_line, tone_role};
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, below, clip, columns, put, reflow, row_of, upper, width, wrap};

/// Commands for a first takeoff, in order; the last one takes a while.
const FIRST_CLIMB: [&str; 3] = ["all guided", "all arm", "all takeoff 20"];
/// Commands to give once the drones are in the air.
const FIRST_FLIGHT: [&str; 2] = ["all goto by n 50", "all rtl"];
/// The minimum number of lines of the text, whatever else is shown.
const LEAST_TEXT: usize = 7;

/// A key, and its effect.
type KeyHint = (String, String);

/// Draws the text with the keys below it. The facts of the career and the objectives are shown beside the text or,
/// without room there, between text and keys.
pub(super) fn draw(state: &State, panel: Panel<'_>, beside: Option<Rect>, buffer: &mut Buffer) {
    let Some(item) = items(state).get(state.rooms().home().cursor()).copied() else {
        return;
    };
    let inner = panel.titled(&name(state, item, panel.look), buffer);
    let keys = key_lines(
        &keys(state, item, panel.look),
        usize::from(inner.width),
        panel.look,
    );
    let facts_width = beside.unwrap_or(inner).width;
    let facts = fact_lines(state, item, panel.look, usize::from(facts_width));
    let mut below_text = vec![Vec::new(), keys];
    if let Some(beside) = beside {
        let mut place = panel.at(beside);
        if !facts.is_empty() {
            let inner = place.titled(&panel.say("home-career"), buffer);
            draw_lines(&facts, inner, buffer);
            place = place.below(facts.len() as u16 + 2);
        }
        draw_tasks(state, item, place, buffer);
    }
    if beside.is_none() && !facts.is_empty() {
        below_text.insert(0, facts);
    } else if let Some(best) = best_words(state, item) {
        let line = Line::styled(panel.text(&best), panel.style(Role::Accent));
        below_text.insert(0, vec![line]);
    }
    below_text.retain(|lines| !lines.is_empty());
    draw_text(&about(state, item, panel.look), &below_text, inner, buffer);
}

/// Draws the objectives and rules of a mission that can be started, if there is room.
fn draw_tasks(state: &State, item: HomeItem, panel: Panel<'_>, buffer: &mut Buffer) {
    let HomeItem::Mission(at) = item else { return };
    if state.session().activity().is_some() {
        return;
    }
    let mission = &state.training().missions()[at];
    let lines = tasks(state, mission, &panel.look.locale, panel.area.width);
    let rows = usize::from(panel.area.height);
    for (row, line) in lines.iter().take(rows).enumerate() {
        draw_line(line, panel.at(row_of(panel.area, row as u16)), buffer);
    }
    panel.mark_scroll(0, lines.len(), buffer);
}

/// Draws the text and the groups of lines below it, with blank lines between them. If there is not
/// enough room, the text is cut first, then the groups before the last: the mission room shows
/// everything.
fn draw_text(text: &str, groups: &[Vec<Line<'_>>], area: Rect, buffer: &mut Buffer) {
    let rows = usize::from(area.height);
    let below_rows: usize = groups.iter().map(|group| group.len() + 1).sum();
    let room = rows.saturating_sub(below_rows).max(LEAST_TEXT);
    let lines = cut_after_sentence(wrap(&reflow(text), usize::from(area.width)), room);
    let mut row = lines.len() as u16;
    for (at, line) in lines.into_iter().enumerate() {
        put(
            buffer,
            area,
            at as u16,
            &Line::raw(clip(&line, area.width.into())),
        );
    }
    let Some((last, before)) = groups.split_last() else {
        return;
    };
    let bottom = area.height.saturating_sub(last.len() as u16);
    for group in before {
        let place = below(upper(area, bottom.saturating_sub(1)), row + 1);
        draw_lines(group, place, buffer);
        row += 1 + group.len() as u16;
    }
    draw_lines(last, below(area, (row + 1).min(bottom)), buffer);
}

/// As many lines as fit, with a mark at the cut: after a whole sentence, unless that would lose more than a third of
/// the lines.
fn cut_after_sentence(mut lines: Vec<String>, room: usize) -> Vec<String> {
    if lines.len() <= room {
        return lines;
    }
    lines.truncate(room);
    let ends = lines.iter().enumerate().rev().find_map(|(at, line)| {
        let end = line
            .rfind(". ")
            .or(line.ends_with('.').then_some(line.len() - 1));
        end.map(|end| (at, end + 1))
    });
    if let Some((at, end)) = ends.filter(|(at, _)| at + 1 > room - room / 3) {
        lines.truncate(at + 1);
        lines[at].truncate(end);
    }
    if let Some(last) = lines.last_mut() {
        last.push_str(" …");
    }
    lines
}

/// Draws lines, with a mark at the end of the last one if not all fit.
fn draw_lines(lines: &[Line<'_>], area: Rect, buffer: &mut Buffer) {
    let rows = usize::from(area.height);
    let is_cut = lines.len() > rows;
    for (row, line) in lines.iter().enumerate().take(rows) {
        let end = put(buffer, area, row as u16, line);
        if let Some(end) = end.filter(|_| is_cut && row + 1 == rows) {
            let x = end.min(area.right().saturating_sub(2)) - area.x;
            let place = columns(area, x, 2);
            put(buffer, place, row as u16, &Line::raw(" …"));
        }
    }
}

fn fact_lines(state: &State, item: HomeItem, look: &Look, columns: usize) -> Vec<Line<'static>> {
    let HomeItem::Mission(at) = item else {
        return Vec::new();
    };
    let facts = facts(state, &state.training().missions()[at]);
    let names: Vec<String> = facts.iter().map(|fact| look.text(&fact.name)).collect();
    let indent = names.iter().map(|name| width(name)).max().unwrap_or(0) + 2;
    let mut lines = Vec::new();
    for (name, fact) in names.iter().zip(&facts) {
        let mut lead = aligned(name, indent, false);
        for text in wrap(&look.text(&fact.what), columns.saturating_sub(indent)) {
            lines.push(Line::from(vec![
                Span::styled(lead, look.style(Role::Muted)),
                Span::styled(text, look.style(tone_role(fact.tone))),
            ]));
            lead = " ".repeat(indent);
        }
    }
    lines
}

fn keys(state: &State, item: HomeItem, look: &Look) -> Vec<KeyHint> {
    let key = |action: Action| look.text(&state.key(action));
    let mut keys = vec![(key(Action::Submit), look.say(deed(item)))];
    let HomeItem::Mission(at) = item else {
        return keys;
    };
    let mission = &state.training().missions()[at];
    if state.training().lock(&mission.id).is_some() {
        keys.clear();
    }
    if state.session().activity().is_none() {
        let rules = look.say("home-mission-rules");
        keys.push((key(Action::Show(Room::Mission)), rules));
    }
    if state.training().lock(&mission.id).is_some() {
        return keys;
    }
    if let Some(drill) = drill(state, &mission.id) {
        let about = text!(
            "home-drill",
            title = &drill.title,
            seconds = drill.time_limit.as_secs()
        );
        keys.push((key(Action::Start(StartAction::Drill)), look.text(&about)));
    }
    if state.training().career().is_some() {
        for (action, what) in [
            (Action::Start(StartAction::Daily), "home-daily"),
            (Action::Start(StartAction::Exam), "home-exam"),
            (Action::Start(StartAction::Practise), "home-practise"),
        ] {
            keys.push((key(action), look.say(what)));
        }
    }
    keys
}

/// Keys in lines, as many per line as fit.
fn key_lines(keys: &[KeyHint], columns: usize, look: &Look) -> Vec<Line<'static>> {
    let mut lines: Vec<Line<'static>> = Vec::new();
    for (key, what) in keys {
        let spans = [
            Span::styled(key.clone(), look.style(Role::Key)),
            Span::styled(format!(" {what}   "), look.style(Role::Muted)),
        ];
        let needed = width(key) + width(what) + 1;
        match lines.last_mut() {
            Some(line) if line.width() + needed <= columns => line.spans.extend(spans),
            _ => lines.push(Line::from(spans.to_vec())),
        }
    }
    lines
}

fn best_words(state: &State, item: HomeItem) -> Option<Text> {
    let HomeItem::Mission(at) = item else {
        return None;
    };
    let id = &state.training().missions()[at].id;
    let best = state.training().best_try(id)?;
    let medal = best.medal.map_or(text!("debrief-no-medal"), Medal::title);
    Some(text!("home-best", score = best.score?, medal = medal))
}

fn about(state: &State, item: HomeItem, look: &Look) -> String {
    match item {
        HomeItem::Mission(at) => look.locale.text(&state.training().missions()[at].brief),
        HomeItem::Free => {
            let (about, first) = (
                look.say("home-free-about"),
                look.text(&text!(
                    "home-free-first",
                    key = state.key(Action::CommandLine)
                )),
            );
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
