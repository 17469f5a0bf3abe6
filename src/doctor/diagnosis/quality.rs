//! The quality of what a link brings: damaged and missing frames, noise, and messages that the dialect does not have.
//! It is apart because it follows from counts of frames and bytes alone.

use std::collections::{BTreeMap, BTreeSet};

use super::autopilots;
use super::finding::Cause;
use crate::doctor::{Chart, ChartChange, HeartbeatRole, Way};
use crate::wire::SystemId;

/// The share of bytes outside frames that counts as noise, and the minimum number of such bytes in the window.
const MOST_NOISE: f64 = 0.5;
const NOISE_THAT_MATTERS: u64 = 2000;
/// The share of frames with a wrong checksum that counts as a fault; a radio at the limit of its range stays below.
const MOST_DAMAGED: f64 = 0.05;
/// The share of missing frames that counts as a fault.
const MOST_LOST: f64 = 0.10;
/// The minimum number of frames with unknown messages that rules out a coincidence.
pub(super) const FOREIGN_ENOUGH: u64 = 3;
/// The share of frames with unknown messages above which they are reported.
const MOST_FOREIGN: f64 = 0.01;

/// The counts of a link within the window of its chart.
pub(super) struct Quality {
    change: ChartChange,
    /// The share of the vehicles' frames that is missing.
    lost: f64,
    /// Whether a recording is played: what it lacks was not lost on a link.
    is_recording: bool,
}

impl Quality {
    /// The quality over the window of a chart.
    pub fn of(chart: &Chart) -> Self {
        Self {
            change: chart.change(),
            lost: lost_share(chart),
            is_recording: chart.way() == Way::File,
        }
    }

    /// The share of the vehicles' frames that is missing, from 0 to 1.
    pub fn lost_share(&self) -> f64 {
        self.lost
    }

    /// The faults in the received data.
    pub fn causes(&self) -> Vec<Cause> {
        let change = &self.change;
        let percent = |share: f64| (share * 100.0).round().clamp(0.0, 100.0) as u8;
        let damaged = share(change.crc_errors, change.frames + change.crc_errors);
        let foreign = share(change.unknown, change.frames + change.unknown);
        let mut causes = Vec::new();
        if damaged > MOST_DAMAGED {
            causes.push(Cause::Damaged(percent(damaged)));
        } else if self.lost > MOST_LOST && !self.is_recording {
            causes.push(Cause::Lossy(percent(self.lost)));
        }
        let noise = share(change.skipped, change.bytes);
        if noise > MOST_NOISE && change.skipped > NOISE_THAT_MATTERS {
            causes.push(Cause::Noise(percent(noise)));
        }
        if change.unknown >= FOREIGN_ENOUGH && foreign > MOST_FOREIGN {
            causes.push(Cause::ForeignMessages(percent(foreign).max(1)));
        }
        causes
    }
}

/// The share of the vehicles' frames that is missing. Other ground stations are not counted, since
/// vehicles forward only some of their frames.
fn lost_share(chart: &Chart) -> f64 {
    let vehicles: BTreeSet<SystemId> = autopilots(chart)
        .map(|sender| sender.source.system)
        .collect();
    let senders: BTreeMap<_, _> = chart
        .senders()
        .iter()
        .filter(|sender| vehicles.contains(&sender.source.system))
        .filter(|sender| sender.role != HeartbeatRole::GroundStation)
        .map(|sender| (sender.ids(), chart.numbered(sender)))
        .collect();
    let came: u64 = senders.values().map(|frames| frames.came).sum();
    let lost: u64 = senders.values().map(|frames| frames.lost).sum();
    share(lost, came + lost)
}

fn share(part: u64, of: u64) -> f64 {
    part as f64 / of.max(1) as f64
}
