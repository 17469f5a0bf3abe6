//! Systems without `/proc`: nothing is known, so nothing is taken for what it may not be.

use std::path::PathBuf;

use super::{Connection, Identity, Socket, Usage};

pub(super) fn identity(_: u32) -> Option<Identity> {
    None
}

pub(super) fn user(_: u32) -> Option<u32> {
    None
}

pub(super) fn executable(_: u32) -> Option<PathBuf> {
    None
}

pub(super) fn usage(_: u32) -> Option<Usage> {
    None
}

pub(super) fn socket(_: Connection) -> Option<Socket> {
    None
}

pub(super) fn holds(_: u32, _: u64) -> Option<bool> {
    None
}
