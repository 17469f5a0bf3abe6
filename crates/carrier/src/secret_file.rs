//! Files that only their owner may read.

use std::fs;
use std::io::{self, Read};
use std::os::unix::fs::MetadataExt as _;
use std::path::Path;

use super::fault::NetworkFault;

/// The maximum number of bytes of such a file: that of a desk with 500 seats has some 60 kB.
const LONGEST: u64 = 256 * 1024;

/// Reads a small file with a secret, which `parse` takes from its text.
///
/// # Errors
/// It cannot be read, it is something else, or other users can read it.
pub(crate) fn read_secret<T>(
    path: &Path,
    parse: impl FnOnce(&str) -> Result<T, NetworkFault>,
) -> Result<T, NetworkFault> {
    let of_system = |error: io::Error| NetworkFault::File {
        file: path.to_owned(),
        error: error.into(),
    };
    let mut file = fs::File::open(path).map_err(of_system)?;
    let found = file.metadata().map_err(of_system)?;
    let mut bytes = Vec::new();
    let mut part = Read::by_ref(&mut file).take(LONGEST);
    part.read_to_end(&mut bytes).map_err(of_system)?;
    // Neither a join line nor the file of a desk has anything but ASCII: what is replaced is refused later.
    let secret = parse(&String::from_utf8_lossy(&bytes))?;
    // Of a file without a secret, this would be the wrong complaint.
    if found.mode() & 0o077 != 0 {
        return Err(NetworkFault::Exposed(path.to_owned()));
    }
    Ok(secret)
}
