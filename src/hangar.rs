//! The hangar: ArduPilot SITL processes on this host, started, watched and ended.
//!
//! A [`Hangar`] owns its processes: when it goes, they go, however it goes. Each instance runs in a folder of its
//! own and connects out to a listener of ours on loopback, so that nobody else can reach it; what it says can be
//! [attached](Hangar::attach) to as a byte stream.
//!
//! - `launcher` starts a process so that it cannot outlive this one; `folder` is where instances run, and knows what an
//!   earlier hangar has left; `process` asks the system about processes; `output` keeps what they print.
//! - `launch` is what is asked for, `refusal` why it is not done; `roster` says who is there and what is free.
//! - `instance` is one instance's task: its process, its connection, its stages, its end. `relay` carries bytes between
//!   it and whoever is attached. `progress` is how far it has come: `probe` asks it, `stages` judges. `restarts` says
//!   whether it is started again.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use tokio::io::DuplexStream;
use tokio::sync::{mpsc, oneshot, watch};
use tokio_util::sync::CancellationToken;
use utoipa::ToSchema;

use crate::sitl::SitlKind;
pub use crate::sitl::SitlStage;

pub mod client;
mod folder;
mod instance;
mod launch;
mod launcher;
mod output;
mod pool;
mod probe;
mod process;
pub mod programs;
mod progress;
mod refusal;
mod relay;
mod restarts;
mod roster;
pub mod service;
pub mod sockets;
mod source;
mod stages;
mod token;

pub use crate::config::Restart;
pub use folder::{FolderError, Leftover, leftovers};
pub use launch::{Launch, LaunchHome};
pub use launcher::{LAUNCH, launch_stub};
pub use output::{OutputLine, ProcessOutput};
pub use pool::{Hangars, InstancePlace, LaunchedVehicle, Seen};
pub use refusal::HangarRefusal;
pub use source::{SitlSource, VehicleBackend};
pub use token::{HangarToken, TokenError};

use roster::Roster;

/// Names an instance within its hangar.
pub type InstanceId = u16;

/// Requests that may wait for one instance.
const REQUESTS_KEPT: usize = 16;

/// How an instance is doing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Instance {
    /// The number of the instance.
    pub id: InstanceId,
    /// The kind of vehicle.
    pub kind: SitlKind,
    /// Its MAVLink system id.
    pub system: u8,
    /// How far it has come.
    pub stage: SitlStage,
    /// How many parameters have come, and how many there are; 0 while that is unknown.
    pub parameters: [u16; 2],
    /// The process, while there is one.
    pub pid: Option<u32>,
    /// How often it was started again.
    pub restarts: u32,
    /// Whether a program is attached to it.
    pub attached: bool,
    /// Resident memory in bytes.
    pub memory_bytes: u64,
    /// Processor time in milliseconds since it was started.
    pub cpu_ms: u64,
    /// Why it has ended, unless it was asked to.
    pub fault: Option<String>,
    /// What it lacks, when a stage has not come for long, or what happens next when it has ended.
    #[serde(default)]
    pub hint: Option<String>,
    /// Connections of other processes that were refused.
    #[serde(default)]
    pub refused: u32,
    /// The last lines that it printed, oldest first; filled in when it has ended by itself.
    pub last_output: Vec<String>,
    /// Its folder on the host.
    pub folder: String,
    /// The TCP port on loopback that gives its MAVLink to all programs of the host, if a service has opened one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub port: Option<u16>,
}

/// What a hangar may use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[schema(as = Limits)]
pub struct HangarLimits {
    /// The most instances at once.
    pub instances: u16,
    /// Address space of one instance, in mebibytes.
    pub memory_mib: u64,
    /// Instances that are started per second.
    pub starts_per_s: u16,
}

impl Default for HangarLimits {
    fn default() -> Self {
        Self {
            instances: 64,
            memory_mib: 1024,
            starts_per_s: 8,
        }
    }
}

/// How a hangar is set up.
#[derive(Debug, Clone)]
pub struct HangarSetup {
    /// The program of each kind of vehicle that can be started.
    pub programs: BTreeMap<SitlKind, PathBuf>,
    /// Where the instances' folders are made.
    pub folder: PathBuf,
    /// What may be used.
    pub limits: HangarLimits,
    /// What happens to instances that end by themselves.
    pub restart: Restart,
    /// The `sortie` program, which starts the others.
    pub sortie: PathBuf,
}

/// How full a hangar is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Capacity {
    /// Instances that have not ended.
    pub running: u16,
    /// Instances that could be started besides.
    pub free: u16,
}

/// What is asked of an instance's task.
enum InstanceRequest {
    Stop(oneshot::Sender<()>),
    Restart,
    Attach(oneshot::Sender<Option<DuplexStream>>),
}

/// The public state of the instances, by number.
pub type Instances = Arc<BTreeMap<InstanceId, Instance>>;

/// What the hangar's handle and its instances' tasks share.
struct Shared {
    config: HangarSetup,
    launcher: launcher::Launcher,
    run: folder::Run,
    roster: Roster,
    cancel: CancellationToken,
}

/// Supervises the instances. Dropping it ends them all.
pub struct Hangar {
    shared: Arc<Shared>,
    leftovers: watch::Receiver<Option<Vec<Leftover>>>,
}

impl Drop for Hangar {
    fn drop(&mut self) {
        self.shared.cancel.cancel();
    }
}

impl Hangar {
    /// Opens an empty hangar, and begins to end what hangars that are gone have left behind in the same folder. Must
    /// be called inside a tokio runtime.
    ///
    /// # Errors
    /// Its folder cannot be made or used.
    pub fn open(config: HangarSetup) -> io::Result<Self> {
        let opened = folder::Run::open(&config.folder).map_err(io::Error::other)?;
        for skipped in &opened.skipped {
            tracing::warn!("{skipped}");
        }
        let launcher = launcher::Launcher::start(config.sortie.clone(), config.limits)?;
        let (ended, leftovers) = watch::channel(None);
        let mut found = opened.leftovers;
        tokio::spawn(async move {
            folder::end(&mut found).await;
            ended.send_replace(Some(found));
        });
        let shared = Shared {
            launcher,
            run: opened.run,
            roster: Roster::new(config.limits.instances),
            cancel: CancellationToken::new(),
            config,
        };
        Ok(Self {
            shared: Arc::new(shared),
            leftovers,
        })
    }

    /// What hangars that are gone had left behind in the same folder, once all that can be ended is.
    pub async fn leftovers(&self) -> Vec<Leftover> {
        let mut leftovers = self.leftovers.clone();
        let ended = leftovers.wait_for(Option::is_some).await;
        ended
            .ok()
            .and_then(|ended| ended.clone())
            .unwrap_or_default()
    }

    /// Starts an instance, in a folder that remembers nothing of one that had its number before; its stages can be
    /// followed by [`Self::instances`].
    ///
    /// # Errors
    /// Why it cannot be.
    pub async fn launch(&self, launch: Launch) -> Result<InstanceId, HangarRefusal> {
        let shared = &self.shared;
        if shared.cancel.is_cancelled() {
            return Err(HangarRefusal::Closing);
        }
        launch.check()?;
        let program = shared
            .config
            .programs
            .get(&launch.kind)
            .cloned()
            .ok_or(HangarRefusal::NoProgram(launch.kind.program()))?;
        let (requests, inbox) = mpsc::channel(REQUESTS_KEPT);
        let taken = shared.roster.take(&launch, requests)?;
        let id = taken.id;
        let begun = instance::begin(launch, taken, program, inbox, Arc::clone(shared)).await;
        if begun.is_err() {
            shared.roster.forget(id);
        }
        begun.map(|()| id)
    }

    /// Ends an instance and waits until its process is gone.
    ///
    /// # Errors
    /// There is no such instance.
    pub async fn stop(&self, id: InstanceId) -> Result<(), HangarRefusal> {
        let (done, over) = oneshot::channel();
        match self.ask(id, InstanceRequest::Stop(done)).await {
            // A task that is gone has ended its process.
            Ok(()) => drop(over.await),
            Err(HangarRefusal::Closing) => {}
            Err(other) => return Err(other),
        }
        Ok(())
    }

    /// Ends an instance's process, if there is one, and starts it again in the same folder: its parameters are as it
    /// had them last. Whoever is attached stays so. For one that remembers nothing, stop it and launch another.
    ///
    /// # Errors
    /// There is no such instance, or it has ended and others have taken its place.
    pub async fn restart(&self, id: InstanceId) -> Result<(), HangarRefusal> {
        self.shared.roster.revive(id)?;
        self.ask(id, InstanceRequest::Restart).await
    }

    /// The bytes of an instance's serial 0. They go on when the instance is started again.
    ///
    /// # Errors
    /// There is no such instance, or a program is attached to it.
    pub async fn attach(&self, id: InstanceId) -> Result<DuplexStream, HangarRefusal> {
        let (answer, pipe) = oneshot::channel();
        self.ask(id, InstanceRequest::Attach(answer)).await?;
        pipe.await
            .map_err(|_| HangarRefusal::Closing)?
            .ok_or(HangarRefusal::Attached(id))
    }

    /// What an instance has printed, from the line with this number on, as far as it is kept; with 0 all of that.
    ///
    /// # Errors
    /// There is no such instance.
    pub fn output(&self, id: InstanceId, since: u64) -> Result<Vec<OutputLine>, HangarRefusal> {
        Ok(self.prints(id)?.since(since))
    }

    /// What an instance prints, now and from now on.
    ///
    /// # Errors
    /// There is no such instance.
    pub fn prints(&self, id: InstanceId) -> Result<ProcessOutput, HangarRefusal> {
        self.shared
            .roster
            .output(id)
            .ok_or(HangarRefusal::Unknown(id))
    }

    /// The instances as they are now and will be.
    pub fn instances(&self) -> watch::Receiver<Instances> {
        self.shared.roster.watch()
    }

    /// Where its instances' folders are; its own, below the one that it was opened with.
    pub fn folder(&self) -> &Path {
        self.shared.run.path()
    }

    /// How full it is.
    pub fn capacity(&self) -> Capacity {
        self.shared.roster.capacity()
    }

    /// Ends all instances and waits until their processes are gone; nothing can be launched any more.
    pub async fn close(&self) {
        self.shared.cancel.cancel();
        let all_gone = |all: &Instances| all.is_empty();
        // The roster is there as long as the hangar is.
        drop(self.instances().wait_for(all_gone).await);
    }

    async fn ask(&self, id: InstanceId, request: InstanceRequest) -> Result<(), HangarRefusal> {
        let task = self
            .shared
            .roster
            .task(id)
            .ok_or(HangarRefusal::Unknown(id))?;
        task.send(request).await.map_err(|_| HangarRefusal::Closing)
    }
}
