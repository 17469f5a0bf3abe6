//! `hover`: every vehicle holds a position in the air without interruption.

use std::slice;

use super::{
    DemandedPlaces, DemandedTime, Demands, ObjectiveDetails, ObjectiveKind, ObjectiveScene,
    ObjectiveStanding, Tracker,
};
use crate::geo::maths;
use crate::mission::craft::Craft;
use crate::mission::format::{FileTable, KindOf, NamedPlace, heights, number, text};
use crate::mission::skill::Skill;
use crate::mission::world::World;
use crate::mission::{Point, TICK};
use crate::text;

#[derive(Debug, Clone)]
struct Hover {
    heights_m: [f64; 2],
    radius_m: f64,
    time_s: f64,
    /// The place; `None` for anywhere.
    place: Option<NamedPlace>,
}

#[derive(Debug, Clone)]
struct HoverTracker {
    plan: Hover,
    holds: Vec<HoverHold>,
}

#[derive(Debug, Clone, Copy, Default)]
struct HoverHold {
    around: Option<Point>,
    now_s: f64,
    best_s: f64,
}

pub(super) const KIND: KindOf<Box<dyn ObjectiveKind>> = KindOf {
    name: "hover",
    about: "met when every vehicle has held its position in the air without a break",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn ObjectiveKind>> {
    let heights_m = table.need("heights", heights(), "heights that count");
    let radius_m = table.need_radius();
    let time_s = table.need("time", number(0.5, 3600.0, "s"), "time without a break");
    let place_name = table.may(
        "place",
        text("id of a place"),
        "place of the hover (default anywhere)",
    );
    let place = match place_name {
        Some(name) => Some(table.draft().named_place(&name)?),
        None => None,
    };
    Some(Box::new(Hover {
        heights_m: heights_m?,
        radius_m: radius_m?,
        time_s: time_s?,
        place,
    }))
}

impl ObjectiveKind for Hover {
    fn measure_unit(&self) -> &'static str {
        "s"
    }

    fn skill(&self, _: usize) -> Option<Skill> {
        Some(Skill::K3)
    }

    fn demands(&self) -> Demands<'_> {
        Demands {
            places: self.place.as_ref().map(|place| DemandedPlaces {
                key: "place",
                all: slice::from_ref(place),
            }),
            heights_m: Some(self.heights_m),
            times: vec![DemandedTime::seconds("time", self.time_s)],
            ..Demands::default()
        }
    }

    fn start(&self, _: &World) -> Box<dyn Tracker> {
        Box::new(HoverTracker {
            plan: self.clone(),
            holds: Vec::new(),
        })
    }
}

impl Hover {
    fn step(&self, hold: &mut HoverHold, craft: &Craft) {
        let [low, high] = self.heights_m;
        let at = craft
            .at
            .filter(|_| craft.under_way && !craft.lost)
            .filter(|_| (low..=high).contains(&craft.height_m));
        let Some(at) = at else {
            (hold.around, hold.now_s) = (None, 0.0);
            return;
        };
        let fixed = self.place.as_ref().map(|place| place.at);
        let around = fixed.or(hold.around).unwrap_or(at);
        if maths::hypot(at[0] - around[0], at[1] - around[1]) <= self.radius_m {
            hold.around = Some(around);
            hold.now_s += TICK.as_secs_f64();
        } else {
            (hold.around, hold.now_s) = (Some(at), 0.0);
        }
        hold.best_s = hold.best_s.max(hold.now_s);
    }
}

impl HoverTracker {
    /// The share of the time that each vehicle has held its place.
    fn shares(&self) -> impl Iterator<Item = f64> {
        let share = |hold: &HoverHold| ((hold.best_s + 1e-9) / self.plan.time_s).min(1.0);
        self.holds.iter().map(share)
    }

    fn least_share(&self) -> f64 {
        self.shares().min_by(f64::total_cmp).unwrap_or(0.0)
    }
}

impl Tracker for HoverTracker {
    fn step(&mut self, scene: &ObjectiveScene<'_>) {
        self.holds
            .resize(scene.vehicles.len(), HoverHold::default());
        for (hold, craft) in self.holds.iter_mut().zip(scene.vehicles) {
            self.plan.step(hold, craft);
        }
    }

    fn standing(&self, _: &ObjectiveScene<'_>) -> ObjectiveStanding {
        let (shares, least) = (self.shares(), self.least_share());
        let met = least >= 1.0;
        ObjectiveStanding {
            fraction: shares.sum::<f64>() / self.holds.len().max(1) as f64,
            measure: least * self.plan.time_s,
            met,
            settled: met,
            landing: false,
        }
    }

    fn details(&self, _: &ObjectiveScene<'_>) -> ObjectiveDetails {
        let held_s = self.least_share() * self.plan.time_s;
        let [low, high] = self.plan.heights_m;
        let time = format!("{:.0}", self.plan.time_s);
        ObjectiveDetails {
            product: None,
            result: text!(
                "mission-hover-of",
                held = format!("{held_s:.0}"),
                time = time.as_str()
            ),
            outlook: None,
            target: text!("mission-hover", time = time.as_str()),
            advice: match &self.plan.place {
                Some(place) => text!(
                    "mission-hover-advice-at",
                    place = place.name.as_str(),
                    radius = format!("{:.0}", self.plan.radius_m),
                    low = format!("{low:.0}"),
                    high = format!("{high:.0}"),
                    time = time
                ),
                None => text!(
                    "mission-hover-advice",
                    radius = format!("{:.0}", self.plan.radius_m),
                    low = format!("{low:.0}"),
                    high = format!("{high:.0}"),
                    time = time
                ),
            },
        }
    }
}
