//! Sets up a session before its first frame: streams, stores and keys.

use std::sync::Arc;
use std::time::Duration;

use super::{FileDesk, KeyDesk, LogKeeper, PlanShelf, Session, Stream};
use crate::metadata::EventDocuments;

impl Session {
    /// Requests these streams instead of the console's usual telemetry.
    #[must_use]
    pub fn wanting(mut self, streams: &'static [Stream], now: Duration) -> Self {
        self.reception.want(streams, now);
        self
    }

    /// Stores the vehicle's downloaded logs with `keeper`.
    #[must_use]
    pub fn keeping_logs(mut self, keeper: Arc<dyn LogKeeper>) -> Self {
        self.orders.transfers().keep_logs_in(keeper);
        self
    }

    /// Reads and writes the files that are copied to and from the vehicle through `desk`.
    #[must_use]
    pub fn with_files(mut self, desk: Arc<dyn FileDesk>) -> Self {
        self.orders.transfers().use_desk(desk);
        self
    }

    /// Shows events by these texts, until the vehicle's own are read.
    #[must_use]
    pub fn knowing_events(mut self, documents: Arc<EventDocuments>) -> Self {
        self.events.use_documents(documents);
        self
    }

    /// Reads and writes plan files through `shelf`.
    #[must_use]
    pub fn with_plan_files(mut self, shelf: Arc<dyn PlanShelf>) -> Self {
        self.orders.transfers().take_plans_from(shelf);
        self
    }

    /// Takes the keys for signing from `desk`, which belongs to the link on which the vehicle is
    /// heard; without a desk, keys cannot be changed.
    pub fn sign_with(&mut self, desk: Option<Arc<dyn KeyDesk>>) {
        self.orders.sign_with(desk);
    }

    /// Reads plans from the answers to other stations' requests, as in a recording, instead of
    /// requesting them.
    #[must_use]
    pub fn following_plans(mut self) -> Self {
        self.orders.transfers().only_follow();
        self
    }
}
