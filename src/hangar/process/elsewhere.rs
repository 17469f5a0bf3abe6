//! Systems without `/proc`: every answer is unknown.

use std::path::PathBuf;

use super::{Connection, ProcessIdentity, ProcessSocket, ProcessUsage};

pub(super) fn identity(_: u32) -> Option<ProcessIdentity> {
    None
}

pub(super) fn user(_: u32) -> Option<u32> {
    None
}

pub(super) fn executable(_: u32) -> Option<PathBuf> {
    None
}

pub(super) fn folder(_: u32) -> Option<PathBuf> {
    None
}

pub(super) fn session(_: u32) -> Vec<u32> {
    Vec::new()
}

pub(super) fn is_stopped(_: u32) -> bool {
    false
}

pub(super) fn usage(_: u32) -> Option<ProcessUsage> {
    None
}

pub(super) fn socket(_: Connection) -> Option<ProcessSocket> {
    None
}

pub(super) fn holds(_: u32, _: u64) -> Option<bool> {
    None
}

pub(super) fn address(_: &str) -> Option<std::net::SocketAddr> {
    None
}
