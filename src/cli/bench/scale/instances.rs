//! `ArduPilot` SITL processes to measure, in a hangar of their own.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use tokio::io::DuplexStream;
use tokio::sync::watch;

use super::cost::{self, Counted};
use crate::hangar::{Config, Hangar, Hangars, Home, Launch, Limits, Restart, Seen, Stage};
use crate::sim::{SYSTEMS, Start};
use crate::sitl::Kind;

/// The processes of one measurement.
pub(super) struct Instances {
    counted: Counted,
    hangars: Hangars,
    seen: watch::Receiver<Seen>,
    folder: PathBuf,
}

impl Instances {
    /// Starts one for each place, and returns the bytes of their serial 0.
    ///
    /// # Errors
    /// Why one of them cannot be started.
    pub fn start(program: &Path, starts: &[Start]) -> anyhow::Result<(Self, Vec<DuplexStream>)> {
        let counted = Counted::start("hangar", 1)?;
        let folder = std::env::temp_dir().join(format!("sortie-scale-{}", std::process::id()));
        let config = Config {
            programs: BTreeMap::from([(Kind::Copter, program.to_owned())]),
            folder: folder.clone(),
            limits: Limits {
                instances: u16::MAX,
                ..Limits::default()
            },
            restart: Restart::Never,
            sortie: std::env::current_exe()?,
        };
        let launches = starts.iter().enumerate().map(|(index, &start)| Launch {
            home: Home::from(start),
            system: Some((index % SYSTEMS) as u8 + 1),
            ..Launch::default()
        });
        let launches: Vec<Launch> = launches.collect();
        let started = counted.runtime.block_on(async {
            let hangars = Hangars::own(Hangar::open(config)?);
            let berths = hangars.launch(launches).await?;
            anyhow::Ok((hangars, berths))
        });
        let (hangars, berths) = match started {
            Ok(started) => started,
            Err(error) => {
                remove(&folder);
                return Err(error);
            }
        };
        let pipes = berths.into_iter().map(|berth| berth.pipe).collect();
        let instances = Self {
            seen: hangars.instances(),
            counted,
            hangars,
            folder,
        };
        Ok((instances, pipes))
    }

    /// How many of them can be armed.
    ///
    /// # Errors
    /// What one has ended of.
    pub fn ready(&self) -> anyhow::Result<usize> {
        let seen = self.seen.borrow();
        if let Some((place, instance)) = seen.iter().find(|(_, i)| i.stage == Stage::Ended) {
            let fault = instance.fault.as_deref().unwrap_or("it has ended");
            let last = instance.last_output.last().map(String::as_str);
            let last = last.map_or(String::new(), |line| format!("; it said last: {line}"));
            anyhow::bail!("instance {}: {fault}{last}", place.id);
        }
        let ready = seen.iter().filter(|(_, i)| i.stage == Stage::Ready).count();
        Ok(ready)
    }

    /// The processes that there are now.
    pub fn pids(&self) -> Vec<u32> {
        let seen = self.seen.borrow();
        seen.iter().filter_map(|(_, i)| i.pid).collect()
    }

    /// Processor time of all processes so far, all their threads together.
    pub fn spent(&self) -> io::Result<Duration> {
        self.pids().into_iter().map(cost::of_process).sum()
    }

    /// Processor time of the hangar, which hands their bytes on.
    pub fn relay_spent(&self) -> io::Result<Duration> {
        Ok(self.counted.spent()?.iter().sum())
    }

    /// Ends them and waits until they are gone.
    pub fn end(self) {
        self.counted.runtime.block_on(self.hangars.close());
        remove(&self.folder);
    }
}

/// What is left in the folder for temporary files goes with the system's next start.
fn remove(folder: &Path) {
    drop(std::fs::remove_dir_all(folder));
}
