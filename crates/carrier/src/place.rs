//! Where the desk of a class is.

use std::fmt;
use std::fs;
use std::net::UdpSocket;
use std::path::{Path, PathBuf};

use super::address::with_port;
#[cfg(feature = "zenoh")]
use super::address::with_port_of;
use super::fault::{ClassFault, NetworkFault};
use super::host::HostPlace;
use super::join_line::{ENDING, JoinLine, is_address};
#[cfg(feature = "zenoh")]
use super::network;
use super::new_class::NewClass;
use super::ports::{DeskPort, SeatPort};
use super::secret_file::read_secret;
use super::unix;

/// The addresses of a desk for several machines unless others are said: all that the machine has.
pub const EVERY_ADDRESS: &str = "0.0.0.0";

/// Where a seat finds the desk of its class.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ClassPlace {
    /// On this host, at the socket of the desk.
    Host(HostPlace),
    /// On another machine, which a join line names.
    #[cfg(feature = "zenoh")]
    Network(Box<JoinLine>),
}

/// Where a desk is opened.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum DeskPlace {
    /// For the users of this host, who connect to its socket.
    Host(HostPlace),
    /// For seats on several machines, with the keys of the class.
    #[cfg(feature = "zenoh")]
    Network(Box<network::NetworkDesk>),
}

/// Makes the keys of a class in a new folder: the file of the desk, and a file with a join line for each seat. Returns
/// the files of the seats.
///
/// # Errors
/// The name or an address cannot be used, the folder exists, a file cannot be written, or this program has no carrier for
/// several machines.
pub fn make_class(class: &NewClass<'_>, folder: &Path) -> Result<Vec<PathBuf>, ClassFault> {
    #[cfg(feature = "zenoh")]
    return Ok(network::make(class, folder)?);
    #[cfg(not(feature = "zenoh"))]
    {
        let _ = (class, folder);
        Err(NetworkFault::NotBuilt.into())
    }
}

/// Takes a seat out of the class in a folder: a desk that is opened afterwards does not let it in.
///
/// # Errors
/// There is no such class or seat, its file cannot be read or written, or this program has no carrier for several
/// machines.
pub fn remove_seat(folder: &Path, seat: &str) -> Result<(), ClassFault> {
    #[cfg(feature = "zenoh")]
    return Ok(network::remove_seat(folder, seat)?);
    #[cfg(not(feature = "zenoh"))]
    {
        let _ = (folder, seat);
        Err(NetworkFault::NotBuilt.into())
    }
}

impl ClassPlace {
    /// The class with a name, at a path (its folder, or its socket), or of a join line or a file with one.
    ///
    /// # Errors
    /// It is meant as a join line, but cannot be used as one.
    pub fn named(name: &str, instructor: Option<String>) -> Result<Self, ClassFault> {
        if JoinLine::is_meant(name) {
            let line = JoinLine::parse(name);
            return Self::of_line(
                line.map_err(|fault| NetworkFault::JoinLine { file: None, fault })?,
            );
        }
        let is_path = name.contains('/') || name.contains('.');
        if is_path && is_join_file(name) {
            return Self::of_file(Path::new(name));
        }
        Ok(Self::Host(HostPlace::named(name, instructor)))
    }

    /// The class of a file with a join line, or of the line itself.
    ///
    /// # Errors
    /// It is neither, or cannot be used.
    pub fn invited(file_or_line: &str) -> Result<Self, ClassFault> {
        if is_join_file(file_or_line) {
            return Self::of_file(Path::new(file_or_line));
        }
        let line = JoinLine::parse(file_or_line);
        Self::of_line(line.map_err(|fault| NetworkFault::JoinLine { file: None, fault })?)
    }

    fn of_file(path: &Path) -> Result<Self, ClassFault> {
        let line = read_secret(path, |text| {
            let file = Some(path.to_owned());
            JoinLine::parse(text).map_err(|fault| NetworkFault::JoinLine { file, fault })
        });
        Self::of_line(line?)
    }

    /// The class of a join line.
    ///
    /// # Errors
    /// This program has no carrier for several machines.
    #[cfg_attr(
        feature = "zenoh",
        expect(
            clippy::unnecessary_wraps,
            reason = "it fails only without the feature"
        )
    )]
    fn of_line(line: JoinLine) -> Result<Self, ClassFault> {
        #[cfg(feature = "zenoh")]
        return Ok(Self::Network(Box::new(line)));
        #[cfg(not(feature = "zenoh"))]
        {
            drop(line);
            Err(NetworkFault::NotBuilt.into())
        }
    }

    /// The same class, whose desk is at another address than the join line says.
    ///
    /// # Errors
    /// It is no address, or the class is on this host.
    pub fn at(self, address: &str) -> Result<Self, ClassFault> {
        if !is_address(&with_port(address)) {
            return Err(NetworkFault::Address(address.to_owned()).into());
        }
        match self {
            Self::Host(place) => Err(NetworkFault::OnHost(place.socket).into()),
            #[cfg(feature = "zenoh")]
            Self::Network(mut line) => {
                line.addresses = vec![with_port_of(address, &line.addresses)];
                Ok(Self::Network(line))
            }
        }
    }

    /// The folder of a class on this host, if it is not there.
    pub fn missing_folder(&self) -> Option<&Path> {
        match self {
            Self::Host(place) => Some(place.folder()).filter(|folder| !folder.exists()),
            #[cfg(feature = "zenoh")]
            Self::Network(_) => None,
        }
    }

    /// Connects to the desk, and again whenever the connection ends.
    pub fn join(&self) -> SeatPort {
        match self {
            Self::Host(place) => unix::join(place.clone()),
            #[cfg(feature = "zenoh")]
            Self::Network(line) => network::join((**line).clone()),
        }
    }

    /// A name by which the class is found again in files. It contains no secret.
    pub fn id(&self) -> String {
        match self {
            Self::Host(place) => place.socket.display().to_string(),
            #[cfg(feature = "zenoh")]
            Self::Network(line) => line.id(),
        }
    }
}

/// Whether a file with a join line is meant: there is a file, or it is named like one.
fn is_join_file(name: &str) -> bool {
    name.ends_with(ENDING) || fs::metadata(name).is_ok_and(|found| found.is_file())
}

/// The class, and where its desk should be. It contains no secret.
impl fmt::Display for ClassPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Host(place) => write!(f, "{}", place.socket.display()),
            #[cfg(feature = "zenoh")]
            Self::Network(line) => write!(f, "{} ({})", line.class, line.addresses.join(", ")),
        }
    }
}

impl DeskPlace {
    /// A desk for several machines, with the keys in a folder, that listens at HOST:PORT; without a port, at that of the
    /// class.
    ///
    /// # Errors
    /// The address or the folder cannot be used, or this program has no carrier for several machines.
    pub fn on_network(folder: &Path, listen: &str) -> Result<Self, ClassFault> {
        #[cfg(feature = "zenoh")]
        return Ok(Self::Network(Box::new(network::NetworkDesk::read(
            folder, listen,
        )?)));
        #[cfg(not(feature = "zenoh"))]
        {
            let _ = (folder, listen);
            Err(NetworkFault::NotBuilt.into())
        }
    }

    /// The name of the class, if its files say one.
    pub fn class(&self) -> Option<&str> {
        match self {
            Self::Host(_) => None,
            #[cfg(feature = "zenoh")]
            Self::Network(desk) => Some(desk.class()),
        }
    }

    /// The address at which it listens for other machines; `None` if it is for this host.
    pub fn address(&self) -> Option<&str> {
        match self {
            Self::Host(_) => None,
            #[cfg(feature = "zenoh")]
            Self::Network(desk) => Some(&desk.listen),
        }
    }

    /// Opens the desk: seats can connect from then on.
    ///
    /// # Errors
    /// Its socket cannot be opened.
    #[cfg_attr(
        not(feature = "zenoh"),
        expect(
            clippy::unused_async,
            reason = "opening a socket needs no waiting, a network does"
        )
    )]
    pub async fn open(&self) -> Result<DeskPort, ClassFault> {
        match self {
            Self::Host(place) => unix::open(place),
            #[cfg(feature = "zenoh")]
            Self::Network(desk) => network::open(desk).await,
        }
    }
}

/// The address of this machine at which others may reach it: that of the interface of the default route. Nothing is
/// sent.
///
/// # Errors
/// There is no such route.
pub fn own_address() -> Result<String, NetworkFault> {
    // An address for documentation, to which nobody answers.
    let route = UdpSocket::bind((EVERY_ADDRESS, 0)).and_then(|socket| {
        socket.connect("192.0.2.1:9")?;
        socket.local_addr()
    });
    let own = route.map_err(|_| NetworkFault::NoAddress)?.ip();
    if own.is_unspecified() {
        return Err(NetworkFault::NoAddress);
    }
    Ok(with_port(&own.to_string()))
}
