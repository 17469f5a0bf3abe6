//! The file system type of a folder.

use std::path::{Path, PathBuf};

/// File systems whose files are stored on another machine, by their names in Linux.
const NETWORK: [&str; 17] = [
    "9p",
    "acfs",
    "afs",
    "beegfs",
    "ceph",
    "cifs",
    "coda",
    "fuse.glusterfs",
    "fuse.rclone",
    "fuse.s3fs",
    "fuse.sshfs",
    "gpfs",
    "lustre",
    "ncpfs",
    "nfs",
    "nfs4",
    "smb3",
];

/// The type of the network file system on which a folder is, from the text of
/// `/proc/self/mountinfo`; `None` for any other file system.
pub(super) fn network_file_system<'a>(mounts: &'a str, folder: &Path) -> Option<&'a str> {
    let mounted = mounts.lines().filter_map(mount);
    // Of two mounts at one place, the later one hides the earlier.
    let (_, kind) = mounted
        .filter(|(at, _)| folder.starts_with(at))
        .max_by_key(|(at, _)| at.as_os_str().len())?;
    NETWORK.contains(&kind).then_some(kind)
}

/// The mount point and the file system type in a line of `/proc/self/mountinfo` (proc(5)).
fn mount(line: &str) -> Option<(PathBuf, &str)> {
    let (before, after) = line.split_once(" - ")?;
    let at = before.split(' ').nth(4)?;
    let kind = after.split(' ').next()?;
    // Spaces in a path are written as octal escapes.
    let at = at
        .replace("\\040", " ")
        .replace("\\011", "\t")
        .replace("\\012", "\n")
        .replace("\\134", "\\");
    Some((PathBuf::from(at), kind))
}

#[cfg(test)]
mod tests {
    use super::*;

    const MOUNTS: &str = "\
22 1 8:1 / / rw,relatime shared:1 - ext4 /dev/sda1 rw
40 22 0:35 / /home rw,relatime shared:2 - nfs4 server:/home rw,vers=4.2
41 40 8:2 / /home/local\\040disk rw - ext4 /dev/sdb1 rw
42 22 0:40 / /mnt/share rw master:3 - cifs //server/share rw
";

    #[test]
    fn a_folder_has_the_file_system_of_the_nearest_mount_above_it() {
        let found = |folder: &str| network_file_system(MOUNTS, Path::new(folder));
        assert_eq!(found("/home/anna/.local/share/sortie"), Some("nfs4"));
        assert_eq!(found("/home/local disk/anna"), None);
        assert_eq!(found("/mnt/share"), Some("cifs"));
        assert_eq!(found("/mnt/shared"), None);
        assert_eq!(found("/var/lib"), None);
        assert_eq!(network_file_system("", Path::new("/")), None);
    }
}
