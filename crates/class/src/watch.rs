//! Watching a seat: its screen as the trainee sees it, sent as pictures and as what has changed since.
//!
//! # How the parts fit
//! - `picture`: a screen as text and numbers.
//! - `part`: a picture, or what has changed, in lines that fit the protocol.
//! - [`PictureSender`] makes parts at a seat, [`PictureReceiver`] puts them together at the desk.

use std::time::Duration;

mod part;
mod picture;
mod receiver;
mod sender;

#[cfg(test)]
mod tests;

pub use part::PicturePart;
pub use picture::{CellStyle, Picture, PictureCell};
pub use receiver::PictureReceiver;
pub use sender::PictureSender;

/// How often a seat looks whether its screen has changed.
pub const LOOK_EVERY: Duration = Duration::from_millis(25);
/// The least time between two pictures that are sent.
pub const PICTURE_EVERY: Duration = Duration::from_millis(100);
/// A seat says at least this often that its picture has not changed.
pub const UNCHANGED_EVERY: Duration = Duration::from_secs(1);
/// How long a desk waits before it says that a picture is old.
pub const STALE_AFTER: Duration = Duration::from_secs(2);
