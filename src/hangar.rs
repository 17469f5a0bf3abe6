//! The hangar: ArduPilot SITL processes on this host, started, watched and ended.
//!
//! A [`Hangar`] owns its processes: they end with it, however it ends. Each instance runs in its
//! own folder and connects to a listener of the hangar on loopback, so that no other program can
//! reach it. A program can [attach](Hangar::attach) to its byte stream.
//!
//! - `launcher` starts a process so that it cannot outlive this one; `folder` manages the
//!   instances' folders, and finds the processes that an earlier hangar has left; `process` queries
//!   the system about processes; `output` keeps what they print.
//! - `launch` is a request to start an instance, `refusal` the reason why a request is refused;
//!   `roster` lists the instances and the free numbers.
//! - `instance` is one instance's task: its process, its connection, its stages, its end. `relay`
//!   carries bytes between it and the attached program. `progress` follows its start: `probe`
//!   queries it, `stages` evaluates the answers. `restarts` decides whether it is started again.
//! - `programs` finds SITL; `source` says which simulator a session uses and where.
//! - Several hangars: `pool` distributes vehicles over them, `client` is a hangar elsewhere, and
//!   `service` the other end of it, over HTTP, with `token` as its secret. `sockets` lists the
//!   sockets of a process.

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
pub use source::{FreeFlight, SitlSource, VehicleBackend};
pub use token::{HangarToken, TokenError};

use roster::Roster;

/// The number of an instance within its hangar.
pub type InstanceId = u16;

/// The maximum number of requests that wait for one instance.
const REQUESTS_KEPT: usize = 16;

/// The state of an instance.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Instance {
    /// The number of the instance.
    pub id: InstanceId,
    /// The kind of vehicle.
    pub kind: SitlKind,
    /// Its MAVLink system id.
    pub system: u8,
    /// The stage of its start.
    pub stage: SitlStage,
    /// The number of parameters received, and the total; 0 while unknown.
    pub parameters: [u16; 2],
    /// The process id, while it runs.
    pub pid: Option<u32>,
    /// The number of restarts.
    pub restarts: u32,
    /// Whether a program is attached to the instance.
    pub attached: bool,
    /// Resident memory in bytes.
    pub memory_bytes: u64,
    /// Processor time in milliseconds since it was started.
    pub cpu_ms: u64,
    /// Why it ended, unless it was stopped on request.
    pub fault: Option<String>,
    /// The missing condition if a stage takes long or, after the instance has ended, the next step.
    #[serde(default)]
    pub hint: Option<String>,
    /// The number of refused connections: from other processes in place of its own, and of a second program to the
    /// vehicle.
    #[serde(default)]
    pub refused: u32,
    /// The last lines that it printed, oldest first; set when it has ended without a request.
    pub last_output: Vec<String>,
    /// Its folder on the host.
    pub folder: String,
    /// The TCP port on loopback that exposes its MAVLink to all programs of the host, if a service has opened one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub port: Option<u16>,
}

/// Limits for the instances of a hangar, to protect its host.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[schema(as = Limits)]
pub struct HangarLimits {
    /// The maximum number of instances at once.
    pub instances: u16,
    /// The limit on the address space of one instance, in MiB.
    pub memory_mib: u64,
    /// The maximum number of starts per second.
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

/// The settings of a hangar.
#[derive(Debug, Clone)]
pub struct HangarSetup {
    /// The program of each kind of vehicle that can be started.
    pub programs: BTreeMap<SitlKind, PathBuf>,
    /// The folder for the instances' folders.
    pub folder: PathBuf,
    pub limits: HangarLimits,
    /// Whether instances that end without a request are restarted.
    pub restart: Restart,
    /// The `sortie` program, which starts the instances.
    pub sortie: PathBuf,
}

/// The load of a hangar.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Capacity {
    /// Instances that have not ended.
    pub running: u16,
    /// Instances that can still be started.
    pub free: u16,
}

enum InstanceRequest {
    Stop(oneshot::Sender<()>),
    Restart,
    Attach(oneshot::Sender<Option<DuplexStream>>),
}

/// The public state of the instances, by number.
pub type Instances = Arc<BTreeMap<InstanceId, Instance>>;

/// The state shared by the hangar's handle and its instances' tasks.
struct HangarShared {
    config: HangarSetup,
    launcher: launcher::Launcher,
    run: folder::Run,
    roster: Roster,
    cancel: CancellationToken,
}

/// Supervises the instances. Dropping it ends them all.
pub struct Hangar {
    shared: Arc<HangarShared>,
    leftovers: watch::Receiver<Option<Vec<Leftover>>>,
}

impl Drop for Hangar {
    fn drop(&mut self) {
        self.shared.cancel.cancel();
    }
}

impl Hangar {
    /// Opens an empty hangar, and starts to end the processes that dead hangars have left in the same folder. Must be
    /// called inside a tokio runtime.
    ///
    /// # Errors
    /// Its folder cannot be created or used.
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
        let shared = HangarShared {
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

    /// The processes that dead hangars had left in the same folder. Returns after the attempt to
    /// end them.
    pub async fn leftovers(&self) -> Vec<Leftover> {
        let mut leftovers = self.leftovers.clone();
        let ended = leftovers.wait_for(Option::is_some).await;
        ended
            .ok()
            .and_then(|ended| ended.clone())
            .unwrap_or_default()
    }

    /// Starts an instance in a folder without files of an earlier instance with its number;
    /// [`Self::instances`] shows its stages.
    ///
    /// # Errors
    /// It cannot be started.
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
    /// No instance has that number.
    pub async fn stop(&self, id: InstanceId) -> Result<(), HangarRefusal> {
        let (done, over) = oneshot::channel();
        match self.ask(id, InstanceRequest::Stop(done)).await {
            // If the task is gone, it has ended its process.
            Ok(()) => drop(over.await),
            Err(HangarRefusal::Closing) => {}
            Err(other) => return Err(other),
        }
        Ok(())
    }

    /// Ends an instance's process, if there is one, and starts it again in the same folder with its
    /// last parameters. An attached program stays attached. For a new instance, stop it and launch
    /// another.
    ///
    /// # Errors
    /// No instance has that number, or it has ended and the hangar is full.
    pub async fn restart(&self, id: InstanceId) -> Result<(), HangarRefusal> {
        self.shared.roster.revive(id)?;
        self.ask(id, InstanceRequest::Restart).await
    }

    /// The bytes of an instance's serial 0. The stream continues when the instance is restarted.
    ///
    /// # Errors
    /// No instance has that number, or a program is attached to it.
    pub async fn attach(&self, id: InstanceId) -> Result<DuplexStream, HangarRefusal> {
        let (answer, pipe) = oneshot::channel();
        self.ask(id, InstanceRequest::Attach(answer)).await?;
        pipe.await
            .map_err(|_| HangarRefusal::Closing)?
            .ok_or(HangarRefusal::Attached(id))
    }

    /// An instance's output, starting with the line of this number if it is still stored; with 0, all of it.
    ///
    /// # Errors
    /// No instance has that number.
    pub fn output(&self, id: InstanceId, since: u64) -> Result<Vec<OutputLine>, HangarRefusal> {
        Ok(self.prints(id)?.since(since))
    }

    /// A handle that follows an instance's output.
    ///
    /// # Errors
    /// No instance has that number.
    pub fn prints(&self, id: InstanceId) -> Result<ProcessOutput, HangarRefusal> {
        self.shared
            .roster
            .output(id)
            .ok_or(HangarRefusal::Unknown(id))
    }

    /// A receiver of the instances and their changes.
    pub fn instances(&self) -> watch::Receiver<Instances> {
        self.shared.roster.watch()
    }

    /// The folder of the instances' folders: a new one below the root given to
    /// [`open`](Self::open).
    pub fn folder(&self) -> &Path {
        self.shared.run.path()
    }

    pub fn capacity(&self) -> Capacity {
        self.shared.roster.capacity()
    }

    /// Ends all instances and waits until their processes are gone; nothing can be launched afterwards.
    pub async fn close(&self) {
        self.shared.cancel.cancel();
        let all_gone = |all: &Instances| all.is_empty();
        // The roster lives as long as the hangar.
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
