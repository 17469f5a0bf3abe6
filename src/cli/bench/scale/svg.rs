//! The figures as a drawing.

use std::error::Error;

use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;

use super::figure::{Figure, figures, label};
use super::sample::Row;

const SIZE: (u32, u32) = (1040, 780);
const MEASURED: RGBColor = RGBColor(0, 90, 160);
const PAPER: RGBColor = RGBColor(190, 80, 0);

type Panel<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// The four figures as an SVG document with this heading.
pub(super) fn svg(rows: &[Row], heading: &str) -> anyhow::Result<String> {
    let mut text = String::new();
    let drawn = draw_all(&mut text, rows, heading);
    drawn.map_err(|error| anyhow::anyhow!("cannot draw: {error}"))?;
    Ok(text)
}

fn draw_all(text: &mut String, rows: &[Row], heading: &str) -> Result<(), Box<dyn Error>> {
    let root = SVGBackend::with_string(text, SIZE).into_drawing_area();
    root.fill(&WHITE).map_err(|error| error.to_string())?;
    let below = root.titled(heading, ("sans-serif", 20));
    let below = below.map_err(|error| error.to_string())?;
    for (panel, figure) in below.split_evenly((2, 2)).iter().zip(figures(rows)) {
        draw(panel, &figure).map_err(|error| error.to_string())?;
    }
    root.present().map_err(|error| error.to_string())?;
    Ok(())
}

fn draw(panel: &Panel<'_>, figure: &Figure) -> Result<(), Box<dyn Error>> {
    let mut chart = ChartBuilder::on(panel)
        .caption(figure.title, ("sans-serif", 17))
        .margin(12)
        .x_label_area_size(40)
        .y_label_area_size(58)
        .build_cartesian_2d(0.0..figure.most_vehicles * 1.02, 0.0..figure.top * 1.02)?;
    chart
        .configure_mesh()
        .x_desc("drones")
        .y_desc("% of a core")
        .x_label_formatter(&|x| label(*x))
        .y_label_formatter(&|y| label(*y))
        .label_style(("sans-serif", 13))
        .axis_desc_style(("sans-serif", 14))
        .max_light_lines(0)
        .draw()?;
    chart
        .draw_series(LineSeries::new(
            figure.measured.iter().copied(),
            MEASURED.stroke_width(2),
        ))?
        .label("measured here")
        .legend(|(x, y)| PathElement::new([(x, y), (x + 24, y)], MEASURED.stroke_width(2)));
    chart.draw_series(
        figure
            .measured
            .iter()
            .map(|&point| Circle::new(point, 4, MEASURED.filled())),
    )?;
    for (index, line) in figure.paper.iter().enumerate() {
        let drawn = chart.draw_series(DashedLineSeries::new(
            line.iter().copied(),
            7,
            5,
            PAPER.stroke_width(1),
        ))?;
        if index == 0 {
            drawn
                .label("the paper, least and most")
                .legend(|(x, y)| DashedPathElement::new([(x, y), (x + 24, y)], 7, 5, PAPER));
        }
    }
    // Where the lines leave room: totals rise from zero.
    let [[(_, at_none), _], _] = figure.paper;
    chart
        .configure_series_labels()
        .position(if at_none > 0.0 {
            SeriesLabelPosition::MiddleRight
        } else {
            SeriesLabelPosition::UpperLeft
        })
        .background_style(WHITE.mix(0.85))
        .label_font(("sans-serif", 13))
        .draw()?;
    Ok(())
}
