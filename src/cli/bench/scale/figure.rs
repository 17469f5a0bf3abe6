//! The four figures: the simulator's and the model update's processor time, in total and per vehicle, each against
//! the number of vehicles and beside what the paper has. [`super::chart`] and [`super::svg`] draw them.

use super::sample::Row;

/// What the paper says of a vehicle, in percent of a core: least and most.
pub(super) const PAPER_SIM: [f64; 2] = [0.8, 1.0];
/// The same of the console's model update.
pub(super) const PAPER_MODEL: [f64; 2] = [0.045, 0.063];
/// The paper's model update per message, in microseconds.
pub(super) const PAPER_US_PER_MESSAGE: f64 = 24.5;

/// One figure.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Figure {
    pub title: &'static str,
    /// Of all vehicles together, and not of each.
    pub is_total: bool,
    /// Numbers of vehicles and percent of a core.
    pub measured: Vec<(f64, f64)>,
    /// The paper's least and most at a vehicle number of 0 and at the highest.
    pub paper: [[(f64, f64); 2]; 2],
    pub most_vehicles: f64,
    /// Where the vertical axis ends: a number with few digits.
    pub top: f64,
}

/// The four figures of a series.
pub(super) fn figures(rows: &[Row]) -> [Figure; 4] {
    let flown = || rows.iter().filter(|row| row.repeats > 0);
    let most = flown().map(|row| row.vehicles).max().unwrap_or(0).max(1);
    let most = f64::from(most);
    let points = |value: fn(&Row) -> Option<f64>| {
        flown()
            .filter_map(|row| Some((f64::from(row.vehicles), value(row)?)))
            .collect::<Vec<_>>()
    };
    let figure = |title, measured: Vec<(f64, f64)>, paper: [f64; 2], is_total: bool| {
        let line = |each: f64| {
            let at = |vehicles: f64| (vehicles, if is_total { each * vehicles } else { each });
            [at(0.0), at(most)]
        };
        let paper = paper.map(line);
        let values = measured.iter().chain(paper.iter().flatten());
        let top = values.map(|(_, value)| *value).fold(0.0, f64::max);
        Figure {
            title,
            is_total,
            measured,
            paper,
            most_vehicles: most,
            top: rounded_up(top),
        }
    };
    [
        figure(
            "Simulator, % of a core",
            points(|row| Some(row.sim_core_percent)),
            PAPER_SIM,
            true,
        ),
        figure(
            "Simulator, % of a core per drone",
            points(|row| row.sim_core_percent_per_vehicle),
            PAPER_SIM,
            false,
        ),
        figure(
            "Model update, % of a core",
            points(|row| Some(row.model_percent)),
            PAPER_MODEL,
            true,
        ),
        figure(
            "Model update, % of a core per drone",
            points(|row| row.model_percent_per_vehicle),
            PAPER_MODEL,
            false,
        ),
    ]
}

/// What each further vehicle costs, in percent of a core: the slope of the straight line that fits best.
pub(super) fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let count = points.len() as f64;
    let mean = |part: fn(&(f64, f64)) -> f64| points.iter().map(part).sum::<f64>() / count;
    let (x, y) = (mean(|point| point.0), mean(|point| point.1));
    let spread: f64 = points.iter().map(|point| (point.0 - x).powi(2)).sum();
    let together: f64 = points
        .iter()
        .map(|point| (point.0 - x) * (point.1 - y))
        .sum();
    (spread > 0.0).then(|| together / spread)
}

/// The next 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6 or 8 times a power of ten.
fn rounded_up(value: f64) -> f64 {
    if value <= 0.0 {
        return 1.0;
    }
    let decade = 10_f64.powf(value.log10().floor());
    let steps = [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    let fits = |step: &f64| step * decade >= value * 0.999;
    decade * steps.into_iter().find(fits).unwrap_or(10.0)
}

/// A number for an axis: as many digits as it needs.
pub(super) fn label(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    text.to_owned()
}
