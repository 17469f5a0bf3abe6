//! Faults of the design, and parts that are still locked.

use ratatui::buffer::Buffer;
use ratatui::style::Style;

use crate::app::State;
use crate::app::action::{Action, WorkshopAction};
use crate::app::room::workshop::{Licence, lacking, licence};
use crate::text;
use crate::text::Text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{columns, put_or_count};
use crate::workshop::{DesignFinding, FindingKind, FindingSeverity};

/// Draws a sentence for each finding, faults first.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    if panel.area.height < 2 {
        return;
    }
    let pane = panel.titled(&panel.say("workshop-findings"), buffer);
    let inner = columns(pane, 1, pane.width.saturating_sub(1));
    let bench = state.rooms().workshop().bench();
    let is_missing = |it: &&DesignFinding| it.kind == FindingKind::Missing;
    let found = bench.findings().iter();
    let kind = bench.sheet().kind;
    let missing = found.filter(is_missing);
    let missing: Vec<Text> = missing.map(|it| kind.slot_name(it.slot)).collect();
    let mut texts: Vec<(String, Style)> = Vec::new();
    if !missing.is_empty() {
        let text = text!("bench-missing", slots = Text::joined(", ", missing));
        let fault = format!("x {}", panel.text(&text));
        texts.push((fault, panel.style(Role::Danger)));
    }
    for finding in bench.findings().iter().filter(|it| !is_missing(it)) {
        let (mark, role) = match finding.severity() {
            FindingSeverity::Fault => ('×', Role::Danger),
            FindingSeverity::Warning => ('!', Role::Warning),
        };
        let text = format!("{mark} {}", panel.text(&finding.text));
        texts.push((text, panel.style(role)));
    }
    if texts.is_empty() {
        texts.push((panel.say(kind.none_found()), panel.style(Role::Ok)));
    }
    for part in lacking(state, bench.design()) {
        let text = match licence(state, part) {
            Licence::ForSale(price) => {
                text!(
                    "bench-part-for-sale",
                    part = part.name(),
                    price = price,
                    key = state.key(Action::Workshop(WorkshopAction::BuyPart))
                )
            }
            Licence::Locked(mission) => {
                text!("bench-part-locked", part = part.name(), mission = mission)
            }
            Licence::Held => continue,
        };
        let offer = format!("$ {}", panel.text(&text));
        texts.push((offer, panel.style(Role::Accent)));
    }
    put_or_count(&texts, panel.at(inner), buffer);
}
