//! The design's figures, and how the part under the cursor would change them.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use super::change;
use crate::app::State;
use crate::app::room::workshop::Pane;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{aligned, put, width};
use crate::workshop::{Measure, Sheet};

/// The width of a change, in columns.
const CHANGE: usize = 8;

/// Draws a line for each measure.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    if panel.area.height == 0 {
        return;
    }
    let room = state.rooms().workshop();
    let candidate = room
        .bench()
        .candidate()
        .filter(|_| room.pane() == Pane::Parts)
        .map(|candidate| &candidate.sheet);
    let title = match candidate {
        Some(_) => "bench-figures-change",
        None => "workshop-figures",
    };
    let inner = panel.titled(&panel.say(title), buffer);
    let fits = room
        .bench()
        .candidate()
        .is_none_or(|it| it.misfit.is_none());
    let table = BenchFigures::new(room.bench().sheet(), candidate, panel.at(inner));
    for (row, figure) in table.rows.iter().enumerate() {
        // A gain is not shown for a part that cannot be used.
        let role = if fits || candidate.is_none() {
            figure.role
        } else {
            Role::Muted
        };
        put(
            buffer,
            inner,
            row as u16,
            &table.line(figure, role, panel.look),
        );
    }
}

/// The figures as rows of three columns: name, value, and the change to another sheet.
struct BenchFigures {
    rows: Vec<BenchFigure>,
    name: usize,
    value: usize,
    change: usize,
}

struct BenchFigure {
    name: String,
    value: String,
    change: String,
    role: Role,
}

impl BenchFigures {
    /// The table in the panel's width. If names would be cut, the values now are left out: the changes tell them.
    fn new(now: &Sheet, then: Option<&Sheet>, panel: Panel<'_>) -> Self {
        let change = if then.is_some() { CHANGE } else { 0 };
        let with = |form: ValueForm| {
            let row = |measure| figure_row(measure, now, then, form, panel.look);
            let shown = then.unwrap_or(now).measures().iter().copied();
            let rows: Vec<BenchFigure> = shown.map(row).collect();
            let widest = |of: fn(&BenchFigure) -> &str| {
                let widths = rows.iter().map(|row| width(of(row)));
                widths.max().unwrap_or(0)
            };
            let value = widest(|row| &row.value);
            // A blank before the names and between the columns.
            let name = panel.width().saturating_sub(value + change + 3);
            let is_cut = widest(|row| &row.name) > name;
            let table = Self {
                rows,
                name,
                value,
                change,
            };
            (table, is_cut)
        };
        match with(ValueForm::BeforeAndAfter) {
            (table, false) => table,
            (_, true) => with(ValueForm::After).0,
        }
    }

    fn line(&self, row: &BenchFigure, role: Role, look: &Look) -> Line<'static> {
        let name = aligned(&row.name, self.name, false);
        Line::from(vec![
            Span::styled(format!(" {name} "), look.style(Role::Muted)),
            Span::raw(aligned(&row.value, self.value, true)),
            Span::styled(
                format!(" {}", aligned(&row.change, self.change, true)),
                look.style(role),
            ),
        ])
    }
}

/// How a value that changes is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ValueForm {
    BeforeAndAfter,
    After,
}

fn figure_row(
    measure: Measure,
    now: &Sheet,
    then: Option<&Sheet>,
    form: ValueForm,
    look: &Look,
) -> BenchFigure {
    let before = measure.of(now);
    let after = then.map_or(before, |sheet| measure.of(sheet));
    let changed = before
        .zip(after)
        .and_then(|(before, after)| change(measure, before, after));
    let value = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |it| measure.figure(it));
    let differs = changed.is_some() || before.is_some() != after.is_some();
    let figures = if differs && form == ValueForm::BeforeAndAfter {
        format!("{} {} {}", value(before), look.arrow(), value(after))
    } else {
        value(after)
    };
    let is_known = match form {
        ValueForm::BeforeAndAfter => before.or(after).is_some(),
        ValueForm::After => after.is_some(),
    };
    let unit = if is_known { measure.unit() } else { "" };
    let (change, role) = changed.unwrap_or_else(|| (String::new(), Role::Text));
    BenchFigure {
        name: look.text(&measure.name()),
        value: format!("{figures} {unit}").trim_end().to_owned(),
        change,
        role,
    }
}
