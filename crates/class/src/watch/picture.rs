//! A screen as text and numbers.

/// The largest screen that is sent; of a larger one, its upper left part.
const MOST_COLUMNS: u16 = 500;
const MOST_ROWS: u16 = 200;
/// The maximum length of the text in one cell, in bytes: enough for a letter with its marks.
const LONGEST_SYMBOL: usize = 32;

/// The colours and attributes of a cell, as numbers that both ends understand in the same way.
///
/// A colour is 0 for the terminal's own, `0x100` + n for the n-th of the sixteen that terminals name, `0x200` + n for
/// the n-th of the palette of 256, and `0x0100_0000` + RGB for others. Each bit of the attributes is one of them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct CellStyle {
    /// The colour of the text.
    pub foreground: u32,
    /// The colour behind it.
    pub background: u32,
    /// The attributes, such as bold.
    pub attributes: u16,
}

/// A cell of a screen.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PictureCell {
    symbol: String,
    /// How the text looks.
    pub style: CellStyle,
}

impl Default for PictureCell {
    fn default() -> Self {
        Self::new(" ", CellStyle::default())
    }
}

impl PictureCell {
    /// A cell. Control characters become spaces and long text is cut, whoever made it, so that a screen can show what
    /// another console has sent.
    pub fn new(symbol: &str, style: CellStyle) -> Self {
        let is_plain = symbol.len() <= LONGEST_SYMBOL && !symbol.chars().any(char::is_control);
        let symbol = if is_plain {
            symbol.to_owned()
        } else {
            cleaned(symbol)
        };
        Self { symbol, style }
    }

    /// The text: usually one character; empty beside a wide one.
    pub fn symbol(&self) -> &str {
        &self.symbol
    }
}

fn cleaned(symbol: &str) -> String {
    let mut cleaned = String::new();
    for c in symbol.chars() {
        let c = if c.is_control() { ' ' } else { c };
        if cleaned.len() + c.len_utf8() > LONGEST_SYMBOL {
            break;
        }
        cleaned.push(c);
    }
    cleaned
}

/// What a screen shows.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Picture {
    columns: u16,
    rows: u16,
    cells: Vec<PictureCell>,
}

impl Picture {
    /// An empty screen of this size, as far as it is sent.
    pub fn blank(columns: u16, rows: u16) -> Self {
        let (columns, rows) = (columns.min(MOST_COLUMNS), rows.min(MOST_ROWS));
        let count = usize::from(columns) * usize::from(rows);
        Self {
            columns,
            rows,
            cells: vec![PictureCell::default(); count],
        }
    }

    /// The number of columns.
    pub fn columns(&self) -> u16 {
        self.columns
    }

    /// The number of rows.
    pub fn rows(&self) -> u16 {
        self.rows
    }

    /// A cell, if it is on the screen.
    pub fn cell(&self, column: u16, row: u16) -> Option<&PictureCell> {
        let at = usize::from(row) * usize::from(self.columns) + usize::from(column);
        self.cells.get(at).filter(|_| column < self.columns)
    }

    /// Changes a cell, if it is on the screen.
    pub fn set(&mut self, column: u16, row: u16, cell: PictureCell) {
        if column < self.columns {
            let at = usize::from(row) * usize::from(self.columns) + usize::from(column);
            if let Some(old) = self.cells.get_mut(at) {
                *old = cell;
            }
        }
    }

    /// All cells, row by row.
    pub(super) fn cells(&self) -> &[PictureCell] {
        &self.cells
    }

    pub(super) fn cells_mut(&mut self) -> &mut [PictureCell] {
        &mut self.cells
    }
}
