//! `sample_cells`: carry a sensor through the cells of a grid, slowly and for long enough.

use super::{
    DemandedTime, Demands, ObjectiveDetails, ObjectiveKind, ObjectiveScene, ObjectiveStanding,
    Tracker,
};
use crate::mission::format::{CountTarget, FileTable, KindOf, heights, number};
use crate::mission::skill::Skill;
use crate::mission::survey::{CellPlan, Survey, SurveyPlan, letters};
use crate::mission::world::World;
use crate::mission::zone::{Shape, Zone};
use crate::text;
use crate::text::Text;

/// The maximum number of cells: more than can be flown, fewer than would slow a step down.
const MOST_CELLS: usize = 10_000;

#[derive(Debug, Clone)]
struct SampleCells {
    zone: Zone,
    plan: SurveyPlan,
    target: CountTarget,
}

pub(super) const KIND: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "sample_cells",
    about: "met when enough cells have been sampled; a cell is sampled once a vehicle has stayed in it for `dwell`, within the limits of height and speed",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn ObjectiveKind>> {
    let zone = table.need_task_zone();
    let sensor = table.need_sensor("sensor", "sensor that takes the samples");
    let side_m = table.need("cell", number(1.0, 1000.0, "m"), "side of a cell");
    let dwell_s = table.need("dwell", number(0.1, 600.0, "s"), "time in each cell");
    let max_speed_m_s = table.need(
        "max_speed",
        number(0.1, 100.0, "m/s"),
        "maximum speed while sampling",
    );
    let heights_m = table.need("heights", heights(), "allowed heights while sampling");
    let target = table.need_count(1, 10_000, "cells");
    let cells = match (&zone, side_m) {
        (Some(zone), Some(side_m)) => grid(&zone.shape, side_m, table),
        _ => Vec::new(),
    };
    let target = target?;
    if !cells.is_empty() && target.met_at > cells.len() {
        let count = cells.len();
        let fault = text!("fault-target-cells", count = count);
        table.fault_of("target", fault);
    }
    let sensor = sensor?;
    let probe = sensor.probe();
    if probe.is_none() {
        let fault = text!("fault-no-measure", sensor = sensor.id);
        table.fault_of("sensor", fault);
    }
    Some(Box::new(SampleCells {
        zone: zone?,
        plan: SurveyPlan {
            id: table.own_id(),
            cells,
            side_m: side_m?,
            sensor,
            probe: probe?,
            dwell_s: dwell_s?,
            max_speed_m_s: max_speed_m_s?,
            heights_m: heights_m?,
        },
        target,
    }))
}

/// The cells whose centres lie in the shape, row by row from the south-west.
fn grid(shape: &Shape, side_m: f64, table: &mut FileTable<'_>) -> Vec<CellPlan> {
    let (low, high) = shape.bounds();
    // A last column thinner than a thousandth of a cell is a rounding error.
    let count = |axis: usize| ((high[axis] - low[axis]) / side_m - 1e-3).ceil().max(0.0) as usize;
    let (columns, rows) = (count(0), count(1));
    if columns.saturating_mul(rows) > MOST_CELLS {
        let fault = text!(
            "fault-grid-most",
            columns = columns,
            rows = rows,
            most = MOST_CELLS
        );
        table.fault_of("cell", fault);
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
        table.fault_of("cell", text!("fault-cells-none"));
    }
    cells
}

impl ObjectiveKind for SampleCells {
    fn skill(&self, _: usize) -> Option<Skill> {
        Some(Skill::K6)
    }

    fn demands(&self) -> Demands<'_> {
        let dwell = DemandedTime::seconds("dwell", self.plan.dwell_s);
        // Cells are sampled one after the other.
        let cells = u32::try_from(self.target.met_at).unwrap_or(u32::MAX);
        Demands {
            zone: Some(&self.zone),
            heights_m: Some(self.plan.heights_m),
            times: vec![dwell],
            staying: dwell.time.saturating_mul(cells),
            ..Demands::default()
        }
    }

    fn survey(&self) -> Option<&SurveyPlan> {
        Some(&self.plan)
    }

    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(self.clone())
    }
}

impl SampleCells {
    fn sampled(&self, scene: &ObjectiveScene<'_>) -> usize {
        scene.survey(&self.plan.id).map_or(0, Survey::sampled)
    }
}

impl Tracker for SampleCells {
    fn standing(&self, scene: &ObjectiveScene<'_>) -> ObjectiveStanding {
        let sampled = self.sampled(scene);
        ObjectiveStanding {
            fraction: self.target.credit(sampled),
            measure: sampled as f64,
            met: sampled >= self.target.met_at,
            settled: sampled >= self.target.met_at,
            landing: false,
        }
    }

    fn details(&self, scene: &ObjectiveScene<'_>) -> ObjectiveDetails {
        let survey = scene.survey(&self.plan.id);
        let missing: Vec<&str> = (0..self.plan.cells.len())
            .filter(|&index| survey.is_none_or(|survey| !survey.is_sampled(index)))
            .map(|index| self.plan.cells[index].name.as_str())
            .collect();
        let [low, high] = self.plan.heights_m;
        ObjectiveDetails {
            product: None,
            outlook: None,
            result: text!(
                "mission-cells-of",
                sampled = self.sampled(scene),
                count = self.plan.cells.len()
            ),
            target: text!("mission-cells", count = self.target.met_at),
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

/// The first few names and the number of the remaining names.
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
