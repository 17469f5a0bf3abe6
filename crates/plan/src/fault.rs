//! What is wrong with a file, and where.

use std::ops::Range;

use crate::ListKind;

/// A fault that keeps a file from being read.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// Where it lies, in bytes of the text ([`Loaded::text`](crate::Loaded::text), or the file itself).
    pub span: Range<usize>,
    /// What it is.
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
        /// As written.
        found: String,
        /// The versions that can be read.
        known: &'static str,
    },
    /// A line with too few or too many fields.
    Fields {
        /// The number on the line.
        found: usize,
        /// The number that it should have.
        expected: usize,
    },
    /// A word that should be a number.
    NotANumber(String),
    /// A number that does not fit what it stands for.
    OutOfRange(String),
    /// An item whose number is not that of its place.
    Order {
        /// As written.
        found: u32,
        /// The number of its place.
        expected: u32,
    },
    /// Not valid JSON or XML.
    Syntax(Syntax),
    /// The XML reader's own message.
    Xml(String),
    /// Something that the format requires is missing; its name in the file.
    Missing(&'static str),
    /// A value of another kind than the format says.
    Expected(Expected),
    /// A complex item without the plain items that it stands for; its type.
    NoEmbeddedItems(String),
    /// A jump to an id that no item has.
    UnknownJump(u32),
    /// A polygon with fewer than three corners.
    FewCorners(usize),
    /// A line without two places.
    ShortLine,
    /// More items than a list can have.
    TooMany,
    /// No item in the whole file.
    Empty,
    /// A compressed file that is damaged, or of a kind that cannot be read.
    Archive(ArchiveFault),
}

/// What the reader of JSON or XML met.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Syntax {
    /// The file ends too early.
    End,
    /// A character that cannot stand here.
    Unexpected(char),
    /// A string or an escape that is not closed or not known.
    Text,
    /// Something after the end of the document.
    Trailing,
    /// More levels than any such file has.
    TooDeep,
}

/// What should stand in a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Expected {
    /// A number.
    Number,
    /// A number or `null`.
    NumberOrNull,
    /// A text.
    Text,
    /// `true` or `false`.
    Flag,
    /// A list.
    List,
    /// An object.
    Object,
    /// A list of this many values.
    Length(usize),
    /// Longitude and latitude in degrees, and perhaps a height.
    Position,
    /// One of these words.
    Word(&'static str),
}

/// What is wrong with a compressed file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ArchiveFault {
    /// It is damaged.
    Damaged,
    /// It holds no `.kml` file.
    NoKml,
    /// It is packed by a method other than deflate.
    Method,
    /// Its content is larger than any such file should be.
    TooLarge,
}

/// What a reader had to assume or leave out.
#[derive(Debug, Clone, PartialEq)]
pub struct Note {
    /// Where, in bytes of the text.
    pub span: Range<usize>,
    /// What it is.
    pub kind: NoteKind,
}

/// The kinds of notes.
#[derive(Debug, Clone, PartialEq)]
pub enum NoteKind {
    /// Places without a height: this one in metres above home was taken.
    HeightAssumed(f32),
    /// The fifth or sixth parameter of a command without a place has a fraction, which the wire cannot carry.
    FractionLost,
    /// The lines of the file were joined into one plan; their number.
    LinesJoined(usize),
}

/// Why a document cannot be written in a format without a loss.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Unwritable {
    /// The format has no room for a list that is not empty.
    #[error("the format has no {0:?} list")]
    List(ListKind),
    /// Rally points of `.plan` files are above home; this one, counted from 0, is not.
    #[error("rally point {0} is not above home")]
    RallyFrame(usize),
    /// The fence is not made of whole polygons and circles; the first such item, counted from 0.
    #[error("fence item {0} belongs to no whole area")]
    FenceShape(usize),
    /// An infinite number, which JSON does not have; the list, and the item counted from 0.
    #[error("item {1} of the {0:?} list has an infinite number")]
    Infinite(ListKind, usize),
}

impl Fault {
    pub(crate) fn new(span: Range<usize>, kind: FaultKind) -> Self {
        Self { span, kind }
    }
}
