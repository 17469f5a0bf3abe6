//! The look: colours, words, symbols.

use std::sync::Arc;

use ratatui::style::{Modifier, Style};

use super::hits::Hits;
use super::theme::{Role, Theme};
use crate::config::Symbols;
use crate::notice::sanitised;
use crate::text::{Locale, Text};
use crate::vehicle::VehicleId;

/// Colours, words and symbols; every widget is handed one.
#[derive(Debug, Clone, Default)]
pub struct Look {
    pub theme: Theme,
    pub locale: Arc<Locale>,
    /// What curves and maps are drawn with.
    pub symbols: Symbols,
    /// What can be clicked on in the frame that was drawn last.
    pub hits: Hits,
}

/// What tells a drone or a team from the others: neighbours differ in both, and thirty follow one another before any
/// two share both.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Badge {
    pub role: Role,
    /// One character, in ASCII too.
    pub sign: char,
}

impl Badge {
    /// Every one differs from the others, and from arrows and marks of the cursor, in ASCII too (`o ^ # + v`).
    const SIGNS: [char; 5] = ['●', '▲', '■', '✚', '▼'];

    /// That of a drone, wherever it is shown.
    pub fn of_vehicle(id: VehicleId) -> Self {
        Self::at(usize::from(id).saturating_sub(1))
    }

    /// That of a team, by its place among the teams.
    pub fn of_team(place: usize) -> Self {
        Self::at(place)
    }

    fn at(place: usize) -> Self {
        Self {
            role: Role::DRONES[place % Role::DRONES.len()],
            sign: Self::SIGNS[place % Self::SIGNS.len()],
        }
    }
}

impl Look {
    /// The style of a role.
    pub fn style(&self, role: Role) -> Style {
        self.theme.style(role)
    }

    /// How blocks of a role look: reversed, a filled one would be empty.
    pub fn fill(&self, role: Role) -> Style {
        let kept_off = Modifier::REVERSED | Modifier::UNDERLINED;
        self.style(role).remove_modifier(kept_off)
    }

    /// A text in words that are safe to show on one line.
    pub fn text(&self, text: &Text) -> String {
        sanitised(&self.locale.text(text))
    }

    /// A message without arguments in words. It may have several lines.
    pub fn say(&self, id: &str) -> String {
        self.locale.say(id)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::ui::ascii;

    #[test]
    fn thirty_drones_differ_and_neighbours_in_colour_and_sign() {
        let badges: Vec<Badge> = (1..=30).map(Badge::of_vehicle).collect();
        let distinct: BTreeSet<_> = badges.iter().map(|it| (it.role, it.sign)).collect();
        assert_eq!(distinct.len(), 30);
        for pair in badges.windows(2) {
            assert!(pair[0].role != pair[1].role && pair[0].sign != pair[1].sign);
        }
        let in_ascii: BTreeSet<String> = Badge::SIGNS
            .map(|sign| ascii::line(&sign.to_string()))
            .into();
        assert_eq!(in_ascii.len(), Badge::SIGNS.len());
    }
}
