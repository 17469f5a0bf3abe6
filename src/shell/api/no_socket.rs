//! Systems without Unix sockets have no interface for programs.

use std::path::Path;

use super::{Exchange, shown};
use crate::text;

/// Cannot be opened.
pub enum Listener {}

impl Listener {
    /// Always fails.
    ///
    /// # Errors
    /// The system has no Unix sockets.
    pub fn open(path: &Path, _exchange: Exchange) -> anyhow::Result<Self> {
        let text = text!("api-no-unix", socket = shown(path));
        anyhow::bail!(text.to_string())
    }
}
