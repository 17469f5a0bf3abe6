//! The parts that a drone, a ground robot or a boat can be built from.

use super::part::{Part, PartSlot};

/// A table of parts: the names of the columns, and a row for each part. The columns between the semicolons are
/// specific to this kind of part; the last ones are fields of [`Part`].
macro_rules! parts {
    ($(#[$doc:meta])* $vis:vis static $name:ident: [$kind:ident; $count:literal] $columns:tt; $($row:tt;)+) => {
        $(#[$doc])*
        $vis static $name: [Part; $count] = [$(part!($kind $columns $row)),+];
    };
}

/// One row of a table of parts.
macro_rules! part {
    (Spec [id; spec; power_w, mass_g, credits]
     [$id:literal; $spec:expr; $power_w:literal, $mass_g:literal, $credits:literal]) => {
        Part { id: $id, mass_g: $mass_g, credits: $credits, power_w: $power_w, spec: $spec }
    };
    ($kind:ident [id; $($column:ident),+; mass_g, credits]
     [$id:literal; $($figure:expr),+; $mass_g:literal, $credits:literal]) => {
        part!($kind [id; $($column),+; power_w, mass_g, credits] [$id; $($figure),+; 0.0, $mass_g, $credits])
    };
    ($kind:ident [id; $($column:ident),+; power_w, mass_g, credits]
     [$id:literal; $($figure:expr),+; $power_w:literal, $mass_g:literal, $credits:literal]) => {
        Part {
            id: $id,
            mass_g: $mass_g,
            credits: $credits,
            power_w: $power_w,
            spec: Spec::$kind($kind { $($column: $figure),+ }),
        }
    };
}

mod drive;
mod equipment;
mod surface;

/// All parts, slot by slot in the order of building; within a slot by kind and size.
pub fn parts() -> impl Iterator<Item = &'static Part> {
    let drive = [
        &drive::FRAMES[..],
        &surface::CHASSIS,
        &surface::HULLS,
        &drive::MOTORS,
        &surface::WHEEL_DRIVES,
        &surface::THRUSTERS,
        &drive::PROPELLERS,
        &drive::ESCS,
        &drive::BATTERIES,
    ];
    let carried = [
        &equipment::AVIONICS[..],
        &equipment::POWER_MODULES,
        &equipment::RADIOS,
        &equipment::PAYLOADS,
        &surface::FLAILS,
    ];
    drive.into_iter().chain(carried).flatten()
}

/// The parts that fit into a slot.
pub fn parts_for(slot: PartSlot) -> impl Iterator<Item = &'static Part> {
    parts().filter(move |part| part.slot() == slot)
}

/// The part with this id, if any.
pub fn part(id: &str) -> Option<&'static Part> {
    parts().find(|part| part.id == id)
}
