//! What gold needs besides points: `safety >= 0.85`, `crashes == 0`, `cells >= 9`.

use super::{Component, ComponentScore, Facts};
use crate::text;
use crate::text::Text;

/// One condition: a name, a comparison and a number.
#[derive(Debug, Clone, PartialEq)]
pub struct Gate {
    name: String,
    comparison: GateComparison,
    number: f64,
}

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
    /// Reads `NAME >= NUMBER` (or `<=`, `==`).
    ///
    /// # Errors
    /// In words, when it has another form or the number is not finite.
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
            name: name.trim().to_owned(),
            comparison,
            number,
        })
    }

    /// The name it compares: a component, `crashes`, or the id of an objective.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether it holds for a flight. A component that does not apply stands in nobody's way.
    pub fn holds(&self, facts: &Facts, components: &[ComponentScore]) -> bool {
        let Some(value) = self.value(facts, components) else {
            return true;
        };
        match self.comparison {
            GateComparison::AtLeast => value >= self.number,
            GateComparison::AtMost => value <= self.number,
            GateComparison::Equal => (value - self.number).abs() < 1e-9,
        }
    }

    /// Whether any flight could make it hold: components lie between 0 and 1, crashes are counted.
    pub fn can_hold(&self) -> bool {
        let is_component = Component::ALL.into_iter().any(|c| c.name() == self.name);
        let (low, high) = match self.name.as_str() {
            "crashes" => (0.0, f64::INFINITY),
            _ if is_component => (0.0, 1.0),
            _ => return true,
        };
        match self.comparison {
            GateComparison::AtLeast => self.number <= high,
            GateComparison::AtMost => self.number >= low,
            GateComparison::Equal => (low..=high).contains(&self.number),
        }
    }

    fn value(&self, facts: &Facts, components: &[ComponentScore]) -> Option<f64> {
        if self.name == "crashes" {
            return Some(
                facts
                    .safety
                    .iter()
                    .filter(|event| event.kind.is_loss())
                    .count() as f64,
            );
        }
        if let Some(objective) = facts.objectives.iter().find(|o| o.id == self.name) {
            return Some(objective.measure);
        }
        let component = Component::ALL.into_iter().find(|c| c.name() == self.name)?;
        components
            .iter()
            .find(|c| c.component == component)
            .map(|c| c.value)
    }
}

impl Gate {
    /// The condition as it is written, with the name that people know.
    pub fn text(&self) -> Text {
        let component = Component::ALL.into_iter().find(|c| c.name() == self.name);
        let name = match component {
            Some(component) => component.title(),
            None if self.name == "crashes" => text!("scoring-crashes"),
            None => self.name.as_str().into(),
        };
        let sign = COMPARISONS
            .iter()
            .find(|(_, comparison)| *comparison == self.comparison)
            .map_or("", |(sign, _)| sign);
        let parts = vec![name, sign.into(), self.number.to_string().into()];
        Text::joined(" ", parts)
    }
}
