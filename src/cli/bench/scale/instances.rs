//! `ArduPilot` SITL processes to measure.

use std::io;
use std::time::Duration;

use futures_util::future::join_all;
use tokio::io::DuplexStream;

use crate::cli::bench::cost::{self, Counted};
use crate::hangar::programs::{self, PATIENCE};
use crate::hangar::{
    Hangar, HangarSetup, Hangars, InstancePlace, Launch, LaunchHome, Restart, SitlStage,
};
use crate::sim::{SYSTEMS, Start};
use crate::sitl::SitlKind;

/// A hangar for a series of measurements. Its processes end with this program; the next hangar cleans up the folder.
pub(super) struct SitlBench {
    hangars: Hangars,
    counted: Counted,
    /// The program's name and version.
    pub name: String,
}

/// The processes of one measurement. Dropping it ends them.
pub(super) struct Instances<'a> {
    bench: &'a SitlBench,
    places: Vec<InstancePlace>,
}

impl SitlBench {
    /// Opens the hangar, once its program has identified itself as an `arducopter`.
    ///
    /// # Errors
    /// The program is not an `arducopter`, or the hangar's folder cannot be used.
    pub fn open(config: HangarSetup) -> anyhow::Result<Self> {
        let counted = Counted::start("hangar")?;
        let config = HangarSetup {
            restart: Restart::Never,
            ..config
        };
        let file = config
            .programs
            .get(&SitlKind::Copter)
            .cloned()
            .unwrap_or_default();
        let (identity, hangars) = counted.runtime.block_on(async {
            let identity = programs::identify(&file, PATIENCE).await?;
            anyhow::Ok((identity, Hangars::own(Hangar::open(config)?)))
        })?;
        if identity.kind != SitlKind::Copter {
            anyhow::bail!(
                "{}: not an arducopter, but an {}",
                file.display(),
                identity.kind.program()
            );
        }
        Ok(Self {
            counted,
            hangars,
            name: format!("ArduCopter {} ({})", identity.version, identity.hash),
        })
    }

    /// Processor time of the hangar, which passes the processes' bytes on.
    pub fn spent(&self) -> io::Result<Duration> {
        self.counted.spent()
    }

    /// Starts a process for each place, and returns the byte streams of their serial 0.
    ///
    /// # Errors
    /// The reason why a process cannot be started.
    pub fn launch(&self, starts: &[Start]) -> anyhow::Result<(Instances<'_>, Vec<DuplexStream>)> {
        let launch = |(index, &start): (usize, &Start)| Launch {
            home: LaunchHome::from(start),
            system: Some((index % SYSTEMS) as u8 + 1),
            ..Launch::default()
        };
        let launches = starts.iter().enumerate().map(launch).collect();
        let launched = self
            .counted
            .runtime
            .block_on(self.hangars.launch(launches))?;
        let (places, pipes) = launched.into_iter().map(|b| (b.place, b.pipe)).unzip();
        Ok((
            Instances {
                bench: self,
                places,
            },
            pipes,
        ))
    }
}

impl Instances<'_> {
    /// The number of processes whose vehicle can be armed.
    ///
    /// # Errors
    /// One of the processes has ended; the error gives the reason.
    pub fn ready(&self) -> anyhow::Result<usize> {
        let channel = self.bench.hangars.instances();
        let seen = channel.borrow();
        let ours = || seen.iter().filter(|(place, _)| self.places.contains(place));
        if let Some((place, instance)) = ours().find(|(_, i)| i.stage == SitlStage::Ended) {
            let fault = instance.fault.as_deref().unwrap_or("it has ended");
            let last = instance
                .last_output
                .last()
                .map(|line| format!("; its last output: {line}"));
            anyhow::bail!("instance {}: {fault}{}", place.id, last.unwrap_or_default());
        }
        Ok(ours().filter(|(_, i)| i.stage == SitlStage::Ready).count())
    }

    /// Processor time of each process so far, all its threads together.
    pub fn spent(&self) -> io::Result<Vec<Duration>> {
        let channel = self.bench.hangars.instances();
        let seen = channel.borrow();
        let ours = seen.iter().filter(|(place, _)| self.places.contains(place));
        ours.filter_map(|(_, i)| i.pid)
            .map(cost::of_process)
            .collect()
    }
}

impl Drop for Instances<'_> {
    fn drop(&mut self) {
        let stops = self
            .places
            .drain(..)
            .map(|place| self.bench.hangars.stop(place));
        // A process that has already ended needs no stop.
        self.bench.counted.runtime.block_on(join_all(stops));
    }
}
