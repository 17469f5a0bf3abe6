//! The diagnosis of links from their charts: why no vehicle is heard, or what is wrong although one is.

use std::collections::BTreeSet;
use std::time::Duration;

use super::{Chart, HeartbeatRole, Sender, Way};
use crate::vehicle_id::VehicleId;
use crate::wire::{GROUND_STATION_COMPONENT, GROUND_STATION_SYSTEM, SystemId};

mod answers;
mod finding;
mod missing;
mod quality;
mod shared_ids;
mod signatures;

use answers::{answering, queries_without_doubt};
use missing::missing;
use quality::{FOREIGN_ENOUGH, Quality};
use shared_ids::{SharedIds, boards, cause_of};
use signatures::signing;

pub use finding::{Cause, HeardBoard, LinkFinding, Weight};

/// The time before a first diagnosis: heartbeats come once a second.
const PATIENCE: Duration = Duration::from_secs(4);
/// The maximum number of vehicles without an answer that are listed by number.
const MOST_NAMED: usize = 3;
/// The minimum number of garbage bytes that count as noise; fewer may be the end of a frame that
/// began before the link was opened.
const NOISE_ENOUGH: u64 = 40;

/// The findings of each link, worst first; every link has at least one. `expected` are the vehicles of the swarm; empty
/// if any vehicle is.
pub fn diagnose(charts: &[Chart], expected: &BTreeSet<VehicleId>) -> Vec<LinkFinding> {
    let shared_ids = SharedIds::of(charts);
    let missing = missing(charts, expected);
    let mut findings = Vec::new();
    for (link, chart) in charts.iter().enumerate() {
        let shared = shared_ids.on_link(link);
        let mut causes: Vec<Cause> = shared.map(|system| cause_of(charts, system)).collect();
        causes.extend(examine(chart));
        // A link without any vehicle has a cause of its own.
        if autopilots(chart).next().is_some() && chart.up_for() >= PATIENCE {
            causes.extend(missing.clone());
        }
        if causes.is_empty() {
            causes = fine(chart);
        }
        findings.extend(causes.into_iter().map(|cause| LinkFinding {
            link,
            way: chart.way(),
            boards: boards(charts, &cause),
            cause,
        }));
    }
    findings.sort_by_key(|finding| finding.cause.weight());
    findings
}

/// The findings of a link without a fault.
fn fine(chart: &Chart) -> Vec<Cause> {
    let (answering, silent): (Vec<&Sender>, Vec<&Sender>) =
        autopilots(chart).partition(|sender| sender.answered_ago.is_some());
    let unanswered = (!silent.is_empty()).then_some(Cause::Unanswered(silent.len()));
    let well = (!answering.is_empty()).then_some(Cause::Well(answering.len()));
    unanswered.into_iter().chain(well).collect()
}

/// The faults of one link, examined on its own.
fn examine(chart: &Chart) -> Vec<Cause> {
    let Some(last) = chart.last() else {
        return vec![Cause::Listening];
    };
    if !last.up {
        return vec![Cause::NotOpen];
    }
    let zero = has_system_zero(chart).then_some(Cause::SystemZero);
    if autopilots(chart).next().is_none() {
        return vec![zero.unwrap_or_else(|| silence(chart))];
    }
    let quality = Quality::of(chart);
    let queries = queries_without_doubt(quality.lost_share());
    let mut causes: Vec<Cause> = autopilots(chart)
        .filter_map(|sender| answering(chart, sender, queries))
        .chain(autopilots(chart).flat_map(|sender| signing(chart, sender)))
        .collect();
    let is_one_way = |cause: &Cause| matches!(cause, Cause::OneWay(_));
    let one_way = causes.iter().filter(|cause| is_one_way(cause)).count();
    if one_way > MOST_NAMED {
        causes.retain(|cause| !is_one_way(cause));
        causes.push(Cause::OneWayVehicles(one_way));
    }
    causes.extend(zero);
    causes.extend(quality.causes());
    causes.extend(other_stations(chart));
    causes.extend(
        autopilots(chart)
            .filter(|sender| sender.version1)
            .map(|sender| Cause::Version1(sender.source.system)),
    );
    if chart.way() == Way::File {
        causes.push(Cause::Recording);
    }
    causes
}

/// Why no vehicle is heard.
fn silence(chart: &Chart) -> Cause {
    if chart.up_for() < PATIENCE {
        return Cause::Listening;
    }
    let change = chart.change();
    if change.frames > 0 || !chart.senders().is_empty() {
        return strangers(chart);
    }
    // Noise contains the beginning of a frame here and there, but most of its bytes belong to none.
    let has_frames = change.bytes > 2 * change.skipped;
    if change.bytes == 0 {
        Cause::Nothing
    } else if has_frames && change.crc_errors.max(change.unknown) >= FOREIGN_ENOUGH {
        if change.crc_errors > change.unknown {
            Cause::Damaged(100)
        } else {
            Cause::UnknownDialect
        }
    } else if change.bytes < NOISE_ENOUGH {
        Cause::Listening
    } else if chart.last().is_some_and(|last| is_text(&last.noise)) {
        Cause::Text
    } else if chart.way() == Way::Serial {
        Cause::WrongBaud
    } else {
        Cause::NoFrame
    }
}

/// The diagnosis if senders are heard, but no vehicle.
fn strangers(chart: &Chart) -> Cause {
    let senders = chart.senders();
    let is_us = |sender: &Sender| sender.ids() == (GROUND_STATION_SYSTEM, GROUND_STATION_COMPONENT);
    let others = senders
        .iter()
        .filter(|sender| sender.role == HeartbeatRole::Other);
    if senders.is_empty() || others.count() > 0 {
        return Cause::NoAutopilot;
    }
    let ground_stations = senders
        .iter()
        .filter(|sender| sender.role == HeartbeatRole::GroundStation);
    match ground_stations.clone().count() {
        0 => Cause::NoAutopilot,
        1 if ground_stations.clone().all(is_us)
            && matches!(chart.way(), Way::Serial | Way::Udp) =>
        {
            Cause::OwnEcho
        }
        _ => Cause::OnlyGroundStations,
    }
}

/// Ground stations that are heard in addition to a vehicle and can command it, too; none in a
/// recording. A component of this type within a vehicle's system belongs to the vehicle.
fn other_stations(chart: &Chart) -> impl Iterator<Item = Cause> {
    let vehicles: BTreeSet<SystemId> = autopilots(chart)
        .map(|sender| sender.source.system)
        .collect();
    let senders = chart.senders().iter();
    let stations = senders
        .filter(|_| chart.way() != Way::File)
        .filter(|sender| sender.role == HeartbeatRole::GroundStation)
        .filter(|sender| !vehicles.contains(&sender.source.system));
    let ids: BTreeSet<_> = stations.map(Sender::ids).collect();
    ids.into_iter()
        .map(|(system, component)| Cause::OtherStation(system, component))
}

/// The autopilots that can be addressed.
fn autopilots(chart: &Chart) -> impl Iterator<Item = &Sender> {
    let senders = chart.senders().iter();
    let autopilots = senders.filter(|sender| sender.role == HeartbeatRole::Autopilot);
    autopilots.filter(|sender| sender.source.system != 0)
}

fn has_system_zero(chart: &Chart) -> bool {
    let mut senders = chart.senders().iter();
    senders.any(|it| it.role == HeartbeatRole::Autopilot && it.source.system == 0)
}

/// Whether bytes are readable text, such as that of a shell, a boot loader or a GPS receiver.
fn is_text(bytes: &[u8]) -> bool {
    let readable = |byte: &&u8| matches!(byte, b' '..=b'~' | b'\r' | b'\n' | b'\t');
    !bytes.is_empty() && bytes.iter().filter(readable).count() * 10 >= bytes.len() * 9
}
