//! Hashes of files.

use std::fs::File;
use std::io;
use std::path::Path;

use sha2::{Digest as _, Sha256};

use crate::class::ContentHash;

/// The hash of a file's content, in hexadecimal digits.
pub(super) fn sha256_of(path: &Path) -> io::Result<String> {
    hash_of(File::open(path)?)
}

/// The hash of what can be read, in hexadecimal digits.
pub(super) fn hash_of(mut read: impl io::Read) -> io::Result<String> {
    let mut hash = Sha256::new();
    let mut bytes = vec![0; 64 * 1024];
    loop {
        match read.read(&mut bytes)? {
            0 => return Ok(hex(hash.finalize())),
            count => hash.update(&bytes[..count]),
        }
    }
}

/// The hash of no bytes, in hexadecimal digits.
pub(super) fn sha256_of_nothing() -> String {
    hex(Sha256::new().finalize())
}

/// A hash in hexadecimal digits.
pub(super) fn hex(digest: impl Into<[u8; 32]>) -> String {
    ContentHash::from(digest.into()).as_str().to_owned()
}
