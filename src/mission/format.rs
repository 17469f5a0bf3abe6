//! The format of mission files: one function per table both reads and describes it.
//!
//! A [reader](Reader) requests its keys from a [`FileTable`] by name, form and meaning, and builds
//! a value from them. On a table of a file, it receives the keys' values. Under [`describe`], it
//! receives none, and its requests form the description. The JSON schema ([`schema`]) and the
//! reference of the guide ([`reference`]) are generated from that description. A reader must
//! therefore request all of its keys before it fails because of a missing one.
//!
//! A section refers to earlier ones through the [`Draft`], which also collects the faults.

mod collection;
mod description;
mod draft;
mod faults;
mod name_kind;
mod reference;
mod schema;
mod shared;
mod table;
mod value;
mod written;

pub(super) use collection::{ListValue, list, map, table, tables};
pub(super) use description::FileShape;
#[cfg(test)]
pub(super) use description::FileTableDescription;
pub(super) use draft::{Draft, NamedPlace};
pub(super) use faults::{FileFaults, not_between};
pub(super) use name_kind::NameKind;
pub(super) use reference::reference;
pub(super) use schema::schema;
pub(super) use shared::{BetterMeasure, CountTarget, ObjectiveTarget};
pub(super) use table::{FileTable, KindOf, describe};
pub(super) use value::{
    FileValue, NamedValue, TextValue, area, flag, gate, heights, named, number, point, rising,
    seconds, spread, text, text_by, time, whole, word,
};
pub(super) use written::WrittenValue;

/// The greatest distance of a point from the origin on each axis; beyond it, the flat earth model of [`crate::geo`] is
/// too inaccurate.
pub(super) const POINT_RANGE: f64 = 20_000.0;
/// The longest time in a file, in seconds: a day.
pub(super) const LONGEST_S: f64 = 86_400.0;
