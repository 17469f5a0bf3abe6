//! The figures as a drawing.

use super::figure::{Figure, figures, label, rounded_up};
use super::row::ScaleRow;

/// The height of the drawing's heading in pixels.
const HEADING: usize = 40;
/// The size of each of the four panels below the heading, in pixels.
const PANEL: (usize, usize) = (520, 370);
/// The size of a panel's plot in pixels.
const PLOT: (f64, f64) = (420.0, 270.0);
/// The margin on the left of a plot and above it, in pixels.
const ORIGIN: (f64, f64) = (75.0, 40.0);
const MEASURED: &str = "#005aa0";
const PAPER: &str = "#be5000";

/// The four figures as an SVG document with this heading.
pub(super) fn svg(rows: &[ScaleRow], heading: &str) -> String {
    let (width, height) = (2 * PANEL.0, HEADING + 2 * PANEL.1);
    let middle = PANEL.0;
    let heading = heading.replace('&', "&amp;").replace('<', "&lt;");
    let mut panels = String::new();
    for (index, figure) in figures(rows).iter().enumerate() {
        let (x, y) = (index % 2 * PANEL.0, HEADING + index / 2 * PANEL.1);
        let inner = panel(figure);
        panels.extend([
            &format!("<g transform=\"translate({x} {y})\">\n"),
            &inner,
            "</g>\n",
        ]);
    }
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
         font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n\
         <text x=\"{middle}\" y=\"26\" text-anchor=\"middle\" font-size=\"20\">{heading}</text>\n{panels}</svg>\n"
    )
}

fn panel(figure: &Figure) -> String {
    let (left, top) = ORIGIN;
    let (right, bottom) = (left + PLOT.0, top + PLOT.1);
    let middle = f64::midpoint(left, right);
    let title = figure.title;
    let mut parts = vec![format!(
        "<text x=\"{middle}\" y=\"24\" text-anchor=\"middle\" font-size=\"17\">{title}</text>"
    )];
    parts.extend(ticks(figure.top, 0.0).map(|value| {
        let y = at(figure, 0.0, value).1;
        format!(
            "<path d=\"M{left} {y:.1}H{right}\" stroke=\"#ddd\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
            left - 6.0,
            y + 4.0,
            label(value)
        )
    }));
    parts.extend(ticks(figure.most_vehicles, 1.0).map(|value| {
        let x = at(figure, value, 0.0).0;
        format!(
            "<path d=\"M{x:.1} {top}V{bottom}\" stroke=\"#ddd\"/>\
             <text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
            bottom + 18.0,
            label(value)
        )
    }));
    parts.push(format!(
        "<path d=\"M{left} {top}V{bottom}H{right}\" fill=\"none\" stroke=\"black\"/>\
         <text x=\"{middle}\" y=\"{:.1}\" text-anchor=\"middle\">drones</text>\
         <text transform=\"translate(18 {:.1}) rotate(-90)\" text-anchor=\"middle\">% of a core</text>",
        bottom + 38.0,
        f64::midpoint(top, bottom)
    ));
    let dashed = format!("stroke=\"{PAPER}\" stroke-dasharray=\"7 5\"");
    let solid = format!("stroke=\"{MEASURED}\" stroke-width=\"2\"");
    parts.extend(figure.paper.map(|ends| line(figure, &ends, &dashed)));
    parts.push(line(figure, &figure.measured, &solid));
    parts.extend(figure.measured.iter().map(|&(vehicles, percent)| {
        let (x, y) = at(figure, vehicles, percent);
        format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"{MEASURED}\"/>")
    }));
    parts.extend(legend(
        figure,
        &[
            (&solid, "measured here"),
            (&dashed, "the paper, least and most"),
        ],
    ));
    parts.join("\n") + "\n"
}

/// The legend, where the lines leave room: at the upper left in figures of totals, which rise from zero.
fn legend(figure: &Figure, entries: &[(&str, &str)]) -> Vec<String> {
    let [[(_, at_none), _], _] = figure.paper;
    let (x, y) = if at_none > 0.0 {
        (ORIGIN.0 + PLOT.0 - 210.0, ORIGIN.1 + PLOT.1 / 2.0)
    } else {
        (ORIGIN.0 + 14.0, ORIGIN.1 + 16.0)
    };
    let rows = entries.iter().zip(0_u8..);
    rows.map(|((stroke, words), row)| {
        let y = y + 20.0 * f64::from(row);
        format!(
            "<path d=\"M{x:.1} {y:.1}h24\" {stroke}/><text x=\"{:.1}\" y=\"{:.1}\">{words}</text>",
            x + 32.0,
            y + 4.0
        )
    })
    .collect()
}

fn line(figure: &Figure, points: &[(f64, f64)], stroke: &str) -> String {
    let points: Vec<String> = points
        .iter()
        .map(|&(vehicles, percent)| at(figure, vehicles, percent))
        .map(|(x, y)| format!("{x:.1},{y:.1}"))
        .collect();
    format!(
        "<polyline points=\"{}\" fill=\"none\" {stroke}/>",
        points.join(" ")
    )
}

/// The pixel of a point: a number of vehicles and a percentage of a core.
fn at(figure: &Figure, vehicles: f64, percent: f64) -> (f64, f64) {
    let x = ORIGIN.0 + vehicles / figure.most_vehicles * PLOT.0;
    let y = ORIGIN.1 + (1.0 - percent / figure.top) * PLOT.1;
    (x, y)
}

/// About five round values from 0 to the end of an axis, no closer together than `least`.
fn ticks(end: f64, least: f64) -> impl Iterator<Item = f64> {
    let step = rounded_up(end / 5.0).max(least);
    (0_u8..)
        .map(move |n| f64::from(n) * step)
        .take_while(move |value| *value <= end * 1.001)
}
