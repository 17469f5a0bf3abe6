//! Access to the files of logs, plans and keys off the event loop, so a slow disk or network folder
//! does not delay other vehicles.

use std::sync::Arc;

use tokio::runtime::{Handle, RuntimeFlavor};
use tokio::task::block_in_place;

use crate::link::{LinkHandle, SignedLink};
use crate::plan::{Document, ListKind};
use crate::session::{
    FileBytes, FileDesk, GapMap, KeptLog, KeyDesk, LogKeeper, PlanOnFile, PlanShelf, VehicleLog,
};
use crate::signing::{SentKey, SigningChange};
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::wire::{MavAddress, Outgoing, SystemId};

/// A keeper whose work blocks only its own vehicle.
#[derive(Debug)]
pub(super) struct BlockingKeeper(pub Arc<dyn LogKeeper>);

impl LogKeeper for BlockingKeeper {
    fn find(&self, log: &VehicleLog) -> Result<KeptLog, Text> {
        off_the_loop(|| self.0.find(log))
    }

    fn keep(&self, log: &VehicleLog, bytes: &[FileBytes], gaps: &GapMap) -> Result<(), Text> {
        off_the_loop(|| self.0.keep(log, bytes, gaps))
    }

    fn checksum(&self, log: &VehicleLog) -> Result<u32, Text> {
        off_the_loop(|| self.0.checksum(log))
    }

    fn finish(&self, log: &VehicleLog) -> Result<String, Text> {
        off_the_loop(|| self.0.finish(log))
    }
}

/// A desk whose work blocks only its own vehicle.
#[derive(Debug)]
pub(super) struct BlockingFiles(pub Arc<dyn FileDesk>);

impl FileDesk for BlockingFiles {
    fn read(&self, file: &str) -> Result<Vec<u8>, Text> {
        off_the_loop(|| self.0.read(file))
    }

    fn write(&self, file: &str, bytes: &[u8]) -> Result<String, Text> {
        off_the_loop(|| self.0.write(file, bytes))
    }

    fn kept(&self, checksum: u32) -> Option<Vec<u8>> {
        off_the_loop(|| self.0.kept(checksum))
    }

    fn keep(&self, checksum: u32, bytes: &[u8]) {
        off_the_loop(|| self.0.keep(checksum, bytes));
    }
}

/// A shelf whose work blocks only its own vehicle.
#[derive(Debug)]
pub(super) struct BlockingShelf(pub Arc<dyn PlanShelf>);

impl PlanShelf for BlockingShelf {
    fn read(&self, file: &str) -> Result<PlanOnFile, Text> {
        off_the_loop(|| self.0.read(file))
    }

    fn write(&self, file: &str, kind: ListKind, document: &Document) -> Result<String, Text> {
        off_the_loop(|| self.0.write(file, kind, document))
    }

    fn keep(&self, vehicle: VehicleId, kind: ListKind, document: &Document) -> bool {
        off_the_loop(|| self.0.keep(vehicle, kind, document))
    }

    fn release(&self, vehicle: VehicleId, kind: ListKind) {
        off_the_loop(|| self.0.release(vehicle, kind));
    }

    fn kept(&self, vehicle: VehicleId) -> Vec<(ListKind, String)> {
        off_the_loop(|| self.0.kept(vehicle))
    }
}

/// The keys of a link; writing their file blocks only the vehicle whose key changes.
#[derive(Debug)]
struct BlockingDesk(SignedLink);

impl KeyDesk for BlockingDesk {
    fn begin(&self, vehicle: SystemId, change: SigningChange) -> Result<(), Text> {
        off_the_loop(|| self.0.begin(vehicle, change))
    }

    fn requires_signatures(&self) -> bool {
        self.0.requires_signatures()
    }

    fn message(&self, vehicle: MavAddress, which: SentKey) -> Option<Outgoing> {
        off_the_loop(|| self.0.message(vehicle, which))
    }

    fn proved(&self, vehicle: SystemId, change: SigningChange) -> Result<(), Text> {
        off_the_loop(|| self.0.proved(vehicle, change))
    }
}

/// The keys for the vehicles of a link; `None` if its frames need no signatures.
pub(super) fn desk_of(link: &LinkHandle) -> Option<Arc<dyn KeyDesk>> {
    let desk = BlockingDesk(link.signing()?);
    Some(Arc::new(desk))
}

/// Does blocking work while other threads continue with the other tasks.
fn off_the_loop<T>(work: impl FnOnce() -> T) -> T {
    let flavor = Handle::try_current().map(|it| it.runtime_flavor());
    match flavor {
        Ok(RuntimeFlavor::MultiThread) => block_in_place(work),
        // A single-threaded runtime has no other thread for its tasks.
        Ok(_) | Err(_) => work(),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc;

    use super::*;
    use crate::session::ListedLog;

    /// A disk that answers only after another task has run.
    #[derive(Debug)]
    struct SlowDisk(std::sync::Mutex<mpsc::Receiver<()>>);

    impl LogKeeper for SlowDisk {
        fn find(&self, log: &VehicleLog) -> Result<KeptLog, Text> {
            let other = self.0.lock().expect("no panic");
            other.recv().expect("the other task runs meanwhile");
            Ok(KeptLog {
                gaps: GapMap::new(log.log.size),
                samples: Vec::new(),
                file: None,
            })
        }

        fn keep(&self, _: &VehicleLog, _: &[FileBytes], _: &GapMap) -> Result<(), Text> {
            Ok(())
        }

        fn checksum(&self, _: &VehicleLog) -> Result<u32, Text> {
            Ok(0)
        }

        fn finish(&self, _: &VehicleLog) -> Result<String, Text> {
            Ok(String::new())
        }
    }

    #[tokio::test(flavor = "multi_thread", worker_threads = 1)]
    async fn a_slow_disk_holds_up_no_other_task() {
        let (sender, receiver) = mpsc::channel();
        let keeper = BlockingKeeper(Arc::new(SlowDisk(receiver.into())));
        let log = VehicleLog {
            vehicle: 1,
            log: ListedLog {
                number: 1,
                size: 100,
                time_utc_s: 0,
            },
            folder: None,
        };
        let reading = tokio::spawn(async move { keeper.find(&log) });
        let other = tokio::spawn(async move { sender.send(()) });
        assert!(other.await.expect("it ran").is_ok());
        assert!(reading.await.expect("it ended").is_ok());
    }
}
