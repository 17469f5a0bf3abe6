//! Opens Unix sockets.

use std::fs::{self, DirBuilder, Permissions};
use std::io;
use std::os::unix::fs::{DirBuilderExt as _, FileTypeExt as _, PermissionsExt as _};
use std::path::Path;

use tokio::net::UnixListener;

/// Why a socket cannot be opened.
#[derive(Debug)]
pub enum SocketFault {
    /// The path leads to something else than a socket.
    NoSocket,
    /// A program answers on it.
    InUse,
    /// The system refuses it.
    Io(io::Error),
}

/// Two errors of the system are the same if they are of the same kind.
impl PartialEq for SocketFault {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Io(one), Self::Io(other)) => one.kind() == other.kind(),
            (Self::NoSocket, Self::NoSocket) | (Self::InUse, Self::InUse) => true,
            _ => false,
        }
    }
}

impl From<io::Error> for SocketFault {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

/// Opens a socket with these permissions. One on which no program answers any more is replaced.
///
/// # Errors
/// The path is taken by another program or another file, or the socket cannot be created there.
pub fn open(path: &Path, mode: u32) -> Result<UnixListener, SocketFault> {
    clear(path)?;
    Ok(bind(path, mode)?)
}

/// Removes a socket on which no program answers any more.
fn clear(path: &Path) -> Result<(), SocketFault> {
    let Ok(found) = fs::symlink_metadata(path) else {
        return Ok(());
    };
    if !found.file_type().is_socket() {
        return Err(SocketFault::NoSocket);
    }
    if std::os::unix::net::UnixStream::connect(path).is_ok() {
        return Err(SocketFault::InUse);
    }
    Ok(fs::remove_file(path)?)
}

/// Binds within a folder of the owner and moves the socket into place, so that no program can connect
/// before its permissions are set.
fn bind(path: &Path, mode: u32) -> io::Result<UnixListener> {
    let parent = path.parent().filter(|it| !it.as_os_str().is_empty());
    let name = format!(".sortie-{}", std::process::id());
    let folder = parent.unwrap_or(Path::new(".")).join(name);
    DirBuilder::new().mode(0o700).create(&folder)?;
    let listener = bind_within(&folder, path, mode);
    // The folder is of no further use; one that remains does no harm.
    drop(fs::remove_dir_all(&folder));
    listener
}

fn bind_within(folder: &Path, path: &Path, mode: u32) -> io::Result<UnixListener> {
    let first = folder.join("s");
    let listener = UnixListener::bind(&first)?;
    fs::set_permissions(&first, Permissions::from_mode(mode))?;
    fs::rename(&first, path)?;
    Ok(listener)
}
