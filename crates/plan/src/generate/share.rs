//! Divides a way among the vehicles so that the largest energy is as small as possible.

use glam::DVec2;

use super::compose::effort;
use super::layers::{ASIDE_M, are_apart, set};
use super::tour::Way;
use super::{GenerateError, Idle, Manner, Scene, Work};

/// The bisection steps for the energy limit, and for the end of a vehicle's share.
const LIMIT_STEPS: u32 = 24;
const CUT_STEPS: u32 = 22;
/// The maximum number of times that the shares are cut, each time with the crossing heights of the
/// previous cut.
const ROUNDS: usize = 8;
/// Work shorter than this counts as none, in metres.
const LEAST_WORK_M: f64 = 1.0;

/// Vehicles that spend little of their energy on their work are left out if that raises the largest energy by no more
/// than this factor.
pub(super) const WORTH: f64 = 1.1;
/// The least share of its energy that a vehicle should spend on its work.
const LEAST_SHARE: f64 = 0.25;
/// The number of candidates from which the vehicle to leave out is chosen.
const SPARES: usize = 3;
/// The number of equal stretches into which a way is divided to find the least energy that a
/// vehicle without a share would need: the energy is computed at the end of each.
const STRETCHES: u32 = 8;

/// The shares, and the vehicles without one.
pub(super) struct Shares {
    pub(super) works: Vec<Work>,
    pub(super) idle: Vec<(usize, Idle)>,
}

/// Work divided among a team.
struct TeamShares {
    /// The largest energy of a vehicle, as the time for which it could hover.
    most_s: f64,
    works: Vec<Work>,
}

/// Divides the best of the ways among the vehicles that are worth their transit.
pub(super) fn works(
    scene: &Scene,
    manner: &Manner,
    ways: &[Way],
    spacing_m: f64,
) -> Result<Shares, GenerateError> {
    let all: Vec<usize> = (0..scene.homes.len()).collect();
    let task = Sharing {
        scene,
        manner,
        ways,
        spacing_m,
    };
    let shared = task.among(&all).ok_or(GenerateError::NoWay(0))?;
    let TeamShares { most_s, works } = task.smallest(shared);
    let idle = (0..scene.homes.len()).filter(|it| works.iter().all(|work| work.vehicle != *it));
    let idle = idle.map(|vehicle| (vehicle, task.reason(vehicle, most_s)));
    let idle = idle.collect();
    Ok(Shares { works, idle })
}

/// The vehicles whose work is small compared with their transit: those with the least work.
fn spares(scene: &Scene, works: &[Work]) -> Vec<usize> {
    if works.len() < 2 {
        return Vec::new();
    }
    let spare = |work: &Work| {
        let done = scene.pace.path(&work.points).hover_s;
        let whole = effort(scene, work)?.hover_s;
        (done < LEAST_SHARE * whole).then_some((done, work.vehicle))
    };
    let mut found: Vec<(f64, usize)> = works.iter().filter_map(spare).collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.truncate(SPARES);
    found.into_iter().map(|(_, vehicle)| vehicle).collect()
}

struct Sharing<'a> {
    scene: &'a Scene,
    manner: &'a Manner,
    ways: &'a [Way],
    spacing_m: f64,
}

impl Sharing<'_> {
    /// The shares of these vehicles; `None` if no path leads to the work.
    fn among(&self, team: &[usize]) -> Option<TeamShares> {
        let (scene, manner) = (self.scene, self.manner);
        let first_m = manner.height_m + manner.layer_m;
        let mut layers = vec![first_m; scene.homes.len()];
        let mut best: Option<TeamShares> = None;
        let mut left: Vec<&Way> = self.ways.iter().collect();
        for round in 0..ROUNDS {
            let shared = left.iter().filter_map(|way| {
                let crew = Crew::of(self, way, &layers, team);
                let (most, cuts) = crew.cut()?;
                Some((most, *way, crew.works(&cuts, self.spacing_m)))
            });
            let least = shared.min_by(|a, b| a.0.total_cmp(&b.0));
            let Some((_, way, mut works)) = least else {
                break;
            };
            left = vec![way];
            let is_settled = are_apart(scene, &works, manner.layer_m);
            if !is_settled {
                set(scene, &mut works, manner.layer_m);
            }
            let costs = works.iter().filter_map(|work| effort(scene, work));
            let most_s = costs.map(|effort| effort.hover_s).fold(0.0, f64::max);
            next_layers(&works, manner.layer_m, round > 0, &mut layers);
            if best.as_ref().is_none_or(|best| most_s < best.most_s) {
                best = Some(TeamShares { most_s, works });
            }
            if is_settled {
                break;
            }
        }
        best
    }

    /// The shares of the smallest team that uses hardly more energy than the best one: spare vehicles are left out one
    /// after another.
    fn smallest(&self, shared: TeamShares) -> TeamShares {
        let mut tried = vec![shared];
        while let Some(TeamShares { works, .. }) = tried.last() {
            let without = |spare: usize| {
                let others = works.iter().map(|work| work.vehicle);
                let team: Vec<usize> = others.filter(|vehicle| *vehicle != spare).collect();
                self.among(&team)
            };
            let spares = spares(self.scene, works);
            let next = spares.into_iter().filter_map(without);
            match next.min_by(|a, b| a.most_s.total_cmp(&b.most_s)) {
                Some(fewer) => tried.push(fewer),
                None => break,
            }
        }
        let least = tried
            .iter()
            .map(|shares| shares.most_s)
            .fold(f64::INFINITY, f64::min);
        let worthwhile = |shares: &TeamShares| shares.most_s <= least * WORTH;
        let place = tried.iter().rposition(worthwhile).unwrap_or_default();
        tried.swap_remove(place)
    }

    /// Why a vehicle has no share, if no vehicle uses more energy than `most`.
    fn reason(&self, vehicle: usize, most: f64) -> Idle {
        let lowest_m = self.manner.height_m + self.manner.layer_m;
        let layers = vec![lowest_m; self.scene.homes.len()];
        let least = |way: &Way| {
            let crew = Crew::of(self, way, &layers, &[vehicle]);
            let end_m = way.length_m() - LEAST_WORK_M;
            let places = (0..=STRETCHES).map(|it| end_m * f64::from(it) / f64::from(STRETCHES));
            let costs = places.map(|at_m| crew.cost(vehicle, at_m, at_m + LEAST_WORK_M));
            costs.fold(f64::INFINITY, f64::min)
        };
        let least = self.ways.iter().map(least).fold(f64::INFINITY, f64::min);
        if least.is_infinite() {
            Idle::NoWay
        } else if least < most {
            Idle::Spare
        } else {
            Idle::Far
        }
    }
}

/// Sets the heights for the next cut: those of the last cut or, with `apart`, a separate height for
/// each vehicle.
fn next_layers(works: &[Work], layer_m: f64, apart: bool, layers: &mut [f64]) {
    let mut order: Vec<&Work> = works.iter().collect();
    order.sort_by(|a, b| a.layer_m.total_cmp(&b.layer_m));
    let lowest_m = order.first().map_or(0.0, |work| work.layer_m);
    for (rank, work) in order.into_iter().enumerate() {
        layers[work.vehicle] = if apart {
            lowest_m + layer_m * rank as f64
        } else {
            work.layer_m
        };
    }
}

/// The vehicles in the order of their shares.
struct Crew<'a> {
    scene: &'a Scene,
    manner: &'a Manner,
    way: &'a Way,
    /// The heights at which the vehicles cross.
    layers: &'a [f64],
    order: Vec<usize>,
}

impl<'a> Crew<'a> {
    fn of(task: &'a Sharing<'a>, way: &'a Way, layers: &'a [f64], team: &[usize]) -> Self {
        let (scene, manner) = (task.scene, task.manner);
        let direction = way.direction();
        let mut order: Vec<usize> = team.to_vec();
        let key = |vehicle: &usize| scene.homes[*vehicle].dot(direction);
        order.sort_by(|a, b| key(a).total_cmp(&key(b)));
        Self {
            scene,
            manner,
            way,
            layers,
            order,
        }
    }

    fn work(&self, vehicle: usize, points: Vec<DVec2>) -> Work {
        Work {
            vehicle,
            points,
            height_m: self.manner.height_m,
            layer_m: self.layers[vehicle],
            circle: None,
        }
    }

    /// The energy that a vehicle uses for a share; infinite if no path leads there.
    fn cost(&self, vehicle: usize, from_m: f64, to_m: f64) -> f64 {
        let work = self.work(vehicle, self.way.part(from_m, to_m));
        effort(self.scene, &work).map_or(f64::INFINITY, |effort| effort.hover_s)
    }

    /// The lowest energy limit with which all work is done, and the ends of the shares.
    fn cut(&self) -> Option<(f64, Vec<f64>)> {
        let length_m = self.way.length_m();
        let alone = self.order.iter().map(|it| self.cost(*it, 0.0, length_m));
        let mut high = alone.fold(f64::INFINITY, f64::min);
        if !high.is_finite() {
            return None;
        }
        high *= 2.0;
        let mut low = 0.0;
        let mut cuts = self.cuts(high)?;
        for _ in 0..LIMIT_STEPS {
            let middle = f64::midpoint(low, high);
            match self.cuts(middle) {
                Some(found) => (high, cuts) = (middle, found),
                None => low = middle,
            }
        }
        Some((high, cuts))
    }

    /// The ends of the shares if no vehicle takes more than `most`; `None` if some work is left.
    fn cuts(&self, most: f64) -> Option<Vec<f64>> {
        let length_m = self.way.length_m();
        let mut at_m = 0.0;
        let mut cuts = Vec::new();
        for &vehicle in &self.order {
            at_m = self.reach(vehicle, at_m, most);
            cuts.push(at_m);
        }
        (at_m >= length_m - 1e-6).then_some(cuts)
    }

    /// How far along the path a vehicle gets from `from_m` with at most the energy `most`.
    fn reach(&self, vehicle: usize, from_m: f64, most: f64) -> f64 {
        let end_m = self.way.length_m();
        let least_m = (from_m + LEAST_WORK_M).min(end_m);
        if from_m >= end_m || self.cost(vehicle, from_m, least_m) > most {
            return from_m;
        }
        if self.cost(vehicle, from_m, end_m) <= most {
            return end_m;
        }
        let (mut low, mut high) = (least_m, end_m);
        for _ in 0..CUT_STEPS {
            let middle = f64::midpoint(low, high);
            if self.cost(vehicle, from_m, middle) <= most {
                low = middle;
            } else {
                high = middle;
            }
        }
        self.way.snapped(low).max(from_m)
    }

    /// The shares; close ones are flown alternately at two heights.
    fn works(&self, cuts: &[f64], spacing_m: f64) -> Vec<Work> {
        let mut from_m = 0.0;
        let mut works: Vec<Work> = Vec::new();
        for (&vehicle, &to_m) in self.order.iter().zip(cuts) {
            let points = self.way.part(from_m, to_m);
            from_m = to_m;
            if points.is_empty() {
                continue;
            }
            let mut work = self.work(vehicle, points);
            if spacing_m < ASIDE_M && works.len() % 2 == 1 {
                work.height_m += self.manner.layer_m;
            }
            works.push(work);
        }
        works
    }
}
