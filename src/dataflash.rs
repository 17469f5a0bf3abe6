//! `DataFlash` logs: a vehicle's own recording of its flight, converted to the timeline of a record.

mod clock;
mod course;
mod curves;
mod flight;
mod joined;
mod names;
mod reader;
mod reading;
#[cfg(test)]
mod tests;

pub use clock::{AlignedBy, Alignment, Misfit, VehicleClock};
pub use course::{Course, Disagreement};
pub use curves::{LogChannel, LogCurves};
pub use flight::{LogDamage, LoggedEvent, LoggedFlight, LoggedMoment};
pub use joined::JoinedLog;
