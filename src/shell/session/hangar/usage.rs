//! A process as the hangar room shows it.

use std::time::Duration;

use crate::app::state::Instance;
use crate::hangar;
use crate::notice::sanitised;

/// The minimum time over which processor use is measured.
const USAGE_OVER: Duration = Duration::from_secs(2);
/// The name of this program's own hangar.
const OWN: &str = "here";

/// A process's use of processor time.
#[derive(Debug, Clone, Copy)]
pub(super) struct ProcessUsage {
    at: Duration,
    cpu_ms: u64,
    percent: Option<f32>,
}

impl ProcessUsage {
    /// The usage of a new process that has used this much processor time.
    pub fn of(cpu_ms: u64, now: Duration) -> Self {
        Self {
            at: now,
            cpu_ms,
            percent: None,
        }
    }

    /// Notes the total processor time so far; returns the usage in percent of one processor, if
    /// known.
    pub fn note(&mut self, cpu_ms: u64, now: Duration) -> Option<f32> {
        let over = now.saturating_sub(self.at);
        if cpu_ms < self.cpu_ms {
            // This is a new process.
            *self = Self::of(cpu_ms, now);
        } else if over >= USAGE_OVER {
            let spent_ms = (cpu_ms - self.cpu_ms) as f32;
            let percent = Some(100.0 * spent_ms / over.as_millis() as f32);
            *self = Self {
                percent,
                ..Self::of(cpu_ms, now)
            };
        }
        self.percent
    }
}

/// The console's view of a process in a hangar.
pub(super) fn shown(
    instance: &hangar::Instance,
    host: &str,
    processor_percent: Option<f32>,
) -> Instance {
    Instance {
        vehicle: instance.system.into(),
        host: (host != OWN).then(|| sanitised(host)),
        stage: instance.stage,
        parameters: instance.parameters,
        pid: instance.pid,
        restarts: instance.restarts,
        memory_bytes: instance.memory_bytes,
        processor_percent,
        fault: instance.fault.as_deref().map(sanitised),
        hint: instance.hint.as_deref().map(sanitised),
        output: instance
            .last_output
            .iter()
            .map(|line| sanitised(line))
            .collect(),
        folder: sanitised(&instance.folder),
    }
}
