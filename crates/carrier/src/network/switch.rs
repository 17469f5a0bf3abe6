//! Passes what arrives at the desk to its connections, and limits what a seat may send.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use sortie_class::SEATS;
use tokio::sync::mpsc;
use tokio::time::Instant;

use super::config::CONSOLES_OF_A_SEAT;
use super::conversation::{INBOX, Inbox};
use super::frame::Frame;

/// The maximum number of greetings that wait to be answered: one of each seat. Seats repeat theirs.
const GREETINGS: usize = SEATS;
/// How many greetings of a seat are looked at in a second, on average.
const GREETINGS_PER_S: f64 = 20.0;
/// How many frames without lines a seat may send in a second, on average. Lines wait for the window.
const FRAMES_PER_S: f64 = 200.0;
/// For how many seconds a seat may save up what it does not send.
const SAVED_S: f64 = 2.0;

/// Which seat has which connection open.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Caller {
    pub seat: String,
    /// The random number of the connection.
    pub number: String,
}

/// The first frame of a connection, not read yet.
pub(super) struct Greeting {
    pub caller: Caller,
    pub bytes: Vec<u8>,
}

/// Passes frames to their connections.
pub(super) struct Switch {
    lines: Mutex<SwitchLines>,
    greeted: mpsc::Sender<Greeting>,
}

#[derive(Default)]
struct SwitchLines {
    /// The connections that have not ended. One that was sent too much has no inbox any more, but keeps its place until
    /// it has ended: otherwise a seat could have any number of them.
    open: BTreeMap<Caller, Option<mpsc::Sender<Vec<u8>>>>,
    traffic: BTreeMap<String, Traffic>,
}

/// What a seat sends, on all its connections.
struct Traffic {
    /// Whether a greeting waits to be answered. Another one is dropped, so that a seat that floods the desk with
    /// greetings does not keep the others out.
    has_greeted: bool,
    greetings: Allowance,
    frames: Allowance,
}

impl Default for Traffic {
    fn default() -> Self {
        Self {
            has_greeted: false,
            greetings: Allowance::new(GREETINGS_PER_S),
            frames: Allowance::new(FRAMES_PER_S),
        }
    }
}

/// A token bucket.
struct Allowance {
    per_s: f64,
    left: f64,
    at: Instant,
}

impl Allowance {
    fn new(per_s: f64) -> Self {
        Self {
            per_s,
            left: per_s * SAVED_S,
            at: Instant::now(),
        }
    }

    /// Takes one, if there is one left.
    fn take(&mut self) -> bool {
        let now = Instant::now();
        let gained = now.duration_since(self.at).as_secs_f64() * self.per_s;
        self.left = (self.left + gained).min(self.per_s * SAVED_S);
        self.at = now;
        let has_one = self.left >= 1.0;
        if has_one {
            self.left -= 1.0;
        }
        has_one
    }
}

/// The place of a connection. It is free again when it is dropped.
pub(super) struct TakenPlace {
    pub switch: Arc<Switch>,
    pub caller: Caller,
}

impl Drop for TakenPlace {
    fn drop(&mut self) {
        self.switch.disconnect(&self.caller);
    }
}

impl Switch {
    pub fn new() -> (Self, mpsc::Receiver<Greeting>) {
        let (greeted, greetings) = mpsc::channel(GREETINGS);
        let lines = Mutex::default();
        (Self { lines, greeted }, greetings)
    }

    fn lines(&self) -> MutexGuard<'_, SwitchLines> {
        self.lines.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Takes a frame in, without waiting: it is called by the thread that reads for all seats. A seat that sends more
    /// than it may loses the connection.
    pub fn pass(&self, caller: Caller, bytes: Vec<u8>) {
        let mut lines = self.lines();
        let SwitchLines { open, traffic } = &mut *lines;
        let traffic = traffic.entry(caller.seat.clone()).or_default();
        match open.get_mut(&caller) {
            // A greeting is repeated until it is answered.
            Some(_) if Frame::may_be_hello(&bytes) => {}
            Some(inbox) => {
                let is_allowed = Frame::may_be_line(&bytes) || traffic.frames.take();
                // Nobody who keeps to the window fills it.
                let has_room = |it: &mpsc::Sender<_>| it.try_send(bytes).is_ok();
                if !(is_allowed && inbox.as_ref().is_some_and(has_room)) {
                    *inbox = None;
                }
            }
            None if Frame::may_be_hello(&bytes) && !traffic.has_greeted => {
                let greeting = Greeting { caller, bytes };
                traffic.has_greeted =
                    traffic.greetings.take() && self.greeted.try_send(greeting).is_ok();
            }
            None => {}
        }
    }

    /// Opens a connection; `None` if the seat or the class has too many.
    pub fn connect(&self, caller: &Caller) -> Option<Inbox> {
        let open = &mut self.lines().open;
        let of_seat = open.keys().filter(|it| it.seat == caller.seat).count();
        if open.contains_key(caller) || of_seat >= CONSOLES_OF_A_SEAT || open.len() >= SEATS {
            return None;
        }
        let (sender, inbox) = mpsc::channel(INBOX);
        open.insert(caller.clone(), Some(sender));
        Some(inbox)
    }

    fn disconnect(&self, caller: &Caller) {
        self.lines().open.remove(caller);
    }

    /// The greeting of a seat has been answered, or not: it may send another one.
    pub fn listen_again(&self, seat: &str) {
        if let Some(traffic) = self.lines().traffic.get_mut(seat) {
            traffic.has_greeted = false;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::network::certificates;
    use crate::network::frame::{FrameKind, signer};

    fn caller(seat: &str, number: usize) -> Caller {
        Caller {
            seat: seat.to_owned(),
            number: number.to_string(),
        }
    }

    /// Frames of a seat, without lines.
    fn frame(kind: FrameKind) -> Vec<u8> {
        let key = certificates::desk("9-A").expect("a key").key;
        let signer = signer(&key).expect("a key");
        let frame = Frame {
            kind,
            number: 0,
            taken: 0,
            body: Vec::new(),
        };
        frame.seal(&signer, "key")
    }

    #[test]
    fn a_seat_that_floods_the_desk_with_greetings_does_not_keep_another_out() {
        let (switch, mut greetings) = Switch::new();
        let hello = frame(FrameKind::Hello);
        let greet = |seat: &str, number| switch.pass(caller(seat, number), hello.clone());
        for number in 0..10_000 {
            greet("seat-01", number);
        }
        greet("seat-02", 7);
        let mut next = || greetings.try_recv().map(|it| it.caller.seat);
        assert_eq!(next().as_deref(), Ok("seat-01"));
        assert_eq!(next().as_deref(), Ok("seat-02"));
        assert!(next().is_err());
        switch.listen_again("seat-01");
        greet("seat-01", 10_001);
        assert_eq!(next().as_deref(), Ok("seat-01"));
    }

    #[tokio::test(start_paused = true)]
    async fn only_so_many_greetings_of_a_seat_are_looked_at_in_a_second() {
        let (switch, mut greetings) = Switch::new();
        let hello = frame(FrameKind::Hello);
        let mut looked_at = || {
            for number in 0..1000 {
                switch.pass(caller("seat-01", number), hello.clone());
                switch.listen_again("seat-01");
            }
            std::iter::from_fn(|| greetings.try_recv().ok()).count()
        };
        let at_once = looked_at();
        assert!((20..100).contains(&at_once), "{at_once}");
        tokio::time::advance(Duration::from_secs(1)).await;
        let later = looked_at();
        assert!((10..100).contains(&later), "{later}");
    }

    #[tokio::test(start_paused = true)]
    async fn who_says_without_end_that_it_is_there_is_disconnected() {
        let (switch, _greetings) = Switch::new();
        let here = frame(FrameKind::KeepAlive);
        let seat = caller("seat-01", 1);
        let mut inbox = switch.connect(&seat).expect("a place");
        // As often as a desk that sends much is told that its lines were taken.
        for _ in 0..600 {
            switch.pass(seat.clone(), here.clone());
            assert!(inbox.try_recv().is_ok());
            tokio::time::advance(Duration::from_millis(10)).await;
        }
        let mut count = 0;
        while count < 10_000 && !inbox.is_closed() {
            switch.pass(seat.clone(), here.clone());
            drop(inbox.try_recv());
            count += 1;
        }
        assert!(count < 1000, "{count}");
    }

    #[test]
    fn a_connection_that_was_sent_too_much_counts_until_it_has_ended() {
        let (switch, _greetings) = Switch::new();
        let callers: Vec<Caller> = (0..CONSOLES_OF_A_SEAT)
            .map(|number| caller("seat-01", number))
            .collect();
        let inboxes: Vec<Inbox> = callers
            .iter()
            .map(|it| switch.connect(it).expect("a place"))
            .collect();
        for caller in &callers {
            for _ in 0..=INBOX {
                switch.pass(caller.clone(), b"no greeting".to_vec());
            }
        }
        assert!(inboxes.iter().all(Inbox::is_closed), "they end");
        let fifth = caller("seat-01", CONSOLES_OF_A_SEAT);
        for caller in [&fifth, &callers[0]] {
            assert!(switch.connect(caller).is_none(), "{caller:?}");
        }
        switch.disconnect(&callers[0]);
        assert!(switch.connect(&fifth).is_some());
    }
}
