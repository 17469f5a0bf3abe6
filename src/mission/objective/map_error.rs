//! `map_error`: the map from a survey's cell means must be close to the truth.
//!
//! The error is the root of the mean squared difference between measured and true cell means, divided by the mean of
//! the true ones (NRMSE). A cell that was not sampled counts as a reading of zero.

use super::{ObjectiveDetails, ObjectiveKind, ObjectiveScene, ObjectiveStanding, Tracker};
use crate::geo::maths;
use crate::mission::Point;
use crate::mission::format::{BetterMeasure, FileTable, KindOf, ObjectiveTarget, number, text};
use crate::mission::skill::Skill;
use crate::mission::survey::{Survey, SurveyPlan};
use crate::mission::world::World;
use crate::scoring::Product;
use crate::text;
use crate::text::Text;

/// The true mean of a cell is taken over this many points along each side.
const POINTS_PER_SIDE: u32 = 5;
/// The error at which the quality is zero.
const WORTHLESS: f64 = 0.5;

#[derive(Debug, Clone)]
struct MapError {
    of: SurveyPlan,
    height_m: f64,
    target: ObjectiveTarget,
}

#[derive(Debug, Clone)]
struct MapTracker {
    of: String,
    height_m: f64,
    truth: Vec<f64>,
    target: ObjectiveTarget,
}

pub(super) const KIND: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "map_error",
    about: "met when the error of a survey's map is at most the target: the root mean square error divided by the mean; a cell without a sample counts as 0. Its map is a product",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn ObjectiveKind>> {
    let of = table.need(
        "of",
        text("id of an earlier `sample_cells`"),
        "survey from which the map is made",
    );
    let height_m = table.need("height", number(0.0, 1000.0, "m"), "height of the map");
    let target = table.need_target([0.0, 10.0], BetterMeasure::Lower);
    Some(Box::new(MapError {
        of: table.draft().survey(&of?)?,
        height_m: height_m?,
        target: target?,
    }))
}

impl ObjectiveKind for MapError {
    fn skill(&self, _: usize) -> Option<Skill> {
        Some(Skill::K7)
    }

    fn start(&self, world: &World) -> Box<dyn Tracker> {
        let cell_mean = |centre: Point| {
            let step = self.of.side_m / f64::from(POINTS_PER_SIDE);
            let offset = |index: u32| (f64::from(index) + 0.5) * step - self.of.side_m / 2.0;
            let points =
                (0..POINTS_PER_SIDE).flat_map(|x| (0..POINTS_PER_SIDE).map(move |y| (x, y)));
            let sum: f64 = points
                .map(|(x, y)| {
                    world.amount(
                        self.of.probe.quantity,
                        [centre[0] + offset(x), centre[1] + offset(y)],
                        self.height_m,
                    )
                })
                .sum();
            sum / f64::from(POINTS_PER_SIDE * POINTS_PER_SIDE) * self.of.probe.gain
        };
        Box::new(MapTracker {
            of: self.of.id.clone(),
            height_m: self.height_m,
            truth: self
                .of
                .cells
                .iter()
                .map(|cell| cell_mean(cell.centre))
                .collect(),
            target: self.target,
        })
    }
}

impl MapTracker {
    /// The error of the map; `None` before the first sample.
    fn known_error(&self, survey: Option<&Survey>) -> Option<f64> {
        let begun = survey.filter(|survey| survey.sampled() > 0);
        begun.map(|survey| self.error(survey))
    }

    fn error(&self, survey: &Survey) -> f64 {
        let count = self.truth.len().max(1) as f64;
        let mean = self.truth.iter().sum::<f64>() / count;
        let squares: f64 = self
            .truth
            .iter()
            .enumerate()
            .map(|(index, truth)| {
                let measured = survey.mean(index).filter(|_| survey.is_sampled(index));
                maths::powi(measured.unwrap_or(0.0) - truth, 2)
            })
            .sum();
        let rms = (squares / count).sqrt();
        // In clean air, any reading is an error.
        if mean > 0.0 { rms / mean } else { rms }
    }
}

impl MapTracker {
    /// Advice on the causes of the error: missing cells, readings at a wrong height or in a corner of a cell, and a
    /// sensor's lag.
    fn quality_advice(&self, survey: Option<&Survey>) -> Text {
        let blank = survey.and_then(|survey| {
            let cells = survey.plan.cells.iter().enumerate();
            let mut blanks = cells.filter(|(index, _)| !survey.is_sampled(*index));
            blanks.next().map(|(_, cell)| cell.name.as_str())
        });
        let how = text!(
            "mission-map-slower",
            height = format!("{:.0}", self.height_m)
        );
        match blank {
            Some(name) => text!("mission-map-blank", cell = name, how = how),
            None => how,
        }
    }
}

impl Tracker for MapTracker {
    fn standing(&self, scene: &ObjectiveScene<'_>) -> ObjectiveStanding {
        let survey = scene.survey(&self.of);
        let error = self.known_error(survey);
        let whole = survey.is_some_and(|survey| survey.sampled() == self.truth.len());
        let met = error.is_some_and(|error| error <= self.target.met_at);
        ObjectiveStanding {
            fraction: error.map_or(0.0, |error| self.target.credit(error)),
            measure: error.unwrap_or(self.target.partial_from),
            met,
            settled: met || whole,
            landing: false,
        }
    }

    fn details(&self, scene: &ObjectiveScene<'_>) -> ObjectiveDetails {
        let survey = scene.survey(&self.of);
        let error = self.known_error(survey);
        let words = error.map(|error| format!("{error:.2}"));
        let result = words.clone().map_or_else(
            || text!("mission-map-none"),
            |error| text!("mission-map-error", error = error),
        );
        let quality = words.map_or_else(
            || text!("mission-map-none"),
            |error| text!("mission-map-quality", error = error),
        );
        ObjectiveDetails {
            product: Some(Product {
                quality: error.map_or(0.0, |error| 1.0 - (error / WORTHLESS).min(1.0)),
                words: quality,
                advice: self.quality_advice(survey),
                is_measured: false,
            }),
            result,
            outlook: None,
            target: format!("{:.2}", self.target.met_at).into(),
            advice: text!(
                "mission-map-advice",
                height = format!("{:.0}", self.height_m)
            ),
        }
    }
}
