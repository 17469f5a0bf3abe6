//! `[scoring]`: weights, medals and limits of the score.

use std::time::Duration;

use toml::Spanned;

use crate::diagnostic::Diagnostic;
use crate::mission::format::{
    FileTable, LONGEST_S, list, number, seconds, table as table_of, text, whole,
};
use crate::scoring::{Component, Gate, Medals, ScoreRules, Weights};
use crate::text;

const USUAL_MEDALS: Medals = Medals {
    gold: 850,
    silver: 700,
    bronze: 550,
};

/// The values that earn full points.
struct Par {
    time: Duration,
    energy_wh: f64,
}

/// Reads the section; gates may name the objectives.
pub(super) fn rules(table: &mut FileTable<'_>) -> Option<ScoreRules> {
    let weights = table.may(
        "weights",
        table_of(weights),
        "weights of the components, with a sum of 1; default .35, .15, .10, .05, .20, .05, .05 and .05",
    );
    let par = table.need(
        "par",
        table_of(par),
        "values that earn all points: fly the reference script and multiply its values by 1.35 (tier 0), 1.25 (tier 1) or 1.15 (tiers 2 and 3)",
    );
    let medals = table.may(
        "medals",
        table_of(medals),
        "points for each medal (default 850, 700 and 550); every medal requires the mandatory objectives",
    );
    let gates_form = list(
        text("`NAME >= NUMBER`, with `>=`, `<=` or `==`"),
        0,
        usize::MAX,
    );
    let gates = table.may(
        "gold_requires",
        gates_form,
        "further conditions for gold: a component (0 to 1), `crashes`, or an objective's measure (cells, vehicles, \
         shares, seconds)",
    ).unwrap_or_default();
    let gold_requires = gates
        .iter()
        .filter_map(|written| gate(table, written))
        .collect();
    let free_refusals = table.or(
        "free_refusals",
        whole(0, 10, "refusals"),
        0,
        "number of refused commands that cost nothing, because the lesson requires them",
    );
    let par = par?;
    Some(ScoreRules {
        weights: weights.unwrap_or_default(),
        par_time: par.time,
        par_energy_wh: par.energy_wh,
        time_limit: table.draft().time_limit?,
        medals: medals.unwrap_or(USUAL_MEDALS),
        gold_requires,
        free_refusals,
    })
}

fn par(table: &mut FileTable<'_>) -> Option<Par> {
    let time = table.need(
        "time",
        seconds(1.0, LONGEST_S),
        "par time, below the time limit",
    );
    let energy = number(0.01, 1e6, "Wh");
    let energy_wh = table.need("energy_wh", energy, "par energy of all vehicles");
    let limit = table.draft().time_limit;
    if time.zip(limit).is_some_and(|(time, limit)| time >= limit) {
        table.fault_of("time", text!("fault-par-time"));
    }
    Some(Par {
        time: time?,
        energy_wh: energy_wh?,
    })
}

fn gate(table: &mut FileTable<'_>, written: &Spanned<String>) -> Option<Gate> {
    let gate = match Gate::parse(written.get_ref()) {
        Ok(gate) => gate,
        Err(reason) => {
            table.draft().faults.add(written.span(), reason);
            return None;
        }
    };
    let objectives = table.draft().ids("objectives").to_vec();
    if let Some(id) = gate
        .objective()
        .filter(|id| !objectives.iter().any(|it| it == id))
    {
        let message = text!("fault-gate-name", name = id);
        let mut names: Vec<&str> = Gate::names().collect();
        names.extend(objectives.iter().map(String::as_str));
        let fault = Diagnostic::new(written.span(), message).with_nearest(id, names);
        table.draft().faults.push(fault);
    }
    Some(gate)
}

/// The meaning of a component, for authors of missions.
fn about(component: Component) -> &'static str {
    match component {
        Component::Objective => {
            "the objectives, weighted by `value`; at most .5 if a mandatory one was missed"
        }
        Component::Quality => {
            "quality of the product; without a product, the other components share its weight"
        }
        Component::Time => {
            "1 up to `par.time`, 0 at the time limit, and 0 below 60 % of the objectives"
        }
        Component::Energy => {
            "1 up to `par.energy_wh`, 0 at 1.6 times that, and 0 below 80 % of the objectives"
        }
        Component::Safety => "1 less the cost of broken rules",
        Component::Command => "falls with refused, repeated and unanswered commands",
        Component::Attention => {
            "alerts with `ok` that were answered in time, weighted 1, 2 or 4 by level; without such alerts, the weight is 0"
        }
        Component::Utilisation => {
            "vehicles in the air with a task; with a single vehicle, the weight goes to safety"
        }
    }
}

fn weights(table: &mut FileTable<'_>) -> Option<Weights> {
    let weight = number(0.0, 1.0, "");
    let weights =
        Component::ALL.map(|component| table.or(component.name(), weight, 0.0, about(component)));
    let sum: f64 = weights.iter().sum();
    if (sum - 1.0).abs() > 1e-6 && !table.has_wrong() {
        table.fault(text!("fault-weights", sum = format!("{sum:.3}")));
    }
    Some(Weights(weights))
}

fn medals(table: &mut FileTable<'_>) -> Option<Medals> {
    let form = whole(0, 1000, "points");
    let mut points = |medal| {
        let needed = table.need(medal, form, "points for this medal");
        needed.and_then(|points| u16::try_from(points).ok())
    };
    let (gold, silver, bronze) = (points("gold"), points("silver"), points("bronze"));
    let medals = Medals {
        gold: gold?,
        silver: silver?,
        bronze: bronze?,
    };
    if !(medals.bronze < medals.silver && medals.silver < medals.gold) {
        table.fault(text!("fault-medals"));
    }
    Some(medals)
}
