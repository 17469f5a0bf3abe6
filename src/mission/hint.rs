//! Hints: those that show by themselves in a phase of the flight, and those that the trainee asks for at a price.

use super::event::expression::Expression;
use crate::text::Text;

/// Advice that fits a phase of the flight, shown by itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Hint {
    /// When it is shown.
    pub phase: Phase,
    /// What it leads to: it is shown until that holds.
    pub(crate) until: Option<Expression>,
    /// What it says; `{next_cell}` stands for the next cell to sample.
    pub text: Text,
}

/// Phases of a flight, for hints.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// No vehicle is armed, not everything is done.
    Ground,
    /// A vehicle is armed, none flies.
    Armed,
    /// A vehicle flies, not everything is done.
    Air,
    /// All but the landing is done.
    Done,
}

impl Phase {
    /// By the names that they have in files.
    pub(super) const WORDS: [(&str, Self); 4] = [
        ("ground", Self::Ground),
        ("armed", Self::Armed),
        ("air", Self::Air),
        ("done", Self::Done),
    ];

    /// How much its advice gives away: 1 is the routine that every flight begins with, 2 what this mission asks for.
    pub fn level(self) -> u8 {
        match self {
            Self::Ground | Self::Armed => 1,
            Self::Air | Self::Done => 2,
        }
    }
}

/// Advice that has to be asked for. What it costs by its level and by the try, `clues` in `flight` decides.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Clue {
    /// 1: a question or a principle; 2: where to look; 3: how to do it, step by step.
    pub level: u8,
    /// The only phase that it fits, if it is made for one.
    pub phase: Option<Phase>,
    /// The id of the objective that it helps with, if it is made for one: of no use once that is met.
    pub objective: Option<String>,
    /// What it says; `{next_cell}` stands for the next cell to sample.
    pub text: Text,
}

/// Which of them fits now: of those not given that fit phase and open objectives, the first of the lowest level.
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
