//! The reasons for the points: objectives, components, improvements.

use unicode_width::UnicodeWidthStr as _;

use super::layout::{fit, right};
use super::{DebriefPage, DebriefTone};
use crate::notice::sanitised;
use crate::scoring::{Component, ComponentReport, ObjectiveReport, Report};
use crate::text;
use crate::text::Text;

impl DebriefPage<'_> {
    pub(super) fn objectives(&mut self, report: &Report) {
        let locale = self.locale;
        let heading = format!(
            "{}{}{}{}",
            fit(&format!(" {}", locale.say("debrief-objectives")), 39),
            fit(&locale.say("debrief-result"), 14),
            fit(&locale.say("debrief-target"), 12),
            locale.say("debrief-points")
        );
        self.line_of(&heading, DebriefTone::Heading);
        for objective in &report.objectives {
            self.objective(objective);
            self.toned(match (objective.met, objective.mandatory) {
                (true, _) => DebriefTone::Good,
                (false, true) => DebriefTone::Bad,
                (false, false) => DebriefTone::Plain,
            });
        }
        self.gap();
    }

    /// Writes an objective as one row, or more if the words do not fit between the columns.
    fn objective(&mut self, objective: &ObjectiveReport) {
        let locale = self.locale;
        let met = if objective.met { 'x' } else { ' ' };
        let points = format!("{:>4.1}/{:.0}", objective.points, objective.points_max);
        let [title, result, target] = [&objective.title, &objective.result, &objective.target]
            .map(|words| sanitised(&locale.text(words)));
        let widths = [
            objective.id.width(),
            title.width(),
            result.width(),
            target.width(),
        ];
        let lead = format!(
            "  [{met}] {}",
            fit(&objective.id, objective.id.width().max(8))
        );
        if widths
            .iter()
            .zip([8, 22, 13, 11])
            .all(|(width, room)| *width <= room)
        {
            let (title, result, target) = (fit(&title, 23), fit(&result, 13), fit(&target, 11));
            self.line(&format!("{lead} {title} {result} {target} {points}"));
        } else {
            self.line(&format!("{} {points}", fit(&format!("{lead} {title}"), 64)));
            let result = text!("debrief-objective-result", result = result, target = target);
            self.wrapped(&" ".repeat(15), &result);
        }
    }

    pub(super) fn components(&mut self, report: &Report) {
        let locale = self.locale;
        let heading = format!(
            "{} {} {} {}   {}",
            fit(&format!(" {}", locale.say("debrief-components")), 14),
            right(&locale.say("debrief-weight"), 6),
            right(&locale.say("debrief-value"), 6),
            right(&locale.say("debrief-points"), 8),
            locale.say("debrief-moved")
        );
        self.line_of(&heading, DebriefTone::Heading);
        for component in &report.components {
            let lead = format!(
                "  {} {:>6.3} {:>6.3} {:>8.1}   ",
                fit(&locale.text(&component.component.title()), 12),
                component.weight,
                component.value,
                component.points
            );
            self.wrapped(&lead, &component.moved_by);
        }
        self.line(&format!("{:28} --------", ""));
        let sum = format!("  {} {:>4}", locale.say("debrief-sum"), report.score);
        self.wrapped(
            &format!("{}{:>8.1}   ", fit(&sum, 29), report.subtotal),
            &beside_sum(report),
        );
        self.words.push('\n');
    }

    pub(super) fn improvements(&mut self, report: &Report) {
        self.heading("debrief-improve");
        if report.improvements.is_empty() {
            self.wrapped("  ", &no_improvement(report));
        }
        for improvement in &report.improvements {
            let gain = format!("+{}", improvement.points);
            self.wrapped(&format!("  {gain:>4}  "), &improvement.text);
        }
        self.toned(DebriefTone::Gain);
        let good = report
            .components
            .iter()
            .filter(|component| component.value >= 0.95 && is_praise(component, report))
            .max_by(|a, b| a.points.total_cmp(&b.points));
        if let Some(good) = good {
            let lead = fit(&format!("  {}", self.locale.say("debrief-good")), 8);
            let words = vec![good.component.title(), good.moved_by.clone()];
            self.wrapped(&lead, &Text::joined(": ", words));
        }
        self.gap();
    }
}

/// Whether a component counts as a success. The objectives do not count if one was missed, even if
/// they earned many points.
fn is_praise(component: &ComponentReport, report: &Report) -> bool {
    component.component != Component::Objective || report.objectives.iter().all(|it| it.met)
}

/// The remarks next to the sum: why the score is not the sum of the components, and what gold still requires.
fn beside_sum(report: &Report) -> Text {
    let mut remarks = Vec::new();
    if report.given_up {
        remarks.push(text!("debrief-given-up"));
    }
    if report.hint_factor < 1.0 {
        let factor = format!("{:.2}", report.hint_factor);
        remarks.push(text!("debrief-times-hints", factor = factor));
    }
    let gates = gold_missing(report);
    remarks.extend(gates.map(|gates| text!("debrief-gold-needs", gates = gates)));
    Text::joined("; ", remarks)
}

fn no_improvement(report: &Report) -> Text {
    match gold_missing(report) {
        _ if !report.passed => text!("debrief-not-flown"),
        Some(gates) => text!("debrief-only-gold", gates = gates),
        None => text!("debrief-nothing"),
    }
}

/// The conditions of gold that the flight does not meet, if any.
pub(super) fn gold_missing(report: &Report) -> Option<Text> {
    let missing = &report.gold_missing;
    (!missing.is_empty()).then(|| Text::joined(", ", missing.clone()))
}
