//! The names of a ledger row's states in JSON. They are a contract with programs and stored runs; the display text is
//! [`RowState::text`].

use std::borrow::Cow;

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serializer};

use crate::ledger::RowState;

const WITHOUT_FIGURE: [RowState; 11] = [
    RowState::Queued,
    RowState::Sent,
    RowState::SentOnly,
    RowState::Accepted,
    RowState::Done,
    RowState::NoEffect,
    RowState::Refused,
    RowState::TimedOut,
    RowState::Superseded,
    RowState::Overtaken,
    RowState::Barred,
];

fn name(state: RowState) -> Cow<'static, str> {
    match state {
        RowState::InProgress(percent) => format!("in progress {percent} %").into(),
        RowState::Queued => "queued".into(),
        RowState::Sent => "sent".into(),
        RowState::SentOnly => "sent only".into(),
        RowState::Accepted => "accepted".into(),
        RowState::Done => "effect seen".into(),
        RowState::NoEffect => "no effect".into(),
        RowState::Refused => "refused".into(),
        RowState::TimedOut => "timed out".into(),
        RowState::Superseded => "superseded".into(),
        RowState::Overtaken => "overtaken".into(),
        RowState::Barred => "barred".into(),
    }
}

fn named(written: &str) -> Option<RowState> {
    let figure = written.strip_prefix("in progress ");
    if let Some(percent) = figure.and_then(|figure| figure.strip_suffix(" %")) {
        return percent.parse().ok().map(RowState::InProgress);
    }
    let mut states = WITHOUT_FIGURE.into_iter();
    states.find(|state| name(*state) == written)
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "serde passes fields by reference"
)]
pub fn serialize<S: Serializer>(state: &RowState, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&name(*state))
}

pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<RowState, D::Error> {
    let written = String::deserialize(deserializer)?;
    named(&written).ok_or_else(|| D::Error::custom(format!("unknown row state `{written}`")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_state_is_read_back_from_its_name() {
        let all = WITHOUT_FIGURE.into_iter();
        for state in all.chain([0, 40, 100].map(RowState::InProgress)) {
            assert_eq!(named(&name(state)), Some(state));
        }
        assert_eq!(name(RowState::InProgress(40)), "in progress 40 %");
        for unknown in ["", "Refused", "in progress 400 %", "in progress"] {
            assert_eq!(named(unknown), None, "{unknown}");
        }
    }
}
