//! The option `--class` of the commands that open a console for a trainee.

use clap::Args;

use super::settings::CliSettings;
use crate::carrier::ClassPlace;
use crate::shell::{ClassOptions, ClassPart};

/// The class of `sortie`, `sortie fly` and `sortie connect`.
#[derive(Debug, Args)]
pub(super) struct SeatArguments {
    /// Join the class with this name, or in this folder: its instructor sees your flight and can act in it.
    #[arg(long, value_name = "NAME|PATH")]
    class: Option<String>,
}

impl SeatArguments {
    /// Whether no class is named.
    pub fn is_default(&self) -> bool {
        self.class.is_none()
    }

    /// The class that was named, otherwise that of the configuration, which asks first.
    pub fn or_configured(&self, settings: &CliSettings) -> Option<ClassOptions> {
        let configured = &settings.config.class;
        let name = self.class.as_ref().or(configured.join.as_ref())?;
        Some(ClassOptions {
            place: ClassPlace::named(name, configured.instructor.clone()),
            part: ClassPart::Seat {
                asks: self.class.is_none(),
            },
        })
    }
}
