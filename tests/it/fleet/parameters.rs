//! Parameters of simulated vehicles over pipes that lose packets.

use std::time::Duration;

use sortie::fleet::FleetEvent;
use sortie::ledger::RowState;
use sortie::link::{Endpoint, Simulator, Transport};
use sortie::parameters::{Fetching, ParameterSnapshot};
use sortie::vehicle::VehicleId;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _, DuplexStream, duplex};
use tokio_util::sync::CancellationToken;

use super::{Console, world};

/// The first byte of a `MAVLink` 2 packet, the number of its bytes besides the payload, and that of
/// a signature.
const MAGIC: u8 = 0xFD;
const AROUND_PAYLOAD: usize = 12;
const SIGNATURE: usize = 13;
/// `PARAM_REQUEST_READ`, `PARAM_REQUEST_LIST`, `PARAM_VALUE`, `PARAM_SET`.
const PARAMETER_MESSAGES: std::ops::RangeInclusive<u8> = 20..=23;

/// Passes packets from one pipe to another, except every n-th one about parameters.
async fn carry(
    mut from: tokio::io::ReadHalf<DuplexStream>,
    mut to: tokio::io::WriteHalf<DuplexStream>,
    nth: usize,
) {
    let (mut buffer, mut chunk, mut count) = (Vec::new(), [0; 4096], 0);
    while let Ok(read) = from.read(&mut chunk).await {
        if read == 0 {
            return;
        }
        buffer.extend_from_slice(&chunk[..read]);
        while let Some(length) = packet_length(&buffer) {
            let packet: Vec<u8> = buffer.drain(..length).collect();
            let is_parameter = packet[0] == MAGIC
                && PARAMETER_MESSAGES.contains(&packet[7])
                && packet[8..10] == [0, 0];
            count += usize::from(is_parameter);
            let is_lost = is_parameter && count.is_multiple_of(nth);
            if !is_lost && to.write_all(&packet).await.is_err() {
                return;
            }
        }
    }
}

fn packet_length(buffer: &[u8]) -> Option<usize> {
    let first = *buffer.first()?;
    if first != MAGIC {
        return Some(1);
    }
    let signature = if *buffer.get(2)? & 1 == 1 {
        SIGNATURE
    } else {
        0
    };
    let length = AROUND_PAYLOAD + usize::from(*buffer.get(1)?) + signature;
    (buffer.len() >= length).then_some(length)
}

/// A pipe that loses every n-th packet about parameters in each direction.
fn lossy(far: DuplexStream, nth: usize) -> DuplexStream {
    let (near, middle) = duplex(64 * 1024);
    let (far_out, far_in) = tokio::io::split(far);
    let (middle_out, middle_in) = tokio::io::split(middle);
    tokio::spawn(carry(far_out, middle_in, nth));
    tokio::spawn(carry(middle_out, far_in, nth));
    near
}

impl Console {
    fn known(&self, vehicle: VehicleId) -> ParameterSnapshot {
        self.parameters
            .get(&vehicle)
            .map(|known| known.borrow().clone())
            .unwrap_or_default()
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn several_lists_come_whole_over_links_that_lose_a_third_of_all() {
    let cancel = CancellationToken::new();
    let started = Simulator::start(world(3), 1.0, &[Endpoint::Pipes], cancel.clone())
        .await
        .expect("pipes always open");
    let mut console = Console::start();
    for pipe in started.pipes {
        let pipe = Transport::Pipe(lossy(pipe, 3));
        console.fleet.connect(pipe).expect("the fleet runs");
    }
    let all = [1, 2, 3];
    console
        .until("all are heard", |console| {
            all.iter().all(|id| {
                let vehicle = console.vehicle(*id);
                vehicle.is_some_and(|vehicle| vehicle.heartbeat.is_some())
            })
        })
        .await;
    for id in all {
        console.fleet.fetch_parameters(id).expect("the fleet runs");
    }
    console
        .until("all lists are there", |console| {
            all.iter()
                .all(|id| console.known(*id).fetching == Fetching::Complete)
        })
        .await;
    for id in all {
        let list = console.known(id).list;
        assert_eq!(
            list.len(),
            usize::from(list.count().expect("it has said so"))
        );
        let own = list.get("SYSID_THISMAV").expect("every vehicle has it");
        assert!((own.value - f64::from(id)).abs() < f64::EPSILON);
    }
    let set = console.give("param set WPNAV_SPEED 640", &all);
    for id in all {
        console.until_done(set, id).await;
    }
    console
        .until("the lists know the new value", |console| {
            all.iter().all(|id| {
                let list = console.known(*id).list;
                list.get("WPNAV_SPEED")
                    .is_some_and(|speed| speed.is_changed() && (speed.value - 640.0).abs() < 0.1)
            })
        })
        .await;
    cancel.cancel();
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_list_is_handed_over_a_few_times_and_not_once_per_parameter() {
    let cancel = CancellationToken::new();
    let started = Simulator::start(world(1), 1.0, &[Endpoint::Pipes], cancel.clone())
        .await
        .expect("pipes always open");
    let mut console = Console::start();
    for pipe in started.pipes {
        let pipe = Transport::Pipe(pipe);
        console.fleet.connect(pipe).expect("the fleet runs");
    }
    let parameters = loop {
        let event = tokio::time::timeout(Duration::from_secs(20), console.events.recv());
        match event.await {
            Ok(Some(FleetEvent::Parameters(1, parameters))) => break parameters,
            Ok(Some(_)) => {}
            other => panic!("the vehicle does not appear: {other:?}"),
        }
    };
    let mut parameters = parameters;
    console.fleet.fetch_parameters(1).expect("the fleet runs");
    let mut handed_over = 0;
    while parameters.borrow_and_update().fetching != Fetching::Complete {
        let change = tokio::time::timeout(Duration::from_secs(20), parameters.changed());
        change.await.expect("it goes on").expect("the task runs");
        handed_over += 1;
    }
    assert!(handed_over < 20, "{handed_over} times");
    let set = console.give("param set ANGLE_MAX 40000", &[1]);
    console
        .until("what does not fit is refused", |console| {
            console.state(set, 1) == Some(RowState::Refused)
        })
        .await;
    cancel.cancel();
}
