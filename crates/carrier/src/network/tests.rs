//! What only a network can do: to break, and to have strangers on it.

use std::net::TcpListener;
use std::path::PathBuf;

use tempfile::TempDir;

use super::*;
use crate::join_line::JoinLine;
use crate::new_class::NewClass;

mod attacks;
mod false_desks;
mod splits;

/// A class on several machines, as files.
pub(crate) struct Lab {
    folder: PathBuf,
    listen: String,
}

/// A class whose desk listens at a free port of this host.
pub(crate) fn lab(seats: u16) -> (TempDir, Lab) {
    lab_at("127.0.0.1", seats)
}

/// A class whose desk listens at a free port of an address.
fn lab_at(host: &str, seats: u16) -> (TempDir, Lab) {
    let free = TcpListener::bind(format!("{host}:0")).expect("a port");
    let listen = free.local_addr().expect("an address").to_string();
    let parent = tempfile::tempdir().expect("a folder");
    let folder = parent.path().join("9-A");
    let new = NewClass {
        name: "9-A",
        seats,
        addresses: std::slice::from_ref(&listen),
    };
    make(&new, &folder).expect("it is made");
    (parent, Lab { folder, listen })
}

impl Lab {
    pub fn desk(&self) -> NetworkDesk {
        NetworkDesk::read(&self.folder, &self.listen).expect("a desk")
    }

    pub fn line(&self, number: u16) -> JoinLine {
        let file = self.folder.join(format!("seats/seat-{number:02}.join"));
        let text = std::fs::read_to_string(file).expect("a join line");
        JoinLine::parse(&text).expect("a join line")
    }
}

mod folder {
    use std::fs::{self, Permissions};
    use std::os::unix::fs::PermissionsExt as _;

    use super::*;
    use crate::fault::{ClassFault, NetworkFault};
    use crate::place::{ClassPlace, DeskPlace};

    #[test]
    fn only_the_owner_can_read_the_keys_of_a_class() {
        let (_parent, lab) = lab(2);
        let mode = |name: &str| {
            let found = fs::metadata(lab.folder.join(name)).expect(name);
            found.permissions().mode() & 0o777
        };
        assert_eq!((mode(""), mode("seats")), (0o700, 0o700));
        assert_eq!(
            (mode("desk.json"), mode("seats/seat-02.join")),
            (0o600, 0o600)
        );
        let open = Permissions::from_mode(0o640);
        for file in ["desk.json", "seats/seat-02.join"] {
            fs::set_permissions(lab.folder.join(file), open.clone()).expect("set");
        }
        let read = NetworkDesk::read(&lab.folder, &lab.listen);
        assert!(matches!(read, Err(NetworkFault::Exposed(_))), "{read:?}");
        let file = lab.folder.join("seats/seat-02.join").display().to_string();
        let named = ClassPlace::named(&file, None);
        assert!(
            matches!(named, Err(ClassFault::Network(NetworkFault::Exposed(_)))),
            "{named:?}"
        );
    }

    #[test]
    fn a_class_is_not_made_twice_nor_with_wrong_names() {
        let (parent, lab) = lab(1);
        let new = |name, address: &str, folder: &str| {
            let addresses = [address.to_owned()];
            let seats = 1;
            let new = NewClass {
                name,
                seats,
                addresses: &addresses,
            };
            make(&new, &parent.path().join(folder)).expect_err("it is refused")
        };
        assert!(matches!(
            new("9-A", &lab.listen, "9-A"),
            NetworkFault::Exists(_)
        ));
        assert!(matches!(
            new("9/A", &lab.listen, "x"),
            NetworkFault::Name(_)
        ));
        assert!(matches!(new("9-A", "lab", "x"), NetworkFault::Address(_)));
        let read = NetworkDesk::read(parent.path(), &lab.listen);
        assert!(matches!(read, Err(NetworkFault::NoClass(_))), "{read:?}");
        // Without a port, it listens at that of its seats.
        let port = lab.listen.rsplit(':').next().expect("a port");
        let read = NetworkDesk::read(&lab.folder, "0.0.0.0").expect("a desk");
        assert_eq!(read.listen, format!("0.0.0.0:{port}"));
        let read = NetworkDesk::read(&lab.folder, "7447");
        assert!(matches!(read, Err(NetworkFault::Address(_))), "{read:?}");
    }

    #[test]
    fn a_seat_is_taken_out_once_and_the_file_stays_secret() {
        let (_parent, lab) = lab(2);
        // As if the program had been killed.
        fs::write(lab.folder.join("desk.json.new"), "half").expect("written");
        remove_seat(&lab.folder, "seat-02").expect("it is removed");
        let seats = |desk: NetworkDesk| desk.keys.seats.into_keys().collect::<Vec<_>>();
        assert_eq!(seats(lab.desk()), ["seat-01"]);
        let again = remove_seat(&lab.folder, "seat-02");
        assert!(
            matches!(again, Err(NetworkFault::NoSeat { .. })),
            "{again:?}"
        );
        let found = fs::metadata(lab.folder.join("desk.json")).expect("it is there");
        assert_eq!(found.permissions().mode() & 0o777, 0o600);
        assert!(!lab.folder.join("desk.json.new").exists());
    }

    #[test]
    fn a_class_has_the_name_that_it_was_made_with_wherever_its_folder_is() {
        let (parent, lab) = lab(1);
        let folder = parent.path().join("keys-of-9-A");
        fs::rename(&lab.folder, &folder).expect("renamed");
        let desk = DeskPlace::on_network(&folder, &lab.listen).expect("a desk");
        assert_eq!(desk.class(), Some("9-A"));
    }

    #[test]
    fn a_damaged_file_is_named_without_its_content() {
        let (_parent, lab) = lab(1);
        let file = lab.folder.join("desk.json");
        let text = fs::read_to_string(&file).expect("read");
        fs::write(&file, text.replace("\"key\": \"", "\"key\": \"*")).expect("written");
        let read = NetworkDesk::read(&lab.folder, &lab.listen);
        let Err(NetworkFault::NoDesk { reason, .. }) = read else {
            panic!("{read:?}");
        };
        assert!(reason.contains(':') && reason.len() < 10, "{reason}");
    }
}
