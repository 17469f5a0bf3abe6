//! A log on the timeline of a record, as it is stored next to the record.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::{AlignedBy, Alignment, LogCurves, LogDamage, LoggedEvent, LoggedFlight};
use crate::moment::{Moment, MomentKind};
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

const VERSION: u32 = 1;

/// The part of a vehicle's log that is joined to a record: events and curves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JoinedLog {
    v: u32,
    pub vehicle: VehicleId,
    /// The name of the log's file.
    pub file: String,
    pub aligned_by: AlignedBy,
    pub damage: LogDamage,
    events: Vec<JoinedEvent>,
    /// Its readings; their seconds count from the start of the record.
    #[serde(default)]
    pub curves: LogCurves,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct JoinedEvent {
    /// Seconds from the beginning of the record.
    at_s: f64,
    #[serde(flatten)]
    event: LoggedEvent,
}

impl JoinedLog {
    /// Converts a log to the timeline of a record of the given length. Events before or after the
    /// record are left out.
    pub fn new(
        vehicle: VehicleId,
        file: &str,
        flight: &LoggedFlight,
        alignment: &Alignment,
        length: Duration,
    ) -> Self {
        let place = |us| alignment.place(us).filter(|at| *at <= length);
        let events = flight.moments.iter().filter_map(|moment| {
            let at = place(moment.time_us)?;
            Some(JoinedEvent {
                at_s: crate::text::rounded(at.as_secs_f64(), 3),
                event: moment.event.clone(),
            })
        });
        Self {
            v: VERSION,
            vehicle,
            file: file.to_owned(),
            aligned_by: alignment.by,
            damage: flight.damage,
            events: events.collect(),
            curves: flight.curves.placed(place),
        }
    }

    /// Reads the JSON that [`to_json`](Self::to_json) wrote.
    ///
    /// # Errors
    /// A text if it is not such JSON, or comes from a later version.
    pub fn read(text: &str) -> Result<Self, Text> {
        let joined: Self = serde_json::from_str(text)
            .map_err(|error| text!("log-join-unreadable", error = error.to_string()))?;
        if joined.v > VERSION {
            return Err(text!("log-join-later", version = joined.v));
        }
        Ok(joined)
    }

    pub fn to_json(&self) -> String {
        // Numbers and texts can always be written as JSON.
        let mut text = serde_json::to_string(self).unwrap_or_default();
        text.push('\n');
        text
    }

    /// The log's moments, earliest first.
    pub fn moments(&self) -> Vec<Moment> {
        let moment = |it: &JoinedEvent| {
            // The file may have been changed by hand.
            let at = Duration::try_from_secs_f64(it.at_s).ok()?;
            Some(Moment {
                at,
                vehicles: vec![self.vehicle],
                kind: MomentKind::Log,
                by: None,
                text: it.event.text(),
            })
        };
        let mut moments: Vec<Moment> = self.events.iter().filter_map(moment).collect();
        moments.sort_by_key(|it| it.at);
        moments
    }
}

impl AlignedBy {
    /// The alignment in a few words.
    pub fn text(self) -> Text {
        match self {
            Self::GpsTime => text!("log-by-gps-time"),
            Self::BootTime => text!("log-by-boot-time"),
            Self::BootTimeOnly => text!("log-by-boot-time-only"),
            Self::Arming => text!("log-by-arming"),
        }
    }
}
