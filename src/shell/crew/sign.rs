//! A member's sign of life, beside the work of the console: a slow terminal or a long drawing does not silence the member.

use std::time::Duration;

use tokio::sync::watch;
use tokio::task::JoinHandle;
use tokio::time::{Instant, sleep};

use crate::carrier::Outbox;
use crate::crew::protocol::MemberMessage;

/// The time between two signs of life.
const HERE_EVERY: Duration = Duration::from_secs(2);
/// A console whose run loop has not run for this time hangs, and gives no sign of life any more.
const HUNG_AFTER: Duration = Duration::from_secs(30);

/// When the console's run loop last ran, and the task that says so to the host.
pub(super) struct SignOfLife {
    ran: watch::Sender<Instant>,
    task: Option<JoinHandle<()>>,
}

impl SignOfLife {
    pub fn new() -> Self {
        Self {
            ran: watch::Sender::new(Instant::now()),
            task: None,
        }
    }

    /// Notes that the console's run loop has run.
    pub fn note_run(&self) {
        self.ran.send_replace(Instant::now());
    }

    /// Gives signs of life over a connection until it ends, or until another begins.
    pub fn begin(&mut self, outbox: Outbox) {
        self.end();
        let say = move || {
            outbox.send(&MemberMessage::Here);
            !outbox.is_closed()
        };
        self.task = Some(tokio::spawn(give(self.ran.subscribe(), say)));
    }

    /// Gives no signs of life any more.
    pub fn end(&mut self) {
        if let Some(task) = self.task.take() {
            task.abort();
        }
    }
}

impl Drop for SignOfLife {
    fn drop(&mut self) {
        self.end();
    }
}

/// Gives signs of life as long as the run loop runs. `say` returns whether the connection is there.
async fn give(ran: watch::Receiver<Instant>, say: impl Fn() -> bool) {
    loop {
        sleep(HERE_EVERY).await;
        let is_hung = ran.borrow().elapsed() >= HUNG_AFTER;
        if !is_hung && !say() {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::cell::{Cell, RefCell};

    use tokio::time::timeout;

    use super::*;

    #[tokio::test(start_paused = true)]
    async fn a_busy_console_lives_and_a_hung_one_falls_silent_until_it_runs_again() {
        let (ran, seen) = watch::channel(Instant::now());
        let began = Instant::now();
        let said = RefCell::new(Vec::new());
        let say = || {
            said.borrow_mut().push(began.elapsed().as_secs());
            true
        };
        let mut signs = std::pin::pin!(give(seen, say));
        // The run loop has run at the beginning only.
        let minute = Duration::from_secs(61);
        assert!(timeout(minute, signs.as_mut()).await.is_err());
        let every_other: Vec<u64> = (2..30).step_by(2).collect();
        assert_eq!(said.take(), every_other);
        ran.send_replace(Instant::now());
        let moment = Duration::from_secs(4);
        assert!(timeout(moment, signs.as_mut()).await.is_err());
        assert_eq!(said.take(), [62, 64]);
    }

    #[tokio::test(start_paused = true)]
    async fn signs_end_with_their_connection() {
        let (_ran, seen) = watch::channel(Instant::now());
        let left = Cell::new(3);
        let say = || {
            left.set(left.get() - 1);
            left.get() > 0
        };
        let minute = Duration::from_secs(60);
        let ended = timeout(minute, give(seen, say)).await;
        assert!(ended.is_ok() && left.get() == 0);
    }
}
