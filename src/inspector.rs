//! The inspector: the content and the rate of every message on the links.
//!
//! A [`Census`] counts the frames of one link, received and sent, and keeps the last of each kind. Its frames are
//! decoded by the [`Definitions`] instead of the dialect crate, which keeps neither names nor units: [`reading::read`]
//! returns every field with name, value, unit and the names of enum values and bits, even for messages that the
//! dialect cannot decode. Sources are never merged: the same system id from two peers, or in two directions, is two
//! sources. [`write`](write()) builds payloads from fields by name.

mod census;
mod definitions;
mod export;
mod reading;
mod writing;

pub use census::{
    Census, Direction, FrameSource, FrameWay, MessageStatistics, MessageTally, Rate, TallyKey,
    WatchedMessage,
};
pub use definitions::{Definitions, EnumDefinition, FieldDefinition, FieldType, MessageDefinition};
pub use export::{CountedLink, StatisticsFormat, statistics_table};
pub use reading::{ElementReading, FieldReading, MessageReading, figure, name_of, read};
pub use writing::{WrittenPayload, target_of, write, written};
