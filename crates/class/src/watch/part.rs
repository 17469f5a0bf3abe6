//! Changes of a picture, in messages that fit a line.

use std::borrow::Cow;
use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::picture::{CellStyle, Picture, PictureCell};

/// The maximum size of a part, in bytes as it is estimated here: with the rest of its line it stays below
/// [`LONGEST_LINE`](crate::protocol::LONGEST_LINE).
const MOST_BYTES: usize = 56 * 1024;
/// The maximum size of a run.
const MOST_RUN_BYTES: usize = 4 * 1024;
/// The size of a run's numbers and signs, and that of a style.
const RUN_BYTES: usize = 24;
const STYLE_BYTES: usize = 32;

/// A picture, a part of it, or what has changed in it.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct PicturePart {
    /// Its number: one more than that of the part before it.
    pub number: u32,
    /// Columns and rows of a new picture, which is blank at first; `None` if the part changes the picture before.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size: Option<[u16; 2]>,
    /// The styles of the runs: foreground, background, attributes.
    #[serde(default)]
    pub(super) styles: Vec<[u32; 3]>,
    #[serde(default)]
    pub(super) runs: Vec<Run>,
    /// Whether the picture is complete only with the next part.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub more: bool,
}

/// Changed cells in a row that share a style: the place of the first one, row by row, the style, and the texts.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Run(pub u32, pub u32, pub Symbols);

/// The texts of the cells of a run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub(super) enum Symbols {
    /// Each cell has one character.
    Letters(String),
    /// Some cells have more than one, or none.
    Texts(Vec<String>),
}

impl From<CellStyle> for [u32; 3] {
    fn from(style: CellStyle) -> Self {
        [
            style.foreground,
            style.background,
            u32::from(style.attributes),
        ]
    }
}

fn style_of([foreground, background, attributes]: [u32; 3]) -> CellStyle {
    CellStyle {
        foreground,
        background,
        attributes: attributes as u16,
    }
}

/// The parts that turn one picture into another; at least one.
pub(super) fn parts(old: Option<&Picture>, new: &Picture) -> Vec<PicturePart> {
    let same_size = |it: &&Picture| (it.columns(), it.rows()) == (new.columns(), new.rows());
    let old = old.filter(same_size);
    let size = old.is_none().then(|| [new.columns(), new.rows()]);
    let blank = || Cow::Owned(Picture::blank(new.columns(), new.rows()));
    let old = old.map_or_else(blank, Cow::Borrowed);
    let mut parts = vec![PartDraft::default()];
    for run in changed(old.cells(), new.cells()) {
        let bytes = run.bytes() + STYLE_BYTES;
        if parts.last().is_some_and(|it| it.bytes + bytes > MOST_BYTES) {
            parts.push(PartDraft::default());
        }
        if let Some(part) = parts.last_mut() {
            part.add(&run);
        }
    }
    let last = parts.len() - 1;
    let parts = parts
        .into_iter()
        .enumerate()
        .map(|(at, draft)| PicturePart {
            size: size.filter(|_| at == 0),
            more: at < last,
            ..draft.part
        });
    parts.collect()
}

#[derive(Default)]
struct PartDraft {
    part: PicturePart,
    bytes: usize,
    known: BTreeMap<CellStyle, u32>,
}

impl PartDraft {
    fn add(&mut self, run: &ChangedRun<'_>) {
        let style = run.cells[0].style;
        let next = self.part.styles.len() as u32;
        let index = *self.known.entry(style).or_insert(next);
        if index == next {
            self.part.styles.push(style.into());
            self.bytes += STYLE_BYTES;
        }
        self.bytes += run.bytes();
        let symbols = Symbols::of(run.cells);
        self.part.runs.push(Run(run.at as u32, index, symbols));
    }
}

impl Symbols {
    fn of(cells: &[PictureCell]) -> Self {
        let texts = cells.iter().map(PictureCell::symbol);
        if texts.clone().all(is_letter) {
            Self::Letters(texts.collect())
        } else {
            Self::Texts(texts.map(str::to_owned).collect())
        }
    }

    /// The text of each cell.
    fn texts(&self) -> Vec<&str> {
        match self {
            Self::Letters(letters) => {
                let pieces = letters.char_indices();
                let pieces = pieces.map(|(at, c)| &letters[at..at + c.len_utf8()]);
                pieces.collect()
            }
            Self::Texts(texts) => texts.iter().map(String::as_str).collect(),
        }
    }
}

fn is_letter(text: &str) -> bool {
    let mut chars = text.chars();
    chars.next().is_some() && chars.next().is_none()
}

/// Cells that have changed, one after another, with the same style.
struct ChangedRun<'a> {
    at: usize,
    cells: &'a [PictureCell],
}

impl ChangedRun<'_> {
    fn bytes(&self) -> usize {
        RUN_BYTES + self.cells.iter().map(cell_bytes).sum::<usize>()
    }
}

/// The most that a cell can take in JSON: escapes double a text, and quotes and a comma may surround it.
fn cell_bytes(cell: &PictureCell) -> usize {
    2 * cell.symbol().len() + 3
}

fn changed<'a>(old: &[PictureCell], new: &'a [PictureCell]) -> Vec<ChangedRun<'a>> {
    let mut runs = Vec::new();
    let mut at = 0;
    while at < new.len() {
        if old.get(at) == Some(&new[at]) {
            at += 1;
            continue;
        }
        let mut bytes = 0;
        let length = new[at..]
            .iter()
            .zip(at..)
            .take_while(|(cell, place)| {
                bytes += cell_bytes(cell);
                let is_changed = old.get(*place) != Some(*cell);
                is_changed && cell.style == new[at].style && bytes <= MOST_RUN_BYTES
            })
            .count();
        let cells = &new[at..at + length];
        runs.push(ChangedRun { at, cells });
        at += length;
    }
    runs
}

/// Changes a picture as a part says; `None` if the part does not fit it.
pub(super) fn apply(part: &PicturePart, picture: &mut Picture) -> Option<()> {
    let cells = picture.cells_mut();
    for Run(at, style, symbols) in &part.runs {
        let style = style_of(*part.styles.get(*style as usize)?);
        let texts = symbols.texts();
        let first = *at as usize;
        let run = cells.get_mut(first..first.checked_add(texts.len())?)?;
        for (cell, text) in run.iter_mut().zip(texts) {
            *cell = PictureCell::new(text, style);
        }
    }
    Some(())
}
