//! The four figures: the simulator's and the model update's processor time, in total and per vehicle, each against the
//! number of vehicles and beside the paper's figures. [`super::chart`] and [`super::svg`] draw them.

use super::row::ScaleRow;
use crate::geo::maths;

/// The paper's figures for the simulation of one vehicle, in percent of a core: minimum and
/// maximum.
pub(super) const PAPER_SIM: [f64; 2] = [0.8, 1.0];
/// The paper's figures for the console's model update of a vehicle, in percent of a core: minimum
/// and maximum.
pub(super) const PAPER_MODEL: [f64; 2] = [0.045, 0.063];
/// The paper's model update per message, in microseconds.
pub(super) const PAPER_US_PER_MESSAGE: f64 = 24.5;

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Figure {
    pub title: &'static str,
    /// Measured points: the number of vehicles, and percent of a core.
    pub measured: Vec<(f64, f64)>,
    /// The paper's minimum and maximum, each as two points: at 0 vehicles and at the highest number
    /// of vehicles.
    pub paper: [[(f64, f64); 2]; 2],
    pub most_vehicles: f64,
    /// The end of the vertical axis, a number with few digits.
    pub top: f64,
}

/// The four figures of a series.
pub(super) fn figures(rows: &[ScaleRow]) -> [Figure; 4] {
    type Value = fn(&ScaleRow) -> Option<f64>;
    let flown: Vec<&ScaleRow> = rows.iter().filter(|row| row.repeats > 0).collect();
    let most = flown.iter().map(|row| row.vehicles).max().unwrap_or(1);
    let most_vehicles = f64::from(most.max(1));
    let figure = |title, value: Value, paper: [f64; 2], is_total: bool| {
        let point = |row: &&ScaleRow| Some((f64::from(row.vehicles), value(row)?));
        let measured: Vec<_> = flown.iter().filter_map(point).collect();
        let paper = paper.map(|each| {
            let at = |vehicles: f64| (vehicles, if is_total { each * vehicles } else { each });
            [at(0.0), at(most_vehicles)]
        });
        let values = measured.iter().chain(paper.iter().flatten());
        let top = values.map(|(_, value)| *value).fold(0.0, f64::max);
        Figure {
            title,
            measured,
            paper,
            most_vehicles,
            top: rounded_up(top),
        }
    };
    let sim: [Value; 2] = [
        |row| Some(row.sim_core_percent),
        |row| row.sim_core_percent_per_vehicle,
    ];
    let model: [Value; 2] = [
        |row| Some(row.model_percent),
        |row| row.model_percent_per_vehicle,
    ];
    [
        figure("Simulator, % of a core", sim[0], PAPER_SIM, true),
        figure("Simulator, % of a core per drone", sim[1], PAPER_SIM, false),
        figure("Model update, % of a core", model[0], PAPER_MODEL, true),
        figure(
            "Model update, % of a core per drone",
            model[1],
            PAPER_MODEL,
            false,
        ),
    ]
}

/// The next 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6 or 8 times a power of ten.
pub(super) fn rounded_up(value: f64) -> f64 {
    let decade = maths::powf(10_f64, maths::log10(value).floor());
    let steps = [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0];
    let fits = |step: &f64| step * decade >= value * 0.999;
    decade * steps.into_iter().find(fits).unwrap_or(10.0)
}

/// A number for an axis: as many digits as it needs.
pub(super) fn label(value: f64) -> String {
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
