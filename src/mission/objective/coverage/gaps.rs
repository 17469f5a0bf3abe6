//! The searched and the missed ground, in as few squares as possible.

use super::CoverageGrid;
use crate::mission::Point;
use crate::mission::objective::GroundPatch;

const MOST: usize = 400;
/// The approximate number of squares on the map of a flight under way.
const MOST_SWEPT: f64 = 1000.0;

/// The missed cells, merged into squares; coarser ones if there would be too many.
pub(super) fn gaps(grid: &CoverageGrid) -> Vec<GroundPatch> {
    let coarsest = grid.columns.max(grid.cells.len() / grid.columns.max(1));
    let tries = (1..=coarsest.max(1)).map(|step| squares(&Blocks::of(grid, step, false)));
    tries
        .into_iter()
        .find(|squares| squares.len() <= MOST)
        .unwrap_or_default()
}

/// The searched ground, with cells merged into blocks so that there are about `MOST_SWEPT` at most.
pub(super) fn swept(grid: &CoverageGrid) -> Vec<GroundPatch> {
    let step = (grid.cells.len() as f64 / MOST_SWEPT).sqrt().ceil();
    let blocks = Blocks::of(grid, step.max(1.0) as usize, true);
    let marked = blocks.marked.iter().enumerate().filter(|(_, it)| **it);
    let patch = |(at, _): (usize, &bool)| {
        let middle =
            |axis: usize, place: usize| blocks.corner[axis] + (place as f64 + 0.5) * blocks.side_m;
        GroundPatch {
            at: [
                middle(0, at % blocks.columns),
                middle(1, at / blocks.columns),
            ],
            side_m: blocks.side_m,
        }
    };
    marked.map(patch).collect()
}

/// Cells in blocks: each block is marked if at least half of its cells are swept, or not swept, as requested.
struct Blocks {
    corner: Point,
    side_m: f64,
    columns: usize,
    marked: Vec<bool>,
}

impl Blocks {
    fn of(grid: &CoverageGrid, step: usize, wants_swept: bool) -> Self {
        let rows = grid.cells.len() / grid.columns;
        let (across, down) = (grid.columns.div_ceil(step), rows.div_ceil(step));
        let is_marked = |block: usize| {
            let (left, low) = (block % across * step, block / across * step);
            let (mut marked, mut all) = (0, 0);
            for row in low..(low + step).min(rows) {
                for column in left..(left + step).min(grid.columns) {
                    if let Some(swept) = grid.cells[row * grid.columns + column] {
                        all += 1;
                        marked += usize::from(swept == wants_swept);
                    }
                }
            }
            marked > 0 && marked * 2 >= all
        };
        Self {
            corner: grid.corner,
            side_m: grid.side_m * step as f64,
            columns: across,
            marked: (0..across * down).map(is_marked).collect(),
        }
    }

    /// Whether a whole square of blocks is marked.
    fn is_marked(&self, place: [usize; 2], size: usize) -> bool {
        let [column, row] = place;
        let rows = self.marked.len() / self.columns;
        column + size <= self.columns
            && row + size <= rows
            && (row..row + size).all(|row| {
                let first = row * self.columns + column;
                self.marked[first..first + size]
                    .iter()
                    .all(|marked| *marked)
            })
    }
}

/// Squares that cover the marked blocks, each as large as possible.
fn squares(blocks: &Blocks) -> Vec<GroundPatch> {
    let mut left = Blocks {
        marked: blocks.marked.clone(),
        ..*blocks
    };
    let mut squares = Vec::new();
    for at in 0..left.marked.len() {
        let place = [at % left.columns, at / left.columns];
        let size = (1..=left.columns)
            .take_while(|size| left.is_marked(place, *size))
            .last();
        let Some(size) = size else {
            continue;
        };
        for row in place[1]..place[1] + size {
            let first = row * left.columns + place[0];
            left.marked[first..first + size].fill(false);
        }
        let middle = |axis: usize, first: usize| {
            left.corner[axis] + (first as f64 + size as f64 / 2.0) * left.side_m
        };
        squares.push(GroundPatch {
            at: [middle(0, place[0]), middle(1, place[1])],
            side_m: left.side_m * size as f64,
        });
    }
    squares
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mission::zone::Shape;

    fn grid(east_m: f64, north_m: f64, side_m: f64) -> CoverageGrid {
        let corners = vec![[0.0, 0.0], [east_m, 0.0], [east_m, north_m], [0.0, north_m]];
        CoverageGrid::new(&Shape::Polygon(corners), side_m)
    }

    fn area_m2(patches: &[GroundPatch]) -> f64 {
        patches
            .iter()
            .map(|patch| patch.side_m * patch.side_m)
            .sum()
    }

    #[test]
    fn what_nobody_has_seen_is_a_few_large_squares() {
        let patches = gaps(&grid(10.0, 40.0, 0.5));
        assert_eq!(patches.len(), 4);
        assert!((area_m2(&patches) - 400.0).abs() < 1e-9);
        let [east_m, north_m] = patches[0].at;
        assert!((east_m - 5.0).abs() + (north_m - 5.0).abs() < 1e-9);
    }

    #[test]
    fn what_has_been_swept_is_no_gap_and_a_strip_between_two_lines_is_one() {
        let mut grid = grid(5.0, 4.0, 1.0);
        for (index, cell) in grid.cells.iter_mut().enumerate() {
            *cell = Some(index % 5 != 2);
        }
        let patches = gaps(&grid);
        let places: Vec<Point> = patches.iter().map(|patch| patch.at).collect();
        assert_eq!(places, [[2.5, 0.5], [2.5, 1.5], [2.5, 2.5], [2.5, 3.5]]);
        assert!((area_m2(&swept(&grid)) - 16.0).abs() < 1e-9);
        grid.cells.fill(Some(true));
        assert_eq!(gaps(&grid), []);
        grid.cells.fill(Some(false));
        assert_eq!(swept(&grid), []);
    }

    #[test]
    fn a_pattern_of_thousands_of_holes_is_told_in_fewer_squares() {
        let mut grid = grid(100.0, 100.0, 1.0);
        for (index, cell) in grid.cells.iter_mut().enumerate() {
            *cell = Some((index + index / 100) % 2 == 0);
        }
        let patches = gaps(&grid);
        assert!(
            !patches.is_empty() && patches.len() <= MOST,
            "{}",
            patches.len()
        );
        grid.cells.fill(Some(true));
        let patches = swept(&grid);
        assert!(patches.len() as f64 <= MOST_SWEPT, "{}", patches.len());
        assert!(area_m2(&patches) >= 10_000.0);
    }
}
