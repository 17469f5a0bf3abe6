//! Splits a stream of bytes into lines for display.

use crate::notice::sanitised;

/// The maximum number of characters kept from a line.
const LINE_LEN: usize = 400;
/// The maximum number of bytes read from a line: a UTF-8 character has up to four.
const LINE_BYTES: usize = 4 * LINE_LEN;
/// The mark at the end of a cut line.
const MORE: char = '…';

/// Splits bytes into lines, and holds the unfinished line.
#[derive(Debug, Default)]
pub(super) struct Cutter {
    begun: Vec<u8>,
    /// Whether the line was longer than the part that is held.
    is_cut: bool,
}

impl Cutter {
    /// The lines that end within these bytes.
    pub fn push(&mut self, bytes: &[u8]) -> Vec<String> {
        let mut lines = Vec::new();
        let mut pieces = bytes.split(|&byte| byte == b'\n');
        let last = pieces.next_back().unwrap_or_default();
        for piece in pieces {
            self.extend(piece);
            lines.push(self.take());
        }
        self.extend(last);
        lines
    }

    /// The unfinished last line, if there is one.
    pub fn finish(&mut self) -> Option<String> {
        (!self.begun.is_empty()).then(|| self.take())
    }

    fn extend(&mut self, piece: &[u8]) {
        let room = LINE_BYTES - self.begun.len();
        self.begun.extend(&piece[..piece.len().min(room)]);
        self.is_cut |= piece.len() > room;
    }

    fn take(&mut self) -> String {
        // Programs for other systems end lines with a carriage return and a line feed.
        let bytes = self.begun.strip_suffix(b"\r").unwrap_or(&self.begun);
        let text = sanitised(&String::from_utf8_lossy(bytes));
        let mut line: String = text.chars().take(LINE_LEN).collect();
        if self.is_cut || line.len() < text.len() {
            if let Some((at, _)) = line.char_indices().nth(LINE_LEN - 1) {
                line.truncate(at);
            }
            line.push(MORE);
        }
        self.begun.clear();
        self.is_cut = false;
        line
    }
}
