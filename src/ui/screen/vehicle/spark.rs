//! A curve of a few rows from a list of readings.

use std::ops::RangeInclusive;

use ratatui::layout::Size;

use crate::config::Symbols;

/// The levels of one row, from empty to full.
const BLOCKS: [char; 9] = [' ', '▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];
const LETTERS: [char; 9] = [' ', '_', '.', '-', '-', '=', '+', '*', '#'];

/// How a column combines several readings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Merge {
    Mean,
    Least,
    Most,
}

/// A curve to draw.
pub struct Spark<'a> {
    /// The readings up to now, oldest first. Gaps stay blank.
    pub readings: &'a [Option<f32>],
    /// The number of readings that fill the width; with fewer, the curve starts further right.
    pub samples: usize,
    /// The values at the bottom and at the top.
    pub range: RangeInclusive<f32>,
    pub merge: Merge,
}

/// The rows of a curve, from the top.
pub fn rows(spark: &Spark<'_>, size: Size, symbols: Symbols) -> Vec<String> {
    let (width, height) = (usize::from(size.width), usize::from(size.height));
    let levels = if symbols == Symbols::Ascii {
        LETTERS
    } else {
        BLOCKS
    };
    let steps = height * (levels.len() - 1);
    let heights: Vec<Option<usize>> = columns(spark, width)
        .into_iter()
        .map(|value| value.map(|value| step(value, &spark.range, steps)))
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

/// The height of a value in steps: at least one, to distinguish it from a gap.
fn step(value: f32, range: &RangeInclusive<f32>, steps: usize) -> usize {
    let (low, high) = (*range.start(), *range.end());
    let share = if high > low {
        ((value - low) / (high - low)).clamp(0.0, 1.0)
    } else {
        0.0
    };
    1 + (share * (steps - 1) as f32).round() as usize
}

/// One value per column, combined from the readings in it.
fn columns(spark: &Spark<'_>, width: usize) -> Vec<Option<f32>> {
    let (readings, samples) = (spark.readings, spark.samples);
    let missing = samples.saturating_sub(readings.len());
    (0..width)
        .map(|column| {
            // A span with fewer samples than columns gives each sample several columns.
            let from = column * samples / width;
            let to = ((column + 1) * samples / width).max(from + 1);
            let known: Vec<f32> = (from.max(missing)..to.max(missing))
                .filter_map(|at| readings.get(at - missing).copied().flatten())
                .collect();
            let first = known.first().copied()?;
            let rest = known.iter().copied();
            Some(match spark.merge {
                Merge::Mean => rest.sum::<f32>() / known.len() as f32,
                Merge::Least => rest.fold(first, f32::min),
                Merge::Most => rest.fold(first, f32::max),
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spark(readings: &[Option<f32>], samples: usize, range: RangeInclusive<f32>) -> Spark<'_> {
        Spark {
            readings,
            samples,
            range,
            merge: Merge::Mean,
        }
    }

    #[test]
    fn a_curve_rises_from_left_to_right_and_shows_gaps() {
        let readings = [Some(0.0), None, Some(5.0), Some(10.0)];
        let spark = spark(&readings, 4, 0.0..=10.0);
        let curve = |height, symbols| rows(&spark, Size::new(4, height), symbols);
        assert_eq!(curve(1, Symbols::Block), ["▁ ▅█"]);
        assert_eq!(curve(2, Symbols::Block), ["  ▁█", "▁ ██"]);
        assert_eq!(curve(1, Symbols::Ascii), ["_ =#"]);
    }

    #[test]
    fn a_young_curve_ends_at_the_right_and_a_flat_one_lies_low() {
        let readings = [Some(3.0), Some(3.0)];
        assert_eq!(
            rows(
                &spark(&readings, 8, 3.0..=3.0),
                Size::new(8, 1),
                Symbols::Block
            ),
            ["      ▁▁"]
        );
    }

    #[test]
    fn readings_are_averaged_where_there_are_more_than_columns() {
        let readings: Vec<_> = (0..100u8).map(|at| Some(f32::from(at))).collect();
        let all = spark(&readings, 100, 0.0..=1.0);
        assert_eq!(columns(&all, 2), [Some(24.5), Some(74.5)]);
        assert_eq!(columns(&spark(&readings[98..], 2, 0.0..=1.0), 4).len(), 4);
        let none = columns(&spark(&[], 60, 0.0..=1.0), 3);
        assert_eq!(none, [None, None, None]);
    }

    #[test]
    fn a_peak_of_one_reading_stays_visible_where_the_worst_counts() {
        let mut readings = vec![Some(5.0); 600];
        (readings[100], readings[400]) = (Some(60.0), Some(1.0));
        for (merge, expected) in [(Merge::Most, [60.0, 5.0]), (Merge::Least, [5.0, 1.0])] {
            let all = Spark {
                merge,
                ..spark(&readings, 600, 0.0..=60.0)
            };
            assert_eq!(columns(&all, 2), expected.map(Some));
        }
    }
}
