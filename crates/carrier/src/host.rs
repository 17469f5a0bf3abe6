//! Where a class is on this host, and whose it must be.

use std::fs::{self, DirBuilder, Permissions};
use std::io;
use std::os::unix::fs::{DirBuilderExt as _, MetadataExt as _, PermissionsExt as _};
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};

use nix::unistd::{Uid, User, geteuid};

use super::fault::ClassFault;
use super::socket::SocketFault;

/// The permissions of a class's folder: everybody may reach the socket, and only the instructor changes the folder.
const FOLDER_MODE: u32 = 0o711;
/// The name of the socket in the folder of a class.
const DESK: &str = "desk";
/// The name of the socket in the folder of a crew.
const CREW: &str = "crew";

/// A class on this host: a folder of the instructor with the socket of the desk.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct HostPlace {
    /// The path of the socket.
    pub socket: PathBuf,
    /// The user to whom the desk must belong; `None` for the owner of the folder.
    pub instructor: Option<String>,
    /// Whether the folder lasts no longer than what is open there: that of a crew.
    pub(super) is_passing: bool,
}

impl HostPlace {
    /// The class with a name, or at a path: its folder, or its socket.
    pub fn named(name: &str, instructor: Option<String>) -> Self {
        let socket = socket(name, "class", DESK);
        Self {
            socket,
            instructor,
            is_passing: false,
        }
    }

    /// The crew with a name, or at a path: its folder, or its socket. `host` is the user to whom it must belong; `None` for
    /// the owner of the folder.
    pub fn crew(name: &str, host: Option<String>) -> Self {
        Self {
            socket: socket(name, "crew", CREW),
            instructor: host,
            is_passing: true,
        }
    }

    /// Whether the place is open, so that connecting is worth the try.
    pub fn is_open(&self) -> bool {
        UnixStream::connect(&self.socket).is_ok()
    }

    /// Removes what was opened: the socket, and a folder that does not last, if it is empty.
    pub(super) fn remove(&self) {
        // They may have been removed already, or be of further use.
        drop(fs::remove_file(&self.socket));
        if self.is_passing {
            drop(fs::remove_dir(self.folder()));
        }
    }

    pub(super) fn folder(&self) -> &Path {
        let parent = self.socket.parent();
        let parent = parent.filter(|it| !it.as_os_str().is_empty());
        parent.unwrap_or(Path::new("."))
    }

    /// Makes the folder, or checks the one that is there.
    ///
    /// # Errors
    /// It cannot be created, or other users could change it.
    pub(super) fn prepare(&self) -> Result<(), ClassFault> {
        let folder = self.folder();
        let made = DirBuilder::new().mode(FOLDER_MODE).create(folder);
        let of_system = |error: io::Error| ClassFault::Socket {
            socket: self.socket.clone(),
            fault: SocketFault::Io(error),
        };
        match made {
            Ok(()) => {}
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(of_system(error)),
        }
        let found = fs::symlink_metadata(folder).map_err(of_system)?;
        let is_own = found.is_dir() && found.uid() == geteuid().as_raw();
        if !is_own || found.mode() & 0o022 != 0 {
            return Err(ClassFault::Folder(folder.to_owned()));
        }
        fs::set_permissions(folder, Permissions::from_mode(FOLDER_MODE)).map_err(of_system)
    }

    /// Checks that the desk belongs to the instructor: to the user who is named, otherwise to the owner of the folder, or to
    /// the user of this program. SSH brings the socket of another machine as this user's own.
    ///
    /// # Errors
    /// It belongs to another user.
    pub(super) fn check(&self, desk_uid: u32) -> Result<(), ClassFault> {
        if self.instructor.is_none() && desk_uid == geteuid().as_raw() {
            return Ok(());
        }
        let user = user_name(desk_uid);
        let owner = || fs::metadata(self.folder()).ok().map(|it| it.uid());
        let instructor = match &self.instructor {
            Some(name) => name.clone(),
            None => owner().map_or_else(String::new, user_name),
        };
        if user == instructor {
            return Ok(());
        }
        Err(ClassFault::Stranger {
            socket: self.socket.clone(),
            user,
            instructor,
        })
    }
}

/// The socket of the class or crew with a name, or at a path.
fn socket(name: &str, kind: &str, file: &str) -> PathBuf {
    let path = if name.contains('/') {
        PathBuf::from(name)
    } else {
        Path::new("/tmp").join(format!("sortie-{kind}-{name}"))
    };
    let is_socket = fs::metadata(&path).is_ok_and(|found| !found.is_dir());
    if is_socket { path } else { path.join(file) }
}

/// The name of the user who runs this program.
pub fn own_user_name() -> String {
    user_name(geteuid().as_raw())
}

/// The name of a user, or the number of one without a name.
pub(super) fn user_name(uid: u32) -> String {
    let user = User::from_uid(Uid::from_raw(uid)).ok().flatten();
    user.map_or_else(|| uid.to_string(), |user| user.name)
}
