//! The parts that there are.

mod drive;
mod equipment;

use super::part::{Part, Slot};

/// All parts, slot by slot in the order of building; within a slot by kind and size.
pub fn parts() -> impl Iterator<Item = &'static Part> {
    let drive = [
        &drive::FRAMES[..],
        &drive::MOTORS,
        &drive::PROPELLERS,
        &drive::ESCS,
        &drive::BATTERIES,
    ];
    let carried = [
        &equipment::AVIONICS[..],
        &equipment::RADIOS,
        &equipment::PAYLOADS,
    ];
    drive.into_iter().chain(carried).flatten()
}

/// The parts that go into a slot.
pub fn parts_for(slot: Slot) -> impl Iterator<Item = &'static Part> {
    parts().filter(move |part| part.slot() == slot)
}

/// The part of an id.
pub fn part(id: &str) -> Option<&'static Part> {
    parts().find(|part| part.id == id)
}
