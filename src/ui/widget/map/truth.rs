//! The truth of a flight on a separate map: the objects, the finds and the tracks.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::canvas::{Canvas, Stroke};
use super::fire;
use super::ground::{WIRE, outline};
use super::heat;
use super::labels::stamp;
use super::legend::draw_scale;
use super::ways::trail;
use crate::app::room::map::PYLON;
use crate::geo::{Dot, Extent, GridSize, LatLon, Outline, Viewport};
use crate::scoring::{ObjectKind, ObjectReport, SquareReport, TruthReport};
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{below, put, upper, width as width_of};

/// The mission's origin: a report gives places only in metres from the origin.
const ORIGIN: LatLon = LatLon::new(0.0, 0.0);
const GAP: Stroke = Stroke::dotted(Role::Warning);
const FENCE: Stroke = Stroke::dashed(Role::Fence);
/// The margin around everything, as a share of the extent, and in metres.
const EDGE: (f64, f64) = (0.04, 5.0);

/// The number of columns between two entries of the legend.
const LEGEND_GAP: usize = 2;

/// A sign with its meaning, readable without colours.
type Sign = (char, Role, &'static str);
const FOUND: Sign = ('#', Role::Ok, "truth-found");
const MISSED: Sign = ('X', Role::Danger, "truth-missed");
const OVER: Sign = ('+', Role::Info, "truth-over");
const UNASKED: Sign = ('*', Role::Info, "truth-unasked");
const DECOY: Sign = ('o', Role::Muted, "truth-decoy");
const FALSE: Sign = ('?', Role::Warning, "truth-false");
const GATE: Sign = ('G', Role::Info, "truth-gate");
const PAD: Sign = ('H', Role::Title, "map-legend-home");
const SIGNS: [Sign; 8] = [FOUND, MISSED, OVER, UNASKED, DECOY, FALSE, GATE, PAD];

struct SignAt {
    sign: Sign,
    /// The sign's number, if the order of the signs matters.
    number: Option<usize>,
    at: [f64; 2],
}

impl SignAt {
    fn new(sign: Sign, at: [f64; 2]) -> Self {
        Self {
            sign,
            number: None,
            at,
        }
    }

    fn text(&self) -> String {
        let number = self.number.map(|number| number.to_string());
        format!("{}{}", self.sign.0, number.unwrap_or_default())
    }
}

/// Draws the map as a pane with a title, and its legend below.
pub fn draw(truth: &TruthReport, panel: Panel<'_>, buffer: &mut Buffer) {
    let inner = panel.titled(&panel.say("truth-title"), buffer);
    let Some(extent) = Extent::around(places(truth)) else {
        let line = Line::styled(panel.say("truth-none"), panel.style(Role::Muted));
        put(buffer, inner, 0, &line);
        return;
    };
    let labels = labels(truth);
    let legend = legend(truth, &labels, panel.look, usize::from(inner.width));
    let rows = inner.height.saturating_sub(legend.len() as u16);
    let extent = extent.with_margin(EDGE.0, EDGE.1);
    let size = GridSize::new(inner.width, rows);
    let view = Viewport::new(extent.centre(), extent.zoom(size), size);
    let canvas_area = upper(inner, rows);
    for square in &truth.squares {
        shade(square, panel.look, &view, canvas_area, buffer);
    }
    let mut canvas = Canvas::new(size, panel.look.symbols);
    draw_lines(truth, &view, &mut canvas);
    canvas.draw(panel.at(canvas_area), buffer);
    draw_labels(truth, &labels, &view, panel.at(canvas_area), buffer);
    draw_scale(panel.look, &view, canvas_area, buffer);
    for (row, line) in legend.into_iter().enumerate() {
        put(buffer, below(inner, rows), row as u16, &line);
    }
}

/// Draws the gaps, the fences, the wires and the tracks.
fn draw_lines(truth: &TruthReport, view: &Viewport, canvas: &mut Canvas) {
    for gap in &truth.gaps {
        let corners = Outline::square(place(gap.at), gap.side_m).corners();
        outline(&corners, view, canvas, GAP);
    }
    for fence in &truth.fences {
        let corners: Vec<LatLon> = fence.iter().copied().map(place).collect();
        outline(&corners, view, canvas, FENCE);
    }
    for pair in truth.wires.iter().flat_map(|pylons| pylons.windows(2)) {
        canvas.line(view.dot(place(pair[0])), view.dot(place(pair[1])), WIRE);
    }
    for track in &truth.tracks {
        let stroke = trail(track.vehicle);
        for pair in track.points.windows(2) {
            let ends = [pair[0], pair[1]].map(|at| view.dot(place(at)));
            canvas.line(ends[0], ends[1], stroke);
        }
    }
}

/// Draws the pylons and the signs.
fn draw_labels(
    truth: &TruthReport,
    labels: &[SignAt],
    view: &Viewport,
    panel: Panel<'_>,
    buffer: &mut Buffer,
) {
    let pylons = truth.wires.iter().flatten();
    let pylons = pylons.map(|&at| (at, PYLON.to_owned(), WIRE.role));
    let signs = labels.iter().map(|it| (it.at, it.text(), it.sign.1));
    for (at, text, role) in pylons.chain(signs) {
        if let Some((column, row)) = view.cell(place(at)) {
            let room = panel.area.width.saturating_sub(column);
            let columns = (text.len() as u16).min(room);
            let cells = Rect::new(panel.area.x + column, panel.area.y + row, columns, 1);
            stamp(&text, panel.style(role), panel.at(cells), buffer);
        }
    }
}

fn place([east_m, north_m]: [f64; 2]) -> LatLon {
    ORIGIN.moved(north_m, east_m)
}

fn places(truth: &TruthReport) -> impl Iterator<Item = LatLon> {
    let squares = truth.squares.iter().chain(&truth.gaps);
    let corners = squares.flat_map(|it| Outline::square(place(it.at), it.side_m).corners());
    let objects = truth.objects.iter().map(|it| it.at);
    let marks = truth.marks.iter().map(|it| it.at);
    let tracks = truth.tracks.iter().flat_map(|it| it.points.iter().copied());
    let points = objects.chain(marks).chain(tracks);
    let pads = truth.pads.iter().copied();
    corners.chain(
        points
            .chain(pads)
            .chain(truth.gates.iter().copied())
            .chain(truth.wires.iter().flatten().copied())
            .map(place),
    )
}

/// The signs at their places, the most important last.
fn labels(truth: &TruthReport) -> Vec<SignAt> {
    let pads = truth.pads.iter().map(|&at| SignAt::new(PAD, at));
    let gates = (1..).zip(&truth.gates).map(|(number, &at)| SignAt {
        number: Some(number),
        ..SignAt::new(GATE, at)
    });
    let sign = |object: &ObjectReport| match (object.kind, object.found) {
        (ObjectKind::Decoy, _) => DECOY,
        (ObjectKind::Find(_), true) => FOUND,
        _ if !object.present => OVER,
        _ if !object.sought => UNASKED,
        _ => MISSED,
    };
    let objects = truth
        .objects
        .iter()
        .map(|object| SignAt::new(sign(object), object.at));
    let wrong = truth
        .marks
        .iter()
        .filter(|mark| !mark.right)
        .map(|mark| SignAt::new(FALSE, mark.at));
    let mut labels: Vec<SignAt> = pads.chain(gates).chain(objects).chain(wrong).collect();
    // Missed objects stay visible even if they share a cell.
    labels.sort_by_key(|label| label.sign == MISSED);
    labels
}

/// Whether a square of a fire still burns.
fn burns(square: &SquareReport) -> bool {
    square.strength >= 1.0
}

fn shade(square: &SquareReport, look: &Look, view: &Viewport, area: Rect, buffer: &mut Buffer) {
    let shaded = if square.is_fire {
        let (sign, _) = fire::truth_sign(burns(square), look.symbols);
        Some((sign, fire::role(look)))
    } else {
        heat::shade(square.strength, look.symbols).map(|shade| (shade, Role::Hazard))
    };
    let Some((shade, role)) = shaded else {
        return;
    };
    let half = square.side_m / 2.0;
    let [east_m, north_m] = square.at;
    let cell = |east_m, north_m| {
        let Dot { x, y } = view.dot(place([east_m, north_m]));
        (
            x / f64::from(crate::geo::DOTS_ACROSS),
            y / f64::from(crate::geo::DOTS_DOWN),
        )
    };
    let (left, top) = cell(east_m - half, north_m + half);
    let (right, bottom) = cell(east_m + half, north_m - half);
    let span = |from: f64, to: f64, count: u16| {
        let within = |at: f64| at.round().clamp(0.0, f64::from(count)) as u16;
        // At least the cell that contains the centre.
        let middle = f64::midpoint(from, to).clamp(0.0, f64::from(count.saturating_sub(1))) as u16;
        within(from).min(middle)..within(to).max(middle + 1)
    };
    for row in span(top, bottom, view.rows) {
        for column in span(left, right, view.columns) {
            if let Some(cell) = buffer.cell_mut((area.x + column, area.y + row)) {
                cell.set_char(shade).set_style(look.fill(role));
            }
        }
    }
}

/// An entry of the legend: its sign in the role that it has on the map, and its meaning.
struct Entry {
    sign: String,
    role: Role,
    meaning: String,
}

impl Entry {
    fn width(&self) -> usize {
        width_of(&self.sign) + 1 + width_of(&self.meaning)
    }

    fn spans(self, look: &Look) -> [Span<'static>; 3] {
        let muted = look.style(Role::Muted);
        [
            Span::styled(self.sign, look.fill(self.role)),
            Span::raw(" "),
            Span::styled(self.meaning, muted),
        ]
    }
}

/// The legend of the signs on the map with their counts, in as many lines as needed.
fn legend(truth: &TruthReport, labels: &[SignAt], look: &Look, width: usize) -> Vec<Line<'static>> {
    let mut lines: Vec<Line<'static>> = Vec::new();
    for entry in entries(truth, labels, look) {
        match lines.last_mut() {
            Some(line) if line.width() + LEGEND_GAP + entry.width() <= width => {
                line.push_span(" ".repeat(LEGEND_GAP));
            }
            _ => lines.push(Line::default()),
        }
        if let Some(line) = lines.last_mut() {
            line.extend(entry.spans(look));
        }
    }
    lines
}

fn entries(truth: &TruthReport, labels: &[SignAt], look: &Look) -> Vec<Entry> {
    let signs = SIGNS.iter().filter_map(|&sign| {
        let count = labels.iter().filter(|label| label.sign == sign).count();
        (count > 0).then(|| Entry {
            sign: sign.0.to_string(),
            role: sign.1,
            meaning: format!("{}: {count}", look.say(sign.2)),
        })
    });
    let fires = [true, false].into_iter().filter_map(|burning| {
        let mut fires = truth.squares.iter().filter(|square| square.is_fire);
        let (sign, meaning) = fire::truth_sign(burning, look.symbols);
        fires.any(|square| burns(square) == burning).then(|| Entry {
            sign: sign.to_string(),
            role: fire::role(look),
            meaning: look.say(meaning),
        })
    });
    let has_strengths = truth.squares.iter().any(|square| !square.is_fire);
    let strength = has_strengths.then(|| Entry {
        sign: heat::shares(look.symbols),
        role: Role::Hazard,
        meaning: look.say("truth-strength"),
    });
    let line = |stroke: Stroke, meaning: String| Entry {
        sign: sample(stroke, look),
        role: stroke.role,
        meaning,
    };
    let fences = (!truth.fences.is_empty()).then(|| line(FENCE, look.say("map-legend-fence")));
    let wires = (!truth.wires.is_empty()).then(|| line(WIRE, look.say("map-legend-wire")));
    let count = truth.gaps.len();
    let gaps = (count > 0).then(|| line(GAP, format!("{}: {count}", look.say("truth-gaps"))));
    let lines = [strength, fences, wires, gaps].into_iter().flatten();
    signs.chain(fires).chain(lines).collect()
}

/// The beginning of a line, up to its first gap.
fn sample(stroke: Stroke, look: &Look) -> String {
    let line = stroke.sample(look.symbols);
    line.split(' ').next().unwrap_or_default().to_owned()
}
