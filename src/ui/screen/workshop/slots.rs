//! The parts of the design, slot by slot.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use super::{first_shown, show_cursor};
use crate::app::State;
use crate::app::room::workshop::{Pane, SlotRow, is_saved};
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, put, row_of, width as width_of};
use crate::workshop::{Design, FindingSeverity, PartSlot};

/// The largest share of the width for the names of slots, in percent.
const NAMES_PERCENT: usize = 45;
/// The minimum width at which mass and price are shown as well, in columns.
const ROOMY: usize = 50;
/// The widths of mass and price, in columns.
const MASS: usize = 8;
const PRICE: usize = 8;

pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let room = state.rooms().workshop();
    let name = panel.text(&Text::verbatim(room.bench().design().name.clone()));
    let title = if is_saved(state) {
        name
    } else {
        format!("{name} ({})", panel.say("bench-not-saved"))
    };
    let has_keys = room.pane() == Pane::Slots;
    let inner = panel.focused(&title, has_keys, buffer);
    let rows = room.bench().rows();
    let cursor = room.bench().row();
    let first = first_shown(cursor, rows.len(), inner.height);
    let width = usize::from(inner.width);
    let kind = room.bench().sheet().kind;
    let names = rows
        .iter()
        .map(|row| width_of(&panel.text(&kind.slot_name(row.slot))));
    let name = names.max().unwrap_or(0).min(width * NAMES_PERCENT / 100);
    let shown = rows.iter().enumerate().skip(first);
    for (at, row) in shown.take(usize::from(inner.height)) {
        let place = row_of(inner, (at - first) as u16);
        let is_first = at == 0 || rows[at - 1].slot != row.slot;
        let severity = room.bench().severity(row.slot).filter(|_| is_first);
        let line = SlotLine {
            there: row,
            is_first,
            severity,
            wide: width >= ROOMY,
            name,
            width,
        };
        put(
            buffer,
            place,
            0,
            &line.drawn(room.bench().design(), panel.look),
        );
        if at == cursor {
            show_cursor(panel.look, has_keys, place, buffer);
        }
    }
    panel
        .at(inner)
        .mark_list(first, rows.len(), has_keys, buffer);
}

struct SlotLine<'a> {
    there: &'a SlotRow,
    is_first: bool,
    severity: Option<FindingSeverity>,
    wide: bool,
    /// The width of the names of slots, in columns.
    name: usize,
    width: usize,
}

impl SlotLine<'_> {
    fn drawn(&self, design: &Design, look: &Look) -> Line<'static> {
        let slot = if self.is_first {
            look.text(&design.kind().slot_name(self.there.slot))
        } else {
            String::new()
        };
        let (mark, role) = match self.severity {
            Some(FindingSeverity::Fault) => ("×", Role::Danger),
            Some(FindingSeverity::Warning) => ("!", Role::Warning),
            None => (" ", Role::Muted),
        };
        let name = self.name;
        let figures = if self.wide { MASS + PRICE } else { 0 };
        let rest = self.width.saturating_sub(name + 4 + figures);
        let (words, part_role) = self.part(design, look);
        let mut spans = vec![
            Span::raw(" "),
            Span::styled(format!("{mark} "), look.style(role)),
            Span::styled(
                format!("{} ", aligned(&slot, name, false)),
                look.style(Role::Muted),
            ),
            Span::styled(aligned(&words, rest, false), look.style(part_role)),
        ];
        if self.wide
            && let Some((mass_g, credits)) = self.whole(design)
        {
            let mass = aligned(&format!("{mass_g:.0} g"), MASS, true);
            let price = aligned(&format!("{credits} cr"), PRICE, true);
            spans.push(Span::raw(mass + &price));
        }
        Line::from(spans)
    }

    fn pieces(&self, design: &Design) -> u32 {
        let count = self.there.count as u32;
        if self.there.slot.is_per_motor() {
            count * u32::from(design.motors())
        } else {
            count
        }
    }

    fn part(&self, design: &Design, look: &Look) -> (String, Role) {
        let Some(part) = self.there.part else {
            let (words, role) = if self.there.slot == PartSlot::Payload {
                ("bench-add-payload", Role::Muted)
            } else {
                ("bench-none-yet", Role::Danger)
            };
            return (look.say(words), role);
        };
        let name = look.text(&part.name());
        let pieces = self.pieces(design);
        let words = if pieces > 1 {
            format!("{pieces} x {name}")
        } else {
            name
        };
        (words, Role::Text)
    }

    /// The mass in grams and the price of all pieces; `None` for an empty slot.
    fn whole(&self, design: &Design) -> Option<(f64, u32)> {
        let part = self.there.part?;
        let pieces = self.pieces(design);
        Some((part.mass_g * f64::from(pieces), part.credits * pieces))
    }
}
