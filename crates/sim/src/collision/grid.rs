//! A hash grid over the ground, to find the bodies near a point.

use glam::DVec3;

/// The side of a cell, in metres: several times the reach of a search, so most searches need only
/// one cell.
const CELL_M: f64 = 4.0;
/// The end of a chain.
const NONE: u32 = u32::MAX;

/// Cells are chains in a table of at least twice as many slots as bodies. Different cells may share
/// a slot, so each body stores its cell.
#[derive(Debug, Clone, Default)]
pub(super) struct CollisionGrid {
    heads: Vec<u32>,
    /// Per body: its cell and the next body of the chain.
    links: Vec<((i32, i32), u32)>,
}

impl CollisionGrid {
    /// Fills the grid with these bodies, numbered in order.
    pub(super) fn fill(&mut self, centres: impl ExactSizeIterator<Item = DVec3>) {
        let slots = (2 * centres.len()).next_power_of_two();
        self.heads.clear();
        self.heads.resize(slots, NONE);
        self.links.clear();
        for (body, centre) in centres.enumerate() {
            let cell = (cell(centre.x), cell(centre.y));
            let slot = self.slot(cell.0, cell.1);
            self.links.push((cell, self.heads[slot]));
            self.heads[slot] = body as u32;
        }
    }

    /// Calls `found` once for every body in the cells that a circle around a point touches.
    pub(super) fn near(&self, centre: DVec3, reach_m: f64, mut found: impl FnMut(usize)) {
        for north in cell(centre.x - reach_m)..=cell(centre.x + reach_m) {
            for east in cell(centre.y - reach_m)..=cell(centre.y + reach_m) {
                let mut next = self.heads[self.slot(north, east)];
                while let Some((own, after)) = self.links.get(next as usize) {
                    if *own == (north, east) {
                        found(next as usize);
                    }
                    next = *after;
                }
            }
        }
    }

    fn slot(&self, north: i32, east: i32) -> usize {
        let mixed =
            (north as u32).wrapping_mul(0x9E37_79B1) ^ (east as u32).wrapping_mul(0x85EB_CA77);
        (mixed ^ (mixed >> 15)) as usize & (self.heads.len() - 1)
    }
}

/// The row or column of a coordinate; values out of range share the last one. Rounds down without
/// `floor`, which is a function call on the oldest processors.
fn cell(metres: f64) -> i32 {
    let cells = metres / CELL_M;
    let towards_zero = cells as i32;
    towards_zero.saturating_sub(i32::from(f64::from(towards_zero) > cells))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_rounded_down() {
        let far = f64::from(i32::MAX) * CELL_M;
        for metres in [
            0.0,
            -0.0,
            0.1,
            -0.1,
            3.999,
            4.0,
            -4.0,
            -4.001,
            1e7,
            -1e7,
            far,
            -far,
            2.0 * far,
            -2.0 * far,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::NAN,
        ] {
            assert_eq!(cell(metres), (metres / CELL_M).floor() as i32, "{metres}");
        }
    }
}
