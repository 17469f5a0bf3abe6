//! One file per room of the console.

pub mod debrief;
pub mod fly;
pub mod home;
pub mod small;
