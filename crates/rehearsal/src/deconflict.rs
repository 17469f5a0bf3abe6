//! Separates vehicles whose plans bring them too close to each other, by later starts or by layers of height.

use sortie_plan::edit::{HeightChange, change_height, insert};
use sortie_plan::{Document, HeightFrame, Item, command};

use crate::approach::nearness;
use crate::place::{self, Place, TRACK_EVERY, Track, sample_s};
use crate::stage::Stage;
use crate::{Conditions, Outcome, Participant, RehearsalError, rehearse};

/// The step of the delays, and the maximum delay, in seconds.
const DELAY_STEP_S: u32 = 1;
const LONGEST_DELAY_S: u32 = 1800;
/// The margins tried in the search, as multiples of the conflict limits: tracks have gaps between their points, and a
/// vehicle that starts later meets other gusts.
const MARGINS: [f64; 3] = [1.4, 2.0, 3.0];
/// The maximum number of times that layers are rehearsed and extended.
const LAYER_ROUNDS: usize = 6;

/// The change to one vehicle's plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Remedy {
    /// The plan stays as it is.
    Nothing,
    /// The vehicle starts this many seconds later.
    Delay(u32),
    /// The vehicle flies this many metres higher.
    Layer(f32),
}

impl Remedy {
    /// The document with the change: a wait before the takeoff, or greater heights.
    #[must_use]
    pub fn apply(self, document: &Document) -> Document {
        let mut changed = document.clone();
        match self {
            Self::Nothing => {}
            Self::Delay(seconds) => {
                // -1: no time of day.
                let wait = Item {
                    command: command::DELAY,
                    frame: 3,
                    auto_continue: true,
                    params: [seconds as f32, -1.0, -1.0, -1.0],
                    ..Item::default()
                };
                if let Ok(plan) = insert(&document.plan, 0, &[wait]) {
                    changed.plan = plan;
                }
            }
            Self::Layer(metres) => changed.plan = raised(&document.plan, metres),
        }
        changed
    }
}

/// A plan at greater heights: every place that the vehicle flies to, except the landing.
fn raised(items: &[Item], metres: f32) -> Vec<Item> {
    let mut plan = items.to_vec();
    for (at, item) in items.iter().enumerate() {
        let lands = matches!(item.command, command::LAND | command::VTOL_LAND);
        // Zero means the vehicle's current height.
        let is_set = item.z != 0.0 && item.height_frame() != HeightFrame::Other;
        if is_set
            && !lands
            && let Ok(changed) = change_height(&plan, at..at + 1, HeightChange::By(metres))
        {
            plan = changed;
        }
    }
    plan
}

/// Changes that keep all vehicles apart, verified by a rehearsal.
#[derive(Debug, Clone, PartialEq)]
pub struct Proposal {
    /// The change for each vehicle.
    pub remedies: Vec<Remedy>,
    /// The time that the changes cost, in seconds, summed over all vehicles.
    pub lost_s: f64,
    /// The rehearsal with the changes.
    pub outcome: Outcome,
}

/// Finds later starts, or layers `layer_m` apart, that leave no conflict, whichever loses less time; `None` if neither
/// does. Vehicles are placed in their order, each as early or as low as those before it allow; that is not always the
/// least of all possible delays. The participants' own delays are taken as 0.
///
/// # Errors
/// See [`RehearsalError`].
pub fn deconflict(
    participants: &[Participant],
    conditions: &Conditions,
    layer_m: f32,
) -> Result<Option<Proposal>, RehearsalError> {
    let together: Vec<Participant> = participants
        .iter()
        .map(|it| Participant {
            delay_s: 0.0,
            ..it.clone()
        })
        .collect();
    let first = rehearse(&together, conditions)?;
    if first.conflicts().next().is_none() {
        return Ok(Some(Proposal {
            remedies: vec![Remedy::Nothing; together.len()],
            lost_s: 0.0,
            outcome: first,
        }));
    }
    let alone = alone(&together, conditions)?;
    let times: Vec<f64> = alone.iter().map(|(time_s, _)| *time_s).collect();
    let tracks: Vec<Track> = alone.into_iter().map(|(_, track)| track).collect();
    let proposals = [
        by_delays(&together, conditions, &tracks)?,
        by_layers(&together, conditions, &first, layer_m)?,
    ];
    let lost = |proposal: Proposal| {
        let flown = proposal
            .outcome
            .vehicles
            .iter()
            .zip(&times)
            .zip(&proposal.remedies);
        let lost_s = flown.map(|((flown, before_s), remedy)| match remedy {
            Remedy::Delay(seconds) => f64::from(*seconds),
            Remedy::Nothing | Remedy::Layer(_) => flown.time_s - before_s,
        });
        Proposal {
            lost_s: lost_s.sum::<f64>().max(0.0),
            ..proposal
        }
    };
    let found = proposals.into_iter().flatten().map(lost);
    Ok(found.min_by(|a, b| a.lost_s.total_cmp(&b.lost_s)))
}

/// The time and the track of each vehicle flying alone: a collision would end the flights of both.
pub(crate) fn alone(
    participants: &[Participant],
    conditions: &Conditions,
) -> Result<Vec<(f64, Track)>, RehearsalError> {
    let places = place::places(participants, conditions)?;
    let origin = place::origin(&places);
    let fly = |(participant, place): (&Participant, &Place)| {
        let (one, place) = (
            std::slice::from_ref(participant),
            std::slice::from_ref(place),
        );
        let outcome = Stage::new(one, place, origin, conditions)?.run();
        let flown = outcome.vehicles.iter().zip(outcome.tracks);
        Ok(flown
            .map(|(flown, track)| (flown.time_s, track))
            .next()
            .unwrap_or_default())
    };
    participants.iter().zip(&places).map(fly).collect()
}

fn tried(
    participants: &[Participant],
    conditions: &Conditions,
    remedies: Vec<Remedy>,
) -> Result<Proposal, RehearsalError> {
    let changed: Vec<Participant> = participants
        .iter()
        .zip(&remedies)
        .map(|(participant, remedy)| match remedy {
            Remedy::Nothing => participant.clone(),
            Remedy::Delay(seconds) => Participant {
                delay_s: f64::from(*seconds),
                ..participant.clone()
            },
            Remedy::Layer(_) => Participant {
                document: remedy.apply(&participant.document),
                ..participant.clone()
            },
        })
        .collect();
    Ok(Proposal {
        remedies,
        lost_s: 0.0,
        outcome: rehearse(&changed, conditions)?,
    })
}

pub(crate) fn by_delays(
    participants: &[Participant],
    conditions: &Conditions,
    tracks: &[Track],
) -> Result<Option<Proposal>, RehearsalError> {
    for margin in MARGINS {
        let Some(delays) = delays(tracks, margin * margin) else {
            return Ok(None);
        };
        let remedies = delays.into_iter().map(|delay| match delay {
            0 => Remedy::Nothing,
            seconds => Remedy::Delay(seconds),
        });
        let proposal = tried(participants, conditions, remedies.collect())?;
        if proposal.outcome.conflicts().next().is_none() {
            return Ok(Some(proposal));
        }
    }
    Ok(None)
}

/// The shortest delay of each vehicle that keeps it away from those before it.
fn delays(tracks: &[Track], limit: f64) -> Option<Vec<u32>> {
    let per_second = (1.0 / (sample_s() * f64::from(TRACK_EVERY))).round() as usize;
    let mut delays: Vec<u32> = Vec::new();
    for (vehicle, track) in tracks.iter().enumerate() {
        let is_free = |delay: u32| {
            let earlier = tracks[..vehicle].iter().zip(&delays);
            earlier.into_iter().all(|(other, other_delay)| {
                let shift = |seconds: u32| seconds as usize * per_second;
                are_apart((track, shift(delay)), (other, shift(*other_delay)), limit)
            })
        };
        let mut candidates = (0..=LONGEST_DELAY_S).step_by(DELAY_STEP_S as usize);
        delays.push(candidates.find(|delay| is_free(*delay))?);
    }
    Some(delays)
}

/// Whether two vehicles stay apart if they start after these numbers of points.
fn are_apart((a, a_shift): (&Track, usize), (b, b_shift): (&Track, usize), limit: f64) -> bool {
    let end = (a.points.len() + a_shift).max(b.points.len() + b_shift);
    // A vehicle that ends in the air stays there.
    let at = |track: &Track, shift: usize, time: usize| {
        let index = time
            .checked_sub(shift)?
            .min(track.points.len().checked_sub(1)?);
        track.points[index]
    };
    (a_shift.max(b_shift)..end).all(|time| match (at(a, a_shift, time), at(b, b_shift, time)) {
        (Some(a), Some(b)) => nearness(a, b) >= limit,
        (None, _) | (_, None) => true,
    })
}

pub(crate) fn by_layers(
    participants: &[Participant],
    conditions: &Conditions,
    first: &Outcome,
    layer_m: f32,
) -> Result<Option<Proposal>, RehearsalError> {
    let pairs = |outcome: &Outcome| -> Vec<(usize, usize)> {
        outcome
            .conflicts()
            .map(|approach| (approach.a, approach.b))
            .collect()
    };
    let mut near = pairs(first);
    for _ in 0..LAYER_ROUNDS {
        let layers = layers(participants.len(), &near);
        let remedies = layers.into_iter().map(|layer| match layer {
            0 => Remedy::Nothing,
            layer => Remedy::Layer(layer_m * layer as f32),
        });
        let proposal = tried(participants, conditions, remedies.collect())?;
        let left = pairs(&proposal.outcome);
        if left.is_empty() {
            return Ok(Some(proposal));
        }
        if left.iter().all(|pair| near.contains(pair)) {
            // They are in different layers already, and meet while climbing or descending.
            return Ok(None);
        }
        near.extend(left);
    }
    Ok(None)
}

/// The lowest layer for each vehicle that is not used by a nearby vehicle before it.
fn layers(vehicles: usize, near: &[(usize, usize)]) -> Vec<usize> {
    let mut layers: Vec<usize> = Vec::new();
    for vehicle in 0..vehicles {
        let is_near = |other: usize| near.contains(&(other, vehicle));
        let taken: Vec<usize> = (0..vehicle)
            .filter(|it| is_near(*it))
            .map(|it| layers[it])
            .collect();
        let free = (0..=vehicle).find(|layer| !taken.contains(layer));
        layers.push(free.unwrap_or_default());
    }
    layers
}
