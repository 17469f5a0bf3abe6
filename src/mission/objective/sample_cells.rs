//! `sample_cells`: carry a sensor slowly enough and for long enough through the cells of a grid.

use serde::Deserialize;
use toml::Spanned;

use super::{Kind, Scene, Standing, Tracker, partial_credit};
use crate::mission::file::{Draft, Faults, Section};
use crate::mission::survey::{CellPlan, Survey, SurveyPlan, letters};
use crate::mission::world::World;
use crate::mission::zone::Shape;
use crate::text;
use crate::text::Text;

/// More cells than a trainee could ever fly, fewer than would slow a step down.
const MOST_CELLS: usize = 10_000;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SampleCellsFile {
    zone: Spanned<String>,
    sensor: Spanned<String>,
    cell: Spanned<f64>,
    dwell: Spanned<f64>,
    max_speed: Spanned<f64>,
    heights: Spanned<[f64; 2]>,
    target: Spanned<u32>,
    #[serde(default)]
    partial_from: u32,
}

#[derive(Debug, Clone)]
struct SampleCells {
    plan: SurveyPlan,
    target: usize,
    partial_from: u32,
}

/// Reads a `[[objectives]]` of kind `sample_cells`.
pub(crate) fn read(
    section: Section<'_>,
    draft: &Draft,
    faults: &mut Faults,
) -> Option<Box<dyn Kind>> {
    let file: SampleCellsFile = faults.read(section)?;
    let side_m = faults.number(&file.cell, 1.0..=1000.0, "cell");
    let cells = match draft.task_zone(&file.zone, faults) {
        Some(zone) => grid(&zone.shape, side_m, &file.cell, faults),
        None => Vec::new(),
    };
    let target = *file.target.get_ref() as usize;
    if !cells.is_empty() && !(1..=cells.len()).contains(&target) {
        faults.add(
            file.target.span(),
            format!(
                "`target` must lie between 1 and the {} cells of the zone",
                cells.len()
            ),
        );
    }
    if file.partial_from as usize >= target.max(1) {
        faults.add(file.target.span(), "`target` must be above `partial_from`");
    }
    let heights_m = *file.heights.get_ref();
    if !(0.0 <= heights_m[0] && heights_m[0] < heights_m[1] && heights_m[1] <= 1000.0) {
        faults.add(
            file.heights.span(),
            "`heights` must be [low, high], 0 to 1000 m",
        );
    }
    let (sensor, probe) = draft.fitted_probe(&file.sensor, faults)?;
    Some(Box::new(SampleCells {
        plan: SurveyPlan {
            id: draft.objective.clone(),
            cells,
            side_m,
            sensor,
            probe,
            dwell_s: faults.number(&file.dwell, 0.1..=600.0, "dwell"),
            max_speed_m_s: faults.number(&file.max_speed, 0.1..=100.0, "max_speed"),
            heights_m,
        },
        target,
        partial_from: file.partial_from,
    }))
}

/// The cells whose centres lie in the shape, row by row from the south-west.
fn grid(shape: &Shape, side_m: f64, place: &Spanned<f64>, faults: &mut Faults) -> Vec<CellPlan> {
    let (low, high) = shape.bounds();
    // A last column that is thinner than a thousandth of a cell is a rounding error.
    let count = |axis: usize| ((high[axis] - low[axis]) / side_m - 1e-3).ceil().max(0.0) as usize;
    let (columns, rows) = (count(0), count(1));
    if columns.saturating_mul(rows) > MOST_CELLS {
        faults.add(
            place.span(),
            format!("{columns} x {rows} cells are more than {MOST_CELLS}; make `cell` larger"),
        );
        return Vec::new();
    }
    let mut cells = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let centre = [
                low[0] + (column as f64 + 0.5) * side_m,
                low[1] + (row as f64 + 0.5) * side_m,
            ];
            if shape.contains(centre) {
                cells.push(CellPlan {
                    name: format!("{}{}", letters(column), row + 1),
                    centre,
                });
            }
        }
    }
    if cells.is_empty() {
        faults.add(
            place.span(),
            "no cell of this size has its centre in the zone",
        );
    }
    cells
}

impl Kind for SampleCells {
    fn survey(&self) -> Option<&SurveyPlan> {
        Some(&self.plan)
    }

    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(self.clone())
    }
}

impl Tracker for SampleCells {
    fn standing(&self, scene: &Scene<'_>) -> Standing {
        let survey = scene.survey(&self.plan.id);
        let sampled = survey.map_or(0, Survey::sampled);
        let missing: Vec<&str> = (0..self.plan.cells.len())
            .filter(|&index| survey.is_none_or(|survey| !survey.is_sampled(index)))
            .map(|index| self.plan.cells[index].name.as_str())
            .collect();
        let [low, high] = self.plan.heights_m;
        Standing {
            fraction: partial_credit(
                sampled as f64,
                f64::from(self.partial_from),
                self.target as f64,
            ),
            measure: sampled as f64,
            met: sampled >= self.target,
            settled: sampled >= self.target,
            landing: false,
            quality: None,
            outlook: None,
            quality_advice: Text::default(),
            result: text!(
                "mission-cells-of",
                sampled = sampled,
                count = self.plan.cells.len()
            ),
            target: text!("mission-cells", count = self.target),
            advice: text!(
                "mission-cells-advice",
                cells = shortened(&missing),
                dwell = format!("{:.0}", self.plan.dwell_s),
                speed = format!("{:.0}", self.plan.max_speed_m_s),
                low = format!("{low:.0}"),
                high = format!("{high:.0}"),
            ),
        }
    }
}

/// The first few names and how many more there are.
fn shortened(names: &[&str]) -> Text {
    const SHOWN: usize = 6;
    if names.len() <= SHOWN {
        names.join(", ").into()
    } else {
        text!(
            "mission-cells-more",
            cells = names[..SHOWN].join(", "),
            more = names.len() - SHOWN
        )
    }
}
