//! Separates vehicles whose plans bring them too close to each other, by later starts or by separate heights (layers).

use std::collections::BTreeMap;

use sortie_plan::edit::{HeightChange, change_height, insert};
use sortie_plan::{Document, HeightFrame, Item, command};

use crate::approach::{Separation, between};
use crate::late::{LATE_S, Shifted, are_apart, points_in};
use crate::order::best_order;
use crate::place::{self, Place, Track};
use crate::stage::Stage;
use crate::{Conditions, Outcome, Participant, RehearsalError, rehearse};

/// The step of the delays, and the maximum delay, in seconds.
const DELAY_STEP_S: u32 = 1;
const LONGEST_DELAY_S: u32 = 1800;
/// The margins tried in the search, as multiples of the conflict limits: tracks have gaps between
/// their points, and a vehicle that starts later meets different gusts.
const MARGINS: [f64; 3] = [1.4, 2.0, 3.0];
/// The time from arming to the takeoff of a plan without a wait, in seconds: a wait of that length
/// changes nothing.
const LIFTS_AFTER_ARMING_S: u32 = 2;
/// The maximum number of times that layers are rehearsed and then extended.
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
                // -1 means no time of day.
                let wait_s = (seconds + LIFTS_AFTER_ARMING_S) as f32;
                let wait = Item {
                    command: command::DELAY,
                    frame: 3,
                    auto_continue: true,
                    params: [wait_s, -1.0, -1.0, -1.0],
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
    /// All pairs stay apart even if one vehicle is this many seconds late: [`LATE_S`], or 0 if that
    /// margin cannot be achieved.
    pub late_s: u32,
    /// The rehearsal with the changes.
    pub outcome: Outcome,
}

/// Finds later starts, or layers `layer_m` apart, that leave no conflict even if a vehicle is
/// [`LATE_S`] late; of the two, the one that loses less time. If that margin cannot be achieved,
/// the proposal has none; if there is always a conflict, returns `None`. Vehicles are placed one
/// after the other, each as early or as low as those before it allow. The order is the one that
/// loses the least time in total: for a few vehicles all orders are tried, for more only some. The
/// participants' own delays are taken as 0.
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
    if first.is_apart(LATE_S) {
        return Ok(Some(unchanged(first, LATE_S)));
    }
    let alone = alone(&together, conditions)?;
    let times: Vec<f64> = alone.iter().map(|(time_s, _)| *time_s).collect();
    let tracks: Vec<Track> = alone.into_iter().map(|(_, track)| track).collect();
    for late_s in [LATE_S, 0] {
        let search = Search {
            participants: &together,
            conditions,
            late_s,
        };
        let proposals = [
            search.by_delays(&tracks)?,
            search.by_layers(&first, layer_m)?,
        ];
        let found = proposals.into_iter().flatten().map(|it| it.costed(&times));
        let best = found.min_by(|a, b| a.lost_s.total_cmp(&b.lost_s));
        if best.is_some() {
            return Ok(best);
        }
        if late_s == LATE_S && first.is_apart(0) {
            return Ok(Some(unchanged(first, 0)));
        }
    }
    Ok(None)
}

fn unchanged(outcome: Outcome, late_s: u32) -> Proposal {
    Proposal {
        remedies: vec![Remedy::Nothing; outcome.vehicles.len()],
        lost_s: 0.0,
        late_s,
        outcome,
    }
}

impl Proposal {
    /// Sets the time that the changes cost, compared with `times_s`, the times of the vehicles flying alone.
    fn costed(self, times_s: &[f64]) -> Self {
        let vehicles = self.outcome.vehicles.iter();
        let flown = vehicles.zip(times_s).zip(&self.remedies);
        let lost_s = flown.map(|((flown, before_s), remedy)| match remedy {
            Remedy::Delay(seconds) => f64::from(*seconds),
            Remedy::Nothing | Remedy::Layer(_) => flown.time_s - before_s,
        });
        Self {
            lost_s: lost_s.sum::<f64>().max(0.0),
            ..self
        }
    }
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

/// A search for changes.
pub(crate) struct Search<'a> {
    pub(crate) participants: &'a [Participant],
    pub(crate) conditions: &'a Conditions,
    /// How late a vehicle may be, in seconds.
    pub(crate) late_s: u32,
}

impl Search<'_> {
    fn tried(&self, remedies: Vec<Remedy>) -> Result<Proposal, RehearsalError> {
        // The plans as they would be written, so that the result also holds for the files.
        let pairs = self.participants.iter().zip(&remedies);
        let changed = pairs.map(|(participant, remedy)| Participant {
            document: remedy.apply(&participant.document),
            ..participant.clone()
        });
        let changed: Vec<Participant> = changed.collect();
        Ok(Proposal {
            remedies,
            lost_s: 0.0,
            late_s: self.late_s,
            outcome: rehearse(&changed, self.conditions)?,
        })
    }

    /// Separates the vehicles by later starts.
    pub(crate) fn by_delays(&self, tracks: &[Track]) -> Result<Option<Proposal>, RehearsalError> {
        for margin in MARGINS {
            let Some(delays) = delays(tracks, margin * margin, self.late_s) else {
                return Ok(None);
            };
            let remedies = delays.into_iter().map(|delay| match delay {
                0 => Remedy::Nothing,
                seconds => Remedy::Delay(seconds),
            });
            let proposal = self.tried(remedies.collect())?;
            if proposal.outcome.is_apart(self.late_s) {
                return Ok(Some(proposal));
            }
        }
        Ok(None)
    }

    /// Separates the vehicles by different heights.
    pub(crate) fn by_layers(
        &self,
        first: &Outcome,
        layer_m: f32,
    ) -> Result<Option<Proposal>, RehearsalError> {
        let mut near = self.near_pairs(first);
        for _ in 0..LAYER_ROUNDS {
            let layers = layers(self.participants.len(), &near);
            let remedies = layers.into_iter().map(|layer| match layer {
                0 => Remedy::Nothing,
                layer => Remedy::Layer(layer_m * layer as f32),
            });
            let proposal = self.tried(remedies.collect())?;
            let left = self.near_pairs(&proposal.outcome);
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

    /// The pairs that come too close to each other, including those that do so only if one of them is late.
    fn near_pairs(&self, outcome: &Outcome) -> Vec<(usize, usize)> {
        let near = outcome
            .closest
            .iter()
            .filter(|it| !it.is_apart(self.late_s));
        near.map(|it| (it.a, it.b)).collect()
    }
}

/// The delays with the smallest sum that keep the vehicles apart.
fn delays(tracks: &[Track], factor: f64, late_s: u32) -> Option<Vec<u32>> {
    let mut pairs = Pairs::new(tracks, factor, late_s);
    let found = best_order(tracks.len(), |order| {
        let delays = delays_in(order, &mut pairs)?;
        Some((delays.iter().sum(), delays))
    });
    found.map(|(_, delays)| delays)
}

/// The shortest delay of each vehicle that keeps it away from those before it in an order.
fn delays_in(order: &[usize], pairs: &mut Pairs<'_>) -> Option<Vec<u32>> {
    let mut delays = vec![0; order.len()];
    for (place, &vehicle) in order.iter().enumerate() {
        let mut candidates = (0..=LONGEST_DELAY_S).step_by(DELAY_STEP_S as usize);
        delays[vehicle] = candidates.find(|delay| {
            let mut earlier = order[..place].iter();
            earlier.all(|other| {
                let after_s = i64::from(*delay) - i64::from(delays[*other]);
                pairs.are_apart(vehicle, *other, after_s)
            })
        })?;
    }
    Some(delays)
}

/// Whether pairs stay apart at given differences of their delays; each result is computed once.
struct Pairs<'a> {
    tracks: &'a [Track],
    /// The factor on the squares of the limits.
    factor: f64,
    late_s: i64,
    known: BTreeMap<(usize, usize, i64), bool>,
}

impl<'a> Pairs<'a> {
    fn new(tracks: &'a [Track], factor: f64, late_s: u32) -> Self {
        Self {
            tracks,
            factor,
            late_s: i64::from(late_s),
            known: BTreeMap::new(),
        }
    }

    /// Whether `a` stays away from `b` if it starts `after_s` seconds later, even if one of them is late.
    fn are_apart(&mut self, a: usize, b: usize, after_s: i64) -> bool {
        let mut differences = after_s - self.late_s..=after_s + self.late_s;
        differences.all(|difference_s| self.are_apart_at(a, b, difference_s))
    }

    fn are_apart_at(&mut self, a: usize, b: usize, after_s: i64) -> bool {
        let (tracks, factor) = (self.tracks, self.factor);
        *self.known.entry((a, b, after_s)).or_insert_with(|| {
            let shift = points_in(u32::try_from(after_s.unsigned_abs()).unwrap_or(u32::MAX));
            let (a_by, b_by) = if after_s > 0 { (shift, 0) } else { (0, shift) };
            let (a, b) = (&tracks[a], &tracks[b]);
            let (first, second) = (Shifted::new(a, a_by), Shifted::new(b, b_by));
            rule(a, b).is_none_or(|rule| are_apart(first, second, &rule, factor))
        })
    }
}

/// The separation rule for two vehicles, from the places at which they leave the ground; `None` if
/// one never leaves it.
fn rule(a: &Track, b: &Track) -> Option<Separation> {
    let first = |track: &Track| {
        let [north, east, _] = track.points.iter().flatten().next().copied()?;
        Some([north, east])
    };
    Some(between([first(a)?, first(b)?]))
}

/// The layers with the smallest sum that separate the vehicles that come near each other.
fn layers(vehicles: usize, near: &[(usize, usize)]) -> Vec<usize> {
    let found = best_order(vehicles, |order| {
        let layers = layers_in(order, near);
        let sum: usize = layers.iter().sum();
        Some((u32::try_from(sum).unwrap_or(u32::MAX), layers))
    });
    found.map(|(_, layers)| layers).unwrap_or_default()
}

/// For each vehicle, the lowest layer not taken by an earlier vehicle that comes near it.
fn layers_in(order: &[usize], near: &[(usize, usize)]) -> Vec<usize> {
    let mut layers = vec![0; order.len()];
    for (place, &vehicle) in order.iter().enumerate() {
        let is_near =
            |other: usize| near.contains(&(other, vehicle)) || near.contains(&(vehicle, other));
        let earlier = order[..place].iter().filter(|other| is_near(**other));
        let taken: Vec<usize> = earlier.map(|other| layers[*other]).collect();
        let free = (0..=place).find(|layer| !taken.contains(layer));
        layers[vehicle] = free.unwrap_or_default();
    }
    layers
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A track at one place: in the air from the start to the end.
    fn track(places: &[f64]) -> Track {
        let per_second = points_in(1);
        let points = places
            .iter()
            .flat_map(|north| vec![Some([*north, 0.0, 0.0]); per_second])
            .chain([None]);
        Track {
            points: points.collect(),
        }
    }

    /// One vehicle stays at a place for a long time, and two pass it early: delaying the first
    /// costs less than delaying both others.
    #[test]
    fn the_order_with_the_least_delay_is_found() {
        let long = [0.0; 30];
        let short = [0.0, 100.0, 200.0];
        let mut late = vec![300.0; 2];
        late.extend(short);
        let tracks = [track(&long), track(&short), track(&late)];
        let mut pairs = Pairs::new(&tracks, 1.0, 0);
        let greedy = delays_in(&[0, 1, 2], &mut pairs).expect("a way");
        assert!(greedy.iter().sum::<u32>() >= 50, "{greedy:?}");
        let best = delays(&tracks, 1.0, 0).expect("a way");
        assert!(best.iter().sum::<u32>() <= 4, "{best:?}");
        assert!(best[0] > 0, "{best:?}");
    }

    #[test]
    fn one_layer_for_the_vehicle_in_the_middle_is_enough() {
        // Vehicle 0 comes near all others, which are apart: it alone is raised.
        let near = [(0, 1), (0, 2), (0, 3)];
        assert_eq!(layers(4, &near), [1, 0, 0, 0]);
        assert_eq!(layers_in(&[0, 1, 2, 3], &near), [0, 1, 1, 1]);
    }

    #[test]
    fn many_vehicles_are_ordered_by_exchanges() {
        let near: Vec<(usize, usize)> = (1..9).map(|other| (0, other)).collect();
        let raised: usize = layers(9, &near).iter().sum();
        assert_eq!(raised, 1);
    }
}
