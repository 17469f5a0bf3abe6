//! The home screen: missions and other items, the trainee's progress with them, and details.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::action::Action;
use crate::app::room::home::{HomeItem, under_cursor};
use crate::app::state::{Career, Room};
use crate::campaign::Mastery;
use crate::notice::sanitised;
use crate::text;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::screen::site::{self, SITE_ROWS};
use crate::ui::theme::Role;
use crate::ui::widget::{below, clip, columns, put, width};

mod about;
mod list;

/// The limits of the list's width, which otherwise depends on its longest line.
const LIST_LEAST: u16 = 34;
const LIST_MOST: u16 = 60;
/// The largest share of the width for the list, in percent; at 80 columns, the longest mission has room for `locked`.
const LIST_PERCENT: u16 = 47;
/// The height of the text above the sketch of a mission's area, without a career and with one, in
/// rows.
const TEXT_ROWS: u16 = 14;
const CAREER_ROWS: u16 = 23;
/// The maximum number of columns of the text: longer lines are hard to read.
const TEXT_WIDTH: u16 = 88;
/// The minimum width of the career's facts and of the objectives beside the text, in columns.
const FACTS_WIDTH: u16 = 50;

/// Draws the trainee's status, the list with its cursor, and a text about the chosen item.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let trainee = panel.at(draw_heads(state, panel, buffer));
    draw_trainee(state, trainee, buffer);
    let body = trainee.below(1);
    let most = (body.area.width * LIST_PERCENT / 100).clamp(LIST_LEAST, LIST_MOST);
    let list = list::wanted_width(state, body.look).clamp(LIST_LEAST, most);
    list::draw(state, body.columns(1, list), buffer);
    let before = list + 3;
    let beside_list = body.columns(before, body.area.width.saturating_sub(before));
    let facts = beside_list.area.width.saturating_sub(TEXT_WIDTH + 3);
    let (middle, facts) = if facts >= FACTS_WIDTH {
        let beside = columns(beside_list.area, TEXT_WIDTH + 3, facts.min(TEXT_WIDTH));
        (beside_list.columns(0, TEXT_WIDTH), Some(beside))
    } else {
        (beside_list, None)
    };
    let rest = draw_site(state, middle, facts.is_some(), buffer).area;
    let text = columns(rest, 0, rest.width.min(TEXT_WIDTH));
    about::draw(state, panel.at(text), facts, buffer);
}

/// Draws the site of the chosen mission below the text if there is room; returns the panel above
/// it. The facts of a career need rows of their own unless they are beside the text.
fn draw_site<'a>(
    state: &State,
    panel: Panel<'a>,
    facts_are_beside: bool,
    buffer: &mut Buffer,
) -> Panel<'a> {
    let text = if state.training().career().is_some() && !facts_are_beside {
        CAREER_ROWS
    } else {
        TEXT_ROWS
    };
    let left = panel.area.height.saturating_sub(text + 1);
    let site = left.min(panel.area.height / 2);
    let above = panel.area.height.saturating_sub(site + 1);
    let Some(mission) = under_cursor(state).filter(|_| site >= SITE_ROWS) else {
        return panel;
    };
    site::draw(state, mission, panel.below(above + 1), buffer);
    panel.upper(above)
}

/// Draws the session under way, if there is one; returns the area below it.
fn draw_heads(state: &State, panel: Panel<'_>, buffer: &mut Buffer) -> Rect {
    let Some(activity) = state.session().activity() else {
        return panel.area;
    };
    let session = activity.title();
    let running = if state.replay().is_some() {
        let key = state.key(Action::Show(Room::Fly));
        text!("home-replay", session = session, key = key)
    } else if state.session().is_over() {
        let key = state.key(Action::Show(Room::Debrief));
        text!("home-over", session = session, key = key)
    } else {
        let key = state.key(Action::Show(Room::Fly));
        text!("home-running", session = session, key = key)
    };
    let line = Line::styled(
        format!(" {}", panel.text(&running)),
        panel.style(Role::Accent),
    );
    put(buffer, panel.area, 0, &line);
    below(panel.area, 1)
}

/// Draws the trainee's name, level, credits and licence, and the recommended next step.
fn draw_trainee(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let Some(career) = state.training().career() else {
        let line = Line::from(vec![
            Span::styled(
                format!(" {}", panel.text(&state.key(Action::Profiles))),
                panel.style(Role::Key),
            ),
            Span::styled(
                format!(" {}", panel.say("home-no-profile")),
                panel.style(Role::Muted),
            ),
        ]);
        put(buffer, panel.area, 0, &line);
        return;
    };
    let standing = &career.standing;
    let figures = text!(
        "home-trainee",
        level = standing.experience().1,
        credits = standing.credits(),
        licence = standing.licence()
    );
    let line = Line::from(vec![
        Span::styled(
            format!(" {}", sanitised(&career.name)),
            panel.style(Role::Title),
        ),
        Span::raw(format!("   {}", panel.text(&figures))),
    ]);
    let left = usize::from(panel.area.width).saturating_sub(line.width() + 4);
    let end = put(buffer, panel.area, 0, &line).unwrap_or(panel.area.x);
    // If the whole advice does not fit, only the mission is shown.
    let words: Vec<String> = advice(career).iter().map(|it| panel.text(it)).collect();
    let shown = words.iter().find(|text| width(text) <= left);
    if let Some(text) = shown.or(words.last()) {
        let place = columns(panel.area, end + 3 - panel.area.x, left as u16);
        let line = Line::styled(clip(text, left), panel.style(Role::Accent));
        put(buffer, place, 0, &line);
    }
}

/// The recommended skill and mission, in full and in short.
fn advice(career: &Career) -> Vec<Text> {
    let Some((skill, offer)) = career.next() else {
        return Vec::new();
    };
    let known = career.standing.skill(skill);
    let percent = (known.chance(career.day) * 100.0).round() as u32;
    let (skill, mission) = (skill.title(), &offer.title);
    let in_full = if known.mastery(career.day) == Mastery::Unknown {
        text!("home-next-new", skill = skill, mission = mission)
    } else {
        text!(
            "home-next",
            skill = skill,
            percent = percent,
            mission = mission
        )
    };
    vec![in_full, text!("home-next-short", mission = mission)]
}

fn name(state: &State, item: HomeItem, look: &Look) -> String {
    match item {
        HomeItem::Mission(at) => look.text(&state.training().missions()[at].title),
        HomeItem::Free => look.say("home-free"),
        HomeItem::ArduPilot => look.say("home-ardupilot"),
        HomeItem::Connect => look.say("home-connect"),
        HomeItem::Quit => look.say("home-quit"),
    }
}
