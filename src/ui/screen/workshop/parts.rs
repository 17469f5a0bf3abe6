//! The parts for the slot under the cursor, and the effect of each.

use ratatui::buffer::Buffer;
use ratatui::style::Style;
use ratatui::text::{Line, Span};

use super::{change, first_shown, put_wrapped, show_cursor};
use crate::app::State;
use crate::app::action::{Action, WorkshopAction};
use crate::app::room::workshop::{Candidate, Licence, Pane, licence};
use crate::text;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, below, columns, put, row_of, upper, width as width_of, wrap};
use crate::workshop::{DesignKind, Measure, PartSlot, Sheet};

/// The columns before a name: the cursor, a blank, the mark, a blank.
const LEAD: usize = 4;
/// The width of a part's price, or of the reason why it is locked, in columns.
const LICENCE: usize = 8;
/// The widths of a change, and of a change with the name of the measure, in columns.
const CHANGE: usize = 8;
const WIDE_CHANGE: usize = 12;
/// The minimum width of a name, and the width at which no name is cut, in columns.
const NAME: usize = 16;
const LONG_NAME: usize = 34;
/// The number of rows of the details of the part under the cursor.
const DETAIL: u16 = 5;

/// Draws the list, and below it the details of the part under the cursor.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let bench = state.rooms().workshop().bench();
    let layout = PartColumns::new(state, panel.look, panel.area.width);
    let has_keys = state.rooms().workshop().pane() == Pane::Parts;
    let slot = bench.sheet().kind.slot_name(bench.slot());
    let title = layout.title(&panel.text(&slot), panel.look);
    let mut inner = panel.focused(&title, has_keys, buffer);
    if layout.shown.len() > 1 {
        let style = panel.style(Role::Muted);
        put(
            buffer,
            inner,
            0,
            &Line::styled(layout.heading(panel.look), style),
        );
        inner = below(inner, 1);
    }
    let candidates = bench.candidates();
    let most = inner.height.saturating_sub(DETAIL);
    let list = upper(inner, most.min(candidates.len() as u16 + 1));
    let cursor = bench.at();
    let first = first_shown(cursor, candidates.len(), list.height);
    let shown = candidates.iter().enumerate().skip(first);
    for (at, candidate) in shown.take(usize::from(list.height)) {
        let place = row_of(list, (at - first) as u16);
        put(
            buffer,
            place,
            0,
            &layout.line(state, candidate, bench.sheet(), panel.look),
        );
        if at == cursor {
            show_cursor(panel.look, has_keys, place, buffer);
        }
    }
    panel
        .at(list)
        .mark_list(first, candidates.len(), has_keys, buffer);
    if let Some(candidate) = bench.candidate() {
        let place = columns(below(inner, list.height), 1, inner.width.saturating_sub(1));
        draw_detail(state, candidate, panel.at(place), buffer);
    }
}

struct PartColumns {
    name: usize,
    licence: usize,
    /// The measures, with the widths of their columns.
    shown: Vec<(Measure, usize)>,
    width: usize,
}

impl PartColumns {
    fn new(state: &State, look: &Look, columns: u16) -> Self {
        let bench = state.rooms().workshop().bench();
        let width = usize::from(columns);
        let licence = if state.training().career().is_some() {
            LICENCE
        } else {
            0
        };
        let flies = |sheet: &Sheet| sheet.performance.is_some();
        let has_figures =
            flies(bench.sheet()) || bench.candidates().iter().any(|it| flies(&it.sheet));
        let telling = telling(bench.slot(), bench.sheet().kind, has_figures);
        let room = width.saturating_sub(LEAD + licence);
        if room < LONG_NAME + 2 * WIDE_CHANGE {
            let shown: Vec<_> = telling.iter().take(1).map(|it| (*it, CHANGE)).collect();
            let name = room.saturating_sub(CHANGE * shown.len());
            return Self {
                name,
                licence,
                shown,
                width,
            };
        }
        let candidates = bench.candidates().iter();
        let names = candidates.map(|it| width_of(&look.text(&it.part.name())));
        let name = names.max().unwrap_or(0).clamp(NAME, LONG_NAME) + 1;
        let mut left = room.saturating_sub(name);
        let wanted = telling.iter().map(|measure| {
            let heading = width_of(&look.text(&measure.name()));
            (*measure, (heading + 2).max(WIDE_CHANGE))
        });
        let shown = wanted.take_while(|(_, columns)| {
            let fits = *columns <= left;
            left = left.saturating_sub(*columns);
            fits
        });
        Self {
            name,
            licence,
            shown: shown.collect(),
            width,
        }
    }

    /// The slot, and the measure if there is only one.
    fn title(&self, slot: &str, look: &Look) -> String {
        match self.shown.as_slice() {
            [(only, _)] => format!("{slot}: {}", look.text(&only.name())),
            _ => slot.to_owned(),
        }
    }

    fn heading(&self, look: &Look) -> String {
        let before = " ".repeat(LEAD + self.name + self.licence);
        let names = self.shown.iter().map(|(measure, columns)| {
            let name = look.text(&measure.name());
            aligned(&name, *columns, true)
        });
        before + &names.collect::<String>()
    }

    fn line(
        &self,
        state: &State,
        candidate: &Candidate,
        before: &Sheet,
        look: &Look,
    ) -> Line<'static> {
        let (mark, role) = match (candidate.on_board, &candidate.misfit) {
            (1.., _) => ('●', Role::Accent),
            (0, Some(_)) => ('×', Role::Muted),
            (0, None) => (' ', Role::Text),
        };
        let name = look.text(&candidate.part.name());
        let mut spans = vec![Span::styled(
            format!("  {mark} {}", aligned(&name, self.name, false)),
            look.style(role),
        )];
        if self.licence > 0 {
            let (words, role) = short(&licence(state, candidate.part), look);
            let words = aligned(&words, self.licence, true);
            spans.push(Span::styled(words, look.style(role)));
        }
        match &candidate.misfit {
            Some(reason) if self.shown.len() > 1 => {
                let used = LEAD + self.name + self.licence;
                let room = self.width.saturating_sub(used + 2);
                let reason = aligned(&look.text(reason), room, false);
                spans.push(Span::styled(format!("  {reason}"), look.style(Role::Muted)));
            }
            // A part that cannot be used brings no gain.
            Some(_) => spans.extend(self.no_changes(look)),
            None => spans.extend(self.changes(&candidate.sheet, before, look)),
        }
        Line::from(spans)
    }

    /// A dash in each column.
    fn no_changes(&self, look: &Look) -> Vec<Span<'static>> {
        let dash = |&(_, columns): &(Measure, usize)| {
            Span::styled(aligned("-", columns, true), look.style(Role::Muted))
        };
        self.shown.iter().map(dash).collect()
    }

    fn changes(&self, after: &Sheet, before: &Sheet, look: &Look) -> Vec<Span<'static>> {
        let cell = |(measure, columns): &(Measure, usize)| {
            let (text, role) = match (measure.of(before), measure.of(after)) {
                (Some(before), Some(after)) => {
                    change(*measure, before, after).unwrap_or_else(|| ("=".to_owned(), Role::Muted))
                }
                (None, Some(after)) => (measure.figure(after), Role::Text),
                (_, None) => ("-".to_owned(), Role::Muted),
            };
            let text = aligned(&text, *columns, true);
            Span::styled(text, look.style(role))
        };
        self.shown.iter().map(cell).collect()
    }
}

/// The most important measures for a slot.
fn telling(slot: PartSlot, kind: DesignKind, has_figures: bool) -> &'static [Measure] {
    match kind {
        DesignKind::Drone => telling_of_drone(slot, has_figures),
        DesignKind::Robot | DesignKind::Boat => telling_of_driven(slot, has_figures),
    }
}

fn telling_of_driven(slot: PartSlot, has_figures: bool) -> &'static [Measure] {
    use Measure::{Cost, DriveRange, DriveTime, Load, Mass, Pull, RadioReach, TopSpeed};
    match slot {
        PartSlot::Radio if has_figures => &[RadioReach, DriveTime, Mass, Cost],
        PartSlot::Radio => &[RadioReach, Mass, Cost],
        _ if !has_figures => &[Mass, Cost],
        PartSlot::Frame | PartSlot::Motor => &[TopSpeed, Pull, DriveTime, Load, Mass, Cost],
        _ => &[DriveTime, DriveRange, Load, TopSpeed, Mass, Cost],
    }
}

fn telling_of_drone(slot: PartSlot, has_figures: bool) -> &'static [Measure] {
    use Measure::{Cost, HoverTime, Mass, RadioReach, Range, Ratio, Spare, TopSpeed};
    match slot {
        PartSlot::Radio if has_figures => &[RadioReach, HoverTime, Mass, Cost],
        PartSlot::Radio => &[RadioReach, Mass, Cost],
        _ if !has_figures => &[Mass, Cost],
        PartSlot::Battery => &[HoverTime, Ratio, Range, TopSpeed, Mass, Cost],
        PartSlot::Frame | PartSlot::Motor | PartSlot::Propeller | PartSlot::Esc => {
            &[HoverTime, Ratio, TopSpeed, Range, Mass, Cost]
        }
        PartSlot::Autopilot | PartSlot::Navigation | PartSlot::Power | PartSlot::Payload => {
            &[HoverTime, Ratio, Range, Spare, Mass, Cost]
        }
    }
}

/// The price or the lock of a part as a single word; empty for a part that may be used.
fn short(licence: &Licence, look: &Look) -> (String, Role) {
    match licence {
        Licence::Held => (String::new(), Role::Muted),
        Licence::ForSale(price) => (format!("{price} cr"), Role::Accent),
        Licence::Locked(_) => (look.say("bench-locked"), Role::Locked),
    }
}

/// That a frame, chassis or hull would make the design another kind of vehicle.
fn begins(state: &State, candidate: &Candidate) -> Option<Text> {
    let (before, after) = (
        state.rooms().workshop().bench().sheet().kind,
        candidate.sheet.kind,
    );
    let begins = || text!("bench-begins", kind = after.name(), before = before.name());
    (before != after).then(begins)
}

/// Draws the part's full name, its price, whether it may be used, and why it does not fit.
fn draw_detail(state: &State, candidate: &Candidate, panel: Panel<'_>, buffer: &mut Buffer) {
    let part = candidate.part;
    let whole = text!(
        "bench-part",
        name = part.name(),
        mass = format!("{:.0}", part.mass_g),
        price = part.credits
    );
    let mut texts: Vec<(String, Style)> = vec![(panel.text(&whole), panel.style(Role::Title))];
    if let Some(reason) = &candidate.misfit {
        let reason = text!("bench-misfit", reason = reason.clone());
        texts.push((panel.text(&reason), panel.style(Role::Danger)));
    }
    texts.extend(
        begins(state, candidate).map(|begins| (panel.text(&begins), panel.style(Role::Warning))),
    );
    let held = match licence(state, part) {
        Licence::Held => None,
        Licence::ForSale(price) => Some(text!(
            "bench-for-sale",
            price = price,
            key = state.key(Action::Workshop(WorkshopAction::BuyPart))
        )),
        Licence::Locked(mission) => Some(text!("bench-locked-by", mission = mission)),
    };
    texts.extend(held.map(|held| (panel.text(&held), panel.style(Role::Accent))));
    if candidate.on_board > 0 {
        let text = text!("bench-on-board", count = candidate.on_board);
        texts.push((panel.text(&text), panel.style(Role::Muted)));
    }
    if part.slot() == PartSlot::Radio {
        let about = match state.rooms().workshop().bench().sheet().kind {
            DesignKind::Drone => "bench-radio",
            DesignKind::Robot | DesignKind::Boat => "bench-ground-radio",
        };
        texts.push((panel.say(about), panel.style(Role::Muted)));
    }
    let rows = |(text, _): &(String, Style)| wrap(text, usize::from(panel.area.width)).len();
    while texts.iter().map(rows).sum::<usize>() > usize::from(panel.area.height) && texts.len() > 2
    {
        texts.pop();
    }
    put_wrapped(&texts, panel.area, buffer);
}
