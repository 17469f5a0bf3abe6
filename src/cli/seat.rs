//! The option `--class` of the commands that open a console for a trainee, and `sortie join`.

use clap::Args;

use super::Failure;
use super::settings::CliSettings;
use crate::carrier::{ClassFault, ClassPlace};
use crate::shell::ClassOptions;
use crate::text;
use crate::text::Text;

/// The class of `sortie`, `sortie fly` and `sortie connect`.
#[derive(Debug, Args)]
pub(super) struct SeatArguments {
    /// Join the class with this name, in this folder, or of this join line or file with one: its instructor sees your
    /// flight and can act in it.
    #[arg(long, value_name = "NAME|PATH|LINE")]
    class: Option<String>,
    #[command(flatten)]
    desk: DeskAddress,
}

/// Options of `sortie join`.
#[derive(Debug, Args)]
pub(super) struct JoinArguments {
    /// The file that you got for your seat, such as seat-07.join, or the line in it. Other users of the machine can see
    /// a line in the list of processes, but not the content of a file.
    #[arg(value_name = "FILE|LINE")]
    line: String,
    #[command(flatten)]
    desk: DeskAddress,
}

/// Where the desk of a class on several machines is.
#[derive(Debug, Args)]
struct DeskAddress {
    /// Look for the desk of a join line here instead of at the addresses in the line; the port is 7447 by default.
    #[arg(long = "desk", value_name = "HOST[:PORT]")]
    address: Option<String>,
}

impl SeatArguments {
    /// Whether no class is named.
    pub fn is_default(&self) -> bool {
        self.class.is_none() && self.desk.address.is_none()
    }

    /// The class that was named, otherwise that of the configuration, which asks first.
    ///
    /// # Errors
    /// The options name a class or a desk that cannot be used.
    pub fn or_configured(&self, settings: &CliSettings) -> Result<Seating, Failure> {
        let configured = settings.config.class.join.as_ref();
        let Some(name) = self.class.as_ref().or(configured) else {
            return match self.desk.address {
                Some(_) => Err(Failure::Wrong(vec![text!("class-desk-alone")])),
                None => Ok(Seating::default()),
            };
        };
        let instructor = settings.config.class.instructor.clone();
        let place = ClassPlace::named(name, instructor);
        match place.and_then(|place| self.desk.seat(place, self.class.is_none())) {
            // The administrator's configuration may be meant for others.
            Err(fault) if self.is_default() => Ok(Seating {
                class: None,
                warning: Some(text!("class-join-unusable", fault = Text::from(&fault))),
            }),
            class => Ok(Seating {
                class: Some(class.map_err(refused)?),
                warning: None,
            }),
        }
    }
}

/// The place of a trainee's console.
#[derive(Default)]
pub(super) struct Seating {
    /// `None` outside of any class.
    pub class: Option<ClassOptions>,
    /// Why the class of the configuration cannot be joined.
    pub warning: Option<Text>,
}

impl JoinArguments {
    /// The class of the join line.
    ///
    /// # Errors
    /// It cannot be used.
    pub fn class(&self) -> Result<ClassOptions, Failure> {
        let place = ClassPlace::invited(&self.line).map_err(refused)?;
        self.desk.seat(place, false).map_err(refused)
    }
}

impl DeskAddress {
    fn seat(&self, place: ClassPlace, asks: bool) -> Result<ClassOptions, ClassFault> {
        let place = match &self.address {
            Some(address) => place.at(address)?,
            None => place,
        };
        Ok(ClassOptions::Seat { place, asks })
    }
}

/// What is wrong with a class, as the failure of a command.
pub(super) fn refused(fault: impl Into<ClassFault>) -> Failure {
    Failure::Wrong(vec![Text::from(&fault.into())])
}
