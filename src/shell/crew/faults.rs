//! Why a crew cannot be opened or joined, as text.

use crate::carrier::ClassFault;
use crate::carrier::socket::SocketFault;
use crate::text;
use crate::text::Text;

/// Why the host cannot open a crew.
pub(super) fn not_opened(fault: &ClassFault) -> Text {
    text!("crew-not-opened", fault = reason(fault))
}

/// Why a member cannot join the crew that it has found.
pub(super) fn not_joined(fault: &ClassFault) -> Text {
    text!("crew-not-joined", fault = reason(fault))
}

fn reason(fault: &ClassFault) -> Text {
    match fault {
        ClassFault::Socket { socket, fault } => {
            let socket = socket.display().to_string();
            match fault {
                SocketFault::NoSocket => text!("crew-no-socket", socket = socket),
                SocketFault::InUse => text!("crew-in-use", socket = socket),
                SocketFault::Io(error) => {
                    text!("crew-no-access", socket = socket, error = Text::from(error))
                }
            }
        }
        ClassFault::Folder(folder) => {
            text!("crew-folder", folder = folder.display().to_string())
        }
        ClassFault::Stranger {
            socket,
            user,
            instructor,
        } => text!(
            "crew-stranger",
            socket = socket.display().to_string(),
            user = user,
            host = instructor
        ),
        // A crew is on one host.
        ClassFault::Network(_) => Text::from(fault),
    }
}
