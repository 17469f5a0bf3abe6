//! Whether a journal belongs to the flight of the files beside it.

use super::{Head, Subject};
use crate::text;
use crate::text::{Text, utc_of};

/// The longest time from the beginning of a session to its first frame, in microseconds: a week.
const LATEST_FRAME_US: u64 = 7 * 24 * 3600 * 1_000_000;

/// How a journal fits the other files of its record.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum JournalFit {
    /// Nothing in the other files contradicts the journal.
    Fits,
    /// The journal belongs to a flight other than the mission of the run.
    OtherFlight(Subject),
    /// The first frame is from before the journal's beginning, or from much later.
    OtherTime {
        /// The beginning of the session; like `first_unix_us`, in microseconds since 1970 (UTC).
        began_unix_us: u64,
        first_unix_us: u64,
    },
}

/// The facts in the other files of a record that a journal has to fit; `None` for unknown facts.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct JournalNeighbours<'a> {
    /// The mission in the head of the run, by its id.
    pub mission: Option<&'a str>,
    /// The time of the first frame: microseconds since 1970 (UTC).
    pub first_unix_us: Option<u64>,
}

impl JournalFit {
    /// How a journal with this head fits.
    pub fn of(journal: &Head, beside: JournalNeighbours<'_>) -> Self {
        let is_other = |mission| journal.subject.mission() != Some(mission);
        if beside.mission.is_some_and(is_other) {
            return Self::OtherFlight(journal.subject.clone());
        }
        let began_unix_us = journal.began_unix_us;
        let latest = began_unix_us.checked_add(LATEST_FRAME_US);
        let is_possible = |first_unix_us: &u64| {
            latest.is_some_and(|latest| (began_unix_us..=latest).contains(first_unix_us))
        };
        match beside.first_unix_us {
            Some(first_unix_us) if !is_possible(&first_unix_us) => Self::OtherTime {
                began_unix_us,
                first_unix_us,
            },
            Some(_) | None => Self::Fits,
        }
    }

    /// Why the journal does not belong to the flight, if so.
    pub fn fault(&self) -> Option<Text> {
        match self {
            Self::Fits => None,
            Self::OtherFlight(subject) => {
                Some(text!("verify-other-journal", flight = subject.text()))
            }
            Self::OtherTime {
                began_unix_us,
                first_unix_us,
            } => {
                let [began, first] = [*began_unix_us, *first_unix_us].map(utc_of);
                Some(text!("journal-other-time", began = began, first = first))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BEGAN: u64 = 1_700_000_000_000_000;

    fn fit(subject: Subject, beside: JournalNeighbours<'_>) -> JournalFit {
        JournalFit::of(&Head::new(subject, BEGAN), beside)
    }

    #[test]
    fn a_journal_begins_before_its_first_frame() {
        let at = |first| JournalNeighbours {
            first_unix_us: Some(first),
            ..JournalNeighbours::default()
        };
        for first in [BEGAN, BEGAN + 1, BEGAN + LATEST_FRAME_US] {
            assert_eq!(fit(Subject::Free, at(first)), JournalFit::Fits);
        }
        for first in [0, BEGAN - 1, BEGAN + LATEST_FRAME_US + 1] {
            let said = fit(Subject::Free, at(first)).fault();
            let said = said.expect("another time").to_string();
            assert!(said.contains("2023-11-14 22:13:20"), "{said}");
        }
        let late = JournalFit::of(&Head::new(Subject::Free, u64::MAX), at(BEGAN));
        assert!(late.fault().is_some());
    }

    #[test]
    fn a_journal_is_of_the_mission_of_its_run() {
        let beside = JournalNeighbours {
            mission: Some("01-air-sample"),
            first_unix_us: Some(BEGAN),
        };
        let mission = |id: &str| Subject::Mission(id.to_owned());
        assert_eq!(fit(mission("01-air-sample"), beside), JournalFit::Fits);
        for other in [mission("02-formation"), Subject::Free] {
            let found = fit(other.clone(), beside);
            assert_eq!(found, JournalFit::OtherFlight(other));
            assert!(found.fault().is_some());
        }
        let none = JournalNeighbours::default();
        assert_eq!(fit(Subject::Free, none), JournalFit::Fits);
    }
}
