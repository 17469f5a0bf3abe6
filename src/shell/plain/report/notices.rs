//! Notices as lines.

use std::time::Duration;

use super::{LISTED, clock, severity_word};
use crate::app::State;
use crate::app::state::{FlightView, NoticeLine};
use crate::notice::{Notice, NoticeSource};
use crate::text::{Text, text};
use crate::vehicle_id::ranges;

/// How long identical notices are merged with the newest one before their count is printed.
const FOLD_TIME: Duration = Duration::from_secs(10);

/// The notices that have been printed.
#[derive(Debug, Default)]
pub(super) struct PrintedNotices {
    /// The newest printed notice, and its count when it was printed.
    newest: Option<(Notice, u32)>,
}

impl PrintedNotices {
    /// Whether a notice of the class is new.
    pub fn has_word_of_class(&self, state: &State) -> bool {
        let said = self.newest.as_ref().map(|(notice, _)| notice);
        let all = state.notices().lines().rev();
        let mut new = all.take_while(|line| said.is_none_or(|said| *said != line.notice));
        new.any(|line| line.notice.source == NoticeSource::Class)
    }

    /// The lines of the notices since the last call, and of the last printed notice if it was
    /// repeated.
    pub fn news(&mut self, state: &State) -> Vec<Text> {
        let mut texts = Vec::new();
        let said = self.newest.as_ref();
        let is_new = |line: &&NoticeLine| said.is_none_or(|(notice, _)| *notice != line.notice);
        let mut lines: Vec<&NoticeLine> =
            state.notices().lines().rev().take_while(is_new).collect();
        lines.reverse();
        if let Some((notice, count)) = &mut self.newest {
            let closed = !lines.is_empty() || state.now().saturating_sub(notice.at) > FOLD_TIME;
            let mut known = state.notices().lines().rev();
            let line = known.find(|line| line.notice == *notice);
            if let Some(line) = line.filter(|line| closed && line.count > *count) {
                texts.push(notice_text(line, state.session()));
                *count = line.count;
            }
        }
        for line in lines {
            texts.push(notice_text(line, state.session()));
            self.newest = Some((line.notice.clone(), line.count));
        }
        texts
    }
}

/// The newest notices, on demand.
pub(super) fn newest(state: &State) -> Vec<Text> {
    let lines = state.notices().lines();
    let skipped = lines.len().saturating_sub(LISTED);
    let lines = lines.skip(skipped);
    lines
        .map(|line| notice_text(line, state.session()))
        .collect()
}

fn notice_text(line: &NoticeLine, session: &FlightView) -> Text {
    let notice = &line.notice;
    let mut head = clock(session, notice.at);
    let vehicles = ranges(line.vehicles.iter().copied());
    if !vehicles.is_empty() {
        head.push(' ');
        head.push_str(&vehicles);
    }
    let mut parts = vec![Text::from(head)];
    parts.extend(severity_word(notice.severity));
    parts.push(notice.text.clone());
    if line.count as usize > line.vehicles.len().max(1) {
        let times = text!("plain-times", count = line.count);
        return Text::joined(" ", vec![Text::joined(": ", parts), times]);
    }
    Text::joined(": ", parts)
}
