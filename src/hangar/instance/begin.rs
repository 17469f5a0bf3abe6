//! Prepares an instance before its process is started: a folder, a listener, its files.

use std::collections::BTreeSet;
use std::io;
use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use tokio::net::TcpListener;
use tokio::sync::mpsc;
use tokio::time::Instant as Moment;

use super::InstanceTask;
use crate::hangar::launcher::LaunchOrder;
use crate::hangar::output::ProcessOutput;
use crate::hangar::relay::Relay;
use crate::hangar::restarts::Restarts;
use crate::hangar::roster::Taken;
use crate::hangar::{HangarRefusal, HangarShared, Instance, InstanceRequest, Launch, SitlStage};
use crate::sitl::{Recipe, SerialEndpoint};

/// The speed-up until an instance is ready: a boot in real time takes 42 s.
const BOOT_SPEEDUP: f64 = 10.0;
/// SITL's parameter file in its folder.
const MEMORY: &str = "eeprom.bin";

/// Starts an instance and its task.
///
/// # Errors
/// Its folder or its listener cannot be made.
pub(in crate::hangar) async fn begin(
    launch: Launch,
    taken: Taken,
    program: PathBuf,
    requests: mpsc::Receiver<InstanceRequest>,
    shared: Arc<HangarShared>,
) -> Result<(), HangarRefusal> {
    let id = taken.id;
    let refuse = |what: String| move |source: io::Error| HangarRefusal::Host { id, what, source };
    let folder = shared
        .run
        .vehicle(id)
        .map_err(|error| HangarRefusal::Host {
            id,
            what: "its folder".to_owned(),
            source: io::Error::other(error),
        })?;
    let listen = || refuse("listen on 127.0.0.1".to_owned());
    let listener = TcpListener::bind(("127.0.0.1", 0))
        .await
        .map_err(listen())?;
    let address = listener.local_addr().map_err(listen())?;
    let arguments = write_files(&launch, taken, address, &folder)?;
    let output = ProcessOutput::new(folder.clone());
    shared.roster.keep_output(id, output.clone());
    let shown = Instance::new(&launch, taken, &folder);
    shared.roster.show(&shown);
    let task = InstanceTask {
        shown,
        order: LaunchOrder {
            program,
            arguments,
            folder,
        },
        speedup: launch.speedup,
        idle: launch.idle_s.map(|s| Duration::from_secs(s.into())),
        unattended_since: Moment::now(),
        restarts: Restarts::new(shared.config.restart),
        relay: Relay::default(),
        listener,
        output,
        earlier_stacks: BTreeSet::new(),
        requests,
        shared,
    };
    tokio::spawn(task.run());
    Ok(())
}

/// Writes the program's files, and returns its arguments.
fn write_files(
    launch: &Launch,
    taken: Taken,
    address: SocketAddr,
    folder: &Path,
) -> Result<Vec<String>, HangarRefusal> {
    let id = taken.id;
    let refuse = |what: String| move |source: io::Error| HangarRefusal::Host { id, what, source };
    let recipe = launch.recipe(taken.system);
    let boot = Recipe {
        speedup: recipe.speedup.max(BOOT_SPEEDUP),
        ..recipe
    };
    let command = boot
        .command_line(SerialEndpoint::Outwards(address))
        .map_err(|unfit| HangarRefusal::Invalid(unfit.to_string()))?;
    forget_earlier(folder).map_err(refuse(format!("remove {MEMORY} in {}", folder.display())))?;
    for (name, text) in &command.files {
        let path = folder.join(name);
        std::fs::write(&path, text).map_err(refuse(format!("write {}", path.display())))?;
    }
    Ok(command.arguments)
}

/// Removes files of an earlier instance with this number, which a new one would read.
fn forget_earlier(folder: &Path) -> io::Result<()> {
    match std::fs::remove_file(folder.join(MEMORY)) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

impl Instance {
    fn new(launch: &Launch, taken: Taken, folder: &Path) -> Self {
        Self {
            id: taken.id,
            kind: launch.kind,
            system: taken.system,
            stage: SitlStage::Queued,
            parameters: [0, 0],
            pid: None,
            restarts: 0,
            attached: false,
            memory_bytes: 0,
            cpu_ms: 0,
            fault: None,
            hint: None,
            refused: 0,
            last_output: Vec::new(),
            folder: folder.display().to_string(),
            port: None,
        }
    }
}
