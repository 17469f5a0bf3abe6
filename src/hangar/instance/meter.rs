//! Memory and processor time of an instance.

use std::time::Duration;

use crate::hangar::process::{self, ProcessUsage};

/// The time between readings.
const EVERY: Duration = Duration::from_secs(1);

/// Measures a process about once a second.
pub(super) struct InstanceMeter {
    pid: u32,
    last: Option<(Duration, ProcessUsage)>,
    /// The number of cores in use between the last two readings.
    cores: f64,
}

impl InstanceMeter {
    pub fn new(pid: u32) -> Self {
        Self {
            pid,
            last: None,
            cores: 0.0,
        }
    }

    /// Takes a reading if one is due; returns whether it did.
    pub fn read(&mut self, now: Duration) -> bool {
        if self.last.is_some_and(|(at, _)| now < at + EVERY) {
            return false;
        }
        let nothing = ProcessUsage {
            memory_bytes: 0,
            cpu: Duration::ZERO,
        };
        let usage = process::usage(self.pid).unwrap_or(nothing);
        if let Some((at, before)) = self.last {
            let used = usage.cpu.saturating_sub(before.cpu);
            self.cores = used.as_secs_f64() / now.saturating_sub(at).as_secs_f64();
        }
        self.last = Some((now, usage));
        true
    }

    pub fn memory_bytes(&self) -> u64 {
        self.last.map_or(0, |(_, usage)| usage.memory_bytes)
    }

    /// The processor time since the process was started, in milliseconds.
    pub fn cpu_ms(&self) -> u64 {
        self.last
            .map_or(0, |(_, usage)| usage.cpu.as_millis() as u64)
    }

    /// The resource usage as text, to distinguish a waiting process from a busy one and from a stopped one.
    pub fn told(&self) -> String {
        if process::is_stopped(self.pid) {
            return "; it is stopped (SIGSTOP)".to_owned();
        }
        format!(", using {:.0} % of a core", 100.0 * self.cores)
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use std::process::Command;

    use nix::sys::signal::{Signal, kill};
    use nix::sys::wait::{WaitPidFlag, waitpid};
    use nix::unistd::Pid;

    use super::*;

    #[test]
    fn a_stopped_process_is_said_to_be_stopped() {
        let mut sleeper = Command::new("sleep").arg("60").spawn().expect("started");
        let pid = Pid::from_raw(sleeper.id().cast_signed());
        let meter = InstanceMeter::new(sleeper.id());
        assert!(!meter.told().contains("SIGSTOP"));
        kill(pid, Signal::SIGSTOP).expect("stopped");
        waitpid(pid, Some(WaitPidFlag::WUNTRACED)).expect("it has stopped");
        assert!(meter.told().contains("SIGSTOP"), "{}", meter.told());
        sleeper.kill().expect("ended");
        sleeper.wait().expect("ended");
    }
}
