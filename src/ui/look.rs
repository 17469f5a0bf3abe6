//! The look: colours, texts, symbols.

use std::sync::Arc;

use ratatui::style::{Modifier, Style};

use super::hits::Hits;
use super::theme::{Role, Theme};
use crate::config::Symbols;
use crate::draft::Draft;
use crate::notice::sanitised;
use crate::text::{Locale, Text};
use crate::vehicle::VehicleId;

/// Colours, texts and symbols; every widget gets one.
#[derive(Debug, Clone, Default)]
pub struct Look {
    pub theme: Theme,
    pub locale: Arc<Locale>,
    /// The symbols for curves and maps.
    pub symbols: Symbols,
    /// The clickable areas of the last frame.
    pub hits: Hits,
}

/// A colour and a sign that distinguish a drone or a team: neighbours differ in both, and the combinations repeat only
/// after thirty.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Badge {
    pub role: Role,
    /// The sign: one character, also in ASCII.
    pub sign: char,
}

impl Badge {
    /// The signs. They differ from one another, and from arrows and the cursor's marks, also in ASCII (`o ^ # + v`).
    const SIGNS: [char; 5] = ['●', '▲', '■', '✚', '▼'];

    /// The signs of drafts without a vehicle. They differ from `SIGNS` too, also in ASCII (`& % @ $
    /// =`).
    const DRAFT_SIGNS: [char; 5] = ['◆', '◇', '◈', '◐', '◧'];

    /// The badge of a drone, on every screen.
    pub fn of_vehicle(id: VehicleId) -> Self {
        Self::at(usize::from(id).saturating_sub(1))
    }

    /// The badge of a team, by its index among the teams.
    pub fn of_team(place: usize) -> Self {
        Self::at(place)
    }

    /// The badge of a draft: that of the vehicle that it is meant for, otherwise a sign that no vehicle has.
    pub fn of_draft(draft: &Draft) -> Self {
        let slot = draft.slot();
        let own = || Self {
            // The first vehicles have the first colours.
            role: Role::DRONES[Role::DRONES.len() - 1 - slot % Role::DRONES.len()],
            sign: Self::DRAFT_SIGNS[slot % Self::DRAFT_SIGNS.len()],
        };
        draft.vehicle().map_or_else(own, Self::of_vehicle)
    }

    fn at(place: usize) -> Self {
        Self {
            role: Role::DRONES[place % Role::DRONES.len()],
            sign: Self::SIGNS[place % Self::SIGNS.len()],
        }
    }
}

impl Look {
    pub fn style(&self, role: Role) -> Style {
        self.theme.style(role)
    }

    /// The style for filled blocks of a role: reversed, they would look empty, and over a background of the role's own
    /// they would have the colour of its letters, which may be that of ordinary text.
    pub fn fill(&self, role: Role) -> Style {
        let kept_off = Modifier::REVERSED | Modifier::UNDERLINED;
        let style = self.style(role).remove_modifier(kept_off);
        let ground = self.style(Role::Text).bg;
        match style
            .bg
            .filter(|own| role != Role::Text && Some(*own) != ground)
        {
            Some(own) => Style {
                fg: Some(own),
                bg: ground,
                ..style
            },
            None => style,
        }
    }

    /// The label of a key. In ASCII, an arrow would look like the key `<`, `>`, `^` or `v`, so it is a word.
    pub fn key(&self, label: &str) -> String {
        if self.symbols != Symbols::Ascii {
            return label.to_owned();
        }
        let named = label.chars().map(|sign| match sign {
            '←' => "Left".to_owned(),
            '→' => "Right".to_owned(),
            '↑' => "Up".to_owned(),
            '↓' => "Down".to_owned(),
            other => other.to_string(),
        });
        named.collect()
    }

    /// A text in the current language, safe to show on one line.
    pub fn text(&self, text: &Text) -> String {
        // Texts name no arrows but those of keys.
        self.key(&sanitised(&self.locale.text(text)))
    }

    /// The arrow between a value before a change and the one after it: a single `>` would compare the two.
    pub fn arrow(&self) -> &'static str {
        match self.symbols {
            Symbols::Ascii => "->",
            Symbols::Braille | Symbols::Block => "→",
        }
    }

    /// A message without arguments; it may have several lines.
    pub fn say(&self, id: &str) -> String {
        self.locale.say(id)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::draft::Drafts;
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
        let drafts = Badge::DRAFT_SIGNS.map(|sign| ascii::line(&sign.to_string()));
        let all: BTreeSet<String> = in_ascii.into_iter().chain(drafts).collect();
        assert_eq!(all.len(), 10);
    }

    #[test]
    fn arrow_keys_have_their_names_in_ascii() {
        let look = |symbols| Look {
            symbols,
            ..Look::default()
        };
        assert_eq!(look(Symbols::Ascii).key("← →"), "Left Right");
        assert_eq!(look(Symbols::Braille).key("← →"), "← →");
        let hint = Text::verbatim("`↑` brings it back");
        assert_eq!(look(Symbols::Ascii).text(&hint), "`Up` brings it back");
    }

    #[test]
    fn filled_blocks_of_danger_look_unlike_text_in_every_theme() {
        for name in Theme::names().filter(|name| *name != "monochrome") {
            let look = Look {
                theme: Theme::named(name).expect("embedded"),
                ..Look::default()
            };
            for role in [Role::Danger, Role::Alert, Role::Armed] {
                let fill = look.fill(role);
                assert_ne!(fill.fg, look.style(Role::Text).fg, "{name} {role:?}");
                let is_plain = fill
                    .bg
                    .is_none_or(|bg| Some(bg) == look.style(Role::Text).bg);
                assert!(is_plain, "{name} {role:?}");
            }
        }
    }

    #[test]
    fn open_drafts_differ_in_colour_and_sign_and_keep_their_own() {
        let draft = |name: &str, vehicle| Draft::new(name, Arc::default(), vehicle);
        let mut drafts = Drafts::default();
        for name in ["a", "b"] {
            drafts.put([draft(name, None)]);
        }
        drafts.put((1..=4).map(|id| draft(&format!("vehicle-{id}"), Some(id))));
        let badges: Vec<Badge> = drafts.all().iter().map(Badge::of_draft).collect();
        let distinct = |of: fn(&Badge) -> String| badges.iter().map(of).collect::<BTreeSet<_>>();
        assert_eq!(distinct(|it| format!("{:?}", it.role)).len(), 6);
        assert_eq!(distinct(|it| it.sign.to_string()).len(), 6);
        drafts.choose("a");
        drafts.close();
        let left: Vec<Badge> = drafts.all().iter().map(Badge::of_draft).collect();
        assert_eq!(left, badges[1..]);
    }
}
