//! The hangars that a console has at hand: its own within this program, or services.
//!
//! `spread` chooses among services; `far` launches by them and keeps up with them.

use std::sync::Arc;

use tokio::io::DuplexStream;
use tokio::sync::watch;

use super::client::RemoteHangar;
use super::{Hangar, HangarRefusal, Instance, InstanceId, Launch, OutputLine};

mod far;
mod spread;

/// Where an instance is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct InstancePlace {
    /// The hangar, by its place in the list.
    pub hangar: usize,
    pub id: InstanceId,
}

/// A vehicle that was launched, with the bytes of its serial 0.
#[derive(Debug)]
pub struct LaunchedVehicle {
    pub place: InstancePlace,
    /// Its bytes, also after it was started again.
    pub pipe: DuplexStream,
}

/// The instances of all hangars that were launched by this console.
pub type Seen = Arc<Vec<(InstancePlace, Instance)>>;

/// The hangars. Dropping them ends what was launched by them.
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

    /// Services, which are followed from now on. What is launched by them ends by itself a minute after this
    /// program has been killed. Must be called inside a tokio runtime.
    pub fn far(services: Vec<RemoteHangar>) -> Self {
        let far = far::Far::new(services);
        let seen = far.seen();
        let at = At::Far(far);
        Self { at, seen }
    }

    /// What the hangars are called, in order.
    pub fn names(&self) -> Vec<String> {
        match &self.at {
            At::Own(_) => vec!["here".to_owned()],
            At::Far(far) => far.names(),
        }
    }

    /// Launches vehicles, spread over the hangars by how much room each has: all, or none. They are in the
    /// order of the launches.
    ///
    /// Services number the vehicles themselves, and give a system id to those that have none: one that no other
    /// vehicle of this console has.
    ///
    /// # Errors
    /// Why one of them could not be launched.
    pub async fn launch(
        &self,
        launches: Vec<Launch>,
    ) -> Result<Vec<LaunchedVehicle>, HangarRefusal> {
        match &self.at {
            At::Own(own) => launch_here(own, launches).await,
            At::Far(far) => far.launch(launches).await,
        }
    }

    /// How the vehicles are doing, now and from now on. Those of a service that does not answer are shown as ended,
    /// with the reason, until it answers again.
    pub fn instances(&self) -> watch::Receiver<Seen> {
        self.seen.clone()
    }

    /// Ends an instance's process, if there is one, and starts it again.
    ///
    /// # Errors
    /// There is no such instance.
    pub async fn restart(&self, place: InstancePlace) -> Result<(), HangarRefusal> {
        match &self.at {
            At::Own(own) => own.restart(place.id).await,
            At::Far(far) => far.restart(place).await,
        }
    }

    /// Ends an instance.
    ///
    /// # Errors
    /// There is no such instance.
    pub async fn stop(&self, place: InstancePlace) -> Result<(), HangarRefusal> {
        match &self.at {
            At::Own(own) => own.stop(place.id).await,
            At::Far(far) => far.stop(place).await,
        }
    }

    /// What an instance has printed, from the line with this number on, as far as it is kept; with 0 all of that.
    ///
    /// # Errors
    /// There is no such instance, or its hangar does not tell.
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

    /// Ends what was launched, and waits until it is gone or its hangar does not answer.
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
            match own.attach(id).await {
                Ok(pipe) => Ok((id, pipe)),
                Err(refusal) => {
                    drop(own.stop(id).await);
                    Err(refusal)
                }
            }
        };
        match begun.await {
            Ok((id, pipe)) => {
                let place = InstancePlace { hangar: 0, id };
                launched.push(LaunchedVehicle { place, pipe });
            }
            Err(refusal) => {
                for vehicle in launched {
                    // One that has ended meanwhile is as good.
                    drop(own.stop(vehicle.place.id).await);
                }
                return Err(refusal);
            }
        }
    }
    Ok(launched)
}
