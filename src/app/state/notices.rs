//! The notices that are shown, newest last, equal ones of a moment folded into one line.

use std::collections::{BTreeSet, VecDeque};
use std::time::Duration;

use crate::notice::Notice;
use crate::vehicle::VehicleId;

pub const LINES_KEPT: usize = 1000;
/// How long after its first notice a line takes in equal ones.
const FOLD_TIME: Duration = Duration::from_secs(10);

/// Lines that are looked through for an equal one, so that a flood of different ones costs little.
const LINES_SEARCHED: usize = 50;

/// One line: a text, how often it came, and from whom.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NoticeLine {
    /// The first of the notices that the line stands for.
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
    pub(in crate::app) dropped: u64,
}

impl NoticeLog {
    /// Notices that the shell could not deliver in time.
    pub fn dropped(&self) -> u64 {
        self.dropped
    }

    /// Adds a notice. One that says the same as a line of a moment ago joins that line, unless its vehicle has said
    /// something else since: the order of what one vehicle says stays readable. The line keeps its time and place.
    pub fn push(&mut self, notice: Notice) {
        if let Some(line) = self.open_line(&notice) {
            line.count += 1;
            line.vehicles.extend(notice.vehicle);
            return;
        }
        self.lines.push_back(NoticeLine {
            count: 1,
            vehicles: notice.vehicle.into_iter().collect(),
            notice,
        });
        if self.lines.len() > LINES_KEPT {
            self.lines.pop_front();
        }
    }

    /// The line that a notice joins.
    fn open_line(&mut self, notice: &Notice) -> Option<&mut NoticeLine> {
        let is_recent =
            |line: &&mut NoticeLine| notice.at.saturating_sub(line.notice.at) <= FOLD_TIME;
        let newest_first = self.lines.iter_mut().rev().take(LINES_SEARCHED);
        for line in newest_first.take_while(is_recent) {
            let alike = line.notice.text == notice.text && line.notice.severity == notice.severity;
            if alike && line.notice.vehicle.is_some() == notice.vehicle.is_some() {
                return Some(line);
            }
            let is_since = match notice.vehicle {
                Some(vehicle) => line.vehicles.contains(&vehicle),
                None => line.vehicles.is_empty(),
            };
            if is_since {
                return None;
            }
        }
        None
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

    fn notice(vehicle: VehicleId, text: &str) -> Notice {
        Notice {
            at: Duration::ZERO,
            vehicle: Some(vehicle),
            severity: Severity::Info,
            kind: None,
            text: text.into(),
        }
    }

    #[test]
    fn equal_texts_of_interleaved_vehicles_become_one_line() {
        let mut log = NoticeLog::default();
        for (vehicle, text) in [(1, "a"), (2, "a"), (1, "a"), (2, "b"), (3, "a"), (2, "a")] {
            log.push(notice(vehicle, text));
        }
        let counts: Vec<_> = log
            .lines()
            .map(|line| {
                (
                    line.notice.text.to_string(),
                    line.count,
                    line.vehicles.len(),
                )
            })
            .collect();
        let counted = |text: &str, count, vehicles| (text.to_owned(), count, vehicles);
        assert_eq!(
            counts,
            [counted("a", 4, 3), counted("b", 1, 1), counted("a", 1, 1)],
            "2 has said something else before it said that again"
        );
    }

    #[test]
    fn a_line_keeps_its_time_and_takes_in_nothing_that_comes_much_later() {
        let mut log = NoticeLog::default();
        for at_s in [0, 8, 10, 11] {
            let at = Duration::from_secs(at_s);
            log.push(Notice {
                at,
                ..notice(1, "a")
            });
        }
        let lines: Vec<_> = log
            .lines()
            .map(|line| (line.notice.at.as_secs(), line.count))
            .collect();
        assert_eq!(lines, [(0, 3), (11, 1)]);
    }

    #[test]
    fn the_list_stays_bounded() {
        let mut log = NoticeLog::default();
        for number in 0..LINES_KEPT + 5 {
            log.push(notice(1, &number.to_string()));
        }
        assert_eq!(log.lines().len(), LINES_KEPT);
        assert_eq!(
            log.lines().next().map(|line| &line.notice.text),
            Some(&"5".into())
        );
    }
}
