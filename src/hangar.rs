//! The hangar: ArduPilot SITL processes on this host, started, watched and ended.
//!
//! A [`Hangar`] owns its processes: when it goes, they go, however it goes. Each instance runs in a folder of its
//! own and connects out to a listener of ours on loopback, so that nobody else can reach it; what it says can be
//! [attached](Hangar::attach) to as a byte stream.
//!
//! - `launcher` starts a process so that it cannot outlive this one; `binary` finds the programs.
//! - `instance` is one instance's task: its process, its connection, its stages, its end. `relay` carries bytes between
//!   it and whoever is attached; `probe` asks it how far it is.

use std::collections::BTreeMap;
use std::io;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use serde::{Deserialize, Serialize};
use tokio::io::DuplexStream;
use tokio::sync::{mpsc, oneshot, watch};
use tokio_util::sync::CancellationToken;
use utoipa::ToSchema;

use crate::geo::LatLon;
use crate::sim::Start;
use crate::sitl::{Kind, Recipe};
use crate::text;
use crate::text::Text;

pub mod client;
mod instance;
mod launcher;
mod pool;
mod probe;
pub mod programs;
mod relay;
pub mod service;
mod source;
mod token;

pub use crate::config::Restart;
pub use launcher::{LAUNCH, launch_stub};
pub use pool::{Berth, Hangars, Place, Seen};
pub use source::{Backend, Frame, Source};
pub use token::{Token, TokenError};

/// Names an instance within its hangar.
pub type InstanceId = u16;

/// Requests that may wait for one instance.
const REQUESTS_KEPT: usize = 16;

/// What to start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct Launch {
    /// The instance's number; the lowest free one by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub id: Option<InstanceId>,
    /// The vehicle.
    #[serde(default)]
    pub kind: Kind,
    /// SITL's name of a model; by default what suits the kind and the airframe.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub model: Option<String>,
    /// A frame file of ArduPilot's SITL.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame: Option<serde_json::Value>,
    /// Where it stands.
    #[serde(default)]
    pub home: Home,
    /// The MAVLink system id, 1 to 254; the instance's number by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub system: Option<u8>,
    /// Simulated seconds per second, once it is ready; until then it goes faster if it can.
    #[serde(default = "real_time")]
    pub speedup: f64,
    /// Parameters to start with.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub parameters: BTreeMap<String, f64>,
    /// Ends the instance once nobody has been attached to it for so many seconds; never by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub idle_s: Option<u32>,
}

fn real_time() -> f64 {
    1.0
}

impl Default for Launch {
    fn default() -> Self {
        Self {
            id: None,
            kind: Kind::default(),
            model: None,
            frame: None,
            home: Home::default(),
            system: None,
            speedup: real_time(),
            parameters: BTreeMap::new(),
            idle_s: None,
        }
    }
}

/// Where a vehicle stands when it is switched on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct Home {
    /// Latitude in degrees.
    pub lat_deg: f64,
    /// Longitude in degrees.
    pub lon_deg: f64,
    /// Metres above mean sea level.
    pub altitude_m: f64,
    /// Degrees clockwise from north.
    pub heading_deg: f64,
}

impl Default for Home {
    /// The model airfield near Canberra at which SITL starts by itself.
    fn default() -> Self {
        Self {
            lat_deg: -35.363_262,
            lon_deg: 149.165_237,
            altitude_m: 584.0,
            heading_deg: 0.0,
        }
    }
}

impl From<Home> for Start {
    fn from(home: Home) -> Self {
        Self {
            at: LatLon::new(home.lat_deg, home.lon_deg),
            altitude_amsl_m: home.altitude_m,
            heading_deg: home.heading_deg,
        }
    }
}

impl From<Start> for Home {
    fn from(start: Start) -> Self {
        Self {
            lat_deg: start.at.lat_deg,
            lon_deg: start.at.lon_deg,
            altitude_m: start.altitude_amsl_m,
            heading_deg: start.heading_deg,
        }
    }
}

/// How far an instance has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum Stage {
    /// Others are being started before it.
    Queued,
    /// Its process runs.
    Process,
    /// Its autopilot has been heard.
    Heartbeat,
    /// All its parameters have come.
    Parameters,
    /// Its navigation filter knows where it is.
    Position,
    /// It can be armed.
    Ready,
    /// It is being ended.
    Stopping,
    /// Its process is gone.
    Ended,
}

/// How an instance is doing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Instance {
    /// Its number.
    pub id: InstanceId,
    /// The vehicle.
    pub kind: Kind,
    /// Its MAVLink system id.
    pub system: u8,
    /// How far it has come.
    pub stage: Stage,
    /// How many parameters have come, and how many there are; 0 while that is unknown.
    pub parameters: [u16; 2],
    /// The process, while there is one.
    pub pid: Option<u32>,
    /// How often it was started again.
    pub restarts: u32,
    /// Whether somebody is attached to it.
    pub attached: bool,
    /// Resident memory in bytes.
    pub memory_bytes: u64,
    /// Processor time in milliseconds since it was started.
    pub cpu_ms: u64,
    /// Why it has ended, unless it was asked to.
    pub fault: Option<String>,
    /// The last lines that it printed, oldest first; filled in when it has ended by itself.
    pub last_output: Vec<String>,
    /// Its folder on the host.
    pub folder: String,
    /// The TCP port on loopback that gives its MAVLink to anybody on the host, if a service has opened one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub port: Option<u16>,
}

/// What a hangar may use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Limits {
    /// Instances at once.
    pub instances: u16,
    /// Address space of one instance, in mebibytes.
    pub memory_mib: u64,
    /// Instances that are started per second.
    pub starts_per_s: u16,
}

impl Default for Limits {
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
pub struct Config {
    /// The program of each kind of vehicle that can be started.
    pub programs: BTreeMap<Kind, PathBuf>,
    /// Where the instances' folders are made.
    pub folder: PathBuf,
    /// What may be used.
    pub limits: Limits,
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

/// Why a hangar does not do what it is asked.
#[derive(Debug, thiserror::Error)]
pub enum Refusal {
    /// No instance has that number.
    #[error("there is no instance {0}: the list has those that there are")]
    Unknown(InstanceId),
    /// The number is taken.
    #[error("instance {0} is there already: stop it first, or choose another number")]
    Taken(InstanceId),
    /// There are as many as there may be.
    #[error("{0} instances run, and no more may: stop some, or raise the limit")]
    Full(u16),
    /// No program for this kind of vehicle is known.
    #[error(
        "no {0} was found: name one with --arducopter or SORTIE_ARDUCOPTER, or put it on the PATH"
    )]
    NoProgram(&'static str),
    /// The request makes no sense.
    #[error("{0}")]
    Invalid(String),
    /// Somebody is attached to the instance already.
    #[error("somebody is attached to instance {0} already")]
    Attached(InstanceId),
    /// The host does not allow it.
    #[error("cannot start instance {id}: {what}: {source}")]
    Host {
        /// The instance.
        id: InstanceId,
        /// What was tried.
        what: String,
        /// Why it failed.
        source: io::Error,
    },
    /// The hangar is being closed.
    #[error("the hangar is closing")]
    Closing,
    /// A hangar elsewhere does not do it.
    #[error("hangar {hangar}: {source}")]
    Far {
        /// What it is called.
        hangar: String,
        /// What it says, or why it says nothing.
        source: client::ClientError,
    },
}

impl From<&Refusal> for Text {
    fn from(refusal: &Refusal) -> Self {
        match refusal {
            Refusal::Unknown(id) => text!("hangar-unknown", id = *id),
            Refusal::Taken(id) => text!("hangar-taken", id = *id),
            Refusal::Full(limit) => text!("hangar-full", limit = *limit),
            Refusal::NoProgram(program) => text!("hangar-no-program", program = *program),
            Refusal::Invalid(reason) => Self::verbatim(reason.clone()),
            Refusal::Attached(id) => text!("hangar-attached", id = *id),
            Refusal::Host { id, what, source } => {
                text!(
                    "hangar-host",
                    id = *id,
                    what = what,
                    error = source.to_string()
                )
            }
            Refusal::Closing => text!("hangar-closing"),
            Refusal::Far { hangar, source } => {
                text!("hangar-far", hangar = hangar, error = Text::from(source))
            }
        }
    }
}

/// What is asked of an instance's task.
enum Request {
    Stop(oneshot::Sender<()>),
    Restart,
    Attach(oneshot::Sender<Option<DuplexStream>>),
}

/// The instances by number, as everybody may see them.
pub type Instances = Arc<BTreeMap<InstanceId, Instance>>;

/// What the hangar's handle and its instances' tasks share.
struct Shared {
    config: Config,
    launcher: launcher::Launcher,
    seen: watch::Sender<Instances>,
    tasks: Mutex<BTreeMap<InstanceId, mpsc::Sender<Request>>>,
    cancel: CancellationToken,
}

/// Supervises the instances. Dropping it ends them all.
pub struct Hangar(Arc<Shared>);

impl Drop for Hangar {
    fn drop(&mut self) {
        self.0.cancel.cancel();
    }
}

impl Hangar {
    /// Opens an empty hangar. Must be called inside a tokio runtime.
    ///
    /// # Errors
    /// Its folder cannot be made.
    pub fn open(config: Config) -> io::Result<Self> {
        std::fs::create_dir_all(&config.folder)?;
        Ok(Self(Arc::new(Shared {
            launcher: launcher::Launcher::start(config.sortie.clone(), config.limits)?,
            seen: watch::Sender::default(),
            tasks: Mutex::default(),
            cancel: CancellationToken::new(),
            config,
        })))
    }

    /// Starts an instance; its stages can be followed by [`Self::instances`].
    ///
    /// # Errors
    /// Why it cannot be.
    pub async fn launch(&self, launch: Launch) -> Result<InstanceId, Refusal> {
        let shared = &self.0;
        let program = shared.config.programs.get(&launch.kind).cloned();
        let program = program.ok_or(Refusal::NoProgram(launch.kind.program()))?;
        let (requests, inbox) = mpsc::channel(REQUESTS_KEPT);
        let id = {
            let mut tasks = shared.tasks.lock().unwrap_or_else(PoisonError::into_inner);
            if tasks.len() >= usize::from(shared.config.limits.instances) {
                return Err(Refusal::Full(shared.config.limits.instances));
            }
            let lowest = || {
                (1..=InstanceId::MAX)
                    .find(|id| !tasks.contains_key(id))
                    .unwrap_or_default()
            };
            let id = launch.id.unwrap_or_else(lowest);
            if tasks.contains_key(&id) {
                return Err(Refusal::Taken(id));
            }
            tasks.insert(id, requests);
            id
        };
        let system = launch.system.or_else(|| u8::try_from(id).ok()).unwrap_or(1);
        let recipe = Recipe {
            kind: launch.kind,
            model: launch.model,
            airframe: launch.frame.map(|frame| frame.to_string()),
            start: launch.home.into(),
            system,
            speedup: launch.speedup,
            parameters: launch.parameters,
        };
        let begun = instance::begin(id, recipe, program, inbox, Arc::clone(shared)).await;
        if begun.is_err() {
            shared.forget(id);
        }
        begun.map(|()| id)
    }

    /// Ends an instance and waits until its process is gone.
    ///
    /// # Errors
    /// There is no such instance.
    pub async fn stop(&self, id: InstanceId) -> Result<(), Refusal> {
        let (done, over) = oneshot::channel();
        self.ask(id, Request::Stop(done)).await?;
        // A task that is gone has ended its process.
        drop(over.await);
        Ok(())
    }

    /// Ends an instance's process, if there is one, and starts it again in the same folder.
    ///
    /// # Errors
    /// There is no such instance.
    pub async fn restart(&self, id: InstanceId) -> Result<(), Refusal> {
        self.ask(id, Request::Restart).await
    }

    /// The bytes of an instance's serial 0. They go on when the instance is started again.
    ///
    /// # Errors
    /// There is no such instance, or somebody is attached to it.
    pub async fn attach(&self, id: InstanceId) -> Result<DuplexStream, Refusal> {
        let (answer, pipe) = oneshot::channel();
        self.ask(id, Request::Attach(answer)).await?;
        pipe.await.ok().flatten().ok_or(Refusal::Attached(id))
    }

    /// The instances as they are now and will be.
    pub fn instances(&self) -> watch::Receiver<Instances> {
        self.0.seen.subscribe()
    }

    /// How full it is.
    pub fn capacity(&self) -> Capacity {
        let running = self
            .0
            .tasks
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .len() as u16;
        Capacity {
            running,
            free: self.0.config.limits.instances.saturating_sub(running),
        }
    }

    /// Ends all instances and waits until their processes are gone.
    pub async fn close(self) {
        self.end().await;
    }

    /// Ends all instances, for one who shares the hangar with others, and waits until their processes are gone.
    async fn end(&self) {
        self.0.cancel.cancel();
        self.0
            .seen
            .subscribe()
            .wait_for(|all| all.is_empty())
            .await
            .ok();
    }

    async fn ask(&self, id: InstanceId, request: Request) -> Result<(), Refusal> {
        let task = {
            let tasks = self.0.tasks.lock().unwrap_or_else(PoisonError::into_inner);
            tasks.get(&id).cloned()
        };
        let task = task.ok_or(Refusal::Unknown(id))?;
        task.send(request).await.map_err(|_| Refusal::Closing)
    }
}

impl Shared {
    /// Publishes a change of an instance.
    fn show(&self, instance: &Instance) {
        self.seen.send_if_modified(|all| {
            let changed = all.get(&instance.id) != Some(instance);
            if changed {
                Arc::make_mut(all).insert(instance.id, instance.clone());
            }
            changed
        });
    }

    fn forget(&self, id: InstanceId) {
        self.tasks
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .remove(&id);
        self.seen
            .send_modify(|all| drop(Arc::make_mut(all).remove(&id)));
    }
}
