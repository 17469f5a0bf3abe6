//! Tables of words: as aligned columns, as Markdown, and for spreadsheets.

use unicode_width::UnicodeWidthStr;

use crate::notice::sanitised;
use crate::text::{Locale, Text, clip};

/// A table of words. Columns of figures are aligned to the right.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct TextTable {
    columns: Vec<(String, Side)>,
    rows: Vec<Vec<String>>,
}

/// The alignment of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    Left,
    Right,
}

impl TextTable {
    /// A table without rows.
    pub fn new(locale: &Locale, columns: &[(Text, Side)]) -> Self {
        let named = columns.iter();
        Self {
            columns: named
                .map(|(name, side)| (locale.text(name), *side))
                .collect(),
            rows: Vec::new(),
        }
    }

    /// Whether the table has no rows.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Adds a row. Control characters are replaced.
    pub fn push(&mut self, row: Vec<String>) {
        self.rows
            .push(row.into_iter().map(|it| sanitised(&it)).collect());
    }

    /// The same table with a new first column that has the same value in every row.
    pub fn led_by(mut self, name: &Text, value: &str, locale: &Locale) -> Self {
        self.columns.insert(0, (locale.text(name), Side::Left));
        for row in &mut self.rows {
            row.insert(0, sanitised(value));
        }
        self
    }

    /// The same table with the cells of a column cut, so that lines have at most this many columns.
    pub fn fitted(mut self, column: usize, most: usize) -> Self {
        let whole: usize = self.widths().iter().map(|width| width + 2).sum();
        let wanted = self.widths()[column];
        let least = self.columns[column].0.width();
        let room = wanted.saturating_sub(whole.saturating_sub(most)).max(least);
        for row in &mut self.rows {
            row[column] = clip(&row[column], room);
        }
        self
    }

    fn widths(&self) -> Vec<usize> {
        let width = |at| self.column(at).map(UnicodeWidthStr::width).max();
        let columns = 0..self.columns.len();
        columns.map(|at| width(at).unwrap_or(0)).collect()
    }

    /// The table in columns as wide as needed.
    pub fn plain(&self) -> String {
        let widths = self.widths();
        let line = |cells: &mut dyn Iterator<Item = &str>| {
            let cells: Vec<String> = cells
                .zip(&widths)
                .zip(&self.columns)
                .map(|((cell, width), (_, side))| {
                    let space = " ".repeat(width.saturating_sub(cell.width()));
                    match side {
                        Side::Left => format!("{cell}{space}"),
                        Side::Right => format!("{space}{cell}"),
                    }
                })
                .collect();
            format!("  {}", cells.join("  ")).trim_end().to_owned() + "\n"
        };
        let mut text = line(&mut self.columns.iter().map(|(name, _)| name.as_str()));
        for row in &self.rows {
            text += &line(&mut row.iter().map(String::as_str));
        }
        text
    }

    /// The table in Markdown.
    pub fn markdown(&self) -> String {
        let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
        let named = self.columns.iter();
        let mut text = line(named.clone().map(|(name, _)| escaped(name)).collect());
        text += &line(
            named
                .map(|(_, side)| match side {
                    Side::Left => "---".to_owned(),
                    Side::Right => "---:".to_owned(),
                })
                .collect(),
        );
        for row in &self.rows {
            text += &line(row.iter().map(|cell| escaped(cell)).collect());
        }
        text
    }

    /// The table as comma-separated values (RFC 4180). Cells that a spreadsheet would take for
    /// formulas are made inert.
    ///
    /// # Errors
    /// A row has more or fewer cells than there are columns.
    pub fn csv(&self) -> Result<String, csv::Error> {
        let mut writer = csv::WriterBuilder::new()
            .terminator(csv::Terminator::CRLF)
            .from_writer(Vec::new());
        writer.write_record(self.columns.iter().map(|(name, _)| inert(name, Side::Left)))?;
        for row in &self.rows {
            let cells = row.iter().zip(&self.columns);
            writer.write_record(cells.map(|(cell, (_, side))| inert(cell, *side)))?;
        }
        let bytes = writer
            .into_inner()
            .map_err(csv::IntoInnerError::into_error)?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }

    fn column(&self, at: usize) -> impl Iterator<Item = &str> {
        let cells = self.rows.iter().filter_map(move |row| row.get(at));
        std::iter::once(self.columns[at].0.as_str()).chain(cells.map(String::as_str))
    }
}

/// Escapes characters that would end a cell or begin markup.
pub(super) fn escaped(cell: &str) -> String {
    let mut text = String::new();
    for c in cell.chars() {
        if matches!(c, '|' | '\\' | '*' | '_' | '`' | '<' | '[') {
            text.push('\\');
        }
        text.push(c);
    }
    text
}

/// A cell that no spreadsheet treats as a formula.
fn inert(cell: &str, side: Side) -> String {
    // Figures may begin with a minus, and a single dash stands for no value.
    let is_figure = side == Side::Right && cell.parse::<f64>().is_ok();
    let is_formula =
        cell.starts_with(['=', '+', '-', '@', '\t', '\r']) && !is_figure && cell != "-";
    if is_formula {
        format!("'{cell}")
    } else {
        cell.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::Language;

    fn table(cells: &[&str]) -> TextTable {
        let locale = Locale::new(Language::English);
        let columns = [("word".into(), Side::Left), ("n".into(), Side::Right)];
        let mut table = TextTable::new(&locale, &columns);
        table.push(cells.iter().map(|cell| (*cell).to_owned()).collect());
        table
    }

    #[test]
    fn columns_are_as_wide_as_they_need_to_be() {
        assert_eq!(
            table(&["їжак", "-1.5"]).plain(),
            "  word     n\n  їжак  -1.5\n"
        );
    }

    #[test]
    fn a_column_is_cut_so_that_the_lines_fit() {
        let fitted = |most| table(&["a long name", "7"]).fitted(0, most).plain();
        assert_eq!(fitted(20), "  word         n\n  a long name  7\n");
        assert_eq!(fitted(12), "  word     n\n  a long…  7\n");
        assert_eq!(fitted(3), "  word  n\n  a l…  7\n", "not below its title");
    }

    #[test]
    fn nothing_becomes_a_formula_and_commas_stay_inside() {
        for (cell, written) in [
            ("=1+1", "'=1+1"),
            ("@x", "'@x"),
            ("-rm", "'-rm"),
            ("+\"a\",b", "\"'+\"\"a\"\",b\""),
            ("plain", "plain"),
            ("-", "-"),
        ] {
            let csv = table(&[cell, "-1.5"])
                .csv()
                .expect("as many cells as columns");
            assert_eq!(csv, format!("word,n\r\n{written},-1.5\r\n"));
        }
        let csv = table(&["a", "-x"]).csv().expect("as many cells as columns");
        assert!(csv.contains("'-x"), "not a number");
    }

    #[test]
    fn a_column_may_lead_all_rows() {
        let locale = Locale::new(Language::English);
        let led = table(&["a", "1"]).led_by(&"trainee".into(), "=Olena", &locale);
        let csv = led.csv().expect("as many cells as columns");
        assert_eq!(csv, "trainee,word,n\r\n'=Olena,a,1\r\n");
    }

    #[test]
    fn a_cell_ends_no_row_of_markdown_and_does_nothing_to_a_terminal() {
        let text = table(&["a|b\n\u{1b}c", "1"]).markdown();
        assert_eq!(text, "| word | n |\n| --- | ---: |\n| a\\|b??c | 1 |\n");
    }
}
