//! What the links count, and how that reads.

use std::time::Duration;

use crate::wire::{ComponentId, SystemId};

/// What a link counts.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LinkSummary {
    /// Its address.
    pub name: String,
    /// Its state in words, such as `up` or `down, next try in 4 s`.
    pub state: String,
    /// Whether it carries data.
    pub up: bool,
    /// Why it does not.
    pub error: Option<String>,
    /// Senders at its other end.
    pub peers: usize,
    /// Bytes per second received.
    pub bytes_in_per_s: f64,
    /// Bytes per second sent.
    pub bytes_out_per_s: f64,
    /// Messages per second received.
    pub messages_in_per_s: f64,
    /// Messages per second sent.
    pub messages_out_per_s: f64,
    /// Frames dropped for their checksum.
    pub bad_crc: u64,
    /// Bytes skipped to find the next frame.
    pub skipped_bytes: u64,
    /// Messages that the dialect does not have.
    pub unknown: u64,
    /// Messages whose fields the dialect does not have.
    pub undecoded: u64,
    /// Frames missing by sequence numbers, per sender.
    pub lost: Vec<((SystemId, ComponentId), u64)>,
    /// Messages that could not be sent.
    pub unsent: u64,
    /// How often it has come up again.
    pub reconnects: u32,
    /// Round trip by TIMESYNC.
    pub round_trip: Option<Duration>,
}

/// What a line about links means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LinkLineState {
    /// A link that carries data.
    Up,
    /// A link that does not.
    Down,
    /// A figure of the link above.
    Detail,
}

/// One line about links.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LinkLine {
    /// What it says.
    pub text: String,
    /// What it means.
    pub state: LinkLineState,
}

/// Everything that the links count, as lines.
pub fn link_lines(links: &[LinkSummary]) -> Vec<LinkLine> {
    let mut lines: Vec<LinkLine> = links.iter().flat_map(lines_of).collect();
    if lines.is_empty() {
        lines.push(detail("there is no link".to_owned()));
    }
    lines
}

fn lines_of(link: &LinkSummary) -> Vec<LinkLine> {
    let state = if link.up {
        LinkLineState::Up
    } else {
        LinkLineState::Down
    };
    let title = format!("{}  {}", link.name, link.state);
    let mut lines = vec![LinkLine { text: title, state }];
    lines.extend(link.error.iter().map(|error| detail(format!("  {error}"))));
    let round_trip = link.round_trip.map_or("not measured".to_owned(), |trip| {
        format!("{} ms", trip.as_millis())
    });
    lines.push(detail(format!(
        "  in {:.0} B/s {:.0} msg/s   out {:.0} B/s {:.0} msg/s   round trip {round_trip}",
        link.bytes_in_per_s, link.messages_in_per_s, link.bytes_out_per_s, link.messages_out_per_s,
    )));
    lines.push(detail(format!(
        "  bad CRC {}   skipped {} B   unknown ids {}   undecoded {}",
        link.bad_crc, link.skipped_bytes, link.unknown, link.undecoded,
    )));
    lines.push(detail(format!(
        "  peers {}   reconnected {}   not sent {}   lost {}",
        link.peers,
        link.reconnects,
        link.unsent,
        losses(&link.lost),
    )));
    lines
}

/// Losses per sender, as `3/1: 12`; senders that lost nothing are left out.
fn losses(lost: &[((SystemId, ComponentId), u64)]) -> String {
    let parts: Vec<String> = lost
        .iter()
        .filter(|(_, count)| *count > 0)
        .map(|((system, component), count)| format!("{system}/{component}: {count}"))
        .collect();
    if parts.is_empty() {
        "0".to_owned()
    } else {
        parts.join(", ")
    }
}

fn detail(text: String) -> LinkLine {
    LinkLine {
        text,
        state: LinkLineState::Detail,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dead_link_says_why_and_losses_name_their_senders() {
        let link = LinkSummary {
            name: "tcp:127.0.0.1:5760".to_owned(),
            state: "down, next try in 1.0 s".to_owned(),
            error: Some("connection refused".to_owned()),
            lost: vec![((1, 1), 0), ((3, 1), 12), ((3, 154), 2)],
            ..LinkSummary::default()
        };
        let lines = link_lines(&[link]);
        assert_eq!(lines[0].state, LinkLineState::Down);
        assert!(lines[1].text.contains("connection refused"));
        assert!(
            lines
                .iter()
                .any(|line| line.text.ends_with("lost 3/1: 12, 3/154: 2"))
        );
    }
}
