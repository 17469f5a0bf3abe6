//! The hangars that a console has at hand: its own within this program, or services.

use std::sync::Arc;

use tokio::io::DuplexStream;
use tokio::sync::watch;

use super::{Hangar, Instance, InstanceId, Launch, Refusal};

/// Where an instance is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Place {
    /// The hangar, by its place in the list.
    pub hangar: usize,
    /// The instance there.
    pub id: InstanceId,
}

/// A vehicle that was launched, with the bytes of its serial 0.
#[derive(Debug)]
pub struct Berth {
    /// Where it is.
    pub place: Place,
    /// Its bytes, also after it was started again.
    pub pipe: DuplexStream,
}

/// The instances of all hangars that were launched by this console.
pub type Seen = Arc<Vec<(Place, Instance)>>;

/// The hangars. Dropping them ends what was launched by them.
pub struct Hangars {
    own: Hangar,
    seen: watch::Receiver<Seen>,
}

impl Hangars {
    /// One hangar within this program.
    pub fn own(own: Hangar) -> Self {
        let mut instances = own.instances();
        let (sender, seen) = watch::channel(Seen::default());
        tokio::spawn(async move {
            loop {
                let all = instances.borrow_and_update().clone();
                let here = |(&id, instance): (&InstanceId, &Instance)| {
                    (Place { hangar: 0, id }, instance.clone())
                };
                sender.send_replace(Arc::new(all.iter().map(here).collect()));
                if instances.changed().await.is_err() {
                    return;
                }
            }
        });
        Self { own, seen }
    }

    /// What the hangars are called, in order.
    pub fn names(&self) -> Vec<String> {
        vec!["here".to_owned()]
    }

    /// Launches vehicles, spread over the hangars by how much room each has: all, or none.
    ///
    /// # Errors
    /// Why one of them could not be launched.
    pub async fn launch(&self, launches: Vec<Launch>) -> Result<Vec<Berth>, Refusal> {
        let mut berths = Vec::new();
        for launch in launches {
            let id = self.own.launch(launch).await?;
            let pipe = self.own.attach(id).await?;
            berths.push(Berth {
                place: Place { hangar: 0, id },
                pipe,
            });
        }
        Ok(berths)
    }

    /// How the vehicles are doing, now and from now on.
    pub fn instances(&self) -> watch::Receiver<Seen> {
        self.seen.clone()
    }

    /// Ends an instance's process, if there is one, and starts it again.
    ///
    /// # Errors
    /// There is no such instance.
    pub async fn restart(&self, place: Place) -> Result<(), Refusal> {
        self.own.restart(place.id).await
    }

    /// Ends an instance.
    ///
    /// # Errors
    /// There is no such instance.
    pub async fn stop(&self, place: Place) -> Result<(), Refusal> {
        self.own.stop(place.id).await
    }
}
