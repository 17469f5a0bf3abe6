//! A seat's attempts to reach its desk.

use std::sync::Arc;

use tokio::sync::mpsc;
use tokio::time::sleep;

use super::fault::ClassFault;
use super::ports::{ARRIVALS, CarrierPeer, Outbox, RETRY, SeatArrival, SeatPort};

/// A way to a desk that says messages of a kind.
pub(super) trait WayToDesk<M>: Send + Sync + 'static {
    /// A connection that the desk has accepted.
    type Call: Send;

    /// Calls the desk; `None` if none is there, which is no fault: it may open later.
    fn call(
        &self,
    ) -> impl Future<Output = Result<Option<(Self::Call, CarrierPeer)>, ClassFault>> + Send;

    /// A desk has answered: from now on only this one is called, where others could take its place.
    fn keep_to(&mut self, _desk: &CarrierPeer) {}

    /// Passes lines in both directions until the connection ends or the console is gone.
    fn pass(
        &self,
        call: Self::Call,
        lines: mpsc::Receiver<String>,
        arrived: &mpsc::Sender<SeatArrival<M>>,
    ) -> impl Future<Output = ()> + Send;
}

/// Connects to the desk, and again whenever the connection ends, until the port is dropped.
pub(super) fn join<M: Send + 'static>(way: impl WayToDesk<M>) -> SeatPort<M> {
    let (arrived, arrivals) = mpsc::channel(ARRIVALS);
    let task = tokio::spawn(async move { keep_connected(way, &arrived).await });
    SeatPort { arrivals, task }
}

async fn keep_connected<M: Send>(
    mut way: impl WayToDesk<M>,
    arrived: &mpsc::Sender<SeatArrival<M>>,
) {
    let mut wait = *RETRY.start();
    let mut told = None;
    let mut last = None;
    while !arrived.is_closed() {
        let called = tokio::select! {
            called = way.call() => called,
            () = arrived.closed() => return,
        };
        match called {
            Ok(Some((call, desk))) => {
                (wait, told, last) = (*RETRY.start(), None, None);
                way.keep_to(&desk);
                let (outbox, lines) = Outbox::new();
                let found = SeatArrival::Found { desk, outbox };
                if arrived.send(found).await.is_err() {
                    return;
                }
                way.pass(call, lines, arrived).await;
                drop(arrived.send(SeatArrival::Lost).await);
            }
            Ok(None) => last = None,
            Err(fault) => {
                let found = Arc::new(fault);
                // A desk that is being opened or closed answers once, but not twice in a row.
                let is_lasting = last.replace(Arc::clone(&found)).as_ref() == Some(&found);
                if is_lasting && told.as_ref() != Some(&found) {
                    told = Some(Arc::clone(&found));
                    drop(arrived.send(SeatArrival::Refused(found)).await);
                }
            }
        }
        tokio::select! {
            () = sleep(wait) => {}
            () = arrived.closed() => return,
        }
        wait = (wait * 2).min(*RETRY.end());
    }
}
