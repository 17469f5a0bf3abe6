//! The leg of its plan that a vehicle flies: the distance and time to the next place, and the time to the end of the
//! plan.

use std::time::Duration;

use super::route::Route;
use super::{Mode, PlanPhase, Vehicle};
use crate::geo::LatLon;
use crate::geo::maths;

/// The time constant with which the mean speed follows a slower speed, so that slowing down at a
/// corner has little effect.
const SLOWER_TIME_S: f32 = 10.0;
/// The speed, in m/s, below which the vehicle counts as staying in place.
const STAYING_M_S: f32 = 1.0;

/// The speed over ground of a vehicle between the corners and stops of its plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LegSpeed {
    /// The mean speed over ground, in m/s.
    pub speed_m_s: f32,
    at: Duration,
}

impl LegSpeed {
    /// The mean speed after another measurement; measurements at a standstill leave it unchanged.
    /// `None` until the vehicle has moved.
    pub fn after(before: Option<Self>, speed_m_s: f32, now: Duration) -> Option<Self> {
        if speed_m_s < STAYING_M_S {
            return before.map(|before| Self { at: now, ..before });
        }
        let speed_m_s = before.map_or(speed_m_s, |before| {
            let passed_s = now.saturating_sub(before.at).as_secs_f32();
            let weight = 1.0 - maths::exp_f32(-passed_s / SLOWER_TIME_S);
            let slower_m_s = before.speed_m_s + weight * (speed_m_s - before.speed_m_s);
            slower_m_s.max(speed_m_s)
        });
        Some(Self { speed_m_s, at: now })
    }
}

/// The progress of a vehicle that flies its plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanLeg {
    /// The number of the current item.
    pub item: u16,
    /// The number of the last item.
    pub last: u16,
    /// The place that the vehicle flies to.
    pub to: Option<LatLon>,
    /// The horizontal distance to that place, in metres.
    pub left_m: Option<f64>,
    /// The time until the next item begins, by the vehicle's clock, including the stay at the
    /// current place.
    pub next: Option<Duration>,
    /// The time until the end of the plan, by the vehicle's clock.
    pub end: Option<Duration>,
}

impl Vehicle {
    /// Whether the vehicle flies its plan.
    pub fn flies_plan(&self) -> bool {
        self.armed() && self.mode().is_some_and(Mode::flies_plan)
    }

    /// Notes the time of arrival at the place where the vehicle stays for the current item of its
    /// plan, if it is there.
    pub fn note_arrival(&mut self, at: Duration) {
        let plan = self.plans.plan.content.as_ref();
        let is_there = plan.and_then(|plan| Route::of(self, plan).is_there(self.plan.current));
        if self.plan.arrived.is_none() && is_there == Some(true) {
            self.plan.arrived = Some(at);
        }
    }

    /// The current leg; `None` unless the vehicle flies a plan that has been read. Times are
    /// estimates from its speed on the way, the speeds in the plan, and the default climb and
    /// descent of `ArduCopter`; in a pause they are unknown.
    pub fn plan_leg(&self) -> Option<PlanLeg> {
        let plan = self.plans.plan.content.as_ref()?;
        let progress = self.plan;
        let last = u16::try_from(plan.items.len().checked_sub(1)?).ok()?;
        let is_over = progress.phase == Some(PlanPhase::Complete);
        if !self.flies_plan() || is_over || progress.current == 0 || progress.current > last {
            return None;
        }
        let route = Route::of(self, plan);
        let to = route.goal(progress.current);
        let here = self.global.map(|global| global.at_point);
        let moves = !self.has_paused() && !self.link.lost;
        let next = route.current_s(progress.current).filter(|_| moves);
        let end = route.end_s(progress.current).filter(|_| moves);
        let time = |seconds: f64| Duration::try_from_secs_f64(seconds).ok();
        Some(PlanLeg {
            item: progress.current,
            last,
            to,
            left_m: here.zip(to).map(|(here, to)| here.distance_m(to)),
            next: next.and_then(time),
            end: end.and_then(time),
        })
    }
}

#[cfg(test)]
mod tests;
