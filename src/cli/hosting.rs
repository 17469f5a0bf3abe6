//! The option `--crew` of the commands that fly: they host a crew.

use std::path::Path;

use clap::Args;

use crate::carrier::HostPlace;
use crate::shell::CrewOptions;

/// The crew of `sortie fly` and `sortie connect`.
#[derive(Debug, Args)]
pub(super) struct HostArguments {
    /// Let others join this flight as a crew with this name: `sortie crew join NAME`. Missions that are not made for a
    /// crew then count as practice.
    #[arg(long, value_name = "NAME", conflicts_with = "class")]
    crew: Option<String>,
}

impl HostArguments {
    /// The crew that the flight opens.
    pub fn options(&self) -> Option<CrewOptions> {
        let name = self.crew.as_ref()?;
        Some(CrewOptions::Host {
            place: HostPlace::crew(name, None),
            name: short(name),
        })
    }
}

/// The name of a crew, which may have been given as a path.
pub(super) fn short(name: &str) -> String {
    let last = Path::new(name).file_name();
    last.map_or_else(|| name.to_owned(), |it| it.to_string_lossy().into_owned())
}
