//! The stages of an instance's start, derived from observation, and the missing condition if it
//! takes too long.

use std::time::Duration;

use super::SitlStage;

/// The time without a new stage before a remark is shown; an instance is never ended for being slow.
const PATIENCE: Duration = Duration::from_secs(20);
/// The time without readiness before a remark is shown: navigation filters settle in 42 simulated seconds, ten times
/// faster than real time if the machine allows it.
const PATIENCE_FOR_READINESS: Duration = Duration::from_secs(90);
/// The simulated time of silence after which the heartbeat counts as lost; one is sent every second.
const SILENCE: Duration = Duration::from_secs(3);

/// The condition that an instance lacks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Lack {
    /// The instance has not connected.
    Connection,
    /// The instance has closed its connection and not reconnected.
    Reconnection,
    /// The instance is connected, but sends no heartbeat.
    Heartbeat,
    /// The instance is connected, but silent.
    Sound,
    /// The list of parameters does not advance.
    Parameters,
    /// The vehicle has no position.
    Position,
    /// The vehicle cannot be armed.
    Readiness,
}

/// The stages of a running instance: they only advance, until it boots again.
#[derive(Debug)]
pub(super) struct Stages {
    /// How long an instance may be silent, at its chosen speed.
    silence: Duration,
    connected: Option<bool>,
    stage: SitlStage,
    parameters: u16,
    /// The time of the last progress.
    since: Duration,
    heard: Duration,
}

impl Stages {
    /// The stages of a new process, at a speed-up.
    pub fn new(speedup: f64, now: Duration) -> Self {
        Self {
            silence: SILENCE.div_f64(speedup.clamp(0.001, 1.0)),
            connected: None,
            stage: SitlStage::Process,
            parameters: 0,
            since: now,
            heard: now,
        }
    }

    /// Notes a connection, which begins with a boot.
    pub fn connected(&mut self, now: Duration) {
        self.connected = Some(true);
        self.again(now);
    }

    /// Notes a closed connection: a reboot, or a fault.
    pub fn disconnected(&mut self, now: Duration) {
        self.connected = Some(false);
        self.again(now);
    }

    /// Notes a reboot within the connection.
    pub fn again(&mut self, now: Duration) {
        self.stage = SitlStage::Process;
        self.parameters = 0;
        self.since = now;
        self.heard = now;
    }

    /// Records that bytes arrived from the vehicle.
    pub fn heard(&mut self, now: Duration) {
        self.heard = now;
    }

    /// Notes the probe's result.
    pub fn probed(&mut self, stage: SitlStage, parameters: u16, now: Duration) {
        if stage > self.stage || parameters > self.parameters {
            self.since = now;
        }
        self.stage = self.stage.max(stage);
        self.parameters = self.parameters.max(parameters);
    }

    /// The stage reached, even if the instance is silent now.
    pub fn reached(&self) -> SitlStage {
        self.stage
    }

    /// The current stage; an instance without a heartbeat counts only as a running process.
    pub fn stage(&self, now: Duration) -> SitlStage {
        if self.is_silent(now) {
            SitlStage::Process
        } else {
            self.stage
        }
    }

    /// The condition that has been missing for too long, and for how long; `None` if the start
    /// makes progress.
    pub fn lack(&self, now: Duration) -> Option<(Lack, Duration)> {
        if self.is_silent(now) && self.stage > SitlStage::Process {
            return Some((Lack::Sound, now.saturating_sub(self.heard)));
        }
        let waited = now.saturating_sub(self.since);
        let (lack, patience) = match (self.stage, self.connected) {
            (SitlStage::Process, None) => (Lack::Connection, PATIENCE),
            (SitlStage::Process, Some(false)) => (Lack::Reconnection, PATIENCE),
            (SitlStage::Process, Some(true)) => (Lack::Heartbeat, PATIENCE),
            (SitlStage::Heartbeat, _) => (Lack::Parameters, PATIENCE),
            (SitlStage::Parameters, _) => (Lack::Position, PATIENCE_FOR_READINESS),
            (SitlStage::Position, _) => (Lack::Readiness, PATIENCE_FOR_READINESS),
            _ => return None,
        };
        (waited >= patience).then_some((lack, waited))
    }

    fn is_silent(&self, now: Duration) -> bool {
        self.connected == Some(true) && now.saturating_sub(self.heard) >= self.silence
    }
}

impl Lack {
    /// The remark to show after waiting this long.
    pub fn told(self, waited: Duration) -> String {
        let seconds = waited.as_secs();
        match self {
            Self::Connection => format!("runs but has not connected for {seconds} s"),
            Self::Reconnection => {
                format!("has closed its connection and not reconnected for {seconds} s")
            }
            Self::Heartbeat => format!("is connected but has sent no heartbeat for {seconds} s"),
            Self::Sound => format!("has sent nothing for {seconds} s"),
            Self::Parameters => format!("has sent no further parameters for {seconds} s"),
            Self::Position => format!("has had no position for {seconds} s"),
            Self::Readiness => format!("has a position but could not be armed for {seconds} s"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn s(seconds: u64) -> Duration {
        Duration::from_secs(seconds)
    }

    fn ready(speedup: f64) -> Stages {
        let mut stages = Stages::new(speedup, s(0));
        stages.connected(s(1));
        stages.probed(SitlStage::Ready, 10, s(2));
        stages.heard(s(2));
        stages
    }

    #[test]
    fn stages_only_go_on_until_it_boots_again() {
        let mut stages = Stages::new(1.0, s(0));
        stages.connected(s(0));
        for (probed, shown) in [
            (SitlStage::Heartbeat, SitlStage::Heartbeat),
            (SitlStage::Position, SitlStage::Position),
            (SitlStage::Parameters, SitlStage::Position),
            (SitlStage::Ready, SitlStage::Ready),
            (SitlStage::Position, SitlStage::Ready),
        ] {
            stages.probed(probed, 0, s(1));
            assert_eq!(stages.stage(s(1)), shown);
        }
        stages.disconnected(s(2));
        assert_eq!(stages.stage(s(2)), SitlStage::Process);
        stages.connected(s(3));
        stages.probed(SitlStage::Heartbeat, 0, s(4));
        assert_eq!(stages.stage(s(4)), SitlStage::Heartbeat);
    }

    #[test]
    fn a_silent_instance_is_only_a_process_until_it_is_heard_again() {
        let mut stages = ready(1.0);
        assert_eq!(stages.stage(s(4)), SitlStage::Ready);
        assert_eq!(stages.stage(s(5)), SitlStage::Process);
        assert_eq!(stages.lack(s(13)), Some((Lack::Sound, s(11))));
        stages.heard(s(14));
        assert_eq!(
            (stages.stage(s(14)), stages.lack(s(14))),
            (SitlStage::Ready, None)
        );
    }

    #[test]
    fn one_that_is_slow_on_purpose_may_be_silent_for_longer() {
        assert_eq!(ready(0.1).stage(s(31)), SitlStage::Ready);
        assert_eq!(ready(0.1).stage(s(32)), SitlStage::Process);
        assert_eq!(ready(100.0).stage(s(4)), SitlStage::Ready);
    }

    #[test]
    fn what_takes_too_long_is_named() {
        let mut stages = Stages::new(1.0, s(0));
        assert_eq!(stages.lack(s(19)), None);
        assert_eq!(stages.lack(s(20)), Some((Lack::Connection, s(20))));
        stages.connected(s(30));
        assert_eq!(stages.lack(s(49)), None);
        assert_eq!(stages.lack(s(50)), Some((Lack::Heartbeat, s(20))));
        for (stage, at, patience_s, lack) in [
            (SitlStage::Heartbeat, 100, 20, Lack::Parameters),
            (SitlStage::Parameters, 200, 90, Lack::Position),
            (SitlStage::Position, 400, 90, Lack::Readiness),
        ] {
            stages.probed(stage, 0, s(at));
            stages.heard(s(at + patience_s));
            assert_eq!(stages.lack(s(at + patience_s - 1)), None);
            let named = stages.lack(s(at + patience_s));
            assert_eq!(named, Some((lack, s(patience_s))));
        }
        stages.probed(SitlStage::Ready, 0, s(600));
        stages.heard(s(900));
        assert_eq!(stages.lack(s(900)), None);
        stages.disconnected(s(1000));
        assert_eq!(stages.lack(s(1020)), Some((Lack::Reconnection, s(20))));
    }

    #[test]
    fn every_parameter_that_comes_is_progress() {
        let mut stages = Stages::new(1.0, s(0));
        stages.connected(s(0));
        stages.probed(SitlStage::Heartbeat, 1, s(1));
        stages.probed(SitlStage::Heartbeat, 2, s(15));
        stages.heard(s(34));
        assert_eq!(stages.lack(s(34)), None);
        assert_eq!(stages.lack(s(35)), Some((Lack::Parameters, s(20))));
    }
}
