//! The progress of an instance's start, derived from its bytes and the time alone.

use std::time::Duration;

use super::SitlStage;
use super::probe::InstanceProbe;
use super::stages::Stages;

/// The progress of an instance whose process runs.
pub(super) struct StartProgress {
    system: u8,
    speedup: f64,
    stages: Stages,
    /// The probe, until the instance is ready.
    probe: Option<InstanceProbe>,
    parameters: [u16; 2],
    reboots: u32,
    ready_since: Option<Duration>,
}

impl StartProgress {
    /// The progress of a new process. Once it is ready, its speed is set to `speedup`.
    pub fn new(system: u8, speedup: f64, now: Duration) -> Self {
        Self {
            system,
            speedup,
            stages: Stages::new(speedup, now),
            probe: None,
            parameters: [0, 0],
            reboots: 0,
            ready_since: None,
        }
    }

    /// Notes a connection: the instance boots, for the first time or again.
    pub fn connected(&mut self, now: Duration) {
        self.stages.connected(now);
        self.probe = Some(InstanceProbe::new(self.system, self.speedup, now));
        self.forget();
    }

    /// Notes the end of the instance's connection.
    pub fn disconnected(&mut self, now: Duration) {
        self.stages.disconnected(now);
        self.probe = None;
        self.forget();
    }

    /// Handles bytes from the vehicle.
    pub fn hear(&mut self, bytes: &[u8], now: Duration) {
        self.stages.heard(now);
        let Some(probe) = &mut self.probe else {
            return;
        };
        probe.hear(bytes, now);
        let reboots = probe.reboots();
        if reboots > self.reboots {
            self.stages.again(now);
            self.reboots = reboots;
        }
        self.parameters = probe.parameters();
        self.stages.probed(probe.stage(), self.parameters[0], now);
        if self.stages.reached() == SitlStage::Ready {
            self.ready_since.get_or_insert(now);
        }
    }

    /// The bytes to send to the instance now; none once it is ready.
    pub fn say(&mut self, is_attached: bool, now: Duration) -> Vec<u8> {
        let Some(probe) = &mut self.probe else {
            return Vec::new();
        };
        if self.ready_since.is_none() {
            return probe.say(now);
        }
        // An attached program may have requested the same messages.
        let last = (!is_attached).then(|| probe.take_leave());
        self.probe = None;
        last.unwrap_or_default()
    }

    /// Whether the instance must still be queried.
    pub fn is_asking(&self) -> bool {
        self.probe.is_some()
    }

    pub fn stage(&self, now: Duration) -> SitlStage {
        self.stages.stage(now)
    }

    /// The number of parameters received, and the total.
    pub fn parameters(&self) -> [u16; 2] {
        self.parameters
    }

    /// How long the instance has been ready since its last boot.
    pub fn ready_for(&self, now: Duration) -> Duration {
        self.ready_since
            .map_or(Duration::ZERO, |since| now.saturating_sub(since))
    }

    /// The condition that has been missing for too long, as text; `None` if the start makes
    /// progress.
    pub fn lack(&self, now: Duration) -> Option<String> {
        let (lack, waited) = self.stages.lack(now)?;
        let mut told = lack.told(waited);
        if let Some(complaint) = self.probe.as_ref().and_then(InstanceProbe::complaint) {
            told.push_str("; it says: ");
            told.push_str(complaint);
        }
        Some(told)
    }

    fn forget(&mut self) {
        self.parameters = [0, 0];
        self.reboots = 0;
        self.ready_since = None;
    }
}
