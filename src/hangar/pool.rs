//! The hangars of a console: one within this program, or services.
//!
//! `spread` chooses among services; `far` launches through them and follows them.

use std::sync::Arc;

use tokio::io::DuplexStream;
use tokio::sync::watch;

use super::client::RemoteHangar;
use super::{Hangar, HangarRefusal, Instance, InstanceId, Launch, OutputLine};

mod far;
mod spread;

/// The hangar and the number of an instance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct InstancePlace {
    /// The hangar, by its index in the list.
    pub hangar: usize,
    pub id: InstanceId,
}

/// A launched vehicle with the byte stream of its serial 0.
#[derive(Debug)]
pub struct LaunchedVehicle {
    pub place: InstancePlace,
    /// Its MAVLink system id.
    pub system: u8,
    /// Its byte stream, across restarts.
    pub pipe: DuplexStream,
}

/// All instances launched by this console.
pub type Seen = Arc<Vec<(InstancePlace, Instance)>>;

/// The hangars. Dropping them ends the vehicles launched through them.
pub struct Hangars {
    at: At,
    seen: watch::Receiver<Seen>,
}

enum At {
    Own(Hangar),
    Far(far::Far),
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
                    (InstancePlace { hangar: 0, id }, instance.clone())
                };
                sender.send_replace(Arc::new(all.iter().map(here).collect()));
                if instances.changed().await.is_err() {
                    return;
                }
            }
        });
        let at = At::Own(own);
        Self { at, seen }
    }

    /// Services, which are followed from now on. Their vehicles end a minute after this program has been killed. Must
    /// be called inside a tokio runtime.
    pub fn far(services: Vec<RemoteHangar>) -> Self {
        let far = far::Far::new(services);
        let seen = far.seen();
        let at = At::Far(far);
        Self { at, seen }
    }

    /// The names of the hangars, in order.
    pub fn names(&self) -> Vec<String> {
        match &self.at {
            At::Own(_) => vec!["here".to_owned()],
            At::Far(far) => far.names(),
        }
    }

    /// Launches vehicles, distributed over the hangars by their free capacity; launches all of them or none. The result
    /// is in the order of the launches.
    ///
    /// Services number the vehicles themselves. A vehicle without a system id gets one that is unique in this console.
    ///
    /// # Errors
    /// One of them could not be launched.
    pub async fn launch(
        &self,
        launches: Vec<Launch>,
    ) -> Result<Vec<LaunchedVehicle>, HangarRefusal> {
        match &self.at {
            At::Own(own) => launch_here(own, launches).await,
            At::Far(far) => far.launch(launches).await,
        }
    }

    /// A receiver of the vehicles' states. Vehicles of a service that does not answer count as
    /// ended, with the reason, until it answers again.
    pub fn instances(&self) -> watch::Receiver<Seen> {
        self.seen.clone()
    }

    /// Ends an instance's process, if there is one, and starts it again.
    ///
    /// # Errors
    /// No instance has that number.
    pub async fn restart(&self, place: InstancePlace) -> Result<(), HangarRefusal> {
        match &self.at {
            At::Own(own) => own.restart(place.id).await,
            At::Far(far) => far.restart(place).await,
        }
    }

    /// Ends an instance.
    ///
    /// # Errors
    /// No instance has that number.
    pub async fn stop(&self, place: InstancePlace) -> Result<(), HangarRefusal> {
        match &self.at {
            At::Own(own) => own.stop(place.id).await,
            At::Far(far) => far.stop(place).await,
        }
    }

    /// An instance's output, starting with the line of this number if it is still stored; with 0, all of it.
    ///
    /// # Errors
    /// No instance has that number, or its hangar does not answer.
    pub async fn output(
        &self,
        place: InstancePlace,
        since: u64,
    ) -> Result<Vec<OutputLine>, HangarRefusal> {
        match &self.at {
            At::Own(own) => own.output(place.id, since),
            At::Far(far) => far.output(place, since).await,
        }
    }

    /// Ends all launched vehicles, and waits until they are gone or their hangar does not answer.
    pub async fn close(self) {
        match self.at {
            At::Own(own) => own.close().await,
            At::Far(far) => far.close().await,
        }
    }
}

async fn launch_here(
    own: &Hangar,
    launches: Vec<Launch>,
) -> Result<Vec<LaunchedVehicle>, HangarRefusal> {
    let mut launched: Vec<LaunchedVehicle> = Vec::new();
    for launch in launches {
        let begun = async {
            let id = own.launch(launch).await?;
            let attached = attach_here(own, id).await;
            if attached.is_err() {
                drop(own.stop(id).await);
            }
            attached
        };
        match begun.await {
            Ok(vehicle) => launched.push(vehicle),
            Err(refusal) => {
                for vehicle in launched {
                    // An instance that has ended in the meantime is not an error.
                    drop(own.stop(vehicle.place.id).await);
                }
                return Err(refusal);
            }
        }
    }
    Ok(launched)
}

async fn attach_here(own: &Hangar, id: InstanceId) -> Result<LaunchedVehicle, HangarRefusal> {
    let system = own.instances().borrow().get(&id).map(|one| one.system);
    Ok(LaunchedVehicle {
        place: InstancePlace { hangar: 0, id },
        system: system.ok_or(HangarRefusal::Unknown(id))?,
        pipe: own.attach(id).await?,
    })
}
