//! Processor time of threads, processes and the machine, and memory, as Linux reports them in `/proc`.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use tokio::runtime::{Builder, Runtime};

/// A runtime with known threads, to separate its processor time from the rest of this program.
pub(in crate::cli::bench) struct Counted {
    pub runtime: Runtime,
    /// The folder of each thread below `/proc`.
    threads: Arc<Mutex<Vec<PathBuf>>>,
}

impl Counted {
    /// A runtime with one thread.
    pub fn start(name: &str) -> io::Result<Self> {
        let threads = Arc::new(Mutex::new(Vec::new()));
        let known = Arc::clone(&threads);
        let runtime = Builder::new_multi_thread()
            .worker_threads(1)
            .thread_name(name)
            .on_thread_start(move || {
                if let Ok(own) = fs::read_link("/proc/thread-self") {
                    let mut known = known.lock().unwrap_or_else(PoisonError::into_inner);
                    known.push(Path::new("/proc").join(own));
                }
            })
            .enable_all()
            .build()?;
        // Once a task has run, its thread exists and is known.
        let first = runtime.spawn(async {});
        runtime.block_on(first).map_err(io::Error::other)?;
        Ok(Self { runtime, threads })
    }

    /// Processor time that the threads of this runtime have used so far.
    pub fn spent(&self) -> io::Result<Duration> {
        let threads = self.threads.lock().unwrap_or_else(PoisonError::into_inner);
        if threads.is_empty() {
            return Err(io::Error::other(
                "this system does not report a thread's processor time in /proc/thread-self: only Linux does",
            ));
        }
        threads.iter().map(|thread| on_processor(thread)).sum()
    }
}

/// Processor time of a thread: the first number of its `schedstat`, nanoseconds.
fn on_processor(thread: &Path) -> io::Result<Duration> {
    let text = fs::read_to_string(thread.join("schedstat"))?;
    let nanoseconds = text
        .split(' ')
        .next()
        .and_then(|first| first.parse().ok())
        .ok_or_else(|| io::Error::other("schedstat contains no number"))?;
    Ok(Duration::from_nanos(nanoseconds))
}

/// Processor time of all threads of a process.
pub(in crate::cli::bench) fn of_process(pid: u32) -> io::Result<Duration> {
    let mut total = Duration::ZERO;
    for thread in fs::read_dir(format!("/proc/{pid}/task"))? {
        total += on_processor(&thread?.path())?;
    }
    Ok(total)
}

/// The most memory that a process has used so far, in bytes.
pub(in crate::cli::bench) fn most_memory_of(pid: u32) -> io::Result<u64> {
    let status = fs::read_to_string(format!("/proc/{pid}/status"))?;
    let most = kibibytes(&status, "VmHWM:");
    most.map(|most| most * 1024)
        .ok_or_else(|| io::Error::other("this system does not report the memory of a process"))
}

/// The bytes that have passed the loopback interface of this machine.
pub(in crate::cli::bench) fn loopback_bytes() -> Option<u64> {
    received_bytes(&fs::read_to_string("/proc/net/dev").ok()?, "lo:")
}

fn received_bytes(devices: &str, name: &str) -> Option<u64> {
    let mut lines = devices.lines().map(str::trim_start);
    let line = lines.find_map(|line| line.strip_prefix(name))?;
    line.split_whitespace().next()?.parse().ok()
}

/// The number of processors.
pub(in crate::cli::bench) fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Share of the machine's memory that is still available, in percent.
pub(in crate::cli::bench) fn memory_free_percent() -> Option<f64> {
    let told = fs::read_to_string("/proc/meminfo").ok()?;
    let available = kibibytes(&told, "MemAvailable:")?;
    let all = kibibytes(&told, "MemTotal:")?;
    Some(available as f64 / all as f64 * 100.0)
}

fn kibibytes(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    line.split_whitespace().next()?.parse().ok()
}

/// The busy time of all processors and programs, in ticks.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::cli::bench) struct Machine {
    busy: u64,
    all: u64,
}

impl Machine {
    /// The counters at this moment; `None` without `/proc/stat`.
    pub fn now() -> Option<Self> {
        Self::read(&fs::read_to_string("/proc/stat").ok()?)
    }

    fn read(stat: &str) -> Option<Self> {
        let numbers: Vec<u64> = stat
            .lines()
            .next()?
            .split_whitespace()
            .skip(1)
            .take(8)
            .map(|number| number.parse().unwrap_or(0))
            .collect();
        let all = numbers.iter().sum();
        // The fourth and the fifth number are the idle time and the wait for disks.
        let idle: u64 = numbers.iter().skip(3).take(2).sum();
        Some(Self {
            busy: all - idle,
            all,
        })
    }

    /// The share of all processors that was busy since `before`, in percent.
    pub fn busy_percent_since(self, before: Self) -> f64 {
        let all = self.all.saturating_sub(before.all).max(1);
        self.busy.saturating_sub(before.busy) as f64 / all as f64 * 100.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bytes_of_a_device_are_its_first_number() {
        let devices = " face |bytes    packets errs\n    lo:   53729      39    0\n  eth0: 7 1 0\n";
        assert_eq!(received_bytes(devices, "lo:"), Some(53729));
        assert_eq!(received_bytes(devices, "wlan0:"), None);
    }

    #[test]
    fn what_the_processors_did_is_read_as_linux_tells_it() {
        let before = Machine::read("cpu  100 0 50 800 50 0 0 0 0 0\ncpu0 1 2 3").expect("a line");
        let after = Machine::read("cpu  160 10 80 850 100 0 0 0 0 0\n").expect("a line");
        assert!((after.busy_percent_since(before) - 50.0).abs() < 1e-9);
    }
}
