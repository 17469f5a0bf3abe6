//! A mission on ArduPilot's SITL: starts its processes, flies, and ends them.

use std::cell::RefCell;
use std::time::{Duration, Instant};

use anyhow::{anyhow, bail};
use futures_util::FutureExt as _;
use futures_util::future::join_all;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _, DuplexStream, ReadHalf, WriteHalf};
use tokio::signal::unix::{SignalKind, signal};
use tokio::sync::{mpsc, watch};
use tokio::time::{MissedTickBehavior, interval, timeout};

use super::recorder::RunRecorder;
use crate::cli::{Failure, runtime};
use crate::exercise::{Exercise, LiveStreams};
use crate::hangar::{
    Hangars, Instance, InstancePlace, Launch, LaunchedVehicle, Seen, SitlSource, SitlStage,
};
use crate::mission::Report;

const READY_WITHIN: Duration = Duration::from_secs(120);
const ENDED_WITHIN: Duration = Duration::from_secs(10);
/// The interval of checks while no vehicle sends anything.
const LOOK_EVERY: Duration = Duration::from_millis(5);
/// The maximum number of pieces of output in a queue.
const PIECES_KEPT: usize = 256;
const PIECE_LEN: usize = 4096;

/// Starts the vehicles, flies, and ends them in every case.
///
/// # Errors
/// The vehicles cannot be started or do not become ready, or the user interrupts the run.
pub(super) fn fly(
    source: &SitlSource,
    launches: Vec<Launch>,
    live: Exercise<LiveStreams>,
    recorder: &mut RunRecorder<'_>,
) -> Result<Report, Failure> {
    let runtime = runtime()?;
    let flown = runtime.block_on(async {
        let hangars = source.open().map_err(|text| anyhow!(text.to_string()))?;
        let places = RefCell::default();
        let flown = tokio::select! {
            flown = session(&hangars, launches, &places, live, recorder) => flown,
            () = interrupted() => Err(anyhow!("interrupted")),
        };
        let ended = join_all(places.take().into_iter().map(|place| hangars.stop(place)));
        // A process that has already ended needs no stop; one that does not end in time ends with the hangar.
        let _ = timeout(ENDED_WITHIN, ended).await;
        flown
    });
    runtime.shutdown_background();
    Ok(flown?)
}

async fn session(
    hangars: &Hangars,
    launches: Vec<Launch>,
    taken: &RefCell<Vec<InstancePlace>>,
    live: Exercise<LiveStreams>,
    recorder: &mut RunRecorder<'_>,
) -> anyhow::Result<Report> {
    let started = Instant::now();
    let launched = hangars.launch(launches).await?;
    let places: Vec<InstancePlace> = launched.iter().map(|vehicle| vehicle.place).collect();
    taken.replace(places.clone());
    let (pieces, heard) = mpsc::channel(PIECES_KEPT);
    let mut fleet = SitlFleet {
        places,
        senders: forward_output(launched, &pieces),
        heard,
        seen: hangars.instances(),
    };
    match timeout(READY_WITHIN, fleet.get_ready()).await {
        Ok(ready) => ready?,
        Err(_) => bail!(
            "not all vehicles were ready after {} s",
            READY_WITHIN.as_secs()
        ),
    }
    tell!(
        "ready after {:.1} s: the mission begins",
        started.elapsed().as_secs_f64()
    );
    Ok(fleet.fly(live, recorder).await)
}

async fn interrupted() {
    let terminated = async {
        match signal(SignalKind::terminate()) {
            Ok(mut signal) => drop(signal.recv().await),
            Err(_) => std::future::pending().await,
        }
    };
    tokio::select! {
        _ = tokio::signal::ctrl_c() => {}
        () = terminated => {}
    }
}

/// A vehicle's output: its index, and the bytes.
type Piece = (usize, Vec<u8>);

/// Forwards the vehicles' output; returns their inputs.
fn forward_output(
    launched: Vec<LaunchedVehicle>,
    pieces: &mpsc::Sender<Piece>,
) -> Vec<WriteHalf<DuplexStream>> {
    let forward_output = |(index, vehicle): (usize, LaunchedVehicle)| {
        let (reader, writer) = tokio::io::split(vehicle.pipe);
        tokio::spawn(listen(index, reader, pieces.clone()));
        writer
    };
    launched
        .into_iter()
        .enumerate()
        .map(forward_output)
        .collect()
}

async fn listen(index: usize, mut reader: ReadHalf<DuplexStream>, pieces: mpsc::Sender<Piece>) {
    let mut bytes = vec![0; PIECE_LEN];
    while let Ok(len @ 1..) = reader.read(&mut bytes).await {
        if pieces.send((index, bytes[..len].to_vec())).await.is_err() {
            return;
        }
    }
}

/// The vehicles, in the order of their system ids.
struct SitlFleet {
    places: Vec<InstancePlace>,
    senders: Vec<WriteHalf<DuplexStream>>,
    heard: mpsc::Receiver<Piece>,
    seen: watch::Receiver<Seen>,
}

impl SitlFleet {
    /// Waits until all vehicles can be armed, and prints each change of their state.
    async fn get_ready(&mut self) -> anyhow::Result<()> {
        let mut told: Vec<Option<String>> = vec![None; self.places.len()];
        loop {
            let all = self.seen.borrow_and_update().clone();
            for (place, told) in self.places.iter().zip(&mut told) {
                let Some(instance) = find(&all, *place) else {
                    continue;
                };
                let words = words(instance);
                if told.as_ref() != Some(&words) {
                    tell!("vehicle {}: {words}", instance.system);
                    *told = Some(words);
                }
                if instance.stage == SitlStage::Ended {
                    bail!("{}", obituary(instance));
                }
            }
            let is_ready = |place: &InstancePlace| {
                find(&all, *place).is_some_and(|instance| instance.stage == SitlStage::Ready)
            };
            if self.places.iter().all(is_ready) {
                return Ok(());
            }
            tokio::select! {
                changed = self.seen.changed() => changed?,
                // Output during the boot is evaluated by the hangar.
                Some(_) = self.heard.recv() => {}
            }
        }
    }

    /// Carries bytes between the vehicles and the mission until the mission is over.
    async fn fly(
        &mut self,
        mut live: Exercise<LiveStreams>,
        recorder: &mut RunRecorder<'_>,
    ) -> Report {
        let begun = Instant::now();
        let mut looks = interval(LOOK_EVERY);
        looks.set_missed_tick_behavior(MissedTickBehavior::Delay);
        while !live.is_over() {
            tokio::select! {
                Some((index, bytes)) = self.heard.recv() => {
                    live.hear(index, &bytes, begun.elapsed());
                    while let Ok((index, bytes)) = self.heard.try_recv() {
                        live.hear(index, &bytes, begun.elapsed());
                    }
                }
                Ok(()) = self.seen.changed() => self.note_losses(&mut live),
                _ = looks.tick() => {}
            }
            live.pass(begun.elapsed());
            for (index, sender) in self.senders.iter_mut().enumerate() {
                let bytes = live.take_output(index);
                if !bytes.is_empty() {
                    // Input for a vehicle that has ended is dropped.
                    let _ = sender.write(&bytes).now_or_never();
                }
            }
            for notice in live.take_notices() {
                recorder.tell(notice);
            }
            recorder.keep(&mut live);
        }
        let (flown, took) = (live.now().as_secs_f64(), begun.elapsed().as_secs_f64());
        tracing::info!("{flown:.1} s flown in {took:.1} s");
        let report = live.close();
        recorder.finish(&mut live);
        report
    }

    /// Marks the vehicles whose processes have ended as lost.
    fn note_losses(&mut self, live: &mut Exercise<LiveStreams>) {
        let all = self.seen.borrow_and_update().clone();
        for (index, place) in self.places.iter().enumerate() {
            let instance = find(&all, *place);
            let is_gone = instance.is_none_or(|instance| instance.stage == SitlStage::Ended);
            if is_gone
                && live.lose(index)
                && let Some(ended) = instance
            {
                let obituary = obituary(ended);
                tracing::error!("{obituary}");
                tell!("{obituary}");
            }
        }
    }
}

fn find(all: &Seen, wanted: InstancePlace) -> Option<&Instance> {
    let mut all = all.iter();
    all.find_map(|(place, instance)| (*place == wanted).then_some(instance))
}

/// The state of a vehicle, and the condition that is not met yet.
fn words(instance: &Instance) -> String {
    let stage = match instance.stage {
        SitlStage::Queued => "waiting to be started".to_owned(),
        SitlStage::Process => "its process runs".to_owned(),
        SitlStage::Heartbeat => "it is in contact".to_owned(),
        SitlStage::Parameters => format!("all {} parameters received", instance.parameters[1]),
        SitlStage::Position => "its position is known".to_owned(),
        SitlStage::Ready => "it can be armed".to_owned(),
        SitlStage::Stopping => "its process is being stopped".to_owned(),
        SitlStage::Ended => "its process has ended".to_owned(),
    };
    match &instance.hint {
        Some(hint) => format!("{stage} ({hint})"),
        None => stage,
    }
}

/// Why a vehicle has ended, with the last output of its process.
fn obituary(instance: &Instance) -> String {
    let fault = instance.fault.as_deref().unwrap_or("it was ended");
    let mut text = format!("vehicle {}: {fault}", instance.system);
    for line in &instance.last_output {
        text.push_str("\n  ");
        text.push_str(line);
    }
    text
}
