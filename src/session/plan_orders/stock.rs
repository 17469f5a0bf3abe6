//! Lists that a mission puts on board without an order.

use std::collections::VecDeque;
use std::sync::Arc;

use crate::commands::{PlanCommand, PlanDeed, PlanSource};
use crate::plan::{Document, ListKind};

/// The maximum number of times a list is sent to a vehicle that does not accept it.
const TRIES: u8 = 5;

/// The lists that are still to be sent, the next one first.
#[derive(Debug, Clone, Default)]
pub(super) struct Stock(VecDeque<StockedList>);

#[derive(Debug, Clone)]
struct StockedList {
    kind: ListKind,
    document: Arc<Document>,
    /// How many more times it may be sent.
    tries: u8,
}

impl Stock {
    /// Adds the lists of a document that have items.
    pub fn add(&mut self, document: &Arc<Document>) {
        let kinds = ListKind::ALL.into_iter();
        let lists = kinds.filter(|kind| !document.list(*kind).is_empty());
        self.0.extend(lists.map(|kind| StockedList {
            kind,
            document: Arc::clone(document),
            tries: TRIES,
        }));
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The upload of the next list, and the document with it.
    pub fn upload(&self) -> Option<(PlanCommand, Arc<Document>)> {
        let list = self.0.front()?;
        let source = PlanSource::document(Arc::clone(&list.document));
        let command = PlanCommand {
            kind: list.kind,
            deed: PlanDeed::Upload { source },
        };
        Some((command, Arc::clone(&list.document)))
    }

    /// Notes whether the vehicle has taken the next list; otherwise it is sent once more, unless that has been tried
    /// often enough.
    pub fn note(&mut self, is_taken: bool) {
        let list = self.0.pop_front();
        let left = list.filter(|list| !is_taken && list.tries > 1);
        self.0.extend(left.map(|list| StockedList {
            tries: list.tries - 1,
            ..list
        }));
    }
}
