//! Which seat needs the instructor most.

use std::cmp::Ordering;
use std::time::Duration;

use super::{FlightReport, Stage};

/// How near a danger has to be, in seconds.
const DANGER_WITHIN_S: f64 = 10.0;
/// The age at which an alert counts as not answered, in seconds.
const ALERT_AFTER_S: f64 = 20.0;
/// The time without a command after which a trainee counts as stuck, in seconds.
const STUCK_AFTER_S: f64 = 60.0;
/// How long a need must have been over before the seat's row moves down.
const HOLD: Duration = Duration::from_secs(3);

/// Why a seat needs the instructor, the most urgent first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Need {
    /// Vehicles are about to collide or to leave the fence.
    Danger,
    /// An alert has not been answered for 20 s.
    Alert,
    /// There was no command for a minute, and an objective is open.
    Stuck,
    /// The seat needs nothing.
    Nothing,
}

impl Need {
    /// The need that a report shows. Only a flight whose time passes needs anything.
    pub fn of(flight: Option<&FlightReport>) -> Self {
        let Some(flight) = flight.filter(|it| it.stage == Stage::Flying) else {
            return Self::Nothing;
        };
        let idle_s = flight
            .last_command
            .as_ref()
            .map_or(flight.clock_s, |it| it.age_s);
        if flight.danger.is_some_and(|it| it.in_s <= DANGER_WITHIN_S) {
            Self::Danger
        } else if flight.oldest_alert_s.is_some_and(|it| it >= ALERT_AFTER_S) {
            Self::Alert
        } else if flight.objectives_open > 0 && idle_s >= STUCK_AFTER_S {
            Self::Stuck
        } else {
            Self::Nothing
        }
    }
}

/// The need by which a seat is placed on the board: it rises at once, and falls only after it has been less for
/// 3 s, so a condition that flickers does not move the row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Attention {
    need: Need,
    since: Duration,
    /// The greatest need since the present one was last seen, and when it was last seen.
    falls_to: Option<(Need, Duration)>,
}

impl Attention {
    /// A seat that needs nothing.
    pub fn new(now: Duration) -> Self {
        Self {
            need: Need::Nothing,
            since: now,
            falls_to: None,
        }
    }

    /// Why the seat needs the instructor.
    pub fn need(&self) -> Need {
        self.need
    }

    /// Since when the seat has needed the instructor for that, by the clock of the desk.
    pub fn since(&self) -> Duration {
        self.since
    }

    /// Takes in the need of a new report.
    pub fn observe(&mut self, seen: Need, now: Duration) {
        match seen.cmp(&self.need) {
            Ordering::Equal => self.falls_to = None,
            Ordering::Less => self.become_known(seen, now),
            Ordering::Greater => {
                let (worst, from) = self.falls_to.unwrap_or((seen, now));
                let worst = worst.min(seen);
                self.falls_to = Some((worst, from));
                if now.saturating_sub(from) >= HOLD {
                    self.become_known(worst, now);
                }
            }
        }
    }

    fn become_known(&mut self, need: Need, now: Duration) {
        *self = Self {
            need,
            since: now,
            falls_to: None,
        };
    }

    /// The place on the board: the greatest need first, and who has had it longest. Seats that need nothing keep
    /// their places.
    pub fn rank(&self) -> (Need, Duration) {
        match self.need {
            Need::Nothing => (Need::Nothing, Duration::ZERO),
            need => (need, self.since),
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::{Danger, DangerKind, LastCommand};

    fn flying() -> FlightReport {
        FlightReport {
            stage: Stage::Flying,
            clock_s: 100.0,
            objectives_open: 1,
            last_command: Some(LastCommand {
                line: "all rtl".into(),
                age_s: 5.0,
            }),
            ..FlightReport::default()
        }
    }

    fn danger(in_s: f64) -> FlightReport {
        let kind = DangerKind::Fence;
        FlightReport {
            danger: Some(Danger { kind, in_s }),
            ..flying()
        }
    }

    fn idle(age_s: f64) -> FlightReport {
        let line = "all rtl".into();
        FlightReport {
            last_command: Some(LastCommand { line, age_s }),
            ..flying()
        }
    }

    #[test]
    fn danger_goes_before_alerts_and_alerts_before_being_stuck() {
        assert_eq!(Need::of(None), Need::Nothing);
        assert_eq!(Need::of(Some(&flying())), Need::Nothing);
        assert_eq!(Need::of(Some(&danger(10.0))), Need::Danger);
        assert_eq!(Need::of(Some(&danger(10.1))), Need::Nothing);
        let alert = |age_s| FlightReport {
            oldest_alert_s: Some(age_s),
            ..idle(70.0)
        };
        assert_eq!(Need::of(Some(&alert(20.0))), Need::Alert);
        assert_eq!(Need::of(Some(&alert(19.9))), Need::Stuck);
        assert_eq!(Need::of(Some(&idle(59.0))), Need::Nothing);
        let met = FlightReport {
            objectives_open: 0,
            ..idle(70.0)
        };
        assert_eq!(Need::of(Some(&met)), Need::Nothing);
    }

    #[test]
    fn a_trainee_who_never_commanded_is_stuck_after_a_minute_of_the_clock() {
        let silent = |clock_s| FlightReport {
            last_command: None,
            clock_s,
            ..flying()
        };
        assert_eq!(Need::of(Some(&silent(59.0))), Need::Nothing);
        assert_eq!(Need::of(Some(&silent(60.0))), Need::Stuck);
    }

    #[test]
    fn nobody_needs_help_while_time_stands() {
        for stage in [
            Stage::Reading,
            Stage::Held,
            Stage::Paused,
            Stage::Frozen,
            Stage::Over,
        ] {
            let flight = FlightReport {
                stage,
                ..danger(0.0)
            };
            assert_eq!(Need::of(Some(&flight)), Need::Nothing, "{stage:?}");
        }
    }

    fn needs() -> impl Strategy<Value = Vec<(u64, Need)>> {
        let need =
            prop::sample::select(vec![Need::Danger, Need::Alert, Need::Stuck, Need::Nothing]);
        prop::collection::vec((0_u64..2000, need), 1..60)
    }

    proptest! {
        #[test]
        fn a_need_is_shown_at_once_and_for_at_least_three_seconds(steps in needs()) {
            let mut now = Duration::ZERO;
            let mut attention = Attention::new(now);
            let mut last_at_least = now;
            for (wait_ms, seen) in steps {
                now += Duration::from_millis(wait_ms);
                let before = attention;
                attention.observe(seen, now);
                prop_assert!(attention.need() <= seen, "shown at once");
                if attention.need() > before.need() {
                    prop_assert!(now.saturating_sub(last_at_least) >= HOLD, "held");
                }
                if seen <= attention.need() {
                    last_at_least = now;
                }
                if attention.need() == before.need() {
                    prop_assert_eq!(attention.since(), before.since());
                }
            }
        }
    }
}
