//! The last line: what is being typed, else what the console has to say, else what the keys do.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::app::room::workshop::Page;
use crate::app::state::{Room, State};
use crate::ui::look::Look;
use crate::ui::screen::{hangar, links, messages, parameters, workshop};
use crate::ui::theme::Role;
use crate::ui::widget::{below, put, severity_role};

const HOME: &[(&str, &str)] = &[
    ("j k", "hint-move"),
    ("Enter", "hint-take"),
    (":", "hint-command"),
    ("?", "hint-help"),
    ("u", "hint-trainee"),
    ("T", "room-standing"),
    ("W", "room-workshop"),
    ("q", "hint-quit"),
];
const STANDING: &[(&str, &str)] = &[
    ("j k", "hint-move"),
    ("Tab", "hint-page"),
    ("Enter", "hint-mission"),
    ("a", "hint-aids"),
    ("u", "hint-trainee"),
    ("Esc", "hint-back"),
    (":", "hint-command"),
    ("?", "hint-help"),
];
const FLY: &[(&str, &str)] = &[
    (":", "hint-command"),
    ("?", "hint-help"),
    ("Space", "hint-select"),
    ("3-9 Enter", "hint-list"),
    ("*", "hint-all"),
    ("/", "hint-filter"),
    ("s", "hint-sort"),
    ("x", "hint-acknowledge"),
    ("Esc", "hint-none"),
    ("j k", "hint-move"),
    ("c n", "hint-look-back"),
    ("M V P I L", "hint-rooms"),
];
const FLY_MISSION: &[(&str, &str)] = &[
    (":", "hint-command"),
    ("?", "hint-help"),
    ("p", "hint-pause"),
    ("w", "hint-hint"),
    ("B", "room-mission"),
    ("Space", "hint-select"),
    ("3-9 Enter", "hint-list"),
    ("*", "hint-all"),
    ("x", "hint-acknowledge"),
    ("j k", "hint-move"),
    ("c n", "hint-look-back"),
    ("M V P I L", "hint-rooms"),
];
const LEDGER: &[(&str, &str)] = &[
    (":", "hint-command"),
    ("?", "hint-help"),
    ("j k", "hint-move"),
    ("Enter", "hint-open"),
    ("/", "hint-filter"),
    ("o", "hint-outcome"),
    ("v", "hint-own"),
    ("Esc", "hint-back"),
];
const VEHICLE: &[(&str, &str)] = &[
    (":", "hint-command"),
    ("?", "hint-help"),
    ("[ ]", "hint-vehicle"),
    ("w", "hint-window"),
    ("Tab", "hint-page"),
    ("Space", "hint-select"),
    ("P", "room-parameters"),
    ("M", "room-map"),
    ("F", "room-fly"),
];
const MAP: &[(&str, &str)] = &[
    (":", "hint-command"),
    ("?", "hint-help"),
    ("hjkl", "hint-cursor"),
    ("+ -", "hint-zoom"),
    ("z", "hint-fit"),
    ("f", "hint-follow"),
    ("g", "hint-goto"),
    ("u", "hint-ruler"),
    ("Tab", "hint-vehicle"),
    ("i", "hint-signs"),
    ("w", "hint-trails"),
];
const BRIEF: &[(&str, &str)] = &[
    (":", "hint-command"),
    ("?", "hint-help"),
    ("j k", "hint-scroll"),
    ("Enter", "hint-fly"),
    ("W", "room-workshop"),
    ("Esc", "hint-back"),
];
const MISSION: &[(&str, &str)] = &[
    (":", "hint-command"),
    ("?", "hint-help"),
    ("j k", "hint-scroll"),
    ("s", "hint-predict"),
    ("g", "hint-goal"),
    ("w", "hint-hint"),
    ("p", "hint-pause"),
    ("r", "hint-again"),
    ("a", "hint-abandon"),
    ("F", "room-fly"),
    ("M", "room-map"),
];
const DEBRIEF: &[(&str, &str)] = &[
    ("j k", "hint-scroll"),
    ("Tab", "hint-section"),
    ("m", "hint-truth"),
    ("r", "hint-again"),
    ("s", "hint-alike"),
    ("n", "hint-next"),
    ("h", "hint-home"),
    ("t", "hint-drill"),
    (":", "hint-command"),
    ("?", "hint-help"),
];
const NO_DEBRIEF: &[(&str, &str)] = &[
    ("h", "hint-home"),
    (":", "hint-command"),
    ("?", "hint-help"),
];

/// Draws the footer into the last row of the screen.
pub fn draw(state: &State, look: &Look, area: Rect, buffer: &mut Buffer) {
    let row = below(area, area.height.saturating_sub(1));
    put(buffer, row, 0, &line(state, look, usize::from(area.width)));
}

fn line<'a>(state: &'a State, look: &Look, width: usize) -> Line<'a> {
    let muted = |text: String| Span::styled(text, look.style(Role::Muted));
    if !state.typed.is_empty() {
        return Line::from(vec![
            muted(format!(" {} ", look.say("footer-vehicles"))),
            Span::styled(state.typed.as_str(), look.style(Role::Selected)),
            muted(format!("_  {}", look.say("footer-list"))),
        ]);
    }
    if state.is_deaf() {
        return Line::from(muted(format!(" {}", look.say("footer-deaf"))));
    }
    if let Some(message) = state.message() {
        let role = severity_role(message.severity);
        return Line::styled(format!(" {}", look.text(&message.text)), look.style(role));
    }
    let mut spans = vec![Span::raw(" ")];
    let mut used = 1;
    for (key, what) in hints(state).iter().filter(|it| is_of_use(state, it)) {
        let what = look.say(what);
        used += Span::raw(*key).width() + Span::raw(&what).width() + 3;
        if used > width {
            break;
        }
        spans.push(Span::styled(*key, look.style(Role::Key)));
        spans.push(muted(format!(" {what}  ")));
    }
    Line::from(spans)
}

/// Whether there is anything that the key could bring now: a pause, where the mission allows one; a further hint of the
/// mission, where it asks for one; the trainee's word, before launch.
fn is_of_use(state: &State, (_, what): &(&str, &str)) -> bool {
    let mission = state.session.mission.as_ref();
    match *what {
        "hint-pause" => state.flown_mission().is_none_or(|it| it.pausable),
        "hint-hint" => mission.is_some_and(|mission| mission.clues.next.is_some()),
        "hint-predict" | "hint-goal" => state.can_pledge(),
        _ => true,
    }
}

/// What the keys of a room do.
fn hints(state: &State) -> &'static [(&'static str, &'static str)] {
    match state.room {
        Room::Home => HOME,
        Room::Standing => STANDING,
        Room::Ledger => LEDGER,
        Room::Debrief if state.rooms.debrief.is_none() => NO_DEBRIEF,
        Room::Debrief => DEBRIEF,
        Room::Vehicle => VEHICLE,
        Room::Map => MAP,
        Room::Messages => messages::HINTS,
        Room::Links => links::HINTS,
        Room::Hangar => hangar::HINTS,
        Room::Parameters if state.rooms.parameters.comparison.is_some() => {
            parameters::COMPARISON_HINTS
        }
        Room::Parameters => parameters::HINTS,
        Room::Workshop => match state.rooms.workshop.page {
            Page::Bench => workshop::HINTS,
            Page::Designs => workshop::SHELF_HINTS,
            Page::Compare => workshop::COMPARISON_HINTS,
            Page::Fleet => workshop::FLEET_HINTS,
        },
        Room::Mission if state.session.activity.is_none() => BRIEF,
        Room::Mission => MISSION,
        Room::Fly if state.flown_mission().is_some() => FLY_MISSION,
        Room::Fly => FLY,
    }
}
