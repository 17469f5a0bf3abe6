//! Why a class cannot be opened or joined, as text.

use std::io::{self, ErrorKind};
use std::path::Path;

use crate::carrier::socket::SocketFault;
use crate::carrier::{ClassFault, JoinLineFault, NetworkFault, StartFault};
use crate::text;
use crate::text::Text;

fn shown(path: &Path) -> String {
    path.display().to_string()
}

impl From<&ClassFault> for Text {
    fn from(fault: &ClassFault) -> Self {
        match fault {
            ClassFault::Socket { socket, fault } => socket_text(&shown(socket), fault),
            ClassFault::Folder(folder) => text!("class-folder", folder = shown(folder)),
            ClassFault::Stranger {
                socket,
                user,
                instructor,
            } => text!(
                "class-stranger",
                socket = shown(socket),
                user = user,
                instructor = instructor
            ),
            ClassFault::Network(fault) => network_text(fault),
        }
    }
}

fn socket_text(socket: &str, fault: &SocketFault) -> Text {
    match fault {
        SocketFault::NoSocket => text!("class-no-socket", socket = socket),
        SocketFault::InUse => text!("class-in-use", socket = socket),
        SocketFault::Io(error) => {
            text!("class-not-open", socket = socket, error = error.to_string())
        }
    }
}

fn network_text(fault: &NetworkFault) -> Text {
    match fault {
        NetworkFault::NotBuilt => text!("class-not-built"),
        NetworkFault::File { file, error } => {
            let error = Text::from(&error.0);
            text!("class-file", file = shown(file), error = error)
        }
        NetworkFault::Exposed(file) => text!("class-exposed", file = shown(file)),
        NetworkFault::JoinLine { file, fault } => {
            let reason = join_line_text(*fault);
            match file {
                Some(file) => text!("class-join-file", file = shown(file), reason = reason),
                None => text!("class-join-line", reason = reason),
            }
        }
        NetworkFault::NoDesk { file, reason } => {
            text!("class-no-keys", file = shown(file), reason = reason)
        }
        NetworkFault::NoClass(folder) => text!("class-no-class", folder = shown(folder)),
        NetworkFault::NoSeat { folder, seat } => {
            text!("class-unknown-file", folder = shown(folder), seat = seat)
        }
        NetworkFault::Exists(folder) => text!("class-exists", folder = shown(folder)),
        NetworkFault::Name(name) => text!("class-name", name = name),
        NetworkFault::Address(address) => text!("class-address", address = address),
        NetworkFault::OnHost(socket) => text!("class-on-host", socket = shown(socket)),
        NetworkFault::NoAddress => text!("class-no-address"),
        NetworkFault::NotOpen { address, error } => not_open_text(address, &error.0),
        NetworkFault::NotStarted { address, fault } => {
            let reason = start_text(*fault);
            text!("class-not-started", address = address, reason = reason)
        }
        NetworkFault::NotTheDesk(address) => text!("class-not-the-desk", address = address),
        NetworkFault::Unknown { class, seat } => {
            text!("class-unknown", class = class, seat = seat)
        }
        NetworkFault::Crypto(reason) => text!("class-crypto", reason = reason),
    }
}

fn not_open_text(address: &str, error: &io::Error) -> Text {
    match error.kind() {
        ErrorKind::AddrInUse => text!("class-port-in-use", address = address),
        ErrorKind::AddrNotAvailable => text!("class-not-of-machine", address = address),
        _ => {
            let reason = Text::from(error);
            text!("class-not-listening", address = address, reason = reason)
        }
    }
}

fn start_text(fault: StartFault) -> Text {
    match fault {
        StartFault::Certificates => text!("class-start-certificates"),
        StartFault::Timeout => text!("class-start-timeout"),
        StartFault::Ended => text!("class-start-ended"),
    }
}

fn join_line_text(fault: JoinLineFault) -> Text {
    match fault {
        JoinLineFault::Prefix => text!("class-join-prefix"),
        JoinLineFault::Incomplete => text!("class-join-incomplete"),
        JoinLineFault::Damaged => text!("class-join-damaged"),
    }
}
