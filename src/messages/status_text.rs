//! STATUSTEXT: chunks joined, reasons not to arm collected.

use std::collections::BTreeMap;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::STATUSTEXT_DATA;

use super::HandlerNotices;
use crate::alert::AlertKind;
use crate::notice::sanitised;
use crate::vehicle::{Severity, StatusText, TEXTS_KEPT, Vehicle};
use crate::wire::ComponentId;

/// How long the next chunk of a text may take.
const REST_WITHIN: Duration = Duration::from_secs(1);
/// The maximum number of incomplete texts at a time; beyond that the oldest is released unfinished.
const MOST_UNFINISHED: usize = 8;
/// Reasons not to arm that are further apart than this belong to different checks.
const SAME_CHECK: Duration = Duration::from_secs(2);
/// The placeholder for missing chunks.
const MISSING: &[u8] = b"...";

/// A STATUSTEXT as received.
#[derive(Debug, Clone)]
pub(super) struct Chunk {
    component: ComponentId,
    /// The text that it belongs to; 0 for a text in one piece.
    id: u16,
    sequence: u8,
    severity: Severity,
    bytes: Vec<u8>,
    /// Whether the chunk is the last one of its text: it is not full.
    is_last: bool,
}

impl Chunk {
    pub(super) fn new(component: ComponentId, data: &STATUSTEXT_DATA) -> Self {
        let end = data.text.iter().position(|&byte| byte == 0);
        Self {
            component,
            id: data.id,
            sequence: data.chunk_seq,
            severity: Severity::from_wire(data.severity as u8),
            bytes: data.text[..end.unwrap_or(data.text.len())].to_vec(),
            is_last: end.is_some(),
        }
    }
}

/// A complete text, not yet cleaned.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Joined {
    pub(super) severity: Severity,
    pub(super) text: String,
}

/// Texts with missing chunks, oldest first.
#[derive(Debug, Clone, Default)]
pub(super) struct Assembly {
    unfinished: Vec<UnfinishedText>,
}

#[derive(Debug, Clone)]
struct UnfinishedText {
    component: ComponentId,
    id: u16,
    severity: Severity,
    chunks: BTreeMap<u8, Vec<u8>>,
    last: Option<u8>,
    /// The time of the last chunk.
    at: Duration,
}

impl Assembly {
    /// Adds a chunk and returns the texts that need not wait any longer: usually none or one.
    pub(super) fn accept(&mut self, chunk: Chunk, now: Duration) -> Vec<Joined> {
        if chunk.id == 0 {
            let text = text_of(&chunk.bytes);
            return vec![Joined {
                severity: chunk.severity,
                text,
            }];
        }
        let mut out = Vec::new();
        let known = self
            .unfinished
            .iter()
            .position(|text| (text.component, text.id) == (chunk.component, chunk.id));
        let index = match known {
            Some(index) if self.unfinished[index].has(&chunk) => return out,
            Some(index) if self.unfinished[index].fits(&chunk) => index,
            Some(index) => {
                out.push(self.unfinished.remove(index).join());
                self.open(&chunk, now)
            }
            None => self.open(&chunk, now),
        };
        self.unfinished[index].add(chunk, now);
        if self.unfinished[index].is_whole() {
            out.push(self.unfinished.remove(index).join());
        } else if self.unfinished.len() > MOST_UNFINISHED {
            out.push(self.unfinished.remove(0).join());
        }
        out
    }

    /// The texts whose missing chunks are overdue.
    pub(super) fn expire(&mut self, now: Duration) -> Vec<Joined> {
        self.unfinished
            .extract_if(.., |text| now.saturating_sub(text.at) >= REST_WITHIN)
            .map(UnfinishedText::join)
            .collect()
    }

    /// All incomplete texts, since no further chunk will come.
    pub(super) fn drain(&mut self) -> Vec<Joined> {
        self.unfinished
            .drain(..)
            .map(UnfinishedText::join)
            .collect()
    }

    fn open(&mut self, chunk: &Chunk, now: Duration) -> usize {
        self.unfinished.push(UnfinishedText {
            component: chunk.component,
            id: chunk.id,
            severity: chunk.severity,
            chunks: BTreeMap::new(),
            last: None,
            at: now,
        });
        self.unfinished.len() - 1
    }
}

impl UnfinishedText {
    /// Whether the same chunk has been received before: a network may deliver it twice.
    fn has(&self, chunk: &Chunk) -> bool {
        self.severity == chunk.severity && self.chunks.get(&chunk.sequence) == Some(&chunk.bytes)
    }

    /// Whether the chunk can be part of this text, and not of a later one with the same id.
    fn fits(&self, chunk: &Chunk) -> bool {
        let beyond_end = self.last.is_some_and(|last| chunk.sequence > last);
        let ends_early = chunk.is_last
            && (self.last.is_some() || self.chunks.keys().any(|&seen| seen > chunk.sequence));
        self.severity == chunk.severity
            && !self.chunks.contains_key(&chunk.sequence)
            && !beyond_end
            && !ends_early
    }

    fn add(&mut self, chunk: Chunk, now: Duration) {
        if chunk.is_last {
            self.last = Some(chunk.sequence);
        }
        self.chunks.insert(chunk.sequence, chunk.bytes);
        self.at = now;
    }

    fn is_whole(&self) -> bool {
        self.last
            .is_some_and(|last| self.chunks.len() == usize::from(last) + 1)
    }

    /// The text in order. Bytes are joined before they are decoded, since a chunk may end within a character.
    fn join(self) -> Joined {
        let mut bytes = Vec::new();
        let mut next = 0;
        for (sequence, chunk) in &self.chunks {
            if u16::from(*sequence) > next {
                bytes.extend_from_slice(MISSING);
            }
            bytes.extend_from_slice(chunk);
            next = u16::from(*sequence) + 1;
        }
        if self.last.is_none() && u8::try_from(next).is_ok() {
            bytes.extend_from_slice(MISSING);
        }
        Joined {
            severity: self.severity,
            text: text_of(&bytes),
        }
    }
}

fn text_of(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Adds a text to the vehicle's texts and to the notices. A reason not to arm is also kept
/// separately; one that comes later than [`SAME_CHECK`] after the last one (`reasons_at`) replaces
/// all earlier ones.
pub(super) fn apply(
    vehicle: &mut Vehicle,
    joined: &Joined,
    reasons_at: &mut Option<Duration>,
    report: &mut HandlerNotices<'_>,
) {
    // PX4 ends texts that it also sends as events with a tab.
    let text = sanitised(joined.text.trim_end());
    if text.is_empty() {
        return;
    }
    if let Some(reason) = StatusText::reason_not_to_arm(&text) {
        let same_check = reasons_at.is_some_and(|at| report.now.saturating_sub(at) <= SAME_CHECK);
        if !same_check {
            vehicle.prearm.clear();
        }
        *reasons_at = Some(report.now);
        vehicle.prearm.retain(|known| known != reason);
        vehicle.prearm.push(reason.to_owned());
        let excess = vehicle.prearm.len().saturating_sub(TEXTS_KEPT);
        vehicle.prearm.drain(..excess);
    }
    let kind = AlertKind::of_status_text(&text);
    report.repeat(joined.severity, kind, text.clone());
    vehicle.texts.push(StatusText {
        severity: joined.severity,
        text,
        at: report.now,
    });
    let excess = vehicle.texts.len().saturating_sub(TEXTS_KEPT);
    vehicle.texts.drain(..excess);
}

#[cfg(test)]
mod tests;
