//! A forward to other ground stations as programs see it.

use serde::Serialize;
use utoipa::ToSchema;

use super::LinkView;
use crate::app::state::ForwardSummary;
use crate::text::Locale;

/// The links, and the forwards to other ground stations.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct LinksState {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub id: Option<u64>,
    pub list: Vec<LinkView>,
    pub forwards: Vec<ForwardView>,
}

/// A forward, through which other ground stations use the links.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, ToSchema)]
pub struct ForwardView {
    /// The address and the filters.
    pub name: String,
    /// Whether it carries data.
    pub up: bool,
    /// Why it carries no data; `null` if it does.
    pub error: Option<String>,
    /// The number of stations at its other end.
    pub stations: usize,
    pub received_bytes: u64,
    pub received_messages: u64,
    pub sent_bytes: u64,
    pub sent_messages: u64,
    /// Messages to the stations that were dropped because a station does not read fast enough.
    pub dropped: u64,
    /// Messages to the stations that the filters left out.
    pub filtered: u64,
    /// Messages from the stations that were not passed on: the forward is read-only, or the receiver is unknown.
    pub held_back: u64,
    /// Messages that arrived a second time, over another path.
    pub repeated: u64,
}

impl ForwardView {
    pub(in crate::api) fn new(forward: &ForwardSummary, locale: &Locale) -> Self {
        Self {
            name: forward.name.clone(),
            up: forward.up,
            error: forward.error.as_ref().map(|error| locale.text(error)),
            stations: forward.peers,
            received_bytes: forward.received_bytes,
            received_messages: forward.received_messages,
            sent_bytes: forward.sent_bytes,
            sent_messages: forward.sent_messages,
            dropped: forward.dropped,
            filtered: forward.filtered,
            held_back: forward.held_back,
            repeated: forward.repeated,
        }
    }
}
