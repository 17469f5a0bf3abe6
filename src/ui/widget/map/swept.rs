//! Searched or sampled ground, as a light shade below everything else.

use std::collections::BTreeSet;

use ratatui::buffer::Buffer;

use super::squares;
use crate::app::State;
use crate::config::Symbols;
use crate::geo::{LatLon, Viewport};
use crate::mission::Progress;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;

/// The theme role of the shade.
pub const ROLE: Role = Role::Ok;

/// The fill character of searched or sampled cells.
pub const fn sign(symbols: Symbols) -> char {
    match symbols {
        Symbols::Braille | Symbols::Block => '·',
        Symbols::Ascii => ',',
    }
}

/// Whether anything has been searched or sampled.
pub fn is_any(state: &State) -> bool {
    let progress = state.session().mission();
    progress.is_some_and(|progress| grounds(progress).next().is_some())
}

pub fn draw(state: &State, view: &Viewport, panel: Panel<'_>, buffer: &mut Buffer) {
    let Some(progress) = state.session().mission() else {
        return;
    };
    let of = |(middle, side_m): (LatLon, f64)| squares::cells(view, middle, side_m);
    let cells: BTreeSet<_> = grounds(progress).flat_map(of).collect();
    let (sign, style) = (sign(panel.look.symbols), panel.style(ROLE));
    for cell in cells {
        squares::fill(cell, sign, style, panel, buffer);
    }
}

/// The centres of the searched or sampled squares, with the length of their sides.
fn grounds(progress: &Progress) -> impl Iterator<Item = (LatLon, f64)> {
    let searched = progress.swept.iter().map(|it| (it.centre, it.side_m));
    let sampled = progress.cells.iter().filter(|cell| cell.sampled);
    searched.chain(sampled.map(|cell| (cell.centre, cell.side_m)))
}
