//! Keys shared by tables of several sections.

use toml::Spanned;

use super::collection::list;
use super::table::FileTable;
use super::value;
use crate::mission::sensor::Sensor;
use crate::mission::zone::Zone;
use crate::text;

/// Whether the larger or the smaller of two values is better.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::mission) enum BetterMeasure {
    Higher,
    Lower,
}

/// The target of an objective.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::mission) struct ObjectiveTarget {
    /// The measure that earns all points.
    pub met_at: f64,
    /// The measure from which partial points are awarded.
    pub partial_from: f64,
}

/// The target of an objective that counts pieces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::mission) struct CountTarget {
    pub met_at: usize,
    /// The count from which partial points are awarded.
    pub partial_from: usize,
}

impl FileTable<'_> {
    /// A task zone by the key `zone`.
    pub fn need_task_zone(&mut self) -> Option<Zone> {
        let name = self.need(
            "zone",
            value::text("id of a task zone"),
            "zone to which this applies",
        )?;
        self.draft().task_zone(&name)
    }

    /// A sensor that the fleet carries, by a key.
    pub fn need_sensor(&mut self, name: &str, about: &'static str) -> Option<&'static Sensor> {
        let id = self.need(name, value::sensor_id(), about)?;
        self.draft().fitted_sensor(&id)
    }

    /// Sensors that the fleet carries, by the key `sensors`, each with its position in the file.
    pub fn need_sensors(&mut self, about: &'static str) -> Option<Vec<Spanned<&'static Sensor>>> {
        let ids = self.need("sensors", list(value::sensor_id(), 1, 100), about)?;
        let fitted = ids.iter().filter_map(|id| {
            let sensor = self.draft().fitted_sensor(id)?;
            Some(Spanned::new(id.span(), sensor))
        });
        Some(fitted.collect())
    }

    /// The index of a hazard, by a key.
    pub fn need_hazard(&mut self, name: &str, about: &'static str) -> Option<usize> {
        let id = self.need(name, value::text("id of a hazard"), about)?;
        self.draft().hazard(&id)
    }

    /// The target, and the measure from which partial points are awarded, which must be worse than
    /// the target.
    pub fn need_target(
        &mut self,
        range: [f64; 2],
        better: BetterMeasure,
    ) -> Option<ObjectiveTarget> {
        let [low, high] = range;
        let asked = value::number(low, high, "");
        let met_at = self.need("target", asked, "result that earns all points");
        let from = value::number(0.0, high, "");
        let partial_from = self.need("partial_from", from, "result at which points begin");
        let target = ObjectiveTarget {
            met_at: met_at?,
            partial_from: partial_from?,
        };
        let (is_worse, message) = match better {
            BetterMeasure::Higher => (
                target.partial_from < target.met_at,
                text!("fault-from-below"),
            ),
            BetterMeasure::Lower => (
                target.partial_from > target.met_at,
                text!("fault-from-above"),
            ),
        };
        if !is_worse {
            self.fault_of("partial_from", message);
        }
        Some(target)
    }

    /// The target count, and the count from which partial points are awarded.
    pub fn need_count(&mut self, least: u32, most: u32, unit: &'static str) -> Option<CountTarget> {
        let asked = value::whole(least, most, unit);
        let needed = self.need("target", asked, "result that earns all points");
        let from = value::whole(0, most, unit);
        let partial_from = self.or("partial_from", from, 0, "result at which points begin");
        let met_at = needed?;
        if met_at <= partial_from {
            self.fault_of("target", text!("fault-target-from"));
        }
        Some(CountTarget {
            met_at: met_at as usize,
            partial_from: partial_from as usize,
        })
    }
}
