//! The first line: room, time, vehicles, and links.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Modifier;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::state::{CrewLink, LinkSummary, MemberPlace, ReplayView, Room, rate};
use crate::crew::Role as CrewRole;
use crate::scoring::AlertLevel;
use crate::text;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{alert_role, clip, clock, columns, put, replay, upper, width};
use crate::vehicle_id::ranges;

/// The time left for a try of an exam from which it is shown as a warning.
const TRY_ENDS_SOON: Duration = Duration::from_secs(60);
/// The maximum number of columns of an instructor's name in a header with little room.
const SHORT_NAME: usize = 12;

/// Draws the header and returns the area between it and the footer.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) -> Rect {
    let header = upper(panel.area, 1);
    buffer.set_style(header, panel.style(Role::Header));
    let name = format!(" {} ", panel.text(&state.room().title()).to_uppercase());
    let activity = state.session().activity();
    let title = activity.map_or_else(String::new, |activity| panel.text(&activity.title()));
    let room = usize::from(panel.area.width);
    let session = state.session();
    let pace = if let Some(view) = recorded(state) {
        replay::badge(view, panel.look)
    } else if let Some(place) = state.crew().member() {
        let badge = match place.link(state.wall()) {
            CrewLink::Awaited => text!("header-crew-awaited"),
            CrewLink::Up => text!("header-crew"),
            CrewLink::Silent(silent) => text!("header-crew-silent", seconds = silent.as_secs()),
            CrewLink::Lost => text!("header-crew-lost"),
            CrewLink::Ended => text!("header-crew-ended"),
        };
        format!(" {} ", panel.text(&badge))
    } else if session.is_paused() && state.class_role().is_frozen() {
        format!(" {} ", panel.say("header-frozen"))
    } else if session.is_paused() {
        format!(" {} ", panel.say("header-paused"))
    } else if session.pace().is_fast() {
        let rate = rate(session.pace().now);
        format!(" {} ", panel.text(&text!("header-speedup", rate = rate)))
    } else {
        String::new()
    };
    let left = width(&name) + width(&pace) + 1;
    // The figures are shortened to make room for the title, as long as they stay clear.
    let fits = |right: &Line<'_>, title: usize| left + title + 3 + right.width() < room;
    let right = |space| right_part(state, panel.look, space);
    let [long, short] = [Space::Wide, Space::Short].map(right);
    let right = if fits(&long, width(&title)) {
        long
    } else if pace.is_empty() || fits(&short, 0) {
        short
    } else {
        right(Space::Least)
    };
    let title = clip(&title, room.saturating_sub(left + right.width() + 4));
    let bold = panel.style(Role::Header).add_modifier(Modifier::BOLD);
    let line = Line::from(vec![
        Span::styled(name, bold),
        Span::styled(pace, panel.style(Role::Cursor)),
        Span::raw(format!(" {title}")),
    ]);
    put(buffer, header, 0, &line);
    let start = panel.area.width.saturating_sub(right.width() as u16 + 1);
    let place = columns(header, start, panel.area.width);
    put(buffer, place, 0, &right);
    Rect {
        y: panel.area.y + 1,
        height: panel.area.height.saturating_sub(2),
        ..panel.area
    }
}

/// A figure of the header; one that needs attention has a role of its own.
struct Figure {
    text: Text,
    role: Option<Role>,
}

impl From<Text> for Figure {
    fn from(text: Text) -> Self {
        Self { text, role: None }
    }
}

impl Figure {
    /// The figure as it is drawn: a role is drawn on the ground of ordinary text, on which every theme's roles can be
    /// read.
    fn span(&self, look: &Look) -> Span<'static> {
        let text = look.text(&self.text);
        match self.role {
            Some(role) => {
                let style = look.style(Role::Text).patch(look.style(role));
                Span::styled(format!(" {text} "), style.add_modifier(Modifier::BOLD))
            }
            None => Span::raw(text),
        }
    }
}

/// The room for the figures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Space {
    Wide,
    /// The figures are abbreviated.
    Short,
    /// The number of vehicles is left out, too: the state of a pause or of a crew is more urgent.
    Least,
}

/// The figures, as there is room for them.
fn right_part(state: &State, look: &Look, space: Space) -> Line<'static> {
    let mut line = Line::default();
    for figure in figures(state, space) {
        if !line.spans.is_empty() {
            line.push_span("   ");
        }
        line.push_span(figure.span(look));
    }
    line
}

fn figures(state: &State, space: Space) -> Vec<Figure> {
    let short = space != Space::Wide;
    let count = (space != Space::Least).then(|| vehicles(state, short));
    let is_reading = state.session().is_reading();
    if is_reading && short {
        let vehicles = text!("count-vehicles", count = state.session().vehicles().len());
        let vehicles = count.is_some().then(|| Figure::from(vehicles));
        let watched = watched(state, short).map(Figure::from);
        return vehicles
            .into_iter()
            .chain(exam_try(state, short))
            .chain(watched)
            .chain([text!("header-reading").into()])
            .collect();
    }
    let time = if is_reading {
        text!("header-reading")
    } else {
        clock(state.session().time(state.now())).into()
    };
    let plain = |text: Option<Text>| text.map(Figure::from);
    let parts = [
        plain(slow_line(state)),
        plain(dropped(state, short)),
        pressing_alert(state),
        mission_alert(state),
        plain(count.flatten()),
        exam_try(state, short),
        pilots(state),
        plain(watched(state, short)),
        plain(recorded_at(state, short)),
        Some(time.into()),
    ];
    parts.into_iter().flatten().collect()
}

fn slow_line(state: &State) -> Option<Text> {
    let bytes_per_s = state.display().slow_line()?;
    let rate = format!("{:.1}", f64::from(bytes_per_s) / 1000.0);
    Some(text!("terminal-slow", rate = rate))
}

fn dropped(state: &State, short: bool) -> Option<Text> {
    let count = state.notices().dropped();
    (count > 0).then(|| {
        if short {
            text!("header-dropped-short", count = count)
        } else {
            text!("header-dropped", count = count)
        }
    })
}

/// The number of unacknowledged alerts, if any, in the role of the worst; not on the flight screen, which has a line for
/// the most urgent one.
fn pressing_alert(state: &State) -> Option<Figure> {
    let session = state.session();
    let is_shown = state.room() != Room::Fly && !session.is_over();
    let worst = session.alerts().pressing().filter(|_| is_shown)?.first;
    let count = session.alerts().open().count();
    Some(Figure {
        text: text!("alert-header", count = count),
        role: Some(alert_role(worst.alert.severity)),
    })
}

/// The time left to answer the mission's alert; the two rooms that show the alert itself do not
/// repeat it.
fn mission_alert(state: &State) -> Option<Figure> {
    let session = state.session();
    let alert = session.mission()?.alerts.first()?;
    let seconds = alert.remaining.as_secs();
    let is_shown = !matches!(state.room(), Room::Fly | Room::Map) && !session.is_over();
    let role = match alert.level {
        AlertLevel::Critical => Role::Alert,
        AlertLevel::Warning => Role::Warning,
        AlertLevel::Caution => Role::Accent,
    };
    is_shown.then(|| Figure {
        text: text!("mission-alert-short", seconds = seconds),
        role: Some(role),
    })
}

fn vehicles(state: &State, short: bool) -> Option<Text> {
    let session = state.session();
    session.activity()?;
    let (armed, all) = (session.armed(), session.all().count());
    let count = if short {
        text!("header-armed-short", armed = armed, all = all)
    } else {
        let vehicles = text!("count-vehicles", count = all);
        text!("header-armed", vehicles = vehicles, armed = armed)
    };
    // The links of a recording no longer exist.
    let links = state.replay().is_none().then(|| links(state, short));
    let shown = std::iter::once(count).chain(links).collect();
    Some(Text::joined("   ", shown))
}

/// The try of an exam, and the time that is left for it.
fn exam_try(state: &State, short: bool) -> Option<Figure> {
    let shown = state.shown_try()?;
    let time = clock(shown.left);
    let text = if short {
        text!("header-try-short", time = time)
    } else {
        let (number, tries) = (shown.number, shown.tries);
        text!("header-try", number = number, tries = tries, time = time)
    };
    let is_short = shown.left < TRY_ENDS_SOON;
    let role = is_short.then_some(Role::Warning);
    Some(Figure { text, role })
}

/// Who else flies vehicles of this console; at a member of a crew, what its user flies, or the role of one that flies
/// nothing.
fn pilots(state: &State) -> Option<Figure> {
    if let Some(own) = state.session().pilots().own() {
        let role = state.crew().member().map(MemberPlace::role);
        let text = match role {
            _ if !own.is_empty() => text!("header-own", vehicles = ranges(own)),
            Some(role) if role != CrewRole::Pilot => role.text(),
            _ => text!("header-own-none"),
        };
        return Some(text.into());
    }
    let others = state.session().pilots().others();
    let parts = others.into_iter().map(|(pilot, vehicles)| {
        let (pilot, vehicles) = (pilot.name(), ranges(vehicles));
        text!("header-pilot", pilot = pilot, vehicles = vehicles)
    });
    let parts: Vec<Text> = parts.collect();
    (!parts.is_empty()).then(|| Figure {
        text: Text::joined(", ", parts),
        role: Some(Role::Warning),
    })
}

/// The flight of the past that is shown, if any.
fn recorded(state: &State) -> Option<&ReplayView> {
    state.replay().filter(|view| !view.is_live)
}

/// Who watches this seat of a class. A short header names the instructor, too; the title gives way.
fn watched(state: &State, short: bool) -> Option<Text> {
    let role = state.class_role();
    let most = if short { SHORT_NAME } else { usize::MAX };
    let instructor = clip(role.watcher()?, most);
    if role.is_screen_watched() {
        return Some(if short {
            text!("header-screen-watched-short", instructor = instructor)
        } else {
            text!("header-screen-watched", instructor = instructor)
        });
    }
    Some(text!("header-watched", instructor = instructor))
}

fn recorded_at(state: &State, short: bool) -> Option<Text> {
    let view = recorded(state)?;
    Some(replay::time_of_day(view, short).into())
}

/// Whether a link is up. The pipe to a simulator's process stays open when the process ends.
fn is_up(state: &State, at: usize, link: &LinkSummary) -> bool {
    link.up && !state.session().leads_to_ended_process(at)
}

/// Whether a link is up and has no fault that keeps its vehicles from being heard.
fn is_well(state: &State, at: usize, link: &LinkSummary) -> bool {
    let session = state.session();
    let mut faults = session.findings().iter().filter(|it| it.link == at);
    is_up(state, at, link) && !faults.any(|fault| session.lacks_vehicle(fault))
}

fn links(state: &State, short: bool) -> Text {
    let links = state.session().links();
    match links {
        [] => text!("header-no-link"),
        [link] if is_up(state, 0, link) && state.session().hears_nothing(0) => {
            text!("header-link-silent")
        }
        [link] if is_up(state, 0, link) => text!("header-link-up"),
        // A long address is cut, so that the state stays visible.
        [link] => {
            let name = clip(
                &state.locale().text(&link.name),
                if short { 14 } else { 24 },
            );
            text!("header-link-down", name = name)
        }
        links => {
            let links_up = links
                .iter()
                .enumerate()
                .filter(|(at, link)| is_well(state, *at, link));
            let up = links_up.count();
            if short {
                text!("header-links-short", up = up, all = links.len())
            } else {
                text!("header-links", up = up, all = links.len())
            }
        }
    }
}
