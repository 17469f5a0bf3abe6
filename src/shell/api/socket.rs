//! A Unix socket that only its owner can use.

use std::fs::{self, DirBuilder, Permissions};
use std::io;
use std::os::unix::fs::{DirBuilderExt as _, FileTypeExt as _, PermissionsExt as _};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use tokio::net::{UnixListener, UnixStream};
use tokio::sync::Semaphore;
use tokio::task::JoinHandle;

use super::{Exchange, MOST_PROGRAMS, ProgramId, converse, shown};
use crate::text;

/// Accepts connections until it is dropped; then it removes the socket.
pub struct Listener {
    path: PathBuf,
    task: JoinHandle<()>,
}

impl Listener {
    /// Opens the socket.
    ///
    /// # Errors
    /// The path is taken by another program or another file, or the socket cannot be created there.
    pub fn open(path: &Path, exchange: Exchange) -> anyhow::Result<Self> {
        clear(path)?;
        let listener = bind(path).map_err(|error| {
            fault(&text!(
                "api-not-open",
                socket = shown(path),
                error = error.to_string()
            ))
        })?;
        Ok(Self {
            path: path.to_owned(),
            task: tokio::spawn(accept(listener, exchange)),
        })
    }
}

impl Drop for Listener {
    fn drop(&mut self) {
        self.task.abort();
        // It may have been removed already.
        drop(fs::remove_file(&self.path));
    }
}

/// Removes a socket on which no program answers any more.
fn clear(path: &Path) -> anyhow::Result<()> {
    let Ok(found) = fs::symlink_metadata(path) else {
        return Ok(());
    };
    if !found.file_type().is_socket() {
        return Err(fault(&text!("api-no-socket", socket = shown(path))));
    }
    if std::os::unix::net::UnixStream::connect(path).is_ok() {
        return Err(fault(&text!("api-in-use", socket = shown(path))));
    }
    fs::remove_file(path).map_err(|error| {
        fault(&text!(
            "api-not-open",
            socket = shown(path),
            error = error.to_string()
        ))
    })
}

/// Binds within a folder of the owner and moves the socket into place, so that no program can connect
/// before its permissions are set.
fn bind(path: &Path) -> io::Result<UnixListener> {
    let parent = path.parent().filter(|it| !it.as_os_str().is_empty());
    let name = format!(".sortie-{}", std::process::id());
    let folder = parent.unwrap_or(Path::new(".")).join(name);
    DirBuilder::new().mode(0o700).create(&folder)?;
    let listener = bind_within(&folder, path);
    // The folder is of no further use; one that remains does no harm.
    drop(fs::remove_dir_all(&folder));
    listener
}

fn bind_within(folder: &Path, path: &Path) -> io::Result<UnixListener> {
    let first = folder.join("s");
    let listener = UnixListener::bind(&first)?;
    fs::set_permissions(&first, Permissions::from_mode(0o600))?;
    fs::rename(&first, path)?;
    Ok(listener)
}

async fn accept(listener: UnixListener, exchange: Exchange) {
    let places = Arc::new(Semaphore::new(MOST_PROGRAMS));
    for number in 0.. {
        let Ok((stream, _)) = listener.accept().await else {
            // No file descriptors are left until a connection ends.
            tokio::task::yield_now().await;
            continue;
        };
        // Beyond the maximum number of programs, the connection is closed.
        let Ok(place) = Arc::clone(&places).try_acquire_owned() else {
            continue;
        };
        let exchange = exchange.clone();
        tokio::spawn(async move {
            serve(stream, ProgramId(number), exchange).await;
            drop(place);
        });
    }
}

async fn serve(stream: UnixStream, id: ProgramId, exchange: Exchange) {
    let (read, write) = stream.into_split();
    converse(id, read, write, exchange).await;
}

fn fault(text: &crate::text::Text) -> anyhow::Error {
    anyhow::anyhow!(text.to_string())
}
