//! The replay's state in every room: a badge, the position, and the moments.

use std::time::Duration;

use chrono::DateTime;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::action::{Action, DebriefAction, ReplayAction};
use crate::app::keymap::Place;
use crate::app::room::Room;
use crate::app::state::{ReplayView, rate};
use crate::moment::{Moment, MomentKind};
use crate::scoring::TruthReport;
use crate::text;
use crate::text::{Text, lasting};
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, clip, clock, width, wrap};
use crate::vehicle_id::ranges;

/// The minimum number of cells for the timeline; with fewer, it is left out.
const SHORTEST: usize = 10;
/// The minimum number of cells for the timeline beside keys or a message; with fewer, the keys are
/// left out, and the message is above it.
const SHORTEST_BESIDE: usize = 20;
/// The keys beside the timeline get one column in `WIDE_HINTS` on a screen of at least this width,
/// and one in `NARROW_HINTS` on a narrower one.
const WIDE_BAR: usize = 120;
const WIDE_HINTS: usize = 2;
const NARROW_HINTS: usize = 3;
/// The sign of a gap in the recording on the timeline.
const GAP: (&str, Role) = (" ", Role::Muted);
/// The width of a moment's kind in the list, in columns.
const KIND_WIDTH: usize = 10;
/// Below this width, a line shows the kind by its sign alone.
const NARROW: usize = 50;

/// The replay badge in the header, with the rate.
pub fn badge(view: &ReplayView, look: &Look) -> String {
    let position = &view.position;
    let name = look.say("replay-badge");
    if position.is_playing {
        let rate = rate(position.rate);
        let way = if position.is_backwards { "◀ " } else { "" };
        format!(" {name} {way}x{rate} ")
    } else {
        format!(" {name} {} ", look.say("replay-stopped"))
    }
}

/// The date and time of the recording: `2026-11-20 14:03:22 UTC`.
pub fn time_of_day(view: &ReplayView, is_short: bool) -> String {
    let unix_us = view.day.unix_us(view.began_unix_us, view.position.at);
    let time = i64::try_from(unix_us)
        .ok()
        .and_then(DateTime::from_timestamp_micros)
        .unwrap_or_default();
    let format = if is_short {
        "%H:%M:%S"
    } else {
        "%Y-%m-%d %H:%M:%S UTC"
    };
    time.format(format).to_string()
}

/// The last line of the screen: the position in the recording, its moments, and the keys.
pub fn bar<'a>(state: &State, view: &ReplayView, panel: Panel<'_>) -> Line<'a> {
    let share = if panel.width() < WIDE_BAR && own_key(state, panel.area.width).is_none() {
        NARROW_HINTS
    } else {
        WIDE_HINTS
    };
    let hints = hints(state, panel.width() / share, panel);
    // On a narrow screen, the keys are left out first, then the remarks; a key that is shown nowhere else stays longer.
    let mut ways = vec![
        (Remarks::All, hints.clone(), SHORTEST_BESIDE),
        (Remarks::All, Vec::new(), SHORTEST),
        (Remarks::None, Vec::new(), SHORTEST),
    ];
    if own_key(state, panel.area.width).is_some() {
        ways.insert(1, (Remarks::None, hints, SHORTEST));
    }
    let fitting = ways.into_iter().find_map(|(remarks, words, least)| {
        let line = TimeLine::of(state, view, remarks, panel.look);
        let cells = line.room_beside(&words, panel)?;
        (cells >= least).then(|| line.draw(cells, words, panel.look))
    });
    fitting.unwrap_or_else(|| {
        let line = TimeLine::of(state, view, Remarks::None, panel.look);
        line.draw(0, Vec::new(), panel.look)
    })
}

/// The last line with a message in place of the keys, if both fit.
pub fn bar_beside<'a>(
    state: &State,
    view: &ReplayView,
    message: &Line<'a>,
    panel: Panel<'_>,
) -> Option<Line<'a>> {
    let spans = message.spans.iter().cloned();
    let spans: Vec<Span<'a>> = spans.map(|it| it.patch_style(message.style)).collect();
    [Remarks::All, Remarks::None]
        .into_iter()
        .find_map(|remarks| {
            let line = TimeLine::of(state, view, remarks, panel.look);
            let cells = line.room_beside(&spans, panel)?;
            (cells >= SHORTEST_BESIDE).then(|| line.draw(cells, spans.clone(), panel.look))
        })
}

/// Which remarks are shown after the position.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Remarks {
    All,
    None,
}

/// The timeline of a replay, and the times at its ends.
struct TimeLine<'a> {
    view: &'a ReplayView,
    position: String,
    end: String,
}

impl<'a> TimeLine<'a> {
    fn of(state: &State, view: &'a ReplayView, remarks: Remarks, look: &Look) -> Self {
        let remarks = match remarks {
            Remarks::All => self::remarks(state, view, look),
            Remarks::None => String::new(),
        };
        Self {
            view,
            position: format!("{}{remarks}", position(view)),
            end: format!(" {}  ", clock(view.length)),
        }
    }

    /// The number of cells for the timeline beside these words; `None` if the words alone do not
    /// fit.
    fn room_beside(&self, says: &[Span<'_>], panel: Panel<'_>) -> Option<usize> {
        let words: usize = says.iter().map(Span::width).sum();
        let times = width(&self.position) + width(&self.end);
        panel.width().checked_sub(words + times + 1)
    }

    fn draw<'s>(self, cells: usize, says: Vec<Span<'s>>, look: &Look) -> Line<'s> {
        let mut spans = vec![Span::styled(self.position, look.style(Role::Accent))];
        if cells > 0 {
            spans.extend(line(self.view, cells, look));
        }
        spans.push(Span::styled(self.end, look.style(Role::Muted)));
        spans.extend(says);
        Line::from(spans)
    }
}

/// The position in the recording: ` ▶ 01:23 `, or ` ■ 01:23.4 ` while it is stopped, so that single frames differ.
fn position(view: &ReplayView) -> String {
    let position = &view.position;
    let at = clock(position.at);
    match (position.is_playing, position.is_backwards) {
        (true, false) => format!(" ▶ {at} "),
        (true, true) => format!(" ◀ {at} "),
        (false, _) => format!(" ■ {at}.{} ", position.at.subsec_millis() / 100),
    }
}

/// The mission's time, the goal, the gap and the stops, if there are any.
fn remarks(state: &State, view: &ReplayView, look: &Look) -> String {
    let position = &view.position;
    // The time that the other panes show.
    let shown_elapsed = state.session().mission().map(|it| it.elapsed);
    let elapsed = shown_elapsed.or_else(|| view.clock.mission_time(position.at));
    let remarks = [
        elapsed.map(|it| text!("replay-mission-time", time = clock(it))),
        position
            .goal
            .map(|it| text!("replay-going-to", time = clock(it))),
        position
            .gap
            .map(|it| text!("replay-gap", time = lasting(it))),
        stops(&position.stops),
    ];
    let mut words = String::new();
    for remark in remarks.iter().flatten() {
        words.push_str(&look.text(remark));
        words.push(' ');
    }
    words
}

/// The kinds of moments at which the replay stops, by their signs on the timeline; `None` if it
/// does not stop.
fn stops(kinds: &[MomentKind]) -> Option<Text> {
    let signs: Vec<&str> = kinds.iter().map(|&kind| sign(kind).0).collect();
    (!signs.is_empty()).then(|| text!("replay-stops", signs = signs.join(" ")))
}

/// The keys, as many as fit; first the key that only this room has.
fn hints<'a>(state: &State, room: usize, panel: Panel<'_>) -> Vec<Span<'a>> {
    let look = panel.look;
    let own = own_key(state, panel.area.width);
    let mut spans = Vec::new();
    let mut used = 0;
    for (keys, about) in own.into_iter().chain(keys(state)) {
        let (keys, about) = (look.text(&keys), look.say(about));
        used += width(&keys) + width(&about) + 3;
        if used > room {
            break;
        }
        spans.push(Span::styled(keys, look.style(Role::Key)));
        spans.push(Span::styled(format!(" {about}  "), look.style(Role::Muted)));
    }
    spans
}

/// The key that shows the map of the truth, in a debrief that does not show it beside the text.
fn own_key(state: &State, columns: u16) -> Option<(Text, &'static str)> {
    let debrief = state.rooms().debrief().shown()?;
    let has_truth = debrief.report().truth != TruthReport::default();
    let is_behind_key = has_truth && !debrief.is_beside(columns);
    let truth = Action::Debrief(DebriefAction::TruthMap);
    let is_here = state.room() == Room::Debrief && is_behind_key;
    is_here.then(|| (state.key(truth), "hint-truth"))
}

/// The keys that end and control the replay, with their meaning.
fn keys(state: &State) -> impl Iterator<Item = (Text, &'static str)> {
    use ReplayAction::{
        NextMoment, PlayReplay, PreviousMoment, ReplayBack, ReplayForward, ShowMoments,
    };

    let is_playing = state.replay().is_some_and(|view| view.position.is_playing);
    let play = if is_playing { "hint-stop" } else { "hint-play" };
    let rows: [(&[ReplayAction], &str); 4] = [
        (&[PlayReplay], play),
        (&[ReplayBack, ReplayForward], "hint-ten-seconds"),
        (&[PreviousMoment, NextMoment], "hint-moments"),
        (&[ShowMoments], "hint-moment-list"),
    ];
    let leave = state.keymap().key(Action::Leave, Place::Replay);
    let controls = rows.into_iter().map(|(actions, about)| {
        let keys = actions
            .iter()
            .map(|&action| state.keymap().key(Action::Replay(action), Place::Replay));
        (Text::joined(" ", keys.collect()), about)
    });
    std::iter::once((leave, "hint-leave-replay")).chain(controls)
}

/// The timeline: the played part, the indexed part, the gaps (blank), the moments, and the repeated
/// stretch.
fn line<'a>(view: &ReplayView, cells: usize, look: &Look) -> Vec<Span<'a>> {
    let cell = |at: Duration| {
        let share = at.as_secs_f64() / view.length.as_secs_f64().max(0.001);
        ((share * cells as f64) as usize).min(cells - 1)
    };
    let position = &view.position;
    let mut line: Vec<(&str, Role)> = (0..cells)
        .map(|at| match at {
            at if at < cell(position.at) => ("━", Role::Accent),
            at if at <= cell(position.indexed) => ("─", Role::Text),
            _ => ("·", Role::Muted),
        })
        .collect();
    for gap in view.gaps.iter() {
        for sign in &mut line[cell(gap.start)..=cell(gap.end)] {
            *sign = GAP;
        }
    }
    // Each cell shows only its most important moment.
    let mut moments: Vec<&Moment> = view.moments.iter().collect();
    moments.sort_by_key(|moment| moment.kind.weight());
    for moment in moments {
        line[cell(moment.at)] = sign(moment.kind);
    }
    if let Some((from, to)) = position.looped {
        line[cell(from)] = ("[", Role::Accent);
        line[cell(to)] = ("]", Role::Accent);
    }
    line[cell(position.at)] = ("●", Role::Accent);
    line.into_iter()
        .map(|(sign, role)| Span::styled(sign, look.style(role)))
        .collect()
}

/// The sign of a moment on the timeline; the same as on the debrief's timeline, if the event is
/// shown there.
fn sign(kind: MomentKind) -> (&'static str, Role) {
    match kind {
        MomentKind::Bookmark => ("◆", Role::Selected),
        MomentKind::Refusal => ("r", Role::Danger),
        MomentKind::Barred => ("r", Role::Muted),
        MomentKind::Alert => ("!", Role::Danger),
        MomentKind::Mode | MomentKind::Arming => ("┴", Role::Muted),
        MomentKind::Objective => ("o", Role::Ok),
        MomentKind::Rule => ("x", Role::Danger),
        MomentKind::Event => ("~", Role::Accent),
        MomentKind::Separation => ("<", Role::Warning),
        MomentKind::Log => ("=", Role::Accent),
    }
}

/// A moment and its vehicles, as text.
pub fn moment_text(moment: &Moment, look: &Look) -> String {
    let (said, line) = (look.text(&moment.said()), look.text(&moment.text));
    let vehicles = ranges(moment.vehicles.iter().copied());
    // The line of a command often begins with the vehicles concerned.
    let is_command = matches!(
        moment.kind,
        MomentKind::Refusal | MomentKind::Barred | MomentKind::Event
    );
    let is_named = is_command
        && line
            .strip_prefix(vehicles.as_str())
            .is_some_and(|rest| rest.starts_with(' '));
    if vehicles.is_empty() || is_named {
        said
    } else {
        format!("{vehicles}: {said}")
    }
}

/// A time of the recording, followed by the mission's time if a mission was flown.
pub fn both_times(view: &ReplayView, at: Duration) -> String {
    match view.clock.mission_time(at) {
        Some(elapsed) => format!("{} {}", clock(at), clock(elapsed)),
        None => clock(at),
    }
}

/// A moment in a list, after its time as given in `time`.
pub fn moment_line<'a>(time: &str, moment: &Moment, columns: usize, look: &Look) -> Line<'a> {
    let head = moment_head(time, moment, columns, look);
    let rest = columns.saturating_sub(head.width());
    let text = clip(&moment_text(moment, look), rest);
    Line::from(vec![head, Span::styled(text, look.style(Role::Text))])
}

/// A moment in a list, with its whole text.
pub fn moment_lines<'a>(time: &str, moment: &Moment, columns: usize, look: &Look) -> Vec<Line<'a>> {
    let head = moment_head(time, moment, columns, look);
    let indent = head.width();
    let parts = wrap(&moment_text(moment, look), columns.saturating_sub(indent));
    let below = std::iter::repeat_with(|| Span::raw(" ".repeat(indent)));
    let leads = std::iter::once(head).chain(below);
    leads
        .zip(parts)
        .map(|(lead, part)| Line::from(vec![lead, Span::styled(part, look.style(Role::Text))]))
        .collect()
}

fn moment_head<'a>(time: &str, moment: &Moment, columns: usize, look: &Look) -> Span<'a> {
    let (sign, role) = sign(moment.kind);
    // In a narrow list, the sign alone leaves room for the text.
    let head = if columns < NARROW {
        format!("{time} {sign} ")
    } else {
        let kind = aligned(&look.text(&moment.kind.text()), KIND_WIDTH, false);
        format!("{time} {sign} {kind} ")
    };
    Span::styled(head, look.style(role))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_refusal_names_its_vehicles_once() {
        let refused = |line: &str, vehicles: &[u16]| {
            let moment = Moment {
                at: Duration::ZERO,
                vehicles: vehicles.to_vec(),
                kind: MomentKind::Refusal,
                by: None,
                text: Text::verbatim(line),
            };
            moment_text(&moment, &Look::default())
        };
        assert_eq!(refused("1 arm: refused", &[1]), "1 arm: refused");
        assert_eq!(refused("1-3 arm: refused", &[1, 2, 3]), "1-3 arm: refused");
        assert_eq!(refused("1-3 arm: refused", &[1]), "1: 1-3 arm: refused");
        assert_eq!(refused("all arm: refused", &[2]), "2: all arm: refused");
    }
}
