//! Pauses in the plan that a vehicle flies.

use super::{LandedState, PlanPhase, Vehicle};

/// The increase over its lowest speed, in m/s, above which a vehicle counts as flying on.
const FLIES_ON_M_S: f32 = 1.5;

/// A pause in a plan. A vehicle that reaches its item while slowing down stops there, but reports
/// the next item as active: a pause lasts until the vehicle is resumed or speeds up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanPause {
    /// The lowest speed since the pause began, in m/s.
    slowest_m_s: f32,
}

/// The effect of a command on the pause of a vehicle that flies its plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PauseChange {
    Begins,
    Ends,
}

impl PlanPause {
    const BEGUN: Self = Self {
        slowest_m_s: f32::INFINITY,
    };

    /// The pause after a report of the phase; `phases` are the phases before and after it, and
    /// `is_news` means that another item or another plan has become current.
    pub(crate) fn reported(
        before: Option<Self>,
        phases: [Option<PlanPhase>; 2],
        is_news: bool,
    ) -> Option<Self> {
        match phases {
            [_, Some(PlanPhase::Paused)] => before.or(Some(Self::BEGUN)),
            [Some(PlanPhase::Paused), Some(PlanPhase::Active)] if !is_news => None,
            [_, Some(PlanPhase::Active) | None] => before,
            [
                _,
                Some(PlanPhase::NoPlan | PlanPhase::NotStarted | PlanPhase::Complete),
            ] => None,
        }
    }

    fn at_speed(self, speed_m_s: f32) -> Option<Self> {
        let slowest_m_s = self.slowest_m_s.min(speed_m_s);
        (speed_m_s <= slowest_m_s + FLIES_ON_M_S).then_some(Self { slowest_m_s })
    }
}

impl Vehicle {
    /// Whether the vehicle has paused in the plan that it flies.
    pub fn has_paused(&self) -> bool {
        let reports_it = self.plan.phase == Some(PlanPhase::Paused);
        self.flies_plan() && (reports_it || self.plan.pause.is_some())
    }

    /// Notes that the vehicle accepted a command that begins or ends a pause.
    pub fn note_pause(&mut self, change: PauseChange) {
        self.plan.pause = match change {
            PauseChange::Begins => self.plan.pause.or(Some(PlanPause::BEGUN)),
            PauseChange::Ends => None,
        };
    }

    /// Ends a pause if the vehicle has left its plan or is flying on; `speed_m_s` is its speed in
    /// m/s.
    pub fn note_speed(&mut self, speed_m_s: f32) {
        let is_on_its_way = self.flies_plan() && self.landed != LandedState::Landing;
        let pause = self.plan.pause.filter(|_| is_on_its_way);
        self.plan.pause = pause.and_then(|pause| pause.at_speed(speed_m_s));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pause_lasts_while_the_vehicle_slows_down_and_stands() {
        let mut pause = Some(PlanPause::BEGUN);
        for speed_m_s in [2.5, 1.0, 0.1, 0.6, 0.0, 1.2] {
            pause = pause.and_then(|it| it.at_speed(speed_m_s));
            assert!(pause.is_some(), "{speed_m_s}");
        }
        assert_eq!(pause.and_then(|it| it.at_speed(1.6)), None);
    }

    #[test]
    fn an_item_reached_while_stopping_does_not_end_a_pause() {
        let paused = Some(PlanPause::BEGUN);
        let (still, goes) = (Some(PlanPhase::Paused), Some(PlanPhase::Active));
        assert_eq!(PlanPause::reported(None, [goes, still], false), paused);
        assert_eq!(PlanPause::reported(paused, [still, goes], true), paused);
        assert_eq!(PlanPause::reported(paused, [goes, goes], true), paused);
        assert_eq!(PlanPause::reported(paused, [still, goes], false), None);
        let over = Some(PlanPhase::Complete);
        assert_eq!(PlanPause::reported(paused, [goes, over], true), None);
    }
}
