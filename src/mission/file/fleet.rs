//! The section `fleet`: what flies, from where, and what each vehicle carries.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;
use toml::de::DeValue;

use super::Faults;
use super::campaign::is_part;
use crate::mission::fit::Fit;
use crate::mission::ground_truth::Load;
use crate::mission::sensor::{SENSORS, Sensor};
use crate::mission::{Outlay, Point};

/// More than a console can fly.
const MOST_VEHICLES: usize = 250;
/// Pieces of one load, or seconds of the sprayer, on one vehicle.
const MOST_LOAD: u32 = 1000;
/// More than any fleet costs.
const MOST_CREDITS: u32 = 1_000_000;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FleetFile {
    max_vehicles: Spanned<usize>,
    pads: Spanned<Vec<Spanned<Point>>>,
    #[serde(default)]
    sensors: Vec<Spanned<String>>,
    #[serde(default)]
    loads: LoadsFile,
    vehicles: Option<Spanned<Vec<VehicleFile>>>,
    budget: Option<Spanned<u32>>,
    loaner: Option<Spanned<Vec<Spanned<String>>>>,
}

/// What one vehicle carries besides what all do.
#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields, default)]
struct VehicleFile {
    sensors: Vec<Spanned<String>>,
    loads: LoadsFile,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields, default)]
struct LoadsFile {
    ball: Option<Spanned<u32>>,
    spray: Option<Spanned<u32>>,
    kit: Option<Spanned<u32>>,
    node: Option<Spanned<u32>>,
}

/// What flies, and from where.
pub(super) struct Fleet {
    pub pads: Vec<Point>,
    /// One for each pad.
    pub fits: Vec<Fit>,
    pub outlay: Outlay,
}

impl Fleet {
    /// Every sensor that some vehicle carries.
    pub fn sensors(&self) -> Vec<&'static Sensor> {
        let mut all = Fit::default();
        let carried = self.fits.iter().flat_map(|fit| &fit.sensors);
        carried.for_each(|sensor| all.add(sensor));
        all.sensors
    }
}

pub(super) fn fleet(value: Spanned<DeValue<'_>>, faults: &mut Faults) -> Option<Fleet> {
    let file: FleetFile = faults.read_value(value)?;
    let (count, pads) = (*file.max_vehicles.get_ref(), file.pads.get_ref());
    if !(1..=MOST_VEHICLES).contains(&count) {
        faults.add(
            file.max_vehicles.span(),
            format!("`max_vehicles` must lie between 1 and {MOST_VEHICLES}"),
        );
    } else if pads.len() != count {
        faults.add(
            file.pads.span(),
            format!("{count} vehicles need {count} pads, not {}", pads.len()),
        );
    }
    let fits = fits(&file, faults);
    Some(Fleet {
        outlay: outlay(&file, faults),
        pads: pads.iter().map(|pad| faults.point(pad, "pads")).collect(),
        fits,
    })
}

/// What the fleet may cost, and what is lent.
fn outlay(file: &FleetFile, faults: &mut Faults) -> Outlay {
    if let Some(budget) = &file.budget
        && !(1..=MOST_CREDITS).contains(budget.get_ref())
    {
        let fault = format!("`budget` must lie between 1 and {MOST_CREDITS} credits");
        faults.add(budget.span(), fault);
    }
    let lent = file.loaner.as_ref();
    if let Some(list) = lent.filter(|list| list.get_ref().len() > file.pads.get_ref().len()) {
        let fault = "`loaner` lends one design for each pad at most";
        faults.add(list.span(), fault);
    }
    let lent = lent.into_iter().flat_map(Spanned::get_ref);
    for id in lent.clone().filter(|id| !is_part(id.get_ref())) {
        let fault = "a design's id is 1 to 40 small letters, digits, `-` and `_`";
        faults.add(id.span(), fault);
    }
    Outlay {
        budget: file.budget.as_ref().map(|budget| *budget.get_ref()),
        loaners: lent.map(|id| id.get_ref().clone()).collect(),
    }
}

/// What each vehicle carries: what all do, and its own.
fn fits(file: &FleetFile, faults: &mut Faults) -> Vec<Fit> {
    let common = VehicleFile::fit(&file.sensors, &file.loads, Fit::default(), faults);
    let count = file.pads.get_ref().len();
    let Some(vehicles) = &file.vehicles else {
        return vec![common; count];
    };
    let own = vehicles.get_ref();
    if own.len() != count {
        faults.add(
            vehicles.span(),
            format!("`vehicles` has {} for {count} pads: one each", own.len()),
        );
    }
    let fit =
        |own: &VehicleFile| VehicleFile::fit(&own.sensors, &own.loads, common.clone(), faults);
    own.iter().map(fit).collect()
}

impl VehicleFile {
    /// A fit with more sensors, and with these loads in the place of others of their kind.
    fn fit(
        sensors: &[Spanned<String>],
        loads: &LoadsFile,
        mut fit: Fit,
        faults: &mut Faults,
    ) -> Fit {
        for name in sensors {
            if let Some(sensor) = Sensor::by_id(name.get_ref()) {
                fit.add(sensor);
            } else {
                let known: Vec<&str> = SENSORS.iter().map(|sensor| sensor.id).collect();
                faults.unknown("sensor", name, &known);
            }
        }
        fit.loads.extend(loads.counted(faults));
        fit.loads.retain(|_, count| *count > 0);
        fit
    }
}

impl LoadsFile {
    fn counted(&self, faults: &mut Faults) -> BTreeMap<Load, u32> {
        let all = [
            (Load::Ball, &self.ball, "ball"),
            (Load::Spray, &self.spray, "spray"),
            (Load::Kit, &self.kit, "kit"),
            (Load::Node, &self.node, "node"),
        ];
        let mut loads = BTreeMap::new();
        for (load, written, name) in all {
            let Some(written) = written else { continue };
            if *written.get_ref() > MOST_LOAD {
                let fault = format!("`{name}` must lie between 0 and {MOST_LOAD}");
                faults.add(written.span(), fault);
            }
            loads.insert(load, *written.get_ref());
        }
        loads
    }
}
