//! Faults of files, with their places.

use std::ops::Range;

use crate::ListKind;

/// A fault that prevents a file from being read.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// The place of the fault, in bytes of the text ([`Loaded::text`](crate::Loaded::text), or the file itself).
    pub span: Range<usize>,
    /// The kind of fault.
    pub kind: FaultKind,
}

/// The kinds of faults.
#[derive(Debug, Clone, PartialEq)]
pub enum FaultKind {
    /// The content is of no known format.
    UnknownFormat,
    /// The bytes are not UTF-8.
    NotText,
    /// A version that cannot be read.
    Version {
        /// The version as it is written in the file.
        found: String,
        /// The versions that can be read.
        known: &'static str,
    },
    /// A line with too few or too many fields.
    Fields {
        /// The number of fields on the line.
        found: usize,
        /// The number of fields that the line should have.
        expected: usize,
    },
    /// A word in place of a number.
    NotANumber(String),
    /// A number that is out of range for its field.
    OutOfRange(String),
    /// An item whose number does not match its position.
    Order {
        /// The number in the file.
        found: u32,
        /// The number that matches its position.
        expected: u32,
    },
    /// Not valid JSON or XML.
    Syntax(Syntax),
    /// The XML reader's own message.
    Xml(String),
    /// A part that the format requires is missing; contains its name in the file.
    Missing(&'static str),
    /// A value of a type other than the format requires.
    Expected(Expected),
    /// A complex item without simple items; contains its type.
    NoEmbeddedItems(String),
    /// A jump to an id that no item has.
    UnknownJump(u32),
    /// A polygon with fewer than three corners; contains their number.
    FewCorners(usize),
    /// A line with fewer than two places.
    ShortLine,
    /// More items than a list can have.
    TooMany,
    /// No item in the whole file.
    Empty,
    /// A compressed file that is damaged, or of a kind that cannot be read.
    Archive(ArchiveFault),
}

/// The syntax errors of JSON and XML.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Syntax {
    /// The file ends too early.
    End,
    /// A character that is not allowed here.
    Unexpected(char),
    /// A string or an escape that is not closed or not valid.
    Text,
    /// Content after the end of the document.
    Trailing,
    /// Values nested more deeply than in any valid file.
    TooDeep,
}

/// The value that the format requires at a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Expected {
    /// A number, written with digits.
    Number,
    /// A number or `null`.
    NumberOrNull,
    /// A string in quotes.
    Text,
    /// A Boolean: `true` or `false`.
    Flag,
    /// A list of any length.
    List,
    /// An object with keys.
    Object,
    /// A list of this many values.
    Length(usize),
    /// Longitude and latitude in degrees, with or without a height.
    Position,
    /// One of these words.
    Word(&'static str),
}

/// The faults of a KMZ archive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ArchiveFault {
    /// The archive is damaged.
    Damaged,
    /// The archive contains no `.kml` file.
    NoKml,
    /// The file is compressed by a method other than deflate.
    Method,
    /// The content is larger than that of any real plan.
    TooLarge,
}

/// An assumption that a reader made, or a value that it left out.
#[derive(Debug, Clone, PartialEq)]
pub struct Note {
    /// The list that the note concerns.
    pub list: ListKind,
    /// The place, in bytes of the text.
    pub span: Range<usize>,
    /// The kind of note.
    pub kind: NoteKind,
}

/// The kinds of notes.
#[derive(Debug, Clone, PartialEq)]
pub enum NoteKind {
    /// Places have no height; contains the height that was assumed, in metres above home.
    HeightAssumed(f32),
    /// Home has no height; it counts as 0 m above sea level.
    HomeHeightMissing,
    /// The fifth or sixth parameter of a command without a place has a fraction, which MAVLink cannot transmit.
    FractionLost,
    /// The lines of the file were joined into one plan; contains their number.
    LinesJoined(usize),
}

/// Why a document cannot be written in a format without loss.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Unwritable {
    /// The format cannot store a list that is not empty.
    #[error("the format has no {0:?} list")]
    List(ListKind),
    /// A rally point, counted from 0, whose height is not measured from home: `.plan` files require
    /// heights above home.
    #[error("rally point {0} is not above home")]
    RallyFrame(usize),
    /// The fence does not consist of complete polygons and circles; contains the first such item, counted from 0.
    #[error("fence item {0} belongs to no complete area")]
    FenceShape(usize),
    /// An infinite number, which JSON does not support; contains the list, and the item counted from 0.
    #[error("item {1} of the {0:?} list has an infinite number")]
    Infinite(ListKind, usize),
}

impl Fault {
    pub(crate) fn new(span: Range<usize>, kind: FaultKind) -> Self {
        Self { span, kind }
    }
}
