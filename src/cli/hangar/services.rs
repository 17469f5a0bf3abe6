//! The options that name hangars on other machines.

use std::path::{Path, PathBuf};

use clap::Args;

use super::super::Failure;
use super::super::settings::CliSettings;
use crate::hangar::HangarToken;
use crate::hangar::client::{HangarAddress, RemoteHangar};

/// The name of the hangars' token file in the state folder.
const TOKEN_FILE: &str = "hangar-token";

/// Options of commands that start SITL in hangars on other machines.
#[derive(Debug, Clone, Default, Args)]
pub(in crate::cli) struct ServiceOptions {
    /// Start the vehicles in this hangar; repeat the option to spread them over several machines.
    #[arg(long = "hangar", value_name = "http://HOST:PORT")]
    hangars: Vec<HangarAddress>,
    /// Read the token of the hangars from this file; by default the one in the configuration, or the one that
    /// `sortie hangar` creates on this machine.
    #[arg(long, value_name = "FILE")]
    hangar_token: Option<PathBuf>,
}

impl ServiceOptions {
    /// Whether a hangar was named.
    pub fn is_given(&self) -> bool {
        !self.hangars.is_empty()
    }

    /// The hangars named by these options, otherwise those of the configuration; empty without any.
    pub fn remotes(&self, settings: &CliSettings) -> Result<Vec<RemoteHangar>, Failure> {
        let invalid = |error: &dyn std::fmt::Display| Failure::Invalid(format!("sortie: {error}"));
        let mut addresses = self.hangars.clone();
        if addresses.is_empty() {
            for url in &settings.config.hangar.urls {
                addresses.push(url.parse().map_err(|error| invalid(&error))?);
            }
        }
        if addresses.is_empty() {
            return Ok(Vec::new());
        }
        let is_named = self.hangar_token.is_some() || settings.config.hangar.token_file.is_some();
        let file = token_file(self.hangar_token.as_deref(), settings)?;
        let token = match HangarToken::load(&file) {
            Ok(token) => Some(token),
            // A hangar of the same user on this machine needs no token.
            Err(error) if error.is_missing() && !is_named => None,
            Err(error) => return Err(invalid(&error)),
        };
        let remote = |address| RemoteHangar::new(address, token.clone());
        Ok(addresses.into_iter().map(remote).collect())
    }
}

/// The path of the token file: the named one, the configured one, or the one in the state folder.
pub(super) fn token_file(named: Option<&Path>, settings: &CliSettings) -> Result<PathBuf, Failure> {
    let set = settings.config.hangar.token_file.as_deref();
    let in_state = || Some(settings.folders.as_ref()?.state.join(TOKEN_FILE));
    named
        .or(set.map(Path::new))
        .map(Path::to_owned)
        .or_else(in_state)
        .ok_or_else(|| {
            let words = "sortie: no home folder: name the hangar's token file with --hangar-token";
            Failure::Invalid(words.to_owned())
        })
}
