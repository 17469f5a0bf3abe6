//! Hangars that are services.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, mpsc};
use std::time::Duration;

use futures_util::future::join_all;
use tokio::sync::watch;
use tokio_util::sync::CancellationToken;

use super::spread::spread;
use super::{InstancePlace, LaunchedVehicle, Seen};
use crate::hangar::client::{ClientError, HangarView, RemoteHangar};
use crate::hangar::{Capacity, HangarRefusal, Instance, InstanceId, Launch, OutputLine, SitlStage};

/// An instance ends after this long without an attached program: the console was killed, or cut off.
const IDLE_S: u32 = 60;
/// How long a console waits for the hangars when it closes.
const STOP_WITHIN: Duration = Duration::from_secs(2);
/// The maximum number of vehicles ended at once: fewer than the connections that a hangar accepts.
const AT_ONCE: usize = 32;
const SYSTEM_MAX: u8 = 254;

/// Services, and the vehicles launched through them.
pub(super) struct Far {
    services: Vec<RemoteHangar>,
    fleet: Arc<FarFleet>,
    cancel: CancellationToken,
}

struct FarFleet {
    ours: Mutex<BTreeMap<InstancePlace, Ours>>,
    seen: watch::Sender<Seen>,
}

struct Ours {
    shown: Instance,
    /// The run of the service that launched the vehicle.
    remote: RemoteHangar,
    life: String,
    /// Whether the service has listed the vehicle: before that, a missing one may still appear.
    is_known: bool,
    /// Whether the vehicle is gone, so its number may be reused.
    is_gone: bool,
    tunnel: CancellationToken,
}

impl Far {
    pub fn new(services: Vec<RemoteHangar>) -> Self {
        let fleet = Arc::new(FarFleet {
            ours: Mutex::default(),
            seen: watch::Sender::default(),
        });
        let cancel = CancellationToken::new();
        for (hangar, remote) in services.iter().enumerate() {
            let views = remote.follow(cancel.clone());
            tokio::spawn(keep_up(hangar, views, Arc::clone(&fleet)));
        }
        Self {
            services,
            fleet,
            cancel,
        }
    }

    pub fn seen(&self) -> watch::Receiver<Seen> {
        self.fleet.seen.subscribe()
    }

    pub fn names(&self) -> Vec<String> {
        let name = |remote: &RemoteHangar| remote.address().authority();
        self.services.iter().map(name).collect()
    }

    /// Launches all vehicles, or none.
    pub async fn launch(
        &self,
        mut launches: Vec<Launch>,
    ) -> Result<Vec<LaunchedVehicle>, HangarRefusal> {
        let (plan, lives) = self.plan(launches.len()).await?;
        self.number(&mut launches);
        let at = |hangar: usize| {
            let here = launches.iter().zip(&plan).enumerate();
            here.filter(move |(_, (_, at))| **at == hangar)
                .map(|(place, (launch, _))| (place, launch))
        };
        // The requests to one hangar are sent one after another; different hangars get theirs in parallel.
        let asked = (0..self.services.len()).map(async |hangar| {
            let mut begun = Vec::new();
            for (place, launch) in at(hangar) {
                let one = self.launch_at(hangar, &lives[hangar], launch).await;
                let is_over = one.is_err();
                begun.push((place, one));
                if is_over {
                    break;
                }
            }
            begun
        });
        let mut begun: Vec<_> = join_all(asked).await.into_iter().flatten().collect();
        begun.sort_by_key(|(place, _)| *place);
        let mut launched = Vec::new();
        let mut refused = None;
        for (_, one) in begun {
            match one {
                Ok(vehicle) => launched.push(vehicle),
                Err(refusal) => refused = refused.or(Some(refusal)),
            }
        }
        let Some(refusal) = refused else {
            return Ok(launched);
        };
        // A vehicle that cannot be stopped now ends on its own, because no program is attached.
        join_all(launched.iter().map(|vehicle| self.stop(vehicle.place))).await;
        Err(refusal)
    }

    /// A hangar for each vehicle, and the current run of each hangar. A hangar that does not answer counts as full.
    async fn plan(&self, count: usize) -> Result<(Vec<usize>, Vec<String>), HangarRefusal> {
        let asked = self.services.iter().map(RemoteHangar::status);
        let (mut rooms, mut lives, mut silent) = (Vec::new(), Vec::new(), None);
        for (remote, status) in self.services.iter().zip(join_all(asked).await) {
            match status {
                Ok(status) => {
                    rooms.push(status.capacity);
                    lives.push(status.life);
                }
                Err(error) => {
                    rooms.push(Capacity {
                        running: 0,
                        free: 0,
                    });
                    lives.push(String::new());
                    silent = silent.or(Some(far(remote, error)));
                }
            }
        }
        if let Some(plan) = spread(&rooms, count) {
            return Ok((plan, lives));
        }
        let running = rooms.iter().map(|room| room.running).sum();
        Err(silent.unwrap_or(HangarRefusal::Full(running)))
    }

    /// Sets system ids for launches without one, and the settings that all launches need.
    fn number(&self, launches: &mut [Launch]) {
        let ours = self.fleet.ours();
        let there = ours.values().filter(|one| !one.is_gone);
        let mut taken: BTreeSet<u8> = there.map(|one| one.shown.system).collect();
        taken.extend(launches.iter().filter_map(|launch| launch.system));
        for launch in launches {
            if launch.system.is_none() {
                launch.system = (1..=SYSTEM_MAX).find(|system| !taken.contains(system));
                taken.extend(launch.system);
            }
            // Other consoles may also use the service.
            launch.id = None;
            launch.idle_s.get_or_insert(IDLE_S);
        }
    }

    async fn launch_at(
        &self,
        hangar: usize,
        life: &str,
        launch: &Launch,
    ) -> Result<LaunchedVehicle, HangarRefusal> {
        let remote = self.services[hangar].in_life(life);
        let launched = remote.launch(launch).await;
        let shown = launched.map_err(|error| far(&remote, error))?;
        let (id, system) = (shown.id, shown.system);
        let place = InstancePlace { hangar, id };
        let tunnel = self.cancel.child_token();
        let pipe = remote.tunnel(id, tunnel.clone());
        let ours = Ours {
            shown,
            remote,
            life: life.to_owned(),
            is_known: false,
            is_gone: false,
            tunnel,
        };
        self.fleet.ours().insert(place, ours);
        self.fleet.show();
        Ok(LaunchedVehicle {
            place,
            system,
            pipe,
        })
    }

    pub async fn restart(&self, place: InstancePlace) -> Result<(), HangarRefusal> {
        let remote = self.fleet.remote(place)?;
        let asked = remote.restart(place.id).await;
        asked.map_err(|error| far(&remote, error))
    }

    pub async fn stop(&self, place: InstancePlace) -> Result<(), HangarRefusal> {
        let remote = self.fleet.remote(place);
        let ours = self.fleet.ours().remove(&place);
        if let Some(ours) = ours {
            ours.tunnel.cancel();
        }
        self.fleet.show();
        let remote = remote?;
        let asked = remote.stop(place.id).await;
        asked.map_err(|error| far(&remote, error))
    }

    pub async fn output(
        &self,
        place: InstancePlace,
        since: u64,
    ) -> Result<Vec<OutputLine>, HangarRefusal> {
        let remote = self.fleet.remote(place)?;
        let told = remote.output(place.id, since).await;
        told.map_err(|error| far(&remote, error))
    }

    pub async fn close(self) {
        let places: Vec<InstancePlace> = self.fleet.ours().keys().copied().collect();
        join_all(places.into_iter().map(|place| self.stop(place))).await;
    }
}

impl Drop for Far {
    /// Requests that the services end the launched vehicles, within [`STOP_WITHIN`]; the other
    /// vehicles end on their own.
    fn drop(&mut self) {
        self.cancel.cancel();
        let ours = std::mem::take(&mut *self.fleet.ours());
        let there = ours.into_iter().filter(|(_, one)| !one.is_gone);
        let orders: Vec<_> = there.map(|(place, one)| (place.id, one.remote)).collect();
        if orders.is_empty() {
            return;
        }
        // The runtime that drops this may be shutting down, and must not block: use a thread with its own runtime.
        let (done, told) = mpsc::channel();
        let thread = std::thread::Builder::new().name("stop-sitl".to_owned());
        let begun = thread.spawn(move || {
            let _ = stop_all(&orders);
            let _ = done.send(());
        });
        if begun.is_ok() {
            let _ = told.recv_timeout(STOP_WITHIN);
        }
    }
}

/// Ends instances, for callers without a runtime.
fn stop_all(orders: &[(InstanceId, RemoteHangar)]) -> std::io::Result<()> {
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()?;
    runtime.block_on(async {
        for some in orders.chunks(AT_ONCE) {
            join_all(some.iter().map(|(id, remote)| remote.stop(*id))).await;
        }
    });
    Ok(())
}

impl FarFleet {
    fn ours(&self) -> MutexGuard<'_, BTreeMap<InstancePlace, Ours>> {
        self.ours.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn remote(&self, place: InstancePlace) -> Result<RemoteHangar, HangarRefusal> {
        let ours = self.ours();
        let there = ours.get(&place).filter(|one| !one.is_gone);
        let remote = there.map(|one| one.remote.clone());
        remote.ok_or(HangarRefusal::Unknown(place.id))
    }

    /// Publishes the launched vehicles.
    fn show(&self) {
        let ours = self.ours();
        let all: Vec<_> = ours
            .iter()
            .map(|(place, one)| (*place, one.shown.clone()))
            .collect();
        self.seen.send_if_modified(|seen| {
            let changed = **seen != all;
            if changed {
                *seen = Arc::new(all);
            }
            changed
        });
    }
}

/// Follows a service until its stream ends.
async fn keep_up(hangar: usize, mut views: watch::Receiver<HangarView>, fleet: Arc<FarFleet>) {
    loop {
        let view = views.borrow_and_update().clone();
        for (place, ours) in &mut *fleet.ours() {
            if place.hangar == hangar && !ours.is_gone {
                ours.look(&view);
            }
        }
        fleet.show();
        if views.changed().await.is_err() {
            return;
        }
    }
}

impl Ours {
    fn look(&mut self, view: &HangarView) {
        if let Some(error) = &view.lost {
            let name = self.remote.address().authority();
            self.end(format!("hangar {name} does not answer: {error}"));
            return;
        }
        if view.life.as_ref().is_some_and(|life| *life != self.life) {
            self.forget("its hangar was restarted");
            return;
        }
        match view.instances.get(&self.shown.id) {
            Some(instance) => {
                self.is_known = true;
                self.shown = instance.clone();
            }
            None if self.is_known => self.forget("its hangar no longer has it"),
            None => {}
        }
    }

    fn end(&mut self, why: String) {
        self.shown.stage = SitlStage::Ended;
        self.shown.fault = Some(why);
        self.shown.attached = false;
    }

    fn forget(&mut self, why: &str) {
        self.end(why.to_owned());
        self.is_gone = true;
        self.tunnel.cancel();
    }
}

fn far(remote: &RemoteHangar, source: ClientError) -> HangarRefusal {
    HangarRefusal::Far {
        hangar: remote.address().authority(),
        source,
    }
}
