//! A class on several machines: its keys, and where its desk listens.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;

use crate::carrier::{
    DeskPlace, EVERY_ADDRESS, HostPlace, NewClass, is_loopback, make_class, own_address,
    remove_seat, with_port,
};
use crate::cli::Failure;
use crate::cli::seat::refused;
use crate::cli::settings::CliSettings;
use crate::sitl::quoted;
use crate::store::ClassRecords;
use crate::text;
use crate::text::{Locale, Text};

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
    #[arg(long = "address", value_name = "HOST[:PORT]")]
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
    check_records(name, settings)?;
    let addresses = match arguments.addresses.as_slice() {
        [] => vec![own_address().map_err(refused)?],
        some => some.iter().map(|it| with_port(it)).collect(),
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

/// Checks that an earlier class has left no records, to which those of a new one would be added.
fn check_records(class: &str, settings: &CliSettings) -> Result<(), Failure> {
    let records = settings
        .data
        .path()
        .map(|data| ClassRecords::within(data, class));
    match records.filter(ClassRecords::exist) {
        Some(records) => Err(Failure::Wrong(vec![text!(
            "class-records-exist",
            class = class,
            folder = shown(records.folder())
        )])),
        None => Ok(()),
    }
}

/// Options of `sortie class remove`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie class remove 9-A seat-07           afterwards, open the desk again\n  \
    sortie class remove /srv/9-A seat-07")]
pub(super) struct RemoveArguments {
    /// The name of the class, or the path of its folder.
    #[arg(value_name = "NAME|PATH")]
    class: String,
    /// The seat, as its file is named without the ending.
    #[arg(value_name = "SEAT")]
    seat: String,
}

/// Takes a seat out of a class.
pub(super) fn remove(
    arguments: &RemoveArguments,
    settings: &CliSettings,
) -> Result<ExitCode, Failure> {
    let locale = Locale::new(settings.language());
    let RemoveArguments { class, seat } = arguments;
    let folder = folder_of(class, settings)?;
    remove_seat(&folder, seat).map_err(refused)?;
    let removed = text!("class-removed", class = class, seat = seat);
    say!("{}", locale.text(&removed))?;
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
    let listen = listening(class.addresses);
    let named = quoted(named).into_owned();
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
        text!(
            "class-made-seat",
            file = file,
            addresses = class.addresses.join(", ")
        ),
    ]
}

/// Where the desk of a class listens that its seats look for at these addresses: at all addresses of the machine, unless
/// they are this machine's own, which no other one reaches.
fn listening(addresses: &[String]) -> String {
    let first = addresses.first().map_or("", String::as_str);
    if addresses.iter().all(|it| is_loopback(it)) {
        return first.to_owned();
    }
    let port = first.rsplit(':').next().unwrap_or_default();
    format!("{EVERY_ADDRESS}:{port}")
}

/// The desk of a class on several machines, by name or by the path of its folder.
pub(super) fn desk(name: &str, listen: &str, settings: &CliSettings) -> Result<DeskPlace, Failure> {
    let folder = folder_of(name, settings)?;
    DeskPlace::on_network(&folder, listen).map_err(refused)
}

/// The desk of a class on this host, by name or by the path of its folder.
pub(super) fn desk_on_host(name: &str, settings: &CliSettings) -> Result<DeskPlace, Failure> {
    let data = settings.data.path().filter(|_| !name.contains('/'));
    let keys = data.map(|data| data.join(KEYS).join(name));
    if keys.is_some_and(|keys| keys.is_dir()) {
        // The seats with its join files would not find this desk.
        return Err(Failure::Wrong(vec![text!("class-has-keys", class = name)]));
    }
    Ok(DeskPlace::Host(HostPlace::named(name, None)))
}

/// The folder of the keys of a class, by name or by path.
fn folder_of(name: &str, settings: &CliSettings) -> Result<PathBuf, Failure> {
    if name.contains('/') {
        return Ok(PathBuf::from(name));
    }
    let locale = Locale::new(settings.language());
    Ok(keys(settings, &locale)?.join(name))
}

/// The folder of the keys of all classes.
fn keys(settings: &CliSettings, locale: &Locale) -> Result<PathBuf, Failure> {
    settings.data.require(locale)?;
    let data = settings.data.path();
    let data = data.ok_or_else(|| Failure::Wrong(vec![text!("career-nowhere")]))?;
    Ok(data.join(KEYS))
}

#[cfg(test)]
mod tests {
    /// `class new` once advised to open the desk of a class on this machine only to all networks.
    #[test]
    fn the_desk_of_a_class_on_this_machine_listens_there_only() {
        let listening = |addresses: &[&str]| {
            let addresses: Vec<String> = addresses.iter().map(|it| (*it).to_owned()).collect();
            super::listening(&addresses)
        };
        assert_eq!(listening(&["127.0.0.1:7461"]), "127.0.0.1:7461");
        assert_eq!(listening(&["192.168.1.5:7461"]), "0.0.0.0:7461");
        assert_eq!(listening(&["127.0.0.1:7461", "lab:7461"]), "0.0.0.0:7461");
    }
}
