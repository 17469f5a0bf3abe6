//! The values of a mission file: how each kind is read, checked and described.

use toml::Spanned;
use toml::de::DeValue;

use super::description::FileShape;
use super::draft::Draft;

mod axis;
mod figure;
mod word;

pub(in crate::mission) use axis::{area, gate, heights, point, rising, spread};
pub(super) use figure::spaced;
pub(in crate::mission) use figure::{flag, number, seconds, time, whole};
pub(in crate::mission) use word::{NamedValue, TextValue, named, text, text_by, word};
pub(super) use word::{id, sensor_id};

/// A kind of value.
pub(in crate::mission) trait FileValue {
    /// The Rust type of a value.
    type Out;

    /// The form of the value in the description.
    fn shape(&self) -> FileShape;

    /// Reads a value of the key `name`; `None` if it is invalid, which is a fault.
    fn read(
        &self,
        name: &str,
        written: Spanned<DeValue<'_>>,
        draft: &mut Draft,
    ) -> Option<Self::Out>;

    /// The text of a default in the description.
    fn show(&self, _: &Self::Out) -> String {
        "none".to_owned()
    }

    /// Whether the value is a section of a file.
    fn is_section(&self) -> bool {
        false
    }
}
