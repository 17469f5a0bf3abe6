//! Prints the simulator's inventory as the rows of the table in `docs/simulator.md`.
//!
//! `cargo run -p sortie-sim --example inventory`

use sortie_sim::Inventory;

fn main() {
    print!("{}", Inventory::read());
}
