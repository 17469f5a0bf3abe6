//! The figures in a terminal.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::symbols::Marker;
use ratatui::widgets::{Axis, Block, Chart, Dataset, GraphType, Widget as _};

use super::figure::{Figure, figures, label};
use super::row::ScaleRow;
use crate::ui::ascii;

/// The width of a figure in columns; two figures side by side fit an ordinary terminal.
const COLUMNS: u16 = 40;
const ROWS: u16 = 13;
/// The mark of a measured point: ratatui's marker, which an ASCII terminal shows as a star.
const POINT: &str = "•";

/// The figures as lines of text, 80 columns wide.
pub(super) fn chart(rows: &[ScaleRow], is_ascii: bool) -> String {
    let mut buffer = Buffer::empty(Rect::new(0, 0, 2 * COLUMNS, 2 * ROWS));
    for (index, figure) in figures(rows).iter().enumerate() {
        let (column, row) = (index as u16 % 2, index as u16 / 2);
        let area = Rect::new(column * COLUMNS, row * ROWS, COLUMNS - 1, ROWS);
        draw(figure, area, &mut buffer);
    }
    let point = if is_ascii { "*" } else { POINT };
    for cell in &mut buffer.content {
        if cell.symbol() == POINT {
            cell.set_symbol(point);
        }
    }
    if is_ascii {
        ascii::map(&mut buffer);
    }
    let line = |row| {
        let cells = (0..buffer.area.width).map(|column| buffer[(column, row)].symbol());
        cells.collect::<String>().trim_end().to_owned()
    };
    let mut lines: Vec<String> = (0..buffer.area.height).map(line).collect();
    lines.push(format!(
        "{point} measured    lines: the paper's least and most    across: number of drones\n"
    ));
    lines.join("\n")
}

fn draw(figure: &Figure, area: Rect, buffer: &mut Buffer) {
    let lines = figure.paper.iter().map(|line| {
        Dataset::default()
            .marker(Marker::Braille)
            .graph_type(GraphType::Line)
            .data(line)
    });
    let points = Dataset::default()
        .marker(Marker::Dot)
        .graph_type(GraphType::Scatter)
        .data(&figure.measured);
    let x_labels = [0.0, figure.most_vehicles / 2.0, figure.most_vehicles].map(label);
    let y_labels = [0.0, figure.top / 2.0, figure.top].map(label);
    Chart::new(lines.chain([points]).collect())
        .block(Block::new().title(format!(" {}", figure.title)))
        .x_axis(
            Axis::default()
                .bounds([0.0, figure.most_vehicles])
                .labels(x_labels),
        )
        .y_axis(Axis::default().bounds([0.0, figure.top]).labels(y_labels))
        .legend_position(None)
        .render(area, buffer);
}
