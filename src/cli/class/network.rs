//! A class on several machines: its keys, and where its desk listens.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;

use crate::carrier::{DeskPlace, NewClass, make_class, own_address};
use crate::cli::Failure;
use crate::cli::seat::refused;
use crate::cli::settings::CliSettings;
use crate::text;
use crate::text::{Locale, Text};

/// All addresses of the machine.
const EVERY_ADDRESS: &str = "0.0.0.0";
/// Where a desk listens unless an address is given.
pub(super) const EVERYWHERE: &str = "0.0.0.0:7447";
/// The folder of the keys of all classes, in the data folder.
const KEYS: &str = "class-keys";

/// Options of `sortie class new`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie class new 9-A                                      32 seats; this machine's address in the network\n  \
    sortie class new 9-A --seats 40 --address 192.168.1.5:7447\n  \
    sortie class new 9-A --address lab:7447 --output /srv/9-A")]
pub(super) struct NewArguments {
    /// The name of the class: letters, digits, `-` and `_`.
    name: String,
    /// Make this many seats. No seats can be added later, so make some more than there are trainees.
    #[arg(long, default_value_t = 32, value_parser = clap::value_parser!(u16).range(1..=500))]
    seats: u16,
    /// Where trainees reach the desk; repeat the option for several addresses, which are tried in this order. By
    /// default, the address of this machine, and port 7447.
    #[arg(long = "address", value_name = "HOST:PORT")]
    addresses: Vec<String>,
    /// Write the keys to this new folder; by default to the data folder, where sortie class open finds them by name.
    #[arg(long, value_name = "DIR")]
    output: Option<PathBuf>,
}

/// Makes the keys of a class, and says what to do with them.
pub(super) fn new(arguments: &NewArguments, settings: &CliSettings) -> Result<ExitCode, Failure> {
    let locale = Locale::new(settings.language());
    let name = arguments.name.as_str();
    let folder = match &arguments.output {
        Some(folder) => folder.clone(),
        None => keys(settings, &locale)?.join(name),
    };
    let addresses = match arguments.addresses.as_slice() {
        [] => vec![own_address().map_err(refused)?],
        some => some.to_owned(),
    };
    let class = NewClass {
        name,
        seats: arguments.seats,
        addresses: &addresses,
    };
    let seats = make_class(&class, &folder).map_err(refused)?;
    let named = match &arguments.output {
        Some(_) if shown(&folder).contains('/') => shown(&folder),
        Some(_) => format!("./{}", shown(&folder)),
        None => name.to_owned(),
    };
    for line in made(&class, &named, &seats) {
        say!("{}", locale.text(&line))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn shown(path: &Path) -> String {
    path.display().to_string()
}

/// What was made, and what to do with it. The desk finds the class by `named`.
fn made(class: &NewClass<'_>, named: &str, seats: &[PathBuf]) -> Vec<Text> {
    let first = seats.first().map_or(Path::new(""), PathBuf::as_path);
    let lines = first.parent().unwrap_or(first);
    let folder = lines.parent().unwrap_or(lines);
    let port = class.addresses.first().and_then(|it| it.rsplit(':').next());
    let listen = format!("{EVERY_ADDRESS}:{}", port.unwrap_or_default());
    let file = first.file_name().unwrap_or_default().display().to_string();
    vec![
        text!(
            "class-made",
            class = class.name,
            seats = u32::from(class.seats),
            folder = shown(folder)
        ),
        text!("class-made-lines", folder = shown(lines)),
        text!("class-made-desk", class = named, listen = listen),
        text!("class-made-seat", file = file),
    ]
}

/// The desk of a class on several machines, by name or by the path of its folder.
pub(super) fn desk(name: &str, listen: &str, settings: &CliSettings) -> Result<DeskPlace, Failure> {
    let locale = Locale::new(settings.language());
    let folder = if name.contains('/') {
        PathBuf::from(name)
    } else {
        keys(settings, &locale)?.join(name)
    };
    DeskPlace::on_network(&folder, listen).map_err(refused)
}

/// The folder of the keys of all classes.
fn keys(settings: &CliSettings, locale: &Locale) -> Result<PathBuf, Failure> {
    settings.data.require(locale)?;
    let data = settings.data.path();
    let data = data.ok_or_else(|| Failure::Wrong(vec![text!("career-nowhere")]))?;
    Ok(data.join(KEYS))
}
