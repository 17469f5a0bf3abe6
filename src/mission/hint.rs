//! Hints: automatic ones for a phase of the flight, and ones on request, which may cost points.

use super::event::expression::Expression;
use crate::text::Text;

/// Automatic advice for a phase of the flight.
#[derive(Debug, Clone, PartialEq)]
pub struct Hint {
    /// The phase in which the hint is shown.
    pub phase: Phase,
    /// Its goal: it is shown until this holds.
    pub(crate) until: Option<Expression>,
    /// The advice; `{next_cell}` is replaced by the next cell to sample.
    pub text: Text,
}

/// Phases of a flight, for hints.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// On the ground, disarmed, with tasks left.
    Ground,
    Armed,
    /// In the air, with tasks left.
    Air,
    /// Everything except the landing is done.
    Done,
}

impl Phase {
    /// The phases by their names in files.
    pub(super) const WORDS: [(&str, Self); 4] = [
        ("ground", Self::Ground),
        ("armed", Self::Armed),
        ("air", Self::Air),
        ("done", Self::Done),
    ];

    /// How much the hints of the phase reveal: 1 is the routine of every flight, 2 the requirements
    /// of this mission.
    pub fn level(self) -> u8 {
        match self {
            Self::Ground | Self::Armed => 1,
            Self::Air | Self::Done => 2,
        }
    }
}

/// Advice that must be requested. Its cost depends on its level and the attempt; see `clues` in `flight`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Clue {
    /// 1: a question or a principle; 2: where to look; 3: the steps.
    pub level: u8,
    /// The only phase in which the hint is suitable; `None` for any phase.
    pub phase: Option<Phase>,
    /// The id of the objective that it helps with, if any; it is not useful once that objective is met.
    pub objective: Option<String>,
    /// The advice; `{next_cell}` is replaced by the next cell to sample.
    pub text: Text,
}

/// The next suitable clue: the first clue of the lowest level, among the clues that have not been
/// given and that match the phase and an open objective.
pub(super) fn next_clue(
    clues: &[Clue],
    given: &[usize],
    phase: Phase,
    is_open: impl Fn(&str) -> bool,
) -> Option<usize> {
    let fits = |clue: &Clue| {
        clue.phase.is_none_or(|wanted| wanted == phase)
            && clue.objective.as_deref().is_none_or(&is_open)
    };
    let open = clues
        .iter()
        .enumerate()
        .filter(|(index, clue)| !given.contains(index) && fits(clue));
    open.min_by_key(|(_, clue)| clue.level)
        .map(|(index, _)| index)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clue(level: u8, phase: Option<Phase>, objective: Option<&str>) -> Clue {
        Clue {
            level,
            phase,
            objective: objective.map(str::to_owned),
            text: Text::default(),
        }
    }

    #[test]
    fn the_next_clue_fits_phase_and_open_objectives_and_is_the_mildest() {
        let clues = [
            clue(3, None, Some("find")),
            clue(2, Some(Phase::Air), None),
            clue(1, None, Some("cover")),
        ];
        let next = |given: &[usize], phase, open: &[&str]| {
            next_clue(&clues, given, phase, |id| open.contains(&id))
        };
        assert_eq!(next(&[], Phase::Air, &["find", "cover"]), Some(2));
        assert_eq!(next(&[2], Phase::Air, &["find", "cover"]), Some(1));
        assert_eq!(next(&[2], Phase::Ground, &["find"]), Some(0));
        assert_eq!(next(&[2], Phase::Ground, &["cover"]), None);
    }
}
