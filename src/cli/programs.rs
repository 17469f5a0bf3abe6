//! The options that name SITL's programs, and the other sources of their names.

use std::collections::BTreeMap;
use std::path::PathBuf;

use clap::Args;

use super::settings::CliSettings;
use crate::hangar::programs::{Named, Places, Programs};
use crate::sitl::SitlKind;

/// Options of commands that start SITL.
#[derive(Debug, Clone, Default, Args)]
pub(super) struct ProgramOptions {
    /// Use this SITL program for multirotors; by default the one from the configuration, from `SORTIE_ARDUCOPTER`, on
    /// the PATH or in a usual build folder.
    #[arg(long, value_name = "FILE", help_heading = "Programs")]
    arducopter: Option<PathBuf>,
    /// Use this SITL program for planes (`SORTIE_ARDUPLANE`).
    #[arg(long, value_name = "FILE", help_heading = "Programs")]
    arduplane: Option<PathBuf>,
    /// Use this SITL program for rovers and boats (`SORTIE_ARDUROVER`).
    #[arg(long, value_name = "FILE", help_heading = "Programs")]
    ardurover: Option<PathBuf>,
    /// Use this SITL program for submarines (`SORTIE_ARDUSUB`).
    #[arg(long, value_name = "FILE", help_heading = "Programs")]
    ardusub: Option<PathBuf>,
}

impl ProgramOptions {
    /// Whether a program was named.
    pub fn is_given(&self) -> bool {
        let named = [
            &self.arducopter,
            &self.arduplane,
            &self.ardurover,
            &self.ardusub,
        ];
        named.into_iter().any(Option::is_some)
    }

    /// Looks for the programs: in these options, then in the settings, then in the usual folders.
    pub fn find(&self, settings: &CliSettings) -> Programs {
        let places = Places::of_environment();
        let named: BTreeMap<SitlKind, Named> = SitlKind::ALL
            .iter()
            .filter_map(|&kind| Some((kind, self.named(kind, settings)?)))
            .collect();
        Programs::find(&named, &places)
    }

    fn named(&self, kind: SitlKind, settings: &CliSettings) -> Option<Named> {
        let set = &settings.config.hangar;
        let (option, set) = match kind {
            SitlKind::Copter => (&self.arducopter, &set.arducopter),
            SitlKind::Plane => (&self.arduplane, &set.arduplane),
            SitlKind::Rover => (&self.ardurover, &set.ardurover),
            SitlKind::Sub => (&self.ardusub, &set.ardusub),
        };
        if let Some(file) = option {
            let by = format!("--{}", kind.program());
            let file = file.clone();
            return Some(Named { file, by });
        }
        let origin = settings
            .sources
            .layers
            .origin(&format!("hangar.{}", kind.program()));
        let file = PathBuf::from(set.as_deref()?);
        let by = origin.to_string();
        Some(Named { file, by })
    }
}
