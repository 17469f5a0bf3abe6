//! Messages with the same interval are sent together, in one bucket; a vehicle has few of them.

/// The number of different intervals; a message with a further one joins the bucket with the nearest.
const BUCKETS: usize = 10;

/// Messages that are sent together, one interval after the last time.
#[derive(Debug, Clone)]
struct Bucket {
    /// The interval in milliseconds; 0 for a free bucket.
    interval_ms: u64,
    last_ms: u64,
    ids: Vec<u32>,
}

impl Bucket {
    const FREE: Self = Self {
        interval_ms: 0,
        last_ms: 0,
        ids: Vec::new(),
    };

    fn due_ms(&self) -> u64 {
        self.last_ms + self.interval_ms
    }
}

/// All buckets, and the bucket that is sent next. It is chosen when the previous one has been sent,
/// so a bucket that is filled later waits its turn.
#[derive(Debug, Clone)]
pub(super) struct Buckets {
    all: [Bucket; BUCKETS],
    next: Option<usize>,
    /// The messages of the next bucket that are not sent yet.
    waiting: Vec<u32>,
}

impl Default for Buckets {
    fn default() -> Self {
        Self {
            all: [Bucket::FREE; BUCKETS],
            next: None,
            waiting: Vec::new(),
        }
    }
}

impl Buckets {
    /// Sets the interval of a message; 0 switches it off.
    pub(super) fn set(&mut self, id: u32, interval_ms: u64, now_ms: u64) {
        let place = self.all.iter().position(|bucket| bucket.ids.contains(&id));
        if let Some(place) = place {
            if interval_ms != 0 && self.all[place].interval_ms == interval_ms {
                return;
            }
            self.remove(place, id, now_ms);
        }
        if interval_ms == 0 {
            return;
        }
        let place = self.place_for(interval_ms, now_ms);
        self.all[place].ids.push(id);
        if self.next.is_none() {
            self.next = Some(place);
            self.waiting.clone_from(&self.all[place].ids);
        }
    }

    /// The bucket with an interval, a free one, or the one with the nearest interval.
    fn place_for(&mut self, interval_ms: u64, now_ms: u64) -> usize {
        let used = self.all.iter().enumerate();
        let nearest = used
            .filter(|(_, bucket)| bucket.interval_ms != 0)
            .map(|(place, bucket)| (bucket.interval_ms.abs_diff(interval_ms), place))
            .min();
        let free = self.all.iter().position(|bucket| bucket.interval_ms == 0);
        match (nearest, free) {
            (Some((0, place)), _) | (Some((_, place)), None) => place,
            (_, Some(place)) => {
                self.all[place].interval_ms = interval_ms;
                self.all[place].last_ms = now_ms;
                place
            }
            (None, None) => 0,
        }
    }

    fn remove(&mut self, place: usize, id: u32, now_ms: u64) {
        let bucket = &mut self.all[place];
        bucket.ids.retain(|own| *own != id);
        let is_empty = bucket.ids.is_empty();
        if is_empty {
            bucket.interval_ms = 0;
        }
        if self.next == Some(place) {
            self.waiting.retain(|own| *own != id);
            if is_empty {
                self.choose(now_ms);
            }
        }
    }

    /// The interval of a message; 0 when it is off.
    pub(super) fn interval_ms(&self, id: u32) -> u64 {
        let bucket = self.all.iter().find(|bucket| bucket.ids.contains(&id));
        bucket.map_or(0, |bucket| bucket.interval_ms)
    }

    /// The time before which nothing is due.
    pub(super) fn due_ms(&self) -> u64 {
        self.next.map_or(u64::MAX, |place| self.all[place].due_ms())
    }

    /// Calls `send` for each message that is due.
    pub(super) fn each_due(&mut self, now_ms: u64, send: &mut impl FnMut(u32)) {
        // Every bucket is due at most once, since one that is late does not catch up.
        for _ in 0..=BUCKETS {
            let Some(place) = self
                .next
                .filter(|place| now_ms >= self.all[*place].due_ms())
            else {
                return;
            };
            self.waiting.drain(..).for_each(&mut *send);
            let bucket = &mut self.all[place];
            bucket.last_ms = bucket.due_ms();
            if now_ms - bucket.last_ms > bucket.interval_ms {
                bucket.last_ms = now_ms;
            }
            self.choose(now_ms);
        }
    }

    /// Chooses the bucket that is due first; of those that are late, the first in order.
    fn choose(&mut self, now_ms: u64) {
        let used = self.all.iter().enumerate();
        self.next = used
            .filter(|(_, bucket)| !bucket.ids.is_empty())
            .min_by_key(|(_, bucket)| bucket.due_ms().saturating_sub(now_ms))
            .map(|(place, _)| place);
        self.waiting.clear();
        if let Some(place) = self.next {
            self.waiting.clone_from(&self.all[place].ids);
        }
    }
}
