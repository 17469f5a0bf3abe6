//! Attention: how soon alerts were answered by an action.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::geo::maths;
use crate::text;
use crate::text::Text;

/// The urgency of an alert.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum AlertLevel {
    /// The alert can wait a minute.
    Caution,
    /// The alert can wait half a minute.
    Warning,
    /// The alert must be answered within seconds.
    Critical,
}

impl AlertLevel {
    /// Its weight among the alerts of a flight.
    pub fn weight(self) -> f64 {
        match self {
            Self::Caution => 1.0,
            Self::Warning => 2.0,
            Self::Critical => 4.0,
        }
    }

    /// The default time limit for full points.
    pub fn usual_limit(self) -> Duration {
        Duration::from_secs(match self {
            Self::Caution => 60,
            Self::Warning => 30,
            Self::Critical => 10,
        })
    }
}

/// One alert that had to be answered.
#[derive(Debug, Clone, PartialEq)]
pub struct AlertFact {
    /// The text of the alert.
    pub text: Text,
    pub level: AlertLevel,
    /// Mission time when it was raised.
    pub at: Duration,
    /// The time limit for full points.
    pub limit: Duration,
    /// The time until the answer; `None` if there was none.
    pub answered_after: Option<Duration>,
}

impl AlertFact {
    /// Whether it was answered in time.
    pub fn is_in_time(&self) -> bool {
        self.answered_after.is_some_and(|after| after <= self.limit)
    }

    /// The value of the answer: 1 if in time, halved with each further time limit; 0 without an answer.
    pub fn value(&self) -> f64 {
        let Some(after) = self.answered_after else {
            return 0.0;
        };
        let limit_s = self.limit.as_secs_f64().max(0.1);
        let late = (after.as_secs_f64() - limit_s) / limit_s;
        maths::exp2(-late.max(0.0))
    }
}

/// The weighted mean over all alerts; `None` if there were none.
pub fn attention_value(alerts: &[AlertFact]) -> Option<f64> {
    let total: f64 = alerts.iter().map(|alert| alert.level.weight()).sum();
    let weighted = alerts
        .iter()
        .map(|alert| alert.level.weight() * alert.value());
    (total > 0.0).then(|| weighted.sum::<f64>() / total)
}

/// The value, and the alert with the greatest effect on it, as text; `None` without alerts.
pub(super) fn value_and_words(alerts: &[AlertFact]) -> Option<(f64, Text)> {
    let value = attention_value(alerts)?;
    let words = match worst(alerts) {
        None => text!("scoring-alerts-answered", count = alerts.len()),
        Some((alert, late)) => {
            let alert = answer_words(alert);
            match late - 1 {
                0 => alert,
                more => text!("scoring-alerts-late", worst = alert, more = more),
            }
        }
    };
    Some((value, words))
}

/// Advice on late alerts; `None` if all were answered in time.
pub(super) fn advice(alerts: &[AlertFact]) -> Option<Text> {
    let (alert, _) = worst(alerts)?;
    let limit = alert.limit.as_secs();
    Some(text!(
        "scoring-advice-alerts",
        alert = &alert.text,
        limit = limit
    ))
}

/// The late alert with the greatest loss, and the number of late ones; `None` if all were answered
/// in time.
fn worst(alerts: &[AlertFact]) -> Option<(&AlertFact, usize)> {
    let late = || alerts.iter().filter(|alert| !alert.is_in_time());
    let cost = |alert: &&AlertFact| alert.level.weight() * (1.0 - alert.value());
    let worst = late().max_by(|a, b| cost(a).total_cmp(&cost(b)))?;
    Some((worst, late().count()))
}

fn answer_words(alert: &AlertFact) -> Text {
    let (what, limit) = (&alert.text, alert.limit.as_secs());
    match alert.answered_after {
        None => text!("scoring-alert-unanswered", alert = what),
        Some(after) => text!(
            "scoring-alert-took",
            alert = what,
            seconds = format!("{:.0}", after.as_secs_f64()),
            limit = limit
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn alert(level: AlertLevel, answered_after_s: Option<u64>) -> AlertFact {
        AlertFact {
            text: Text::default(),
            level,
            at: Duration::ZERO,
            limit: level.usual_limit(),
            answered_after: answered_after_s.map(Duration::from_secs),
        }
    }

    #[test]
    fn an_answer_loses_half_its_worth_with_each_further_limit() {
        for (after_s, expected) in [
            (Some(5), 1.0),
            (Some(10), 1.0),
            (Some(20), 0.5),
            (Some(30), 0.25),
            (None, 0.0),
        ] {
            let value = alert(AlertLevel::Critical, after_s).value();
            assert!((value - expected).abs() < 1e-9, "{after_s:?}: {value}");
        }
    }

    #[test]
    fn critical_alerts_weigh_four_times_as_much_as_cautions() {
        let alerts = [
            alert(AlertLevel::Critical, None),
            alert(AlertLevel::Caution, Some(1)),
        ];
        let value = attention_value(&alerts).expect("there are alerts");
        assert!((value - 0.2).abs() < 1e-9, "{value}");
        assert_eq!(attention_value(&[]), None);
    }
}
