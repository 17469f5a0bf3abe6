//! The decision whether and when to restart an instance that has ended without a request.

use std::time::Duration;

use super::Restart;

/// The number of failures in a row before the instance is abandoned.
const FAILURES: u32 = 5;
/// Once an instance has been ready for this long, its earlier failures do not count.
const GOOD_FOR: Duration = Duration::from_secs(60);
/// The wait before the first attempt; each further one is twice as long.
const FIRST_WAIT: Duration = Duration::from_secs(1);

/// Counts the failures of one instance.
#[derive(Debug)]
pub(super) struct Restarts {
    policy: Restart,
    failures: u32,
}

impl Restarts {
    pub fn new(policy: Restart) -> Self {
        Self {
            policy,
            failures: 0,
        }
    }

    /// Clears the failures after a requested restart.
    pub fn forgive(&mut self) {
        self.failures = 0;
    }

    /// Counts a failure of an instance that had been ready for `ready_for`. Returns the delay
    /// before a restart, or `None` if the instance is abandoned.
    pub fn failed(&mut self, ready_for: Duration) -> Option<Duration> {
        if ready_for >= GOOD_FOR {
            self.forgive();
        }
        self.failures += 1;
        (self.policy == Restart::Always && self.failures < FAILURES)
            .then(|| FIRST_WAIT * 2u32.pow(self.failures - 1))
    }

    /// Whether the instance has been abandoned.
    pub fn is_given_up(&self) -> bool {
        self.policy == Restart::Always && self.failures >= FAILURES
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn waits(restarts: &mut Restarts, ready_for_s: u64, times: usize) -> Vec<Option<u64>> {
        let ready_for = Duration::from_secs(ready_for_s);
        let wait = |_| restarts.failed(ready_for).map(|wait| wait.as_secs());
        (0..times).map(wait).collect()
    }

    #[test]
    fn it_is_started_later_and_later_and_given_up_after_five_failures() {
        let mut restarts = Restarts::new(Restart::Always);
        let expected = [Some(1), Some(2), Some(4), Some(8), None, None];
        assert_eq!(waits(&mut restarts, 59, 6), expected);
        assert!(restarts.is_given_up());
        restarts.forgive();
        assert_eq!(waits(&mut restarts, 0, 1), [Some(1)]);
    }

    #[test]
    fn a_minute_of_being_ready_makes_up_for_the_failures_before() {
        let mut restarts = Restarts::new(Restart::Always);
        waits(&mut restarts, 0, 4);
        assert_eq!(waits(&mut restarts, 60, 3), [Some(1), Some(1), Some(1)]);
    }

    #[test]
    fn without_the_policy_it_stays_down() {
        let mut restarts = Restarts::new(Restart::Never);
        assert_eq!(waits(&mut restarts, 100, 1), [None]);
        assert!(!restarts.is_given_up());
    }
}
