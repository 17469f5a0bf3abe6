//! The truth as a map of characters: objects, finds, and the areas that were never searched.

use super::DebriefPage;
use crate::scoring::{ObjectKind, ObjectReport, SquareReport, TruthReport};
use crate::text;
use crate::text::Text;

/// The maximum size of the map; a row is twice as high as a column is wide.
const COLUMNS: usize = 72;
const ROWS: usize = 22;
const SHADES: [char; 6] = ['.', ':', '-', '+', '*', '#'];
/// The strength of a hazard below which squares are left blank.
const FAINT: f64 = 0.03;
/// The maximum number of objects named below the map.
const NAMED: usize = 6;

/// The signs, each with the id of the text that explains it; a later sign is drawn over an earlier
/// one.
const SIGNS: [(char, &str); 10] = [
    ('?', "debrief-sign-gap"),
    ('=', "debrief-sign-wire"),
    ('~', "debrief-sign-track"),
    ('P', "debrief-sign-pad"),
    ('d', "debrief-sign-decoy"),
    ('o', "debrief-sign-there"),
    ('F', "debrief-sign-false"),
    ('v', "debrief-sign-mark"),
    ('O', "debrief-sign-found"),
    ('X', "debrief-sign-missed"),
];

impl DebriefPage<'_> {
    /// Writes the map, unless the mission had nothing to find.
    pub(super) fn map(&mut self, truth: &TruthReport) {
        let is_known = !truth.squares.is_empty()
            || !truth.objects.is_empty()
            || !truth.marks.is_empty()
            || !truth.gaps.is_empty();
        let Some(mut canvas) = TextMap::around(truth).filter(|_| is_known) else {
            return;
        };
        self.heading("debrief-truth");
        canvas.draw(truth);
        for row in &canvas.rows {
            let row: String = row.iter().collect();
            self.line(&format!("  |{row}|"));
        }
        self.wrapped("  ", &canvas.legend());
        self.missed(truth);
        self.gap();
    }

    /// Writes the number of objects found, the area that was never searched, and the places of
    /// missed objects.
    fn missed(&mut self, truth: &TruthReport) {
        let real = truth.objects.iter().filter(|object| is_asked(object));
        let (found, missed): (Vec<&ObjectReport>, Vec<_>) = real.partition(|object| object.found);
        let wrong = truth.marks.iter().filter(|mark| !mark.right).count();
        if found.len() + missed.len() + wrong > 0 {
            let (found, all) = (found.len(), found.len() + missed.len());
            let text = text!("debrief-found", found = found, all = all, wrong = wrong);
            self.wrapped("  ", &text);
        }
        let area_m2 = |gap: &SquareReport| gap.side_m * gap.side_m;
        let largest = truth.gaps.iter().rev();
        if let Some(largest) = largest.max_by(|a, b| a.side_m.total_cmp(&b.side_m)) {
            let [east, north] = largest.at.map(|axis| format!("{axis:.0}"));
            let area = format!("{:.0}", truth.gaps.iter().map(area_m2).sum::<f64>());
            let text = text!("debrief-gaps", area = area, north = north, east = east);
            self.wrapped("  ", &text);
        }
        for object in missed.iter().take(NAMED) {
            let ObjectKind::Find(kind) = object.kind else {
                continue;
            };
            let [east, north] = object.at.map(|axis| format!("{axis:.0}"));
            let kind = kind.title();
            let text = text!("debrief-missed", kind = kind, north = north, east = east);
            self.wrapped("    ", &text);
        }
    }
}

/// Whether the object counts as missed if it is not reported.
fn is_asked(object: &ObjectReport) -> bool {
    object.sought && object.kind != ObjectKind::Decoy
}

struct TextMap {
    rows: Vec<Vec<char>>,
    /// The north-west corner, in metres.
    corner: [f64; 2],
    scale_m: f64,
}

impl TextMap {
    /// A canvas for everything in the report; `None` if it is empty.
    fn around(truth: &TruthReport) -> Option<Self> {
        let strong = truth
            .squares
            .iter()
            .filter(|square| square.strength >= FAINT);
        let squares = strong.map(|square| square.at);
        let corners = truth.gaps.iter().flat_map(|gap| {
            let half_m = gap.side_m / 2.0;
            [-half_m, half_m].map(|by_m| gap.at.map(|axis| axis + by_m))
        });
        let squares = squares.chain(corners);
        let objects = truth.objects.iter().map(|object| object.at);
        let marks = truth.marks.iter().map(|mark| mark.at);
        let tracks = truth
            .tracks
            .iter()
            .flat_map(|track| track.points.iter().copied());
        let wires = truth.wires.iter().flatten().copied();
        let pads = truth.pads.iter().copied().chain(wires);
        let all = squares.chain(objects).chain(marks).chain(tracks);
        let bounds = all
            .chain(pads)
            .fold(None, |bounds: Option<([f64; 2], [f64; 2])>, at| {
                let (low, high) = bounds.unwrap_or((at, at));
                let low = [low[0].min(at[0]), low[1].min(at[1])];
                Some((low, [high[0].max(at[0]), high[1].max(at[1])]))
            });
        let (low, high) = bounds?;
        let (width_m, height_m) = (high[0] - low[0], high[1] - low[1]);
        let scale_m = (width_m / (COLUMNS - 1) as f64)
            .max(height_m / 2.0 / (ROWS - 1) as f64)
            .max(0.5);
        let columns = (width_m / scale_m).round() as usize + 1;
        let rows = (height_m / 2.0 / scale_m).round() as usize + 1;
        Some(Self {
            rows: vec![vec![' '; columns.min(COLUMNS)]; rows.min(ROWS)],
            corner: [low[0], high[1]],
            scale_m,
        })
    }

    fn draw(&mut self, truth: &TruthReport) {
        self.shade(truth);
        for gap in &truth.gaps {
            self.fill(gap, '?');
        }
        for pair in truth.wires.iter().flat_map(|pylons| pylons.windows(2)) {
            self.line([pair[0], pair[1]], '=');
        }
        for at in truth.tracks.iter().flat_map(|track| &track.points) {
            self.put(*at, '~');
        }
        for pad in &truth.pads {
            self.put(*pad, 'P');
        }
        for mark in &truth.marks {
            self.put(mark.at, if mark.right { 'v' } else { 'F' });
        }
        for object in &truth.objects {
            let sign = match (object.kind, object.found) {
                (ObjectKind::Decoy, _) => 'd',
                (ObjectKind::Find(_), true) => 'O',
                _ if is_asked(object) => 'X',
                _ => 'o',
            };
            self.put(object.at, sign);
        }
    }

    /// Shades the squares by the strength of their hazard.
    fn shade(&mut self, truth: &TruthReport) {
        let strong = truth
            .squares
            .iter()
            .filter(|square| square.strength >= FAINT);
        for square in strong {
            let step = square.strength * (SHADES.len() - 1) as f64;
            let shade = SHADES[(step.round() as usize).min(SHADES.len() - 1)];
            self.fill(square, shade);
        }
    }

    /// Fills all cells of the canvas that lie in a square.
    fn fill(&mut self, square: &SquareReport, sign: char) {
        let half = square.side_m / 2.0;
        let [west, north] = [square.at[0] - half, square.at[1] + half];
        let across = (square.side_m / self.scale_m).ceil().max(1.0) as usize;
        let down = (square.side_m / 2.0 / self.scale_m).ceil().max(1.0) as usize;
        for (column, row) in (0..across).flat_map(|column| (0..down).map(move |row| (column, row)))
        {
            let east = west + (column as f64 + 0.5) / across as f64 * square.side_m;
            let south = north - (row as f64 + 0.5) / down as f64 * square.side_m;
            self.put([east, south], sign);
        }
    }

    /// Puts a sign into every column or row between two places.
    fn line(&mut self, [from, to]: [[f64; 2]; 2], sign: char) {
        let (east_m, north_m) = (to[0] - from[0], to[1] - from[1]);
        let steps = (east_m.abs().max(north_m.abs()) / self.scale_m)
            .ceil()
            .max(1.0);
        for step in 0..=steps as usize {
            let share = step as f64 / steps;
            self.put([from[0] + east_m * share, from[1] + north_m * share], sign);
        }
    }

    fn put(&mut self, at: [f64; 2], sign: char) {
        let column = ((at[0] - self.corner[0]) / self.scale_m).round();
        let row = ((self.corner[1] - at[1]) / 2.0 / self.scale_m).round();
        if column < 0.0 || row < 0.0 {
            return;
        }
        let place = self.rows.get_mut(row as usize);
        if let Some(place) = place.and_then(|row| row.get_mut(column as usize)) {
            *place = sign;
        }
    }

    fn legend(&self) -> Text {
        let stands = |sign: char| self.rows.iter().any(|row| row.contains(&sign));
        let signs = SIGNS.iter().filter(|(sign, _)| stands(*sign));
        let mut parts: Vec<Text> = signs
            .map(|(sign, words)| {
                let words = Text::new(*words, Vec::new());
                text!("debrief-sign", sign = *sign, meaning = words)
            })
            .collect();
        if SHADES.iter().any(|shade| stands(*shade)) {
            let shades: String = SHADES.iter().collect();
            parts.push(text!("debrief-sign-shades", shades = shades));
        }
        let scale = format!("{:.1}", self.scale_m);
        parts.push(text!("debrief-scale", metres = scale));
        Text::joined(", ", parts)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::FindKind;
    use crate::debrief::text as debrief;
    use crate::scoring::{MarkReport, TrackReport};
    use crate::text::{Language, Locale};

    const MINE: ObjectKind = ObjectKind::Find(FindKind::Mine);

    fn object(at: [f64; 2], kind: ObjectKind, found: bool) -> ObjectReport {
        ObjectReport {
            at,
            kind,
            present: true,
            found,
            sought: kind != ObjectKind::Decoy,
        }
    }

    fn truth() -> TruthReport {
        let square = |at, strength| SquareReport {
            at,
            side_m: 20.0,
            strength,
            is_fire: false,
        };
        let mark = |at, right| MarkReport {
            at,
            kind: Some(FindKind::Mine),
            right,
        };
        TruthReport {
            squares: vec![square([10.0, 90.0], 1.0), square([30.0, 90.0], 0.4)],
            objects: vec![
                object([50.0, 40.0], MINE, true),
                object([70.0, 20.0], MINE, false),
                object([20.0, 20.0], ObjectKind::Decoy, false),
            ],
            marks: vec![mark([50.4, 40.0], true), mark([90.0, 60.0], false)],
            gaps: vec![square([90.0, 90.0], 0.0)],
            pads: vec![[0.0, 0.0]],
            tracks: vec![TrackReport {
                vehicle: 1,
                points: (0..10).map(|step| [f64::from(step) * 5.0, 10.0]).collect(),
            }],
            ..TruthReport::default()
        }
    }

    #[test]
    fn the_truth_on_the_map_reads_like_this() {
        let mut report = crate::mission::fake::do_nothing().report();
        report.truth = truth();
        for language in Language::ALL {
            let text = debrief(&report, &Locale::new(language));
            let lines = text.lines().skip_while(|line| !line.starts_with("  |"));
            let map: Vec<&str> = lines.take_while(|line| !line.is_empty()).collect();
            let name = format!("map_{}", language.code());
            insta::assert_snapshot!(name, map.join("\n"));
        }
    }

    #[test]
    fn two_places_are_as_many_columns_apart_as_the_scale_says() {
        for apart_m in [40.0, 400.0, 4000.0] {
            let truth = TruthReport {
                pads: vec![[0.0, 0.0], [apart_m, 0.0]],
                ..TruthReport::default()
            };
            let mut canvas = TextMap::around(&truth).expect("there is something");
            canvas.draw(&truth);
            let row = canvas.rows.iter().find(|row| row.contains(&'P'));
            let row = row.expect("the pads");
            let first = row.iter().position(|it| *it == 'P').expect("a pad");
            let last = row.iter().rposition(|it| *it == 'P').expect("a pad");
            let shown_m = (last - first) as f64 * canvas.scale_m;
            assert!((shown_m - apart_m).abs() <= canvas.scale_m, "{shown_m}");
        }
    }

    #[test]
    fn a_power_line_is_drawn_from_pylon_to_pylon() {
        let truth = TruthReport {
            pads: vec![[0.0, 0.0]],
            wires: vec![vec![[-30.0, 40.0], [0.0, 40.0], [30.0, 40.0]]],
            ..TruthReport::default()
        };
        let mut canvas = TextMap::around(&truth).expect("there is something");
        canvas.draw(&truth);
        let row: String = canvas.rows[0].iter().collect();
        assert!(row.chars().all(|sign| sign == '='), "{row}");
        let legend = Locale::new(Language::English).text(&canvas.legend());
        assert!(legend.contains("= power line"), "{legend}");
    }

    #[test]
    fn a_map_of_any_extent_fits_on_the_page() {
        for extent in [0.0, 1.0, 500.0, 20_000.0] {
            let mut truth = truth();
            truth.pads.push([extent, -extent]);
            let mut canvas = TextMap::around(&truth).expect("there is something");
            canvas.draw(&truth);
            assert!(canvas.rows.len() <= ROWS && canvas.rows[0].len() <= COLUMNS);
            assert!(canvas.rows.iter().any(|row| row.contains(&'P')));
        }
        assert!(TextMap::around(&TruthReport::default()).is_none());
    }
}
