//! A screen as SVG: its cells as text in the theme's colours, on rectangles where they have a background.

use std::fmt::Write as _;

use ratatui::buffer::{Buffer, Cell};
use ratatui::style::{Color, Modifier};

/// The size of a cell in hundredths of a pixel, so positions are whole numbers until they are
/// written.
const CELL_WIDTH: usize = 840;
const CELL_HEIGHT: usize = 1600;
const FONT_SIZE: usize = 1400;
/// The distance from the upper edge of a cell to the baseline of its text.
const BASELINE: usize = 1280;
const MARGIN: usize = 1000;
/// The positions of the dots in a braille character, in the order of its bits.
const DOTS: [(usize, usize); 8] = [
    (110, 100),
    (110, 500),
    (110, 900),
    (530, 100),
    (530, 500),
    (530, 900),
    (110, 1300),
    (530, 1300),
];
const FOREGROUND: &str = "#c9d1d9";
const BACKGROUND: &str = "#12161b";
const FONTS: &str =
    "ui-monospace, 'DejaVu Sans Mono', Menlo, Consolas, 'Liberation Mono', monospace";

/// The way a character is drawn. Every monospaced font has ASCII; other characters are positioned one by one, and
/// those that must touch their neighbours are drawn as shapes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shape {
    Letters,
    Sign,
    /// A braille pattern, as in curves and maps.
    Dots,
    /// A bar across full cells: its upper edge and its height in hundredths of a pixel.
    Bar(usize, usize),
}

impl Shape {
    fn of(cell: &Cell) -> Self {
        match cell.symbol() {
            "─" => Self::Bar(750, 100),
            "━" => Self::Bar(700, 200),
            "█" => Self::Bar(0, CELL_HEIGHT),
            symbol if symbol.is_ascii() => Self::Letters,
            symbol if braille(symbol).is_some() => Self::Dots,
            _ => Self::Sign,
        }
    }
}

/// The picture of a screen on the background of its theme.
pub fn of(buffer: &Buffer, ground: Color) -> String {
    let columns = usize::from(buffer.area.width);
    let width = 2 * MARGIN + columns * CELL_WIDTH;
    let height = 2 * MARGIN + usize::from(buffer.area.height) * CELL_HEIGHT;
    let ground = colour(ground, BACKGROUND);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" \
         font-family=\"{FONTS}\" font-size=\"{size}\" xml:space=\"preserve\">\n\
         <rect width=\"{w}\" height=\"{h}\" rx=\"8\" fill=\"{ground}\"/>\n",
        w = pixels(width),
        h = pixels(height),
        size = pixels(FONT_SIZE),
    );
    for (row, cells) in buffer.content.chunks(columns).enumerate() {
        let top = MARGIN + row * CELL_HEIGHT;
        for (start, run) in runs(cells, |a, b| background(a) == background(b)) {
            if background(&run[0]) != ground {
                rectangle(&mut svg, start, top, run);
            }
        }
        for (start, run) in runs(cells, is_alike) {
            draw(&mut svg, start, top, run);
        }
    }
    svg.push_str("</svg>\n");
    svg
}

/// Runs of cells that are drawn together, each with its first column.
fn runs(
    cells: &[Cell],
    is_alike: fn(&Cell, &Cell) -> bool,
) -> impl Iterator<Item = (usize, &[Cell])> {
    let pieces = cells.chunk_by(is_alike);
    pieces.scan(0, |column, run| {
        let start = *column;
        *column += run.len();
        Some((start, run))
    })
}

/// Whether two neighbours can be drawn as one.
fn is_alike(a: &Cell, b: &Cell) -> bool {
    let shape = Shape::of(a);
    shape == Shape::of(b)
        && shape != Shape::Sign
        && (a.fg, a.bg, a.modifier) == (b.fg, b.bg, b.modifier)
}

fn rectangle(svg: &mut String, column: usize, top: usize, run: &[Cell]) {
    let _ = writeln!(
        svg,
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>",
        pixels(left(column)),
        pixels(top),
        pixels(run.len() * CELL_WIDTH),
        pixels(CELL_HEIGHT),
        background(&run[0]),
    );
}

fn draw(svg: &mut String, column: usize, top: usize, run: &[Cell]) {
    let symbols: String = run.iter().map(Cell::symbol).collect();
    if symbols.trim().is_empty() {
        return;
    }
    let (x, width) = (pixels(left(column)), pixels(run.len() * CELL_WIDTH));
    let fill = foreground(&run[0]);
    let _ = match Shape::of(&run[0]) {
        Shape::Letters | Shape::Sign => writeln!(
            svg,
            "<text x=\"{x}\" y=\"{}\" textLength=\"{width}\" fill=\"{fill}\"{}>{}</text>",
            pixels(top + BASELINE),
            face(run[0].modifier),
            escaped(&symbols),
        ),
        Shape::Bar(edge, height) => writeln!(
            svg,
            "<rect x=\"{x}\" y=\"{}\" width=\"{width}\" height=\"{}\" fill=\"{fill}\"/>",
            pixels(top + edge),
            pixels(height),
        ),
        Shape::Dots => {
            let path = dots(column, top, run);
            writeln!(svg, "<path fill=\"{fill}\" d=\"{path}\"/>")
        }
    };
}

/// The dots of a run as a path of squares.
fn dots(column: usize, top: usize, run: &[Cell]) -> String {
    let mut path = String::new();
    for (place, cell) in run.iter().enumerate() {
        let bits = braille(cell.symbol()).unwrap_or_default();
        for (dot, (right, down)) in DOTS.into_iter().enumerate() {
            if bits >> dot & 1 == 1 {
                let (x, y) = (left(column + place) + right, top + down);
                let _ = write!(path, "M{} {}h2v2h-2z", pixels(x), pixels(y));
            }
        }
    }
    path
}

/// The dots of a braille character, as a bit for each.
fn braille(symbol: &str) -> Option<u32> {
    let code = u32::from(symbol.chars().next()?);
    (0x2800..0x2900).contains(&code).then(|| code - 0x2800)
}

fn left(column: usize) -> usize {
    MARGIN + column * CELL_WIDTH
}

fn face(modifier: Modifier) -> String {
    let faces = [
        (Modifier::BOLD, " font-weight=\"bold\""),
        (Modifier::ITALIC, " font-style=\"italic\""),
        (Modifier::UNDERLINED, " text-decoration=\"underline\""),
    ];
    let worn = faces
        .into_iter()
        .filter(|(face, _)| modifier.contains(*face));
    worn.map(|(_, attribute)| attribute).collect()
}

fn foreground(cell: &Cell) -> String {
    if cell.modifier.contains(Modifier::REVERSED) {
        colour(cell.bg, BACKGROUND)
    } else {
        colour(cell.fg, FOREGROUND)
    }
}

fn background(cell: &Cell) -> String {
    if cell.modifier.contains(Modifier::REVERSED) {
        colour(cell.fg, FOREGROUND)
    } else {
        colour(cell.bg, BACKGROUND)
    }
}

/// A colour in SVG. The shipped themes have 24-bit colours only; any other colour becomes
/// `otherwise`.
fn colour(colour: Color, otherwise: &str) -> String {
    match colour {
        Color::Rgb(red, green, blue) => format!("#{red:02x}{green:02x}{blue:02x}"),
        _ => otherwise.to_owned(),
    }
}

fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;");
    text.replace('<', "&lt;").replace('>', "&gt;")
}

/// Hundredths of a pixel as text: `1234` is 12.34, `1200` is 12.
fn pixels(hundredths: usize) -> String {
    let (whole, rest) = (hundredths / 100, hundredths % 100);
    match (rest, rest % 10) {
        (0, _) => whole.to_string(),
        (_, 0) => format!("{whole}.{}", rest / 10),
        _ => format!("{whole}.{rest:02}"),
    }
}
