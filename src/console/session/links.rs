//! What is shown and said of a session's links.

use std::sync::Arc;
use std::time::Duration;

use tokio::sync::watch;

use crate::app::state::LinkSummary;
use crate::link::{LinkId, LinkState, LinkStatus};
use crate::notice::Notice;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, Vehicle};

/// What is worth saying of a link.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum LinkNews {
    /// Nothing yet.
    Silent,
    /// It carries data.
    Up,
    /// It does not, for this reason.
    Down(Text),
    /// Closed for good, as a recording that has been played to its end.
    Ended,
}

impl LinkNews {
    pub fn of(status: &LinkStatus) -> Self {
        match (status.state, &status.last_error) {
            (LinkState::Up, _) => Self::Up,
            (_, Some(error)) => Self::Down(error.clone()),
            (LinkState::Ended, None) => Self::Ended,
            _ => Self::Silent,
        }
    }

    pub fn notice(&self, name: &str, now: Duration) -> Notice {
        let (severity, text) = match self {
            Self::Silent | Self::Up => (Severity::Info, text!("transport-is-up", link = name)),
            Self::Ended => (Severity::Notice, text!("transport-has-ended", link = name)),
            Self::Down(reason) => {
                let text = text!("transport-is-down", link = name, reason = reason);
                (Severity::Error, text)
            }
        };
        Notice {
            at: now,
            vehicle: None,
            severity,
            text,
        }
    }
}

/// The shortest round trip of the vehicles that are heard by a link.
pub(super) fn round_trip(
    vehicles: &[watch::Receiver<Arc<Vehicle>>],
    link: LinkId,
) -> Option<Duration> {
    let quality = |vehicle: &watch::Receiver<Arc<Vehicle>>| vehicle.borrow().link;
    vehicles
        .iter()
        .map(quality)
        .filter(|quality| quality.via == Some(link.0))
        .filter_map(|quality| quality.round_trip)
        .min()
}

pub(super) fn summary(status: &LinkStatus, round_trip: Option<Duration>) -> LinkSummary {
    let up = status.state == LinkState::Up;
    LinkSummary {
        name: status.name.clone(),
        state: status.state.text(),
        up,
        error: status.last_error.clone().filter(|_| !up),
        peers: status.peers,
        bytes_in_per_s: f64::from(status.rates.bytes_in_s),
        bytes_out_per_s: f64::from(status.rates.bytes_out_s),
        messages_in_per_s: f64::from(status.rates.messages_in_s),
        messages_out_per_s: f64::from(status.rates.messages_out_s),
        bad_crc: status.decoder.crc_errors,
        skipped_bytes: status.decoder.skipped_bytes,
        unknown: status.decoder.unknown_messages,
        undecoded: status.decoder.undecoded,
        lost: status.lost.clone(),
        unsent: status.dropped_out,
        reconnects: status.reconnects,
        round_trip,
    }
}
