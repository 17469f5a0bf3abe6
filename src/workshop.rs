//! The constructor of drones, ground robots and boats: parts, designs, and a design's figures.
//!
//! A [`Design`] is a choice of parts; its frame, chassis or hull says which [`DesignKind`] it is. Its
//! [`Performance`] follows from the parts: mass, thrust or pull, power, endurance, speed, range, cost. The same figures give the airframe and the parameters of both simulators
//! ([`Airframe`]), so that a drone flies as computed. Everything here is pure and fast enough to
//! show the effect of each part while the cursor moves over a list.
//!
//! The physics of drones is momentum theory with measured propeller coefficients and a brushless motor
//! modelled as a resistance and a back-EMF, fitted to bench tests of motors. The results agree with
//! the published hover times of six real drones within about 10 %; see the tests. Robots have the same motors with
//! wheels and a resistance to rolling, boats have discs in water that work against the drag of a hull.
//!
//! # How the parts fit
//! - What can be chosen: `catalogue` has the parts, `part` their properties, `design` the choice;
//!   `check` finds problems, with reasons. `kind` has the slots of each kind of vehicle, and which parts it takes.
//! - What follows for a drone: `figures` puts the results together, from `drive` (thrust and power), `forward`
//!   (speed and range), `pack` (the battery under load) and `loss` (how far the radio reaches). For a robot or
//!   boat: `driving`, from `surface` (resistance, power and force), `pack` and `loss`.
//!   `measure` shows figures with units and whether more is better.
//! - How simulators fly it: `airframe`.

mod air;
mod airframe;
mod catalogue;
mod check;
mod design;
mod drive;
mod driving;
mod figures;
mod forward;
mod kind;
pub(crate) mod loss;
mod measure;
mod pack;
mod part;
mod surface;
#[cfg(test)]
mod tests;

pub use air::Air;
pub use airframe::{Airframe, AirframeBuild};
pub use catalogue::{part, parts, parts_for};
pub use check::{DesignFinding, FindingKind, FindingSeverity};
pub use design::{Design, DesignError};
pub use driving::DriveFigures;
pub use figures::{Figures, GOOD_THRUST, LEAST_THRUST, Link, Performance};
pub use kind::DesignKind;
pub use measure::{Better, Measure, Sheet};
pub use part::{Part, PartSlot, Radio};
