//! `[fleet]`: the vehicles, their pads, and their equipment.

use std::collections::BTreeMap;

use super::career::design_id;
use crate::mission::MissionSeats;
use crate::mission::fit::Fit;
use crate::mission::format::{
    FileTable, ListValue, NameKind, NamedValue, flag, list, named, point, table as table_of, whole,
};
use crate::mission::ground_truth::Load;
use crate::mission::sensor::Sensor;
use crate::mission::{Outlay, Point};
use crate::sim::VehicleKind;
use crate::text;

/// The maximum number of vehicles, more than a console can fly.
const MOST_VEHICLES: u32 = 250;
/// The maximum number of pieces of one load, or seconds of spray, on one vehicle.
const MOST_LOAD: u32 = 1000;
/// The highest budget, more than any fleet costs.
const MOST_CREDITS: u32 = 1_000_000;

/// The vehicles and their pads.
pub(super) struct FleetSection {
    pub pads: Vec<Point>,
    /// One fit for each pad.
    pub fits: Vec<Fit>,
    /// The kind of vehicle on each pad.
    pub kinds: Vec<VehicleKind>,
    pub outlay: Outlay,
}

/// Sensors and loads as the file lists them.
#[derive(Default)]
struct Carried {
    sensors: Vec<&'static Sensor>,
    loads: BTreeMap<Load, u32>,
}

/// One vehicle as the file lists it.
struct ListedVehicle {
    kind: VehicleKind,
    flail: bool,
    carried: Carried,
}

impl FleetSection {
    /// Every sensor that some vehicle carries.
    pub fn sensors(&self) -> Vec<&'static Sensor> {
        let mut all = Fit::default();
        let carried = self.fits.iter().flat_map(|fit| &fit.sensors);
        carried.for_each(|sensor| all.add(sensor));
        all.sensors
    }

    /// The seats of the mission with its own drones.
    pub fn seats(self) -> MissionSeats {
        MissionSeats {
            count: self.pads.len(),
            sensors: self.sensors(),
            outlay: self.outlay,
            pads: self.pads,
            asked: self.fits.clone(),
            fits: self.fits,
            kinds: self.kinds,
            designs: Vec::new(),
            crew: Vec::new(),
        }
    }
}

pub(super) fn fleet(table: &mut FileTable<'_>) -> Option<FleetSection> {
    let vehicles = table.need(
        "max_vehicles",
        whole(1, MOST_VEHICLES, ""),
        "number of vehicles",
    );
    let pads_form = list(point(), 0, usize::MAX);
    let pads = table.need("pads", pads_form, "start positions, one per vehicle");
    let common = Carried {
        sensors: table
            .may("sensors", sensors(), "sensors on every vehicle")
            .unwrap_or_default(),
        loads: table
            .may("loads", table_of(loads), "loads on every vehicle")
            .unwrap_or_default(),
    };
    let own_form = list(table_of(vehicle), 0, usize::MAX);
    let own = table.may("vehicles", own_form, "one table per pad");
    let outlay = outlay(table, pads.as_ref().map(Vec::len));
    let (vehicles, pads) = (vehicles?, pads?);
    let place = table.place_of("pads");
    // A pad that cannot be read is missing in the list; its own fault is enough.
    if pads.len() != vehicles as usize && !table.draft().faults.are_within(&place) {
        let fault = text!("fault-pads", vehicles = vehicles, found = pads.len());
        table.fault_of("pads", fault);
    }
    if let Some(own) = &own
        && own.len() != pads.len()
    {
        let fault = text!(
            "fault-each-pad",
            name = "vehicles",
            count = own.len(),
            pads = pads.len()
        );
        table.fault_of("vehicles", fault);
    }
    let common = common.added_to(Fit::default());
    let usual = || ListedVehicle {
        kind: VehicleKind::Copter,
        flail: false,
        carried: Carried::default(),
    };
    let own = own.unwrap_or_else(|| pads.iter().map(|_| usual()).collect());
    let fit = |vehicle: &ListedVehicle| Fit {
        flail: vehicle.flail,
        ..vehicle.carried.added_to(common.clone())
    };
    Some(FleetSection {
        outlay,
        fits: own.iter().map(fit).collect(),
        kinds: own.iter().map(|vehicle| vehicle.kind).collect(),
        pads,
    })
}

/// The fleet's budget, and the designs lent.
fn outlay(table: &mut FileTable<'_>, pads: Option<usize>) -> Outlay {
    let budget = table.may(
        "budget",
        whole(1, MOST_CREDITS, "credits"),
        "maximum cost of the fleet; must be enough for the cheapest one",
    );
    let loaners = table
        .may(
            "loaner",
            list(design_id(), 0, usize::MAX),
            "designs lent to trainees without a suitable one, at most one per pad",
        )
        .unwrap_or_default();
    if pads.is_some_and(|pads| loaners.len() > pads) {
        table.fault_of("loaner", text!("fault-loaners"));
    }
    Outlay {
        budget,
        loaners: loaners.into_iter().map(toml::Spanned::into_inner).collect(),
    }
}

fn sensors() -> ListValue<NamedValue<&'static Sensor>> {
    list(
        named(NameKind::Sensor, Sensor::ids, Sensor::by_id),
        0,
        usize::MAX,
    )
}

fn vehicle(table: &mut FileTable<'_>) -> Option<ListedVehicle> {
    let kind = table.or(
        "kind",
        named(
            NameKind::VehicleKind,
            VehicleKind::names,
            VehicleKind::named,
        ),
        VehicleKind::Copter,
        "kind of vehicle: a drone, a ground robot or a boat",
    );
    let flail = table.or(
        "flail",
        flag(),
        false,
        "whether this ground robot clears mines ahead of it, at up to 1.2 m/s",
    );
    let sensors = table.may("sensors", sensors(), "additional sensors of this vehicle");
    let loads = table.may(
        "loads",
        table_of(loads),
        "loads of this vehicle instead of the fleet's",
    );
    Some(ListedVehicle {
        kind,
        flail,
        carried: Carried {
            sensors: sensors.unwrap_or_default(),
            loads: loads.unwrap_or_default(),
        },
    })
}

fn loads(table: &mut FileTable<'_>) -> Option<BTreeMap<Load, u32>> {
    let keys = [
        (Load::Ball, "extinguishing balls"),
        (Load::Spray, "seconds of spray"),
        (Load::Kit, "kits for people"),
        (Load::Node, "sensor nodes"),
    ];
    let counted = keys.into_iter().filter_map(|(load, about)| {
        let count = table.may(load.id(), whole(0, MOST_LOAD, ""), about)?;
        Some((load, count))
    });
    Some(counted.collect())
}

impl Carried {
    /// A fit with these sensors added, and with these loads replacing others of the same kind.
    fn added_to(&self, mut fit: Fit) -> Fit {
        self.sensors.iter().for_each(|sensor| fit.add(sensor));
        fit.loads.extend(&self.loads);
        fit.loads.retain(|_, count| *count > 0);
        fit
    }
}
