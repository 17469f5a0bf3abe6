//! The file formats: how each is recognised, and one module for each.
//!
//! # How the parts fit
//! - Plans of ground stations: `wpl` (`QGC WPL`), `qgc` (QGroundControl's `.plan`), `lines` (MAVProxy's old fences
//!   and rally points).
//! - Maps of other programs: `kml` (`archive` for KMZ) and `geojson`; `shapes` decides what their lines, polygons and
//!   points become.
//! - Faults need places in the text: `json` and `number` keep them.

use std::ops::Range;

use crate::fault::{Fault, FaultKind, Note, Unwritable};
use crate::{Document, Home, ListKind};

mod archive;
mod geojson;
mod json;
mod kml;
mod lines;
mod number;
mod qgc;
mod shapes;
#[cfg(test)]
mod tests;
mod wpl;

/// A format that can be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SourceFormat {
    /// `QGC WPL 110` or `120`: Mission Planner, MAVProxy, QGroundControl.
    Wpl,
    /// QGroundControl's `.plan` files, in JSON: plan, fence and rally points in one.
    QgcPlan,
    /// MAVProxy's old fence: a latitude and a longitude on each line, the first the return point.
    OldFence,
    /// MAVProxy's old rally points: `RALLY` lines.
    OldRally,
    /// Google Earth's KML, without compression.
    Kml,
    /// KML in a zip archive.
    Kmz,
    /// `GeoJSON`, as in RFC 7946.
    GeoJson,
}

/// A format that can be written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileFormat {
    /// `QGC WPL 110` with one of the lists; a plan also contains home.
    Wpl(ListKind),
    /// QGroundControl's `.plan`, with all lists.
    QgcPlan,
    /// KML with all lists: shapes for display, and every field of the items as extended data.
    Kml,
    /// `GeoJSON` with all lists, in the same way.
    GeoJson,
}

impl FileFormat {
    /// The format for a file-name extension, given without the dot.
    pub fn of_ending(ending: &str) -> Option<Self> {
        match ending.to_ascii_lowercase().as_str() {
            "waypoints" | "wpl" | "txt" | "mission" => Some(Self::Wpl(ListKind::Plan)),
            "fence" | "fen" => Some(Self::Wpl(ListKind::Fence)),
            "rally" | "ral" => Some(Self::Wpl(ListKind::Rally)),
            "plan" => Some(Self::QgcPlan),
            "kml" => Some(Self::Kml),
            "geojson" | "json" => Some(Self::GeoJson),
            _ => None,
        }
    }
}

/// The values to assume where a file lacks them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReadOptions {
    /// The height above home of shapes without heights, in metres.
    pub height_m: f32,
    /// Whether a vehicle must stay inside the polygons of KML and `GeoJSON` files rather than
    /// outside them.
    pub polygons_keep_in: bool,
}

impl Default for ReadOptions {
    fn default() -> Self {
        Self {
            height_m: 30.0,
            polygons_keep_in: true,
        }
    }
}

/// A file that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Loaded {
    /// The format that was recognised.
    pub format: SourceFormat,
    /// The lists that the file contains.
    pub document: Document,
    /// Where each item is in the text.
    pub places: Places,
    /// The values that were assumed or left out.
    pub notes: Vec<Note>,
    /// The text to which all places refer: the file, or the KML in the archive.
    pub text: String,
}

/// The positions of the items in the text, in bytes.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Places {
    /// Home, if the file has it.
    pub home: Option<Range<usize>>,
    lists: [Vec<Range<usize>>; 3],
}

impl Places {
    /// The place of an item of a list, counted from 0; `None` beyond the end of the list.
    pub fn item(&self, kind: ListKind, index: usize) -> Option<Range<usize>> {
        self.lists[usize::from(kind.number())].get(index).cloned()
    }

    fn push(&mut self, kind: ListKind, span: Range<usize>) {
        self.lists[usize::from(kind.number())].push(span);
    }
}

#[derive(Debug, Default)]
struct Parsed {
    document: Document,
    places: Places,
    notes: Vec<Note>,
}

impl Parsed {
    fn push(&mut self, kind: ListKind, item: crate::Item, span: Range<usize>) {
        self.document.list_mut(kind).push(item);
        self.places.push(kind, span);
    }

    /// Sets home; a height that is not a number is noted and counts as 0.
    fn set_home(&mut self, home: Home, span: Range<usize>) {
        let is_known = home.z.is_finite();
        if !is_known {
            self.note(ListKind::Plan, &span, crate::NoteKind::HomeHeightMissing);
        }
        let z = if is_known { home.z } else { 0.0 };
        self.document.home = Some(Home { z, ..home });
        self.places.home = Some(span);
    }

    fn note(&mut self, list: ListKind, span: &Range<usize>, kind: crate::NoteKind) {
        self.notes.push(Note {
            list,
            span: span.clone(),
            kind,
        });
    }
}

/// The largest number of items of a list: they are counted in 16 bits on the wire, and home is one of them.
const MOST_ITEMS: usize = u16::MAX as usize - 1;

/// Reads a file in any of the formats, which is recognised by the content.
///
/// # Errors
/// Every fault that was found, with its place, and the text to which the places refer.
pub fn read(bytes: &[u8], options: &ReadOptions) -> Result<Loaded, (String, Vec<Fault>)> {
    let in_archive = is_archive(bytes);
    let text = source_text(bytes);
    let text = text.map_err(|fault| (String::from_utf8_lossy(bytes).into_owned(), vec![fault]))?;
    let (format, parsed) = parsed(&text, in_archive, *options);
    let checked = parsed.and_then(|parsed| {
        let most = ListKind::ALL.map(|kind| parsed.document.list(kind).len());
        if most.into_iter().any(|length| length > MOST_ITEMS) {
            return Err(vec![Fault::new(0..0, FaultKind::TooMany)]);
        }
        let is_empty = parsed.document.home.is_none() && most == [0; 3];
        if is_empty && !matches!(format, SourceFormat::QgcPlan | SourceFormat::Wpl) {
            return Err(vec![Fault::new(0..0, FaultKind::Empty)]);
        }
        Ok(parsed)
    });
    match checked {
        Ok(parsed) => Ok(Loaded {
            format,
            document: parsed.document,
            places: parsed.places,
            notes: parsed.notes,
            text,
        }),
        Err(mut faults) => {
            for fault in &mut faults {
                fault.span = within(&fault.span, &text);
            }
            Err((text, faults))
        }
    }
}

/// The range within the text, with both ends moved back to the start of a character.
fn within(span: &Range<usize>, text: &str) -> Range<usize> {
    let floor = |at: usize| {
        (0..=at.min(text.len()))
            .rev()
            .find(|at| text.is_char_boundary(*at))
    };
    let start = floor(span.start).unwrap_or_default();
    start..floor(span.end).unwrap_or_default().max(start)
}

fn is_archive(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK")
}

/// The text of a plan file: the file itself, or the KML in an archive (KMZ), at most 16 MiB.
///
/// # Errors
/// The file is not text, or the archive is damaged, has no KML or is too large.
pub fn source_text(bytes: &[u8]) -> Result<String, Fault> {
    if is_archive(bytes) {
        archive::kml_of(bytes)
    } else {
        text_of(bytes)
    }
}

fn text_of(bytes: &[u8]) -> Result<String, Fault> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        // The place refers to the text with replacements, which is the same up to the first replacement.
        let at = error.valid_up_to();
        Fault::new(at..at + '\u{fffd}'.len_utf8(), FaultKind::NotText)
    })?;
    Ok(text.to_owned())
}

fn parsed(
    text: &str,
    in_archive: bool,
    options: ReadOptions,
) -> (SourceFormat, Result<Parsed, Vec<Fault>>) {
    // A byte order mark stays in the text, so that positions stay correct.
    let start = text.trim_start_matches('\u{feff}').trim_start();
    match start.chars().next() {
        Some('<') if in_archive => (SourceFormat::Kmz, kml::parse(text, options)),
        Some('<') => (SourceFormat::Kml, kml::parse(text, options)),
        Some('{') => match json::parse(text) {
            Err(fault) => (SourceFormat::GeoJson, Err(vec![fault])),
            Ok(root) if qgc::is_plan(&root) => (SourceFormat::QgcPlan, qgc::parse(&root)),
            Ok(root) => (SourceFormat::GeoJson, geojson::parse(&root, options)),
        },
        _ if start.starts_with("QGC WPL") => (SourceFormat::Wpl, wpl::parse(text)),
        _ if lines::is_rally(text) => (SourceFormat::OldRally, lines::parse_rally(text)),
        _ if lines::is_fence(text) => (SourceFormat::OldFence, lines::parse_fence(text)),
        _ => {
            let end = start.find('\n').unwrap_or(start.len());
            let at = text.len() - start.len();
            let fault = Fault::new(at..at + end, FaultKind::UnknownFormat);
            (SourceFormat::Wpl, Err(vec![fault]))
        }
    }
}

/// Writes a document.
///
/// # Errors
/// The format cannot store the whole document.
pub fn write(document: &Document, format: FileFormat) -> Result<String, Unwritable> {
    match format {
        FileFormat::Wpl(kind) => wpl::write(document, kind),
        FileFormat::QgcPlan => qgc::write(document),
        FileFormat::Kml => Ok(kml::write(document)),
        FileFormat::GeoJson => geojson::write(document),
    }
}
