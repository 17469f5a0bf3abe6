//! The columns of the swarm table, and their widths.

use super::cells::Words;
use crate::app::State;
use crate::config::Column;
use crate::ui::look::Look;
use crate::ui::widget::width;

/// A column as shown.
pub struct Shown {
    pub column: Column,
    pub title: String,
    pub width: u16,
    /// Whether the column is aligned to the right, as numbers are.
    pub right: bool,
}

struct ColumnForm {
    column: Column,
    title: &'static str,
    /// The minimum width; the column of alerts also gets the remaining width.
    width: u16,
    /// The priority of the column: narrow screens keep the columns with the lowest ranks.
    rank: u8,
    right: bool,
}

/// Columns of this rank and above are shown only if alerts then have this much more room than they
/// need, in columns.
const EXTRA_RANK: u8 = 14;
const ALERT_EXTRA: u16 = 26;
/// Columns of this rank and above are shown only once alerts have this much more room than their
/// minimum, so that alerts are rarely cut.
const MORE_RANK: u8 = 8;
const ALERT_MORE: u16 = 5;
/// Columns of this rank are only shown on request.
const ASKED: u8 = 100;

/// The columns in the order of display; ranks determine which ones are dropped on narrow screens.
const FORMS: &[ColumnForm] = &[
    form(Column::Id, "column-id", 3, 0, true),
    form(Column::Name, "column-name", 7, 13, false),
    form(Column::Group, "column-group", 5, 10, false),
    // Wide enough for the beginning of a user name.
    form(Column::Pilot, "column-pilot", 6, 2, false),
    form(Column::Mode, "column-mode", 9, 2, false),
    form(Column::Armed, "column-armed", 5, 3, false),
    form(Column::State, "column-state", 6, 7, false),
    form(Column::Altitude, "column-alt", 6, 4, true),
    form(Column::Speed, "column-speed", 4, 8, true),
    form(Column::Battery, "column-bat", 4, 5, true),
    form(Column::Gps, "column-gps", 8, 12, false),
    form(Column::Link, "column-link", 5, 9, true),
    form(Column::Home, "column-home", 6, 11, true),
    // Wide enough for `takeoff timed out`.
    form(Column::Command, "column-command", 17, 6, false),
    form(Column::Item, "column-item", 5, 7, true),
    form(Column::Next, "column-next", 11, 12, true),
    form(Column::End, "column-end", 6, 10, true),
    form(Column::ToGo, "column-to-go", 7, 14, true),
    form(Column::Heading, "column-heading", 3, 15, true),
    form(Column::Climb, "column-climb", 5, 16, true),
    form(Column::Voltage, "column-volt", 4, 17, true),
    form(Column::Current, "column-amps", 5, ASKED, true),
    form(Column::Used, "column-used", 5, ASKED, true),
    form(Column::Hdop, "column-hdop", 4, ASKED, true),
    form(Column::RoundTrip, "column-round-trip", 5, ASKED, true),
    form(Column::Ekf, "column-ekf", 4, ASKED, true),
    form(Column::Vibration, "column-vibe", 4, ASKED, true),
    form(Column::Sea, "column-sea", 6, ASKED, true),
    form(Column::Latitude, "column-lat", 10, ASKED, true),
    form(Column::Longitude, "column-lon", 11, ASKED, true),
    form(Column::Alert, "column-alert", 17, 1, false),
];

const fn form(
    column: Column,
    title: &'static str,
    width: u16,
    rank: u8,
    right: bool,
) -> ColumnForm {
    ColumnForm {
        column,
        title,
        width,
        rank,
        right,
    }
}

/// The columns that fit into a width: those that the user has chosen, otherwise by rank.
pub fn columns(state: &State, words: &Words, look: &Look, room: u16) -> Vec<Shown> {
    let chosen = &state.config().table.columns;
    let (mut columns, left) = if chosen.is_empty() {
        by_rank(state, words, look, room)
    } else {
        in_order(chosen, words, look, room)
    };
    let alert = columns.iter_mut().find(|it| it.column == Column::Alert);
    if let Some(alert) = alert {
        alert.width += left;
    }
    columns
}

/// The chosen columns in order until one no longer fits, and the remaining width.
fn in_order(chosen: &[Column], words: &Words, look: &Look, room: u16) -> (Vec<Shown>, u16) {
    let forms = chosen
        .iter()
        .filter_map(|column| FORMS.iter().find(|form| form.column == *column));
    let mut left = room;
    let mut columns = Vec::new();
    for form in forms {
        let shown = form.shown(words, look);
        // An alert is useful even with little room.
        let least = if form.column == Column::Alert {
            8
        } else {
            shown.width
        };
        if least + 1 > left {
            break;
        }
        let width = shown.width.min(left - 1);
        left -= width + 1;
        columns.push(Shown { width, ..shown });
    }
    (columns, left)
}

fn by_rank(state: &State, words: &Words, look: &Look, room: u16) -> (Vec<Shown>, u16) {
    let has_groups = !state.session().groups().is_empty();
    let has_pilots = state.session().pilots().are_several();
    let is_plan_flown = state.session().is_plan_flown();
    let is_offered = |form: &&ColumnForm| match form.column {
        Column::Group => has_groups,
        Column::Pilot => has_pilots,
        Column::Item | Column::Next | Column::End => is_plan_flown,
        _ => form.rank < ASKED,
    };
    let mut by_rank: Vec<(u8, Shown)> = FORMS
        .iter()
        .filter(is_offered)
        .map(|form| {
            // While a plan is flown, its item is more informative than the state.
            let rank = match form.column {
                Column::State if is_plan_flown => MORE_RANK,
                _ => form.rank,
            };
            (rank, form.shown(words, look))
        })
        .collect();
    by_rank.sort_by_key(|(rank, _)| *rank);
    let mut left = room;
    let mut kept = Vec::new();
    for (rank, shown) in by_rank {
        let spared = match rank {
            EXTRA_RANK.. => ALERT_EXTRA,
            MORE_RANK.. => ALERT_MORE,
            _ => 0,
        };
        if shown.width + 1 + spared > left {
            break;
        }
        left -= shown.width + 1;
        kept.push(shown);
    }
    let place = |column: Column| FORMS.iter().position(|form| form.column == column);
    kept.sort_by_key(|shown| place(shown.column));
    (kept, left)
}

impl ColumnForm {
    fn shown(&self, words: &Words, look: &Look) -> Shown {
        let title = look.say(self.title);
        let said: &[&String] = match self.column {
            Column::Armed => &[&words.armed, &words.ready, &words.off],
            Column::State => &[
                &words.ground,
                &words.air,
                &words.takeoff,
                &words.landing,
                &words.paused,
            ],
            Column::Link => &[&words.lost],
            _ => &[],
        };
        let longest = said.iter().map(|word| width(word)).max().unwrap_or(0);
        let widest = longest.max(width(&title)) as u16;
        Shown {
            column: self.column,
            title,
            width: self.width.max(widest),
            right: self.right,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::{App, Setup};
    use crate::text::said::without_words;

    #[test]
    fn which_columns_are_shown_does_not_depend_on_the_words() {
        let chosen: [&[Column]; 2] = [&[], &[Column::Id, Column::Alert, Column::Mode, Column::Sea]];
        for columns_chosen in chosen {
            let mut setup = Setup::default();
            setup.config.table.columns = columns_chosen.to_vec();
            let app = App::new(setup);
            // Words can widen columns; at these widths all columns fit, so only the rules decide.
            for room in 400..402 {
                let shown = || -> Vec<Column> {
                    let look = Look::default();
                    let shown = columns(app.state(), &Words::new(&look), &look, room);
                    shown.iter().map(|shown| shown.column).collect()
                };
                assert_eq!(without_words(shown), shown(), "{room} columns");
            }
        }
    }
}
