//! The notices that are shown, newest last, equal ones folded into one line.

use std::collections::{BTreeSet, VecDeque};

use crate::notice::Notice;
use crate::vehicle::VehicleId;

/// Lines kept.
pub const LINES_KEPT: usize = 1000;
/// How far back an equal text is looked for; farther back it becomes a line of its own again, so that
/// the order of events stays readable.
const FOLD_DEPTH: usize = 12;

/// One line: a text, how often it came, and from whom.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NoticeLine {
    /// The newest of the notices that the line stands for.
    pub notice: Notice,
    /// How many it stands for.
    pub count: u32,
    /// The vehicles they were about.
    pub vehicles: BTreeSet<VehicleId>,
}

/// The list of notices.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct NoticeLog {
    lines: VecDeque<NoticeLine>,
    /// Notices that the shell could not deliver in time.
    pub dropped: u64,
}

impl NoticeLog {
    /// Adds a notice. One with the text and severity of a recent line joins it and moves it to the end.
    pub fn push(&mut self, notice: Notice) {
        let recent = self.lines.len().saturating_sub(FOLD_DEPTH);
        let same = self.lines.iter().skip(recent).position(|line| {
            line.notice.text == notice.text && line.notice.severity == notice.severity
        });
        let known = same.and_then(|at| self.lines.remove(recent + at));
        let mut line = known.unwrap_or_else(|| NoticeLine {
            notice: notice.clone(),
            count: 0,
            vehicles: BTreeSet::new(),
        });
        line.count += 1;
        line.vehicles.extend(notice.vehicle);
        line.notice = notice;
        self.lines.push_back(line);
        if self.lines.len() > LINES_KEPT {
            self.lines.pop_front();
        }
    }

    /// The lines, oldest first.
    pub fn lines(&self) -> impl DoubleEndedIterator<Item = &NoticeLine> + ExactSizeIterator {
        self.lines.iter()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vehicle::Severity;
    use std::time::Duration;

    fn notice(vehicle: VehicleId, text: &str) -> Notice {
        Notice {
            at: Duration::ZERO,
            vehicle: Some(vehicle),
            severity: Severity::Info,
            text: text.to_owned(),
        }
    }

    #[test]
    fn equal_texts_become_one_line() {
        let mut log = NoticeLog::default();
        for (vehicle, text) in [(1, "a"), (2, "b"), (3, "a"), (1, "a")] {
            log.push(notice(vehicle, text));
        }
        let lines: Vec<_> = log.lines().collect();
        assert_eq!(lines.len(), 2);
        assert_eq!((lines[1].count, lines[1].vehicles.len()), (3, 2));
        assert_eq!(lines[1].notice.text, "a");
    }

    #[test]
    fn the_list_stays_bounded() {
        let mut log = NoticeLog::default();
        for number in 0..LINES_KEPT + 5 {
            log.push(notice(1, &number.to_string()));
        }
        assert_eq!(log.lines().len(), LINES_KEPT);
        assert_eq!(
            log.lines().next().map(|line| line.notice.text.as_str()),
            Some("5")
        );
    }
}
