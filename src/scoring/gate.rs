//! The conditions for gold besides points: `safety >= 0.85`, `crashes == 0`, `cells >= 9`.

use super::{Component, ComponentScore, Facts};
use crate::text;
use crate::text::Text;

/// A condition: a quantity, a relation and a number.
#[derive(Debug, Clone, PartialEq)]
pub struct Gate {
    measure: GateMeasure,
    comparison: GateComparison,
    number: f64,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum GateMeasure {
    Component(Component),
    /// The number of lost vehicles.
    Crashes,
    /// The measure of an objective, by its id.
    Objective(String),
}

impl GateMeasure {
    fn of(name: &str) -> Self {
        if name == CRASHES {
            return Self::Crashes;
        }
        let component = Component::ALL.into_iter().find(|it| it.name() == name);
        component.map_or_else(|| Self::Objective(name.to_owned()), Self::Component)
    }

    /// Its display name and unit; `subject` describes an objective by its id.
    fn subject(&self, subject: impl Fn(&str) -> Option<GateSubject>) -> GateSubject {
        let plain = |title| GateSubject { title, unit: "" };
        match self {
            Self::Component(component) => plain(component.title()),
            Self::Crashes => plain(text!("scoring-crashes")),
            Self::Objective(id) => subject(id).unwrap_or_else(|| plain(id.as_str().into())),
        }
    }

    /// The value of the quantity; `None` if the flight has no such quantity.
    fn value(&self, facts: &Facts, components: &[ComponentScore]) -> Option<f64> {
        match self {
            Self::Component(component) => components
                .iter()
                .find(|it| it.component == *component)
                .map(|it| it.value),
            Self::Crashes => {
                let lost = facts.safety.iter().filter(|event| event.kind.is_loss());
                Some(lost.count() as f64)
            }
            Self::Objective(id) => facts
                .objectives
                .iter()
                .find(|it| it.id == *id)
                .map(|it| it.measure),
        }
    }
}

/// The objective that a gate compares, in words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GateSubject {
    pub title: Text,
    /// The unit of its measure; empty for counts and shares.
    pub unit: &'static str,
}

/// The name by which gates count lost vehicles.
const CRASHES: &str = "crashes";

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum GateComparison {
    AtLeast,
    AtMost,
    Equal,
}

const COMPARISONS: [(&str, GateComparison); 3] = [
    (">=", GateComparison::AtLeast),
    ("<=", GateComparison::AtMost),
    ("==", GateComparison::Equal),
];

impl Gate {
    /// The names that are valid in every mission, in addition to the ids of its objectives.
    pub fn names() -> impl Iterator<Item = &'static str> {
        let components = Component::ALL.into_iter().map(Component::name);
        components.chain([CRASHES])
    }

    /// Reads `NAME >= NUMBER` (or `<=`, `==`).
    ///
    /// # Errors
    /// The form differs, or the number is not finite.
    pub fn parse(text: &str) -> Result<Self, String> {
        let found = COMPARISONS
            .iter()
            .find_map(|&(sign, comparison)| text.split_once(sign).map(|parts| (parts, comparison)));
        let Some(((name, number), comparison)) = found else {
            return Err("a gate reads `NAME >= NUMBER`, with `>=`, `<=` or `==`".to_owned());
        };
        let number: f64 = number
            .trim()
            .parse()
            .map_err(|_| format!("`{}` is not a number", number.trim()))?;
        if !number.is_finite() {
            return Err("the number of a gate must be finite".to_owned());
        }
        Ok(Self {
            measure: GateMeasure::of(name.trim()),
            comparison,
            number,
        })
    }

    /// The id of the objective that it compares, if any.
    pub fn objective(&self) -> Option<&str> {
        match &self.measure {
            GateMeasure::Objective(id) => Some(id),
            GateMeasure::Component(_) | GateMeasure::Crashes => None,
        }
    }

    /// Whether it holds for a flight. A component that does not apply always passes.
    pub fn holds(&self, facts: &Facts, components: &[ComponentScore]) -> bool {
        let Some(value) = self.measure.value(facts, components) else {
            return true;
        };
        match self.comparison {
            GateComparison::AtLeast => value >= self.number,
            GateComparison::AtMost => value <= self.number,
            GateComparison::Equal => (value - self.number).abs() < 1e-9,
        }
    }

    /// Whether it can hold for any flight: components are within 0 to 1, crashes are counts.
    pub fn can_hold(&self) -> bool {
        let (low, high) = match self.measure {
            GateMeasure::Crashes => (0.0, f64::INFINITY),
            GateMeasure::Component(_) => (0.0, 1.0),
            GateMeasure::Objective(_) => return true,
        };
        match self.comparison {
            GateComparison::AtLeast => self.number <= high,
            GateComparison::AtMost => self.number >= low,
            GateComparison::Equal => (low..=high).contains(&self.number),
        }
    }
}

impl Gate {
    /// The condition in words. `subject` describes an objective by its id.
    pub fn text(&self, subject: impl Fn(&str) -> Option<GateSubject>) -> Text {
        let loses_none = self.comparison != GateComparison::AtLeast && self.number.abs() < 1e-9;
        if self.measure == GateMeasure::Crashes && loses_none {
            return text!("gate-no-crash");
        }
        let GateSubject { title: what, unit } = self.measure.subject(subject);
        // Objectives that are met or not are measured as 1 or 0.
        let is_met = self.comparison == GateComparison::AtLeast && (self.number - 1.0).abs() < 1e-9;
        if is_met && self.objective().is_some() {
            return what;
        }
        let number = match unit {
            "" => self.number.to_string(),
            unit => format!("{} {unit}", self.number),
        };
        match self.comparison {
            GateComparison::AtLeast => text!("gate-at-least", what = what, number = number),
            GateComparison::AtMost => text!("gate-at-most", what = what, number = number),
            GateComparison::Equal => text!("gate-equal", what = what, number = number),
        }
    }
}
