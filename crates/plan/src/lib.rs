//! The lists that a MAVLink vehicle carries on board: its plan, its fence and its rally points
//! (`MAV_MISSION_TYPE`). Items keep every field of the wire format, so a file that was read can be
//! written back unchanged.
//!
//! [`read`] turns a file into a [`Document`], and finds the format by the content; [`write()`] does
//! the reverse. Faults carry their place in the file, but no text: the program that shows them
//! supplies it.
//!
//! ```
//! use sortie_plan::{FileFormat, ListKind, ReadOptions, read, write};
//!
//! let file = "QGC WPL 110\n\
//!     0\t1\t0\t16\t0\t0\t0\t0\t50.4501\t30.5234\t170\t1\n\
//!     1\t0\t3\t22\t0\t0\t0\t0\t0\t0\t20\t1\n\
//!     2\t0\t3\t16\t0\t0\t0\t0\t50.4511\t30.5234\t20\t1\n\
//!     3\t0\t3\t20\t0\t0\t0\t0\t0\t0\t0\t1\n";
//! let loaded = read(file.as_bytes(), &ReadOptions::default()).expect("a valid file");
//! assert_eq!(loaded.document.plan.len(), 3);
//! let written = write(&loaded.document, FileFormat::Wpl(ListKind::Plan)).expect("it fits");
//! assert!(written.starts_with("QGC WPL 110\n"));
//! ```
//!
//! # How the parts fit
//! - What a list is: `item`, `document`, `place`, and the numbers in `command`, `frame` and `field`
//!   (short words); `areas` for fences. `hash` names a content.
//! - Files: `files`, with `fault` for what is wrong and where.
//! - Whether it can be flown: `check` by the vehicle's rules, `board` for what storage changes or
//!   refuses.
//! - What it costs: `legs` (times) and `effort` (time and energy).
//! - Making plans: `generate` divides a task among vehicles, `pattern` has the patterns on a plane.
//!   `edit` changes a plan, and jumps still lead to the same items.

#![warn(missing_docs)]

mod areas;
pub mod board;
pub mod check;
pub mod command;
mod document;
pub mod edit;
pub mod effort;
mod fault;
pub mod field;
mod files;
pub mod frame;
pub mod generate;
mod hash;
mod item;
pub mod legs;
pub mod pattern;
mod place;

pub use areas::{AreaShape, Fence, FenceArea, FenceError, is_inside};
pub use document::{Document, Home, Origin};
pub use fault::{ArchiveFault, Expected, Fault, FaultKind, Note, NoteKind, Syntax, Unwritable};
pub use files::{FileFormat, Loaded, Places, ReadOptions, SourceFormat, read, source_text, write};
pub use hash::ContentHash;
pub use item::{HeightFrame, Item, ListKind};
