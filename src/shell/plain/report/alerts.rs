//! Alerts as lines.

use std::collections::BTreeSet;

use super::{clock, severity_word};
use crate::alert::AlertKind;
use crate::app::State;
use crate::app::state::Alert;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};
use crate::vehicle_id::ranges;

/// The standing alerts that have been printed.
#[derive(Debug, Default)]
pub(super) struct PrintedAlerts(BTreeSet<PrintedAlert>);

/// A printed alert. It is printed again when it becomes more serious, and when it returns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct PrintedAlert {
    vehicle: VehicleId,
    kind: AlertKind,
    severity: Severity,
}

impl PrintedAlerts {
    /// The alerts that were raised; vehicles with the same alert are merged.
    pub fn news(&mut self, state: &State) -> Vec<Text> {
        let session = state.session();
        let mut standing = BTreeSet::new();
        let mut raised: Vec<(&Alert, Vec<VehicleId>)> = Vec::new();
        for (vehicle, one) in session.alerts().open() {
            let printed = PrintedAlert {
                vehicle,
                kind: one.alert.kind,
                severity: one.alert.severity,
            };
            standing.insert(printed);
            // The notice of such an alert has already been printed.
            if self.0.contains(&printed) || one.alert.kind.needs_notice() {
                continue;
            }
            match raised.iter_mut().find(|(alert, _)| **alert == one.alert) {
                Some((_, vehicles)) => vehicles.push(vehicle),
                None => raised.push((&one.alert, vec![vehicle])),
            }
        }
        self.0 = standing;
        let now = clock(session, state.now());
        let line = |(alert, vehicles): (&Alert, Vec<VehicleId>)| {
            let head = Text::from(format!("{now} {}", ranges(vehicles)));
            let parts = std::iter::once(head).chain(severity_word(alert.severity));
            Text::joined(": ", parts.chain([alert.text.clone()]).collect())
        };
        raised.into_iter().map(line).collect()
    }
}
