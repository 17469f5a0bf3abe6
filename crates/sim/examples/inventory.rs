//! Prints the simulator's inventory as the rows of the tables in `docs/simulator.md`: what a copter has, then the modes
//! and commands of a rover.
//!
//! `cargo run -p sortie-sim --example inventory`

use sortie_sim::{Chassis, Inventory, VehicleKind};

fn main() {
    println!("{}", Inventory::read());
    print!(
        "{}",
        Inventory::of(VehicleKind::Rover(Chassis::Ackermann)).conduct()
    );
}
