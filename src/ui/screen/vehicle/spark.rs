//! A curve of a few rows from a list of readings.

use std::ops::RangeInclusive;

use ratatui::layout::Size;

use crate::config::Symbols;

/// Levels of one row, from nothing to full.
const BLOCKS: [char; 9] = [' ', '▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];
const LETTERS: [char; 9] = [' ', '_', '.', '-', '-', '=', '+', '*', '#'];

/// The rows of a curve, from the top. `readings` end now; `samples` is the capacity of the span, so that a shorter
/// curve starts inside it. Gaps stay blank. `range` gives the values at the bottom and at the top.
pub fn rows(
    readings: &[Option<f32>],
    samples: usize,
    range: &RangeInclusive<f32>,
    size: Size,
    symbols: Symbols,
) -> Vec<String> {
    let (width, height) = (usize::from(size.width), usize::from(size.height));
    let levels = if symbols == Symbols::Ascii {
        LETTERS
    } else {
        BLOCKS
    };
    let steps = height * (levels.len() - 1);
    let heights: Vec<Option<usize>> = columns(readings, samples, width)
        .into_iter()
        .map(|value| value.map(|value| step(value, range, steps)))
        .collect();
    (0..height)
        .rev()
        .map(|row| {
            let below = row * (levels.len() - 1);
            let row = heights.iter().map(|height| {
                let filled = height.map_or(0, |height| height.saturating_sub(below));
                levels[filled.min(levels.len() - 1)]
            });
            row.collect()
        })
        .collect()
}

/// The height of a value: at least one step, to distinguish it from a gap.
fn step(value: f32, range: &RangeInclusive<f32>, steps: usize) -> usize {
    let (low, high) = (*range.start(), *range.end());
    let share = if high > low {
        ((value - low) / (high - low)).clamp(0.0, 1.0)
    } else {
        0.0
    };
    1 + (share * (steps - 1) as f32).round() as usize
}

/// One value per column: the mean of the readings that fall into it.
fn columns(readings: &[Option<f32>], samples: usize, width: usize) -> Vec<Option<f32>> {
    let missing = samples.saturating_sub(readings.len());
    (0..width)
        .map(|column| {
            // A span with fewer samples than columns gives each sample several columns.
            let from = column * samples / width;
            let to = ((column + 1) * samples / width).max(from + 1);
            let known = (from.max(missing)..to.max(missing))
                .filter_map(|at| readings.get(at - missing).copied().flatten());
            let (sum, count) =
                known.fold((0.0, 0u16), |(sum, count), value| (sum + value, count + 1));
            (count > 0).then(|| sum / f32::from(count))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_rises_from_left_to_right_and_shows_gaps() {
        let readings = [Some(0.0), None, Some(5.0), Some(10.0)];
        let curve =
            |height, symbols| rows(&readings, 4, &(0.0..=10.0), Size::new(4, height), symbols);
        assert_eq!(curve(1, Symbols::Block), ["▁ ▅█"]);
        assert_eq!(curve(2, Symbols::Block), ["  ▁█", "▁ ██"]);
        assert_eq!(curve(1, Symbols::Ascii), ["_ =#"]);
    }

    #[test]
    fn a_young_curve_ends_at_the_right_and_a_flat_one_lies_low() {
        let readings = [Some(3.0), Some(3.0)];
        assert_eq!(
            rows(&readings, 8, &(3.0..=3.0), Size::new(8, 1), Symbols::Block),
            ["      ▁▁"]
        );
    }

    #[test]
    fn readings_are_averaged_where_there_are_more_than_columns() {
        let readings: Vec<_> = (0..100u8).map(|at| Some(f32::from(at))).collect();
        assert_eq!(columns(&readings, 100, 2), [Some(24.5), Some(74.5)]);
        assert_eq!(columns(&readings[98..], 2, 4).len(), 4);
        assert_eq!(columns(&[], 60, 3), [None, None, None]);
    }
}
