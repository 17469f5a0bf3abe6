//! The elements of Markdown documents that the tests check.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

/// A document of the repository.
pub struct Document {
    pub path: PathBuf,
    pub text: String,
}

/// A fenced block of code.
pub struct Fence {
    /// The language of the block; empty without one.
    pub language: String,
    pub text: String,
}

impl Document {
    pub fn read(path: PathBuf) -> Self {
        let text = fs::read_to_string(&path);
        let text = text.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        Self { path, text }
    }

    fn all_fences(&self) -> impl Iterator<Item = Fence> {
        let pieces = self.text.split("\n```").skip(1).step_by(2);
        pieces.map(|piece| {
            let (language, text) = piece.split_once('\n').unwrap_or((piece, ""));
            Fence {
                language: language.to_owned(),
                text: text.to_owned(),
            }
        })
    }

    /// The fenced blocks in a language.
    pub fn fences(&self, language: &str) -> Vec<Fence> {
        let all = self.all_fences();
        all.filter(|fence| fence.language == language).collect()
    }

    /// The text outside of fenced blocks.
    fn prose(&self) -> String {
        let pieces = self.text.split("\n```").step_by(2);
        let pieces = pieces.map(|piece| piece.trim_start_matches('\n'));
        pieces.collect::<Vec<_>>().join("\n")
    }

    /// The inline code of sentences and tables.
    pub fn spans(&self) -> Vec<String> {
        code_of(&self.prose())
    }

    /// The targets of the document's links.
    pub fn links(&self) -> Vec<String> {
        let prose = self.prose();
        let text: String = prose.split('`').step_by(2).collect();
        let targets = text.split("](").skip(1);
        let targets = targets.filter_map(|rest| rest.split_once(')'));
        targets.map(|(target, _)| target.to_owned()).collect()
    }

    /// The anchors of the document's headings, as Git hosts generate them.
    pub fn anchors(&self) -> BTreeSet<String> {
        let prose = self.prose();
        let headings = prose.lines().filter(|line| line.starts_with('#'));
        headings.map(anchor).collect()
    }

    /// The rows of the document's tables.
    pub fn rows(&self) -> Vec<String> {
        let prose = self.prose();
        let rows = prose.lines().filter(|line| line.starts_with('|'));
        rows.map(str::to_owned).collect()
    }

    /// The code in the first column of the tables with this heading, row by row.
    pub fn rows_below(&self, head: &str) -> Vec<Vec<String>> {
        let prose = self.prose();
        let mut found = Vec::new();
        let mut is_below = false;
        for line in prose.lines() {
            let first = line.split('|').nth(1).unwrap_or_default();
            is_below = line.starts_with('|') && (is_below || first.trim() == head);
            let code = code_of(first);
            if is_below && !code.is_empty() {
                found.push(code);
            }
        }
        found
    }
}

fn code_of(text: &str) -> Vec<String> {
    let pieces = text.split('`').skip(1).step_by(2);
    pieces.map(str::to_owned).collect()
}

fn anchor(heading: &str) -> String {
    let words = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = words.chars().filter_map(|c| match c {
        ' ' => Some('-'),
        c if c.is_alphanumeric() || c == '-' || c == '_' => Some(c),
        _ => None,
    });
    kept.collect()
}

/// All Rust sources below some folders, as one text.
pub fn sources(folders: &[PathBuf]) -> String {
    let mut text = String::new();
    for folder in folders {
        for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                text.push_str(&sources(&[path]));
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                text.push_str(&fs::read_to_string(path).unwrap_or_default());
            }
        }
    }
    text
}
