//! A seat on the board or in a tile: why it needs the instructor, otherwise what it does.

use std::time::Duration;

use super::age;
use crate::class::{Danger, DangerKind, Desk, FlightReport, Need, Presence, SeatRecord, Stage};
use crate::text;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::theme::Role;

/// How long a connected seat may be silent before the board says so.
const SILENT: Duration = Duration::from_secs(3);

/// A seat as it is drawn.
pub(super) struct SeatLineView<'a> {
    pub desk: &'a Desk,
    pub seat: &'a SeatRecord,
    pub now: Duration,
    pub look: &'a Look,
}

impl SeatLineView<'_> {
    pub fn flight(&self) -> Option<&FlightReport> {
        self.seat.report.as_ref()?.flight.as_ref()
    }

    pub fn say(&self, text: &Text) -> String {
        self.look.text(text)
    }

    /// Why the seat needs the instructor, otherwise what it does.
    pub fn state(&self) -> (String, Role) {
        if let Presence::Gone(since) = self.seat.presence {
            let time = age(self.now.saturating_sub(since).as_secs_f64());
            return (self.say(&text!("class-gone", time = time)), Role::Muted);
        }
        let silent = self.now.saturating_sub(self.seat.heard_at);
        if silent >= SILENT {
            let time = age(silent.as_secs_f64());
            return (self.say(&text!("class-silent", time = time)), Role::Warning);
        }
        let Some(flight) = self.flight() else {
            return (self.look.say("class-home"), Role::Muted);
        };
        // The row stays where it is for a moment after its reason is gone.
        let need = Need::of(Some(flight));
        match (need, need_text(need, flight)) {
            (Need::Danger, Some(text)) => (self.say(&text), Role::Alert),
            (Need::Alert, Some(text)) => (self.say(&text), Role::Danger),
            (Need::Stuck, Some(text)) => (self.say(&text), Role::Warning),
            _ => self.stage(flight),
        }
    }

    fn stage(&self, flight: &FlightReport) -> (String, Role) {
        let (id, role) = match flight.stage {
            Stage::Reading => ("class-reading", Role::Muted),
            Stage::Held => ("class-held", Role::Accent),
            Stage::Flying if flight.exam => ("class-exam", Role::Ok),
            Stage::Flying => ("class-flying", Role::Ok),
            Stage::Paused => ("class-paused", Role::Muted),
            Stage::Frozen => ("class-frozen-short", Role::Accent),
            Stage::Over => ("class-over", Role::Muted),
        };
        (self.look.say(id), role)
    }
}

fn need_text(need: Need, flight: &FlightReport) -> Option<Text> {
    let idle_s = flight
        .last_command
        .as_ref()
        .map_or(flight.clock_s, |it| it.age_s);
    Some(match need {
        Need::Danger => {
            let Danger { kind, in_s } = flight.danger?;
            let time = age(in_s);
            match kind {
                DangerKind::Collision if in_s <= 0.0 => text!("class-need-collision-now"),
                DangerKind::Collision => text!("class-need-collision", time = time),
                DangerKind::Fence if in_s <= 0.0 => text!("class-need-fence-now"),
                DangerKind::Fence => text!("class-need-fence", time = time),
            }
        }
        Need::Alert => text!("class-need-alert", time = age(flight.oldest_alert_s?)),
        Need::Stuck => text!("class-need-stuck", time = age(idle_s)),
        Need::Nothing => return None,
    })
}
