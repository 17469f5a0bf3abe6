//! The operator's handling of several vehicles. It is shown, but not scored, unlike utilisation and attention.

use super::DebriefPage;
use super::layout::fit;
use crate::scoring::{Report, UseReport};
use crate::text;

impl DebriefPage<'_> {
    /// Writes the figures, only for flights with several vehicles.
    pub(super) fn swarm(&mut self, report: &Report) {
        let figures = &report.swarm;
        if report.usage.len() < 2 || figures.flown == 0 {
            return;
        }
        self.heading("debrief-swarm");
        let who = report.commanders();
        if let Some(fan_out) = figures.fan_out_waiting {
            let handled = format!("{fan_out:.1}");
            let text = text!(
                "debrief-fan-out",
                handled = handled,
                flown = figures.flown,
                who = who
            );
            self.wrapped("  ", &text);
        }
        let seconds = |time: Option<f64>| time.map_or("-".to_owned(), |time| format!("{time:.0}"));
        let times = text!(
            "debrief-swarm-times",
            neglect = seconds(figures.neglect_s),
            interaction = seconds(figures.interaction_s),
            wait = seconds(Some(figures.wait_s)),
            who = who
        );
        self.wrapped("  ", &times);
        let habits = text!(
            "debrief-swarm-habits",
            switches = format!("{:.1}", figures.switches_per_min),
            group = format!("{:.0}", figures.group_share * 100.0),
            who = who
        );
        self.wrapped("  ", &habits);
        for one in &report.usage {
            let lead = format!("  {}", fit(&one.vehicle.to_string(), 4));
            self.wrapped(&lead, &usage(one));
        }
        self.gap();
    }
}

fn usage(one: &UseReport) -> text::Text {
    if one.airborne_s <= 0.0 {
        return text!("debrief-use-none");
    }
    let percent = (one.productive_s / one.airborne_s * 100.0).min(100.0);
    text!(
        "debrief-use",
        airborne = format!("{:.0}", one.airborne_s),
        percent = format!("{percent:.0}"),
        idle = format!("{:.0}", one.idle_s)
    )
}
