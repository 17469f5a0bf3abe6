//! The section `scoring`.

use std::time::Duration;

use serde::Deserialize;
use toml::Spanned;
use toml::de::DeValue;

use super::SHORTEST_LIMIT;
use super::{Faults, seconds};
use crate::diagnostic::Diagnostic;
use crate::scoring::{Component, Gate, Medals, Rules, Weights};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ScoringFile {
    weights: Option<Spanned<WeightsFile>>,
    par: ParFile,
    medals: Option<Spanned<MedalsFile>>,
    #[serde(default)]
    gold_requires: Vec<Spanned<String>>,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields, default)]
struct WeightsFile {
    objective: f64,
    quality: f64,
    time: f64,
    energy: f64,
    safety: f64,
    command: f64,
    attention: f64,
    utilisation: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ParFile {
    time: Spanned<f64>,
    energy_wh: Spanned<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MedalsFile {
    gold: u16,
    silver: u16,
    bronze: u16,
}

/// Reads the section; gates may name the objectives.
pub(super) fn rules(
    value: Spanned<DeValue<'_>>,
    objectives: &[&str],
    time_limit: Duration,
    faults: &mut Faults,
) -> Option<Rules> {
    let file: ScoringFile = faults.read_value(value)?;
    let par_s = faults.number(&file.par.time, 1.0..=86_400.0, "time");
    if par_s >= time_limit.as_secs_f64() && time_limit >= SHORTEST_LIMIT {
        faults.add(
            file.par.time.span(),
            "the par time must be shorter than `time_limit`",
        );
    }
    let names = || {
        Component::ALL
            .map(Component::name)
            .into_iter()
            .chain(["crashes"])
            .chain(objectives.iter().copied())
    };
    let mut gold_requires = Vec::new();
    for text in &file.gold_requires {
        match Gate::parse(text.get_ref()) {
            Ok(gate) if names().any(|name| name == gate.name()) => gold_requires.push(gate),
            Ok(gate) => {
                let fault = Diagnostic::new(
                    text.span(),
                    format!("unknown name `{}` in a gate", gate.name()),
                );
                faults.found.push(fault.with_nearest(gate.name(), names()));
            }
            Err(reason) => faults.add(text.span(), reason),
        }
    }
    Some(Rules {
        weights: file
            .weights
            .map_or_else(Weights::default, |weights| weights_of(&weights, faults)),
        par_time: seconds(par_s)?,
        par_energy_wh: faults.number(&file.par.energy_wh, 0.01..=1e6, "energy_wh"),
        time_limit,
        medals: medals(file.medals.as_ref(), faults),
        gold_requires,
    })
}

fn weights_of(file: &Spanned<WeightsFile>, faults: &mut Faults) -> Weights {
    let w = file.get_ref();
    let all = [
        w.objective,
        w.quality,
        w.time,
        w.energy,
        w.safety,
        w.command,
        w.attention,
        w.utilisation,
    ];
    let sum: f64 = all.iter().sum();
    if !all.iter().all(|weight| (0.0..=1.0).contains(weight)) {
        faults.add(file.span(), "every weight must lie between 0 and 1");
    } else if (sum - 1.0).abs() > 1e-6 {
        faults.add(
            file.span(),
            format!("the weights must sum to 1, not {sum:.3}"),
        );
    }
    Weights(all)
}

fn medals(file: Option<&Spanned<MedalsFile>>, faults: &mut Faults) -> Medals {
    let Some(file) = file else {
        return Medals {
            gold: 850,
            silver: 700,
            bronze: 550,
        };
    };
    let &MedalsFile {
        gold,
        silver,
        bronze,
    } = file.get_ref();
    if !(bronze < silver && silver < gold && gold <= 1000) {
        faults.add(
            file.span(),
            "medals must rise from bronze to gold, 1000 at most",
        );
    }
    Medals {
        gold,
        silver,
        bronze,
    }
}
