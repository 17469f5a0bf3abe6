//! The open drafts with their signs, and the lists of the current one.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::action::{Action, PlansAction};
use crate::app::room::plans::is_elsewhere;
use crate::draft::Draft;
use crate::plan::ListKind;
use crate::preflight::list_words;
use crate::ui::look::Badge;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{clip, columns, put, width};

/// The number of columns between two drafts.
const GAP: usize = 2;
/// The width of a sign with a star or a blank, in columns.
const SIGN: usize = 2;
/// The number of columns between two drafts without names.
const CLOSE_GAP: usize = 1;
/// The width of the number of drafts that are not shown, such as `+12`, in columns.
const COUNT: usize = 4;

/// Draws the drafts at the left and the lists at the right.
pub(super) fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let lists = lists(state, panel);
    let room_left = panel.width().saturating_sub(lists.width() + 1);
    let left = columns(panel.area, 0, room_left as u16);
    put(buffer, left, 0, &drafts(state, room_left, panel));
    let right = columns(panel.area, room_left as u16, panel.area.width);
    put(buffer, right, 0, &lists);
}

/// The drafts within a width: the current one always with its name, the others as far as there is room.
fn drafts(state: &State, columns: usize, panel: Panel<'_>) -> Line<'static> {
    let room = state.rooms().plans();
    let all = room.drafts().all();
    let current = room.drafts().current_index();
    let names: Vec<String> = all.iter().map(|draft| name(state, draft)).collect();
    let widths = all.iter().zip(&names).map(|(draft, name)| TabWidth {
        name: width(name),
        short: width(&short(draft)),
    });
    let widths: Vec<TabWidth> = widths.collect();
    let mut spans = vec![Span::raw(" ")];
    if all.len() > 1 {
        let key = panel.text(&state.key(Action::Plans(PlansAction::NextDraft)));
        spans.push(Span::styled(format!("{key} "), panel.style(Role::Key)));
    }
    let used: usize = spans.iter().map(Span::width).sum();
    let shown = fitting(&widths, current, columns.saturating_sub(used));
    let count = |hidden: usize, sign: &str| {
        let text = format!("{sign}{hidden} ");
        (hidden > 0).then(|| Span::styled(text, panel.style(Role::Muted)))
    };
    let first = shown.first().map_or(0, |tab| tab.index);
    spans.extend(count(first, "-"));
    let mut left = columns.saturating_sub(used);
    for tab in &shown {
        let own = draft_spans(state, *tab, left, panel);
        left = left.saturating_sub(own.iter().map(Span::width).sum());
        spans.extend(own);
    }
    let last = shown.last().map_or(0, |tab| tab.index + 1);
    spans.extend(count(all.len() - last.min(all.len()), "+"));
    Line::from(spans)
}

/// The sign of a draft, and its name or the star of an unsaved one, within a width.
fn draft_spans(state: &State, tab: Tab, columns: usize, panel: Panel<'_>) -> Vec<Span<'static>> {
    let drafts = state.rooms().plans().drafts();
    let Some(draft) = drafts.all().get(tab.index) else {
        return Vec::new();
    };
    let badge = Badge::of_draft(draft);
    let is_current = tab.index == drafts.current_index();
    let role = if is_current { Role::Title } else { Role::Muted };
    let sign = Span::styled(badge.sign.to_string(), panel.style(badge.role));
    if tab.is_named {
        let words = clip(&name(state, draft), columns.saturating_sub(SIGN));
        let gap = " ".repeat(GAP);
        vec![
            sign,
            Span::raw(" "),
            Span::styled(words, panel.style(role)),
            Span::raw(gap),
        ]
    } else {
        let star = if is_elsewhere(state, draft) { " " } else { "*" };
        let gap = " ".repeat(CLOSE_GAP);
        let short = format!("{}{star}{gap}", short(draft));
        vec![sign, Span::styled(short, panel.style(role))]
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Tab {
    index: usize,
    /// Whether the name is shown in addition to the sign.
    is_named: bool,
}

/// The widths of a draft's name and of its short name, in columns.
#[derive(Debug, Clone, Copy)]
struct TabWidth {
    name: usize,
    short: usize,
}

impl TabWidth {
    /// The width of the sign with the name.
    fn named(self) -> usize {
        SIGN + self.name + GAP
    }

    /// The width of the sign with the short name.
    fn alone(self) -> usize {
        SIGN + self.short + CLOSE_GAP
    }
}

/// The drafts that fit into a width, given the widths of their names. The current one is shown with
/// its name; its neighbours are added with their short names, and, if all drafts fit, with their
/// full names, the nearest first.
fn fitting(names: &[TabWidth], current: usize, columns: usize) -> Vec<Tab> {
    let Some(own) = names.get(current) else {
        return Vec::new();
    };
    let mut by_distance: Vec<usize> = (0..names.len()).filter(|at| *at != current).collect();
    by_distance.sort_by_key(|at| at.abs_diff(current));
    let spare = |count: usize| if count < names.len() { 2 * COUNT } else { 0 };
    let mut used = own.named();
    let mut shown = vec![current];
    for &at in &by_distance {
        let alone = names[at].alone();
        if used + alone + spare(shown.len() + 1) > columns {
            break;
        }
        used += alone;
        shown.push(at);
    }
    let is_whole = shown.len() == names.len();
    let mut with_name = vec![current];
    for &at in by_distance.iter().filter(|_| is_whole) {
        let more = names[at].named() - names[at].alone();
        if used + more > columns {
            break;
        }
        used += more;
        with_name.push(at);
    }
    shown.sort_unstable();
    let tab = |index| Tab {
        index,
        is_named: with_name.contains(&index),
    };
    shown.into_iter().map(tab).collect()
}

/// The number of a draft's vehicle, otherwise the first letter of its name: signs repeat, and some terminals have no
/// colours.
fn short(draft: &Draft) -> String {
    match draft.vehicle() {
        Some(vehicle) => vehicle.to_string(),
        None => draft.short_name().chars().take(1).collect(),
    }
}

/// A draft's name without its folder; a star marks a draft whose content is stored nowhere else.
fn name(state: &State, draft: &Draft) -> String {
    let star = if is_elsewhere(state, draft) { "" } else { "*" };
    format!("{}{star}", draft.short_name())
}

/// The lists of the current draft, each after the key that shows it.
fn lists(state: &State, panel: Panel<'_>) -> Line<'static> {
    let room = state.rooms().plans();
    let Some(draft) = room.drafts().current() else {
        return Line::default();
    };
    let mut spans = Vec::new();
    for kind in ListKind::ALL {
        let is_shown = kind == room.list();
        let (open, close) = if is_shown { ("[", "]") } else { (" ", " ") };
        let role = if is_shown { Role::Title } else { Role::Muted };
        let key = match kind {
            ListKind::Plan => PlansAction::PlanList,
            ListKind::Fence => PlansAction::FenceList,
            ListKind::Rally => PlansAction::RallyList,
        };
        let key = panel.text(&state.key(Action::Plans(key)));
        let words = panel.text(&list_words(kind));
        let count = draft.document().list(kind).len();
        spans.extend([
            Span::styled(open, panel.style(role)),
            Span::styled(format!("{key} "), panel.style(Role::Key)),
            Span::styled(format!("{words} {count}{close}"), panel.style(role)),
        ]);
    }
    Line::from(spans)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(names: &[usize], current: usize, columns: usize) -> Vec<(usize, bool)> {
        let widths = names.iter().map(|&name| TabWidth { name, short: 1 });
        let widths: Vec<TabWidth> = widths.collect();
        let tabs = fitting(&widths, current, columns).into_iter();
        tabs.map(|tab| (tab.index, tab.is_named)).collect()
    }

    #[test]
    fn all_drafts_are_named_where_there_is_room() {
        assert_eq!(shown(&[4, 4], 1, 20), [(0, true), (1, true)]);
        assert!(shown(&[], 0, 20).is_empty());
    }

    #[test]
    fn the_current_draft_is_always_named() {
        let six = [6; 6];
        for current in 0..6 {
            let tabs = shown(&six, current, 40);
            assert_eq!(tabs.len(), 6, "every draft has its sign");
            assert!(tabs.contains(&(current, true)), "{tabs:?}");
            let used: usize = tabs.iter().map(|tab| if tab.1 { 10 } else { 4 }).sum();
            assert!(used <= 40, "{tabs:?}");
        }
        assert_eq!(shown(&[60], 0, 10), [(0, true)]);
    }

    #[test]
    fn of_many_drafts_those_around_the_current_one_are_shown() {
        let many = [8; 40];
        let tabs = shown(&many, 30, 40);
        assert!(tabs.contains(&(30, true)) && tabs.contains(&(29, false)));
        assert!(tabs.len() < 40 && tabs.windows(2).all(|pair| pair[0].0 + 1 == pair[1].0));
    }
}
