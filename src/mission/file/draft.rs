//! What earlier sections of a mission file have established, and references to it.

use toml::Spanned;

use super::Faults;
use crate::mission::Point;
use crate::mission::sensor::{ProbeSpec, Sensor};
use crate::mission::survey::SurveyPlan;
use crate::mission::zone::{Zone, ZoneKind};

/// What earlier sections have established, for those that refer to it.
#[derive(Debug, Default)]
pub(in crate::mission) struct Draft {
    pub zones: Vec<Zone>,
    pub sensors: Vec<&'static Sensor>,
    pub surveys: Vec<SurveyPlan>,
    /// Named points.
    pub places: Vec<(String, Point)>,
    pub pads: Vec<Point>,
    /// Names of the hazards, in the order of the file.
    pub hazards: Vec<String>,
    /// All names in the file that could be referred to, whether they could be read or not.
    pub declared: Vec<String>,
    /// What the places are called that earlier objectives will bring.
    pub drawn: Vec<String>,
    /// Id of the objective that is being read.
    pub objective: String,
}

impl Draft {
    /// A zone of kind `task` by name.
    pub fn task_zone(&self, name: &Spanned<String>, faults: &mut Faults) -> Option<&Zone> {
        let tasks = || self.zones.iter().filter(|zone| zone.kind == ZoneKind::Task);
        let found = tasks().find(|zone| zone.id == *name.get_ref());
        if found.is_none() {
            let known: Vec<&str> = tasks().map(|zone| zone.id.as_str()).collect();
            self.refers_to_nothing("task zone", name, &known, faults);
        }
        found
    }

    /// A sensor that the fleet carries.
    pub fn fitted_sensor(
        &self,
        name: &Spanned<String>,
        faults: &mut Faults,
    ) -> Option<&'static Sensor> {
        let found = self
            .sensors
            .iter()
            .find(|sensor| sensor.id == name.get_ref());
        if found.is_none() {
            let known: Vec<&str> = self.sensors.iter().map(|sensor| sensor.id).collect();
            self.refers_to_nothing("sensor of the fleet", name, &known, faults);
        }
        found.copied()
    }

    /// A sensor that the fleet carries and that measures where it is.
    pub fn fitted_probe(
        &self,
        name: &Spanned<String>,
        faults: &mut Faults,
    ) -> Option<(&'static Sensor, &'static ProbeSpec)> {
        let sensor = self.fitted_sensor(name, faults)?;
        let probe = sensor.probe();
        if probe.is_none() {
            let fault = format!("`{}` finds things, it measures nothing", sensor.id);
            faults.add(name.span(), fault);
        }
        Some((sensor, probe?))
    }

    /// The place of a hazard in the file, by name.
    pub fn hazard(&self, name: &Spanned<String>, faults: &mut Faults) -> Option<usize> {
        let found = self.hazards.iter().position(|id| id == name.get_ref());
        if found.is_none() {
            let known: Vec<&str> = self.hazards.iter().map(String::as_str).collect();
            self.refers_to_nothing("hazard", name, &known, faults);
        }
        found
    }

    /// The survey of an objective that stands earlier in the file.
    pub fn survey(&self, name: &Spanned<String>, faults: &mut Faults) -> Option<SurveyPlan> {
        let found = self
            .surveys
            .iter()
            .find(|survey| survey.id == *name.get_ref());
        if found.is_none() {
            let known: Vec<&str> = self
                .surveys
                .iter()
                .map(|survey| survey.id.as_str())
                .collect();
            self.refers_to_nothing("earlier sample_cells objective", name, &known, faults);
        }
        found.cloned()
    }
}

impl Draft {
    /// A reference to nothing, unless that only follows from a fault that is already known.
    pub(super) fn refers_to_nothing(
        &self,
        what: &str,
        name: &Spanned<String>,
        known: &[&str],
        faults: &mut Faults,
    ) {
        if faults.found.is_empty() || !(known.is_empty() || self.declared.contains(name.get_ref()))
        {
            faults.unknown(what, name, known);
        }
    }
}
