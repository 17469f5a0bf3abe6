//! Steps the world of a simulator at its pace, between the inputs and the outputs of its vehicles.

use std::sync::Arc;
use std::time::Duration;

use tokio::sync::{mpsc, oneshot, watch};
use tokio::task::yield_now;
use tokio::time::{Instant, MissedTickBehavior, interval};
use tokio_util::sync::CancellationToken;

use super::inputs::WorldRecord;
use super::places::{PlaceFeed, TruePlaces};
use super::transport::Transports;
use super::{PaceFeed, SPEEDUP_MAX};
use crate::sim::{STEP, World};

/// At this many simulated vehicle seconds per second or more, steps are distributed over threads. Below that, one core
/// suffices, and scheduling another thread takes longer than the work.
const SHARED_FROM: f64 = 20_000.0;
/// The maximum delay that the simulation makes up at once; with a longer delay, it falls behind real time.
const CATCH_UP: Duration = Duration::from_millis(50);
/// At high speed, ground stations are served after this many steps.
const STEPS_PER_ROUND: usize = 10;

/// A request to a running simulator, which it also answers while it is held.
enum WorldRequest {
    /// Send a copy of the world.
    Copy(oneshot::Sender<World>),
    /// Go on with this world, which is a copy of an earlier time; what waits on the way to or from its ground stations
    /// is dropped, and inputs are not recorded any more.
    Replace(Box<World>, oneshot::Sender<()>),
}

/// The way to copy and replace the world of a running simulator.
#[derive(Debug, Clone)]
pub struct WorldHandle(mpsc::Sender<WorldRequest>);

impl WorldHandle {
    /// A copy of the world as it is; `None` if the simulator has ended.
    pub async fn copy(&self) -> Option<World> {
        let (answer, copied) = oneshot::channel();
        self.0.send(WorldRequest::Copy(answer)).await.ok()?;
        copied.await.ok()
    }

    /// Replaces the world with an earlier copy; returns whether the simulator continues from that copy.
    pub async fn replace(&self, world: World) -> bool {
        let (answer, replaced) = oneshot::channel();
        let request = WorldRequest::Replace(Box::new(world), answer);
        self.0.send(request).await.is_ok() && replaced.await.is_ok()
    }
}

fn threads(vehicles: usize, speedup: f64) -> usize {
    if vehicles as f64 * speedup < SHARED_FROM {
        return 1;
    }
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Steps a world on several threads. Vehicles do not interact within a step, so the result is the same.
pub fn step_on_threads(world: &mut World, threads: usize) {
    if threads < 2 {
        world.step();
        return;
    }
    world.step_in_parts(threads, |mut parts| {
        let own = parts.pop();
        std::thread::scope(|scope| {
            for part in parts {
                scope.spawn(|| part.step());
            }
            if let Some(own) = own {
                own.step();
            }
        });
    });
}

/// The world of a running simulator, with all that its steps feed.
pub struct SteppedWorld {
    world: World,
    transports: Transports,
    count: watch::Sender<usize>,
    passed: watch::Sender<u64>,
    places: PlaceFeed,
    threads: usize,
    record: Option<WorldRecord>,
    requests: mpsc::Receiver<WorldRequest>,
}

/// What is known of a world that is stepped by a task.
pub struct WorldOutlets {
    /// The number of connected ground stations.
    pub connections: watch::Receiver<usize>,
    /// The number of steps whose output was sent.
    pub steps: watch::Receiver<u64>,
    pub handle: WorldHandle,
    pub places: TruePlaces,
}

impl SteppedWorld {
    pub fn new(
        world: World,
        transports: Transports,
        record: Option<WorldRecord>,
    ) -> (Self, WorldOutlets) {
        let (count, connections) = watch::channel(world.connections());
        let (passed, steps) = watch::channel(world.steps());
        let (handle, requests) = mpsc::channel(1);
        let places = watch::Sender::new(Arc::default());
        let outlets = WorldOutlets {
            connections,
            steps,
            handle: WorldHandle(handle),
            places: places.clone(),
        };
        let stepped = Self {
            world,
            transports,
            count,
            passed,
            places: PlaceFeed::new(places),
            threads: 1,
            record,
            requests,
        };
        (stepped, outlets)
    }

    /// Steps the world at a pace until cancelled.
    pub async fn run(mut self, feed: PaceFeed, cancel: CancellationToken) {
        let mut wake = interval(STEP);
        wake.set_missed_tick_behavior(MissedTickBehavior::Skip);
        let mut last = Instant::now();
        let mut owed = Duration::ZERO;
        loop {
            tokio::select! {
                () = cancel.cancelled() => return self.end(),
                Some(request) = self.requests.recv() => self.serve(request),
                _ = wake.tick() => {}
            }
            let now = Instant::now();
            let given = *feed.0.borrow();
            if given.held {
                last = now;
                continue;
            }
            self.threads = threads(self.world.vehicles(), given.speedup);
            // A vehicle whose speed-up has changed sets it for all.
            let wanted = self.world.wanted_speedup();
            let pace = wanted.unwrap_or(given.speedup).min(SPEEDUP_MAX);
            owed += (now - last).min(CATCH_UP).mul_f64(pace);
            last = now;
            if let Some(record) = &mut self.record {
                record.note_pace(&self.world, pace);
            }
            self.transports.read(&mut self.world);
            let mut steps = 0;
            while owed >= STEP {
                owed -= STEP;
                self.step();
                steps += 1;
                if steps % STEPS_PER_ROUND == 0 {
                    self.write();
                    yield_now().await;
                    if cancel.is_cancelled() {
                        return self.end();
                    }
                    self.transports.read(&mut self.world);
                }
            }
            self.write();
            self.count_connections();
        }
    }

    fn serve(&mut self, request: WorldRequest) {
        match request {
            WorldRequest::Copy(answer) => drop(answer.send(self.world.copy())),
            WorldRequest::Replace(world, answer) => {
                self.transports.drop_traffic(&mut self.world);
                self.end();
                self.record = None;
                self.world = *world;
                self.places.start_again();
                self.places.publish(&self.world);
                self.passed.send_replace(self.world.steps());
                let _ = answer.send(());
            }
        }
    }

    fn step(&mut self) {
        step_on_threads(&mut self.world, self.threads);
        if let Some(record) = &mut self.record {
            record.follow(&mut self.world);
        }
    }

    fn write(&mut self) {
        if let Some(record) = &mut self.record {
            record.publish();
        }
        self.passed.send_replace(self.world.steps());
        self.places.publish(&self.world);
        self.transports.write(&mut self.world);
    }

    fn end(&mut self) {
        if let Some(record) = &mut self.record {
            record.end(&mut self.world);
        }
    }

    fn count_connections(&self) {
        let now = self.world.connections();
        self.count.send_if_modified(|count| {
            let changed = *count != now;
            *count = now;
            changed
        });
    }
}
