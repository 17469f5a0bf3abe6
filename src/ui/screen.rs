//! One file per room of the console.

pub mod debrief;
pub mod fly;
pub mod hangar;
pub mod home;
pub mod ledger;
pub mod links;
pub mod map;
pub mod messages;
pub mod mission;
pub mod parameters;
pub mod small;
pub mod standing;
pub mod vehicle;
pub mod workshop;
