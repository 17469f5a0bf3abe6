//! A comparison with the design on the bench: parts, figures, and the changes.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use super::change;
use crate::app::State;
use crate::app::room::workshop::rows;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, put};
use crate::workshop::{Design, Measure, PartSlot};

/// The width of names, the maximum width of a design's parts, and the width of a change, in
/// columns.
const NAME: usize = 20;
const WIDEST: usize = 60;
const CHANGE: usize = 12;

/// Draws the table from its first visible line.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let room = state.rooms().workshop();
    let inner = panel.titled(&panel.say("bench-comparison"), buffer);
    let Some((other, sheet)) = room.compared() else {
        return;
    };
    let column = usize::from(inner.width).saturating_sub(NAME + CHANGE + 3) / 2;
    let table = FigureTable {
        look: panel.look,
        column: column.min(WIDEST),
    };
    let name = |design: &Design| panel.text(&Text::verbatim(design.name.clone()));
    let design = room.bench().design();
    let mut lines = vec![table.line(
        &panel.say("bench-compared"),
        [&name(other), &name(design)],
        None,
        Role::Title,
    )];
    for measure in Measure::of_both(sheet, room.bench().sheet()) {
        let (before, after) = (measure.of(sheet), measure.of(room.bench().sheet()));
        let shown = |value: Option<f64>| value.map_or("-".to_owned(), |it| measure.shown(it));
        let changed = before.zip(after).and_then(|(a, b)| change(measure, a, b));
        let values = [shown(before), shown(after)];
        lines.push(table.line(
            &panel.text(&measure.name()),
            [&values[0], &values[1]],
            changed,
            Role::Text,
        ));
    }
    for slot in PartSlot::ALL {
        lines.extend(table.slot(slot, other, design));
    }
    let room_for = usize::from(inner.height);
    let first = room.scroll().min(lines.len().saturating_sub(room_for));
    panel.at(inner).mark_scroll(first, lines.len(), buffer);
    for (row, line) in lines.into_iter().skip(first).take(room_for).enumerate() {
        put(buffer, inner, row as u16, &line);
    }
}

struct FigureTable<'a> {
    look: &'a Look,
    column: usize,
}

impl FigureTable<'_> {
    fn line(
        &self,
        name: &str,
        [one, two]: [&str; 2],
        changed: Option<(String, Role)>,
        role: Role,
    ) -> Line<'static> {
        let (changed, change_role) = changed.unwrap_or_else(|| (String::new(), Role::Text));
        let cells = format!(
            " {}  {}",
            aligned(one, self.column, false),
            aligned(two, self.column, false)
        );
        Line::from(vec![
            Span::styled(
                format!(" {}", aligned(name, NAME, false)),
                self.look.style(Role::Muted),
            ),
            Span::styled(cells, self.look.style(role)),
            Span::styled(
                aligned(&changed, CHANGE - 2, true),
                self.look.style(change_role),
            ),
        ])
    }

    /// The parts of a slot side by side; differing lines are highlighted.
    fn slot(&self, slot: PartSlot, one: &Design, two: &Design) -> Vec<Line<'static>> {
        let parts = |design: &Design| -> Vec<String> {
            let here = rows(design).into_iter().filter(|row| row.slot == slot);
            here.filter_map(|row| {
                let name = self.look.text(&row.part?.name());
                Some(if row.count > 1 {
                    format!("{} x {name}", row.count)
                } else {
                    name
                })
            })
            .collect()
        };
        let (one, two) = (parts(one), parts(two));
        let count = one.len().max(two.len()).max(1);
        (0..count)
            .map(|at| {
                let of = |parts: &[String]| parts.get(at).map_or("-".to_owned(), Clone::clone);
                let (one, two) = (of(&one), of(&two));
                let name = if at == 0 {
                    self.look.text(&slot.name())
                } else {
                    String::new()
                };
                let differs = one != two;
                let role = if differs { Role::Accent } else { Role::Muted };
                let mark = differs.then(|| (self.look.say("bench-differs"), Role::Accent));
                self.line(&name, [&one, &two], mark, role)
            })
            .collect()
    }
}
